//! What `rtc` says of changes of a mesh file that name nothing, or are none.

use std::path::Path;
use std::process::Command;

use serde_json::Value;

const CAR: &str = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nmtllib car.mtl\n\
    o body\nusemtl paint\nf 1 2 3\no wheel\nusemtl rubber\nf 1 2 4\n";

/// Codes, messages, helps and notes of a scene with this shape.
fn said(folder: &Path, shape: &str) -> Vec<String> {
    check(
        folder,
        &format!(
            "asset car = obj(\"car.obj\", unit: m)\nmaterial m: diffuse {{ color = linear(0.5) }}\n\
             camera c: perspective {{ from = (0, 1, 5)m, to = (0, 1, 0)m }}\n\
             instance a {{ shape = {shape}, material = m }}\n"
        ),
    )
}

/// Codes, messages, helps and notes of a scene of these declarations and a sky, seen by the camera `c`.
fn check(folder: &Path, declarations: &str) -> Vec<String> {
    let text =
        format!("rts 1\n{declarations}\nsky s: constant {{ }}\nrender r: path {{ camera = c }}\n");
    std::fs::write(folder.join("a.rts"), text).expect("room for a text");
    let output = Command::new(env!("CARGO_BIN_EXE_rtc"))
        .current_dir(folder)
        .env("RTC_CACHE_DIR", folder.join("cache"))
        .args(["check", "a.rts", "--json"])
        .output()
        .expect("rtc starts");
    let object: Value = serde_json::from_slice(&output.stdout).expect("JSON");
    let list = object["diagnostics"].as_array().expect("a list").iter();
    list.map(|found| {
        let text = |value: &Value| value.as_str().unwrap_or("-").to_owned();
        let children = found["children"].as_array().expect("a list").iter();
        let more: Vec<String> = children.map(|child| text(&child["message"])).collect();
        format!("{} {} [{}]", text(&found["code"]), text(&found["message"]), more.join("; "))
    })
    .collect()
}

/// A triangle of each material, and three cameras above them.
const SHOW: &str = r#"{"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0, 1, 2, 3]}],
"nodes": [{"mesh": 0}, {"name": "Main", "camera": 0, "translation": [0, 0, 5]},
{"name": "Flat", "camera": 1, "translation": [0, 0, 5]}, {"name": "main", "camera": 0}],
"cameras": [{"type": "perspective", "perspective": {"yfov": 0.5, "znear": 0.1}},
{"type": "orthographic", "orthographic": {"xmag": 1, "ymag": 1, "znear": 0.1, "zfar": 9}}],
"meshes": [{"primitives": [
{"attributes": {"POSITION": 0, "TEXCOORD_0": 1}, "material": 0}, {"attributes": {"POSITION": 0, "TEXCOORD_0": 1}, "material": 1},
{"attributes": {"POSITION": 0, "TEXCOORD_0": 1}, "material": 2}, {"attributes": {"POSITION": 0, "TEXCOORD_0": 1}, "material": 3},
{"attributes": {"POSITION": 0, "TEXCOORD_0": 1}, "material": 4}, {"attributes": {"POSITION": 0, "TEXCOORD_0": 1}, "material": 5}]}],
"materials": [{"name": "paint", "extensions": {"KHR_materials_clearcoat": {"clearcoatFactor": 1}}},
{"name": "glass", "extensions": {"KHR_materials_transmission": {"transmissionFactor": 1}, "KHR_materials_ior": {"ior": 1.25},
"KHR_materials_volume": {"thicknessFactor": 1}}, "pbrMetallicRoughness": {"metallicFactor": 0, "roughnessFactor": 0}},
{"name": "sign", "pbrMetallicRoughness": {"baseColorFactor": [0.5, 1, 0.25, 1]}, "extensions": {"KHR_materials_unlit": {}}},
{"name": "lamp", "emissiveFactor": [1, 1, 1]},
{"name": "leaf", "alphaMode": "MASK", "pbrMetallicRoughness": {"baseColorTexture": {"index": 0}}},
{"name": "brushed", "pbrMetallicRoughness": {"roughnessFactor": 0.5}, "extensions": {"KHR_materials_anisotropy": {"anisotropyStrength": 0.5, "anisotropyTexture": {"index": 0}}}}],
"textures": [{"source": 0}], "images": [{"uri": "image.png"}],
"buffers": [{"byteLength": 36, "uri": "data:application/octet-stream;base64,AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAA"}],
"bufferViews": [{"buffer": 0, "byteLength": 36, "byteStride": 12}],
"accessors": [{"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3", "min": [0, 0, 0], "max": [1, 1, 0]},
{"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC2"}]}"#;

/// What is like materials of the file, and what is said of it.
const MATERIALS: [(&str, &[&str]); 13] = [
    ("show.material(\"PAINT\") { roughness = 0.2 }", &[]),
    (
        "show.material(\"piant\") { }",
        &[
            "E0521 `show` has no material named `piant` [a material with a similar name exists: `paint`]",
        ],
    ),
    (
        "show.material(\"door\") { }",
        &[
            "E0521 `show` has no material named `door` [there are: brushed, glass, lamp, leaf, paint, sign]",
        ],
    ),
    (
        "show.material(\"glass\") { roughness = 0.2 }",
        &[
            "E0535 `glass` of `show` is no principled material [declare it: `material m: dielectric { ior = 1.25 }`]",
        ],
    ),
    (
        "show.material(\"sign\") { }",
        &[
            "E0535 `sign` of `show` is no principled material [declare it: `material m: emissive { color = linear(0.5, 1, 0.25), strength = 1, sides = both }`]",
        ],
    ),
    (
        "show.material(\"paint\") { sheen = linear(0.5) }",
        &["E0703 `sheen` cannot go with `coat.weight` [add `coat.weight = 0`, or leave this out]"],
    ),
    ("show.material(\"paint\") { sheen = linear(0.5), coat.weight = 0 }", &[]),
    (
        "show.material(\"lamp\") { coat.roughness = 0.5, specular = 0.5 }",
        &[
            "W0404 `coat.roughness` has no effect: there is no coat []",
            "W0404 `specular` has no effect: what a metal reflects is its `color` []",
        ],
    ),
    (
        "show.material(\"leaf\") { projection = box }",
        &[
            "E0703 a textured `alpha` cannot be projected [use the texture coordinates of the shape: `projection = uv`]",
        ],
    ),
    ("show.material(\"leaf\") { projection = box, alpha = 1 }", &[]),
    (
        "show.material(\"brushed\") { }",
        &["W0524 `brushed`: the image that turns its brushed highlight is left out []"],
    ),
    ("show.material(\"brushed\") { anisotropy = 0 }", &[]),
    (
        "car.material(\"paint\") { roughness = 0.25 }",
        &[
            "W0404 `roughness` has no effect: the material of the file has no highlights; `specular = 1` gives it some []",
        ],
    ),
];

/// What is like cameras of the file, and what is said of it.
const CAMERAS: [(&str, &[&str]); 6] = [
    ("Main\") { f_stop = 2 }", &[]),
    ("Flat\") { }", &[]),
    (
        "Mian\") { }",
        &["E0521 `show` has no camera named `Mian` [a camera with a similar name exists: `Main`]"],
    ),
    (
        "Flat\") { f_stop = 2 }",
        &[
            "E0703 `f_stop` does not go with a camera that is orthographic [leave it out, or declare the camera; `rtc show --assets` prints it to paste]",
        ],
    ),
    ("Main\") { to = (0, 0, 5)m }", &["E0704 the camera looks at the point where it is []"]),
    ("Main\") { up = (0, 0, 1) }", &["E0704 the camera looks along its own `up` []"]),
];

const ASSETS: &str = "asset show = gltf(\"show.gltf\")\nasset car = obj(\"car.obj\", unit: m)\n";
const EYE: &str = "camera c: perspective { from = (0, 1, 5)m, to = (0, 1, 0)m }\n";

fn show() -> tempfile::TempDir {
    let folder = tempfile::tempdir().expect("a folder");
    std::fs::write(folder.path().join("show.gltf"), SHOW).expect("room for a text");
    let image = image::RgbaImage::from_pixel(2, 2, image::Rgba([200, 100, 50, 128]));
    image.save(folder.path().join("image.png")).expect("room for an image");
    std::fs::write(folder.path().join("car.obj"), CAR).expect("room for a text");
    let mtl = "newmtl paint\nillum 1\nnewmtl rubber\n";
    std::fs::write(folder.path().join("car.mtl"), mtl).expect("room for a text");
    folder
}

/// What is said of these declarations with both files, beside what is said of the file with cameras in any case; and
/// whether it is said that its cameras are left out.
fn said_of(folder: &Path, declarations: &str) -> (Vec<String>, bool) {
    let show = "instance always { shape = show }\n";
    let all = check(folder, &format!("{ASSETS}{show}{declarations}\n"));
    let (about_file, rest): (Vec<String>, Vec<String>) =
        all.into_iter().partition(|text| text.starts_with("W0524 show.gltf: "));
    let rest = rest.into_iter().filter(|text| !text.starts_with("W0201 asset `car`"));
    let left_out = "W0524 show.gltf: 3 cameras are left out: `rtc show --assets` prints them as text for the scene \
                    [to look through its camera: `camera eye like show.camera(\"Main\") { }`]";
    (rest.collect(), about_file.iter().any(|text| text == left_out))
}

#[test]
fn what_is_wrong_with_materials_like_those_of_a_file_is_said() {
    let folder = show();
    for (like, expected) in MATERIALS {
        let thing = format!("instance a {{ shape = show, material = m }}\nmaterial m like {like}");
        let expected = expected.iter().map(|text| (*text).to_owned()).collect();
        assert_eq!(said_of(folder.path(), &format!("{EYE}{thing}")), (expected, true), "{like}");
    }
    let mixed = "material m like show.material(\"lamp\") { }\nmaterial both: mix { a = m, b = other }\n\
                 material other: diffuse { color = linear(0.5) }\ninstance a { shape = show, material = both }";
    let expected = "E0534 `m` cannot be mixed with another material \
                    [mix materials that only reflect or scatter light at their surface]";
    assert_eq!(said_of(folder.path(), &format!("{EYE}{mixed}")).0, [expected]);
}

#[test]
fn what_is_wrong_with_cameras_like_those_of_a_file_is_said() {
    let folder = show();
    for (like, expected) in CAMERAS {
        let expected = expected.iter().map(|text| (*text).to_owned()).collect();
        let camera = format!("camera c like show.camera(\"{like}");
        assert_eq!(said_of(folder.path(), &camera), (expected, false), "{like}");
    }
}

#[test]
fn what_names_nothing_and_what_is_no_change_is_said() {
    let folder = tempfile::tempdir().expect("a folder");
    std::fs::write(folder.path().join("car.obj"), CAR).expect("room for a text");
    std::fs::write(folder.path().join("car.mtl"), "newmtl paint\nnewmtl rubber\n").expect("room");
    let cases: [(&str, &[&str]); 8] = [
        ("car { material \"paint\" = m, part \"wheel\" = none }", &[]),
        (
            "car { material \"Piant*\" = m }",
            &[
                "E0521 `car` shows no material named `Piant*` [a material with a similar name exists: `paint`]",
            ],
        ),
        (
            "car { part \"door\" = none }",
            &["E0521 `car` shows no part named `door` [there are: body, wheel]"],
        ),
        (
            "car.body { part \"wheel\" = none }",
            &["E0521 `car` shows no part named `wheel` [there are: body]"],
        ),
        (
            "car { glass \"paint\" = m }",
            &[
                "E0201 a mesh file has no `glass` to replace [it has `material \"name\"` and `part \"name\"`]",
            ],
        ),
        (
            "car { part \"body\" = 3 }",
            &[
                "E0305 this needs a material or `none`, found a plain number [`none` leaves out what has this name]",
            ],
        ),
        ("car { part \"body\" = wood }", &["E0202 no material named `wood` []"]),
        (
            "sphere(radius: 1m) { part \"x\" = none }",
            &[
                "E0305 only the materials and parts of a mesh file can be replaced [write `asset { material \"its name\" = mine }` after the name of an `asset`]",
            ],
        ),
    ];
    for (shape, expected) in cases {
        assert_eq!(said(folder.path(), shape), expected, "{shape}");
    }
}

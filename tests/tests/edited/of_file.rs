//! Materials and cameras that are like those of a mesh file: the file's own where a declaration says nothing, and the
//! declaration's where it does.

use std::path::Path;

use pack::Pack;
use tests::picture;
use tests::scene::{bytes, compile_in};

/// Materials of a glTF file, of which each extension and each kind of image is in one at least. Image 0 is a colour with
/// alpha, image 1 numbers, image 2 a normal map.
const MATERIALS: [&str; 9] = [
    r#""pbrMetallicRoughness": {"baseColorTexture": {"index": 0}, "baseColorFactor": [0.9, 0.5, 0.7, 1],
"metallicRoughnessTexture": {"index": 1}, "metallicFactor": 0.6, "roughnessFactor": 0.7}"#,
    r#""emissiveTexture": {"index": 0}, "emissiveFactor": [0.5, 1, 0.25],
"extensions": {"KHR_materials_emissive_strength": {"emissiveStrength": 3}, "KHR_materials_clearcoat":
{"clearcoatFactor": 0.8, "clearcoatTexture": {"index": 1}, "clearcoatRoughnessFactor": 0.2,
"clearcoatRoughnessTexture": {"index": 1}}}"#,
    r#""alphaMode": "BLEND", "pbrMetallicRoughness": {"baseColorTexture": {"index": 0},
"baseColorFactor": [1, 1, 1, 0.75], "metallicFactor": 0}"#,
    r#""alphaMode": "MASK", "alphaCutoff": 0.4, "pbrMetallicRoughness": {"baseColorTexture": {"index": 0},
"metallicFactor": 0}"#,
    r#""pbrMetallicRoughness": {"metallicFactor": 0, "roughnessFactor": 0.9}, "extensions": {"KHR_materials_sheen":
{"sheenColorFactor": [0.9, 0.6, 0.3], "sheenColorTexture": {"index": 0}, "sheenRoughnessFactor": 0.6,
"sheenRoughnessTexture": {"index": 0}}}"#,
    r#""pbrMetallicRoughness": {"roughnessFactor": 0.4}, "extensions": {"KHR_materials_anisotropy":
{"anisotropyStrength": 0.7, "anisotropyRotation": 0.3}}"#,
    r#""pbrMetallicRoughness": {"metallicFactor": 0, "roughnessFactor": 0.3}, "extensions":
{"KHR_materials_transmission": {"transmissionFactor": 0.6, "transmissionTexture": {"index": 1}}}"#,
    r#""pbrMetallicRoughness": {"metallicFactor": 0, "roughnessFactor": 0.2}, "extensions": {"KHR_materials_specular":
{"specularFactor": 0.5, "specularTexture": {"index": 0}, "specularColorFactor": [1, 0.5, 0.2],
"specularColorTexture": {"index": 0}}, "KHR_materials_ior": {"ior": 1.8}}"#,
    r#""normalTexture": {"index": 2, "scale": 0.8}, "pbrMetallicRoughness": {"metallicFactor": 0.5}"#,
];

/// A file with a square of 1 m for each material, side by side, from x = 0 on; their vertices have colours if `colored`.
fn write(dir: &Path, materials: &[&str], colored: bool) {
    let corners = [[0.0_f32, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]];
    let mut buffer: Vec<u8> = Vec::new();
    let mut list = |values: &mut dyn Iterator<Item = f32>| {
        buffer.extend(values.flat_map(f32::to_le_bytes));
    };
    list(&mut corners.iter().flat_map(|[x, y]| [*x, *y, 0.0]));
    list(&mut corners.iter().flat_map(|[x, y]| [*x, 1.0 - *y]));
    list(
        &mut corners.iter().flat_map(|[x, y]| [0.5 + 0.4 * x, 0.5 + 0.4 * y, 0.75, 0.25 + 0.5 * x]),
    );
    buffer.extend([0_u16, 1, 2, 0, 2, 3].into_iter().flat_map(u16::to_le_bytes));
    std::fs::write(dir.join("row.bin"), &buffer).expect("a file can be written");
    let all = |part: &dyn Fn(usize) -> String| {
        (0..materials.len()).map(part).collect::<Vec<String>>().join(",\n")
    };
    let color = if colored { ", \"COLOR_0\": 2" } else { "" };
    let meshes = all(&|k| {
        format!(
            "{{\"primitives\": [{{\"attributes\": {{\"POSITION\": 0, \"TEXCOORD_0\": 1{color}}}, \
             \"indices\": 3, \"material\": {k}}}]}}"
        )
    });
    let nodes = all(&|k| format!("{{\"mesh\": {k}, \"translation\": [{k}, 0, 0]}}"));
    let named = all(&|k| format!("{{\"name\": \"m{k}\", {}}}", materials[k]));
    let roots = all(&|k| k.to_string());
    let text = format!(
        r#"{{"asset": {{"version": "2.0"}}, "scene": 0, "scenes": [{{"nodes": [{roots}]}}],
"nodes": [{nodes}], "meshes": [{meshes}], "materials": [{named}],
"textures": [{{"source": 0}}, {{"source": 1}}, {{"source": 2}}],
"images": [{{"uri": "paint.png"}}, {{"uri": "numbers.png"}}, {{"uri": "bumps.png"}}],
"buffers": [{{"uri": "row.bin", "byteLength": 156}}],
"bufferViews": [{{"buffer": 0, "byteLength": 48}}, {{"buffer": 0, "byteOffset": 48, "byteLength": 32}},
{{"buffer": 0, "byteOffset": 80, "byteLength": 64}}, {{"buffer": 0, "byteOffset": 144, "byteLength": 12}}],
"accessors": [{{"bufferView": 0, "componentType": 5126, "count": 4, "type": "VEC3", "min": [0, 0, 0], "max": [1, 1, 0]}},
{{"bufferView": 1, "componentType": 5126, "count": 4, "type": "VEC2"}},
{{"bufferView": 2, "componentType": 5126, "count": 4, "type": "VEC4"}},
{{"bufferView": 3, "componentType": 5123, "count": 6, "type": "SCALAR"}}]}}"#
    );
    std::fs::write(dir.join("row.gltf"), text).expect("a file can be written");
    let image = |name: &str, at: fn(u8) -> [u8; 4]| {
        let image = image::RgbaImage::from_fn(4, 4, |x, y| {
            image::Rgba(at(u8::try_from(x + 4 * y).expect("16 texels")))
        });
        image.save(dir.join(name)).expect("an image can be written");
    };
    image("paint.png", |k| [90 + 10 * k, 250 - 9 * k, 128, 70 + 12 * k]);
    image("numbers.png", |k| [255 - 12 * k, 80 + 11 * k, 17 * k, 255]);
    image("bumps.png", |k| [100 + 4 * k, 160 - 5 * k, 240, 255]);
}

fn row(things: &str) -> String {
    format!(
        "rts 1
asset row = gltf(\"row.gltf\")
{things}
light lamp: sphere {{ center = (2, 3, 4)m, radius = 50cm, strength = 20 }}
sky day: constant {{ color = linear(0.5) }}
camera eye: perspective {{ from = (4.5, 1, 12)m, to = (4.5, 0.5, 0)m, fov.horizontal = 42deg }}
film f {{ size = (144, 16)px }}
render main: path {{ camera = eye, film = f, samples = 16, seed = 5 }}
"
    )
}

/// Radiance of each pixel: red, green, blue.
fn radiance(dir: &Path, things: &str) -> Vec<f64> {
    let compiled = compile_in(dir, &row(things));
    let pack = Pack::from_bytes(bytes(&compiled)).expect("a good pack");
    let outcome = picture::cpu(pack, |_| {});
    (0..3).flat_map(|k| picture::channel(outcome.film(), k)).collect()
}

/// The row without these materials.
fn without(left_out: impl Iterator<Item = usize>) -> String {
    let lines: Vec<String> = left_out.map(|k| format!("material \"m{k}\" = none")).collect();
    format!("row {{ {} }}", lines.join(", "))
}

#[test]
fn what_says_nothing_looks_like_the_material_of_the_file() {
    let dir = tempfile::tempdir().expect("a folder");
    for colored in [false, true] {
        write(dir.path(), &MATERIALS, colored);
        for k in 0..MATERIALS.len() {
            // The materials of the file, on two instances as the other scene has them: what is not all there
            // is by chance, which depends on the instance.
            let (rest, alone) = (without(k..=k), without((0..MATERIALS.len()).filter(|i| *i != k)));
            let [a, b] = if k == 0 { [alone, rest] } else { [rest, alone] };
            let own = format!("instance a {{ shape = {a} }}\ninstance b {{ shape = {b} }}");
            let like = format!(
                "material l like row.material(\"m{k}\") {{ }}\n\
                 instance r {{ shape = row {{ material \"m{k}\" = l }} }}"
            );
            let [own, like] = [own, like].map(|things| radiance(dir.path(), &things));
            let far =
                own.iter().zip(&like).filter(|(a, b)| (**a - **b).abs() > 1e-4 * (0.1 + a.abs()));
            // Factors, images and colours of vertices are multiplied in another order.
            let far = far.count();
            assert!(far <= own.len() / 1_000, "material {k}, {colored}: {far} numbers differ");
        }
    }
}

/// Factors of a file, and what a declaration with all of them says.
const FACTORS: [(&str, &[(&str, &str)]); 2] = [
    (
        r#""alphaMode": "BLEND", "pbrMetallicRoughness": {"baseColorFactor": [0.5, 0.25, 0.75, 0.5],
"metallicFactor": 0.25, "roughnessFactor": 0.5}, "emissiveFactor": [0.25, 0.5, 1], "extensions": {
"KHR_materials_ior": {"ior": 1.75}, "KHR_materials_specular": {"specularFactor": 0.5, "specularColorFactor": [0.5, 1, 0.25]},
"KHR_materials_clearcoat": {"clearcoatFactor": 0.5, "clearcoatRoughnessFactor": 0.125},
"KHR_materials_transmission": {"transmissionFactor": 0.25}}"#,
        &[
            ("color", "linear(0.5, 0.25, 0.75)"),
            ("metallic", "0.25"),
            ("roughness", "0.5"),
            ("ior", "1.75"),
            ("specular", "0.5"),
            ("specular.color", "linear(0.5, 1, 0.25)"),
            ("coat.weight", "0.5"),
            ("coat.roughness", "0.125"),
            ("transmission", "0.25"),
            ("emission.color", "linear(0.25, 0.5, 1)"),
            ("emission.strength", "1"),
            ("alpha", "0.5"),
        ],
    ),
    (
        r#""pbrMetallicRoughness": {"metallicFactor": 0}, "extensions": {"KHR_materials_sheen":
{"sheenColorFactor": [0.5, 0.25, 0.75], "sheenRoughnessFactor": 0.5}}"#,
        &[
            ("color", "linear(1)"),
            ("roughness", "1"),
            ("sheen", "linear(0.5, 0.25, 0.75)"),
            ("sheen.roughness", "0.5"),
        ],
    ),
];

/// Another value of a field.
fn other(field: &str, value: &str) -> &'static str {
    match field {
        "alpha" => "0.75",
        "ior" => "1.5",
        _ if value.starts_with("linear") => "linear(0.75, 0.5, 0.125)",
        _ => "0.375",
    }
}

/// Records of two materials, which must be the same; `textures` count, too.
fn same(dir: &Path, things: [&str; 2]) {
    let [a, b] = things.map(|things| {
        let things = format!("{things}\ninstance r {{ shape = row {{ material \"m0\" = l }} }}");
        compile_in(dir, &row(&things)).lowered
    });
    assert_eq!(a.materials, b.materials, "{}", things[0]);
    assert_eq!(a.textures, b.textures, "{}", things[0]);
    assert_eq!(a.texels.len(), b.texels.len(), "{}", things[0]);
}

#[test]
fn what_is_said_replaces_what_the_file_says_and_nothing_else() {
    let dir = tempfile::tempdir().expect("a folder");
    for (material, fields) in FACTORS {
        write(dir.path(), &[material], false);
        let declared = |changed: Option<usize>| {
            let line = |(k, (field, value)): (usize, &(&str, &str))| {
                let value = if changed == Some(k) { other(field, value) } else { value };
                format!("{field} = {value}")
            };
            let lines: Vec<String> = fields.iter().enumerate().map(line).collect();
            format!("material l: principled {{ {} }}", lines.join(", "))
        };
        same(dir.path(), ["material l like row.material(\"M0\") { }", &declared(None)]);
        for (k, (field, value)) in fields.iter().enumerate() {
            let said = format!("{field} = {}", other(field, value));
            let like = format!("material l like row.material(\"m0\") {{ {said} }}");
            same(dir.path(), [&like, &declared(Some(k))]);
        }
    }
    // glTF widens the highlight of a brushed surface; where it is said how rough and how brushed, only the angle is left.
    let brushed = r#""pbrMetallicRoughness": {"roughnessFactor": 0.5}, "extensions": {"KHR_materials_anisotropy":
{"anisotropyStrength": 0.5, "anisotropyRotation": 0.75}}"#;
    write(dir.path(), &[brushed], false);
    let said = "roughness = 0.25, anisotropy = 0.75";
    let like = format!("material l like row.material(\"m0\") {{ {said} }}");
    let rest = "color = linear(1), metallic = 1, anisotropy.rotation = 0.75rad";
    same(dir.path(), [&like, &format!("material l: principled {{ {said}, {rest} }}")]);
}

#[test]
fn images_of_the_file_and_of_the_scene_go_together() {
    let dir = tempfile::tempdir().expect("a folder");
    let images = r#""pbrMetallicRoughness": {"metallicRoughnessTexture": {"index": 1},
"baseColorTexture": {"index": 0}}, "normalTexture": {"index": 2, "scale": 0.5}, "alphaMode": "MASK""#;
    write(dir.path(), &[images], false);
    let own = "texture p = image(\"paint.png\", space: srgb)
texture n = image(\"numbers.png\", space: data)
texture b = image(\"bumps.png\", space: data)
material l: principled { color = p.rgb, metallic = n.b, roughness = n.g, normal = b.rgb, normal.strength = 0.5, \
               alpha = p.a, alpha.clip = 0.5 }";
    let like = |said: &str| {
        let texture = if said.contains("n.") {
            "texture n = image(\"numbers.png\", space: data)\n"
        } else {
            ""
        };
        format!(
            "{texture}material base like row.material(\"m0\") {{ }}\nmaterial l like base {{ {said} }}"
        )
    };
    let cases = [
        ("", own.to_owned()),
        ("roughness = n.r", own.replace("n.g", "n.r")),
        ("roughness = 0.25", own.replace("n.g", "0.25")),
        ("metallic = default", own.replace("metallic = n.b, ", "")),
        ("normal.strength = 2", own.replace("strength = 0.5", "strength = 2")),
        (
            "normal = none",
            own.replace(", normal = b.rgb, normal.strength = 0.5", "")
                .replace("texture b", "texture _b"),
        ),
        ("alpha.clip = 0.25", own.replace("clip = 0.5", "clip = 0.25")),
        ("alpha.clip = none", own.replace(", alpha.clip = 0.5", "")),
        (
            "projection = x, alpha = 1",
            own.replace("alpha = p.a, alpha.clip = 0.5", "projection = x"),
        ),
    ];
    for (said, declared) in cases {
        let own = radiance(
            dir.path(),
            &format!("{declared}\ninstance r {{ shape = row {{ material \"m0\" = l }} }}"),
        );
        let found = radiance(
            dir.path(),
            &format!("{}\ninstance r {{ shape = row {{ material \"m0\" = l }} }}", like(said)),
        );
        let bits = |values: &[f64]| values.iter().map(|x| x.to_bits()).collect::<Vec<u64>>();
        assert!(own.iter().any(|x| *x > 0.1) && bits(&own) == bits(&found), "{said}");
    }
}

/// A scene of the row with this camera.
fn seen_by(dir: &Path, camera: &str) -> (pack::abi::Camera, Vec<pack::abi::CameraKey>) {
    let text = row("instance r { shape = row }");
    let eye = text.lines().find(|line| line.starts_with("camera")).expect("the row has a camera");
    let lowered = compile_in(dir, &text.replace(eye, camera)).lowered;
    (lowered.camera, lowered.camera_keys)
}

#[test]
fn cameras_of_files_are_those_that_one_would_declare() {
    let dir = tempfile::tempdir().expect("a folder");
    write(dir.path(), &[r#""doubleSided": true"#], false);
    let text =
        std::fs::read_to_string(dir.path().join("row.gltf")).expect("the file that was written");
    // Both stand before the square, which is from 0 to 1 along x and y; the second lies on its side.
    let cameras = r#""cameras": [{"type": "perspective", "perspective": {"yfov": 0.5, "znear": 0.1}},
{"type": "orthographic", "orthographic": {"xmag": 3, "ymag": 0.75, "znear": 0.1, "zfar": 9}}], "nodes": ["#;
    let nodes = r#", {"name": "Eye", "camera": 0, "translation": [1, 2, 5]},
{"name": "Top", "camera": 1, "translation": [1, 2, 5], "rotation": [0, 0, 0.70710678, 0.70710678]}], "meshes""#;
    let text = text.replace("\"nodes\": [{\"mesh\"", &format!("{cameras}{{\"mesh\""));
    let text =
        text.replace("], \"meshes\"", nodes).replace("\"nodes\": [0]}", "\"nodes\": [0, 1, 2]}");
    std::fs::write(dir.path().join("row.gltf"), text).expect("a file can be written");
    let place = "from = (1, 2, 5)m, to = (1, 2, 0)m";
    let cases = [
        ("", format!("perspective {{ {place}, fov.vertical = 0.5rad }}")),
        ("f_stop = 2", format!("perspective {{ {place}, fov.vertical = 0.5rad, f_stop = 2 }}")),
        (
            "aperture = 3cm, blades = 5, focus = 2m",
            format!("perspective {{ {place}, fov.vertical = 0.5rad, aperture = 3cm, blades = 5, focus = 2m }}"),
        ),
        ("lens = 35mm, f_stop = 4", format!("perspective {{ {place}, lens = 35mm, f_stop = 4 }}")),
        ("fov.horizontal = 1rad", format!("perspective {{ {place}, fov.horizontal = 1rad }}")),
        (
            "from = (3, 2, 5)m, up = (0, 2, 1)",
            "perspective { from = (3, 2, 5)m, to = (1, 2, 0)m, up = (0, 2, 1), fov.vertical = 0.5rad }".to_owned(),
        ),
        (
            "to = (0, 0, 0)m, aperture = 2cm",
            "perspective { from = (1, 2, 5)m, to = (0, 0, 0)m, fov.vertical = 0.5rad, aperture = 2cm }".to_owned(),
        ),
        (
            "from = [0ms: (1, 2, 5)m, 10ms: (2, 2, 5)m], shutter = 0ms..10ms, aperture = 1cm",
            "perspective { from = [0ms: (1, 2, 5)m, 10ms: (2, 2, 5)m], to = (1, 2, 0)m, shutter = 0ms..10ms, \
             aperture = 1cm, fov.vertical = 0.5rad }"
                .to_owned(),
        ),
        ("fit = r", format!("perspective {{ {place}, fov.vertical = 0.5rad, fit = r }}")),
    ];
    for (said, declared) in cases {
        let like =
            seen_by(dir.path(), &format!("camera eye like row.camera(\"eye\") {{ {said} }}"));
        assert_eq!(like, seen_by(dir.path(), &format!("camera eye: {declared}")), "{said}");
    }
    let like = seen_by(dir.path(), "camera eye like row.camera(\"Top\") { }").0;
    let flat = seen_by(
        dir.path(),
        &format!("camera eye: orthographic {{ {place}, up = (-1, 0, 0), height = 1.5m }}"),
    );
    let numbers = |camera: &pack::abi::Camera| bytemuck::cast_slice::<_, f32>(&[*camera]).to_vec();
    for (a, b) in numbers(&like).iter().zip(numbers(&flat.0)) {
        assert!((a - b).abs() < 1e-5, "{like:?} {flat:?}");
    }
}

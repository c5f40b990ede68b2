//! glTF and GLB: the scene graph, accessors, materials, and every refusal with its accessor.

#![expect(clippy::float_cmp, reason = "these numbers are exact")]

#[path = "import_gltf/compressed.rs"]
mod compressed;
#[path = "import_gltf/extensions.rs"]
mod extensions;
mod import_support;

use compiler::import::{
    ErrorKind, FileView, ImportError, LightKind, Limits, MeshFile, load_gltf, read_gltf, topology,
};
use import_support::{Builder, glb, tiny_png, triangle};
use lang::scene::{ColorSpace, GltfChoice, Wrap};
use serde_json::{Value, json};
use std::fs;
use std::path::Path;
use tempfile::TempDir;

fn load_bytes(bytes: &[u8], files: &[(&str, &[u8])]) -> Result<MeshFile, ImportError> {
    let folder = TempDir::new().expect("temporary folder");
    for (name, bytes) in files {
        fs::write(folder.path().join(name), bytes).expect("write");
    }
    let path = folder.path().join("a.glb");
    fs::write(&path, bytes).expect("write");
    load_gltf(&path, &GltfChoice::default(), &Limits::default()).map_err(|mut error| {
        error.place = error.place.replace(&format!("{}/", folder.path().display()), "");
        error
    })
}

/// The same of bytes that are in no file.
fn read_bytes(bytes: &[u8]) -> Result<MeshFile, ImportError> {
    read_gltf(bytes, Path::new("a.glb"), &GltfChoice::default(), &Limits::default())
}

fn load(document: &Builder) -> MeshFile {
    load_bytes(&document.glb(), &[]).expect("a good file")
}

/// The error of a changed `triangle()` must be exactly `expected`.
fn check_error(change: impl FnOnce(&mut Value), expected: &str) {
    let mut document = triangle();
    change(&mut document.json);
    let error = load_bytes(&document.glb(), &[]).expect_err("a bad file");
    assert_eq!(error.to_string(), expected);
}

fn close(a: f64, b: f64) -> bool {
    (a - b).abs() < 1e-6
}

fn soup(mesh: &MeshFile) -> Vec<[[f32; 3]; 3]> {
    let parts = mesh.parts.iter();
    parts.flat_map(|part| (0..part.triangles.len()).map(|tri| part.corners(tri))).collect()
}

#[test]
fn triangle_has_its_numbers_and_v_points_up() {
    let mesh = load(&triangle());
    assert_eq!(soup(&mesh), [[[0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]]]);
    assert_eq!(mesh.parts[0].corner_normals(0), Some([[0.0, 0.0, 1.0]; 3]));
    assert_eq!(mesh.parts[0].corner_uvs(0), Some([[0.0, 1.0], [1.0, 1.0], [0.0, 0.0]]));
    let bounds = mesh.report.bounds.expect("bounds");
    assert_eq!(bounds, [[0.0; 3], [1.0, 1.0, 0.0]]);
}

#[test]
fn nodes_are_baked_with_their_parents_and_named() {
    let mut document = triangle();
    document.json["nodes"] = json!([
        {"name": "car", "translation": [10, 0, 0], "children": [1, 2]},
        {"name": "wheel left", "mesh": 0, "scale": [2, 2, 2]},
        {"rotation": [0, 0, 0.707_106_77, 0.707_106_77], "children": [3]},
        {"name": "door", "mesh": 0,
         "matrix": [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 5, 1]}
    ]);
    document.json["meshes"][0]["name"] = json!("tri");
    let mesh = load(&document);
    let names: Vec<_> = mesh.parts.iter().map(|part| part.name.as_str()).collect();
    assert_eq!(names, ["car/wheel left", "car/node 2/door"]);
    assert_eq!(mesh.find_parts("car"), [0, 1]);
    assert_eq!(mesh.find_parts("tri"), [0, 1]);
    assert_eq!(mesh.find_parts("wheel_left"), [0]);
    assert_eq!(mesh.find_parts("door"), [1]);
    assert!(mesh.find_parts("node 2").is_empty(), "made-up names select nothing");
    assert_eq!(mesh.parts[0].corners(0)[1], [12.0, 0.0, 0.0]);
    // A quarter turn about z takes x to y.
    let turned = mesh.parts[1].corners(0)[1];
    for (found, expected) in turned.into_iter().zip([10.0, 1.0, 5.0]) {
        assert!((found - expected).abs() < 1e-5, "{turned:?}");
    }
}

#[test]
fn mirrors_keep_the_outside_outside() {
    let mut document = triangle();
    document.json["nodes"][0]["scale"] = json!([-1, 2, 3]);
    let mesh = load(&document);
    let [a, b, c] = mesh.parts[0].corners(0);
    let z = (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
    assert!(z > 0.0, "still counter-clockwise from +z");
    assert_eq!(mesh.parts[0].corner_normals(0), Some([[0.0, 0.0, 1.0]; 3]));
}

#[test]
fn strips_and_fans_and_missing_indices() {
    let square = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [1.0, 1.0, 0.0]];
    for (mode, order, area) in [(5, [0, 1, 2, 3], 1.0), (6, [0, 1, 3, 2], 1.0)] {
        let mut document = Builder::default();
        let positions = document.floats(&order.map(|i| square[i]), "VEC3");
        document.mesh(&json!({"attributes": {"POSITION": positions}, "mode": mode}));
        let mesh = load(&document);
        let parts: Vec<_> = mesh.parts.iter().collect();
        let found = topology(&parts);
        assert_eq!(
            (found.boundary_edges, found.flipped_edges, soup(&mesh).len()),
            (4, 0, 2),
            "{area}"
        );
        assert_eq!(mesh.parts[0].corner_normals(0), None, "flat where the file has no normals");
    }
    let mut document = Builder::default();
    let positions = document.floats(&square, "VEC3");
    let indices = document.indices(&[0, 1, 2, 2, 3, 3, 1, 2, 3]);
    document.mesh(&json!({"attributes": {"POSITION": positions}, "indices": indices, "mode": 5}));
    document.mesh(&json!({"attributes": {"POSITION": positions}, "mode": 1}));
    let mesh = load(&document);
    assert_eq!(mesh.report.zero_area.count, 0, "sewing triangles of strips are no surface");
    assert_eq!(mesh.report.warnings[0].message, "1 primitives of points or lines are left out");
}

#[test]
fn sparse_interleaved_and_quantised_accessors() {
    let mut document = Builder::default();
    let positions = document.floats(&[[0.0_f32; 3], [1.0, 0.0, 0.0], [0.0; 3]], "VEC3");
    let at = document.view(&[2, 0]);
    let new = document.view(bytemuck::cast_slice(&[0.0_f32, 3.0, 0.0]));
    document.json["accessors"][positions]["sparse"] = json!({"count": 1,
        "indices": {"bufferView": at, "componentType": 5121}, "values": {"bufferView": new}});
    document.mesh(&json!({"attributes": {"POSITION": positions}}));
    assert_eq!(soup(&load(&document)), [[[0.0; 3], [1.0, 0.0, 0.0], [0.0, 3.0, 0.0]]]);

    let mut document = Builder::default();
    let shorts: [i16; 12] = [0, 0, 0, 77, 32767, 0, 0, 77, 0, -32768, 0, 77];
    let view = document.view(bytemuck::cast_slice(&shorts));
    document.json["bufferViews"][view]["byteStride"] = json!(8);
    let accessor = json!({"bufferView": view, "componentType": 5122, "normalized": true, "count": 3, "type": "VEC3"});
    let positions = document.push("accessors", accessor);
    document.mesh(&json!({"attributes": {"POSITION": positions}}));
    document.json["extensionsRequired"] = json!(["KHR_mesh_quantization"]);
    assert_eq!(soup(&load(&document)), [[[0.0; 3], [1.0, 0.0, 0.0], [0.0, -1.0, 0.0]]]);
}

/// glTF 2.0, 3.7.2.1: without a material a primitive has the default one.
#[test]
fn primitives_without_a_material_are_white_rough_metal() {
    let mesh = load(&triangle());
    let [default] = &mesh.materials[..] else { panic!("{:?}", mesh.materials) };
    assert_eq!((default.name.as_str(), mesh.parts[0].material), ("default", Some(0)));
    assert_eq!((default.color, default.metallic, default.roughness), ([1.0; 3], 1.0, 1.0));
}

#[test]
fn materials_carry_factors_maps_and_extensions() {
    let mut document = triangle();
    let image = document.view(&tiny_png());
    document.json["images"] =
        json!([{"bufferView": image, "mimeType": "image/png"}, {"uri": "no such.png"}]);
    document.json["samplers"] = json!([{"wrapS": 33071, "wrapT": 33648}]);
    document.json["textures"] = json!([{"source": 0, "sampler": 0}, {"source": 1}]);
    document.json["materials"] = json!([
        {"name": "unused", "emissiveTexture": {"index": 1}},
        {"name": "wood", "alphaMode": "MASK", "alphaCutoff": 0.25, "doubleSided": true,
         "emissiveFactor": [1, 0.5, 0], "normalTexture": {"index": 0, "scale": 0.5, "extensions":
            {"KHR_texture_transform": {"offset": [0.5, 0], "scale": [2, 1], "rotation": 1.570_796_4}}},
         "pbrMetallicRoughness": {"baseColorFactor": [0.5, 0.6, 0.7, 0.8], "metallicFactor": 0.1,
            "roughnessFactor": 0.3, "baseColorTexture": {"index": 0, "extensions":
                {"KHR_texture_transform": {"offset": [0.5, 0], "scale": [2, 1], "rotation": 1.570_796_4}}}},
         "extensions": {"KHR_materials_emissive_strength": {"emissiveStrength": 4},
            "KHR_materials_ior": {"ior": 1.25}, "KHR_materials_transmission": {"transmissionFactor": 0.75}}}
    ]);
    document.json["meshes"][0]["primitives"][0]["material"] = json!(1);
    let mesh = load(&document);
    let [wood] = &mesh.materials[..] else { panic!("{:?}", mesh.materials) };
    assert_eq!((wood.name.as_str(), mesh.parts[0].material), ("wood", Some(0)));
    assert!(close(wood.color[2], 0.7) && close(wood.metallic, 0.1) && close(wood.roughness, 0.3));
    assert_eq!((wood.emission, wood.alpha_clip), ([4.0, 2.0, 0.0], Some(0.25)));
    assert!(close(wood.alpha, 0.8) && close(wood.ior, 1.25) && close(wood.transmission, 0.75));
    let map = wood.color_map.expect("map");
    assert_eq!((map.wrap, wood.alpha_map), ([Wrap::Clamp, Wrap::Mirror], Some(map)));
    assert_eq!(mesh.images.len(), 1);
    // (1, 0) scaled (2, 0), turned counter-clockwise in the image (v downwards) (0, -2), moved, flipped.
    let [_, uv, _] = mesh.parts[0].corner_uvs(0).expect("uvs");
    assert!((uv[0] - 0.5).abs() < 1e-6 && (uv[1] - 3.0).abs() < 1e-6, "{uv:?}");
    let normal = wood.normal_map.expect("map");
    assert_eq!((normal.space, wood.normal_strength), (ColorSpace::Data, 0.5));
    assert_eq!(mesh.report.warnings, [], "looked up like the colour");
}

#[test]
fn layers_of_a_material_are_read_from_their_extensions() {
    let mut document = triangle();
    let image = document.view(&tiny_png());
    document.json["images"] = json!([{"bufferView": image, "mimeType": "image/png"}]);
    document.json["textures"] = json!([{"source": 0}]);
    document.json["extensionsRequired"] =
        json!(["KHR_materials_clearcoat", "KHR_materials_volume"]);
    document.json["materials"] = json!([{"name": "paint", "extensions": {
        "KHR_materials_specular": {"specularFactor": 0.5, "specularColorFactor": [2, 1, 0.5],
            "specularTexture": {"index": 0}, "specularColorTexture": {"index": 0}},
        "KHR_materials_clearcoat": {"clearcoatFactor": 0.75, "clearcoatRoughnessFactor": 0.25,
            "clearcoatTexture": {"index": 0}, "clearcoatNormalTexture": {"index": 0}},
        "KHR_materials_transmission": {"transmissionFactor": 1, "transmissionTexture": {"index": 0}},
        "KHR_materials_volume": {"thicknessFactor": 0.1, "attenuationDistance": 2,
            "attenuationColor": [0.5, 1, 1]}
    }, "pbrMetallicRoughness": {"metallicFactor": 0}}]);
    document.json["meshes"][0]["primitives"][0]["material"] = json!(0);
    let mesh = load(&document);
    let [paint] = &mesh.materials[..] else { panic!("{:?}", mesh.materials) };
    assert_eq!((paint.specular, paint.specular_color), (0.5, [2.0, 1.0, 0.5]));
    assert_eq!((paint.coat, paint.coat_roughness, paint.transmission), (0.75, 0.25, 1.0));
    let spaces =
        [paint.specular_map, paint.specular_color_map, paint.coat_map, paint.transmission_map]
            .map(|map| map.map(|map| map.space));
    let (data, srgb) = (Some(ColorSpace::Data), Some(ColorSpace::Srgb));
    assert_eq!((spaces, paint.coat_roughness_map), ([data, srgb, data, data], None));
    assert!(paint.solid && paint.is_glass());
    let said: Vec<&str> = mesh.report.warnings.iter().map(|w| w.message.as_str()).collect();
    assert_eq!(
        said,
        [
            "1 materials have coats with normal maps of their own, which are not used",
            "1 materials are solid glass, whose colour, roughness, coat and opaque part are not used",
        ]
    );
    // Half of the red is left after two metres.
    let expected = std::f64::consts::LN_2 / 2.0;
    assert!(close(paint.sigma_a[0], expected) && paint.sigma_a[1..] == [0.0, 0.0]);
}

#[test]
fn sheen_is_read_with_its_images() {
    let mut document = triangle();
    let image = document.view(&tiny_png());
    document.json["images"] = json!([{"bufferView": image, "mimeType": "image/png"}]);
    document.json["textures"] = json!([{"source": 0}]);
    document.json["extensionsRequired"] = json!(["KHR_materials_sheen"]);
    let sheen = json!({"sheenColorFactor": [0.5, 0.25, 2], "sheenRoughnessFactor": 0.75,
        "sheenColorTexture": {"index": 0}, "sheenRoughnessTexture": {"index": 0}});
    document.json["materials"] = json!([{"extensions": {"KHR_materials_sheen": sheen}}]);
    document.json["meshes"][0]["primitives"][0]["material"] = json!(0);
    let mesh = load(&document);
    let velvet = &mesh.materials[0];
    assert_eq!((velvet.sheen, velvet.sheen_roughness), ([0.5, 0.25, 1.0], 0.75));
    let spaces = [velvet.sheen_map, velvet.sheen_roughness_map].map(|map| map.map(|map| map.space));
    assert_eq!(spaces, [Some(ColorSpace::Srgb), Some(ColorSpace::Data)]);
    assert_eq!(mesh.report.warnings, []);
    document.json["materials"][0]["extensions"]["KHR_materials_sheen"] =
        json!({"sheenColorFactor": [1, 2]});
    let error = load_bytes(&document.glb(), &[]).expect_err("two numbers");
    assert!(error.to_string().contains("the colour of its sheen is not three numbers"), "{error}");
}

#[test]
fn brushed_materials_keep_their_wider_width() {
    let load_with = |material: Value| {
        let mut document = triangle();
        let image = document.view(&tiny_png());
        document.json["images"] = json!([{"bufferView": image, "mimeType": "image/png"}]);
        document.json["textures"] = json!([{"source": 0}]);
        document.json["extensionsRequired"] = json!(["KHR_materials_anisotropy"]);
        document.json["materials"] = json!([material]);
        document.json["meshes"][0]["primitives"][0]["material"] = json!(0);
        load(&document)
    };
    let brushed = |extension: Value, roughness: f64| {
        load_with(json!({"extensions": {"KHR_materials_anisotropy": extension},
            "pbrMetallicRoughness": {"roughnessFactor": roughness}}))
    };
    let mesh = brushed(json!({"anisotropyStrength": 0.5, "anisotropyRotation": 1.5}), 0.5);
    let steel = &mesh.materials[0];
    // alpha 1/4 across, 1/4 + 3/4 * 1/4 along.
    let aspect = (1.0 - 0.9 * steel.anisotropy).sqrt();
    let alpha = steel.roughness.powi(2);
    assert!(close(alpha * aspect, 0.25) && close(alpha / aspect, 0.4375), "{steel:?}");
    assert_eq!((steel.anisotropy_rotation, steel.anisotropy_map), (1.5, None));
    assert_eq!(mesh.report.warnings, []);
    let mesh = brushed(json!({"anisotropyStrength": 1, "anisotropyTexture": {"index": 0}}), 0.1);
    let steel = &mesh.materials[0];
    assert!(close(steel.anisotropy, 1.0) && close(steel.roughness.powi(4), 0.1), "{steel:?}");
    assert_eq!(steel.anisotropy_map.map(|map| map.space), Some(ColorSpace::Data));
    assert_eq!(mesh.report.warnings.len(), 2, "{:?}", mesh.report.warnings);
    let sheen = json!({"sheenColorFactor": [1, 1, 1], "sheenColorTexture": {"index": 0}});
    let mesh = load_with(json!({"pbrMetallicRoughness": {"roughnessFactor": 0.5}, "extensions":
        {"KHR_materials_sheen": sheen, "KHR_materials_anisotropy": {"anisotropyStrength": 0.5}}}));
    assert_eq!((mesh.materials[0].sheen, mesh.materials[0].sheen_map), ([0.0; 3], None));
    let message = "1 materials have sheen and are coated or brushed; their sheen is left out";
    assert_eq!(mesh.report.warnings[0].message, message);
    let plain = brushed(json!({"anisotropyRotation": 1}), 0.5);
    assert_eq!((plain.materials[0].anisotropy, plain.materials[0].roughness), (0.0, 0.5));
}

#[test]
fn a_thin_pane_is_no_glass() {
    let mut document = triangle();
    document.json["materials"] = json!([{"extensions": {
        "KHR_materials_transmission": {"transmissionFactor": 1},
        "KHR_materials_volume": {"thicknessFactor": 0}
    }, "pbrMetallicRoughness": {"metallicFactor": 0}}]);
    document.json["meshes"][0]["primitives"][0]["material"] = json!(0);
    let mesh = load(&document);
    assert!(!mesh.materials[0].is_glass() && mesh.materials[0].transmission > 0.0);
}

#[test]
fn a_clear_coat_that_is_not_gltf_is_an_error() {
    for (coat, expected) in [
        (json!({"clearcoatFactor": "much"}), "a factor of its clear coat is not a number"),
        (json!({"clearcoatTexture": 3}), "its clearcoatTexture is not glTF"),
        (json!({"clearcoatTexture": {"index": 7}}), "there is no texture 7"),
    ] {
        let mut document = triangle();
        document.json["materials"] = json!([{"extensions": {"KHR_materials_clearcoat": coat}}]);
        document.json["meshes"][0]["primitives"][0]["material"] = json!(0);
        let error = load_bytes(&document.glb(), &[]).expect_err(expected);
        assert!(error.to_string().contains(expected), "{error}");
    }
}

#[test]
fn opaque_ignores_alpha_and_blend_is_coverage() {
    for (mode, expected) in [("OPAQUE", (1.0, None)), ("BLEND", (0.5, None))] {
        let mut document = triangle();
        document.json["materials"] = json!([{"alphaMode": mode, "pbrMetallicRoughness": {"baseColorFactor": [1, 1, 1, 0.5]}}]);
        document.json["meshes"][0]["primitives"][0]["material"] = json!(0);
        let mesh = load(&document);
        let material = &mesh.materials[0];
        assert_eq!((material.alpha, material.alpha_clip), expected);
        assert_eq!(mesh.report.warnings, []);
    }
}

#[test]
fn buffers_come_from_data_uris_and_files() {
    use base64::Engine as _;
    let document = triangle();
    let text = base64::engine::general_purpose::STANDARD.encode(&document.binary);
    let mut json = document.json.clone();
    json["buffers"][0]["uri"] = json!(format!("data:application/octet-stream;base64,{text}"));
    let mesh = load_bytes(json.to_string().as_bytes(), &[]).expect("data URI");
    assert_eq!(soup(&mesh), soup(&load(&document)));
    json["buffers"][0]["uri"] = json!("my%20data.bin");
    let mesh = load_bytes(json.to_string().as_bytes(), &[("my data.bin", &document.binary)])
        .expect("file");
    assert_eq!(soup(&mesh), soup(&load(&document)));
    assert_eq!(mesh.report.files.len(), 2);
}

#[test]
fn required_extensions_are_refused_by_name() {
    let mut document = triangle();
    document.json["extensionsRequired"] = json!(["KHR_materials_ior", "KHR_meshopt_compression"]);
    let error = load_bytes(&document.glb(), &[]).expect_err("another meshopt");
    assert_eq!(error.kind, ErrorKind::Extension);
    let expected = "a.glb: the file requires KHR_meshopt_compression, which is not supported";
    assert_eq!(error.to_string(), expected);
    assert!(error.help.contains("gltf-transform copy"), "{}", error.help);
    // Also where the rest is not plain glTF: a buffer view without a buffer.
    document.json["extensionsRequired"] = json!(["EXT_without_buffers"]);
    document.json["bufferViews"][0] = json!({"extensions": {"EXT_without_buffers": {}}});
    let error = load_bytes(&document.glb(), &[]).expect_err("no buffer");
    assert_eq!(error.kind, ErrorKind::Extension);
}

#[test]
fn extensions_that_are_left_out_are_told_with_what_has_them() {
    let mut document = triangle();
    let iridescent = json!({"extensions": {"KHR_materials_iridescence": {"iridescenceFactor": 1},
        "KHR_materials_ior": {"ior": 1.25}}});
    let placed = json!({"index": 0, "extensions": {"EXT_elsewhere": {}}});
    let dispersive = json!({"extensions": {"KHR_materials_iridescence": {"iridescenceTexture": placed},
        "KHR_materials_dispersion": {"dispersion": 0.1}}, "extras": {"extensions": {"NOT_one": {}}}});
    document.json["materials"] = json!([iridescent, {}, dispersive]);
    document.json["nodes"][0]["extensions"] = json!({"EXT_elsewhere": {}});
    document.json["extensions"] = json!({"KHR_xmp_json_ld": {"packets": []}});
    document.json["extensionsUsed"] = json!([
        "KHR_materials_iridescence",
        "KHR_materials_ior",
        "KHR_materials_dispersion",
        "EXT_elsewhere",
        "KHR_xmp_json_ld",
        "EXT_of_nothing"
    ]);
    let warnings = load(&document).report.warnings;
    let messages: Vec<&str> = warnings.iter().map(|warning| warning.message.as_str()).collect();
    let expected = [
        "EXT_elsewhere is left out of 1 material and 1 node",
        "KHR_materials_dispersion is left out of 1 material",
        "KHR_materials_iridescence is left out of 2 materials",
        "KHR_xmp_json_ld is left out",
    ];
    assert_eq!(messages, expected);
}

#[test]
#[expect(clippy::too_many_lines, reason = "a table")]
fn bad_accessors_are_named() {
    type Change = fn(&mut Value);
    let cases: &[(Change, &str)] = &[
        (
            |json| json["accessors"][0]["count"] = json!(4),
            "accessor 0: 4 elements of 12 bytes, 12 apart, from byte 0 are not inside buffer view 0 of 36 bytes",
        ),
        (
            |json| json["accessors"][0]["count"] = json!(4_000_000_000_000_000_000_u64),
            "accessor 0: 4000000000000000000 elements are too many",
        ),
        (
            |json| json["accessors"][0]["byteOffset"] = json!(u64::MAX),
            "accessor 0: 3 elements of 12 bytes, 12 apart, from byte 18446744073709551615 are not inside buffer view 0 of 36 bytes",
        ),
        (
            |json| json["bufferViews"][0]["byteStride"] = json!(4),
            "accessor 0: stride 4 is less than the 12 bytes of an element",
        ),
        (
            |json| json["bufferViews"][0]["byteStride"] = json!(u64::MAX),
            "accessor 0: 3 elements of 12 bytes, 18446744073709551615 apart, from byte 0 are not inside buffer view 0 of 36 bytes",
        ),
        (
            |json| json["bufferViews"][0]["byteLength"] = json!(u64::MAX),
            "accessor 0: buffer view 0: 18446744073709551615 bytes from 0 are not inside buffer 0 of 104 bytes",
        ),
        (
            |json| json["bufferViews"][0]["buffer"] = json!(7),
            "accessor 0: buffer view 0: there are no bytes of buffer 7",
        ),
        (
            |json| json["accessors"][0]["bufferView"] = json!(70),
            "accessor 0: there is no buffer view 70",
        ),
        (
            |json| json["accessors"][0]["type"] = json!("VEC2"),
            "accessor 0: it has the type Vec2, expected Vec3",
        ),
        (
            |json| json["accessors"][0]["componentType"] = json!(5125),
            "accessor 0: 32-bit integers where floats are expected",
        ),
        (
            |json| json["accessors"][0]["componentType"] = json!(1),
            "accessor 0: its type or component type is not one of glTF",
        ),
        (
            |json| json["accessors"][3]["componentType"] = json!(5126),
            "accessor 3: indices must be unsigned integers",
        ),
        (
            |json| json["accessors"][0]["count"] = json!(2),
            "accessor 1: it has 3 elements, but there are 2 positions",
        ),
        (
            |json| json["accessors"][0]["count"] = json!(0),
            "accessor 1: it has 3 elements, but there are 0 positions",
        ),
        (
            |json| json["accessors"][3]["count"] = json!(2),
            "mesh 0 primitive 0: 2 indices do not make whole triangles",
        ),
        (
            |json| json["meshes"][0]["primitives"][0]["indices"] = json!(9),
            "accessor 9: there is no such accessor",
        ),
        (
            |json| json["meshes"][0]["primitives"][0]["attributes"] = json!({}),
            "mesh 0 primitive 0: it has no POSITION",
        ),
        (
            |json| json["meshes"][0]["primitives"][0]["mode"] = json!(9),
            "mesh 0 primitive 0: its mode is not one of glTF",
        ),
        (
            |json| json["meshes"][0]["primitives"][0]["material"] = json!(9),
            "material 9: there is no such material",
        ),
        (
            |json| {
                json["accessors"][0]["sparse"] = json!({"count": 9,
                "indices": {"bufferView": 0, "componentType": 5121}, "values": {"bufferView": 0}});
            },
            "accessor 0: 9 sparse values for 3 elements",
        ),
        (
            |json| {
                json["accessors"][0]["sparse"] = json!({"count": 1,
                "indices": {"bufferView": 0, "byteOffset": 14, "componentType": 5121}, "values": {"bufferView": 0}});
            },
            "accessor 0: sparse index 128, but there are 3 elements",
        ),
        (|json| json["nodes"][0]["mesh"] = json!(3), "node 0: its mesh does not exist"),
        (
            |json| json["nodes"][0]["children"] = json!([0]),
            "node 0: it is reached twice: the nodes do not form a tree",
        ),
        (|json| json["nodes"][0]["children"] = json!([5]), "node 5: there is no such node"),
        (
            |json| json["nodes"][0]["rotation"] = json!([0, 0, 0, 0]),
            "node 0: its transform is not a finite affine one",
        ),
        (|json| json["scene"] = json!(4), "scene 4: the default scene does not exist"),
        (
            |json| json["buffers"][0]["byteLength"] = json!(1000),
            "buffer 0: it says 1000 bytes, but there are only 104",
        ),
        (
            |json| json["buffers"][0]["uri"] = json!("https://example.org/a.bin"),
            "buffer 0: `https://example.org/a.bin` is a URL; only files beside the glTF file are read",
        ),
        (
            |json| json["buffers"][0]["uri"] = json!("/etc/passwd"),
            "buffer 0: `/etc/passwd` is an absolute path; it must be relative to the file",
        ),
        (
            |json| json["buffers"][0]["uri"] = json!("data:;base64,@@@@"),
            "buffer 0: broken base64: Invalid symbol 64, offset 0.",
        ),
    ];
    for (change, expected) in cases {
        check_error(change, &format!("a.glb: {expected}"));
    }
}

#[test]
fn numbers_that_are_not_finite_are_named() {
    let mut document = Builder::default();
    let positions = document.floats(&[[0.0; 3], [1.0, f32::NAN, 0.0], [0.0, 1.0, 0.0]], "VEC3");
    document.mesh(&json!({"attributes": {"POSITION": positions}}));
    let error = load_bytes(&document.glb(), &[]).expect_err("NaN");
    assert_eq!(
        (error.kind, error.to_string().as_str()),
        (ErrorKind::Number, "a.glb: accessor 0: element 1 is not finite")
    );

    let mut document = triangle();
    document.json["nodes"] =
        json!([{"mesh": 0, "scale": [3e38, 1, 1], "translation": [3e38, 0, 0]}]);
    let error = load_bytes(&document.glb(), &[]).expect_err("overflow");
    assert_eq!(
        error.to_string(),
        "a.glb: mesh 0 primitive 0: vertex 1 is infinite where node `node 0` places it"
    );

    let mut document = Builder::default();
    let positions = document.floats(&[[0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]], "VEC3");
    let indices = document.indices(&[0, 1, 3]);
    document.mesh(&json!({"attributes": {"POSITION": positions}, "indices": indices}));
    let error = load_bytes(&document.glb(), &[]).expect_err("index");
    assert_eq!(error.to_string(), "a.glb: accessor 1: element 2 is 3, but there are 3 vertices");
}

#[test]
fn zero_area_and_zero_normals_are_counted() {
    let mut document = Builder::default();
    let positions =
        document.floats(&[[0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [2.0, 0.0, 0.0]], "VEC3");
    let normals = document.floats(&[[0.0_f32; 3]; 4], "VEC3");
    let indices = document.indices(&[0, 1, 2, 0, 1, 3]);
    document.mesh(
        &json!({"attributes": {"POSITION": positions, "NORMAL": normals}, "indices": indices}),
    );
    let mesh = load(&document);
    assert_eq!(
        (mesh.report.n_triangles, mesh.report.zero_area.count, mesh.report.zero_normals.count),
        (1, 1, 3)
    );
    let first = mesh.report.zero_area.first.expect("place");
    assert!(first.ends_with("a.glb: mesh 0 primitive 0 triangle 1"), "{first}");
    assert_eq!(mesh.parts[0].corner_normals(0), Some([[0.0, 0.0, 1.0]; 3]));
}

#[test]
fn broken_containers_are_one_clear_line() {
    let whole = triangle().glb();
    let error = |bytes: &[u8]| load_bytes(bytes, &[]).expect_err("broken").to_string();
    assert_eq!(error(b"glTF"), "a.glb: the GLB header is cut off");
    assert_eq!(
        error(b"hello"),
        "a.glb: this is neither a GLB file nor the JSON text of a glTF file"
    );
    assert!(error(b"{").starts_with("a.glb: the JSON is cut off: EOF while parsing"));
    assert!(error(b"{}").starts_with("a.glb: the JSON is not glTF: missing field `asset`"));
    let expected = format!(
        "a.glb: the file is cut off: its header says {0} bytes, it has {1}",
        whole.len(),
        whole.len() - 1
    );
    assert_eq!(error(&whole[..whole.len() - 1]), expected);
    let mut old = whole.clone();
    old[4] = 1;
    assert_eq!(error(&old), "a.glb: this is GLB version 1, only 2 is read");
    let mut long = whole.clone();
    long[15] = 0x7f;
    assert!(error(&long).starts_with("a.glb: the chunk at byte 12 has "));
    assert_eq!(error(&glb(None, &[])), "a.glb: the GLB file has no JSON chunk");
    let mut document = triangle();
    document.json["asset"]["version"] = json!("1.0");
    assert_eq!(error(&document.glb()), "a.glb: this is glTF 1.0, only 2.x is read");
    document.json["asset"]["version"] = json!("2.0");
    document.json["nodes"] = json!([]);
    document.json["scenes"] = json!([{"nodes": []}]);
    assert_eq!(error(&document.glb()), "a.glb: the scene of this file has no triangles");
}

#[test]
fn deep_and_repeated_meshes_stay_within_limits() {
    let mut document = triangle();
    let chain: Vec<Value> =
        (0..1000).map(|i| json!({"children": [i + 1]})).chain([json!({"mesh": 0})]).collect();
    document.json["nodes"] = Value::from(chain);
    let error = load_bytes(&document.glb(), &[]).expect_err("deep");
    assert_eq!(error.to_string(), "a.glb: node 256: it is nested more than 256 levels deep");

    let copies: Vec<Value> = (0..5).map(|i| json!({"mesh": 0, "translation": [i, 0, 0]})).collect();
    let mut document = triangle();
    document.json["nodes"] = Value::from(copies);
    document.json["scenes"][0]["nodes"] = json!([0, 1, 2, 3, 4]);
    assert_eq!(load(&document).report.n_triangles, 5);
    let folder = TempDir::new().expect("temporary folder");
    let path = folder.path().join("a.glb");
    fs::write(&path, document.glb()).expect("write");
    let limits = Limits { triangles: 4, ..Limits::default() };
    let error = load_gltf(&path, &GltfChoice::default(), &limits).expect_err("limit");
    assert_eq!(error.kind, ErrorKind::Limit);
}

#[test]
fn required_lights_load_and_lights_and_cameras_are_known_where_nodes_place_them() {
    let mut document = triangle();
    document.json["extensionsUsed"] = json!(["KHR_lights_punctual"]);
    document.json["extensionsRequired"] = json!(["KHR_lights_punctual"]);
    document.json["extensions"] = json!({"KHR_lights_punctual": {"lights": [
        {"type": "point", "name": "own name", "intensity": 683.0},
        {"type": "spot", "color": [1, 0.5, 0], "spot": {"outerConeAngle": 0.5}},
        {"type": "directional"},
    ]}});
    document.json["cameras"] = json!([
        {"type": "perspective", "perspective": {"yfov": 0.5, "znear": 0.1}},
        {"type": "orthographic",
         "orthographic": {"xmag": 2, "ymag": 1.5, "zfar": 9, "znear": 0}},
    ]);
    let of = |light: usize| json!({"KHR_lights_punctual": {"light": light}});
    document.json["nodes"] = json!([
        {"mesh": 0},
        {"name": "up here", "translation": [0, 2, 0], "children": [2, 3]},
        {"translation": [1, 0, 0], "extensions": of(0), "camera": 1},
        {"name": "Key", "rotation": [-std::f32::consts::FRAC_1_SQRT_2, 0, 0, std::f32::consts::FRAC_1_SQRT_2], "extensions": of(1)},
        {"extensions": of(2), "camera": 0},
    ]);
    document.json["scenes"] = json!([{"nodes": [0, 1, 4]}]);
    let mesh = load(&document);
    let [point, spot, sun] = mesh.studio.lights.as_slice() else { panic!("three lights") };
    assert_eq!(
        (point.name.as_str(), point.kind, point.at),
        ("own name", LightKind::Point, [1.0, 2.0, 0.0])
    );
    assert_eq!((point.color, point.intensity), ([1.0; 3], 683.0));
    assert_eq!(
        (spot.name.as_str(), spot.kind),
        ("Key", LightKind::Spot { inner: 0.0, outer: 0.5 })
    );
    assert!(spot.along[1] < -0.999_999, "turned down: {:?}", spot.along);
    assert_eq!((sun.kind, sun.along), (LightKind::Directional, [0.0, 0.0, -1.0]));
    let [plan, camera] = mesh.studio.cameras.as_slice() else { panic!("two cameras") };
    assert_eq!(
        (camera.view, camera.from, camera.up),
        (FileView::Perspective(0.5), [0.0; 3], [0.0, 1.0, 0.0])
    );
    assert_eq!((plan.view, plan.from), (FileView::Orthographic(3.0), [1.0, 2.0, 0.0]));
    let said: Vec<&str> = mesh.report.warnings.iter().map(|w| w.message.as_str()).collect();
    let left_out = "3 lights and 2 cameras are left out: `rtc show --assets` prints them as text for the scene";
    assert_eq!(said, [left_out]);
    let wrong: [(&str, &str); 4] = [
        (
            r#"{"type": "point", "intensity": -1}"#,
            "a.glb: light 0: its colour, intensity or angles are negative or not finite",
        ),
        (
            r#"{"type": "point", "intensity": 1e39}"#,
            "a.glb: light 0: its colour, intensity or angles are negative or not finite",
        ),
        (r#"{"type": "area"}"#, "a.glb: light 0: its type is not directional, point or spot"),
        ("", "a.glb: light 0: there is no such light"),
    ];
    for (light, expected) in wrong {
        let lights: Value = serde_json::from_str(&format!("[{light}]")).expect("JSON");
        document.json["extensions"]["KHR_lights_punctual"]["lights"] = lights;
        let error = load_bytes(&document.glb(), &[]).expect_err(expected).to_string();
        assert_eq!(error, expected);
    }
}

#[test]
fn vertex_colours_multiply_the_base_colour_where_the_material_has_no_images() {
    for (kind, has_image) in [("VEC3", false), ("VEC4", false), ("VEC3", true)] {
        let mut document = triangle();
        let colors = match kind {
            "VEC3" => document.floats(&[[1.0, 0.0, 0.5], [0.0, 1.0, 0.5], [0.0, 0.0, 0.5]], kind),
            _ => document
                .floats(&[[1.0, 0.0, 0.5, 1.0], [0.0, 1.0, 0.5, 0.0], [0.0, 0.0, 0.5, 1.0]], kind),
        };
        document.json["meshes"][0]["primitives"][0]["attributes"]["COLOR_0"] = json!(colors);
        document.json["meshes"][0]["primitives"][0]["material"] = json!(0);
        let mut material =
            json!({"name": "m", "pbrMetallicRoughness": {"baseColorFactor": [0.5, 1, 1, 1]}});
        if has_image {
            let png = document.view(&tiny_png());
            document.json["images"] = json!([{"bufferView": png, "mimeType": "image/png"}]);
            document.json["textures"] = json!([{"source": 0}]);
            material["pbrMetallicRoughness"]["baseColorTexture"] = json!({"index": 0});
        }
        document.json["materials"] = json!([material]);
        let mesh = load(&document);
        let part = &mesh.parts[0];
        let found = &mesh.materials[part.material.expect("a material") as usize];
        assert_eq!((found.name.as_str(), found.color), ("m", [0.5, 1.0, 1.0]));
        let said: Vec<&str> = mesh.report.warnings.iter().map(|w| w.message.as_str()).collect();
        if has_image {
            assert_eq!(said, ["1 part has vertex colours beside images: the colours are not used"]);
            assert_eq!((part.paint, mesh.images.len()), (None, 1));
            continue;
        }
        assert!(said.is_empty(), "{said:?}");
        let map = found.color_map.expect("the colours");
        assert_eq!((map.space, map.wrap), (ColorSpace::Linear, [Wrap::Clamp; 2]));
        let image = &mesh.images[map.image as usize].image;
        assert_eq!([image.width, image.height], [2, 2]);
        assert_eq!(part.corner_uvs_for(true, 0), Some([[0.25, 0.75], [0.75, 0.75], [0.25, 0.25]]));
        assert_eq!(part.corner_uvs_for(false, 0), Some([[0.0, 1.0], [1.0, 1.0], [0.0, 0.0]]));
    }
}

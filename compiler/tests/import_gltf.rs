//! glTF and GLB: the scene graph, accessors, extensions, lights and cameras.

#![expect(clippy::float_cmp, reason = "these numbers are exact")]

#[path = "import_gltf/compressed.rs"]
mod compressed;
#[path = "import_gltf/extensions.rs"]
mod extensions;
mod import_support;
#[path = "import_gltf/materials.rs"]
mod materials;
#[path = "import_gltf/refusals.rs"]
mod refusals;

use compiler::import::{
    ErrorKind, FileView, ImportError, LightKind, Limits, MeshFile, load_gltf, read_gltf, topology,
};
use import_support::{Builder, triangle};
use lang::scene::GltfChoice;
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
    assert_eq!(mesh.report.warnings[0].message, "points and lines are left out (1 primitive)");
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
    assert!(said.is_empty(), "{said:?}");
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

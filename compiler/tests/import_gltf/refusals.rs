//! Files that are wrong or beyond the limits: one clear line each.

use super::import_support::{Builder, glb, triangle};
use super::{check_error, load, load_bytes};
use compiler::import::{ErrorKind, Limits, load_gltf};
use lang::scene::GltfChoice;
use serde_json::{Value, json};
use std::fs;
use tempfile::TempDir;

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

//! Meshes in Draco and textures in KTX2: the files beside this one, which `make.mjs` makes with other people's encoders,
//! hold what their formulas say; damaged ones are refused in a line.

use super::import_support::{Builder, glb, triangle};
use super::{load, load_bytes};
use compiler::import::{Attribute, ErrorKind, Image, Limits, MeshFile, Pixels, decode_image};
use serde_json::{Value, json};
use std::f64::consts::TAU;

const EDGEBREAKER: &[u8] = include_bytes!("edgebreaker.glb");
const SEQUENTIAL: &[u8] = include_bytes!("sequential.glb");
const ETC1S: &[u8] = include_bytes!("etc1s.ktx2");
const ETC1S_ALPHA: &[u8] = include_bytes!("etc1s-alpha.ktx2");
const UASTC: &[u8] = include_bytes!("uastc.ktx2");
const UASTC_ZSTD: &[u8] = include_bytes!("uastc-zstd.ktx2");

/// The document and the buffer of a GLB file.
fn split(file: &[u8]) -> Builder {
    let word = |at: usize| u32::from_le_bytes(file[at..at + 4].try_into().expect("four bytes"));
    let end = 20 + usize::try_from(word(12)).expect("small");
    let json = serde_json::from_slice(&file[20..end]).expect("JSON");
    Builder { json, binary: file[end + 8..].to_vec() }
}

/// Position and normal of the torus of `make.mjs` at its UVs.
fn torus([u, v]: [f64; 2]) -> ([f64; 3], [f64; 3]) {
    let ((sin_a, cos_a), (sin_b, cos_b)) = ((TAU * u).sin_cos(), (TAU * v).sin_cos());
    let far = 2.0 + cos_b;
    ([far * cos_a, far * sin_a, sin_b], [cos_b * cos_a, cos_b * sin_a, sin_b])
}

fn check_torus(mesh: &MeshFile) {
    let [part] = &mesh.parts[..] else { panic!("{} parts", mesh.parts.len()) };
    assert_eq!((part.triangles.len(), mesh.report.warnings.len()), (192, 0));
    let mut area = 0.0;
    for triangle in 0..part.triangles.len() {
        let corners = part.corners(triangle).map(|p| p.map(f64::from));
        let normals = part.corner_normals(triangle).expect("normals");
        let uvs = part.corner_uvs(triangle).expect("UVs");
        for i in 0..3 {
            let [u, v] = uvs[i].map(f64::from);
            // Twelve bits of UVs, fourteen of positions over a width of 6, ten of normals.
            let (position, normal) = torus([u, 1.0 - v]);
            for axis in 0..3 {
                assert!((corners[i][axis] - position[axis]).abs() < 0.004, "{corners:?} {uvs:?}");
                assert!((f64::from(normals[i][axis]) - normal[axis]).abs() < 0.01, "{normals:?}");
            }
        }
        let [a, b, c] = corners;
        let edge = |p: [f64; 3], q: [f64; 3]| [q[0] - p[0], q[1] - p[1], q[2] - p[2]];
        let ([x, y, z], [k, l, m]) = (edge(a, b), edge(a, c));
        let cross = [y * m - z * l, z * k - x * m, x * l - y * k];
        area += 0.5 * cross.iter().map(|x| x * x).sum::<f64>().sqrt();
    }
    // Of 12 x 8 pairs of triangles: within a tenth of the area of the torus, 8 pi^2.
    let whole = 2.0 * TAU * TAU;
    assert!(area > 0.9 * whole && area < whole, "{area} of {whole}");
    assert!(matches!(&part.uvs, Attribute::PerVertex(uvs) if uvs.len() == 117), "no vertex twice");
}

#[test]
fn meshes_in_draco_are_those_that_were_compressed() {
    for file in [EDGEBREAKER, SEQUENTIAL] {
        check_torus(&load_bytes(file, &[]).expect("a good file"));
    }
    // Twice in one file: decoded once, and there twice.
    let mut document = split(EDGEBREAKER);
    let primitive = document.json["meshes"][0]["primitives"][0].clone();
    document.json["meshes"][0]["primitives"] = json!([primitive, primitive]);
    assert_eq!(load(&document).report.n_triangles, 384);
}

/// The error of a changed file must be exactly `expected`.
fn check(change: impl FnOnce(&mut Value), kind: ErrorKind, expected: &str) {
    let mut document = split(EDGEBREAKER);
    change(&mut document.json);
    let error = load_bytes(&document.glb(), &[]).expect_err(expected);
    assert_eq!((error.kind, error.to_string()), (kind, format!("a.glb: {expected}")));
}

fn extension(json: &mut Value) -> &mut Value {
    &mut json["meshes"][0]["primitives"][0]["extensions"]["KHR_draco_mesh_compression"]
}

#[test]
fn draco_that_is_not_what_the_file_says_is_an_error() {
    use ErrorKind::{Accessor, Extension, Format};
    let wrong = "mesh 0 primitive 0: it is not what KHR_draco_mesh_compression says";
    check(|json| *extension(json) = json!({}), Format, wrong);
    check(|json| extension(json)["attributes"] = json!(7), Format, wrong);
    check(|json| extension(json)["attributes"]["NORMAL"] = json!(-1), Format, wrong);
    let no_view = "mesh 0 primitive 0: there is no buffer view 9";
    check(|json| extension(json)["bufferView"] = json!(9), Accessor, no_view);
    let none = "mesh 0 primitive 0: its compressed bytes have no attribute 9";
    check(|json| extension(json)["attributes"]["NORMAL"] = json!(9), Accessor, none);
    let kind = "accessor 3: its type is not that of its compressed bytes, 3 x Float32";
    check(|json| extension(json)["attributes"]["TEXCOORD_0"] = json!(1), Accessor, kind);
    let count = "accessor 1: it has 118 elements, and its compressed bytes hold 117";
    check(|json| json["accessors"][1]["count"] = json!(118), Accessor, count);
    let more = "mesh 0 primitive 0: its compressed bytes hold more than its accessors say";
    check(|json| json["accessors"][0]["count"] = json!(573), Accessor, more);
    let mode = "mesh 0 primitive 0: of meshes in Draco only lists of triangles are read";
    check(|json| json["meshes"][0]["primitives"][0]["mode"] = json!(5), Extension, mode);
    let indices = "mesh 0 primitive 0: it has no indices";
    let remove = |json: &mut Value| {
        let primitive = json["meshes"][0]["primitives"][0].as_object_mut().expect("a primitive");
        primitive.remove("indices");
    };
    check(remove, Format, indices);
    let limit = "its meshes have 1431655765 triangles, the limit is 134217728";
    check(|json| json["accessors"][0]["count"] = json!(u32::MAX), ErrorKind::Limit, limit);
    // An accessor of indices that is asked for as if it held triples.
    let asked = |json: &mut Value| {
        json["accessors"][0]["type"] = json!("VEC3");
        json["meshes"][0]["primitives"][0]["attributes"]["NORMAL"] = json!(0);
        extension(json)["attributes"].as_object_mut().expect("a list").remove("NORMAL");
        json["accessors"][0]["componentType"] = json!(5126);
    };
    check(asked, Accessor, "accessor 0: its compressed elements are not of its type");
    let missing = |json: &mut Value| json["accessors"] = json!([]);
    check(missing, Accessor, "accessor 0: there is no such accessor");
}

/// Every cut and every flipped bit of a stream, and its bytes replaced by others.
fn damaged(bytes: &[u8], mut each: impl FnMut(&[u8])) {
    for end in 0..bytes.len() {
        each(&bytes[..end]);
        let mut changed = bytes.to_vec();
        for bit in 0..8 {
            changed[end] ^= 1 << bit;
            each(&changed);
            changed[end] ^= 1 << bit;
        }
        changed[end] = 0xff;
        each(&changed);
        let last = (end + 4).min(bytes.len());
        changed[end..last].fill(0xff);
        each(&changed);
    }
}

#[test]
fn damaged_draco_is_refused_in_a_line_or_read() {
    for file in [EDGEBREAKER, SEQUENTIAL] {
        let document = split(file);
        let json = document.json.to_string();
        let (mut refused, mut read) = (0, 0);
        damaged(&document.binary, |binary| {
            let mut padded = binary.to_vec();
            padded.resize(document.binary.len(), 0);
            match super::read_bytes(&glb(Some(json.as_bytes()), &padded)) {
                Ok(_) => read += 1,
                Err(error) => {
                    refused += 1;
                    let text = error.to_string();
                    assert!(!text.contains("gave up") && !text.contains('\n'), "{text}");
                }
            }
        });
        assert!(refused > 1000 && read > 100, "{refused} refused, {read} read");
    }
}

/// Texels that are at most `off` away from those of `make.mjs`.
fn check_picture(image: &Image, off: u8, alpha: bool) {
    assert_eq!((image.width, image.height, image.has_alpha), (18, 10, alpha));
    let Pixels::Rgba8(texels) = &image.data else { panic!("8 bits") };
    for (index, texel) in (0_u8..).zip(texels.chunks_exact(4)) {
        let (x, y) = (index % 18, index / 18);
        let light = 8 * x + 6 * y;
        let a = if alpha && x < 9 { 128 } else { 255 };
        for (found, expected) in texel.iter().zip([40 + light, 60 + light, 20 + light, a]) {
            assert!(found.abs_diff(expected) <= off, "({x}, {y}): {texel:?}, {expected} expected");
        }
    }
}

fn decode(bytes: &[u8]) -> Result<Image, String> {
    decode_image(bytes, "a.ktx2", &Limits::default()).map_err(|error| error.to_string())
}

#[test]
fn textures_in_ktx2_are_the_pictures_that_were_compressed() {
    check_picture(&decode(ETC1S).expect("good"), 14, false);
    check_picture(&decode(ETC1S_ALPHA).expect("good"), 14, true);
    check_picture(&decode(UASTC).expect("good"), 4, false);
    check_picture(&decode(UASTC_ZSTD).expect("good"), 8, true);
    let mut document = triangle();
    let ktx2 = document.view(UASTC);
    document.json["images"] = json!([{"bufferView": ktx2, "mimeType": "image/ktx2"}]);
    document.json["textures"] = json!([{"extensions": {"KHR_texture_basisu": {"source": 0}}}]);
    document.json["extensionsRequired"] = json!(["KHR_texture_basisu"]);
    document.json["materials"] =
        json!([{"pbrMetallicRoughness": {"baseColorTexture": {"index": 0}}}]);
    document.json["meshes"][0]["primitives"][0]["material"] = json!(0);
    check_picture(&load(&document).images[0].image, 4, false);
    document.json["textures"] = json!([{"extensions": {"KHR_texture_basisu": {"source": true}}}]);
    let error = load_bytes(&document.glb(), &[]).expect_err("a truth as an index");
    assert!(error.to_string().ends_with("is not what KHR_texture_basisu says"), "{error}");
}

#[test]
fn other_ktx2_and_false_claims_are_errors() {
    let check = |at: usize, value: &[u8], expected: &str| {
        let mut bytes = UASTC_ZSTD.to_vec();
        bytes[at..at + value.len()].copy_from_slice(value);
        assert_eq!(decode(&bytes).expect_err(expected), format!("a.ktx2: {expected}"));
    };
    let foreign =
        "this KTX2 image has texels of the Vulkan format 37; those of Basis Universal are read";
    check(12, &[37], foreign);
    let layers = "this KTX2 image has layers, faces or depth; those of Basis Universal are read";
    check(28, &[1], layers);
    check(32, &[2], layers);
    check(36, &[6], layers);
    check(20, &[0], "the image has no pixels");
    let limit = "the image claims 4294967295 x 10 pixels, the limit is 268435456";
    check(20, &[255; 4], limit);
    let outside = "the image is damaged or cut off: its parts are not inside it";
    check(80, &[255; 8], outside);
    check(88, &[255; 4], outside);
    check(48, &[255; 4], outside);
    check(64, &[255; 8], outside);
    let length =
        "the image is damaged or cut off: its largest level has not the length of its size";
    check(96, &[255; 8], length);
    let inflated = "the image is damaged or cut off: its largest level cannot be inflated";
    check(88, &[9, 0], inflated);
    let head = "a.ktx2: the image is damaged or cut off: it ends in its header";
    assert_eq!(decode(&UASTC[..90]).expect_err(head), head);
    let old = decode(b"\xabKTX 11\xbb\r\n\x1a\n").expect_err("another format");
    assert!(old.starts_with("a.ktx2: this is a KTX 1 image;"), "{old}");
}

/// A frame of Zstandard that would become two gigabytes is left after what the texture has.
#[test]
fn a_frame_that_grows_without_end_is_refused() {
    let mut frame = vec![0x28, 0xb5, 0x2f, 0xfd, 0, 0x58];
    for _ in 0..16_000 {
        // A block of 128 KiB of one byte, not the last.
        frame.extend([0x02, 0x00, 0x10, 7]);
    }
    let mut bytes = UASTC_ZSTD.to_vec();
    let (offset, length) = (bytes.len() as u64, frame.len() as u64);
    bytes[80..88].copy_from_slice(&offset.to_le_bytes());
    bytes[88..96].copy_from_slice(&length.to_le_bytes());
    bytes.extend(frame);
    let expected = "a.ktx2: the image is damaged or cut off: its largest level cannot be inflated";
    assert_eq!(decode(&bytes).expect_err(expected), expected);
}

#[test]
fn damaged_ktx2_is_refused_in_a_line_or_read() {
    let small = Limits { pixels: 1 << 16, ..Limits::default() };
    for file in [ETC1S, ETC1S_ALPHA, UASTC, UASTC_ZSTD] {
        let (mut refused, mut read) = (0, 0);
        damaged(file, |bytes| match decode_image(bytes, "a", &small) {
            Ok(_) => read += 1,
            Err(error) => {
                refused += 1;
                let text = error.to_string();
                assert!(!text.contains("gave up") && !text.contains('\n'), "{text}");
            }
        });
        assert!(refused > 500 && read > 100, "{refused} refused, {read} read");
    }
}

//! Damaged files never make an importer panic, hang or take memory without limit.
//!
//! Files of each format are damaged at random, with a fixed seed: bytes changed, cut out, repeated,
//! swapped for interesting numbers. Whatever comes back must be a result; a panic inside a decoder,
//! which is caught, is allowed only where it is known.

#![expect(clippy::cast_possible_truncation, reason = "random bits")]

mod import_support;

use compiler::import::{Budget, ImportError, Limits, MeshFile, decode_image, read_gltf, read_obj};
use compiler::input::Root;
use import_support::{Builder, compressed_triangle, tiny_png, triangle};
use lang::scene::{Axis, GltfChoice};
use serde_json::json;
use std::fs;
use std::path::Path;
use tempfile::TempDir;

/// Small, so that a damaged header cannot make the test slow.
const LIMITS: Limits = Limits {
    file_bytes: 1 << 20,
    triangles: 1 << 16,
    pixels: 1 << 16,
    total_pixels: 1 << 18,
    memory: Budget::UNLIMITED,
    root: Root::ANYWHERE,
};

/// Xorshift64*, Vigna 2016.
struct Random(u64);

impl Random {
    fn next(&mut self) -> u64 {
        self.0 ^= self.0 >> 12;
        self.0 ^= self.0 << 25;
        self.0 ^= self.0 >> 27;
        self.0.wrapping_mul(0x2545_f491_4f6c_dd1d) >> 16
    }

    /// In `0..n`; 0 when `n` is 0.
    fn below(&mut self, n: usize) -> usize {
        (self.next() % n.max(1) as u64) as usize
    }

    fn damage(&mut self, bytes: &mut Vec<u8>) {
        const WORDS: [u32; 6] = [0, 1, u32::MAX, 0x7fff_ffff, 0x8000_0000, 0x7fc0_0000];
        for _ in 0..=self.below(4) {
            let at = self.below(bytes.len());
            match self.below(6) {
                0 => bytes[at] ^= 1 << self.below(8),
                1 => bytes[at] = self.next() as u8,
                2 => {
                    let word = WORDS[self.below(WORDS.len())].to_le_bytes();
                    let end = bytes.len().min(at + 4);
                    bytes[at..end].copy_from_slice(&word[..end - at]);
                }
                3 => bytes.truncate(at.max(1)),
                4 => {
                    let end = bytes.len().min(at + self.below(32));
                    let piece = bytes[at..end].to_vec();
                    let to = self.below(bytes.len());
                    bytes.splice(to..to, piece);
                }
                _ => {
                    let end = bytes.len().min(at + self.below(8));
                    bytes.drain(at..end);
                    if bytes.is_empty() {
                        bytes.push(0);
                    }
                }
            }
        }
    }

    /// Replaces a number of a text, or repeats or drops one of its words.
    fn damage_text(&mut self, bytes: &mut Vec<u8>) {
        const NUMBERS: [&str; 10] = [
            "0",
            "-1",
            "1e38",
            "1e-45",
            "nan",
            "4294967296",
            "-9223372036854775808",
            "1e400",
            "",
            "7/",
        ];
        let text = String::from_utf8_lossy(bytes).into_owned();
        let mut words: Vec<&str> = text.split_inclusive([' ', '\n', ',', '/']).collect();
        let at = self.below(words.len());
        let number = format!("{} ", NUMBERS[self.below(NUMBERS.len())]);
        match self.below(4) {
            0 => words.insert(at, words[at]),
            1 => drop(words.remove(at)),
            2 => words.swap(at, 0),
            _ => words[at] = &number,
        }
        *bytes = words.concat().into_bytes();
    }
}

/// Damages `seeds` `n` times and hands each result to `load`; returns how many were still good.
fn damage_and_load<T>(
    n: usize,
    seeds: &[Vec<u8>],
    name: &str,
    repair: fn(&mut [u8]),
    load: impl Fn(&[u8], &Path) -> Result<T, ImportError>,
) -> usize {
    let path = Path::new(name);
    let mut random = Random(0x9e37_79b9_7f4a_7c15);
    let mut n_good = 0;
    for i in 0..n {
        let mut bytes = seeds[i % seeds.len()].clone();
        if bytes.is_ascii() && random.below(2) == 0 {
            random.damage_text(&mut bytes);
        } else {
            random.damage(&mut bytes);
        }
        if random.below(2) == 0 {
            repair(&mut bytes);
        }
        match load(&bytes, path) {
            Ok(_) => n_good += 1,
            Err(error) => {
                let text = error.to_string();
                let panicked = text.contains("gave up");
                // The B44 decoder of `exr` 1.74 subtracts without a check.
                let known = name == "a.exr";
                assert!(!panicked || known, "a decoder panicked on file {i}: {bytes:?}");
                assert!(!text.contains('\n') && text.len() < 1000, "{text}");
            }
        }
    }
    n_good
}

fn keep(_: &mut [u8]) {}

fn noise(n: usize) -> Vec<u8> {
    let mut random = Random(7);
    (0..n).map(|_| random.next() as u8).collect()
}

/// Everything that came out must be usable without a check.
fn check_mesh(mesh: &MeshFile) {
    for part in &mesh.parts {
        assert!(part.material.is_none_or(|m| (m as usize) < mesh.materials.len()));
        for tri in 0..part.triangles.len() {
            assert!(part.corners(tri).iter().flatten().all(|x| x.is_finite()));
            let normals = part.corner_normals(tri).unwrap_or([[1.0, 0.0, 0.0]; 3]);
            for n in normals {
                let length2 = n.iter().map(|x| x * x).sum::<f32>();
                assert!((length2 - 1.0).abs() < 1e-4, "{n:?}");
            }
            assert!(
                part.corner_uvs(tri).unwrap_or_default().iter().flatten().all(|x| x.is_finite())
            );
        }
    }
    for material in &mesh.materials {
        let maps = [material.color_map, material.emission_map, material.alpha_map];
        assert!(maps.iter().flatten().all(|map| (map.image as usize) < mesh.images.len()));
    }
}

#[test]
fn damaged_png() {
    let rgba = |size: u32, color: image::ExtendedColorType| {
        let mut out = Vec::new();
        let encoder = image::codecs::png::PngEncoder::new(&mut out);
        let bytes = noise(size as usize * size as usize * 8);
        let bytes = if color == image::ExtendedColorType::Rgba16 {
            &bytes[..]
        } else {
            &bytes[..bytes.len() / 8]
        };
        image::ImageEncoder::write_image(encoder, bytes, size, size, color).expect("encode");
        out
    };
    let seeds = [
        rgba(9, image::ExtendedColorType::L8),
        rgba(5, image::ExtendedColorType::Rgba16),
        tiny_png(),
    ];
    damage_and_load(6000, &seeds, "a.png", repair_png, |bytes, _| {
        decode_image(bytes, "a", &LIMITS)
    });
}

/// Recomputes the checksums, so that damage reaches the decoder behind them.
fn repair_png(bytes: &mut [u8]) {
    let mut at = 8;
    while let Some(length) = bytes.get(at..at + 4) {
        let length = u32::from_be_bytes(length.try_into().expect("four bytes")) as usize;
        let end = at + 8 + length;
        if end + 4 > bytes.len() {
            return;
        }
        let step = |crc: u32, byte: &u8| {
            (0..8).fold(crc ^ u32::from(*byte), |c, _| {
                if c & 1 == 1 { (c >> 1) ^ 0xedb8_8320 } else { c >> 1 }
            })
        };
        let crc = !bytes[at + 4..end].iter().fold(u32::MAX, step);
        bytes[end..end + 4].copy_from_slice(&crc.to_be_bytes());
        at = end + 4;
    }
}

#[test]
fn damaged_webp() {
    let mut color = Vec::new();
    image::codecs::webp::WebPEncoder::new_lossless(&mut color)
        .encode(&noise(17 * 13 * 4), 17, 13, image::ExtendedColorType::Rgba8)
        .expect("encode");
    let mut gray = Vec::new();
    image::codecs::webp::WebPEncoder::new_lossless(&mut gray)
        .encode(&noise(64), 8, 8, image::ExtendedColorType::L8)
        .expect("encode");
    damage_and_load(4000, &[color, gray], "a.webp", keep, |bytes, _| {
        decode_image(bytes, "a", &LIMITS)
    });
}

#[test]
fn damaged_jpeg() {
    let mut color = Vec::new();
    image::ImageEncoder::write_image(
        image::codecs::jpeg::JpegEncoder::new(&mut color),
        &noise(17 * 13 * 3),
        17,
        13,
        image::ExtendedColorType::Rgb8,
    )
    .expect("encode");
    let mut gray = Vec::new();
    image::ImageEncoder::write_image(
        image::codecs::jpeg::JpegEncoder::new(&mut gray),
        &noise(64),
        8,
        8,
        image::ExtendedColorType::L8,
    )
    .expect("encode");
    let n_good = damage_and_load(5000, &[color, gray], "a.jpg", keep, |bytes, _| {
        decode_image(bytes, "a", &LIMITS)
    });
    assert!(n_good > 100, "most damage of JPEG data is not seen by its decoder: {n_good}");
}

#[test]
fn damaged_hdr() {
    let pixels: Vec<image::Rgb<f32>> = noise(16 * 9 * 3)
        .chunks(3)
        .map(|c| image::Rgb([c[0], c[1] / 64, 3].map(f32::from)))
        .collect();
    let mut out = Vec::new();
    image::codecs::hdr::HdrEncoder::new(&mut out).encode(&pixels, 16, 9).expect("encode");
    damage_and_load(6000, &[out], "a.hdr", keep, |bytes, _| decode_image(bytes, "a", &LIMITS));
}

#[test]
fn damaged_exr() {
    use exr::prelude::*;
    let write = |encoding: Encoding| {
        let channels = SpecificChannels::rgba(|at: Vec2<usize>| {
            (at.x() as f32, at.y() as f32, 0.5_f32, f16::from_f32(0.5))
        });
        let layer = Layer::new((20, 18), LayerAttributes::named("main"), encoding, channels);
        let mut out = std::io::Cursor::new(Vec::new());
        exr::image::Image::from_layer(layer).write().to_buffered(&mut out).expect("encode");
        out.into_inner()
    };
    let seeds = [
        write(Encoding::UNCOMPRESSED),
        write(Encoding::FAST_LOSSLESS),
        write(Encoding::SMALL_LOSSLESS),
        write(Encoding { compression: Compression::PIZ, ..Encoding::UNCOMPRESSED }),
        write(Encoding { compression: Compression::PXR24, ..Encoding::UNCOMPRESSED }),
        write(Encoding { compression: Compression::B44, ..Encoding::UNCOMPRESSED }),
    ];
    damage_and_load(4000, &seeds, "a.exr", keep, |bytes, _| decode_image(bytes, "a", &LIMITS));
}

#[test]
fn damaged_glb() {
    let mut textured = triangle();
    let image = textured.view(&tiny_png());
    textured.json["images"] = json!([{"bufferView": image, "mimeType": "image/png"}]);
    textured.json["textures"] = json!([{"source": 0}]);
    textured.json["materials"] = json!([{"alphaMode": "MASK",
        "pbrMetallicRoughness": {"baseColorTexture": {"index": 0}}, "emissiveTexture": {"index": 0}}]);
    textured.json["meshes"][0]["primitives"][0]["material"] = json!(0);
    let mut sparse = Builder::default();
    let positions = sparse.floats(&[[0.0_f32; 3], [1.0, 0.0, 0.0], [0.0; 3], [1.0; 3]], "VEC3");
    let at = sparse.view(&[2, 0]);
    let new = sparse.view(bytemuck::cast_slice(&[0.0_f32, 3.0, 0.0]));
    sparse.json["accessors"][positions]["sparse"] = json!({"count": 1,
        "indices": {"bufferView": at, "componentType": 5121}, "values": {"bufferView": new}});
    sparse.mesh(&json!({"attributes": {"POSITION": positions}, "mode": 5}));
    let seeds = [textured.glb(), sparse.glb(), compressed_triangle().glb()];
    let n_good = damage_and_load(8000, &seeds, "a.glb", repair_glb, |bytes, path| {
        read_gltf(bytes, path, &GltfChoice::default(), &LIMITS).map(|mesh| check_mesh(&mesh))
    });
    assert!(n_good > 100, "{n_good}");
    let json = textured.json.to_string().into_bytes();
    damage_and_load(4000, &[json], "a.gltf", keep, |bytes, path| {
        read_gltf(bytes, path, &GltfChoice::default(), &LIMITS).map(|mesh| check_mesh(&mesh))
    });
}

/// Makes the length in the header true again.
fn repair_glb(bytes: &mut [u8]) {
    let length = u32::try_from(bytes.len()).expect("small").to_le_bytes();
    if let Some(header) = bytes.get_mut(8..12) {
        header.copy_from_slice(&length);
    }
}

#[test]
fn damaged_obj_and_mtl() {
    let obj = b"mtllib a.mtl\no box\ng side front\nv -1 -1 -1\nv 1 -1 -1\nv 1 1 -1 1.0\nv -1 1 \\\n-1\n\
        v 0 2 0 0.5 0.5 0.5\nvt 0 0\nvt 1 0\nvt 1 1 0\nvn 0 0 1\nusemtl red\ns 1\nf 1/1/1 2/2/1 3/3/1 4/1/1\n\
        f -5//-1 -4//-1 -1//1\ns off\nusemtl blue\nf 1 2 3 4 5\nf 1/2 2/3 5/1\nl 1 2\n";
    let mtl =
        b"newmtl red\nKd 1 0 0\nKs 1 1 1\nNs 100\nNi 1.5\nd 0.5\nillum 2\nmap_Kd -clamp on a.png\n\
        newmtl blue\nKe 1 2 3\nTr 0.5\nPr 0.1\nPm 1\nmap_d -o 0 0 0 a.png\nKa 0 0 0\nbump b.png\n";
    let n_good = damage_and_load(8000, &[obj.to_vec()], "a.obj", keep, |bytes, path| {
        read_obj(bytes, path, 0.01, Axis::PlusZ, &LIMITS).map(|mesh| check_mesh(&mesh))
    });
    assert!(n_good > 100, "{n_good}");
    let folder = TempDir::new().expect("temporary folder");
    fs::write(folder.path().join("a.png"), tiny_png()).expect("write");
    damage_and_load(1000, &[mtl.to_vec()], "a.mtl", keep, |bytes, name| {
        fs::write(folder.path().join(name), bytes).expect("write");
        let path = folder.path().join("a.obj");
        read_obj(obj, &path, 1.0, Axis::PlusY, &LIMITS).map(|mesh| check_mesh(&mesh))
    });
}

//! Seeds that are made by code: those of binary formats. Texts lie in `tests/corpus` only.
//!
//! `UPDATE=1 cargo test --workspace --test fuzz` writes them there, after a format has changed.

use std::io::Cursor;

use exr::prelude::{
    Compression, Encoding, Image, Layer, LayerAttributes, SpecificChannels, Vec2,
    WritableImage as _, f16,
};
use image::{ExtendedColorType, ImageEncoder};
use runtime::output::{Denoised, Identity, Meta, Picture, encode_exr};
use runtime::{Checkpoint, Film, Rect, SampleRange};
use serde_json::{Value, json};

use super::{Random, Seed, Target, entry, pack, picture};

/// The seeds of a target that are made, with their names.
fn made(target: &Target) -> Vec<Seed> {
    let seeds = match target.name {
        "ply" => plys(),
        "stl" => stls(),
        "gltf" => gltf(),
        "glb" => glbs(),
        "png" => pngs(),
        "jpeg" => jpegs(),
        "ktx2" => ktx2s(),
        "hdr" => hdrs(),
        "ies" => luminaires(),
        "exr" => exrs(),
        "merge" => parts(),
        "checkpoint" => checkpoints(),
        "entry" => entries(),
        "pack" => packs(),
        "pack-table" => tables(),
        "pack-contents" => contents(),
        _ => Vec::new(),
    };
    seeds.into_iter().map(|(name, bytes)| Seed { name: name.to_owned(), bytes }).collect()
}

type Made = Vec<(&'static str, Vec<u8>)>;

fn noise(n: usize) -> Vec<u8> {
    let mut random = Random::new(7);
    (0..n).map(|_| u8::try_from(random.below(256)).unwrap_or(0)).collect()
}

/// The checksum of PNG.
pub(super) fn crc32(bytes: &[u8]) -> u32 {
    let step = |crc: u32, byte: &u8| {
        (0..8).fold(crc ^ u32::from(*byte), |c, _| {
            if c & 1 == 1 { (c >> 1) ^ 0xedb8_8320 } else { c >> 1 }
        })
    };
    !bytes.iter().fold(u32::MAX, step)
}

fn put(bytes: &mut [u8], at: usize, value: &[u8]) {
    bytes[at..at + value.len()].copy_from_slice(value);
}

fn cut(bytes: &[u8], part: usize) -> Vec<u8> {
    bytes[..bytes.len() * part / 100].to_vec()
}

// Meshes.

/// A square as two triangles, or a quadrilateral, in binary, with all that is read beside positions.
fn binary_ply(big: bool) -> Vec<u8> {
    let order = if big { "big" } else { "little" };
    let mut out = format!(
        "ply\nformat binary_{order}_endian 1.0\ncomment made\nelement vertex 4\nproperty float x\n\
         property double y\nproperty float z\nproperty float nx\nproperty float ny\nproperty float nz\n\
         property uchar red\nproperty uchar green\nproperty uchar blue\nelement face 2\n\
         property list uchar ushort vertex_indices\nproperty list uchar float texcoord\nend_header\n"
    )
    .into_bytes();
    let float = |x: f32| if big { x.to_be_bytes() } else { x.to_le_bytes() };
    let double = |x: f64| if big { x.to_be_bytes() } else { x.to_le_bytes() };
    let short = |x: u16| if big { x.to_be_bytes() } else { x.to_le_bytes() };
    for (x, y) in [(0.0, 0.0), (1.0, 0.0), (1.0, 1.0), (0.0, 1.0)] {
        out.extend(float(x));
        out.extend(double(y));
        out.extend([0.0, 0.0, 0.0, 1.0].map(float).as_flattened());
        out.extend([255, 128, 0]);
    }
    for (corners, uvs) in [(&[0, 1, 2][..], 6), (&[0, 1, 2, 3], 0)] {
        out.extend(u8::try_from(corners.len()));
        out.extend(corners.iter().flat_map(|corner| short(*corner)));
        out.push(uvs);
        out.extend((0..uvs).flat_map(|i| float(f32::from(i))));
    }
    out
}

fn plys() -> Made {
    let little = binary_ply(false);
    let mut claims = little.clone();
    let at = claims.windows(8).position(|word| word == b"vertex 4").expect("its vertices");
    claims[at + 7] = b'9';
    vec![
        ("bad-binary-cut", cut(&little, 90)),
        ("bad-binary-claims", claims),
        ("good-binary-little", little),
        ("good-binary-big", binary_ply(true)),
    ]
}

/// A tetrahedron whose comment begins as a text does.
fn binary_stl() -> Vec<u8> {
    let mut out = b"solid as many programs write it".to_vec();
    out.resize(80, b' ');
    let points = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0_f32]];
    let faces = [[0, 2, 1], [0, 1, 3], [1, 2, 3], [2, 0, 3]];
    out.extend(4_u32.to_le_bytes());
    for face in faces {
        out.extend([0; 12]);
        out.extend(
            face.iter().flat_map(|corner: &usize| points[*corner]).flat_map(f32::to_le_bytes),
        );
        out.extend([0; 2]);
    }
    out
}

fn stls() -> Made {
    let good = binary_stl();
    let mut infinite = good.clone();
    put(&mut infinite, 96, &f32::INFINITY.to_le_bytes());
    let mut nameless = good.clone();
    put(&mut nameless, 0, b"STLB");
    let mut longer = nameless.clone();
    longer.extend([0; 7]);
    vec![
        ("bad-binary-cut", cut(&nameless, 90)),
        ("bad-binary-infinite", infinite),
        ("good-binary", good),
        ("good-binary-nameless", nameless),
        ("good-binary-longer", longer),
    ]
}

// Images.

fn png(size: [u32; 2], color: ExtendedColorType) -> Vec<u8> {
    let mut out = Vec::new();
    let n = size[0] as usize * size[1] as usize * usize::from(color.bits_per_pixel()) / 8;
    let encoder = image::codecs::png::PngEncoder::new(&mut out);
    encoder.write_image(&noise(n), size[0], size[1], color).expect("noise can be stored");
    out
}

/// Two texels, one of which lets light through.
pub(super) fn tiny_png() -> Vec<u8> {
    let mut out = Vec::new();
    let texels = [255, 0, 0, 255, 0, 255, 0, 64];
    let encoder = image::codecs::png::PngEncoder::new(&mut out);
    encoder.write_image(&texels, 2, 1, ExtendedColorType::Rgba8).expect("two texels can be stored");
    out
}

fn pngs() -> Made {
    let good = png([9, 9], ExtendedColorType::L8);
    let claims = |width: u32, height: u32| {
        let mut bytes = good.clone();
        put(&mut bytes, 16, &width.to_be_bytes());
        put(&mut bytes, 20, &height.to_be_bytes());
        let crc = crc32(&bytes[12..29]);
        put(&mut bytes, 29, &crc.to_be_bytes());
        bytes
    };
    vec![
        ("good-gray", good.clone()),
        ("good-rgb", png([4, 7], ExtendedColorType::Rgb8)),
        ("good-rgba16", png([5, 5], ExtendedColorType::Rgba16)),
        ("good-tiny", tiny_png()),
        ("bad-cut", cut(&good, 60)),
        ("bad-empty", Vec::new()),
        ("bad-huge", claims(0x7fff_ffff, 0x7fff_ffff)),
        ("bad-large", claims(16_384, 16_384)),
        ("bad-no-pixels", claims(0, 9)),
        ("bad-magic", [b"\x88", &good[1..]].concat()),
        ("bad-signature-only", good[..8].to_vec()),
    ]
}

fn jpeg(size: [u32; 2], color: ExtendedColorType) -> Vec<u8> {
    let mut out = Vec::new();
    let n = size[0] as usize * size[1] as usize * usize::from(color.bits_per_pixel()) / 8;
    let encoder = image::codecs::jpeg::JpegEncoder::new(&mut out);
    encoder.write_image(&noise(n), size[0], size[1], color).expect("noise can be stored");
    out
}

fn jpegs() -> Made {
    let good = jpeg([17, 13], ExtendedColorType::Rgb8);
    let mut huge = good.clone();
    let frame = huge.windows(2).position(|pair| pair == [0xff, 0xc0]).expect("a baseline frame");
    put(&mut huge, frame + 5, &[0xff; 4]);
    vec![
        ("good-rgb", good.clone()),
        ("good-gray", jpeg([8, 8], ExtendedColorType::L8)),
        ("bad-cut", cut(&good, 30)),
        ("bad-huge", huge),
        ("bad-start-only", vec![0xff, 0xd8, 0xff]),
        ("bad-empty", Vec::new()),
    ]
}

/// Those of the tests of the compiler, which other people's encoders made.
fn ktx2s() -> Made {
    let good = include_bytes!("../../../compiler/tests/import_gltf/uastc-zstd.ktx2");
    let forged = |at: usize, value: &[u8]| {
        let mut bytes = good.to_vec();
        put(&mut bytes, at, value);
        bytes
    };
    let fixture = |bytes: &[u8]| bytes.to_vec();
    vec![
        ("good-etc1s", fixture(include_bytes!("../../../compiler/tests/import_gltf/etc1s.ktx2"))),
        (
            "good-etc1s-alpha",
            fixture(include_bytes!("../../../compiler/tests/import_gltf/etc1s-alpha.ktx2")),
        ),
        ("good-uastc", fixture(include_bytes!("../../../compiler/tests/import_gltf/uastc.ktx2"))),
        ("good-uastc-zstd", good.to_vec()),
        ("bad-cut", cut(good, 90)),
        ("bad-empty", Vec::new()),
        ("bad-huge", forged(20, &[255; 8])),
        ("bad-large", forged(20, &[0, 64, 0, 0, 0, 64, 0, 0])),
        ("bad-level", forged(80, &[255; 8])),
        ("bad-inflated", forged(96, &[255; 8])),
        ("bad-layers", forged(32, &[255; 4])),
    ]
}

fn hdrs() -> Made {
    let pixels: Vec<image::Rgb<f32>> = noise(16 * 9 * 3)
        .chunks(3)
        .map(|c| image::Rgb([c[0], c[1] / 64, 3].map(f32::from)))
        .collect();
    let mut good = Vec::new();
    image::codecs::hdr::HdrEncoder::new(&mut good)
        .encode(&pixels, 16, 9)
        .expect("noise can be stored");
    let head = |size: &str| format!("#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n{size}\n").into_bytes();
    vec![
        ("good-runs", good.clone()),
        ("good-flat", [head("-Y 1 +X 2"), vec![128, 64, 32, 129, 0, 0, 0, 0]].concat()),
        ("bad-cut", cut(&good, 50)),
        ("bad-huge", head("-Y 4294967295 +X 4294967295")),
        ("bad-large", head("-Y 100000 +X 100000")),
        ("bad-negative", head("-Y -1 +X 5")),
        ("bad-no-size", b"#?RADIANCE\n\n".to_vec()),
        ("bad-run-too-long", [head("-Y 1 +X 16"), vec![2, 2, 0, 16, 255, 1]].concat()),
        ("bad-empty", Vec::new()),
    ]
}

fn luminaires() -> Made {
    let file = |counts: &str, rest: &str| {
        format!("IESNA:LM-63-2002\nTILT=NONE\n1 -1 1 {counts} 1 2 0 0 0\n1 1 9\n{rest}\n")
            .into_bytes()
    };
    let good = file("3 1", "0 45 90\n0\n900 400 10");
    let tilted = b"TILT=INCLUDE\n1\n2\n0 90\n1 0.8\n1 900 1 2 1 1 1 0 0 0\n1 1 9\n0 90\n0\n9 3\n";
    vec![
        ("good-around", good.clone()),
        ("good-quarter", file("2 2", "0 90\n0 90\n900 400\n300 0")),
        ("good-tilted", tilted.to_vec()),
        ("bad-cut", cut(&good, 70)),
        ("bad-huge", file("1000000 1000000", "0 90")),
        ("bad-angles", file("2 2", "0 90\n10 20\n1 2 3 4")),
        ("bad-tilt", b"IESNA91\nTILT=lamp.tlt\n1".to_vec()),
    ]
}

fn exr(encoding: Encoding) -> Vec<u8> {
    let channels = SpecificChannels::rgba(|at: Vec2<usize>| {
        let number = |x: usize| u8::try_from(x).map_or(0.0, f32::from);
        (number(at.x()), number(at.y()), 0.5_f32, f16::from_f32(0.5))
    });
    let layer = Layer::new((20, 18), LayerAttributes::named("main"), encoding, channels);
    let mut out = Cursor::new(Vec::new());
    Image::from_layer(layer).write().to_buffered(&mut out).expect("a gradient can be stored");
    out.into_inner()
}

/// Where the four numbers of an EXR's `dataWindow` begin.
fn data_window(bytes: &[u8]) -> usize {
    let name = b"dataWindow\0box2i\0";
    let at = bytes.windows(name.len()).position(|window| window == name);
    at.expect("an EXR has a data window") + name.len() + 4
}

fn exrs() -> Made {
    let packed = |compression| exr(Encoding { compression, ..Encoding::UNCOMPRESSED });
    let good = exr(Encoding::FAST_LOSSLESS);
    let window = |corner: [i32; 4]| {
        let mut bytes = good.clone();
        let at = data_window(&bytes);
        put(&mut bytes, at, &corner.map(i32::to_le_bytes).concat());
        bytes
    };
    vec![
        ("good-runs", good.clone()),
        ("good-plain", exr(Encoding::UNCOMPRESSED)),
        ("good-zip", exr(Encoding::SMALL_LOSSLESS)),
        ("good-piz", packed(Compression::PIZ)),
        ("good-pxr24", packed(Compression::PXR24)),
        ("good-b44", packed(Compression::B44)),
        ("bad-cut", cut(&good, 70)),
        ("bad-header-only", good[..8].to_vec()),
        ("bad-huge", window([0, 0, 0x7fff_fffe, 0x7fff_fffe])),
        ("bad-large", window([0, 0, 20_000, 20_000])),
        ("bad-inside-out", window([10, 10, -10, -10])),
        ("bad-empty", Vec::new()),
    ]
}

// Pictures and checkpoints.

fn film(crop: Rect, range: SampleRange) -> Film {
    let mut film = Film::new([9, 8], crop);
    film.ranges = vec![range];
    film.counts.fill(range.count());
    for (sum, i) in film.sums.iter_mut().zip(0_u32..) {
        *sum = [1.0 / f64::from(i + 3), f64::from(i), 0.0];
    }
    film
}

fn range(start: u32, end: u32) -> SampleRange {
    SampleRange::new(start, end).expect("not empty")
}

fn part(picture: &Picture) -> Vec<u8> {
    encode_exr(picture, true).expect("a small picture can be stored")
}

fn parts() -> Made {
    let meta = Meta {
        clamp_indirect: None,
        adaptive: false,
        render_id: "00ff".to_owned(),
        seed: 3,
        estimator: 0,
        precision: "f32".to_owned(),
        device: "CPU kernel (f32, 2 threads)".to_owned(),
        commit: String::new(),
        seconds: 1.5,
        exposure: -0.5,
        tone_map: 1,
        complete: true,
        coarse_block: None,
    };
    let of = |film: Film| Picture::new(film, meta.clone());
    let crop = Rect { x: 1, y: 2, w: 5, h: 3 };
    let good = of(film(crop, range(0, 16)));
    let bytes = part(&good);
    let mut uneven = good.clone();
    uneven.film.counts[4] = 3;
    let mut replicates = good.clone();
    replicates.film.variance = vec![0.25; 15];
    let mut unbounded = good.clone();
    unbounded.film.sums = vec![[f64::INFINITY, f64::NAN, -1.0]; 15];
    let mut denoised = good.clone();
    denoised.denoised = Some(Denoised { pixels: vec![[0.5; 3]; 15], by: "a denoiser".to_owned() });
    let window = |corner: [i32; 4]| {
        let mut bytes = bytes.clone();
        let at = data_window(&bytes);
        put(&mut bytes, at, &corner.map(i32::to_le_bytes).concat());
        bytes
    };
    let without = |name: &str| {
        let mut bytes = bytes.clone();
        let at = bytes.windows(name.len()).position(|window| window == name.as_bytes());
        bytes[at.expect("it is there")] = b'x';
        bytes
    };
    vec![
        ("good-part", bytes.clone()),
        ("good-later", part(&of(film(crop, range(48, 64))))),
        ("good-infinite", part(&unbounded)),
        ("good-denoised", part(&denoised)),
        ("bad-last-samples", part(&of(film(crop, range(16, u32::MAX))))),
        ("bad-uneven", part(&uneven)),
        ("bad-replicates", part(&replicates)),
        ("bad-cut", cut(&bytes, 80)),
        ("bad-huge", window([0, 0, 0x7fff_fffe, 0x7fff_fffe])),
        ("bad-outside", window([5, 6, 9, 8])),
        ("bad-no-ranges", without("sample_ranges")),
        ("bad-foreign", exr(Encoding::UNCOMPRESSED)),
        ("bad-b44", exr(Encoding { compression: Compression::B44, ..Encoding::UNCOMPRESSED })),
        ("bad-empty", Vec::new()),
    ]
}

fn checkpoint() -> Vec<u8> {
    let crop = Rect { x: 1, y: 2, w: 5, h: 3 };
    let identity = Identity {
        clamp_indirect: "off".to_owned(),
        render_id: "00ff".to_owned(),
        image_size: [9, 8],
        crop,
        seed: 3,
        estimator: 0,
        precision: "f32".to_owned(),
    };
    let checkpoint = Checkpoint {
        identity,
        samples: range(3, 100),
        film: film(crop, range(3, 32)),
        device: "CPU kernel (f32, 2 threads)".to_owned(),
        seconds: 1.25,
    };
    let file = tempfile::NamedTempFile::new().expect("a temporary file");
    checkpoint.write(file.path()).expect("a small checkpoint can be stored");
    std::fs::read(file.path()).expect("what was written can be read")
}

fn checkpoints() -> Made {
    let good = checkpoint();
    let n_text = u32::from_le_bytes([good[12], good[13], good[14], good[15]]) as usize;
    let (head, rest) = good.split_at(picture::HEADER);
    let (text, sums) = rest.split_at(n_text);
    let text = String::from_utf8(text.to_vec()).expect("its text is one");
    let forged = |from: &str, to: &str, sums: &[u8]| {
        assert!(text.contains(from), "{from}");
        let text = text.replacen(from, to, 1);
        let mut bytes = [head, text.as_bytes(), sums].concat();
        put(&mut bytes, 12, &u32::try_from(text.len()).expect("short").to_le_bytes());
        picture::repair_checkpoint(&mut bytes);
        bytes
    };
    let mut flipped = good.clone();
    flipped[100] ^= 1;
    let nan = f64::NAN.to_le_bytes().repeat(sums.len() / 8);
    vec![
        ("good-half-way", good.clone()),
        ("good-not-finite", forged("seed", "seed", &nan)),
        ("bad-bit", flipped),
        ("bad-cut", cut(&good, 90)),
        ("bad-magic-only", good[..8].to_vec()),
        ("bad-huge", forged("crop 1,2,5,3", "crop 0,0,4294967295,4294967295", sums)),
        ("bad-crop", forged("crop 1,2,5,3", "crop 4294967295,2,5,3", sums)),
        ("bad-done", forged("done 3..32", "done 3..4294967295", sums)),
        ("bad-ranges", forged("done 3..32", "done 3..16,16..32,8..20", sums)),
        ("bad-seconds", forged("seconds 1.25", "seconds nan", sums)),
        ("bad-sums", forged("seed", "seed", &sums[..24])),
        ("bad-version", forged("rtr ", "rtr 99", sums)),
        ("bad-empty", Vec::new()),
    ]
}

// Trees and packs.

fn entries() -> Made {
    let good = entry::seed();
    let forged = |at: usize, word: u32| {
        let mut bytes = good.clone();
        put(&mut bytes, at, &word.to_le_bytes());
        entry::repair(&mut bytes);
        bytes
    };
    let mut flipped = good.clone();
    flipped[200] ^= 1;
    vec![
        ("good-entry", good.clone()),
        ("bad-bit", flipped),
        ("bad-cut", cut(&good, 50)),
        // The root, and the children of node 0: node 0 again.
        ("bad-root", forged(12, 0x8000_ffff)),
        ("bad-cycle", forged(104, 0x8000_0000)),
        ("bad-cycle-of-two", forged(108, 0x8000_0000)),
        ("bad-nodes", forged(16, u32::MAX)),
        ("bad-pieces", forged(20, u32::MAX)),
        ("bad-splits", forged(96, u32::MAX)),
        ("bad-order", forged(good.len() - 4, u32::MAX)),
        ("bad-twice", forged(good.len() - 4, 0)),
        ("bad-empty", Vec::new()),
    ]
}

fn packs() -> Made {
    let good = pack::seed();
    let forged = |at: usize, value: &[u8]| {
        let mut bytes = good.clone();
        put(&mut bytes, at, value);
        pack::repair(&mut bytes);
        bytes
    };
    vec![
        ("good-little", good.clone()),
        ("bad-cut", cut(&good, 50)),
        ("bad-header-only", good[..128].to_vec()),
        ("bad-magic", forged(0, b"x")),
        ("bad-count", forged(32, &[0xff; 4])),
        ("bad-length", forged(40, &[0xff; 8])),
        ("bad-offset", forged(128 + 16, &[0xff; 8])),
        ("bad-section-length", forged(128 + 24, &[0xff; 8])),
        ("bad-elements", forged(128 + 40, &[0xff; 8])),
        ("bad-empty", Vec::new()),
    ]
}

fn tables() -> Made {
    let edit = |at: u16, value: u64| [at.to_le_bytes().as_slice(), &value.to_le_bytes()].concat();
    vec![
        ("good-none", Vec::new()),
        ("bad-count", edit(32, 0xffff_ffff)),
        ("bad-offset", edit(128 + 16, u64::MAX)),
        ("bad-length", edit(128 + 64 + 24, u64::MAX)),
        ("bad-elements", edit(128 + 64 + 40, 1 << 63)),
        ("bad-overlap", [edit(128 + 16, 4096), edit(128 + 64 + 16, 4096)].concat()),
    ]
}

fn contents() -> Made {
    let edit = |section: u8, action: u8, at: u16, word: u32| {
        let [low, high] = at.to_le_bytes();
        [[section, action, low, high].as_slice(), &word.to_le_bytes()].concat()
    };
    // Sections: render settings, camera, nodes, triangles, …; words of a node: 3 and 7 are children.
    vec![
        ("good-none", Vec::new()),
        ("bad-not-a-number", edit(1, 2, 0, 0x7fc0_0000)),
        ("bad-root", edit(0, 2, 8, 0x8000_ffff)),
        ("cycle", [edit(2, 2, 3, 0x8000_0000), edit(3, 2, 3, 0x8000_0000)].concat()),
        ("longer", [edit(2, 0, 0, 0), edit(3, 0, 1, 0), edit(4, 0, 2, 0)].concat()),
        ("shorter", edit(4, 1, 48, 0)),
        ("infinite", edit(5, 2, 1, 0x7f80_0000)),
    ]
}

// glTF.

/// A document with one buffer in the making.
struct Document {
    json: Value,
    binary: Vec<u8>,
}

impl Document {
    fn push(&mut self, list: &str, value: Value) -> usize {
        let list = self.json[list].as_array_mut().expect("a list");
        list.push(value);
        list.len() - 1
    }

    fn view(&mut self, bytes: &[u8]) -> usize {
        let offset = self.binary.len();
        self.binary.extend_from_slice(bytes);
        self.binary.resize(self.binary.len().next_multiple_of(4), 0);
        self.json["buffers"][0]["byteLength"] = json!(self.binary.len());
        let view = json!({"buffer": 0, "byteOffset": offset, "byteLength": bytes.len()});
        self.push("bufferViews", view)
    }

    fn floats<const N: usize>(&mut self, values: &[[f32; N]], kind: &str) -> usize {
        let view = self.view(bytemuck::cast_slice(values.as_flattened()));
        let accessor =
            json!({"bufferView": view, "componentType": 5126, "count": values.len(), "type": kind});
        self.push("accessors", accessor)
    }

    /// One triangle with normals, UVs, indices and a textured material.
    fn triangle() -> Self {
        let json = json!({
            "asset": {"version": "2.0"}, "buffers": [{"byteLength": 0}], "bufferViews": [], "accessors": [],
            "meshes": [], "nodes": [{"mesh": 0, "scale": [1, 2, -1]}, {"children": [0]}],
            "scenes": [{"nodes": [1]}], "scene": 0, "textures": [{"source": 0}],
            "materials": [{"alphaMode": "MASK", "emissiveTexture": {"index": 0},
                "pbrMetallicRoughness": {"baseColorTexture": {"index": 0}}}]
        });
        let mut document = Self { json, binary: Vec::new() };
        let positions = document.floats(&[[0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]], "VEC3");
        let normals = document.floats(&[[0.0, 0.0, 1.0]; 3], "VEC3");
        let uvs = document.floats(&[[0.0, 0.0], [1.0, 0.0], [0.0, 1.0]], "VEC2");
        let view = document.view(bytemuck::cast_slice(&[0_u16, 1, 2]));
        let indices =
            json!({"bufferView": view, "componentType": 5123, "count": 3, "type": "SCALAR"});
        let indices = document.push("accessors", indices);
        let attributes = json!({"POSITION": positions, "NORMAL": normals, "TEXCOORD_0": uvs});
        let primitive = json!({"attributes": attributes, "indices": indices, "material": 0});
        document.push("meshes", json!({"primitives": [primitive]}));
        let image = document.view(&tiny_png());
        document.json["images"] = json!([{"bufferView": image, "mimeType": "image/png"}]);
        document
    }

    /// A strip with a sparse accessor.
    fn sparse() -> Self {
        let mut document = Self::triangle();
        let places = [[0.0_f32; 3], [1.0, 0.0, 0.0], [0.0; 3], [1.0; 3]];
        let positions = document.floats(&places, "VEC3");
        let at = document.view(&[2, 0]);
        let new = document.view(bytemuck::cast_slice(&[0.0_f32, 3.0, 0.0]));
        document.json["accessors"][positions]["sparse"] = json!({"count": 1,
            "indices": {"bufferView": at, "componentType": 5121}, "values": {"bufferView": new}});
        document.json["meshes"][0]["primitives"] =
            json!([{"attributes": {"POSITION": positions}, "mode": 5}]);
        document
    }

    /// The same with one value replaced.
    fn with(mut self, pointer: &str, value: Value) -> Self {
        *self.json.pointer_mut(pointer).expect("a place in the document") = value;
        self
    }

    fn glb(&self) -> Vec<u8> {
        let mut out = b"glTF\x02\0\0\0\0\0\0\0".to_vec();
        let json = self.json.to_string();
        for (kind, bytes, fill) in [(b"JSON", json.as_bytes(), b' '), (b"BIN\0", &self.binary, 0)] {
            let length = bytes.len().next_multiple_of(4);
            out.extend_from_slice(&u32::try_from(length).expect("small").to_le_bytes());
            out.extend_from_slice(kind);
            out.extend_from_slice(bytes);
            out.resize(out.len() + length - bytes.len(), fill);
        }
        super::mesh::repair_glb(&mut out);
        out
    }

    /// The document with its buffer as a data URI.
    fn gltf(mut self) -> Vec<u8> {
        let uri = format!("data:application/octet-stream;base64,{}", base64(&self.binary));
        self.json["buffers"][0]["uri"] = json!(uri);
        self.json.to_string().into_bytes()
    }
}

fn base64(bytes: &[u8]) -> String {
    const LETTERS: &[u8; 64] = b"ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    let letters = |chunk: &[u8]| {
        let byte = |i: usize| u32::from(chunk.get(i).copied().unwrap_or(0));
        let bits = byte(0) << 16 | byte(1) << 8 | byte(2);
        let letter = move |i: usize| {
            let is_data = i <= chunk.len();
            if is_data { char::from(LETTERS[(bits >> (18 - 6 * i) & 63) as usize]) } else { '=' }
        };
        [letter(0), letter(1), letter(2), letter(3)]
    };
    bytes.chunks(3).flat_map(letters).collect()
}

fn glbs() -> Made {
    let good = Document::triangle().glb();
    let forged = |at: usize, word: u32| {
        let mut bytes = good.clone();
        put(&mut bytes, at, &word.to_le_bytes());
        bytes
    };
    vec![
        ("good-triangle", good.clone()),
        ("good-sparse", Document::sparse().glb()),
        (
            "good-edgebreaker",
            include_bytes!("../../../compiler/tests/import_gltf/edgebreaker.glb").to_vec(),
        ),
        (
            "good-sequential",
            include_bytes!("../../../compiler/tests/import_gltf/sequential.glb").to_vec(),
        ),
        ("bad-cut", cut(&good, 50)),
        ("bad-magic", forged(0, 0)),
        ("bad-version", forged(4, 1)),
        ("bad-length", forged(8, u32::MAX)),
        ("bad-chunk-length", forged(12, u32::MAX)),
        ("bad-chunk-kind", forged(16, 0)),
        ("bad-header-only", good[..12].to_vec()),
        ("bad-empty", Vec::new()),
    ]
}

fn gltf() -> Made {
    let good = || Document::triangle();
    let bad = |pointer: &str, value: Value| good().with(pointer, value).gltf();
    let nested = format!("{}{}", "[".repeat(2000), "]".repeat(2000)).into_bytes();
    vec![
        ("good-triangle", good().gltf()),
        ("good-sparse", Document::sparse().gltf()),
        ("bad-cut", cut(&good().gltf(), 90)),
        ("bad-cycle", bad("/nodes/0", json!({"mesh": 0, "children": [1]}))),
        ("bad-own-child", bad("/nodes/1/children", json!([1]))),
        ("bad-count", bad("/accessors/0/count", json!(u32::MAX))),
        ("bad-count-of-indices", bad("/accessors/3/count", json!(u64::MAX))),
        ("bad-view", bad("/bufferViews/0/byteLength", json!(u32::MAX))),
        ("bad-view-offset", bad("/bufferViews/0/byteOffset", json!(u64::MAX))),
        ("bad-buffer", bad("/buffers/0/byteLength", json!(u64::MAX))),
        ("bad-not-finite", bad("/nodes/0/scale", json!([1e39, 1e39, 1e39]))),
        ("large", bad("/nodes/0/scale", json!([1e38, 1e38, 1e38]))),
        ("bad-index", bad("/meshes/0/primitives/0/attributes/POSITION", json!(99))),
        ("bad-version", bad("/asset/version", json!("1.0"))),
        ("bad-nested", nested),
        ("bad-not-json", b"{".to_vec()),
        ("bad-empty", Vec::new()),
    ]
}

/// Writes the seeds that are missing in the corpus of a target, or no longer fare as their names say: encoders need
/// not give the same bytes twice.
///
/// # Errors
/// When a file cannot be written.
pub fn write(target: &'static Target) -> std::io::Result<()> {
    let (folder, runner) = (super::corpus::folder(target), super::Runner::new(target)?);
    std::fs::create_dir_all(&folder)?;
    for seed in made(target) {
        let path = folder.join(&seed.name);
        let fares = std::fs::read(&path).ok().map(|bytes| runner.run(&bytes).is_ok());
        if fares.is_none() || seed.is_good().is_some_and(|good| fares != Some(good)) {
            std::fs::write(path, &seed.bytes)?;
        }
    }
    Ok(())
}

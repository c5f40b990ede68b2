//! Images: what is kept of each format, and that everything wrong is one clear line.

use compiler::import::{
    Environment, ErrorKind, Image, ImportError, Limits, Pixels, load_environment, load_image,
};
use half::f16;
use image::codecs::{hdr::HdrEncoder, jpeg::JpegEncoder, png::PngEncoder};
use image::{ExtendedColorType, ImageEncoder, Rgb};
use std::fs;
use tempfile::TempDir;

fn load(name: &str, bytes: &[u8]) -> Result<Image, ImportError> {
    load_within(name, bytes, &Limits::default())
}

fn load_within(name: &str, bytes: &[u8], limits: &Limits) -> Result<Image, ImportError> {
    let folder = TempDir::new().expect("temporary folder");
    let path = folder.path().join(name);
    fs::write(&path, bytes).expect("write");
    load_image(&path, limits).map_err(|mut error| {
        error.place = error.place.replace(&format!("{}/", folder.path().display()), "");
        error
    })
}

fn png(bytes: &[u8], size: [u32; 2], color: ExtendedColorType) -> Vec<u8> {
    let mut out = Vec::new();
    PngEncoder::new(&mut out).write_image(bytes, size[0], size[1], color).expect("encode");
    out
}

fn exr(texel: impl Fn(usize, usize) -> (f32, f32, f32, f32) + Sync) -> Vec<u8> {
    use exr::prelude::*;
    let channels = SpecificChannels::rgba(|at: Vec2<usize>| texel(at.x(), at.y()));
    let image = exr::image::Image::from_channels((4, 3), channels);
    let mut out = std::io::Cursor::new(Vec::new());
    image.write().to_buffered(&mut out).expect("encode");
    out.into_inner()
}

fn halves(image: &Image) -> Vec<f32> {
    let Pixels::Rgba16F(bits) = &image.data else { panic!("expected half floats") };
    bits.iter().map(|bits| f16::from_bits(*bits).to_f32()).collect()
}

#[test]
fn png_bytes_are_kept_and_rows_run_downwards() {
    let image =
        load("a.png", &png(&[1, 2, 3, 4, 5, 6], [1, 2], ExtendedColorType::Rgb8)).expect("png");
    assert_eq!((image.width, image.height, image.has_alpha), (1, 2, false));
    assert_eq!(image.data, Pixels::Rgba8(vec![1, 2, 3, 255, 4, 5, 6, 255]));
    let gray = load("a.png", &png(&[9, 128], [1, 1], ExtendedColorType::La8)).expect("png");
    assert!(gray.has_alpha);
    assert_eq!(gray.data, Pixels::Rgba8(vec![9, 9, 9, 128]));
}

#[test]
fn sixteen_bits_become_half_floats() {
    let values: [u16; 4] = [0, 65535, 32768, 16384];
    let bytes: Vec<u8> = values.iter().flat_map(|v| v.to_ne_bytes()).collect();
    let image = load("a.png", &png(&bytes, [1, 1], ExtendedColorType::Rgba16)).expect("png");
    let found = halves(&image);
    for (found, value) in found.iter().zip(values) {
        assert!((found - f32::from(value) / 65535.0).abs() < 1.0 / 2048.0);
    }
    assert!(image.has_alpha);
}

#[test]
fn jpeg_is_recognised_by_content_not_by_name() {
    let mut bytes = Vec::new();
    JpegEncoder::new_with_quality(&mut bytes, 95)
        .write_image(&[200; 3 * 64], 8, 8, ExtendedColorType::Rgb8)
        .expect("encode");
    let image = load("photo.png", &bytes).expect("jpeg");
    let Pixels::Rgba8(texels) = &image.data else { panic!("8 bits") };
    assert!(texels.chunks(4).all(|t| t[0].abs_diff(200) < 3 && t[3] == 255));
}

#[test]
fn hdr_and_exr_are_linear_and_clamped_with_a_count() {
    let mut bytes = Vec::new();
    HdrEncoder::new(&mut bytes)
        .encode(&[Rgb([0.5_f32, 2.0, 8.0]), Rgb([1e6, 0.0, 0.0])], 2, 1)
        .expect("encode");
    let image = load("a.hdr", &bytes).expect("hdr");
    let texels = halves(&image);
    assert!((texels[0] - 0.5).abs() < 0.05 && (texels[2] - 8.0).abs() < 0.05);
    assert_eq!((texels[4], image.clamped), (65504.0, 1));

    let image = load("a.exr", &exr(|x, y| (x as f32, y as f32, 1e9, 1.0))).expect("exr");
    assert_eq!((image.width, image.height, image.clamped, image.has_alpha), (4, 3, 12, false));
    assert_eq!(halves(&image)[4 * 6..4 * 7], [2.0, 1.0, 65504.0, 1.0]);
}

fn environment(name: &str, bytes: &[u8]) -> Result<Environment, ImportError> {
    let folder = TempDir::new().expect("temporary folder");
    let path = folder.path().join(name);
    fs::write(&path, bytes).expect("write");
    load_environment(&path, &Limits::default()).map_err(|mut error| {
        error.place = error.place.replace(&format!("{}/", folder.path().display()), "");
        error
    })
}

#[test]
fn environments_keep_suns_that_are_too_bright_for_half_floats() {
    let sun = |x, y| if (x, y) == (2, 1) { (4e6, 1e5, 1.0, 1.0) } else { (0.5, 0.25, 0.0, 1.0) };
    let found = environment("a.exr", &exr(sun)).expect("radiance");
    assert_eq!((found.scale, found.image.clamped, found.image.is_radiance), (64.0, 0, true));
    let texels = halves(&found.image);
    let near = |texel: usize, expected: [f64; 3]| {
        let rgb = &texels[4 * texel..4 * texel + 3];
        rgb.iter().zip(expected).all(|(value, expected)| {
            (f64::from(*value) * found.scale - expected).abs() <= expected / 2048.0
        })
    };
    assert!(near(6, [4e6, 1e5, 1.0]) && near(0, [0.5, 0.25, 0.0]), "{texels:?}");
    let dim = environment("a.exr", &exr(|_, _| (1.0, 65504.0, 0.0, 1.0))).expect("radiance");
    assert_eq!((dim.scale, halves(&dim.image)[1]), (1.0, 65504.0));
    let picture = environment("a.png", &png(&[9, 128], [1, 1], ExtendedColorType::La8));
    assert!(!picture.expect("a picture").image.is_radiance);
}

#[test]
fn environments_with_texels_that_are_no_radiance_are_refused_by_the_first() {
    for (value, shown) in [(-1.5, "-1.5"), (f32::NAN, "NaN"), (f32::INFINITY, "inf")] {
        let bytes =
            exr(|x, y| if y > 0 && x > 1 { (1.0, value, 1.0, 1.0) } else { (1.0, 1.0, 1.0, 1.0) });
        let error = environment("sky.exr", &bytes).expect_err("not radiance");
        assert_eq!(
            error.to_string(),
            format!(
                "sky.exr: texel (2, 1), counted from the top left, has a channel of {shown}; radiance is a \
                 finite number, 0 or more"
            )
        );
        assert_eq!(error.kind, ErrorKind::Image);
    }
}

#[test]
fn exr_colour_is_divided_by_alpha() {
    let image = load("a.exr", &exr(|_, _| (0.25, 0.5, f32::NAN, 0.5))).expect("exr");
    assert_eq!(halves(&image)[..4], [0.5, 1.0, 0.0, 0.5]);
    assert_eq!((image.has_alpha, image.clamped), (true, 12));
}

#[test]
fn exr_with_luminance_only_is_grey_and_without_colour_refused() {
    use exr::prelude::*;
    let write = |name: &str| {
        let samples = FlatSamples::F32(vec![0.25, 0.5]);
        let channel = AnyChannel::new(name, samples);
        let channels = AnyChannels::sort(SmallVec::from_vec(vec![channel]));
        let mut out = std::io::Cursor::new(Vec::new());
        exr::image::Image::from_channels((2, 1), channels)
            .write()
            .to_buffered(&mut out)
            .expect("encode");
        out.into_inner()
    };
    assert_eq!(halves(&load("y.exr", &write("Y")).expect("exr"))[4..], [0.5, 0.5, 0.5, 1.0]);
    let error = load("z.exr", &write("Z")).expect_err("depth");
    assert_eq!(error.to_string(), "z.exr: no flat layer has the channels R, G, B or the channel Y");
}

#[test]
fn foreign_and_cut_off_files_are_one_clear_line() {
    let cases: [(&[u8], &str); 4] = [
        (b"", "a.png: the file is empty"),
        (b"GIF89a", "a.png: this is a GIF image; images are PNG, JPEG, WebP, KTX2, HDR or EXR"),
        (b"RIFF....WAVE", "a.png: this is not a PNG, JPEG, WebP, KTX2, HDR or EXR image"),
        (b"hello there", "a.png: this is not a PNG, JPEG, WebP, KTX2, HDR or EXR image"),
    ];
    for (bytes, expected) in cases {
        assert_eq!(load("a.png", bytes).expect_err("foreign").to_string(), expected);
    }
    let noise: Vec<u8> =
        (0..3 * 64 * 64_u32).map(|i| (i.wrapping_mul(2_654_435_761) >> 24) as u8).collect();
    let mut jpeg = Vec::new();
    JpegEncoder::new(&mut jpeg)
        .write_image(&noise, 64, 64, ExtendedColorType::Rgb8)
        .expect("encode");
    let mut hdr = Vec::new();
    let pixels: Vec<Rgb<f32>> = noise.chunks(3).map(|c| Rgb([f32::from(c[0]), 1.0, 2.0])).collect();
    HdrEncoder::new(&mut hdr).encode(&pixels, 64, 64).expect("encode");
    let files = [
        png(&noise, [64, 64], ExtendedColorType::Rgb8),
        hdr,
        exr(|x, y| (x as f32, y as f32, 1.0, 1.0)),
    ];
    for bytes in files {
        let error = load("a", &bytes[..bytes.len() / 2]).expect_err("cut off");
        let text = error.to_string();
        assert!(text.starts_with("a: the image is damaged or cut off: "), "{text}");
        assert!(!text.contains('\n') && error.kind == ErrorKind::Image, "{text}");
    }
    // A JPEG that ends early may be shown as far as it goes; it must not be a panic.
    let _ = load("a", &jpeg[..jpeg.len() / 2]);
}

#[test]
fn huge_claims_are_refused_before_decoding() {
    // A PNG header that claims 65536 x 65536 pixels, with its checksum.
    let mut bytes = png(&[0; 3], [1, 1], ExtendedColorType::Rgb8);
    bytes[16..24].copy_from_slice(&[0, 1, 0, 0, 0, 1, 0, 0]);
    let crc = crc32(&bytes[12..29]);
    bytes[29..33].copy_from_slice(&crc.to_be_bytes());
    let error = load("a.png", &bytes).expect_err("huge");
    let expected = "a.png: the image claims 65536 x 65536 pixels, the limit is 268435456";
    assert_eq!((error.kind, error.to_string().as_str()), (ErrorKind::Limit, expected));
    let hdr = b"#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 100000 +X 100000\n";
    assert_eq!(load("a.hdr", hdr).expect_err("huge").kind, ErrorKind::Limit);
    let small = Limits { pixels: 11, ..Limits::default() };
    let error = load_within("a.exr", &exr(|_, _| (0.0, 0.0, 0.0, 1.0)), &small).expect_err("limit");
    assert_eq!(error.kind, ErrorKind::Limit);
}

/// CRC-32 of PNG chunks.
fn crc32(bytes: &[u8]) -> u32 {
    let step = |crc: u32, byte: &u8| {
        (0..8).fold(
            crc ^ u32::from(*byte),
            |c, _| if c & 1 == 1 { c >> 1 ^ 0xedb8_8320 } else { c >> 1 },
        )
    };
    !bytes.iter().fold(u32::MAX, step)
}

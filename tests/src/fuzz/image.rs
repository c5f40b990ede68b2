//! Images: the texels are as many as the size says, finite, and the same after being stored as PNG.

use std::path::Path;

use compiler::import::{Image, Pixels, decode_image};
use image::{ExtendedColorType, ImageEncoder as _};

use super::mesh::limits;

pub(super) const PNG_WORDS: &[&[u8]] = &[
    b"IHDR",
    b"IDAT",
    b"IEND",
    b"PLTE",
    b"tRNS",
    b"gAMA",
    b"sRGB",
    b"iCCP",
    b"zTXt",
    b"iTXt",
    b"acTL",
    b"\0\0\0\0",
    b"\x7f\xff\xff\xff",
    b"\0\x01\0\0",
];
pub(super) const JPEG_WORDS: &[&[u8]] = &[
    b"\xff\xd8",
    b"\xff\xd9",
    b"\xff\xc0",
    b"\xff\xc2",
    b"\xff\xc4",
    b"\xff\xda",
    b"\xff\xdb",
    b"\xff\xdd",
    b"\xff\xe0",
    b"\xff\xe2",
    b"\xff\xee",
    b"\xff\xd0",
    b"\xff\0",
    b"ICC_PROFILE\0",
    b"Adobe\0",
];
pub(super) const KTX2_WORDS: &[&[u8]] = &[
    b"\xabKTX 20\xbb\r\n\x1a\n",
    b"KTXorientation\0rd\0",
    b"KTXanimData\0",
    b"\x28\xb5\x2f\xfd",
    b"\x02\0\0\0",
    b"\xff\xff\xff\xff",
    b"\0\0\0\0\0\0\0\x80",
    b"\xa3\x01\x01\0",
    b"\xa6\x01\x01\0",
];
pub(super) const HDR_WORDS: &[&[u8]] = &[
    b"#?RADIANCE\n",
    b"FORMAT=32-bit_rle_rgbe\n",
    b"EXPOSURE=",
    b"-Y ",
    b"+X ",
    b"+Y ",
    b"-X ",
    b"\n\n",
    b"\x02\x02",
    b"\x01\x01\x01",
    b"100000",
];
pub(super) const IES_WORDS: &[&[u8]] = &[
    b"IESNA:LM-63-2002\n",
    b"TILT=NONE\n",
    b"TILT=INCLUDE\n",
    b" 0 90 180 270 360\n",
    b" 0 45 90\n",
    b"1e308",
    b"-1",
    b"1000000",
    b"nan",
];
pub(super) const EXR_WORDS: &[&[u8]] = &[
    b"channels\0chlist\0",
    b"compression\0compression\0",
    b"dataWindow\0box2i\0",
    b"lineOrder\0",
    b"tiles\0tiledesc\0",
    b"displayWindow\0",
    b"chunkCount\0int\0",
    b"type\0string\0",
    b"tiledimage",
    b"deepscanline",
    b"R\0",
    b"G\0",
    b"B\0",
    b"A\0",
    b"\xff\xff\xff\xff",
    b"\xff\xff\xff\x7f",
    b"render_id",
    b"sample_ranges",
    b"0..16",
    b"16..48",
    b"seed",
    b"complete",
];

/// PNG, JPEG and KTX2.
pub(super) fn low(_: &Path, bytes: &[u8]) -> Result<(), String> {
    let image = decode(bytes)?;
    assert_whole(&image);
    if let Pixels::Rgba8(texels) = &image.data {
        let mut stored = Vec::new();
        image::codecs::png::PngEncoder::new(&mut stored)
            .write_image(texels, image.width, image.height, ExtendedColorType::Rgba8)
            .expect("what was decoded can be stored");
        let again = decode(&stored).expect("what was stored can be read");
        assert_eq!(
            (again.width, again.height, &again.data),
            (image.width, image.height, &image.data)
        );
    }
    Ok(())
}

/// HDR.
pub(super) fn high(_: &Path, bytes: &[u8]) -> Result<(), String> {
    assert_whole(&decode(bytes)?);
    Ok(())
}

/// EXR.
pub(super) fn exr(_: &Path, bytes: &[u8]) -> Result<(), String> {
    let image = decode_image(bytes, "a", &limits()).map_err(|error| error.to_string())?;
    assert_whole(&image);
    Ok(())
}

/// The image. A panic in a decoder, which the compiler catches, is a finding here: only the B44
/// decoder of `exr` 1.74 is known to subtract without a check, which is why `exr` does not ask.
fn decode(bytes: &[u8]) -> Result<Image, String> {
    decode_image(bytes, "a", &limits()).map_err(|error| {
        let refusal = error.to_string();
        assert!(!refusal.contains("gave up"), "a decoder panicked: {refusal}");
        refusal
    })
}

fn assert_whole(image: &Image) {
    let n_texels = u64::from(image.width) * u64::from(image.height);
    assert!((1..=limits().pixels).contains(&n_texels));
    let length = match &image.data {
        Pixels::Rgba8(bytes) => bytes.len(),
        Pixels::Rgba16F(halves) => {
            // An exponent of ones is infinity or NaN.
            assert!(halves.iter().all(|half| half & 0x7c00 != 0x7c00), "a texel is not finite");
            halves.len()
        }
    };
    assert_eq!(length as u64, 4 * n_texels);
}

/// Recomputes the checksums of chunks, so that damage reaches the decoder behind them.
pub(super) fn repair_png(bytes: &mut [u8]) {
    let mut at = 8;
    while let Some(length) = bytes.get(at..at + 4) {
        let length = length.iter().fold(0_usize, |n, byte| n << 8 | usize::from(*byte));
        let end = at + 8 + length;
        if end + 4 > bytes.len() {
            return;
        }
        let crc = super::seeds::crc32(&bytes[at + 4..end]);
        bytes[end..end + 4].copy_from_slice(&crc.to_be_bytes());
        at = end + 4;
    }
}

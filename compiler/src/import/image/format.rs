//! What the decoders share: which format a file has, the size that it may have, and the memory that it takes.

use super::texels::n_pixels;
use crate::import::budget::{Loan, zeroed};
use crate::import::error::{ErrorKind, ImportError};
use crate::import::file::Limits;
use ::image::ImageDecoder;

/// Formats that are read, by their first bytes.
#[derive(Clone, Copy, PartialEq)]
pub(super) enum Format {
    Png,
    Jpeg,
    WebP,
    Ktx2,
    Hdr,
    Exr,
    Ies,
}

pub(super) fn gave_up(place: &str) -> ImportError {
    ImportError::new(ErrorKind::Image, place, "the image is damaged: its decoder gave up")
        .with_help("open it and save it again with an image editor")
}

pub(super) fn recognise(bytes: &[u8], place: &str) -> Result<Format, ImportError> {
    const KNOWN: [(&[u8], Format); 5] = [
        (b"\x89PNG\r\n\x1a\n", Format::Png),
        (b"\xff\xd8\xff", Format::Jpeg),
        (b"\xabKTX 20\xbb\r\n\x1a\n", Format::Ktx2),
        (b"#?", Format::Hdr),
        (b"\x76\x2f\x31\x01", Format::Exr),
    ];
    const OTHERS: [(&[u8], &str); 8] = [
        (b"GIF8", "GIF"),
        (b"BM", "BMP"),
        (b"II*\0", "TIFF"),
        (b"MM\0*", "TIFF"),
        (b"DDS ", "DDS"),
        (b"\xabKTX", "KTX 1"),
        (b"8BPS", "Photoshop"),
        (b"qoif", "QOI"),
    ];
    // A container that others use too.
    if bytes.starts_with(b"RIFF") && bytes.get(8..12) == Some(b"WEBP") {
        return Ok(Format::WebP);
    }
    if let Some((_, format)) = KNOWN.iter().find(|(magic, _)| bytes.starts_with(magic)) {
        return Ok(*format);
    }
    if is_luminaire(bytes) {
        return Ok(Format::Ies);
    }
    let other = OTHERS.iter().find(|(magic, _)| bytes.starts_with(magic));
    let message = match other {
        Some((_, name)) => {
            format!("this is a {name} image; images are PNG, JPEG, WebP, KTX2, HDR or EXR")
        }
        None if bytes.is_empty() => "the file is empty".to_owned(),
        // Nothing of it is shown: a scene may name any file of its reader.
        None => "this is not a PNG, JPEG, WebP, KTX2, HDR or EXR image".to_owned(),
    };
    Err(ImportError::new(ErrorKind::Image, place, message).with_help("convert it to PNG or EXR"))
}

/// Whether these are the first bytes of a luminaire file: a text with a line `TILT=` before its numbers.
fn is_luminaire(bytes: &[u8]) -> bool {
    const HEAD: usize = 1 << 16;
    let head = &bytes[..bytes.len().min(HEAD)];
    let mut lines = head.split(|byte| *byte == b'\n');
    bytes.starts_with(b"IESNA") || lines.any(|line| line.starts_with(b"TILT="))
}

/// `width` and `height` if they are not zero and within the limit.
pub(super) fn checked_size(
    width: u32,
    height: u32,
    place: &str,
    limits: &Limits,
) -> Result<[u32; 2], ImportError> {
    let n_pixels = u64::from(width) * u64::from(height);
    if n_pixels == 0 {
        return Err(ImportError::new(ErrorKind::Image, place, "the image has no pixels"));
    }
    if n_pixels > limits.pixels {
        let max = limits.pixels;
        let message = format!("the image claims {width} x {height} pixels, the limit is {max}");
        return Err(ImportError::new(ErrorKind::Limit, place, message)
            .with_help("scale it down, or cut it into several images"));
    }
    Ok([width, height])
}

pub(super) fn broken(place: &str, error: &dyn std::fmt::Display) -> ImportError {
    let text = error.to_string();
    let text = text.lines().next().unwrap_or_default();
    ImportError::new(ErrorKind::Image, place, format!("the image is damaged or cut off: {text}"))
}

/// Memory for texels of `bytes` each: those of the image, and those that the pack gets.
pub(super) fn kept(
    size: [u32; 2],
    bytes: u64,
    place: &str,
    limits: &Limits,
) -> Result<Loan, ImportError> {
    limits.memory.take((n_pixels(size) as u64).saturating_mul(2 * bytes), place)
}

/// The channels as they are in the file, and the memory that decoding takes.
pub(super) fn raw<T: bytemuck::Pod>(
    decoder: impl ImageDecoder,
    size: [u32; 2],
    format: Format,
    place: &str,
    limits: &Limits,
) -> Result<(Vec<T>, Loan), ImportError> {
    let n_bytes = decoder.total_bytes();
    // A progressive JPEG keeps its coefficients, 16 bits each, up to four a pixel, until its end; a WebP the planes or the
    // colours that it is made of.
    let planes = matches!(format, Format::Jpeg | Format::WebP);
    let more = if planes { 8 * n_pixels(size) as u64 } else { 0 };
    let loan = limits.memory.take(n_bytes.saturating_add(more), place)?;
    let n = usize::try_from(n_bytes).unwrap_or(usize::MAX) / size_of::<T>();
    let mut values: Vec<T> = zeroed(n, place)?;
    decoder.read_image(bytemuck::cast_slice_mut(&mut values)).map_err(|e| broken(place, &e))?;
    Ok((values, loan))
}

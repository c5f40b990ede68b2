//! Radiance HDR (shared exponent, linear) becomes half floats.

use super::format::{Format, broken, checked_size, kept, raw};
use super::texels::HalfImage;
use crate::import::error::ImportError;
use crate::import::file::Limits;
use ::image::ImageDecoder as _;
use ::image::codecs::hdr::HdrDecoder;
use std::io::Cursor;

/// Width and height by the header, within the limit.
pub(super) fn size(bytes: &[u8], place: &str, limits: &Limits) -> Result<[u32; 2], ImportError> {
    let decoder = HdrDecoder::new(Cursor::new(bytes)).map_err(|e| broken(place, &e))?;
    let (width, height) = decoder.dimensions();
    checked_size(width, height, place, limits)
}

/// Decodes a whole file, its colours times `scale`.
pub(super) fn decode(
    bytes: &[u8],
    place: &str,
    limits: &Limits,
    scale: f32,
) -> Result<HalfImage, ImportError> {
    let decoder = HdrDecoder::new(Cursor::new(bytes)).map_err(|e| broken(place, &e))?;
    let (width, height) = decoder.dimensions();
    let size = checked_size(width, height, place, limits)?;
    let kept = kept(size, 8, place, limits)?;
    let (decoded, _loan) = raw::<f32>(decoder, size, Format::Hdr, place, limits)?;
    let mut image = HalfImage::new(size).check(place)?;
    for (texel_idx, rgb) in decoded.chunks_exact(3).enumerate() {
        image.set(texel_idx, [rgb[0] * scale, rgb[1] * scale, rgb[2] * scale, 1.0]);
    }
    kept.keep();
    Ok(image)
}

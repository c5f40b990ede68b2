//! Radiance HDR (shared exponent, linear) becomes half floats.

use super::{HalfImage, broken, checked_size};
use crate::import::error::ImportError;
use crate::import::file::Limits;
use ::image::codecs::hdr::HdrDecoder;
use ::image::{DynamicImage, ImageDecoder as _};
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
    let decoded = DynamicImage::from_decoder(decoder).map_err(|e| broken(place, &e))?;
    let mut image = HalfImage::new(size);
    for (texel_idx, rgb) in decoded.into_rgb32f().as_raw().chunks_exact(3).enumerate() {
        image.set(texel_idx, [rgb[0] * scale, rgb[1] * scale, rgb[2] * scale, 1.0]);
    }
    Ok(image)
}

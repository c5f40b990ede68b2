//! Film → 8-bit sRGB PNG: exposure, tone curve, encoding, the same bytes on every machine.

use super::picture::{OutputError, Picture};
use image::ImageEncoder as _;
use pack::abi::ToneMap;
use std::io;

/// The tone-mapped picture.
pub fn encode_png(picture: &Picture) -> Result<Vec<u8>, OutputError> {
    let film = &picture.film;
    let pixels = tone_map(&film.means(), picture.meta.exposure, picture.meta.tone_map);
    encode_rgb(&pixels, [film.region.w, film.region.h])
}

/// Pixels, row by row, as a PNG file.
pub(crate) fn encode_rgb(pixels: &[[u8; 3]], size: [u32; 2]) -> Result<Vec<u8>, OutputError> {
    let mut file = Vec::new();
    let encoder = image::codecs::png::PngEncoder::new(io::Cursor::new(&mut file));
    let [w, h] = size;
    let written = encoder.write_image(pixels.as_flattened(), w, h, image::ExtendedColorType::Rgb8);
    written.map_err(|error| OutputError::Encode { message: error.to_string() })?;
    Ok(file)
}

/// Linear radiance → sRGB bytes. `exposure` in stops; `curve`: a `ToneMap` number, unknown ones
/// are `None`.
#[must_use]
pub fn tone_map(means: &[[f64; 3]], exposure: f32, curve: u32) -> Vec<[u8; 3]> {
    let scale = libm::exp2(f64::from(exposure));
    let encoder = SrgbEncoder::new();
    let map: fn(f64) -> f64 = match ToneMap::from_tag(curve) {
        Some(ToneMap::Reinhard) => |x| if x.is_finite() { x / (1.0 + x) } else { 1.0 },
        Some(ToneMap::Aces) => aces,
        Some(ToneMap::None) | None => |x| x,
    };
    means.iter().map(|rgb| rgb.map(|x| encoder.encode(map((x * scale).max(0.0))))).collect()
}

/// Narkowicz 2015, "ACES Filmic Tone Mapping Curve"; approaches 2.51 / 2.43 and is cut at 1 later.
fn aces(x: f64) -> f64 {
    if x > 1e6 {
        return 1.0;
    }
    x * (2.51 * x + 0.03) / (x * (2.43 * x + 0.59) + 0.14)
}

/// Nearest sRGB byte by comparison with the 255 linear values between neighbouring bytes: no
/// rounding of a power function can move a pixel.
struct SrgbEncoder {
    limits: [f64; 255],
}

impl SrgbEncoder {
    fn new() -> Self {
        let mut limits = [0.0; 255];
        for (byte, limit) in (0_u32..).zip(&mut limits) {
            *limit = srgb_to_linear((f64::from(byte) + 0.5) / 255.0);
        }
        Self { limits }
    }

    fn encode(&self, linear: f64) -> u8 {
        let byte = self.limits.partition_point(|limit| *limit <= linear);
        u8::try_from(byte).expect("255 limits make 256 bytes")
    }
}

/// IEC 61966-2-1.
fn srgb_to_linear(x: f64) -> f64 {
    if x <= 0.04045 { x / 12.92 } else { libm::pow((x + 0.055) / 1.055, 2.4) }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn grey(x: f64, exposure: f32, curve: ToneMap) -> u8 {
        tone_map(&[[x; 3]], exposure, curve as u32)[0][0]
    }

    #[test]
    fn every_srgb_byte_comes_back() {
        for byte in 0..=255_u8 {
            let linear = srgb_to_linear(f64::from(byte) / 255.0);
            assert_eq!(grey(linear, 0.0, ToneMap::None), byte);
        }
    }

    #[test]
    fn exposure_doubles_a_stop() {
        assert_eq!(grey(0.25, 1.0, ToneMap::None), grey(0.5, 0.0, ToneMap::None));
        assert_eq!(grey(0.25, -1.0, ToneMap::None), grey(0.125, 0.0, ToneMap::None));
    }

    #[test]
    fn curves_rise_and_stay_in_range() {
        for curve in [ToneMap::None, ToneMap::Reinhard, ToneMap::Aces] {
            let steps: Vec<u8> =
                (-20..40).map(|e| grey(f64::from(1.5_f32.powi(e)), 0.0, curve)).collect();
            assert!(steps.is_sorted(), "{curve:?}");
            assert_eq!(grey(0.0, 0.0, curve), 0);
            assert_eq!(grey(-1.0, 0.0, curve), 0);
            assert!(grey(1e30, 0.0, curve) >= 254, "{curve:?}");
            assert!(grey(f64::INFINITY, 0.0, curve) >= 254, "{curve:?}");
        }
        assert_eq!(grey(1.0, 0.0, ToneMap::Reinhard), grey(0.5, 0.0, ToneMap::None));
    }
}

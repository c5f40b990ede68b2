//! Film → sRGB PNG of 8 or 16 bits: exposure, tone curve, encoding, the same bytes on every machine.

use super::picture::{OutputError, Picture};
use crate::layers::Layer;
use image::ImageEncoder as _;
use pack::abi::ToneMap;
use std::io;

/// The tone-mapped picture, in 8 bits.
pub fn encode_png(picture: &Picture) -> Result<Vec<u8>, OutputError> {
    encode_whole(PngRows::new(&picture.head(), false), picture)
}

/// The tone-mapped picture, in 16 bits.
pub fn encode_png16(picture: &Picture) -> Result<Vec<u8>, OutputError> {
    encode_whole(PngRows::new(&picture.head(), true), picture)
}

fn encode_whole(mut rows: PngRows, picture: &Picture) -> Result<Vec<u8>, OutputError> {
    rows.add(picture);
    rows.finish()
}

/// A PNG that is made some rows at a time.
pub struct PngRows {
    size: [u32; 2],
    has_alpha: bool,
    is_deep: bool,
    curve: Curve,
    encoder: SrgbEncoder,
    bytes: Vec<u8>,
}

impl PngRows {
    /// Of the picture whose head this is; `is_deep`: in 16 bits.
    #[must_use]
    pub fn new(head: &Picture, is_deep: bool) -> Self {
        let most = if is_deep { u16::MAX } else { u16::from(u8::MAX) };
        Self {
            size: [head.film.region.w, head.film.region.h],
            has_alpha: head.layers.as_ref().is_some_and(|layers| layers.has(Layer::Alpha)),
            is_deep,
            curve: Curve::new(head.meta.exposure, head.meta.tone_map),
            encoder: SrgbEncoder::new(most),
            bytes: Vec::new(),
        }
    }

    /// Adds the next rows.
    pub fn add(&mut self, rows: &Picture) {
        let (means, alphas) = straight(rows);
        for (i, rgb) in means.iter().enumerate() {
            for x in rgb {
                self.push(self.encoder.encode(self.curve.of(*x)));
            }
            if self.has_alpha {
                let alpha = alphas.get(i).copied().unwrap_or(1.0);
                self.push(if self.is_deep { sixteen_bits(alpha) } else { eight_bits(alpha) });
            }
        }
    }

    fn push(&mut self, number: u16) {
        // As the encoder of PNGs takes them.
        let bytes = number.to_ne_bytes();
        match u8::try_from(number) {
            Ok(byte) if !self.is_deep => self.bytes.push(byte),
            _ => self.bytes.extend(bytes),
        }
    }

    /// Whether all rows are there.
    #[must_use]
    pub fn is_whole(&self) -> bool {
        let sample = if self.is_deep { 2 } else { 1 };
        let pixel = sample * if self.has_alpha { 4 } else { 3 };
        self.bytes.len() as u64 == u64::from(self.size[0]) * u64::from(self.size[1]) * pixel
    }

    /// The file, once all rows are there.
    pub fn finish(self) -> Result<Vec<u8>, OutputError> {
        let kind = match (self.is_deep, self.has_alpha) {
            (false, false) => image::ExtendedColorType::Rgb8,
            (false, true) => image::ExtendedColorType::Rgba8,
            (true, false) => image::ExtendedColorType::Rgb16,
            (true, true) => image::ExtendedColorType::Rgba16,
        };
        encode_as(&self.bytes, self.size, kind)
    }
}

/// The colours of what is there, not what of it is seen, as PNGs have them; and alpha where it is a layer.
fn straight(picture: &Picture) -> (Vec<[f64; 3]>, Vec<f64>) {
    let layers = picture.layers.as_ref().filter(|layers| layers.has(Layer::Alpha));
    let mut means = picture.shown();
    let alphas = layers.map(|layers| (0..means.len()).map(|i| layers.alpha(i)).collect());
    let alphas: Vec<f64> = alphas.unwrap_or_default();
    for (mean, alpha) in means.iter_mut().zip(&alphas).filter(|(_, alpha)| **alpha > 0.0) {
        *mean = mean.map(|x| x / alpha);
    }
    (means, alphas)
}

/// A share from 0 to 1, which PNGs hold as it is.
#[expect(clippy::cast_possible_truncation, reason = "at most 255")]
fn eight_bits(share: f64) -> u16 {
    (share.clamp(0.0, 1.0) * 255.0).round() as u16
}

#[expect(clippy::cast_possible_truncation, reason = "at most 65535")]
fn sixteen_bits(share: f64) -> u16 {
    (share.clamp(0.0, 1.0) * 65535.0).round() as u16
}

/// Pixels, row by row, as a PNG file.
pub(crate) fn encode_rgb(pixels: &[[u8; 3]], size: [u32; 2]) -> Result<Vec<u8>, OutputError> {
    encode_as(pixels.as_flattened(), size, image::ExtendedColorType::Rgb8)
}

fn encode_as(
    bytes: &[u8],
    [w, h]: [u32; 2],
    kind: image::ExtendedColorType,
) -> Result<Vec<u8>, OutputError> {
    let mut file = Vec::new();
    let encoder = image::codecs::png::PngEncoder::new(io::Cursor::new(&mut file));
    let written = encoder.write_image(bytes, w, h, kind);
    written.map_err(|error| OutputError::Encode { message: error.to_string() })?;
    Ok(file)
}

/// Linear radiance → sRGB bytes. `exposure` in stops; `curve`: a `ToneMap` number, unknown ones
/// are `None`.
#[must_use]
pub fn tone_map(means: &[[f64; 3]], exposure: f32, curve: u32) -> Vec<[u8; 3]> {
    let (encoder, curve) = (SrgbEncoder::new(u16::from(u8::MAX)), Curve::new(exposure, curve));
    let byte = |x| u8::try_from(encoder.encode(curve.of(x))).expect("255 limits make 256 bytes");
    means.iter().map(|rgb| rgb.map(byte)).collect()
}

/// Exposure and tone curve.
struct Curve {
    scale: f64,
    map: fn(f64) -> f64,
}

impl Curve {
    fn new(exposure: f32, curve: u32) -> Self {
        let map: fn(f64) -> f64 = match ToneMap::from_tag(curve) {
            Some(ToneMap::Reinhard) => |x| if x.is_finite() { x / (1.0 + x) } else { 1.0 },
            Some(ToneMap::Aces) => aces,
            Some(ToneMap::None) | None => |x| x,
        };
        Self { scale: libm::exp2(f64::from(exposure)), map }
    }

    fn of(&self, x: f64) -> f64 {
        (self.map)((x * self.scale).max(0.0))
    }
}

/// Narkowicz 2015, "ACES Filmic Tone Mapping Curve"; approaches 2.51 / 2.43 and is cut at 1 later.
fn aces(x: f64) -> f64 {
    if x > 1e6 {
        return 1.0;
    }
    x * (2.51 * x + 0.03) / (x * (2.43 * x + 0.59) + 0.14)
}

/// Nearest sRGB number by comparison with the linear values between neighbouring numbers: no
/// rounding of a power function can move a pixel.
struct SrgbEncoder {
    limits: Vec<f64>,
}

impl SrgbEncoder {
    /// To numbers up to `most`.
    fn new(most: u16) -> Self {
        let limit = |number| srgb_to_linear((f64::from(number) + 0.5) / f64::from(most));
        Self { limits: (0..most).map(limit).collect() }
    }

    fn encode(&self, linear: f64) -> u16 {
        let number = self.limits.partition_point(|limit| *limit <= linear);
        u16::try_from(number).expect("there are at most 65535 limits")
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

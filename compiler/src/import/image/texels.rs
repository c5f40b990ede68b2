//! Texels of an image, and how linear floats become half floats.

use crate::import::budget::{no_memory, zeroed};
use crate::import::error::ImportError;
use half::f16;

/// A decoded image. Row 0 is the top row (v = 1); rows follow without gaps; alpha is straight.
#[derive(Clone, Debug, PartialEq)]
pub struct Image {
    /// Columns, >= 1.
    pub width: u32,
    /// Rows, >= 1.
    pub height: u32,
    /// `width * height` texels of red, green, blue, alpha.
    pub data: Pixels,
    /// Some texel has an alpha below 1.
    pub has_alpha: bool,
    /// Channels that were clamped because they were not finite or beyond what a half float holds.
    pub clamped: u64,
    /// The file holds radiance: it is HDR or EXR.
    pub is_radiance: bool,
}

/// Texels, four channels each.
#[derive(Clone, Debug, PartialEq)]
pub enum Pixels {
    /// Bytes, in the encoding of the file.
    Rgba8(Vec<u8>),
    /// Bits of half floats; finite. Linear for HDR and EXR, in the encoding of the file for PNG.
    Rgba16F(Vec<u16>),
}

pub(super) fn n_pixels([width, height]: [u32; 2]) -> usize {
    width as usize * height as usize
}

/// Collects linear float texels as half floats.
pub(super) struct HalfImage {
    pub(super) size: [u32; 2],
    texels: Vec<u16>,
    has_alpha: bool,
    clamped: u64,
    /// The largest finite colour channel, and the first that is negative or not finite, with its texel.
    pub(super) largest: f32,
    pub(super) bad: Option<(usize, f32)>,
}

impl HalfImage {
    /// All texels transparent black; no texels where there is no memory for them.
    pub(super) fn new(size: [u32; 2]) -> Self {
        Self {
            size,
            texels: zeroed(4 * n_pixels(size), "").unwrap_or_default(),
            has_alpha: false,
            clamped: 0,
            largest: 0.0,
            bad: None,
        }
    }

    /// Sets one texel; a position outside is ignored.
    pub(super) fn set(&mut self, texel_idx: usize, rgba: [f32; 4]) {
        for value in &rgba[..3] {
            if *value >= 0.0 && value.is_finite() {
                self.largest = self.largest.max(*value);
            } else if self.bad.is_none_or(|(first, _)| texel_idx < first) {
                self.bad = Some((texel_idx, *value));
            }
        }
        let mut bits = [0; 4];
        for (bits, value) in bits.iter_mut().zip(rgba) {
            let (half, fits) = to_half(value);
            *bits = half;
            self.clamped += u64::from(!fits);
        }
        self.has_alpha |= rgba[3] < 1.0;
        if let Some(texel) = self.texels.get_mut(4 * texel_idx..4 * texel_idx + 4) {
            texel.copy_from_slice(&bits);
        }
    }

    /// Whether it has its texels.
    pub(super) fn check(self, place: &str) -> Result<Self, ImportError> {
        let n = 4 * n_pixels(self.size);
        if self.texels.len() == n { Ok(self) } else { Err(no_memory(2 * n, place)) }
    }

    pub(super) fn finish(self) -> Image {
        Image {
            width: self.size[0],
            height: self.size[1],
            data: Pixels::Rgba16F(self.texels),
            has_alpha: self.has_alpha,
            clamped: self.clamped,
            is_radiance: true,
        }
    }
}

/// Bits of the nearest finite half float, and whether the value was within range. NaN becomes 0.
fn to_half(value: f32) -> (u16, bool) {
    const MAX: f32 = 65504.0;
    if value.is_nan() {
        return (0, false);
    }
    (f16::from_f32(value.clamp(-MAX, MAX)).to_bits(), value.abs() <= MAX)
}

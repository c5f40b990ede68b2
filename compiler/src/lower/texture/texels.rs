//! Pixels of an image file become the texels of a pack: words, and their mean.
//!
//! It does not know which textures there are, nor which materials read them.

use lang::scene::ColorSpace;
use pack::abi::TextureFormat;

use crate::import::{Image, Pixels};
use crate::lower::light::luminance;

/// A texture on its way into the pack.
pub(super) struct Made {
    /// Width and height, texels.
    pub(super) size: [u32; 2],
    pub(super) format: TextureFormat,
    /// Texels as the kernel reads them, row by row from the top: one word each, or two for half floats.
    pub(super) words: Vec<u32>,
    /// Mean of red, green, blue, alpha over all texels, linear.
    pub(super) mean: [f64; 4],
}

/// An image as large as the largest of those that its channels come from.
pub(super) fn gather(channels: [Option<(&Image, u8)>; 4], space: ColorSpace) -> Made {
    let largest = |side: fn(&Image) -> u32| channels.iter().flatten().map(|(i, _)| side(i)).max();
    let size = [largest(|i| i.width).unwrap_or(1), largest(|i| i.height).unwrap_or(1)];
    let mut bytes = Vec::with_capacity(4 * size[0] as usize * size[1] as usize);
    for y in 0..size[1] {
        for x in 0..size[0] {
            bytes.extend(channels.map(|channel| {
                channel.map_or(u8::MAX, |(image, channel)| nearest(image, [x, y], size, channel))
            }));
        }
    }
    let (format, mean) = match space {
        ColorSpace::Srgb => (TextureFormat::Rgba8Srgb, byte_mean(&bytes, srgb_to_linear)),
        ColorSpace::Linear | ColorSpace::Data => {
            (TextureFormat::Rgba8Linear, byte_mean(&bytes, |x| x))
        }
    };
    Made { size, format, words: byte_words(&bytes), mean }
}

/// A whole image whose numbers are to be read as `space` says.
pub(super) fn whole(source: &Image, space: ColorSpace) -> Made {
    let (format, words, mean) = match (&source.data, space) {
        (Pixels::Rgba8(bytes), ColorSpace::Srgb) => {
            (TextureFormat::Rgba8Srgb, byte_words(bytes), byte_mean(bytes, srgb_to_linear))
        }
        (Pixels::Rgba8(bytes), ColorSpace::Linear | ColorSpace::Data) => {
            (TextureFormat::Rgba8Linear, byte_words(bytes), byte_mean(bytes, |x| x))
        }
        (Pixels::Rgba16F(bits), space) => {
            let decode = if space == ColorSpace::Srgb { srgb_to_linear } else { |x| x };
            let (words, mean) = half_words(bits, decode);
            (TextureFormat::Rgba16Float, words, mean)
        }
    };
    Made { size: [source.width, source.height], format, words, mean }
}

/// Images of the sky are radiance, or pictures with the sRGB curve.
pub(super) fn space_of(is_radiance: bool) -> ColorSpace {
    if is_radiance { ColorSpace::Linear } else { ColorSpace::Srgb }
}

/// Luminance of each texel of a row of an image of the sky.
pub(in crate::lower) fn luminances(image: &Image, row: usize) -> Vec<f64> {
    let width = image.width as usize;
    let decode = if image.is_radiance { |x| x } else { srgb_to_linear };
    let texels = 4 * row * width..4 * (row + 1) * width;
    let light = |rgb: [f64; 3]| luminance(rgb.map(decode));
    match &image.data {
        Pixels::Rgba8(bytes) => {
            let value = |byte: u8| f64::from(byte) / 255.0;
            let texels = bytes[texels].as_chunks::<4>().0.iter();
            texels.map(|[r, g, b, _]| light([*r, *g, *b].map(value))).collect()
        }
        Pixels::Rgba16F(bits) => {
            let value = |bits: u16| f64::from(half::f16::from_bits(bits).to_f32());
            let texels = bits[texels].as_chunks::<4>().0.iter();
            texels.map(|[r, g, b, _]| light([*r, *g, *b].map(value))).collect()
        }
    }
}

/// The linear value of each sRGB byte (IEC 61966-2-1), as the SRGBLUT section holds it.
#[must_use]
pub fn srgb_table() -> [f32; 256] {
    std::array::from_fn(|byte| srgb_to_linear(byte as f64 / 255.0) as f32)
}

fn srgb_to_linear(x: f64) -> f64 {
    if x <= 0.04045 { x / 12.92 } else { libm::pow((x + 0.055) / 1.055, 2.4) }
}

fn byte_words(bytes: &[u8]) -> Vec<u32> {
    bytes.as_chunks::<4>().0.iter().map(|texel| u32::from_le_bytes(*texel)).collect()
}

/// Mean over texels; `decode` is applied to the colour channels only.
fn byte_mean(bytes: &[u8], decode: fn(f64) -> f64) -> [f64; 4] {
    let mut counts = [[0_u64; 256]; 4];
    for texel in bytes.as_chunks::<4>().0 {
        for (count, byte) in counts.iter_mut().zip(texel) {
            count[usize::from(*byte)] += 1;
        }
    }
    let texels = (bytes.len() / 4).max(1) as f64;
    [0, 1, 2, 3].map(|k| {
        let value = |byte: usize| byte as f64 / 255.0;
        let decoded = |byte| if k < 3 { decode(value(byte)) } else { value(byte) };
        let sum: f64 = (0..256).map(|byte| counts[k][byte] as f64 * decoded(byte)).sum();
        sum / texels
    })
}

/// Two words a texel, colour channels decoded; and the mean.
fn half_words(bits: &[u16], decode: fn(f64) -> f64) -> (Vec<u32>, [f64; 4]) {
    let mut words = Vec::with_capacity(bits.len() / 2);
    let mut sum = [0.0; 4];
    for texel in bits.as_chunks::<4>().0 {
        let mut halves = *texel;
        for (k, half) in halves.iter_mut().enumerate() {
            let raw = f64::from(half::f16::from_bits(*half).to_f32());
            let value = if k < 3 { decode(raw) } else { raw };
            if value.to_bits() != raw.to_bits() {
                *half = half::f16::from_f64(value).to_bits();
            }
            sum[k] += value;
        }
        words.push(u32::from(halves[0]) | u32::from(halves[1]) << 16);
        words.push(u32::from(halves[2]) | u32::from(halves[3]) << 16);
    }
    let texels = (bits.len() / 4).max(1) as f64;
    (words, sum.map(|s| s / texels))
}

/// The texel of `image` at the place of texel `at` of a picture of `size`, one channel as a byte.
fn nearest(image: &Image, at: [u32; 2], size: [u32; 2], channel: u8) -> u8 {
    let scale =
        |x: u32, to: u32, from: u32| (u64::from(x) * u64::from(to) / u64::from(from)) as usize;
    let (x, y) = (scale(at[0], image.width, size[0]), scale(at[1], image.height, size[1]));
    let index = 4 * (y * image.width as usize + x) + usize::from(channel);
    match &image.data {
        Pixels::Rgba8(bytes) => bytes[index],
        Pixels::Rgba16F(bits) => {
            let value = half::f16::from_bits(bits[index]).to_f32();
            (value.clamp(0.0, 1.0) * 255.0 + 0.5) as u8
        }
    }
}

/// The least number in a channel of an image, as a texture of it may hold it: bytes round down.
pub(super) fn least(image: &Image, channel: u8) -> f32 {
    let channel = usize::from(channel);
    match &image.data {
        Pixels::Rgba8(bytes) => {
            let texels = bytes.as_chunks::<4>().0.iter();
            let least = texels.map(|texel| texel[channel]).min().unwrap_or(u8::MAX);
            f32::from(least) / 255.0
        }
        Pixels::Rgba16F(bits) => {
            let texels = bits.as_chunks::<4>().0.iter();
            let values = texels.map(|texel| half::f16::from_bits(texel[channel]).to_f32());
            // `f32::min` would forget a NaN.
            let least = |a: f32, b: f32| if b < a || b.is_nan() { b } else { a };
            libm::floorf(values.fold(1.0, least) * 255.0) / 255.0
        }
    }
}

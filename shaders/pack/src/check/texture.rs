//! Texel values, where a format can hold a bad one.
//!
//! Turns the texel section into the first half float that is not finite, and the sRGB table into
//! its first value that cannot be one. Textures may share texels, so ranges are merged first:
//! no texel is read twice.

use rayon::prelude::*;

use crate::abi::{Texture, TextureFormat};
use crate::contents::Contents;
use crate::error::{PackError, Place};
use crate::fault::ElementFault;
use crate::kind::Kind;

use super::broken::CHUNK;

/// All texels; every range is inside TEXEL already.
pub(super) fn check(contents: &Contents<'_>) -> Result<(), PackError> {
    srgb_table(contents.srgb)?;
    for range in half_float_ranges(contents.textures) {
        half_floats(contents.texels, range)?;
    }
    Ok(())
}

/// 256 values between 0 and 1 that never fall.
fn srgb_table(values: &[f32]) -> Result<(), PackError> {
    let mut before = 0.0;
    for (value_index, found) in values.iter().copied().enumerate() {
        if !(before..=1.0).contains(&found) {
            let expected = "0 to 1 and not less than the value before";
            return Err(word(Kind::SRGBLUT, value_index, ElementFault::Range { found, expected }));
        }
        before = found;
    }
    Ok(())
}

/// Words of half-float textures, sorted and merged.
fn half_float_ranges(textures: &[Texture]) -> Vec<std::ops::Range<usize>> {
    let mut ranges: Vec<std::ops::Range<usize>> = textures
        .iter()
        .filter(|texture| texture.format == TextureFormat::Rgba16Float as u32)
        .filter_map(|texture| {
            let first = texture.offset as usize;
            Some(first..first + usize::try_from(texture.words()?).ok()?)
        })
        .collect();
    ranges.sort_by_key(|range| (range.start, range.end));
    let mut merged: Vec<std::ops::Range<usize>> = Vec::with_capacity(ranges.len());
    for range in ranges {
        match merged.last_mut() {
            Some(last) if range.start <= last.end => last.end = last.end.max(range.end),
            _ => merged.push(range),
        }
    }
    merged
}

/// No half float of these words is NaN or infinite.
fn half_floats(texels: &[[u32; 4]], range: std::ops::Range<usize>) -> Result<(), PackError> {
    let words = texels.get(range.clone()).unwrap_or_default();
    let bad = words.par_chunks(CHUNK).enumerate().find_map_first(|(chunk, words)| {
        // One pass without branches; the position is only looked for when there is one.
        let any = words.as_flattened().iter().fold(false, |any, pair| any | not_finite(*pair));
        any.then(|| {
            let at = words.as_flattened().iter().position(|pair| not_finite(*pair)).unwrap_or(0);
            let first = (range.start + chunk * CHUNK) * 4;
            (first + at, words.as_flattened()[at])
        })
    });
    let Some((at, pair)) = bad else { return Ok(()) };
    let high = is_bad_half(pair >> 16) && !is_bad_half(pair);
    let half = if high { pair >> 16 } else { pair & 0xffff };
    let nan = half & 0x3ff != 0;
    let sign = if half & 0x8000 != 0 { -1.0 } else { 1.0 };
    let found = sign * if nan { f32::NAN } else { f32::INFINITY };
    Err(word(Kind::TEXEL, at, ElementFault::NotFinite(found)))
}

fn is_bad_half(bits: u32) -> bool {
    bits & 0x7c00 == 0x7c00
}

fn not_finite(pair: u32) -> bool {
    is_bad_half(pair) || is_bad_half(pair >> 16)
}

/// The error for a 32-bit word of a section of 16-byte elements.
fn word(kind: Kind, word: usize, fault: ElementFault) -> PackError {
    const LANES: [&str; 4] = ["word 0", "word 1", "word 2", "word 3"];
    let at = Place { kind, index: word / 4, offset: word * 4 };
    PackError::Element { at, field: LANES[word % 4], fault }
}

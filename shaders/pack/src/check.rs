//! Checks what the sections mean, after `table` has proven where they are.
//!
//! Turns typed slices into the first broken rule, always the same one whatever the number of
//! threads: relations between sections, then every field of every record (`rules`), textures, lights, sky and
//! motion, then the trees, then the feature bits. Linear time, no allocation beyond a bit a primitive, a byte
//! a light and a word a node.

mod albedo;
mod broken;
mod expression;
mod light_tree;
mod mix;
mod motion;
mod rule;
mod rules;
mod sky;
mod texture;
mod tree;

use rayon::prelude::*;

use crate::abi::{self, LightKind, TextureFormat};
use crate::contents::Contents;
use crate::error::PackError;
use crate::fault::{ElementFault, HeaderFault};
use crate::features;
use crate::kind::Kind;
use broken::{CHUNK, element};
use rules::Ruled;

/// Checks everything; `features` are the header's.
pub(crate) fn contents(contents: &Contents<'_>, features: u64) -> Result<(), PackError> {
    sections(contents)?;
    let (records, tree) = rayon::join(|| records(contents), || tree::check(contents));
    records.and(tree)?;
    let expected = features::of(contents);
    if features == expected {
        Ok(())
    } else {
        Err(HeaderFault::Features { found: features, expected }.into())
    }
}

/// Which sections need each other, and which counts agree.
fn sections(contents: &Contents<'_>) -> Result<(), PackError> {
    let equal = |left, left_count: usize, right, right_count: usize| {
        let (left_count, right_count) = (left_count as u64, right_count as u64);
        if left_count == right_count {
            Ok(())
        } else {
            Err(PackError::CountMismatch { left, left_count, right, right_count })
        }
    };
    equal(
        "the number of TRISHADE elements",
        contents.shades.len(),
        "the number of TRIANGLE elements",
        contents.triangles.len(),
    )?;
    equal(
        "RENDER.n_lights",
        contents.render.n_lights as usize,
        "the number of LIGHT elements",
        contents.lights.len(),
    )?;
    let is_srgb = |format: u32| format == TextureFormat::Rgba8Srgb as u32;
    let srgb = contents.textures.iter().any(|texture| is_srgb(texture.format));
    match (srgb, contents.srgb.is_empty()) {
        (true, true) => {
            let because = ", a texture is Rgba8Srgb";
            return Err(PackError::Missing { kind: Kind::SRGBLUT, because });
        }
        (false, false) => {
            let because = ", no texture is Rgba8Srgb";
            return Err(PackError::Unwanted { kind: Kind::SRGBLUT, because });
        }
        _ => {}
    }
    if contents.textures.is_empty() && !contents.texels.is_empty() {
        let because = ", there are no textures";
        return Err(PackError::Unwanted { kind: Kind::TEXEL, because });
    }
    std::str::from_utf8(contents.kernel)
        .map_err(|error| PackError::KernelNotUtf8 { at: error.valid_up_to() })?;
    Ok(())
}

/// Every field of every record but the tree's, then what spans several records.
fn records(contents: &Contents<'_>) -> Result<(), PackError> {
    each(std::slice::from_ref(contents.render), contents)?;
    each(std::slice::from_ref(contents.camera), contents)?;
    each(contents.sky.map_or(&[], std::slice::from_ref), contents)?;
    each(contents.triangles, contents)?;
    each(contents.shades, contents)?;
    each(contents.vertex_colors, contents)?;
    each(contents.spheres, contents)?;
    each(contents.materials, contents)?;
    each(contents.objects, contents)?;
    each(contents.links, contents)?;
    each(contents.motion, contents)?;
    each(contents.camera_keys, contents)?;
    each(contents.instances, contents)?;
    each(contents.media, contents)?;
    each(contents.lights, contents)?;
    light_table(contents)?;
    each(contents.light_nodes, contents)?;
    light_tree::check(contents)?;
    sky::check(contents)?;
    albedo::check(contents)?;
    mix::check(contents)?;
    each(contents.textures, contents)?;
    texture::check(contents)?;
    expression::check(contents)?;
    motion::check(contents)
}

/// Applies the rules of a record type to all its records; reports the first that breaks one.
fn each<R: Ruled>(records: &[R], contents: &Contents<'_>) -> Result<(), PackError> {
    let broken = records.par_chunks(CHUNK).enumerate().find_map_first(|(chunk, records)| {
        (chunk * CHUNK..)
            .zip(records)
            .find_map(|(index, record)| Some((index, record.broken(contents)?)))
    });
    broken.map_or(Ok(()), |(index, broken)| Err(element::<R>(index, broken)))
}

/// Cumulative probabilities rise and end at 1, and directional lights come first.
fn light_table(contents: &Contents<'_>) -> Result<(), PackError> {
    let fault = |index, fault| Err(element::<crate::abi::Light>(index, ("cdf", fault)));
    for (index, pair) in contents.lights.windows(2).enumerate() {
        let (before, found) = (pair[0].cdf, pair[1].cdf);
        if found < before {
            return fault(index + 1, ElementFault::Falling { found, before });
        }
    }
    let directional = LightKind::Directional as u32;
    let behind = |pair: &[abi::Light]| pair[0].kind != directional && pair[1].kind == directional;
    if let Some(index) = contents.lights.windows(2).position(behind) {
        return Err(element::<abi::Light>(index + 1, ("kind", ElementFault::NotFirst)));
    }
    match contents.lights {
        [.., last] if last.cdf.to_bits() != 1.0f32.to_bits() => {
            fault(contents.lights.len() - 1, ElementFault::LastCdf(last.cdf))
        }
        _ => Ok(()),
    }
}

//! Where a surface with an alpha texture is there, and where it is cut out, as far as a small map tells.
//!
//! Turns the texels of an image into one of three answers for each square of them: everywhere there, everywhere cut out,
//! or ask the texture. A map stays in the caches, which an image does not. It gives no answer that `alpha_exists` would
//! not give: the texels that a lookup mixes are found as in `texture/bilinear.wgsl`.

use crate::kernel::{Kernel, NONE, Ray};
use glam::Vec2;
use pack::abi::{Material, Texture, TextureFormat, Wrap, material_flag};
use rayon::prelude::*;
use std::collections::BTreeMap;

/// Squares along the longer side of an image, at most, but for the one that begins at its last texel.
const MOST_SQUARES: u32 = 256;

/// The least side of a square, in texels: two to this power.
const LEAST_SIDE: u32 = 2;

/// More than the rounding of a lookup, relative to alpha.
const SLACK: f32 = 1e-5;

/// Answers; `&` joins those of two texels.
const THERE: u8 = 1;
const CUT: u8 = 2;

/// Alpha below this loses more than `SLACK` to rounding.
const LEAST_ALPHA: f32 = 1e-30;

/// Maps of the materials that have one.
#[derive(Debug, Default)]
pub(super) struct AlphaMaps {
    /// For each material its place in `maps`, or none.
    of: Vec<Option<usize>>,
    maps: Vec<AlphaMap>,
}

impl AlphaMaps {
    /// Those of materials that clip alpha by an image of bytes; `texels` are the words of all images.
    pub(super) fn new(materials: &[Material], textures: &[Texture], texels: &[u32]) -> Self {
        let mut known = BTreeMap::new();
        let mut maps = Vec::new();
        let of = materials.iter().map(|material| {
            let texture = clipped_by(material, textures)?;
            let Material { alpha_texture, alpha, alpha_cutoff, .. } = *material;
            let same = (alpha_texture, alpha.to_bits(), alpha_cutoff.to_bits());
            let place = *known.entry(same).or_insert(maps.len());
            if place == maps.len() {
                maps.push(AlphaMap::new(material, texture, texels));
            }
            Some(place)
        });
        let of = of.collect();
        Self { of, maps }
    }

    /// Whether a hit on triangle `i`, at weights `b` of its corners, counts: what `candidate_triangle` says.
    pub(super) fn is_candidate(&self, kernel: &mut Kernel<'_>, i: u32, b: Vec2, ray: &Ray) -> bool {
        self.tell(kernel, i, b, ray).unwrap_or_else(|| kernel.candidate_triangle(i, b, *ray))
    }

    /// The same as far as a map tells.
    fn tell(&self, kernel: &mut Kernel<'_>, i: u32, b: Vec2, ray: &Ray) -> Option<bool> {
        if self.maps.is_empty() || ray.light != NONE && kernel.load_tri_shade_light(i) == ray.light
        {
            return None;
        }
        let own = kernel.load_tri_shade_material(i);
        let material = kernel.dispatch_placed_material(ray.instance, own);
        let place = self.of.get(material as usize).copied().flatten()?;
        let map = self.maps.get(place)?;
        let uv = kernel.triangle_texture_point(i, b).uv;
        map.tell(kernel, uv)
    }
}

/// The map of one material.
#[derive(Debug)]
struct AlphaMap {
    columns: Axis,
    rows: Axis,
    /// The answers of four squares each.
    squares: Vec<u8>,
}

impl AlphaMap {
    fn new(material: &Material, texture: &Texture, texels: &[u32]) -> Self {
        let side = (texture.width.max(texture.height) / MOST_SQUARES).next_power_of_two().ilog2();
        let side = side.max(LEAST_SIDE);
        let columns = Axis { texels: texture.width, wrap: texture.wrap_u, side };
        let rows = Axis { texels: texture.height, wrap: texture.wrap_v, side };
        let answers = answers(material);
        let first = 4 * texture.offset as usize;
        let at = |x: u32, y: u32| {
            let texel = texels.get(first + y as usize * texture.width as usize + x as usize);
            texel.map_or(0, |texel| answers[(texel >> 24) as usize])
        };
        let answer = |x: u32, y: u32| {
            rows.mixed(y).fold(THERE | CUT, |all, row| {
                columns.mixed(x).fold(all, |all, column| all & at(column, row))
            })
        };
        let of_row = |y: u32| {
            let answer = &answer;
            (0..columns.squares()).map(move |x| answer(x, y))
        };
        let all: Vec<u8> = (0..rows.squares()).into_par_iter().flat_map_iter(of_row).collect();
        let packed = |four: &[u8]| four.iter().rev().fold(0, |byte, answer| byte << 2 | answer);
        let squares = all.chunks(4).map(packed).collect();
        Self { columns, rows, squares }
    }

    /// Whether the surface is there at texture coordinates `uv`, if the map tells.
    fn tell(&self, kernel: &mut Kernel<'_>, uv: Vec2) -> Option<bool> {
        let x = self.columns.square(kernel, uv.x)?;
        let y = self.rows.square(kernel, 1.0 - uv.y)?;
        let k = y as usize * self.columns.squares() as usize + x as usize;
        match self.squares.get(k / 4)? >> (2 * (k % 4)) & (THERE | CUT) {
            THERE => Some(true),
            CUT => Some(false),
            _ => None,
        }
    }
}

/// The image of bytes that alone clips `material`.
fn clipped_by<'a>(material: &Material, textures: &'a [Texture]) -> Option<&'a Texture> {
    let both = material_flag::ALPHA_CLIP | material_flag::ALPHA_BLEND;
    let texture = textures.get(material.alpha_texture as usize)?;
    let is_bytes = match TextureFormat::from_tag(texture.format)? {
        TextureFormat::Rgba8Srgb | TextureFormat::Rgba8Linear => true,
        TextureFormat::Rgba16Float | TextureFormat::Expression => false,
    };
    let clips = material.flags & both == material_flag::ALPHA_CLIP;
    (is_bytes && clips && material.alpha >= LEAST_ALPHA).then_some(texture)
}

/// What each alpha of a texel tells if all texels of a lookup have it.
fn answers(material: &Material) -> [u8; 256] {
    let mut bytes = 0_u8..=u8::MAX;
    [(); 256].map(|()| {
        // As in `texture/rgba8.wgsl`.
        let alpha = material.alpha * (f32::from(bytes.next().unwrap_or_default()) * 0.003_921_569);
        let there = alpha * (1.0 - SLACK) >= material.alpha_cutoff;
        let cut = alpha * (1.0 + SLACK) < material.alpha_cutoff;
        (u8::from(there) * THERE) | (u8::from(cut) * CUT)
    })
}

/// One axis of an image, cut into squares. Lookups are in the same one if the first texels that they mix are: the one
/// before the image and the next ones are in the first square, and so on.
#[derive(Debug)]
struct Axis {
    texels: u32,
    wrap: u32,
    /// The side of a square, in texels: two to this power.
    side: u32,
}

impl Axis {
    fn squares(&self) -> u32 {
        (self.texels >> self.side) + 1
    }

    /// The texels that lookups in a square mix.
    fn mixed(&self, square: u32) -> impl Iterator<Item = u32> + Clone + '_ {
        let first = square << self.side;
        let last = (first + (1 << self.side)).min(self.texels + 1);
        (first..=last).map(|after| self.texel(after))
    }

    /// The texel before the one that would have the number `after`, as `bilinear_index`.
    fn texel(&self, after: u32) -> u32 {
        let last = self.texels - 1;
        match after.checked_sub(1) {
            Some(i) if i <= last => i,
            Some(_) if self.wrap == Wrap::Repeat as u32 => 0,
            None if self.wrap != Wrap::Repeat as u32 => 0,
            _ => last,
        }
    }

    /// The square of a lookup at `u`, unless that is no number.
    #[expect(clippy::cast_possible_truncation, reason = "what is too large is the last one")]
    fn square(&self, kernel: &mut Kernel<'_>, u: f32) -> Option<u32> {
        let at = kernel.bilinear_unit(u, self.wrap) * self.texels as f32 - 0.5;
        // From -0.5, so that the number after the first texel is none below 0.
        let whole = at as i32;
        let after = whole + i32::from(whole as f32 <= at);
        (!at.is_nan()).then_some(after.cast_unsigned() >> self.side)
    }
}

#[cfg(test)]
mod tests;

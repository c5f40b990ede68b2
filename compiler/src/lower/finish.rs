//! The last part of lowering: records that follow from lights, materials and settings, not from geometry.

use glam::DVec3;
use lang::diagnostic::{Code, Diagnostic};
use lang::scene::{Film, Filter, Sampler, Scene, ToneMap};
use pack::abi::{self, material_flag};

use super::hidden;
use super::light_tree;
use super::material::MaterialTable;
use super::sky::LoweredSky;
use super::sky_table::SkyTable;

use crate::normalize::Normalization;
use crate::stage::{KeyOf, Stages};

/// Whether any material asks about the thing that it is on.
pub(super) fn asks_about_objects(materials: &[abi::Material]) -> bool {
    materials.iter().any(|material| material.flags & material_flag::OBJECT != 0)
}

/// The tree of lights where there are many; tells each light its trail. `motion`: how far a light comes while the
/// shutter is open; `faint`: lights that count less, see `hidden.rs`, or empty. Where the primitives of lights are is
/// nothing to the tree.
pub(super) fn light_tree(
    lights: &mut [abi::Light],
    faint: &[bool],
    materials: &[abi::Material],
    motion: impl Fn(&abi::Light) -> [DVec3; 2],
    stages: &Stages,
) -> Vec<abi::LightNode> {
    if !(light_tree::FROM..=light_tree::UP_TO).contains(&lights.len()) {
        return Vec::new();
    }
    let flags = |material: u32| materials[material as usize].flags;
    let both_sides = |material| flags(material) & material_flag::EMIT_BOTH_SIDES != 0;
    let mut key = KeyOf::stage("tree of lights");
    let is_faint = |i: usize| faint.get(i).copied().unwrap_or(false);
    for (i, light) in lights.iter().enumerate() {
        key.number(is_faint(i));
        let light = abi::Light { trail: 0, primitive: 0, ..*light };
        key.bytes(bytemuck::bytes_of(&light));
        for end in motion(&light) {
            key.floats(&end.to_array());
        }
        key.number(light.has_surface() && both_sides(light.material));
    }
    let key = key.end();
    if let Some(((), pack)) = stages.in_pack(key) {
        for (light, made) in lights.iter_mut().zip(pack.records::<abi::Light>()) {
            light.trail = made.trail;
        }
        return pack.records().to_vec();
    }
    let factor = |i: usize| if is_faint(i) { hidden::HIDDEN } else { 1.0 };
    let (nodes, trails) = light_tree::tree(lights, both_sides, motion, factor);
    for (light, trail) in lights.iter_mut().zip(trails) {
        light.trail = trail;
    }
    stages.put_in_pack(key, &());
    nodes
}

/// The sky, told which light it is and how large its table; and the table, in words.
pub(super) fn sky_records(
    sky: Option<LoweredSky>,
    lights: &[abi::Light],
) -> (Option<abi::Sky>, Vec<[f32; 4]>) {
    let Some(LoweredSky { record, table }) = sky else { return (None, Vec::new()) };
    let light = lights.iter().position(|light| light.kind == abi::LightKind::Sky as u32);
    let (Some(SkyTable { columns, rows, mut values, .. }), Some(light)) = (table, light) else {
        return (Some(record), Vec::new());
    };
    values.resize(values.len().next_multiple_of(4), 0.0);
    let words = values.as_chunks::<4>().0.to_vec();
    (Some(abi::Sky { light: light as u32, rows, columns, ..record }), words)
}

/// A scene without any light is an error.
pub(super) fn darkness(
    scene: &Scene,
    lights: &[abi::Light],
    materials: &MaterialTable<'_>,
    sky: Option<&abi::Sky>,
) -> Option<Diagnostic> {
    let dark = lights.is_empty() && sky.is_none() && !materials.has_partial_glow();
    dark.then(|| {
        Diagnostic::error(Code("E0710"), "nothing in this scene gives light")
            .at(scene.render.name.span, "this picture would be black")
            .with_help("add a `light`, a `sky`, or an instance with an `emissive` material")
    })
}

/// Everything that holds for the whole picture. The tree: its root and the stack that it needs. Media: those that
/// the camera is inside of, then the one around everything and the fog.
pub(super) fn settings(
    scene: &Scene,
    frame: &Normalization,
    (root, stack_need): (u32, u32),
    (inside, [air, fog]): ([u32; 4], [u32; 2]),
    n_lights: usize,
) -> abi::RenderSettings {
    let tone_map = match scene.film.tone_map {
        ToneMap::None => abi::ToneMap::None,
        ToneMap::Reinhard => abi::ToneMap::Reinhard,
        ToneMap::Aces => abi::ToneMap::Aces,
    };
    let sampler = match scene.render.sampler {
        Sampler::Sobol => abi::SamplerKind::Sobol,
        Sampler::Pcg => abi::SamplerKind::Pcg,
    };
    let (filter, filter_width) = filter(&scene.film);
    abi::RenderSettings {
        image_size: scene.film.size,
        samples: scene.render.samples,
        max_depth: scene.render.max_depth.unwrap_or(abi::UNLIMITED_DEPTH),
        roulette_depth: scene.render.roulette_depth,
        seed: scene.render.seed,
        exposure: scene.film.exposure as f32,
        tone_map: tone_map as u32,
        root,
        stack_need,
        air,
        fog,
        inside,
        scale_bits: abi::f64_bits(frame.scale()),
        center_x_bits: abi::f64_bits(frame.center[0]),
        center_y_bits: abi::f64_bits(frame.center[1]),
        center_z_bits: abi::f64_bits(frame.center[2]),
        n_lights: n_lights as u32,
        sampler: sampler as u32,
        filter: filter as u32,
        filter_width,
    }
}

/// Kind and width of the pixel filter. The kernel need not ask for the width of a box of one pixel.
#[expect(clippy::cast_possible_truncation, reason = "rounded once")]
fn filter(film: &Film) -> (abi::FilterKind, f32) {
    let kind = match film.filter {
        Filter::Box if (film.filter_width - 1.0).abs() <= 0.0 => {
            return (abi::FilterKind::Pixel, 0.0);
        }
        Filter::Box => abi::FilterKind::Box,
        Filter::Tent => abi::FilterKind::Tent,
        Filter::Gaussian => abi::FilterKind::Gaussian,
        Filter::BlackmanHarris => abi::FilterKind::BlackmanHarris,
    };
    (kind, film.filter_width as f32)
}

//! The last part of lowering: records that follow from lights, materials and settings, not from geometry.

use glam::DVec3;
use lang::diagnostic::{Code, Diagnostic};
use lang::scene::{Name, Sampler, Scene, ToneMap};
use lang::source::Span;
use pack::Pack;
use pack::abi::{self, material_flag};

use super::light_tree;
use super::material::MaterialRef;
use super::object::Thing;
use super::sky::LoweredSky;
use super::sky_table::SkyTable;
use crate::normalize::Normalization;

/// The things of the scene, if one of them `moves` or any material asks about them.
pub(super) fn objects(
    things: &[Thing],
    materials: &[abi::Material],
    frame: &Normalization,
    moves: bool,
) -> Vec<abi::Object> {
    let asked = materials.iter().any(|material| material.flags & material_flag::OBJECT != 0);
    if !asked && !moves {
        return Vec::new();
    }
    things.iter().map(|thing| thing.record(frame)).collect()
}

/// The tree of lights where there are many; tells each light its trail. `motion`: how far a light comes while the
/// shutter is open.
pub(super) fn light_tree(
    lights: &mut [abi::Light],
    materials: &[abi::Material],
    motion: impl Fn(&abi::Light) -> DVec3,
) -> Vec<abi::LightNode> {
    if !(light_tree::FROM..=light_tree::UP_TO).contains(&lights.len()) {
        return Vec::new();
    }
    let flags = |material: u32| materials[material as usize].flags;
    let both_sides = |material| flags(material) & material_flag::EMIT_BOTH_SIDES != 0;
    let (nodes, trails) = light_tree::tree(lights, both_sides, motion);
    for (light, trail) in lights.iter_mut().zip(trails) {
        light.trail = trail;
    }
    nodes
}

/// The tree of lights of a pack, if it has these very lights; each is told its trail. Where their primitives are is
/// nothing to the tree.
pub(super) fn light_tree_again(
    pack: &Pack,
    lights: &mut [abi::Light],
) -> Option<Vec<abi::LightNode>> {
    let earlier: &[abi::Light] = pack.records();
    // As bytes: two numbers that are equal may differ in sign.
    let bytes = |light: &abi::Light| {
        let light = abi::Light { trail: 0, primitive: 0, ..*light };
        <[u8; size_of::<abi::Light>()]>::try_from(bytemuck::bytes_of(&light)).ok()
    };
    let same = |(a, b): (&abi::Light, &abi::Light)| bytes(a) == bytes(b);
    if earlier.len() != lights.len() || !earlier.iter().zip(&*lights).all(same) {
        return None;
    }
    for (light, earlier) in lights.iter_mut().zip(earlier) {
        light.trail = earlier.trail;
    }
    Some(pack.records().to_vec())
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
    sky: Option<&abi::Sky>,
) -> Option<Diagnostic> {
    let dark = lights.is_empty() && sky.is_none();
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
    abi::RenderSettings {
        image_size: scene.film.size,
        samples: scene.render.samples,
        max_depth: scene.render.max_depth,
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
        ..Default::default()
    }
}

/// Name and place of declaration of each material in use; `own_name`: what a material of a mesh file, here by its
/// place in the list, is called there.
pub(super) fn names<'a>(
    scene: &Scene,
    refs: &[MaterialRef],
    own_name: impl Fn(usize) -> &'a str,
) -> Vec<(String, Option<Span>)> {
    let name = |(index, of): (usize, &MaterialRef)| match *of {
        MaterialRef::Scene(index) => declared(&scene.materials[index].name),
        MaterialRef::Light(index) => declared(&scene.lights[index].name),
        MaterialRef::Default => ("default".to_owned(), None),
        MaterialRef::Asset { asset, .. } => {
            let asset = &scene.assets[asset].name;
            (format!("{}/{}", asset.text, own_name(index)), Some(asset.span))
        }
    };
    refs.iter().enumerate().map(name).collect()
}

fn declared(name: &Name) -> (String, Option<Span>) {
    (name.text.clone(), Some(name.span))
}

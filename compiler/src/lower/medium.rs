//! Media become `Medium` records, and materials learn that they have an inside.

use lang::scene::{self, MediumModel, Scene};
use pack::abi::{self, MaterialKind, NONE, material_flag};

use crate::normalize::Normalization;

/// Length of a segment that leaves the scene inside of a thing: without an end, and still a number
/// that can be multiplied. Normalised units.
const ENDLESS: f32 = 1e20;

/// What fills things whose material names no medium of the scene: waters, glass of mesh files.
#[derive(Clone, Copy, Debug)]
pub(super) struct OwnMedium {
    /// Absorption, per metre.
    pub(super) sigma_a: scene::Rgb,
    /// Radiance of the deep, in a water.
    pub(super) color: scene::Rgb,
}

/// The records of `Scene::media`, in that order, and then those of materials.
pub(super) fn records(scene: &Scene, own: &[OwnMedium], frame: &Normalization) -> Vec<abi::Medium> {
    let air = scene.render.atmosphere;
    let reach = |(index, medium): (usize, &scene::Medium)| {
        let around = air == Some(index);
        let reach = if around { frame.length(medium.sky_distance) } else { ENDLESS };
        record(medium, frame, reach)
    };
    let own_record = |own: &OwnMedium| abi::Medium {
        sigma_a: own.sigma_a.map(|sigma| frame.per_length(sigma)),
        color: own.color.map(|c| c as f32),
        reach: ENDLESS,
        ..Default::default()
    };
    scene.media.iter().enumerate().map(reach).chain(own.iter().map(own_record)).collect()
}

fn record(medium: &scene::Medium, frame: &Normalization, reach: f32) -> abi::Medium {
    let spectrum = |sigma: scene::Rgb| sigma.map(|sigma| frame.per_length(sigma));
    match medium.model {
        MediumModel::Homogeneous { sigma_a, sigma_s, g } => abi::Medium {
            sigma_a: spectrum(sigma_a),
            g: g as f32,
            sigma_s: spectrum(sigma_s),
            reach,
            ..Default::default()
        },
        MediumModel::Fog { density, color } => abi::Medium {
            sigma_a: spectrum([density; 3]),
            color: color.map(|c| c as f32),
            reach,
            ..Default::default()
        },
    }
}

/// Indices of the medium around everything and of the fog, each or `NONE`; also where it does nothing.
fn around(scene: &Scene) -> [u32; 2] {
    let Some(index) = scene.render.atmosphere else { return [NONE; 2] };
    match scene.media[index].model {
        MediumModel::Homogeneous { .. } => [index as u32, NONE],
        MediumModel::Fog { .. } => [NONE, index as u32],
    }
}

/// Those of `media`, one for each of the scene and then those of materials, that something is filled with or
/// surrounded by and that are not clear: along a clear one a path keeps its light to the last bit. Also what is
/// around everything and the fog, as `RenderSettings` holds them. `materials` are marked that have an inside,
/// also a clear one: things that overlap still ask which of them counts; and they get the new numbers.
pub(super) fn used(
    scene: &Scene,
    media: &[abi::Medium],
    materials: &mut [abi::Material],
) -> (Vec<abi::Medium>, [u32; 2]) {
    mark(scene, materials);
    let mut around = around(scene);
    let mut names: Vec<&mut u32> = around.iter_mut().collect();
    names.extend(materials.iter_mut().map(|material| &mut material.medium));
    let mut kept: Vec<u32> = Vec::new();
    for name in names.into_iter().filter(|name| **name != NONE) {
        if is_clear(&media[*name as usize]) {
            *name = NONE;
            continue;
        }
        let known = kept.iter().position(|old| old == name);
        let new = known.unwrap_or_else(|| {
            kept.push(*name);
            kept.len() - 1
        });
        *name = new as u32;
    }
    (kept.iter().map(|old| media[*old as usize]).collect(), around)
}

/// Neither takes light away nor scatters it.
fn is_clear(medium: &abi::Medium) -> bool {
    medium.sigma_a.iter().chain(&medium.sigma_s).all(|sigma| *sigma <= 0.0)
}

/// Whether light must know in this scene what it is inside of: there are media, or priorities.
pub(super) fn matters(scene: &Scene, materials: &[abi::Material]) -> bool {
    around(scene)[0] != NONE
        || materials.iter().any(|material| material.medium != NONE || material.priority > 0)
}

/// Whether light goes through the surface of this material into an inside.
pub(super) fn has_inside(material: &abi::Material) -> bool {
    MaterialKind::from_tag(material.kind).is_some_and(|kind| kind.traits().inside)
}

/// Marks the materials that have an inside, where that matters.
fn mark(scene: &Scene, materials: &mut [abi::Material]) {
    if matters(scene, materials) {
        for material in materials.iter_mut().filter(|material| has_inside(material)) {
            material.flags |= material_flag::INTERIOR | material_flag::THROUGH;
        }
    }
}

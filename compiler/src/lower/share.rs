//! Which meshes are stored once and shown by instances, and which are copied to each of their places.
//!
//! A mesh that is stored once takes less memory and its tree need not be built again when it is moved; but every
//! ray that comes near pays for the way into its frame and back, and trees that overlap cannot be taken apart as
//! triangles in one frame can. So a mesh is shared when it is placed twice or more and that saves
//! [`MIN_SAVED`] triangles or more; `docs/instances.md` has the measurements. One that turns while the shutter is open
//! is shared wherever it is placed.
//!
//! Never shared are places whose triangles are lights (the light table names triangles of the world), whose leaves
//! or petals depend on the name of the thing, and whose transform has no good inverse in 24 bits.

use std::collections::BTreeMap;
use std::fmt;
use std::str::FromStr;

use glam::DMat3;
use lang::material::Traits as _;
use lang::scene::{Color, Instance, Parts, Scene, Shape};
use thiserror::Error;

use super::geometry::transform::Transform;
use super::sheet::Sheets;
use super::shutter::Shutter;
use super::stored::condition;
use crate::import::{MeshFacts, PartFacts};

/// Fewest triangles that sharing a mesh must save.
pub const MIN_SAVED: usize = 1_000;
/// Fewest triangles of a mesh that is shared: a ray tests a few of them in the time that it takes to get to its frame.
pub const MIN_TRIANGLES: usize = 128;
/// Largest [`condition`] of a shared mesh's transform.
const MAX_CONDITION: f64 = 64.0;
/// Smallest size of a shared mesh, of the scene's.
const MIN_SIZE: f64 = 1.0 / 16_777_216.0; // 2^-24

/// Whether meshes are stored once: what `rtc --instances` takes.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord)]
pub enum Instancing {
    /// Where it pays.
    #[default]
    Auto,
    /// Nowhere: every place has its own triangles. For comparison.
    Never,
}

/// What is not a way of instancing.
#[derive(Clone, Debug, Error, PartialEq, Eq)]
#[error("expected `auto` or `never`, found `{0}`")]
pub struct UnknownInstancing(String);

impl fmt::Display for Instancing {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        out.write_str(match self {
            Self::Auto => "auto",
            Self::Never => "never",
        })
    }
}

impl FromStr for Instancing {
    type Err = UnknownInstancing;

    fn from_str(name: &str) -> Result<Self, UnknownInstancing> {
        let named = |how: &Self| how.to_string() == name;
        let found = [Self::Auto, Self::Never].into_iter().find(named);
        found.ok_or_else(|| UnknownInstancing(name.to_owned()))
    }
}

/// The meshes of a scene that are stored once.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub(super) struct Plan {
    /// Index of the stored mesh of each of `Scene::instances` that shows one.
    meshes: BTreeMap<usize, usize>,
}

impl Plan {
    /// `assets`: what is known of the scene's files.
    pub(super) fn new(
        scene: &Scene,
        assets: &[MeshFacts],
        how: Instancing,
        shutter: Shutter,
    ) -> Self {
        let mut plan = Self::default();
        if how == Instancing::Never {
            return plan;
        }
        let least = MIN_SIZE * extent(scene, shutter);
        let mut meshes = BTreeMap::<MeshName<'_>, (Mesh<'_>, Vec<usize>)>::new();
        for (index, instance) in scene.instances.iter().enumerate() {
            let Shape::Mesh { asset, parts } = &instance.shape else { continue };
            let file = &assets[*asset];
            let name = (*asset, parts);
            let new = || (Mesh::new(file, parts), Vec::new());
            let (mesh, places) = meshes.entry(name).or_insert_with(new);
            let linear = Transform::of(instance, shutter).linear;
            let fits = condition(linear) <= MAX_CONDITION && scale(linear) * mesh.size >= least;
            let differs = Sheets::of(scene, instance).is_some();
            if fits && !differs && !glows(scene, file, instance, &mesh.parts) {
                places.push(index);
            }
        }
        // The tree of a mesh that turns is much tighter in its own frame than around all places of its triangles.
        let turns = |index: &usize| {
            shutter.way(&scene.instances[*index]).1.is_some_and(|path| path.turns())
        };
        let mut shared: Vec<Vec<usize>> = (meshes.into_values())
            .filter(|(mesh, places)| {
                pays(mesh.n_triangles, places.len())
                    || (mesh.n_triangles >= MIN_TRIANGLES && places.iter().any(turns))
            })
            .map(|(_, places)| places)
            .collect();
        // In order of declaration; beyond what a pack can name, places are stored as if there were no instances.
        shared.sort();
        for of_mesh in shared {
            if plan.meshes.len() + of_mesh.len() <= pack::MAX_INSTANCES as usize {
                let mesh = plan.meshes.values().max().map_or(0, |last| last + 1);
                plan.meshes.extend(of_mesh.into_iter().map(|index| (index, mesh)));
            }
        }
        plan
    }

    /// The stored mesh that `Scene::instances[index]` shows.
    pub(super) fn mesh_of(&self, index: usize) -> Option<usize> {
        self.meshes.get(&index).copied()
    }
}

/// Asset and parts.
type MeshName<'a> = (usize, &'a Parts);

/// A mesh of the scene.
struct Mesh<'a> {
    parts: Vec<&'a PartFacts>,
    n_triangles: usize,
    /// Largest coordinate, metres.
    size: f64,
}

impl<'a> Mesh<'a> {
    fn new(file: &'a MeshFacts, parts: &Parts) -> Self {
        let parts: Vec<_> = file.chosen(parts).into_iter().map(|part| &file.parts[part]).collect();
        let n_triangles = parts.iter().map(|part| part.n_triangles).sum();
        // A part without vertices has no bounds.
        let coordinates = parts.iter().flat_map(|part| part.bounds.as_flattened());
        let coordinates = coordinates.filter(|x| x.is_finite());
        let size = coordinates.fold(0.0_f64, |most, x| most.max(f64::from(x.abs())));
        Self { parts, n_triangles, size }
    }
}

/// Whether a mesh of that many triangles is worth sharing between that many places.
fn pays(n_triangles: usize, n_places: usize) -> bool {
    let saved = n_triangles.saturating_mul(n_places.saturating_sub(1));
    n_triangles >= MIN_TRIANGLES && saved >= MIN_SAVED
}

/// Whether any of the parts may give light at this place.
fn glows(scene: &Scene, file: &MeshFacts, instance: &Instance, parts: &[&PartFacts]) -> bool {
    let dark =
        |color: &Color| matches!(color, Color::Constant(rgb) if rgb.iter().all(|c| *c == 0.0));
    if let Some(material) = instance.material {
        let model = &scene.materials[material].model;
        let lit = |(color, strength): (Color, f64)| strength != 0.0 && !dark(&color);
        // What does nothing else counts as a light though it be dark.
        return !model.scatters() || model.emission().is_some_and(lit);
    }
    let of_part =
        |part: &&PartFacts| part.material.map(|material| &file.materials[material as usize]);
    parts.iter().filter_map(of_part).any(|material| material.emission.iter().any(|c| *c != 0.0))
}

/// How much a map shrinks lengths at most.
fn scale(linear: DMat3) -> f64 {
    let inverse = linear.inverse();
    let entries = inverse.to_cols_array().into_iter().map(f64::abs);
    1.0 / entries.fold(f64::MIN_POSITIVE, f64::max)
}

/// No less than the distance of anything from the origin of the world, meshes left out, metres.
fn extent(scene: &Scene, shutter: Shutter) -> f64 {
    let things = scene.instances.iter().map(|instance| {
        let Transform { linear, translation, .. } = Transform::of(instance, shutter);
        let size = instance.shape.reach();
        let longest = linear.to_cols_array().into_iter().map(f64::abs).fold(0.0, f64::max);
        translation.abs().max_element() + 3.0 * longest * size
    });
    let lights = scene
        .lights
        .iter()
        .map(|light| light.center.iter().map(|x| x.abs()).fold(0.0, f64::max) + light.radius);
    things.chain(lights).fold(0.0, f64::max)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_are_read_as_they_are_written() {
        for how in [Instancing::Auto, Instancing::Never] {
            assert_eq!(how.to_string().parse(), Ok(how));
        }
        assert!("always".parse::<Instancing>().is_err());
    }

    #[test]
    fn two_places_or_more_that_save_enough_are_shared() {
        assert!(!pays(1_000_000, 1) && !pays(1_000_000, 0));
        assert!(pays(MIN_SAVED, 2) && !pays(MIN_SAVED - 1, 2) && pays(MIN_SAVED / 2, 3));
        assert!(!pays(MIN_TRIANGLES - 1, 1_000_000) && pays(MIN_TRIANGLES, 1_000_000));
    }
}

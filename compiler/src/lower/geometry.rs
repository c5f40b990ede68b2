//! Instances become triangles and spheres in the world, in `f64`, with their shading data, or places of meshes
//! that are stored once.
//!
//! Instances that `share` does not name are flattened: each writes its own triangles. Rectangles are two
//! triangles, boxes twelve. Everything that emits is noted as an `Emitter` on the way.

mod placer;
mod transform;

use glam::DVec3;
use lang::diagnostic::Diagnostic;
use lang::scene::Scene;
use pack::abi::{self, LightKind, TRI_SMOOTH};

use super::Loaded;
use super::light::{self, Emitter};
use super::material::{MaterialRef, MaterialTable};
use super::motion::Shutter;
use super::object::Thing;
use super::share::Plan;
use super::sheet::Sheets;
use super::stored::{Placed, Stored};
use placer::Placer;
pub(super) use transform::{Transform, octahedral};

/// Geometry of the whole scene when the shutter opens, before normalisation, in order of declaration.
#[derive(Debug, Default)]
pub struct Placement {
    /// Corners of every triangle that is stored in the world, world frame, metres.
    pub corners: Vec<[DVec3; 3]>,
    /// Shading data, one a triangle; `light` is `NONE` still.
    pub shades: Vec<abi::TriShade>,
    /// Triangles of each mesh instance: `groups[i]` is where group `i` ends.
    pub groups: Vec<u32>,
    /// Meshes that are stored once.
    pub meshes: Vec<Stored>,
    /// Where they are.
    pub placed: Vec<Placed>,
    /// Centre and radius of every sphere, metres.
    pub spheres: Vec<(DVec3, f64)>,
    /// Material of every sphere.
    pub sphere_materials: Vec<u32>,
    /// Object of every sphere.
    pub sphere_objects: Vec<u32>,
    /// Things in the world: their instances, then the lights.
    pub things: Vec<Thing>,
    /// What emits, in order of declaration.
    pub(super) emitters: Vec<Emitter>,
    /// Where what each of the things brought ends in the lists above.
    pub(super) ends: Vec<Ends>,
}

/// How many triangles, spheres and emitters there are with those of a thing.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(super) struct Ends {
    /// Triangles.
    pub(super) triangles: u32,
    /// Spheres.
    pub(super) spheres: u32,
    /// Emitters.
    pub(super) emitters: u32,
}

/// What is placed, and what need not be.
pub(super) struct Stage<'a> {
    pub(super) scene: &'a Scene,
    pub(super) loaded: &'a Loaded,
    pub(super) plan: &'a Plan,
    /// Of each instance, whether its triangles are known already: it is a thing and leaves nothing else. Beyond the
    /// end none are known.
    pub(super) known: &'a [bool],
}

/// Places everything; complaints about single instances go to `diagnostics`. What is stored once may be there
/// already.
pub(super) fn place(
    stage: &Stage<'_>,
    meshes: Vec<Stored>,
    materials: &mut MaterialTable<'_>,
    diagnostics: &mut Vec<Diagnostic>,
) -> Placement {
    let mut placement = Placement { meshes, ..Placement::default() };
    let shutter = Shutter::of(&stage.scene.camera);
    for (index, instance) in stage.scene.instances.iter().enumerate() {
        let object = placement.things.len() as u32;
        placement.things.push(Thing::of(instance, shutter));
        if !stage.known.get(index).is_some_and(|known| *known) {
            let mut placer = Placer {
                object,
                sheets: Sheets::of(stage.scene, instance),
                transform: Transform::of(instance, shutter),
                instance,
                materials: &mut *materials,
                placement: &mut placement,
            };
            placer.instance(stage, index, diagnostics);
        }
        placement.close();
    }
    for (index, light) in stage.scene.lights.iter().enumerate() {
        let material = materials.index(MaterialRef::Light(index));
        let object = placement.things.len() as u32;
        let thing = Thing::lit(light, shutter);
        let ball = Ball { center: thing.origin, radius: light.radius, material, object };
        placement.things.push(thing);
        let before = placement.emitters.len();
        placement.add_sphere(&ball, materials);
        // A black light is no emitter.
        if let (Some(tint), Some(emitter)) =
            (light::tint(light), placement.emitters.get_mut(before))
        {
            let [x, y, z] = tint.direction.map(|c| c as f32);
            emitter.tint = [x, y, z, libm::cos(tint.angle) as f32];
        }
        placement.close();
    }
    placement
}

/// A sphere in the world, metres.
#[derive(Clone, Copy)]
struct Ball {
    center: DVec3,
    radius: f64,
    material: u32,
    /// Index into `Placement::things`.
    object: u32,
}

impl Placement {
    /// Triangles of a placed mesh in the world, metres.
    fn triangles_of(&self, placed: &Placed) -> Vec<[DVec3; 3]> {
        let corners = &self.meshes[placed.mesh].corners;
        corners.iter().map(|corners| placed.triangle(corners)).collect()
    }

    fn add_sphere(&mut self, ball: &Ball, materials: &MaterialTable<'_>) {
        let Ball { center, radius, material, object } = *ball;
        if materials.glow(material) > 0.0 {
            self.emitters.push(Emitter {
                kind: LightKind::Sphere,
                primitive: self.spheres.len() as u32,
                count: 1,
                material,
                area: 4.0 * std::f64::consts::PI * radius * radius,
                tint: [0.0; 4],
            });
        }
        self.spheres.push((center, radius));
        self.sphere_materials.push(material);
        self.sphere_objects.push(object);
    }

    /// Takes triangles out. A rectangle that loses one of its two is no longer a rectangle light.
    pub(super) fn remove_triangles(&mut self, remove: &[bool]) {
        let left = counted(remove.iter().map(|removed| !removed));
        let stays = |emitter: &Emitter| {
            let (first, end) = (emitter.primitive, emitter.primitive + emitter.count);
            emitter.kind == LightKind::Sphere
                || left[end as usize] - left[first as usize] == emitter.count
        };
        let emitters_left = counted(self.emitters.iter().map(stays));
        self.emitters.retain_mut(|emitter| {
            let stays = stays(emitter);
            if emitter.kind != LightKind::Sphere {
                emitter.primitive = left[emitter.primitive as usize];
            }
            stays
        });
        for end in &mut self.groups {
            *end = left[*end as usize];
        }
        self.groups.dedup();
        self.groups.retain(|end| *end > 0);
        for ends in &mut self.ends {
            ends.triangles = left[ends.triangles as usize];
            ends.emitters = emitters_left[ends.emitters as usize];
        }
        let mut index = 0;
        self.shades.retain(|_| {
            index += 1;
            !remove[index - 1]
        });
    }

    /// What each of the things brought, by its index.
    pub(super) fn spans(&self) -> impl Iterator<Item = (Ends, Ends)> {
        let starts = std::iter::once(Ends::default()).chain(self.ends.iter().copied());
        starts.zip(self.ends.iter().copied())
    }

    /// Triangles of each group.
    pub(super) fn mesh_sizes(&self) -> Vec<usize> {
        let starts = std::iter::once(&0).chain(&self.groups);
        starts.zip(&self.groups).map(|(start, end)| (end - start) as usize).collect()
    }

    /// The entry of `of_thing` for each group.
    pub(super) fn mesh_motions(&self, of_thing: &[[f32; 3]]) -> Vec<[f32; 3]> {
        let starts = std::iter::once(&0).chain(&self.groups).take(self.groups.len());
        let thing = |start: &u32| self.shades[*start as usize].object & !TRI_SMOOTH;
        starts.map(|start| of_thing[thing(start) as usize]).collect()
    }

    /// Ends what one thing brings.
    fn close(&mut self) {
        self.close_with(self.spheres.len() as u32);
    }

    /// As `close`, where there are that many spheres up to here. Things without triangles make no group.
    pub(super) fn close_with(&mut self, spheres: u32) {
        let triangles = self.shades.len() as u32;
        if self.groups.last().copied().unwrap_or(0) < triangles {
            self.groups.push(triangles);
        }
        let emitters = self.emitters.len() as u32;
        self.ends.push(Ends { triangles, spheres, emitters });
    }
}

/// How many of the first `0..=n` are true.
fn counted(all: impl Iterator<Item = bool>) -> Vec<u32> {
    let mut so_far = 0;
    let sum = all.map(|one| {
        so_far += u32::from(one);
        so_far
    });
    let sum: Vec<u32> = sum.collect();
    std::iter::once(0).chain(sum).collect()
}

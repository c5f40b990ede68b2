//! Lowers a scene again in which instances or lights stand elsewhere than in an earlier pack.
//!
//! Turns the scene as it says now, the earlier pack and what is remembered of it into the records that `lower` would
//! give, to the last bit. Triangles of instances that stay are the pack's; only meshes that move are placed, and only
//! their files are looked at. Trees are made of the triangles as ever: those of meshes that stay are in the cache.
//! Where moving something changes more than that (the frame of the scene, which meshes are stored once), it gives
//! up, and everything must be done.

use std::sync::Arc;
use std::time::Instant;

use glam::DVec3;
use lang::diagnostic::Diagnostic;
use lang::scene::{Scene, Shape};
use pack::Pack;
use pack::abi::{LightKind, NONE, TRI_SMOOTH, TriShade};

use super::assemble::{Front, check_count, normalised};
use super::extent::{self, Extent, extents};
use super::geometry::{Ends, Placement, Stage, place};
use super::inside::{Boundary, Solids, boundaries};
use super::light::Emitter;
use super::lowered::{Counters, LowerError, Lowered, Times};
use super::material::MaterialTable;
use super::motion::Shutter;
use super::roster::{self, Earlier, KnownThing, Roster};
use super::share::Plan;
use super::sketch::Sketch;
use super::sky_source::SkySource;
use super::trees::{Corners, Trees, add_meshes};
use super::{Loaded, medium, power, thick};
use crate::normalize::Normalization;
use crate::weld::{Welded, weld_again};

/// What an earlier compilation left.
#[derive(Clone, Copy, Debug)]
pub struct Left<'a> {
    /// Its pack.
    pub pack: &'a Arc<Pack>,
    /// What else is remembered.
    pub sketch: &'a Sketch,
    /// What is remembered of each thing.
    pub roster: &'a Roster,
}

/// Which mesh files must be loaded before a scene can be lowered after things moved, by their index in the scene.
/// `None` if everything must be done.
#[must_use]
pub fn files_of_moved(scene: &Scene, roster: &Roster, trees: &Trees<'_>) -> Option<Vec<bool>> {
    let plan = plan(scene, roster, trees)?;
    let mut needed = vec![false; scene.assets.len()];
    for (index, instance) in scene.instances.iter().enumerate() {
        let Shape::Mesh { asset, .. } = &instance.shape else { continue };
        let stays = roster.things[index].stays(&instance.world_from_object);
        let looked_at = plan.mesh_of(index).is_none() || thick::matters(scene, instance);
        needed[*asset] |= !stays && looked_at;
    }
    Some(needed)
}

/// The meshes that are stored once; `None` if they are others than before.
fn plan(scene: &Scene, roster: &Roster, trees: &Trees<'_>) -> Option<Plan> {
    if roster.things.len() != scene.instances.len() + scene.lights.len() {
        return None;
    }
    let facts: Vec<_> = roster.things.iter().map(|thing| thing.facts).collect();
    let plan = Plan::new(scene, &facts, trees.instancing, Shutter::of(&scene.camera));
    (plan == roster.plan).then_some(plan)
}

/// Lowers `scene`, all of whose instances and lights are in `left`, some of them elsewhere; `loaded` has the files
/// that `files_of_moved` named. `None` if everything must be done.
pub fn lower_moved(
    scene: &Scene,
    sky_text: &str,
    loaded: &Loaded,
    left: Left<'_>,
    trees: &Trees<'_>,
    diagnostics: &mut Vec<Diagnostic>,
) -> Option<Result<Lowered, LowerError>> {
    let start = Instant::now();
    let Left { pack, sketch, roster } = left;
    let plan = plan(scene, roster, trees)?;
    let earlier = Earlier::new(roster, pack)?;
    let mut materials = MaterialTable::again(scene, &sketch.materials, &sketch.textures)?;
    let sky = SkySource::again(scene, sky_text, (pack, &sketch.sky), &mut materials.textures)?;
    if !materials.textures.is_as_known() {
        return None;
    }
    let known = known(scene, roster, &plan);
    let (meshes, mesh_ids) = earlier.meshes();
    let stage = Stage { scene, loaded, plan: &plan, known: &known };
    let mut placed = place(&stage, meshes, &mut materials, diagnostics);
    if materials.refs().len() != sketch.materials.len() {
        return None;
    }
    let boundaries = boundaries_again(&placed, &materials, sketch, &known);
    thick::check(scene, loaded, diagnostics);
    let inside = inside(scene, &materials, &placed, &boundaries, diagnostics);
    let boxes = boxes(&placed, left, &known)?;
    let sky_area = power::weigh(&mut placed, roster.ball);

    let mut counters = Counters::default();
    let before: Vec<(Ends, Ends)> = placed.spans().collect();
    let frame = Normalization { center: sketch.frame.0, exponent: sketch.frame.1 };
    let corners = normalised(&mut placed, &frame, &mut counters);
    let facts: Vec<_> = roster.things.iter().map(|thing| thing.facts).collect();
    let mut things = KnownThing::all(scene, &placed, &before, boxes, &facts);
    for (thing, from) in kept(&mut things, &roster.things, &known) {
        *thing = *from;
        counters.dropped_triangles += u64::from(from.dropped);
    }
    let world = World::of(placed, &corners, &known, &earlier);
    // The trees are made beside a copy of the triangles; the pack itself would be a third of all memory.
    pack.release_pages();
    if let Err(error) = check_count(&world.placement) {
        return Some(Err(error));
    }
    let emitters = roster::emitters(&things, &world.placement);
    let (meshes, ball, at) = (roster.meshes.clone(), roster.ball, Vec::new());
    let roster = Roster { things, plan, meshes, emitters, ball, at };
    let (placement, corners, welded) = world.weld(mesh_ids, sketch, &mut counters)?;
    let times = Times { geometry: start.elapsed(), ..Times::default() };
    let front = Front {
        scene,
        placement,
        corners,
        welded,
        counters,
        frame,
        materials,
        sketch: sketch.clone(),
        inside: (inside, boundaries),
        sky,
        sky_area,
        roster,
        times,
    };
    Some(front.finish(trees, Some(pack), diagnostics))
}

/// The boxes of all things; `None` if the frame of the scene or the ball of what receives light is another.
fn boxes(placed: &Placement, left: Left<'_>, known: &[bool]) -> Option<Vec<Extent>> {
    let mut boxes = extents(placed);
    for (extent, from) in kept(&mut boxes, &left.roster.things, known) {
        *extent = from.extent;
    }
    let frame = extent::frame(&boxes, Vec::new());
    let bits = |center: [f64; 3]| center.map(f64::to_bits);
    let (center, exponent) = left.sketch.frame;
    let same_frame = (bits(frame.center), frame.exponent) == (bits(center), exponent);
    (same_frame && extent::receivers(&boxes) == left.roster.ball).then_some(boxes)
}

/// What there is of each known thing, beside what the roster says of it.
fn kept<'a, T>(
    all: &'a mut [T],
    things: &'a [KnownThing],
    known: &'a [bool],
) -> impl Iterator<Item = (&'a mut T, &'a KnownThing)> {
    let pairs = all.iter_mut().zip(things).enumerate();
    pairs.filter(|(index, _)| is(known, *index)).map(|(_, pair)| pair)
}

fn is(known: &[bool], index: usize) -> bool {
    known.get(index).is_some_and(|known| *known)
}

/// Instances whose triangles are the pack's: meshes with triangles of their own that stand where they stood.
fn known(scene: &Scene, roster: &Roster, plan: &Plan) -> Vec<bool> {
    let instances = scene.instances.iter().zip(&roster.things).enumerate();
    let known = instances.map(|(index, (instance, thing))| {
        let is_mesh = matches!(instance.shape, Shape::Mesh { .. });
        is_mesh && plan.mesh_of(index).is_none() && thing.stays(&instance.world_from_object)
    });
    known.collect()
}

/// Surfaces of filled things: those that were placed now, and those of the others from before.
fn boundaries_again(
    placed: &Placement,
    materials: &MaterialTable<'_>,
    sketch: &Sketch,
    known: &[bool],
) -> Vec<Boundary> {
    let kept = sketch.boundaries.iter().filter(|b| is(known, b.object() as usize)).copied();
    kept.chain(boundaries(placed, materials.records())).collect()
}

/// What the camera is inside of.
fn inside(
    scene: &Scene,
    materials: &MaterialTable<'_>,
    placed: &Placement,
    boundaries: &[Boundary],
    diagnostics: &mut Vec<Diagnostic>,
) -> [u32; 4] {
    let records = materials.records();
    if !medium::matters(scene, records) {
        return [NONE; 4];
    }
    let solids = Solids::new(boundaries, DVec3::from(scene.camera.from));
    solids.warn_of_overlaps(placed, records, scene, diagnostics);
    solids.around_camera(scene, records, diagnostics)
}

/// All things of a scene.
struct World {
    placement: Placement,
    /// Triangles that are stored in the world.
    corners: Vec<[[f32; 3]; 3]>,
    /// What their corners were called; `NONE` for those that were placed now.
    ids: Vec<[u32; 3]>,
}

impl World {
    /// Puts what was `placed`, with these corners, and what is `known` together, in order of declaration.
    fn of(
        placed: Placement,
        corners: &[[[f32; 3]; 3]],
        known: &[bool],
        earlier: &Earlier<'_>,
    ) -> Self {
        let spans: Vec<(Ends, Ends)> = placed.spans().collect();
        let (shades, emitters) = (placed.shades, placed.emitters);
        let placement = Placement {
            shades: Vec::new(),
            emitters: Vec::new(),
            groups: Vec::new(),
            ends: Vec::new(),
            ..placed
        };
        let mut world = Self { placement, corners: Vec::new(), ids: Vec::new() };
        let mut spheres = 0;
        for (index, (from, to)) in spans.into_iter().enumerate() {
            let first = world.corners.len() as u32;
            if is(known, index) {
                world.take(index, earlier);
            } else {
                let triangles = from.triangles as usize..to.triangles as usize;
                world.ids.resize(world.ids.len() + triangles.len(), [NONE; 3]);
                world.corners.extend_from_slice(&corners[triangles.clone()]);
                world.placement.shades.extend_from_slice(&shades[triangles]);
                let own = &emitters[from.emitters as usize..to.emitters as usize];
                // Spheres are all placed now: their numbers stay.
                let shift = |emitter: &Emitter| match emitter.kind {
                    LightKind::Sphere => *emitter,
                    LightKind::Rectangle | LightKind::Triangle | LightKind::Sky => Emitter {
                        primitive: emitter.primitive - from.triangles + first,
                        ..*emitter
                    },
                };
                world.placement.emitters.extend(own.iter().map(shift));
            }
            spheres += to.spheres - from.spheres;
            world.placement.close_with(spheres);
        }
        world
    }

    /// With what is stored once, whose corners were called `mesh_ids`, and every corner called anew. `None` if what
    /// they were called cannot be.
    fn weld(
        self,
        mesh_ids: Vec<[u32; 3]>,
        sketch: &Sketch,
        counters: &mut Counters,
    ) -> Option<(Placement, Corners, Welded)> {
        let Self { mut placement, corners, mut ids } = self;
        let corners = add_meshes(&mut placement, corners, counters);
        ids.extend(mesh_ids);
        let welded = weld_again(&corners.all, ids, sketch.counters.vertices)?;
        counters.vertices = u64::from(welded.n_ids);
        Some((placement, corners, welded))
    }

    /// Adds a thing whose triangles the pack has.
    fn take(&mut self, thing: usize, earlier: &Earlier<'_>) {
        let first = self.corners.len() as u32;
        for number in earlier.triangles_of(thing) {
            let (triangle, shade) = earlier.triangle(number);
            self.corners.push([triangle.v0, triangle.v1, triangle.v2]);
            self.ids.push([triangle.id0, triangle.id1, triangle.id2]);
            let object = thing as u32 | shade.object & TRI_SMOOTH;
            self.placement.shades.push(TriShade { object, ..shade });
        }
        self.placement.emitters.extend(earlier.emitters_of(thing, first));
    }
}

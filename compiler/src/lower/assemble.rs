//! Puts the records of a scene together, in the order in which the pack stores them.
//!
//! World geometry in `f64` is normalised once, triangles without area are dropped and counted,
//! each mesh gets its tree, the trees are joined, and primitives and lights are renumbered to leaf
//! order.

use std::sync::Arc;
use std::time::Instant;

use glam::DVec3;
use lang::diagnostic::Diagnostic;
use lang::scene::Scene;
use pack::abi::{self, NONE, OBJECT_OF_INSTANCE, TRI_SMOOTH};
use pack::{Kind, Pack};

use super::extent::{self, extents};
use super::finish::{self, settings};
use super::geometry::{Ends, Placement, Stage, place};
use super::inside::{Boundary, Solids, boundaries};
use super::lowered::{Counters, LowerError, Lowered, Times};
use super::material::MaterialTable;
use super::motion::Shutter;
use super::order::{Declared, Ordered, order};
use super::roster::{self, KnownThing, Roster};
use super::rows::Rows;
use super::share::{MeshFacts, Plan};
use super::sketch::{KnownEmitter, KnownSky, Sketch};
use super::sky_source::SkySource;
use super::stored::Stored;
use super::texture::TextureTable;
use super::trees::{Corners, Trees, add_meshes, build_tree};
use super::{Loaded, camera, closed, medium, motion, power, thick};
use crate::bvh::{self, Joined};
use crate::normalize::Normalization;
use crate::weld::{Welded, weld};

/// Everything of a scene in the normalised frame, before there are trees.
pub(super) struct Front<'a> {
    pub(super) scene: &'a Scene,
    /// Without the corners, which are in `corners`.
    pub(super) placement: Placement,
    pub(super) corners: Corners,
    pub(super) welded: Welded,
    pub(super) counters: Counters,
    pub(super) frame: Normalization,
    pub(super) materials: MaterialTable<'a>,
    /// What is remembered of materials and textures.
    pub(super) sketch: Sketch,
    /// What the camera is inside of, and the surfaces that tell.
    pub(super) inside: ([u32; 4], Vec<Boundary>),
    pub(super) sky: SkySource,
    pub(super) sky_area: Option<f64>,
    /// What else is remembered for the next time.
    pub(super) roster: Roster,
    pub(super) times: Times,
}

/// Lowers a scene whose files are loaded. Faults of single instances are added to `diagnostics`.
///
/// # Errors
/// When the scene is too large for the format.
pub fn lower(
    scene: &Scene,
    loaded: Loaded,
    trees: &Trees<'_>,
    diagnostics: &mut Vec<Diagnostic>,
) -> Result<Lowered, LowerError> {
    let start = Instant::now();
    let mut materials = MaterialTable::new(scene, &loaded);
    let facts = MeshFacts::of(scene, &loaded);
    let plan = Plan::new(scene, &facts, trees.instancing, Shutter::of(&scene.camera));
    let stage = Stage { scene, loaded: &loaded, plan: &plan, known: &[] };
    let mut placement = place(&stage, Vec::new(), &mut materials, diagnostics);
    check_count(&placement)?;
    let inside = inside(scene, &loaded, &materials, &placement, diagnostics);
    let environment = loaded.environment.as_ref();
    let sky = SkySource::new(scene, environment, &mut materials.textures);
    let extents = extents(&placement);
    let ball = extent::receivers(&extents);
    let sky_area = power::weigh(&mut placement, ball);
    let frame = extent::frame(&extents, motion::ends(&placement));
    let sketch = Sketch::of(&frame, &materials, Counters::default());
    // What was read is copied: from here on it would only take room.
    let materials = materials.without_files(scene);
    drop(loaded);
    let meshes = placement.meshes.iter().map(Stored::known).collect();
    let before: Vec<(Ends, Ends)> = placement.spans().collect();
    let (corners, welded, counters) = weld_all(&mut placement, &frame);
    let things = KnownThing::all(scene, &placement, &before, extents, &facts);
    let emitters = roster::emitters(&things, &placement);
    let roster = Roster { things, plan, meshes, emitters, ball, at: Vec::new() };
    let times = Times { geometry: start.elapsed(), ..Times::default() };
    let front = Front {
        scene,
        placement,
        corners,
        welded,
        counters,
        frame,
        materials,
        sketch,
        inside,
        sky,
        sky_area,
        roster,
        times,
    };
    front.finish(trees, None, diagnostics)
}

impl Front<'_> {
    /// Makes the trees and all records. With an `earlier` pack and what is remembered of it, whose materials and
    /// frame are the same, textures are its own, and the tree of lights, if it has these very lights.
    pub(super) fn finish(
        self,
        trees: &Trees<'_>,
        earlier: Option<&Arc<Pack>>,
        diagnostics: &mut Vec<Diagnostic>,
    ) -> Result<Lowered, LowerError> {
        let Self { scene, mut placement, corners, welded, mut counters, frame, materials, .. } =
            self;
        let (mut times, mut roster) = (self.times, self.roster);
        let flux = self.sky.flux;
        placement.emitters.extend(flux.and(self.sky_area).map(power::sky));

        let start = Instant::now();
        let balls = normalised_spheres(&placement, &frame);
        let motions = motion::displacements(&placement.things, &frame);
        let (joined, wide_nodes, report) =
            build_tree(&placement, &corners, &balls, (&motions, &frame), trees)?;
        times.bvh = start.elapsed();

        let start = Instant::now();
        let instances = instances(&placement, &joined, &motions, &frame);
        let powers = power::powers(&placement.emitters, &materials, flux);
        let declared = Declared { corners: corners.all, welded, balls };
        let mut ordered = order(&mut placement, &powers, declared, &joined);
        ordered.count(&mut counters);
        roster.at = std::mem::take(&mut ordered.triangle_at);
        times.order = start.elapsed();

        let still = motions.is_empty();
        let (inside, boundaries) = self.inside;
        let sketch = Sketch {
            emitters: known_emitters(&placement, &ordered),
            sky_area: self.sky_area,
            sky: KnownSky { flux, ..KnownSky::default() },
            boundaries,
            n_trees: report.groups,
            counters,
            ..self.sketch
        };
        let light_nodes = light_tree(&mut ordered, materials.records(), &motions, earlier);
        let (sky, sky_table) = self.sky.records(&ordered.lights);
        diagnostics.extend(finish::darkness(scene, &ordered.lights, sky.as_ref()));
        let own_name = |index: usize| sketch.own_name(index);
        let material_names = finish::names(scene, materials.refs(), own_name);
        let declared = medium::records(scene, materials.waters(), &frame);
        let (mut materials, textures) = materials.into_records();
        let (media, around) = medium::used(scene, &declared, &mut materials);
        let objects = finish::objects(&placement.things, &materials, &frame, !still);
        let instances = forget_objects(&objects, &mut ordered, instances);
        motion::mark(&objects, &mut ordered);
        let (textures, texels) = images(textures, earlier);
        Ok(Lowered {
            render: settings(scene, &frame, joined.entry(), (inside, around), ordered.lights.len()),
            camera: camera::camera(&scene.camera, &frame),
            sky,
            sky_table,
            nodes: joined.nodes.into(),
            wide_nodes: wide_nodes.into(),
            triangles: ordered.triangles.into(),
            shades: ordered.shades.into(),
            spheres: ordered.spheres,
            objects,
            instances,
            materials,
            media,
            material_names,
            lights: ordered.lights,
            light_nodes,
            textures,
            texels,
            counters,
            times,
            trees: report,
            sketch: still.then_some(sketch),
            roster: still.then_some(roster),
        })
    }
}

/// Textures and texels, those of an `earlier` pack if there is one.
fn images(
    made: TextureTable<'_>,
    earlier: Option<&Arc<Pack>>,
) -> (Vec<abi::Texture>, Rows<[u32; 4]>) {
    let Some(pack) = earlier else {
        let (textures, texels) = made.into_records();
        return (textures, texels.into());
    };
    (pack.records().to_vec(), Rows::kept(pack, Kind::TEXEL, Pack::texels))
}

/// Triangles in the normalised frame, those of the world and those of meshes that are stored once, and their
/// vertices.
fn weld_all(placement: &mut Placement, frame: &Normalization) -> (Corners, Welded, Counters) {
    let mut counters = Counters::default();
    let corners = normalised(placement, frame, &mut counters);
    let shared = add_meshes(placement, corners, &mut counters);
    let welded = weld(&shared.all);
    counters.vertices = u64::from(welded.n_ids);
    (shared, welded, counters)
}

/// What the camera is inside of, as `RenderSettings` holds it, and the surfaces that tell.
fn inside(
    scene: &Scene,
    loaded: &Loaded,
    materials: &MaterialTable<'_>,
    placement: &Placement,
    diagnostics: &mut Vec<Diagnostic>,
) -> ([u32; 4], Vec<Boundary>) {
    let matters = medium::matters(scene, materials.records());
    closed::check(scene, loaded, matters, diagnostics);
    thick::check(scene, loaded, diagnostics);
    if !matters {
        return ([NONE; 4], Vec::new());
    }
    let records = materials.records();
    let boundaries = boundaries(placement, records);
    let solids = Solids::new(&boundaries, DVec3::from(scene.camera.from));
    solids.warn_of_overlaps(placement, records, scene, diagnostics);
    (solids.around_camera(scene, records, diagnostics), boundaries)
}

/// What emits and which of it is a light, without the sky, which comes last.
fn known_emitters(placement: &Placement, ordered: &Ordered) -> Vec<KnownEmitter> {
    let emitters = placement.emitters.iter().zip(&ordered.selected);
    let emitters = emitters.filter(|(emitter, _)| emitter.kind != abi::LightKind::Sky);
    emitters.map(|(emitter, selected)| KnownEmitter::new(emitter, *selected)).collect()
}

/// The tree of lights; `motions`: how far each thing comes, empty where nothing moves.
fn light_tree(
    ordered: &mut Ordered,
    materials: &[abi::Material],
    motions: &[[f32; 3]],
    earlier: Option<&Arc<Pack>>,
) -> Vec<abi::LightNode> {
    let Ordered { lights, shades, spheres, .. } = ordered;
    if let Some(nodes) = earlier.and_then(|pack| finish::light_tree_again(pack, lights)) {
        return nodes;
    }
    finish::light_tree(lights, materials, |light| {
        let primitive = light.primitive as usize;
        let object = if light.kind == abi::LightKind::Sphere as u32 {
            spheres[primitive].object
        } else {
            shades[primitive].object & !TRI_SMOOTH
        };
        motions.get(object as usize).map_or(DVec3::ZERO, |motion| motion.map(f64::from).into())
    })
}

/// Without a table, every primitive says 0, and every instance; triangles of instances go on to say so.
fn forget_objects(
    objects: &[abi::Object],
    ordered: &mut Ordered,
    mut instances: Vec<abi::Instance>,
) -> Vec<abi::Instance> {
    if objects.is_empty() {
        for shade in &mut ordered.shades {
            if shade.object & !TRI_SMOOTH != OBJECT_OF_INSTANCE {
                shade.object &= TRI_SMOOTH;
            }
        }
        ordered.spheres.iter_mut().for_each(|sphere| sphere.object = 0);
        for instance in &mut instances {
            instance.object = 0;
        }
    }
    instances
}

/// Centres and radii in the normalised frame; no radius is lost.
fn normalised_spheres(placement: &Placement, frame: &Normalization) -> Vec<([f32; 3], f32)> {
    let sphere = |(center, radius): &(DVec3, f64)| {
        (frame.point(center.to_array()), frame.length(*radius).max(f32::MIN_POSITIVE))
    };
    placement.spheres.iter().map(sphere).collect()
}

/// Refuses more triangles than the pack can number.
pub(super) fn check_count(placement: &Placement) -> Result<(), LowerError> {
    let stored = placement.meshes.iter().map(|mesh| mesh.corners.len()).sum::<usize>();
    let count = placement.corners.len() + stored;
    if count > bvh::MAX_PRIMITIVES {
        return Err(LowerError::TooManyTriangles { count });
    }
    Ok(())
}

/// The records of placed meshes.
fn instances(
    placement: &Placement,
    joined: &Joined,
    motions: &[[f32; 3]],
    frame: &Normalization,
) -> Vec<abi::Instance> {
    let record = |placed: &super::Placed| {
        let motion = motions.get(placed.object as usize).copied().unwrap_or_default();
        let moves = motion.iter().any(|x| *x != 0.0);
        let record = placed.record(&placement.meshes[placed.mesh], frame, moves);
        abi::Instance { root: joined.mesh_roots[placed.mesh], ..record }
    };
    placement.placed.iter().map(record).collect()
}

/// Corners in the normalised frame; triangles that have no area there are taken out of `placement`.
pub(super) fn normalised(
    placement: &mut Placement,
    frame: &Normalization,
    counters: &mut Counters,
) -> Vec<[[f32; 3]; 3]> {
    let point = |p: DVec3| frame.point(p.to_array());
    let corners: Vec<[[f32; 3]; 3]> =
        placement.corners.iter().map(|corners| corners.map(point)).collect();
    placement.corners = Vec::new();
    let flat: Vec<bool> = corners.iter().map(has_no_area).collect();
    counters.dropped_triangles = flat.iter().filter(|flat| **flat).count() as u64;
    if counters.dropped_triangles == 0 {
        return corners;
    }
    placement.remove_triangles(&flat);
    corners.into_iter().zip(flat).filter(|(_, flat)| !flat).map(|(corners, _)| corners).collect()
}

/// Whether the corners lie on one line, with products in `f64`, where they round least.
pub(super) fn has_no_area(corners: &[[f32; 3]; 3]) -> bool {
    let [a, b, c] = corners.map(|p| DVec3::from(p.map(f64::from)));
    (b - a).cross(c - a) == DVec3::ZERO
}

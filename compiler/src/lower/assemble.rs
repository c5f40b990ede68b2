//! Puts the records of a scene together, in the order in which the pack stores them.
//!
//! World geometry in `f64` is normalised once, triangles without area are dropped and counted,
//! each mesh gets its tree, the trees are joined, and primitives and lights are renumbered to leaf
//! order.

use std::time::{Duration, Instant};

use glam::DVec3;
use lang::diagnostic::{Code, Diagnostic};
use lang::scene::{Name, Sampler, Scene, ToneMap};
use lang::source::Span;
use pack::abi::{self, NONE, OBJECT_OF_INSTANCE, TRI_SMOOTH, material_flag};

use super::geometry::{self, Placement};
use super::inside::Solids;
use super::material::{MaterialRef, MaterialTable};
use super::order::{Declared, Ordered, order};
use super::share::Instancing;
use super::sky::LoweredSky;
use super::sky_table::SkyTable;
use super::{Loaded, camera, closed, light_tree, medium, motion, power, sky, thick};
use crate::bvh::{self, BuildReport, BvhError, Joined, Layout, Preset, Primitives, Shared};
use crate::cache::Cache;
use crate::normalize::Normalization;
use crate::weld::weld;

/// How trees over the geometry are made.
#[derive(Clone, Copy, Debug)]
pub struct Trees<'a> {
    /// Which builder.
    pub preset: Preset,
    /// How their nodes are stored.
    pub layout: Layout,
    /// Which meshes are stored once.
    pub instancing: Instancing,
    /// Trees of earlier runs.
    pub cache: &'a Cache,
}

impl<'a> Trees<'a> {
    /// As everybody gets them.
    #[must_use]
    pub fn usual(cache: &'a Cache) -> Self {
        let (preset, layout) = (Preset::default(), Layout::default());
        Self { preset, layout, instancing: Instancing::default(), cache }
    }

    /// All that changes what is made, for keys.
    #[must_use]
    pub fn recipe(&self) -> String {
        format!("{} {:?} {:?}", self.preset.recipe(), self.layout, self.instancing)
    }
}

/// What was counted while lowering.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Counters {
    /// Triangles in the pack.
    pub triangles: u64,
    /// Triangles in the world: those of a mesh that is stored once count at each of its places.
    pub shown: u64,
    /// Meshes that are stored once.
    pub meshes: u64,
    /// Their places.
    pub instances: u64,
    /// Triangles in the leaves of the tree; those that were split count once for each piece.
    pub references: u64,
    /// Triangles that had no area once positions were rounded; not in the pack.
    pub dropped_triangles: u64,
    /// Distinct vertex positions.
    pub vertices: u64,
    /// Spheres in the pack.
    pub spheres: u64,
    /// Entries of the light table.
    pub lights: u64,
}

/// Time spent.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Times {
    /// Placing instances, normalising, welding.
    pub geometry: Duration,
    /// Building, fetching and joining trees.
    pub bvh: Duration,
    /// Putting primitives in order, lights.
    pub order: Duration,
}

/// All records of a pack.
#[derive(Clone, Debug)]
pub struct Lowered {
    /// Settings.
    pub render: abi::RenderSettings,
    /// Camera.
    pub camera: abi::Camera,
    /// Sky; `None` is black.
    pub sky: Option<abi::Sky>,
    /// By which the sky is sampled; empty if it is no light.
    pub sky_table: Vec<[f32; 4]>,
    /// Nodes of the joined tree; empty if they are wide.
    pub nodes: Vec<abi::Node>,
    /// Nodes of the joined tree; empty if they are binary.
    pub wide_nodes: Vec<abi::WideNode>,
    /// Triangles in leaf order.
    pub triangles: Vec<abi::Triangle>,
    /// Shading data in leaf order.
    pub shades: Vec<abi::TriShade>,
    /// Spheres in leaf order.
    pub spheres: Vec<abi::Sphere>,
    /// Things in the world; empty when no material depends on them and none moves.
    pub objects: Vec<abi::Object>,
    /// Places of meshes that are stored once.
    pub instances: Vec<abi::Instance>,
    /// Materials in use.
    pub materials: Vec<abi::Material>,
    /// Media of the scene.
    pub media: Vec<abi::Medium>,
    /// Name and place of each material.
    pub material_names: Vec<(String, Option<Span>)>,
    /// Light table.
    pub lights: Vec<abi::Light>,
    /// Tree of lights; empty if the table is good enough.
    pub light_nodes: Vec<abi::LightNode>,
    /// Textures in use.
    pub textures: Vec<abi::Texture>,
    /// Texels of all textures.
    pub texels: Vec<[u32; 4]>,
    /// What was counted.
    pub counters: Counters,
    /// What took how long.
    pub times: Times,
    /// What building the trees cost, and what the cache did.
    pub trees: BuildReport,
}

/// Why a scene could not be lowered, apart from faults in its text.
#[derive(Debug, thiserror::Error)]
pub enum LowerError {
    /// The tree could not be built.
    #[error(transparent)]
    Bvh(#[from] BvhError),
    /// More triangles than the pack can number.
    #[error("{count} triangles are too many; at most {} are possible", bvh::MAX_PRIMITIVES)]
    TooManyTriangles {
        /// How many there are.
        count: usize,
    },
}

/// Lowers a scene whose files are loaded. Faults of single instances are added to `diagnostics`.
///
/// # Errors
/// When the scene is too large for the format.
pub fn lower(
    scene: &Scene,
    loaded: &Loaded,
    trees: &Trees<'_>,
    diagnostics: &mut Vec<Diagnostic>,
) -> Result<Lowered, LowerError> {
    let start = Instant::now();
    let mut materials = MaterialTable::new(scene, loaded);
    let mut placement =
        geometry::place(scene, loaded, trees.instancing, &mut materials, diagnostics);
    check_count(&placement)?;
    let inside = around_camera(scene, loaded, &materials, &placement, diagnostics);
    let environment = loaded.environment.as_ref();
    let sky = scene.sky.as_ref().and_then(|s| sky::sky(s, environment, &mut materials.textures));
    let table = sky.as_ref().and_then(|sky| sky.table.as_ref());
    power::weigh(&mut placement, table.map(|table| table.flux));
    let frame = normalization(&placement);
    let mut counters = Counters::default();
    let corners = normalised(&mut placement, &frame, &mut counters);
    let shared = add_meshes(&mut placement, corners, &mut counters);
    let welded = weld(&shared.all);
    counters.vertices = u64::from(welded.n_ids);
    let mut times = Times { geometry: start.elapsed(), ..Times::default() };

    let start = Instant::now();
    let balls = normalised_spheres(&placement, &frame);
    let motions = motion::displacements(&placement, &frame);
    let (mut joined, report) = build_tree(&placement, &shared, &balls, (&motions, &frame), trees)?;
    let mesh_of: Vec<usize> = placement.placed.iter().map(|placed| placed.mesh).collect();
    let wide_nodes = widened(&mut joined, trees.layout, &mesh_of)?;
    times.bvh = start.elapsed();

    let start = Instant::now();
    let instances = instances(&placement, &joined, &motions, &frame);
    let declared = Declared { corners: shared.all, welded, balls };
    let mut ordered = order(&placement, &declared, &joined);
    drop(declared);
    counters.references = ordered.triangles.len() as u64;
    counters.spheres = ordered.spheres.len() as u64;
    counters.lights = ordered.lights.len() as u64;
    times.order = start.elapsed();

    let light_nodes = light_tree(&mut ordered, materials.records(), &motions);
    let (sky, sky_table) = sky_records(sky, &ordered.lights);
    if ordered.lights.is_empty() && sky.is_none() {
        diagnostics.push(darkness(scene));
    }
    let material_names = names(scene, loaded, materials.refs());
    let settings = settings(scene, &frame, &joined, ordered.lights.len());
    let declared = medium::records(scene, materials.waters(), &frame);
    let (mut materials, textures) = materials.into_records();
    let (media, [air, fog]) = medium::used(scene, &declared, &mut materials);
    let objects = objects(&placement, &materials, &frame, !motions.is_empty());
    let instances = forget_objects(&objects, &mut ordered, instances);
    motion::mark(&objects, &mut ordered);
    let (textures, texels) = textures.into_records();
    Ok(Lowered {
        render: abi::RenderSettings { air, fog, inside, ..settings },
        camera: camera::camera(&scene.camera, &frame),
        sky,
        sky_table,
        nodes: joined.nodes,
        wide_nodes,
        triangles: ordered.triangles,
        shades: ordered.shades,
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
    })
}

/// The nodes in the layout of the pack: wide ones are returned, and `joined` is left with their roots, the
/// stack that they need, and no nodes. Instance `i` shows mesh `mesh_of[i]`.
fn widened(
    joined: &mut Joined,
    layout: Layout,
    mesh_of: &[usize],
) -> Result<Vec<abi::WideNode>, BvhError> {
    if layout == Layout::Binary || joined.nodes.is_empty() {
        return Ok(Vec::new());
    }
    let mut wide = Vec::new();
    let roots: Vec<u32> =
        std::iter::once(joined.root).chain(joined.mesh_roots.iter().copied()).collect();
    let roots = bvh::widen_all(&joined.nodes, &roots, &mut wide)?;
    let need = bvh::stack_need(&wide, &roots[1..], mesh_of, roots[0]);
    // Four children may wait where two did not: trees that are as deep as binary ones may be stay binary.
    if need > abi::MAX_STACK {
        return Ok(Vec::new());
    }
    joined.root = roots[0];
    joined.mesh_roots = roots[1..].to_vec();
    joined.stack_need = need;
    joined.nodes = Vec::new();
    Ok(wide)
}

/// What the camera is inside of, as `RenderSettings` holds it. Reports what media cannot be in.
fn around_camera(
    scene: &Scene,
    loaded: &Loaded,
    materials: &MaterialTable<'_>,
    placement: &Placement,
    diagnostics: &mut Vec<Diagnostic>,
) -> [u32; 4] {
    let matters = medium::matters(scene, materials.records());
    closed::check(scene, loaded, matters, diagnostics);
    thick::check(scene, loaded, diagnostics);
    if !matters {
        return [NONE; 4];
    }
    let records = materials.records();
    let solids = Solids::find(placement, records, DVec3::from(scene.camera.from));
    solids.warn_of_overlaps(placement, records, scene, diagnostics);
    solids.around_camera(scene, records, diagnostics)
}

/// Centres and radii in the normalised frame; no radius is lost.
fn normalised_spheres(placement: &Placement, frame: &Normalization) -> Vec<([f32; 3], f32)> {
    let sphere = |(center, radius): &(DVec3, f64)| {
        (frame.point(center.to_array()), frame.length(*radius).max(f32::MIN_POSITIVE))
    };
    placement.spheres.iter().map(sphere).collect()
}

/// Refuses more triangles than the pack can number.
fn check_count(placement: &Placement) -> Result<(), LowerError> {
    let stored = placement.meshes.iter().map(|mesh| mesh.corners.len()).sum::<usize>();
    let count = placement.corners.len() + stored;
    if count > bvh::MAX_PRIMITIVES {
        return Err(LowerError::TooManyTriangles { count });
    }
    Ok(())
}

/// Triangles of the world and of meshes that are stored once, one list.
struct Corners {
    /// Those of the world first, then mesh after mesh.
    all: Vec<[[f32; 3]; 3]>,
    n_world: usize,
    meshes: Vec<Vec<[[f32; 3]; 3]>>,
}

/// Adds what is stored once to the triangles of the world, which have these `corners`, and counts both.
fn add_meshes(
    placement: &mut Placement,
    mut corners: Vec<[[f32; 3]; 3]>,
    counters: &mut Counters,
) -> Corners {
    count_triangles(placement, counters);
    let n_world = corners.len();
    let mut meshes = Vec::with_capacity(placement.meshes.len());
    for mesh in &mut placement.meshes {
        placement.shades.append(&mut mesh.shades);
        corners.extend_from_slice(&mesh.corners);
        meshes.push(std::mem::take(&mut mesh.corners));
    }
    Corners { all: corners, n_world, meshes }
}

fn count_triangles(placement: &Placement, counters: &mut Counters) {
    let count = |mesh: usize| placement.meshes[mesh].corners.len() as u64;
    let flat = placement.shades.len() as u64;
    counters.meshes = placement.meshes.len() as u64;
    counters.instances = placement.placed.len() as u64;
    counters.triangles = flat + (0..placement.meshes.len()).map(count).sum::<u64>();
    counters.shown = flat + placement.placed.iter().map(|placed| count(placed.mesh)).sum::<u64>();
    counters.dropped_triangles += placement.meshes.iter().map(|mesh| mesh.dropped).sum::<u64>();
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

/// The trees over all triangles and over these spheres; `motions`: how far each thing comes.
fn build_tree(
    placement: &Placement,
    corners: &Corners,
    balls: &[([f32; 3], f32)],
    (motions, frame): (&[[f32; 3]], &Normalization),
    trees: &Trees<'_>,
) -> Result<(Joined, BuildReport), BvhError> {
    let sizes = placement.mesh_sizes();
    let (mesh_motions, sphere_motions) = motions_of(placement, motions);
    let primitives = Primitives {
        triangles: &corners.all[..corners.n_world],
        mesh_sizes: &sizes,
        mesh_motions: &mesh_motions,
        spheres: balls,
        sphere_motions: &sphere_motions,
    };
    let boxed = |placed: &super::Placed| {
        let motion = motions.get(placed.object as usize).copied().unwrap_or_default();
        (placed.mesh, placed.box_of(frame, motion))
    };
    let instances: Vec<_> = placement.placed.iter().map(boxed).collect();
    let shared = Shared { meshes: &corners.meshes, instances: &instances };
    bvh::build_instanced(&primitives, &shared, trees.preset, trees.cache)
}

/// How far each mesh and each sphere comes, from the displacements of things; empty where those are.
fn motions_of(placement: &Placement, of_thing: &[[f32; 3]]) -> (Vec<[f32; 3]>, Vec<[f32; 3]>) {
    if of_thing.is_empty() {
        return (Vec::new(), Vec::new());
    }
    let sphere = |object: &u32| of_thing[*object as usize];
    let spheres = placement.sphere_objects.iter().map(sphere).collect();
    (placement.mesh_motions(of_thing), spheres)
}

/// The things of the scene, if one of them `moves` or any material asks about them.
fn objects(
    placement: &Placement,
    materials: &[abi::Material],
    frame: &Normalization,
    moves: bool,
) -> Vec<abi::Object> {
    let asked = materials.iter().any(|material| material.flags & material_flag::OBJECT != 0);
    if !asked && !moves {
        return Vec::new();
    }
    placement.things.iter().map(|thing| thing.record(frame)).collect()
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

/// The tree of lights where there are many; tells each light its trail. `motions`: how far each thing comes; empty
/// where nothing moves.
fn light_tree(
    ordered: &mut Ordered,
    materials: &[abi::Material],
    motions: &[[f32; 3]],
) -> Vec<abi::LightNode> {
    let Ordered { lights, shades, spheres, .. } = ordered;
    if !(light_tree::FROM..=light_tree::UP_TO).contains(&lights.len()) {
        return Vec::new();
    }
    let flags = |material: u32| materials[material as usize].flags;
    let both_sides = |material| flags(material) & material_flag::EMIT_BOTH_SIDES != 0;
    let motion = |light: &abi::Light| {
        let primitive = light.primitive as usize;
        let object = if light.kind == abi::LightKind::Sphere as u32 {
            spheres[primitive].object
        } else {
            shades[primitive].object & !TRI_SMOOTH
        };
        motions.get(object as usize).map_or(DVec3::ZERO, |motion| motion.map(f64::from).into())
    };
    let (nodes, trails) = light_tree::tree(lights, both_sides, motion);
    for (light, trail) in lights.iter_mut().zip(trails) {
        light.trail = trail;
    }
    nodes
}

/// The sky, told which light it is and how large its table; and the table, in words.
fn sky_records(
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

fn darkness(scene: &Scene) -> Diagnostic {
    Diagnostic::error(Code("E0710"), "nothing in this scene gives light")
        .at(scene.render.name.span, "this picture would be black")
        .with_help("add a `light`, a `sky`, or an instance with an `emissive` material")
}

fn settings(
    scene: &Scene,
    frame: &Normalization,
    joined: &Joined,
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
        root: joined.root,
        stack_need: joined.stack_need,
        scale_bits: abi::f64_bits(frame.scale()),
        center_x_bits: abi::f64_bits(frame.center[0]),
        center_y_bits: abi::f64_bits(frame.center[1]),
        center_z_bits: abi::f64_bits(frame.center[2]),
        n_lights: n_lights as u32,
        sampler: sampler as u32,
        ..Default::default()
    }
}

/// Name and place of declaration of each material in use.
fn names(scene: &Scene, loaded: &Loaded, refs: &[MaterialRef]) -> Vec<(String, Option<Span>)> {
    let name = |of: &MaterialRef| match *of {
        MaterialRef::Scene(index) => declared(&scene.materials[index].name),
        MaterialRef::Light(index) => declared(&scene.lights[index].name),
        MaterialRef::Default => ("default".to_owned(), None),
        MaterialRef::Asset { asset, material } => {
            let file = loaded.assets[asset].as_ref();
            let own = file.map_or("", |file| file.materials[material].name.as_str());
            let asset = &scene.assets[asset].name;
            (format!("{}/{own}", asset.text), Some(asset.span))
        }
    };
    refs.iter().map(name).collect()
}

fn declared(name: &Name) -> (String, Option<Span>) {
    (name.text.clone(), Some(name.span))
}

fn normalization(placement: &Placement) -> Normalization {
    let corners = placement.corners.iter().flatten().map(DVec3::to_array);
    let balls = placement.spheres.iter().flat_map(|(center, radius)| {
        [(*center - *radius).to_array(), (*center + *radius).to_array()]
    });
    let placed = placement.placed.iter().flat_map(|placed| placed.bounds.map(|p| p.to_array()));
    Normalization::of_points(corners.chain(balls).chain(placed).chain(motion::ends(placement)))
}

/// Corners in the normalised frame; triangles that have no area there are taken out of `placement`.
fn normalised(
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

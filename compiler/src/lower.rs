//! A checked scene and its loaded files become the records of a pack.
//!
//! Each submodule turns one kind of declaration into one kind of record; `lower` puts them
//! together. What no instance uses never gets here: materials and textures are numbered in the
//! order in which geometry first asks for them. It does not know text or the disk.

#![expect(
    clippy::cast_possible_truncation,
    reason = "records hold f32 and u32; indices are bounded by the format's limits before"
)]

pub mod albedo;
mod bounds;
mod camera;
mod closed;
mod edited;
mod extent;
mod files;
mod finish;
mod fit;
mod fresnel;
mod geometry;
mod grain;
mod hidden;
mod inside;
mod light;
mod light_tree;
mod linking;
mod listing;
mod lowered;
mod material;
mod measured;
mod medium;
mod motion;
mod object;
mod occlusion;
mod of_file;
mod order;
mod pieces;
mod power;
mod rows;
mod seen;
mod share;
mod sheet;
mod shutter;
mod sky;
mod sky_table;
mod spread;
mod stored;
mod sun;
mod survey;
mod texture;
mod thick;
mod trees;
mod visibility;
mod world;

use glam::DVec3;
use lang::diagnostic::Diagnostic;
use lang::scene::Scene;
use pack::abi::{self, NONE};

use self::geometry::body::Bodies;
use self::inside::{Boundary, Solids};
use self::material::MaterialTable;
use self::object::Thing;
use self::share::Plan;
use self::shutter::Shutter;
use self::texture::Textures;
use self::world::{Sections, World};
use crate::bvh::Motion;
use crate::normalize::Normalization;
use crate::stage::Stages;

pub use bounds::Bounds;
pub use edited::edited;
pub use files::{Files, Meshes};
pub use fit::framed;
pub use listing::{Listed, Listing, listing};
pub use lowered::{Counters, LowerError, Lowered, Reused, Times};
pub use of_file::of_files;
pub use rows::{Kept, Rows};
pub use share::{Instancing, MIN_SAVED, MIN_TRIANGLES, UnknownInstancing};
pub use sun::with_sun;
pub use texture::srgb_table;
pub use trees::Trees;
pub use visibility::{UnknownVisibility, Visibility};

/// Lowers a scene. Faults of single instances are added to `diagnostics`.
///
/// Results of the last compilation that `stages` has are taken from there.
///
/// # Errors
/// When the scene is too large for the format, or a file cannot be loaded.
pub fn lower(
    scene: &Scene,
    files: &dyn Files,
    trees: &Trees<'_>,
    stages: &Stages,
    diagnostics: &mut Vec<Diagnostic>,
) -> Result<Lowered, LowerError> {
    // What things are, and their materials.
    let plan = Plan::new(scene, files.assets(), trees.instancing, Shutter::of(&scene.camera));
    let mut materials = MaterialTable::new(scene, files, stages);
    let bodies = Bodies::of(scene, &plan, stages, &mut materials, diagnostics)?;
    let sky = sky::sky(scene.sky.as_ref(), (files, stages), &mut materials.textures)?;
    let (textures, has_textures) = materials.textures.made()?;

    spread::powers(scene, &bodies, stages, &mut materials, diagnostics)?;
    motion::check(scene, &bodies, &materials, diagnostics);

    // Where they are.
    let inside = medium::matters(scene, materials.records());
    closed::check(scene, (files, stages), inside, diagnostics)?;
    thick::check(scene, files.assets(), diagnostics);
    let look = seen::Look { scene, bodies: &bodies, materials: &materials, stages };
    seen::check(&look, diagnostics)?;
    let n_far = scene.directional.iter().filter(|light| power::shines(light)).count();
    let world = World { bodies: &bodies, materials: &materials, stages, trees, inside, n_far };
    let progress = world.begin()?;
    let frame = progress.frame();
    let boundaries = inside.then(|| progress.boundaries());
    let inside = around_camera(scene, &materials, &bodies.things, boundaries, diagnostics);

    // What gives light.
    let flux = sky.as_ref().and_then(sky::LoweredSky::flux);
    let far = progress.sky_area().unwrap_or(1.0);
    let mut emitters: Vec<_> = (0..)
        .zip(&scene.directional)
        .map(|(index, light)| power::directional(index, light, far))
        .collect();
    let first = emitters.len();
    emitters.extend(progress.emitters());
    let surfaces = first..emitters.len();
    emitters.extend(flux.and(progress.sky_area()).map(power::sky));
    let choices = light::choices(&power::powers(&emitters, &materials, flux));
    let ids = light::ids(&choices);

    // Triangles, spheres and the tree over them.
    let (sections, times, has_geometry) = world.finish(progress, &ids[surfaces])?;
    let first = scene.instances.len() + scene.lights.len();
    let far: Vec<abi::Light> = (first..)
        .zip(&scene.directional)
        .map(|(object, light)| light::directional(light, object))
        .collect();
    let mut lights = light::table(&emitters, &choices, &far, &sections.lights);
    let motions = motion::displacements(&bodies.things, &frame);
    let motion = |light: &abi::Light| displacement(light, &sections, &motions);
    let still = motions.is_empty() && scene.camera.keys.is_empty();
    let hidden = if trees.visibility == Visibility::Auto && still && lights.len() > 1 {
        let camera = &camera::camera(&scene.camera, &frame);
        let (materials, lights, world) = (&materials, &lights[..], world.key());
        hidden::lights(&hidden::Scene { camera, materials, lights, world, stages }, &sections)
    } else {
        Vec::new()
    };
    let light_nodes = finish::light_tree(&mut lights, &hidden, materials.records(), motion, stages);
    let (sky, sky_table) = finish::sky_records(sky, &lights);
    diagnostics.extend(finish::darkness(scene, &lights, &materials, sky.as_ref()));

    let moves = !motions.is_empty();
    let reused =
        Reused { geometry: has_geometry, parts: stages.used_parts(), textures: has_textures };
    let lit = Lit { sections, times, lights, light_nodes, sky, sky_table, frame, inside, moves };
    Ok(records(scene, &bodies, materials, lit, textures, reused))
}

/// A scene whose geometry and lights are there.
struct Lit {
    sections: Sections,
    times: Times,
    lights: Vec<abi::Light>,
    light_nodes: Vec<abi::LightNode>,
    sky: Option<abi::Sky>,
    sky_table: Vec<[f32; 4]>,
    frame: Normalization,
    /// What the camera is inside of.
    inside: [u32; 4],
    /// Something moves.
    moves: bool,
}

/// Adds what surfaces and the space between them do.
fn records(
    scene: &Scene,
    bodies: &Bodies,
    materials: MaterialTable<'_>,
    lit: Lit,
    textures: Textures,
    reused: Reused,
) -> Lowered {
    let frame = &lit.frame;
    let material_names = materials.names();
    let declared = medium::records(scene, materials.own_media(), frame);
    let mut materials = materials.into_records();
    let (media, around) = medium::used(scene, &declared, &mut materials);
    let mut motion = Vec::new();
    let objects = if lit.moves || finish::asks_about_objects(&materials) {
        bodies.things.iter().map(|thing| thing.record(frame, &mut motion)).collect()
    } else {
        Vec::new()
    };
    let links = linking::links(scene, &lit.lights, &lit.sections);
    let mut media = media;
    linking::media(scene, &links, (&materials, &mut media), (&lit.sections, around));
    let Sections {
        nodes, wide_nodes, triangles, shades, vertex_colors, spheres, instances, ..
    } = lit.sections;
    let inside = (lit.inside, around);
    Lowered {
        render: finish::settings(scene, frame, lit.sections.entry, inside, lit.lights.len()),
        camera: camera::camera(&scene.camera, frame),
        links,
        motion,
        camera_keys: camera::keys(&scene.camera, frame),
        sky: lit.sky,
        sky_table: lit.sky_table,
        albedo: albedo::words(&materials),
        nodes,
        wide_nodes,
        triangles,
        shades,
        vertex_colors,
        spheres,
        objects,
        instances,
        materials,
        media,
        material_names,
        counters: Counters { lights: lit.lights.len() as u64, ..lit.sections.counters },
        lights: lit.lights,
        light_nodes: lit.light_nodes,
        textures: textures.records,
        texels: textures.texels,
        times: lit.times,
        trees: lit.sections.trees,
        reused,
    }
}

/// What the camera is inside of, as `RenderSettings` holds it; nothing without `boundaries`.
fn around_camera(
    scene: &Scene,
    materials: &MaterialTable<'_>,
    things: &[Thing],
    boundaries: Option<&[Boundary]>,
    diagnostics: &mut Vec<Diagnostic>,
) -> [u32; 4] {
    let Some(boundaries) = boundaries else { return [NONE; 4] };
    let materials = materials.records();
    let solids = Solids::new(boundaries, DVec3::from(scene.camera.from));
    solids.warn_of_overlaps(things, materials, scene, diagnostics);
    solids.around_camera(scene, materials, diagnostics)
}

/// By how much at least and at most a light is displaced while the shutter is open; `motions` is empty where nothing
/// moves.
fn displacement(light: &abi::Light, sections: &Sections, motions: &[Motion]) -> [DVec3; 2] {
    if motions.is_empty() || !light.has_surface() {
        return [DVec3::ZERO; 2];
    }
    let motion =
        linking::object_of(light, sections).and_then(|object| motions.get(object as usize));
    motion.map_or([DVec3::ZERO; 2], Motion::range)
}

//! Lowers a scene again whose geometry is that of an earlier pack.
//!
//! Turns the scene as it says now, the earlier pack and what is remembered of it into the records that `lower`
//! would give, to the last bit, without looking at any file. Sections that grow with the geometry and the textures
//! are the pack's own, in place. Who calls it has made sure that everything which geometry depends on is the same,
//! see `again::neutral`; here it is looked at once more where the records tell.

use std::sync::Arc;

use glam::DVec3;
use lang::diagnostic::Diagnostic;
use lang::scene::{Instance, Light, Scene};
use pack::abi::{self, LightKind, NONE};
use pack::{Kind, Pack};

use super::finish::{self, settings};
use super::inside::Solids;
use super::light;
use super::lowered::{Counters, Lowered, Times};
use super::material::MaterialTable;
use super::motion::Shutter;
use super::object::Thing;
use super::rows::Rows;
use super::sketch::{KnownEmitter, KnownSky, Sketch};
use super::sky_source::SkySource;
use super::trees::Trees;
use super::{camera, medium, power};
use crate::bvh::BuildReport;
use crate::normalize::Normalization;

/// Lowers `scene`, whose geometry `pack` has; `sketch` was made with the pack. `None` if the records would not be
/// those of the pack, so that everything must be done. Warnings go to `diagnostics`.
pub fn lower_again(
    scene: &Scene,
    sky_text: &str,
    (pack, sketch): (&Arc<Pack>, &Sketch),
    trees: &Trees<'_>,
    diagnostics: &mut Vec<Diagnostic>,
) -> Option<Lowered> {
    let (center, exponent) = sketch.frame;
    let frame = Normalization { center, exponent };
    let mut table = MaterialTable::again(scene, &sketch.materials, &sketch.textures)?;
    let sky = SkySource::again(scene, sky_text, (pack, &sketch.sky), &mut table.textures)?;
    if !table.textures.is_as_known() {
        return None;
    }
    let mut lights = lights(pack, sketch, &table, sky.flux)?;
    let light_nodes = finish::light_tree_again(pack, &mut lights)
        .unwrap_or_else(|| finish::light_tree(&mut lights, table.records(), |_| DVec3::ZERO));
    let flux = sky.flux;
    let (sky_record, sky_table) = sky.records(&lights);
    diagnostics.extend(finish::darkness(scene, &lights, sky_record.as_ref()));
    let inside = inside(scene, sketch, table.records(), diagnostics);
    let own_name = |index: usize| sketch.own_name(index);
    let material_names = finish::names(scene, table.refs(), own_name);
    let declared = medium::records(scene, table.waters(), &frame);
    let (mut materials, _) = table.into_records();
    let (media, around) = medium::used(scene, &declared, &mut materials);
    let tree = (pack.render().root, pack.render().stack_need);
    Some(Lowered {
        render: settings(scene, &frame, tree, (inside, around), lights.len()),
        camera: camera::camera(&scene.camera, &frame),
        sky: sky_record,
        sky_table,
        nodes: Rows::kept(pack, Kind::NODE, Pack::records),
        wide_nodes: Rows::kept(pack, Kind::WIDENODE, Pack::records),
        triangles: Rows::kept(pack, Kind::TRIANGLE, Pack::records),
        shades: Rows::kept(pack, Kind::TRISHADE, Pack::records),
        spheres: pack.records().to_vec(),
        objects: finish::objects(&things(scene), &materials, &frame, false),
        instances: pack.records().to_vec(),
        materials,
        media,
        material_names,
        counters: Counters { lights: lights.len() as u64, ..sketch.counters },
        lights,
        light_nodes,
        textures: pack.records().to_vec(),
        texels: Rows::kept(pack, Kind::TEXEL, Pack::texels),
        times: Times::default(),
        trees: BuildReport {
            preset: trees.preset,
            groups: sketch.n_trees,
            loaded: sketch.n_trees,
            references: pack.records::<abi::Triangle>().len(),
            ..BuildReport::default()
        },
        sketch: Some(Sketch {
            sky: KnownSky { text: sky_text.to_owned(), flux },
            ..sketch.clone()
        }),
        roster: None,
    })
}

/// Everything that has a place, none of it moving.
fn things(scene: &Scene) -> Vec<Thing> {
    let shutter = Shutter::of(&scene.camera);
    let instance = |instance: &Instance| Thing::of(instance, shutter);
    let light = |light: &Light| Thing::lit(light, shutter);
    scene.instances.iter().map(instance).chain(scene.lights.iter().map(light)).collect()
}

/// The light table; `None` if other emitters would be in it.
fn lights(
    pack: &Pack,
    sketch: &Sketch,
    materials: &MaterialTable<'_>,
    flux: Option<f64>,
) -> Option<Vec<abi::Light>> {
    let mut emitters: Vec<_> = sketch.emitters.iter().map(KnownEmitter::emitter).collect();
    emitters.extend(flux.and(sketch.sky_area).map(power::sky));
    let powers = power::powers(&emitters, materials, flux);
    let selected: Vec<bool> = sketch.emitters.iter().map(|known| known.selected).collect();
    let earlier: &[abi::Light] = pack.records();
    let sky = |light: &&abi::Light| light.kind == LightKind::Sky as u32;
    let n_geometry = earlier.len() - earlier.iter().filter(sky).count();
    light::table_again(&emitters, &powers, &earlier[..n_geometry], &selected)
}

/// What the camera is inside of.
fn inside(
    scene: &Scene,
    sketch: &Sketch,
    materials: &[abi::Material],
    diagnostics: &mut Vec<Diagnostic>,
) -> [u32; 4] {
    if !medium::matters(scene, materials) {
        return [NONE; 4];
    }
    let solids = Solids::new(&sketch.boundaries, DVec3::from(scene.camera.from));
    solids.around_camera(scene, materials, diagnostics)
}

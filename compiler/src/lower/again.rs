//! Lowers a scene again whose geometry is that of an earlier pack.
//!
//! Turns the scene as it says now, the earlier pack and what is remembered of it into the records that `lower`
//! would give, to the last bit, without looking at any file. Sections that grow with the geometry and the textures
//! are the pack's own, in place. Who calls it has made sure that everything which geometry depends on is the same,
//! see `again::neutral`; here it is looked at once more where the records tell.

use std::sync::Arc;

use glam::DVec3;
use lang::diagnostic::Diagnostic;
use lang::scene::{Instance, Light, Scene, SkyModel};
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
use super::texture::TextureTable;
use super::trees::Trees;
use super::{camera, medium, power, sky};
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
    let sky = sky_again(scene, sky_text, (pack, sketch), &mut table.textures)?;
    if !table.textures.is_as_known() {
        return None;
    }
    let mut lights = lights(pack, sketch, &table, sky.flux)?;
    let light_nodes = light_tree(pack, &mut lights, table.records());
    let flux = sky.flux;
    let (sky_record, sky_table) = sky.records(&lights);
    diagnostics.extend(finish::darkness(scene, &lights, sky_record.as_ref()));
    let inside = inside(scene, sketch, table.records(), diagnostics);
    let own_name = |index: usize| sketch.materials[index].own_name.as_deref().unwrap_or_default();
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

/// The tree of lights; that of the pack, if it has these very lights.
fn light_tree(
    pack: &Pack,
    lights: &mut Vec<abi::Light>,
    materials: &[abi::Material],
) -> Vec<abi::LightNode> {
    let earlier: &[abi::Light] = pack.records();
    let without_trail = |light: &abi::Light| abi::Light { trail: 0, ..*light };
    // As bytes: two numbers that are equal may differ in sign.
    let same =
        |(a, b)| bytemuck::bytes_of(&without_trail(a)) == bytemuck::bytes_of::<abi::Light>(b);
    if earlier.len() == lights.len() && earlier.iter().zip(&*lights).all(same) {
        *lights = earlier.to_vec();
        return pack.records().to_vec();
    }
    finish::light_tree(lights, materials, |_| DVec3::ZERO)
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

/// The sky, made now or taken over.
struct Sky {
    flux: Option<f64>,
    form: Form,
}

enum Form {
    Made(Option<sky::LoweredSky>),
    Kept(Option<abi::Sky>, Vec<[f32; 4]>),
}

/// `None` if an image would have to be read.
fn sky_again(
    scene: &Scene,
    text: &str,
    (pack, sketch): (&Pack, &Sketch),
    textures: &mut TextureTable<'_>,
) -> Option<Sky> {
    let is_image = scene.sky.as_ref().is_some_and(|s| matches!(s.model, SkyModel::Image { .. }));
    if text == sketch.sky.text {
        if is_image && pack.sky().is_some() {
            textures.environment(None);
        }
        let table = pack.section_bytes(Kind::SKYTABLE).map_or(&[][..], bytemuck::cast_slice);
        let form = Form::Kept(pack.sky().copied(), table.to_vec());
        return Some(Sky { flux: sketch.sky.flux, form });
    }
    if is_image {
        return None;
    }
    let made = scene.sky.as_ref().and_then(|s| sky::sky(s, None, textures));
    Some(Sky { flux: made.as_ref().and_then(sky::LoweredSky::flux), form: Form::Made(made) })
}

impl Sky {
    /// The record and the table, with the place of the sky among `lights`.
    fn records(self, lights: &[abi::Light]) -> (Option<abi::Sky>, Vec<[f32; 4]>) {
        match self.form {
            Form::Made(made) => finish::sky_records(made, lights),
            Form::Kept(record, table) if table.is_empty() => (record, table),
            Form::Kept(record, table) => {
                let light = lights.iter().position(|light| light.kind == LightKind::Sky as u32);
                let light = light.map_or(NONE, |light| light as u32);
                (record.map(|record| abi::Sky { light, ..record }), table)
            }
        }
    }
}

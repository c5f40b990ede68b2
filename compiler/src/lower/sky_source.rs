//! The sky of a scene: made from what the scene says, or as an earlier pack has it.

use lang::scene::{Scene, SkyModel};
use pack::abi::{self, LightKind, NONE};
use pack::{Kind, Pack};

use super::sketch::KnownSky;
use super::texture::TextureTable;
use super::{finish, sky};
use crate::import::Environment;

/// See the module.
pub(super) struct SkySource {
    /// The integral of its luminance over all directions, if it is to be sampled.
    pub(super) flux: Option<f64>,
    form: Form,
}

enum Form {
    Made(Option<sky::LoweredSky>),
    Kept(Option<abi::Sky>, Vec<[f32; 4]>),
}

impl SkySource {
    /// Made now.
    pub(super) fn new(
        scene: &Scene,
        environment: Option<&Environment>,
        textures: &mut TextureTable<'_>,
    ) -> Self {
        let made = scene.sky.as_ref().and_then(|s| sky::sky(s, environment, textures));
        Self { flux: made.as_ref().and_then(sky::LoweredSky::flux), form: Form::Made(made) }
    }

    /// That of a pack, if `text`, all that is said of it, is what is `known` of it. `None` if an image would have to
    /// be read.
    pub(super) fn again(
        scene: &Scene,
        text: &str,
        (pack, known): (&Pack, &KnownSky),
        textures: &mut TextureTable<'_>,
    ) -> Option<Self> {
        let is_image =
            scene.sky.as_ref().is_some_and(|s| matches!(s.model, SkyModel::Image { .. }));
        if text == known.text {
            if is_image && pack.sky().is_some() {
                textures.environment(None);
            }
            let table = pack.section_bytes(Kind::SKYTABLE).map_or(&[][..], bytemuck::cast_slice);
            let form = Form::Kept(pack.sky().copied(), table.to_vec());
            return Some(Self { flux: known.flux, form });
        }
        (!is_image).then(|| Self::new(scene, None, textures))
    }

    /// The record and the table, with the place of the sky among `lights`.
    pub(super) fn records(self, lights: &[abi::Light]) -> (Option<abi::Sky>, Vec<[f32; 4]>) {
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

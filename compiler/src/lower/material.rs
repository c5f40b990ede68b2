//! Materials in use become `Material` records, numbered in the order in which geometry asks.

mod declared;
mod imported;
mod principled;
mod table;

use pack::abi::{self, MaterialKind, NONE, material_flag};

use super::light::tint;
use table::blank;

pub(super) use table::{MaterialRef, MaterialTable, linear};

/// Reflectance of surfaces that nobody gave a material: a neutral 50 % grey.
const DEFAULT_COLOR: f32 = 0.5;

impl MaterialTable<'_> {
    /// The index of a material, which is lowered at its first use.
    pub(super) fn index(&mut self, of: MaterialRef) -> u32 {
        if let Some(index) = self.position(of) {
            return index;
        }
        let record = match of {
            MaterialRef::Scene(index) => self.declared(&self.scene.materials[index]),
            MaterialRef::Asset { asset, material } => self.imported(asset, material),
            MaterialRef::Light(index) => {
                let light = &self.scene.lights[index];
                let emission = light.radiance.map(|c| c as f32);
                let plain = abi::Material { emission, ..blank(MaterialKind::Emissive) };
                let spot = if light.beam.is_some() { material_flag::EMIT_SPOT } else { 0 };
                let unseen = if light.visible { 0 } else { material_flag::UNSEEN };
                let (profile, color_texture) = match &light.profile {
                    Some(profile) => (material_flag::EMIT_PROFILE, self.profile(profile.texture)),
                    None => (0, NONE),
                };
                let flags = plain.flags | spot | unseen | profile;
                let plain = abi::Material { flags, color_texture, ..plain };
                tint(light).map_or(plain, |tint| abi::Material {
                    tint: tint.color.map(|c| c as f32),
                    flags: plain.flags | material_flag::EMIT_TINT,
                    ..plain
                })
            }
            MaterialRef::Default => {
                abi::Material { color: [DEFAULT_COLOR; 3], ..blank(MaterialKind::Diffuse) }
            }
        };
        self.push(of, record)
    }
}

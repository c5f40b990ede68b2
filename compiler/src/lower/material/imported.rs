//! A material of a mesh file becomes a record.

use pack::abi::{self, MaterialKind, material_flag};

use super::table::{MaterialTable, blank, covering, image_of, set_normal_map, with_ior};
use crate::import::ImportedMaterial;

impl MaterialTable<'_> {
    pub(super) fn imported(&mut self, asset: usize, material: usize) -> abi::Material {
        let files = self.files;
        let from = &files.assets()[asset].materials[material];
        let mut record = if from.unlit {
            let emission = from.color.map(|c| c as f32);
            let map = self.colored_map(&emission, (asset, from.color_map), from.vertex_colors);
            abi::Material { emission, emission_texture: map, ..blank(MaterialKind::Emissive) }
        } else {
            self.imported_surface(asset, from)
        };
        record.flags |= material_flag::EMIT_BOTH_SIDES;
        if !from.unlit && from.normal_strength.abs() > 0.0 {
            let image = self.map(asset, from.normal_map);
            set_normal_map(&mut record, image, from.normal_strength);
        }
        let alpha = from.alpha as f32;
        let least = match from.alpha_map {
            _ if from.vertex_alpha => 0.0,
            None => 1.0,
            Some(map) => self.textures.least((image_of(asset, map), 3)),
        };
        if let Some((flag, cutoff)) = covering(from.alpha_clip, alpha, least) {
            record.flags |= flag;
            record.alpha_cutoff = cutoff;
            record.alpha = alpha;
            let map = (asset, from.alpha_map);
            record.alpha_texture = self.colored_map(&[1.0], map, from.vertex_alpha);
        }
        record
    }

    fn imported_surface(&mut self, asset: usize, from: &ImportedMaterial) -> abi::Material {
        if from.is_glass() {
            let glass = with_ior(blank(MaterialKind::Dielectric), from.ior);
            if from.sigma_a.iter().all(|sigma| *sigma <= 0.0) {
                return glass;
            }
            let medium = self.own_medium(from.sigma_a, [0.0; 3]) as u32;
            return abi::Material { medium, ..glass };
        }
        if from.diffuse_only && from.emission.iter().all(|&c| c <= 0.0) {
            let color = from.color.map(|c| c as f32);
            return abi::Material {
                color,
                color_texture: self.colored_map(
                    &color,
                    (asset, from.color_map),
                    from.vertex_colors,
                ),
                ..blank(MaterialKind::Diffuse)
            };
        }
        self.imported_principled(asset, from)
    }
}

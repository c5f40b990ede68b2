//! Principled materials, declared or of a mesh file, become `Material` records.

use lang::scene::{Color, ColorSpace, Principled, Scalar, Wrap};
use pack::abi::{self, MaterialKind, NONE, material_flag};

use super::table::{MaterialTable, blank, channel, cutting, factor, image_of, switch, with_ior};
use crate::import::{ImportedMaterial, MapUse};
use crate::lower::files::ImageRef;
use crate::lower::texture::Channel;

/// Factor and channel of a scalar.
type Textured = (f32, Option<Channel>);

fn textured(scalar: Scalar) -> Textured {
    (factor(scalar), channel(scalar))
}

impl MaterialTable<'_> {
    pub(super) fn principled(&mut self, from: &Principled) -> abi::Material {
        let (color, color_texture) = self.color(from.color);
        let (emission, emission_texture) = self.emission(from.emission, from.emission_strength);
        let metallic_roughness = [None, channel(from.roughness), channel(from.metallic), None];
        let wrap = self.wrap(&[from.roughness, from.metallic]);
        let mut record = abi::Material {
            color,
            color_texture,
            emission,
            emission_texture,
            roughness: factor(from.roughness),
            metallic: factor(from.metallic),
            metallic_roughness_texture: self.channels(metallic_roughness, wrap),
            flags: material_flag::EMIT_BOTH_SIDES,
            compensation: switch(from.compensation),
            ..with_ior(blank(MaterialKind::Principled), from.ior)
        };
        self.specular(&mut record, from);
        self.coat(&mut record, from);
        let (transmission, through) = textured(from.transmission);
        if transmission > 0.0 {
            record.transmission = transmission;
            let wrap = self.wrap(&[from.transmission]);
            record.transmission_texture = self.channels([through, None, None, None], wrap);
            mark_straight(&mut record);
        }
        self.clip(&mut record, from.alpha, from.alpha_clip);
        record
    }

    /// Cuts out where `alpha` is below `cutoff`, if there is one.
    pub(super) fn clip(&mut self, record: &mut abi::Material, alpha: Scalar, cutoff: Option<f64>) {
        let least = channel(alpha).map_or(1.0, |channel| self.textures.least(channel));
        let Some(cutoff) = cutting(cutoff, factor(alpha), least) else { return };
        record.flags |= material_flag::ALPHA_CLIP;
        record.alpha_cutoff = cutoff;
        record.alpha = factor(alpha);
        let wrap = self.wrap(&[alpha]);
        record.alpha_texture = self.channels([None, None, None, channel(alpha)], wrap);
    }

    /// The texture with this roughness in green, or `NONE`.
    pub(super) fn roughness_texture(&mut self, roughness: Scalar) -> u32 {
        let wrap = self.wrap(&[roughness]);
        self.channels([None, channel(roughness), None, None], wrap)
    }

    fn specular(&mut self, record: &mut abi::Material, from: &Principled) {
        let (specular, alpha) = textured(from.specular);
        record.specular = specular;
        let (image, space, wrap) = match from.specular_color {
            Color::Constant(rgb) => {
                record.tint = rgb.map(|c| c as f32);
                let wrap = self.wrap(&[from.specular]);
                record.specular_texture = self.channels([None, None, None, alpha], wrap);
                return;
            }
            Color::Texture(texture) => {
                let found = &self.scene.textures[texture];
                (ImageRef::Scene(texture), found.space, found.wrap)
            }
        };
        record.specular_texture = self.tinted(image, space, alpha, wrap);
    }

    /// An image for colour whose alpha is `alpha`, or 1.
    fn tinted(
        &mut self,
        image: ImageRef,
        space: ColorSpace,
        alpha: Option<Channel>,
        wrap: [Wrap; 2],
    ) -> u32 {
        if alpha == Some((image, 3)) || (alpha.is_none() && !self.textures.has_alpha(image)) {
            return self.textures.whole(image, space, wrap);
        }
        let [r, g, b] = [0, 1, 2].map(|k| Some((image, k)));
        self.textures.gathered([r, g, b, alpha], space, wrap)
    }

    fn coat(&mut self, record: &mut abi::Material, from: &Principled) {
        let ((coat, share), (roughness, rough)) =
            (textured(from.coat), textured(from.coat_roughness));
        if coat > 0.0 {
            (record.coat, record.coat_roughness) = (coat, roughness);
            let wrap = self.wrap(&[from.coat, from.coat_roughness]);
            record.coat_texture = self.channels([share, rough, None, None], wrap);
        }
    }

    /// A texture of single channels; `NONE` where there is no channel.
    fn channels(&mut self, channels: [Option<Channel>; 4], wrap: [Wrap; 2]) -> u32 {
        if channels.iter().all(Option::is_none) {
            return NONE;
        }
        self.textures.gathered(channels, ColorSpace::Data, wrap)
    }

    /// How the texture of the first textured scalar wraps.
    fn wrap(&self, scalars: &[Scalar]) -> [Wrap; 2] {
        let textures = scalars.iter().filter_map(|scalar| match scalar {
            Scalar::Texture { texture, .. } => Some(self.scene.textures[*texture].wrap),
            Scalar::Constant(_) => None,
        });
        textures.into_iter().next().unwrap_or([Wrap::Repeat; 2])
    }

    /// The principled material of a mesh file.
    pub(super) fn imported_principled(
        &mut self,
        asset: usize,
        from: &ImportedMaterial,
    ) -> abi::Material {
        let [color, emission] = [from.color, from.emission].map(|rgb| rgb.map(|c| c as f32));
        let (metallic, roughness) = (from.metallic as f32, from.roughness as f32);
        let both = from.metallic_roughness_map;
        let mut record = abi::Material {
            color,
            color_texture: self.factor_map(&color, asset, from.color_map),
            emission,
            emission_texture: self.factor_map(&emission, asset, from.emission_map),
            metallic,
            roughness,
            metallic_roughness_texture: self.factor_map(&[metallic, roughness], asset, both),
            specular: from.specular as f32,
            tint: from.specular_color.map(|c| c as f32),
            ..with_ior(blank(MaterialKind::Principled), from.ior)
        };
        let used = |map: Option<MapUse>| map.map(|map| (image_of(asset, map), map));
        match (used(from.specular_color_map), used(from.specular_map)) {
            (Some((image, map)), alpha) => {
                let alpha = alpha.map(|(image, _)| (image, 3));
                record.specular_texture = self.tinted(image, map.space, alpha, map.wrap);
            }
            (None, Some((image, map))) => {
                let channels = [None, None, None, Some((image, 3))];
                record.specular_texture = self.channels(channels, map.wrap);
            }
            (None, None) => {}
        }
        if from.coat > 0.0 {
            record.coat = from.coat as f32;
            record.coat_roughness = from.coat_roughness as f32;
            let maps = [used(from.coat_map), used(from.coat_roughness_map)];
            let wrap = maps.iter().flatten().next().map_or([Wrap::Repeat; 2], |(_, map)| map.wrap);
            let [share, rough] = maps.map(|map| map.map(|(image, _)| image));
            let channels =
                [share.map(|image| (image, 0)), rough.map(|image| (image, 1)), None, None];
            record.coat_texture = self.channels(channels, wrap);
        }
        if from.transmission > 0.0 {
            record.transmission = from.transmission as f32;
            record.transmission_texture = self.map(asset, from.transmission_map);
            mark_straight(&mut record);
        }
        record
    }
}

/// Lets shadow rays through where a sheet may be so smooth that light goes straight through it; the limit of the
/// width of the lobe, roughness squared, is `GLOSS_SMOOTH` of the kernel.
fn mark_straight(record: &mut abi::Material) {
    let textured = record.metallic_roughness_texture != NONE;
    if textured || record.roughness * record.roughness < 1e-3 {
        record.flags |= material_flag::THROUGH;
    }
}

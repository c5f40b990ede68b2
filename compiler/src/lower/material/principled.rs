//! Principled materials, declared or of a mesh file, become `Material` records.

use lang::scene::{Color, ColorSpace, Placement, Principled, Scalar, TextureExpression, Wrap};
use pack::abi::{self, MaterialKind, NONE, material_flag};

use super::table::{MaterialTable, blank, covering, image_of, image_ref, switch, with_ior};
use crate::import::{ImportedMaterial, MapUse};
use crate::lower::files::ImageRef;
use crate::lower::texture::{Channel, expression};

/// A channel that nothing reads, or that is 1.
/// A factor that changes nothing.
pub(super) const ONE: Scalar = Scalar::Constant(1.0);

impl MaterialTable<'_> {
    pub(super) fn principled(&mut self, from: &Principled) -> abi::Material {
        let (color, color_texture) = self.color(from.color);
        let (emission, emission_texture) = self.emission(from.emission, from.emission_strength);
        let metallic_roughness = self.scalars([ONE, from.roughness, from.metallic, ONE]);
        let mut record = abi::Material {
            color,
            color_texture,
            emission,
            emission_texture,
            roughness: self.factor(from.roughness),
            metallic: self.factor(from.metallic),
            metallic_roughness_texture: metallic_roughness,
            flags: material_flag::EMIT_BOTH_SIDES,
            compensation: switch(from.compensation),
            ..with_ior(blank(MaterialKind::Principled), from.ior)
        };
        self.specular(&mut record, from);
        self.coat(&mut record, from);
        self.sheen(&mut record, from);
        brush(&mut record, from.anisotropy, from.anisotropy_rotation);
        let transmission = self.factor(from.transmission);
        if transmission > 0.0 {
            record.transmission = transmission;
            record.transmission_texture = self.scalars([from.transmission, ONE, ONE, ONE]);
            mark_straight(&mut record);
        }
        self.cover(&mut record, from.alpha, from.alpha_clip);
        record
    }

    /// Cuts out where `alpha` is below `cutoff`; without one `alpha` is the share that is there.
    pub(super) fn cover(&mut self, record: &mut abi::Material, alpha: Scalar, cutoff: Option<f64>) {
        let least = self.least(alpha);
        let Some((flag, cutoff)) = covering(cutoff, self.factor(alpha), least) else { return };
        record.flags |= flag;
        record.alpha_cutoff = cutoff;
        record.alpha = self.factor(alpha);
        record.alpha_texture = self.scalars([ONE, ONE, ONE, alpha]);
    }

    /// The texture with this roughness in green, or `NONE`.
    pub(super) fn roughness_texture(&mut self, roughness: Scalar) -> u32 {
        self.scalars([ONE, roughness, ONE, ONE])
    }

    fn specular(&mut self, record: &mut abi::Material, from: &Principled) {
        record.specular = self.factor(from.specular);
        if let Color::Constant(rgb) = from.specular_color {
            record.tint = rgb.map(|c| c as f32);
        }
        record.specular_texture = self.color_and_number(from.specular_color, from.specular);
    }

    fn sheen(&mut self, record: &mut abi::Material, from: &Principled) {
        record.sheen = match from.sheen {
            Color::Constant(rgb) => rgb.map(|c| c as f32),
            Color::Texture(_) | Color::Expression(_) => [1.0; 3],
        };
        if record.has_sheen() {
            record.sheen_roughness = self.factor(from.sheen_roughness);
            record.sheen_texture = self.color_and_number(from.sheen, from.sheen_roughness);
        }
    }

    /// The texture of a colour, and of a number in its alpha; what is constant is 1.
    fn color_and_number(&mut self, color: Color, number: Scalar) -> u32 {
        match color {
            Color::Constant(_) => self.scalars([ONE, ONE, ONE, number]),
            Color::Texture(texture) => {
                let found = &self.scene.textures[texture];
                let alpha = self.channel(number);
                let is_constant = matches!(number, Scalar::Constant(_));
                if found.placement == Placement::NONE && (alpha.is_some() || is_constant) {
                    self.tinted(image_ref(self.scene, texture), found.space, alpha, found.wrap)
                } else {
                    self.computed(&TextureExpression::Image(texture), number)
                }
            }
            Color::Expression(index) => {
                let scene = self.scene;
                self.computed(&scene.expressions[index], number)
            }
        }
    }

    /// A colour, and a number in alpha.
    fn computed(&mut self, color: &TextureExpression<usize>, alpha: Scalar) -> u32 {
        let mut ops = self.operations(color);
        ops.extend(self.number(alpha).unwrap_or_else(|| vec![expression::constant([1.0; 4])]));
        ops.push(expression::insert(3));
        self.textures.expression(ops)
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
        let coat = self.factor(from.coat);
        if coat > 0.0 {
            (record.coat, record.coat_roughness) = (coat, self.factor(from.coat_roughness));
            record.coat_texture = self.scalars([from.coat, from.coat_roughness, ONE, ONE]);
        }
    }

    /// A texture of single channels; `NONE` where there is no channel.
    pub(super) fn channels(&mut self, channels: [Option<Channel>; 4], wrap: [Wrap; 2]) -> u32 {
        if channels.iter().all(Option::is_none) {
            return NONE;
        }
        self.textures.gathered(channels, ColorSpace::Data, wrap)
    }

    /// A texture of the colours of one image and the alpha of another.
    fn color_and_alpha(&mut self, color: Used, alpha: Used) -> u32 {
        match (color, alpha) {
            (Some((image, map)), alpha) => {
                let alpha = alpha.map(|(image, _)| (image, 3));
                self.tinted(image, map.space, alpha, map.wrap)
            }
            (None, Some((image, map))) => {
                self.channels([None, None, None, Some((image, 3))], map.wrap)
            }
            (None, None) => NONE,
        }
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
            color_texture: self.colored_map(&color, (asset, from.color_map), from.vertex_colors),
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
        record.specular_texture =
            self.color_and_alpha(used(from.specular_color_map), used(from.specular_map));
        record.sheen = from.sheen.map(|c| c as f32);
        if record.has_sheen() {
            record.sheen_roughness = from.sheen_roughness as f32;
            record.sheen_texture =
                self.color_and_alpha(used(from.sheen_map), used(from.sheen_roughness_map));
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
        if brush(&mut record, from.anisotropy, from.anisotropy_rotation) {
            record.anisotropy_texture = self.map(asset, from.anisotropy_map);
        }
        if from.transmission > 0.0 {
            record.transmission = from.transmission as f32;
            record.transmission_texture = self.map(asset, from.transmission_map);
            mark_straight(&mut record);
        }
        record
    }
}

/// An image, and how it is used.
type Used = Option<(ImageRef, MapUse)>;

/// Brushes the surface, `rotation` radians from its tangent, if there is any anisotropy.
fn brush(record: &mut abi::Material, anisotropy: f64, rotation: f64) -> bool {
    let brushed = anisotropy > 0.0;
    if brushed {
        record.anisotropy = anisotropy as f32;
        let turns = rotation / std::f64::consts::TAU;
        record.anisotropy_turn = (turns - libm::floor(turns)) as f32;
        record.flags |= material_flag::TANGENT;
    }
    brushed
}

/// Lets shadow rays through where a sheet may be so smooth that light goes straight through it; the limit of the
/// width of the lobe, roughness squared, is `GLOSS_SMOOTH` of the kernel.
fn mark_straight(record: &mut abi::Material) {
    let textured = record.metallic_roughness_texture != NONE;
    if textured || record.roughness * record.roughness < 1e-3 {
        record.flags |= material_flag::THROUGH;
    }
}

//! The materials in use and the textures they read: records, and what else is asked about them.
//!
//! It does not know how a material becomes a record.

use lang::scene::{
    self, Color, ColorSpace, MeshImage, Placement, Scalar, Scene, TextureExpression, Wrap,
};
use pack::abi::{self, MaterialKind, NONE, TextureOp, material_flag};

use crate::import::MapUse;
use crate::lower::files::{Files, ImageRef};
use crate::lower::light::luminance;
use crate::lower::medium::{OwnMedium, has_inside};
use crate::lower::texture::{Channel, TextureTable, expression};
use crate::stage::Stages;

/// Where a material is declared.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(in crate::lower) enum MaterialRef {
    /// Index into `Scene::materials`.
    Scene(usize),
    /// Material of a mesh file.
    Asset {
        /// Index into `Scene::assets`.
        asset: usize,
        /// Index into `MeshFile::materials`.
        material: usize,
    },
    /// The emission of a `light`, index into `Scene::lights`.
    Light(usize),
    /// Grey Lambert, for parts of mesh files that name no material.
    Default,
}

/// Materials, and the textures they use.
pub(in crate::lower) struct MaterialTable<'a> {
    pub(in crate::lower) scene: &'a Scene,
    pub(in crate::lower) files: &'a dyn Files,
    pub(in crate::lower) textures: TextureTable<'a>,
    refs: Vec<MaterialRef>,
    records: Vec<abi::Material>,
    glows: Vec<f64>,
    pub(super) own_media: Vec<OwnMedium>,
}

impl<'a> MaterialTable<'a> {
    pub(in crate::lower) fn new(
        scene: &'a Scene,
        files: &'a dyn Files,
        stages: &'a Stages,
    ) -> Self {
        let (refs, records, glows, own_media) = Default::default();
        let textures = TextureTable::new(files, stages);
        Self { scene, files, textures, refs, records, glows, own_media }
    }

    pub(in crate::lower) fn records(&self) -> &[abi::Material] {
        &self.records
    }

    /// What fills things whose material names no medium; these follow the media of the scene.
    pub(in crate::lower) fn own_media(&self) -> &[OwnMedium] {
        &self.own_media
    }

    /// Name and place of declaration of each.
    pub(in crate::lower) fn names(&self) -> Vec<(String, Option<lang::source::Span>)> {
        let declared = |name: &scene::Name| (name.text.clone(), Some(name.span));
        let name = |of: &MaterialRef| match *of {
            MaterialRef::Scene(index) => declared(&self.scene.materials[index].name),
            MaterialRef::Light(index) => declared(&self.scene.lights[index].name),
            MaterialRef::Default => ("default".to_owned(), None),
            MaterialRef::Asset { asset, material } => {
                let own = &self.files.assets()[asset].materials[material].name;
                let asset = &self.scene.assets[asset].name;
                (format!("{}/{own}", asset.text), Some(asset.span))
            }
        };
        self.refs.iter().map(name).collect()
    }

    /// Luminance of a material's mean radiance, counted for each side that emits.
    pub(in crate::lower) fn glow(&self, index: u32) -> f64 {
        self.glows[index as usize]
    }

    /// Whether any texture belongs to the material, or to what it is mixed from, and is looked up at texture
    /// coordinates.
    pub(in crate::lower) fn reads_textures(&self, index: u32) -> bool {
        let record = &self.records[index as usize];
        let is_mix = record.kind == MaterialKind::Mix as u32;
        let is_projected = record.flags & material_flag::PROJECT != 0;
        let at_uvs = |texture: &u32| *texture != NONE && self.textures.reads_uvs(*texture);
        !is_projected && record.textures().iter().any(at_uvs)
            || is_mix && record.parts().into_iter().any(|part| self.reads_textures(part))
    }

    /// Whether any texture of the material, or of what it is mixed from, reads the colours of vertices.
    pub(in crate::lower) fn reads_vertex_colors(&self, index: u32) -> bool {
        let record = &self.records[index as usize];
        let is_mix = record.kind == MaterialKind::Mix as u32;
        let reads = |texture: &u32| *texture != NONE && self.textures.reads_vertex_colors(*texture);
        record.textures().iter().any(reads)
            || is_mix && record.parts().into_iter().any(|part| self.reads_vertex_colors(part))
    }

    /// What geometry knows of a material: whether it gives light, and whether it has an inside.
    pub(in crate::lower) fn looks(&self, index: u32) -> Looks {
        Looks {
            glows: self.glow(index) > 0.0,
            has_inside: has_inside(&self.records[index as usize]),
            is_partial: self.records[index as usize].is_partial(),
        }
    }

    /// Whether a material of partial coverage gives light, of which the table of lights may have nothing.
    pub(in crate::lower) fn has_partial_glow(&self) -> bool {
        self.records
            .iter()
            .zip(&self.glows)
            .any(|(record, glow)| record.is_partial() && *glow > 0.0)
    }

    /// Of each material, whether it stops light.
    pub(in crate::lower) fn opaque(&self) -> Vec<bool> {
        let stops = |material: &abi::Material| {
            const HOLES: u32 =
                material_flag::ALPHA_CLIP | material_flag::ALPHA_BLEND | material_flag::THROUGH;
            let holes = material.flags & HOLES != 0;
            let kind = MaterialKind::from_tag(material.kind);
            // That principled materials may transmit is said by their flags.
            let transmits =
                kind.is_none_or(|kind| kind != MaterialKind::Principled && kind.traits().transmits);
            !holes && !transmits && !has_inside(material)
        };
        self.records.iter().map(stops).collect()
    }

    /// The number of a medium that absorbs this much per metre, for a material that names none; `color`: radiance of the
    /// deep.
    pub(super) fn own_medium(&mut self, sigma_a: scene::Rgb, color: scene::Rgb) -> usize {
        self.own_media.push(OwnMedium { sigma_a, color });
        self.scene.media.len() + self.own_media.len() - 1
    }

    /// The index of a material, if it is known.
    pub(in crate::lower) fn position(&self, of: MaterialRef) -> Option<u32> {
        self.refs.iter().position(|known| *known == of).map(|index| index as u32)
    }

    /// Adds a material; its index.
    pub(super) fn push(&mut self, of: MaterialRef, record: abi::Material) -> u32 {
        let glow = self.glow_of(&record);
        self.refs.push(of);
        self.records.push(record);
        self.glows.push(glow);
        (self.records.len() - 1) as u32
    }

    /// Multiplies the emission of a material; whether it is still a number that a pack can hold.
    pub(in crate::lower) fn brighten(&mut self, index: u32, factor: f64) -> bool {
        let record = &mut self.records[index as usize];
        record.emission = record.emission.map(|c| (f64::from(c) * factor) as f32);
        self.glows[index as usize] *= factor;
        record.emission.iter().all(|c| f64::from(*c) <= lang::schema::MAX_MAGNITUDE)
    }

    fn glow_of(&mut self, record: &abi::Material) -> f64 {
        let sides = if record.flags & material_flag::EMIT_BOTH_SIDES != 0 { 2.0 } else { 1.0 };
        sides
            * luminance(self.mean_emission(record))
            * self.mean_coverage(record)
            * self.mean_profile(record)
    }

    /// Mean brightness of a light over its profile; a lamp whose profile is black still has its place.
    fn mean_profile(&mut self, record: &abi::Material) -> f64 {
        if record.flags & material_flag::EMIT_PROFILE == 0 {
            return 1.0;
        }
        self.textures.mean(record.color_texture)[0].max(1e-6)
    }

    /// Mean share of a surface that is there.
    fn mean_coverage(&mut self, record: &abi::Material) -> f64 {
        if !record.is_partial() {
            return 1.0;
        }
        let texture = record.alpha_texture;
        let mean = if texture == NONE { 1.0 } else { self.textures.mean(texture)[3] };
        (f64::from(record.alpha) * mean).clamp(0.0, 1.0)
    }

    /// Mean emitted radiance of a material, over its texture if it has one.
    fn mean_emission(&mut self, record: &abi::Material) -> [f64; 3] {
        let factor = record.emission.map(f64::from);
        if record.emission_texture == NONE {
            return factor;
        }
        let mean = self.textures.mean(record.emission_texture);
        [0, 1, 2].map(|k| factor[k] * mean[k])
    }

    pub(in crate::lower) fn into_records(self) -> Vec<abi::Material> {
        self.records
    }

    /// Factor and texture of a declared colour.
    pub(in crate::lower) fn color(&mut self, color: Color) -> ([f32; 3], u32) {
        match color {
            Color::Constant(rgb) => (rgb.map(|c| c as f32), NONE),
            Color::Texture(texture) => ([1.0; 3], self.image(texture)),
            Color::Expression(index) => {
                let scene = self.scene;
                let of = &scene.expressions[index];
                match tinted_image(of) {
                    Some((factor, texture)) => (factor, self.image(texture)),
                    None => ([1.0; 3], self.expression(of)),
                }
            }
        }
    }

    /// A declared image where it is placed.
    fn image(&mut self, texture: usize) -> u32 {
        let scene::Texture { space, wrap, placement, .. } = &self.scene.textures[texture];
        let id = self.textures.whole(image_ref(self.scene, texture), *space, *wrap);
        if *placement == Placement::NONE {
            return id;
        }
        self.textures.expression(vec![expression::image(id, placement)])
    }

    /// A declared image of the light of a lamp by direction, whatever it is elsewhere.
    pub(super) fn profile(&mut self, texture: usize) -> u32 {
        let wrap = [Wrap::Repeat, Wrap::Clamp];
        self.textures.whole(image_ref(self.scene, texture), ColorSpace::Linear, wrap)
    }

    /// A declared image of normals where it is placed.
    pub(super) fn normals(&mut self, texture: usize) -> u32 {
        let scene::Texture { space, wrap, placement, .. } = &self.scene.textures[texture];
        let id = self.textures.whole(image_ref(self.scene, texture), *space, *wrap);
        if *placement == Placement::NONE {
            return id;
        }
        let ops = vec![expression::image(id, placement), expression::tilt(placement)];
        self.textures.expression(ops)
    }

    fn expression(&mut self, of: &TextureExpression<usize>) -> u32 {
        let ops = self.operations(of);
        self.textures.expression(ops)
    }

    /// The operations that leave the value of an expression.
    pub(super) fn operations(&mut self, of: &TextureExpression<usize>) -> Vec<TextureOp> {
        let scene = self.scene;
        expression::operations(of, &mut |texture| {
            let scene::Texture { space, wrap, placement, .. } = &scene.textures[texture];
            let id = self.textures.whole(image_ref(scene, texture), linear(*space), *wrap);
            vec![expression::image(id, placement)]
        })
    }

    /// A number as a constant factor and the rest, which is a channel where the number is nothing but their product.
    fn split(&self, scalar: Scalar) -> (f64, Scalar) {
        match scalar {
            Scalar::Constant(value) => (value, Scalar::Constant(1.0)),
            Scalar::Texture { .. } => (1.0, scalar),
            Scalar::Expression(index) => match scaled_channel(&self.scene.expressions[index]) {
                Some((factor, (texture, channel))) => {
                    (factor, Scalar::Texture { texture, channel })
                }
                None => (1.0, scalar),
            },
        }
    }

    /// The constant factor of a number; that of its texture is in the texture.
    pub(super) fn factor(&self, scalar: Scalar) -> f32 {
        self.split(scalar).0 as f32
    }

    /// The channel of an image that a number is, but for its factor.
    pub(super) fn channel(&self, scalar: Scalar) -> Option<Channel> {
        match self.split(scalar).1 {
            Scalar::Constant(_) | Scalar::Expression(_) => None,
            Scalar::Texture { texture, channel } => Some((image_ref(self.scene, texture), channel)),
        }
    }

    /// A texture whose channels are these numbers but for their factors, 1 for those that are the same everywhere;
    /// `NONE` if all are.
    pub(super) fn scalars(&mut self, lanes: [Scalar; 4]) -> u32 {
        let lanes = lanes.map(|lane| self.split(lane).1);
        let is_plain = |lane: &Scalar| match lane {
            Scalar::Constant(_) => true,
            Scalar::Texture { texture, .. } => {
                self.scene.textures[*texture].placement == Placement::NONE
            }
            Scalar::Expression(_) => false,
        };
        if lanes.iter().all(is_plain) {
            let wrap = lanes.iter().find_map(|lane| match lane {
                Scalar::Texture { texture, .. } => Some(self.scene.textures[*texture].wrap),
                Scalar::Constant(_) | Scalar::Expression(_) => None,
            });
            let channels = lanes.map(|lane| self.channel(lane));
            return self.channels(channels, wrap.unwrap_or([Wrap::Repeat; 2]));
        }
        let mut ops = vec![expression::constant([1.0; 4])];
        for (k, lane) in lanes.into_iter().enumerate() {
            if let Some(lane) = self.number(lane) {
                ops.extend(lane);
                ops.push(expression::insert(k));
            }
        }
        self.textures.expression(ops)
    }

    /// The operations that leave a number but for its factor; none for one that is the same everywhere.
    pub(super) fn number(&mut self, scalar: Scalar) -> Option<Vec<TextureOp>> {
        let scene = self.scene;
        match self.split(scalar).1 {
            Scalar::Constant(_) => None,
            Scalar::Texture { texture, channel } => {
                Some(self.operations(&TextureExpression::Channel(texture, channel)))
            }
            Scalar::Expression(index) => Some(self.operations(&scene.expressions[index])),
        }
    }

    /// The least that a number is anywhere, in proportion to its factor.
    pub(super) fn least(&mut self, scalar: Scalar) -> f32 {
        match self.split(scalar).1 {
            Scalar::Constant(_) => 1.0,
            Scalar::Texture { texture, channel } => {
                self.textures.least((image_ref(self.scene, texture), channel))
            }
            Scalar::Expression(index) => self.scene.expressions[index].range()[0] as f32,
        }
    }

    /// Factor and texture of a declared emission; no texture where the factor is 0.
    pub(in crate::lower) fn emission(&mut self, color: Color, strength: f64) -> ([f32; 3], u32) {
        if strength <= 0.0 {
            return ([0.0; 3], NONE);
        }
        let (color, texture) = self.color(color);
        (color.map(|c| (f64::from(c) * strength) as f32), texture)
    }

    /// A map whose numbers are multiplied by these factors; `NONE` where all of them are 0.
    pub(in crate::lower) fn factor_map(
        &mut self,
        factors: &[f32],
        asset: usize,
        map: Option<MapUse>,
    ) -> u32 {
        let read = factors.iter().any(|factor| *factor > 0.0);
        self.map(asset, map.filter(|_| read))
    }

    /// As `factor_map`, times the colours of vertices if `colored`.
    pub(super) fn colored_map(
        &mut self,
        factors: &[f32],
        (asset, map): (usize, Option<MapUse>),
        colored: bool,
    ) -> u32 {
        let image = self.factor_map(factors, asset, map);
        if !colored || factors.iter().all(|factor| *factor <= 0.0) {
            return image;
        }
        self.textures.expression(expression::vertex_color((image != NONE).then_some(image)))
    }

    pub(in crate::lower) fn map(&mut self, asset: usize, map: Option<MapUse>) -> u32 {
        map.map_or(NONE, |map| {
            self.textures.whole(image_of(asset, map), linear(map.space), map.wrap)
        })
    }
}

/// What geometry knows of a material.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(in crate::lower) struct Looks {
    /// It gives light.
    pub(in crate::lower) glows: bool,
    /// Light goes through it into an inside.
    pub(in crate::lower) has_inside: bool,
    /// Only a share of it is there.
    pub(in crate::lower) is_partial: bool,
}

/// A material of this kind without textures and layers, opaque, black, ior 1.5.
pub(in crate::lower) fn blank(kind: MaterialKind) -> abi::Material {
    let base = abi::Material {
        kind: kind as u32,
        alpha: 1.0,
        color_texture: NONE,
        emission_texture: NONE,
        metallic_roughness_texture: NONE,
        alpha_texture: NONE,
        normal_texture: NONE,
        normal_strength: 1.0,
        medium: NONE,
        specular: 1.0,
        compensation: 1.0,
        tint: if kind == MaterialKind::Principled { [1.0; 3] } else { [0.0; 3] },
        specular_texture: NONE,
        coat_texture: NONE,
        transmission_texture: NONE,
        anisotropy_texture: NONE,
        sheen_texture: NONE,
        ..Default::default()
    };
    with_ior(base, 1.5)
}

/// Whether a surface whose coverage is `alpha` times an image that is `least` at least lets some rays by, and how: where
/// its coverage is below `cutoff`, or by chance. The flag, and the cutoff. What lies nowhere below needs no test, for any
/// ray.
pub(in crate::lower) fn covering(
    cutoff: Option<f64>,
    alpha: f32,
    least: f32,
) -> Option<(u32, f32)> {
    let (flag, limit) = match cutoff {
        Some(cutoff) => (material_flag::ALPHA_CLIP, cutoff as f32),
        None => (material_flag::ALPHA_BLEND, 1.0),
    };
    let everywhere = alpha * least;
    // A NaN in an image keeps the test.
    (everywhere < limit || everywhere.is_nan()).then_some((flag, limit))
}

/// Gives the material a normal map, if there is one.
pub(super) fn set_normal_map(material: &mut abi::Material, image: u32, strength: f64) {
    if image != NONE {
        material.normal_texture = image;
        material.normal_strength = strength as f32;
        material.flags |= material_flag::TANGENT;
    }
}

pub(in crate::lower) fn with_ior(material: abi::Material, ior: f64) -> abi::Material {
    abi::Material { ior: ior as f32, ior_minus_1: (ior - 1.0) as f32, ..material }
}

/// What a record holds for `on` and `off`.
pub(in crate::lower) fn switch(on: bool) -> f32 {
    if on { 1.0 } else { 0.0 }
}

/// The image of a texture of the scene.
pub(super) fn image_ref(scene: &Scene, texture: usize) -> ImageRef {
    match scene.textures[texture].of_mesh {
        Some(MeshImage { asset, image }) => ImageRef::Asset { asset, image },
        None => ImageRef::Scene(texture),
    }
}

/// The constant factor and the image of what is nothing but their product.
fn tinted_image(of: &TextureExpression<usize>) -> Option<([f32; 3], usize)> {
    let TextureExpression::Product(parts) = of else { return None };
    let (factor, texture) = match parts.as_slice() {
        [TextureExpression::Image(texture), TextureExpression::Color(rgb)]
        | [TextureExpression::Color(rgb), TextureExpression::Image(texture)] => (*rgb, texture),
        [TextureExpression::Image(texture), TextureExpression::Number(x)]
        | [TextureExpression::Number(x), TextureExpression::Image(texture)] => ([*x; 3], texture),
        _ => return None,
    };
    Some((factor.map(|c| c as f32), *texture))
}

/// The constant factor and the channel of what is nothing but their product.
fn scaled_channel(of: &TextureExpression<usize>) -> Option<(f64, (usize, u8))> {
    let TextureExpression::Product(parts) = of else { return None };
    match parts.as_slice() {
        [TextureExpression::Channel(texture, channel), TextureExpression::Number(x)]
        | [TextureExpression::Number(x), TextureExpression::Channel(texture, channel)] => {
            Some((*x, (*texture, *channel)))
        }
        _ => None,
    }
}

/// Bytes that are not colours are the same numbers under either linear name.
pub(in crate::lower) fn linear(space: ColorSpace) -> ColorSpace {
    match space {
        ColorSpace::Data => ColorSpace::Linear,
        space @ (ColorSpace::Srgb | ColorSpace::Linear) => space,
    }
}

/// The image of a map of a mesh file.
pub(in crate::lower) fn image_of(asset: usize, map: MapUse) -> ImageRef {
    ImageRef::Asset { asset, image: map.image as usize }
}

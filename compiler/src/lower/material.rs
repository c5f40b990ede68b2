//! Materials in use become `Material` records, numbered in the order in which geometry asks.

mod declared;
mod imported;
mod principled;

use lang::scene::{self, Color, ColorSpace, Scalar, Scene};
use pack::abi::{self, MaterialKind, NONE, material_flag};
use serde::{Deserialize, Serialize};

use super::light::luminance;
use super::medium::Water;
use super::texture::{ImageRef, TextureTable};
use super::{Loaded, light};
use crate::import::MapUse;
use principled::image_of;

/// Where a material is declared.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
pub(super) enum MaterialRef {
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

/// Reflectance of surfaces that nobody gave a material: a neutral 50 % grey.
const DEFAULT_COLOR: f32 = 0.5;

/// Materials, and the textures they use.
pub(super) struct MaterialTable<'a> {
    pub(super) scene: &'a Scene,
    /// `None` where mesh files are not looked at.
    pub(super) loaded: Option<&'a Loaded>,
    pub(super) textures: TextureTable<'a>,
    refs: Vec<MaterialRef>,
    records: Vec<abi::Material>,
    /// Of each material, how many textures there were with those of it.
    pub(super) n_textures: Vec<usize>,
    waters: Vec<Water>,
}

impl<'a> MaterialTable<'a> {
    pub(super) fn new(scene: &'a Scene, loaded: &'a Loaded) -> Self {
        Self::over(scene, Some(loaded), TextureTable::new(loaded))
    }

    pub(super) fn over(
        scene: &'a Scene,
        loaded: Option<&'a Loaded>,
        textures: TextureTable<'a>,
    ) -> Self {
        let (refs, records, n_textures, waters) = Default::default();
        Self { scene, loaded, textures, refs, records, n_textures, waters }
    }

    /// The same without the files: no other material may be asked for.
    pub(super) fn without_files(self, scene: &Scene) -> MaterialTable<'_> {
        let Self { scene: _, loaded: _, textures, refs, records, n_textures, waters } = self;
        let textures = textures.without_images();
        MaterialTable { scene, loaded: None, textures, refs, records, n_textures, waters }
    }

    pub(super) fn push(&mut self, of: MaterialRef, record: abi::Material) {
        self.refs.push(of);
        self.records.push(record);
        self.n_textures.push(self.textures.len());
    }

    /// The index of a material, which is lowered at its first use.
    pub(super) fn index(&mut self, of: MaterialRef) -> u32 {
        if let Some(index) = self.refs.iter().position(|known| *known == of) {
            return index as u32;
        }
        let record = match of {
            MaterialRef::Scene(index) => self.declared(&self.scene.materials[index]),
            MaterialRef::Asset { asset, material } => self.imported(asset, material),
            MaterialRef::Light(index) => {
                let light = &self.scene.lights[index];
                let emission = light.radiance.map(|c| c as f32);
                let plain = abi::Material { emission, ..blank(MaterialKind::Emissive) };
                light::tint(light).map_or(plain, |tint| abi::Material {
                    tint: tint.color.map(|c| c as f32),
                    flags: plain.flags | material_flag::EMIT_TINT,
                    ..plain
                })
            }
            MaterialRef::Default => {
                abi::Material { color: [DEFAULT_COLOR; 3], ..blank(MaterialKind::Diffuse) }
            }
        };
        self.push(of, record);
        (self.records.len() - 1) as u32
    }

    pub(super) fn records(&self) -> &[abi::Material] {
        &self.records
    }

    /// What waters are filled with that name no medium; their media follow those of the scene.
    pub(super) fn waters(&self) -> &[Water] {
        &self.waters
    }

    pub(super) fn refs(&self) -> &[MaterialRef] {
        &self.refs
    }

    /// Luminance of a material's mean radiance, counted for each side that emits.
    pub(super) fn glow(&self, index: u32) -> f64 {
        let flags = self.records[index as usize].flags;
        let sides = if flags & material_flag::EMIT_BOTH_SIDES != 0 { 2.0 } else { 1.0 };
        sides * luminance(self.mean_emission(index))
    }

    /// Mean emitted radiance of a material, over its texture if it has one.
    fn mean_emission(&self, index: u32) -> [f64; 3] {
        let record = &self.records[index as usize];
        let factor = record.emission.map(f64::from);
        if record.emission_texture == NONE {
            return factor;
        }
        let mean = self.textures.mean(record.emission_texture);
        [0, 1, 2].map(|k| factor[k] * mean[k])
    }

    pub(super) fn into_records(self) -> (Vec<abi::Material>, TextureTable<'a>) {
        (self.records, self.textures)
    }

    /// Factor and texture of a declared colour.
    pub(super) fn color(&mut self, color: Color) -> ([f32; 3], u32) {
        match color {
            Color::Constant(rgb) => (rgb.map(|c| c as f32), NONE),
            Color::Texture(texture) => {
                let scene::Texture { space, wrap, .. } = &self.scene.textures[texture];
                let id = self.textures.whole(ImageRef::Scene(texture), *space, *wrap);
                ([1.0; 3], id)
            }
        }
    }

    /// Factor and texture of a declared emission; no texture where the factor is 0.
    pub(super) fn emission(&mut self, color: Color, strength: f64) -> ([f32; 3], u32) {
        if strength <= 0.0 {
            return ([0.0; 3], NONE);
        }
        let (color, texture) = self.color(color);
        (color.map(|c| (f64::from(c) * strength) as f32), texture)
    }

    /// A map whose numbers are multiplied by these factors; `NONE` where all of them are 0.
    pub(super) fn factor_map(&mut self, factors: &[f32], asset: usize, map: Option<MapUse>) -> u32 {
        let read = factors.iter().any(|factor| *factor > 0.0);
        self.map(asset, map.filter(|_| read))
    }

    pub(super) fn map(&mut self, asset: usize, map: Option<MapUse>) -> u32 {
        map.map_or(NONE, |map| {
            let image = image_of(asset, map);
            // Bytes that are not colours are the same numbers under either linear name.
            let space = match map.space {
                ColorSpace::Data => ColorSpace::Linear,
                space @ (ColorSpace::Srgb | ColorSpace::Linear) => space,
            };
            self.textures.whole(image, space, map.wrap)
        })
    }
}

/// A material of this kind without textures and layers, opaque, black, ior 1.5.
pub(super) fn blank(kind: MaterialKind) -> abi::Material {
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
        tint: if kind == MaterialKind::Principled { [1.0; 3] } else { [0.0; 3] },
        specular_texture: NONE,
        coat_texture: NONE,
        transmission_texture: NONE,
        ..Default::default()
    };
    with_ior(base, 1.5)
}

/// The least coverage that exists, where some of the surface does not: `alpha` times an image that is
/// `least` at least lies below. What lies nowhere below needs no test, for any ray.
pub(super) fn cutting(cutoff: Option<f64>, alpha: f32, least: f32) -> Option<f32> {
    let cutoff = cutoff? as f32;
    let everywhere = alpha * least;
    // A NaN in an image keeps the test.
    (everywhere < cutoff || everywhere.is_nan()).then_some(cutoff)
}

/// Gives the material a normal map, if there is one.
fn set_normal_map(material: &mut abi::Material, image: u32, strength: f64) {
    if image != NONE {
        material.normal_texture = image;
        material.normal_strength = strength as f32;
        material.flags |= material_flag::TANGENT;
    }
}

pub(super) fn with_ior(material: abi::Material, ior: f64) -> abi::Material {
    abi::Material { ior: ior as f32, ior_minus_1: (ior - 1.0) as f32, ..material }
}

pub(super) fn factor(scalar: Scalar) -> f32 {
    match scalar {
        Scalar::Constant(value) => value as f32,
        Scalar::Texture { .. } => 1.0,
    }
}

pub(super) fn channel(scalar: Scalar) -> Option<(ImageRef, u8)> {
    match scalar {
        Scalar::Constant(_) => None,
        Scalar::Texture { texture, channel } => Some((ImageRef::Scene(texture), channel)),
    }
}

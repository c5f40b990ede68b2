//! Materials in use become `Material` records, numbered in the order in which geometry asks.

use lang::scene::{
    self, Color, ColorSpace, Inside, Leaf, MaterialModel, Pattern, Petal, Rgb, Scalar, Scene,
};
use pack::abi::{self, MaterialKind, NONE, material_flag};
use serde::{Deserialize, Serialize};

use super::light::luminance;
use super::medium::Water;
use super::principled::image_of;
use super::texture::{ImageRef, TextureTable};
use super::{Loaded, fresnel, light};
use crate::import::{ImportedMaterial, MapUse};

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

/// Veins of stone are this share of its colour where the scene says nothing else.
const VEIN: f64 = 0.4;

/// What `Material::fuzz` says of the grain along x, y, z: the middles of the thirds that the kernel tells apart,
/// the first third being y.
const GRAIN_CODES: [f32; 3] = [1.0 / 2.0, 1.0 / 6.0, 5.0 / 6.0];

/// Late wood is denser: darker, and more so in blue, where wood absorbs most.
fn late_wood([r, g, b]: [f64; 3]) -> [f64; 3] {
    [r * 0.5, g * 0.38, b * 0.3]
}

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

    fn declared(&mut self, material: &scene::Material) -> abi::Material {
        let mut record = self.model(&material.model);
        // A map of strength 0 does nothing, and its image is not needed.
        if let Some(map) = material.normal.as_ref().filter(|map| map.strength.abs() > 0.0) {
            let (_, image) = self.color(Color::Texture(map.texture));
            set_normal_map(&mut record, image, map.strength);
        }
        record
    }

    fn model(&mut self, model: &MaterialModel) -> abi::Material {
        match model {
            MaterialModel::Diffuse { color } => {
                let (color, color_texture) = self.color(*color);
                abi::Material { color, color_texture, ..blank(MaterialKind::Diffuse) }
            }
            MaterialModel::Metal { color, fuzz } => {
                let (color, color_texture) = self.color(*color);
                let fuzz = *fuzz as f32;
                abi::Material { color, color_texture, fuzz, ..blank(MaterialKind::Metal) }
            }
            MaterialModel::Dielectric { ior, roughness, inside } => {
                filled(self.dielectric(*ior, *roughness), *inside)
            }
            MaterialModel::Conductor { color, roughness, anisotropy, compensation } => {
                self.conductor(*color, *roughness, *anisotropy, *compensation)
            }
            MaterialModel::Clearcoat { color, fuzz, coat_ior, coat_tint } => {
                let (color, color_texture) = self.color(*color);
                abi::Material {
                    color,
                    color_texture,
                    fuzz: *fuzz as f32,
                    tint: coat_tint.map(|c| c as f32),
                    specular: fresnel::mean_from_within(*coat_ior) as f32,
                    ..with_ior(blank(MaterialKind::Clearcoat), *coat_ior)
                }
            }
            MaterialModel::Water { ior, inside, sigma_a, depth_color, waves } => {
                self.water(*ior, *inside, (*sigma_a, *depth_color), *waves)
            }
            MaterialModel::Emissive { color, strength, both_sides } => {
                let (emission, emission_texture) = self.emission(*color, *strength);
                let flags = if *both_sides { material_flag::EMIT_BOTH_SIDES } else { 0 };
                let base = blank(MaterialKind::Emissive);
                abi::Material { emission, emission_texture, flags, ..base }
            }
            MaterialModel::Principled(principled) => self.principled(principled),
            MaterialModel::Stone { color, vein, pattern, gloss } => {
                stone(*color, *vein, pattern, *gloss)
            }
            MaterialModel::Wood {
                color,
                late,
                grain,
                grain_span: _,
                pattern,
                gloss,
                anisotropy,
            } => wood((*color, *late), *grain, pattern, *gloss, *anisotropy),
            MaterialModel::Fabric { color, pattern, roughness, gloss, translucency } => {
                self.fabric(*color, pattern, *roughness, *gloss, *translucency)
            }
            MaterialModel::Leaf(leaf) => self.leaf(leaf),
            MaterialModel::Petal(petal) => self.petal(petal),
        }
    }

    fn conductor(
        &mut self,
        color: Color,
        roughness: Scalar,
        anisotropy: f64,
        compensation: bool,
    ) -> abi::Material {
        let (color, color_texture) = self.color(color);
        abi::Material {
            color,
            color_texture,
            roughness: factor(roughness),
            metallic_roughness_texture: self.roughness_texture(roughness),
            anisotropy: anisotropy as f32,
            weight: if compensation { 1.0 } else { 0.0 },
            flags: if anisotropy > 0.0 { material_flag::TANGENT } else { 0 },
            ..blank(MaterialKind::Conductor)
        }
    }

    fn fabric(
        &mut self,
        color: Color,
        pattern: &Pattern,
        roughness: f64,
        gloss: f64,
        translucency: f64,
    ) -> abi::Material {
        let (color, color_texture) = self.color(color);
        abi::Material {
            color,
            color_texture,
            roughness: roughness as f32,
            gloss: gloss as f32,
            weight: translucency as f32,
            ..with_pattern(blank(MaterialKind::Fabric), pattern)
        }
    }

    /// What it is filled with is said by a medium, or by `(sigma_a, depth_color)`.
    fn water(
        &mut self,
        ior: f64,
        mut inside: Inside,
        (sigma_a, depth_color): (Rgb, Rgb),
        waves: Option<[f64; 2]>,
    ) -> abi::Material {
        if inside.medium.is_none() {
            // Radiance in water is the square of its index times that in air.
            let color = depth_color.map(|c| c * ior * ior);
            inside.medium = Some(self.scene.media.len() + self.waters.len());
            self.waters.push(Water { sigma_a, color });
        }
        let [scale, height] = waves.unwrap_or([0.0; 2]);
        abi::Material {
            pattern_scale: scale as f32,
            bump_height: height as f32,
            flags: if height > 0.0 { material_flag::OBJECT } else { 0 },
            ..filled(with_ior(blank(MaterialKind::Water), ior), inside)
        }
    }

    /// Polished glass has its own kind, so that scenes without rough glass do not carry its code.
    fn dielectric(&mut self, ior: f64, roughness: Scalar) -> abi::Material {
        if roughness == Scalar::Constant(0.0) {
            return with_ior(blank(MaterialKind::Dielectric), ior);
        }
        abi::Material {
            roughness: factor(roughness),
            metallic_roughness_texture: self.roughness_texture(roughness),
            ..with_ior(blank(MaterialKind::RoughDielectric), ior)
        }
    }

    /// Sheets have no unit of their own: thickness in millimetres, coefficients per millimetre.
    fn leaf(&mut self, leaf: &Leaf) -> abi::Material {
        let (color, color_texture) = self.color(leaf.color);
        let mut record = abi::Material {
            color,
            color_texture,
            weight: leaf.translucency as f32,
            sigma_a: leaf.sigma_a.map(|sigma| (sigma * 1e-3) as f32),
            thickness_middle: (leaf.thickness * 1e3) as f32,
            forward: leaf.forward as f32,
            g: leaf.g as f32,
            ..blank(MaterialKind::Leaf)
        };
        self.clip(&mut record, leaf.alpha, leaf.alpha_clip);
        record
    }

    fn petal(&mut self, petal: &Petal) -> abi::Material {
        let (color, color_texture) = self.color(petal.color);
        let [edge, middle] = petal.thickness.map(|length| (length * 1e3) as f32);
        let mut record = abi::Material {
            color,
            color_texture,
            weight: petal.fuzz_weight as f32,
            fuzz: petal.fuzz as f32,
            roughness: petal.wax as f32,
            sigma_a: petal.sigma_a.map(|sigma| (sigma * 1e-3) as f32),
            sigma_s: (petal.sigma_s * 1e-3) as f32,
            g: petal.g as f32,
            thickness_edge: edge,
            thickness_middle: middle,
            ..with_ior(blank(MaterialKind::Petal), petal.ior)
        };
        record.flags |= material_flag::TANGENT | material_flag::THROUGH;
        self.clip(&mut record, petal.alpha, petal.alpha_clip);
        record
    }

    fn imported(&mut self, asset: usize, material: usize) -> abi::Material {
        let file = self.loaded.and_then(|loaded| loaded.assets[asset].as_ref());
        let file = file.expect("an asset whose material is used has been loaded");
        let from: &ImportedMaterial = &file.materials[material];
        let mut record = if from.unlit {
            let emission = from.color.map(|c| c as f32);
            let map = self.factor_map(&emission, asset, from.color_map);
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
        let least =
            from.alpha_map.map_or(1.0, |map| self.textures.least((image_of(asset, map), 3)));
        if let Some(cutoff) = cutting(from.alpha_clip, alpha, least) {
            record.flags |= material_flag::ALPHA_CLIP;
            record.alpha_cutoff = cutoff;
            record.alpha = alpha;
            record.alpha_texture = self.map(asset, from.alpha_map);
        }
        record
    }

    fn imported_surface(&mut self, asset: usize, from: &ImportedMaterial) -> abi::Material {
        if from.is_glass() {
            return with_ior(blank(MaterialKind::Dielectric), from.ior);
        }
        if from.diffuse_only && from.emission.iter().all(|&c| c <= 0.0) {
            let color = from.color.map(|c| c as f32);
            return abi::Material {
                color,
                color_texture: self.factor_map(&color, asset, from.color_map),
                ..blank(MaterialKind::Diffuse)
            };
        }
        self.imported_principled(asset, from)
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
                space => space,
            };
            self.textures.whole(image, space, map.wrap)
        })
    }
}

fn stone(color: Rgb, vein: Option<Rgb>, pattern: &Pattern, gloss: f64) -> abi::Material {
    abi::Material {
        color: color.map(|c| c as f32),
        tint: vein.unwrap_or(color.map(|c| c * VEIN)).map(|c| c as f32),
        gloss: gloss as f32,
        ..with_pattern(blank(MaterialKind::Stone), pattern)
    }
}

/// Early and late wood; `grain`: the axis along which it runs.
fn wood(
    (early, late): (Rgb, Option<Rgb>),
    grain: usize,
    pattern: &Pattern,
    gloss: f64,
    anisotropy: f64,
) -> abi::Material {
    abi::Material {
        color: early.map(|c| c as f32),
        tint: late.unwrap_or(late_wood(early)).map(|c| c as f32),
        fuzz: GRAIN_CODES[grain],
        gloss: gloss as f32,
        anisotropy: anisotropy as f32,
        ..with_pattern(blank(MaterialKind::Wood), pattern)
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

/// A material that asks where it is in its object.
fn with_pattern(material: abi::Material, pattern: &Pattern) -> abi::Material {
    abi::Material {
        flags: material_flag::OBJECT,
        pattern_scale: pattern.scale as f32,
        bump_step: pattern.step as f32,
        bump_height: pattern.height as f32,
        ..material
    }
}

pub(super) fn with_ior(material: abi::Material, ior: f64) -> abi::Material {
    abi::Material { ior: ior as f32, ior_minus_1: (ior - 1.0) as f32, ..material }
}

/// The media of the pack are those of the scene, in the same order, and then those of waters.
fn filled(material: abi::Material, inside: Inside) -> abi::Material {
    let medium = inside.medium.map_or(NONE, |medium| medium as u32);
    abi::Material { medium, priority: inside.priority, ..material }
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

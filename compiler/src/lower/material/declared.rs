//! A material that a scene declares becomes a record.

use lang::scene::{self, Color, Inside, Leaf, MaterialModel, Pattern, Petal, Rgb, Scalar};
use pack::abi::{self, MaterialKind, NONE, material_flag};

use super::{MaterialTable, blank, factor, set_normal_map, with_ior};
use crate::lower::fresnel;
use crate::lower::medium::Water;

/// Veins of stone are this share of its colour where the scene says nothing else.
const VEIN: f64 = 0.4;

/// What `Material::fuzz` says of the grain along x, y, z: the middles of the thirds that the kernel tells apart,
/// the first third being y.
const GRAIN_CODES: [f32; 3] = [1.0 / 2.0, 1.0 / 6.0, 5.0 / 6.0];

/// Late wood is denser: darker, and more so in blue, where wood absorbs most.
fn late_wood([r, g, b]: [f64; 3]) -> [f64; 3] {
    [r * 0.5, g * 0.38, b * 0.3]
}

impl MaterialTable<'_> {
    pub(super) fn declared(&mut self, material: &scene::Material) -> abi::Material {
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

/// The media of the pack are those of the scene, in the same order, and then those of waters.
fn filled(material: abi::Material, inside: Inside) -> abi::Material {
    let medium = inside.medium.map_or(NONE, |medium| medium as u32);
    abi::Material { medium, priority: inside.priority, ..material }
}

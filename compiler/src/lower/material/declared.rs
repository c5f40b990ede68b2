//! A material that a scene declares becomes a record.

use lang::material::{
    self, Brightness, Clearcoat, Conductor, Dielectric, Diffuse, Emissive, Fabric, Inside, Leaf,
    Metal, Mix, Pattern, Petal, Stone, Wood,
};
use lang::scene::{self, MaterialModel, Scalar, TextureProjection};
use pack::abi::{self, MaterialKind, NONE, material_flag};

use super::principled::ONE;
use super::table::{MaterialRef, MaterialTable, blank, set_normal_map, switch, with_ior};
use crate::lower::fresnel;

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
            let image = self.normals(map.texture);
            set_normal_map(&mut record, image, map.strength);
        }
        // Without textures there is nothing to project.
        if record.textures().iter().any(|texture| *texture != NONE) {
            record.flags |= match material.projection {
                TextureProjection::Uv => 0,
                TextureProjection::Box => material_flag::PROJECT_BOX | material_flag::OBJECT,
                TextureProjection::Axis(0) => material_flag::PROJECT_X | material_flag::OBJECT,
                TextureProjection::Axis(1) => material_flag::PROJECT_Y | material_flag::OBJECT,
                TextureProjection::Axis(_) => material_flag::PROJECT_Z | material_flag::OBJECT,
                TextureProjection::Solid => material_flag::PROJECT_SOLID | material_flag::OBJECT,
            };
        }
        record
    }

    /// A kind that is forgotten here does not compile.
    fn model(&mut self, model: &MaterialModel) -> abi::Material {
        match model {
            MaterialModel::Diffuse(from) => self.diffuse(from),
            MaterialModel::Metal(from) => self.metal(from),
            MaterialModel::Dielectric(from) => self.dielectric(from),
            MaterialModel::Conductor(from) => self.conductor(from),
            MaterialModel::Clearcoat(from) => self.clearcoat(from),
            MaterialModel::Water(from) => self.water(from),
            MaterialModel::Emissive(from) => self.emissive(from),
            MaterialModel::Mix(from) => self.mix(from),
            MaterialModel::Principled(from) => self.principled(from),
            MaterialModel::Stone(from) => stone(from),
            MaterialModel::Wood(from) => wood(from),
            MaterialModel::Fabric(from) => self.fabric(from),
            MaterialModel::Leaf(from) => self.leaf(from),
            MaterialModel::Petal(from) => self.petal(from),
        }
    }

    fn diffuse(&mut self, from: &Diffuse) -> abi::Material {
        let (color, color_texture) = self.color(from.color);
        abi::Material { color, color_texture, ..blank(MaterialKind::Diffuse) }
    }

    fn metal(&mut self, from: &Metal) -> abi::Material {
        let (color, color_texture) = self.color(from.color);
        let fuzz = from.fuzz as f32;
        abi::Material { color, color_texture, fuzz, ..blank(MaterialKind::Metal) }
    }

    fn clearcoat(&mut self, from: &Clearcoat) -> abi::Material {
        let (color, color_texture) = self.color(from.color);
        abi::Material {
            color,
            color_texture,
            fuzz: from.fuzz as f32,
            tint: from.coat_tint.map(|c| c as f32),
            specular: fresnel::mean_from_within(from.coat_ior) as f32,
            ..with_ior(blank(MaterialKind::Clearcoat), from.coat_ior)
        }
    }

    fn emissive(&mut self, from: &Emissive) -> abi::Material {
        let strength = match from.brightness {
            Brightness::Strength(strength) => strength,
            // The rest is known where its area is: `lower/spread.rs`.
            Brightness::Power(watts) => f64::from(u8::from(watts > 0.0)),
        };
        let (emission, emission_texture) = self.emission(from.color, strength);
        let sides = if from.both_sides { material_flag::EMIT_BOTH_SIDES } else { 0 };
        let unseen = if from.visible { 0 } else { material_flag::UNSEEN };
        let flags = sides | unseen;
        let blank = blank(MaterialKind::Emissive);
        let mut record = abi::Material { emission, emission_texture, flags, ..blank };
        self.cover(&mut record, from.alpha, from.alpha_clip);
        record
    }

    /// A mix that has only one of its parts is that part.
    fn mix(&mut self, from: &Mix) -> abi::Material {
        let scene = self.scene;
        match from.amount {
            Scalar::Constant(0.0) => return self.declared(&scene.materials[from.a.0]),
            Scalar::Constant(1.0) => return self.declared(&scene.materials[from.b.0]),
            Scalar::Constant(_) | Scalar::Texture { .. } | Scalar::Expression(_) => {}
        }
        let [a, b] = [from.a, from.b].map(|part| self.index(MaterialRef::Scene(part.0)));
        abi::Material {
            weight: self.factor(from.amount),
            color_texture: self.scalars([from.amount, ONE, ONE, ONE]),
            priority: a | b << 16,
            ..blank(MaterialKind::Mix)
        }
    }

    fn conductor(&mut self, from: &Conductor) -> abi::Material {
        let (color, color_texture) = self.color(from.color);
        abi::Material {
            color,
            color_texture,
            roughness: self.factor(from.roughness),
            metallic_roughness_texture: self.roughness_texture(from.roughness),
            anisotropy: from.anisotropy as f32,
            compensation: switch(from.compensation),
            flags: if from.anisotropy > 0.0 { material_flag::TANGENT } else { 0 },
            ..blank(MaterialKind::Conductor)
        }
    }

    fn fabric(&mut self, from: &Fabric) -> abi::Material {
        let (color, color_texture) = self.color(from.color);
        abi::Material {
            color,
            color_texture,
            roughness: from.roughness as f32,
            gloss: from.gloss as f32,
            weight: from.translucency as f32,
            ..with_pattern(blank(MaterialKind::Fabric), &from.pattern)
        }
    }

    fn water(&mut self, from: &material::Water) -> abi::Material {
        let (ior, filling) = (from.ior, &from.filling);
        let mut inside = filling.inside;
        if inside.medium.is_none() {
            // Radiance in water is the square of its index times that in air.
            let color = filling.depth_color.map(|c| c * ior * ior);
            inside.medium = Some(self.own_medium(filling.sigma_a, color));
        }
        let [scale, height] = from.waves.map_or([0.0; 2], |waves| [waves.scale, waves.height]);
        abi::Material {
            pattern_scale: scale as f32,
            bump_height: height as f32,
            flags: if height > 0.0 { material_flag::OBJECT } else { 0 },
            ..filled(with_ior(blank(MaterialKind::Water), ior), inside)
        }
    }

    /// Polished glass has its own kind, so that scenes without rough glass do not carry its code.
    fn dielectric(&mut self, from: &Dielectric) -> abi::Material {
        let roughness = from.roughness;
        let surface = if roughness == Scalar::Constant(0.0) {
            with_ior(blank(MaterialKind::Dielectric), from.ior)
        } else {
            abi::Material {
                roughness: self.factor(roughness),
                metallic_roughness_texture: self.roughness_texture(roughness),
                compensation: switch(from.compensation),
                ..with_ior(blank(MaterialKind::RoughDielectric), from.ior)
            }
        };
        filled(surface, from.inside)
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
        self.cover(&mut record, leaf.alpha, leaf.alpha_clip);
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
        self.cover(&mut record, petal.alpha, petal.alpha_clip);
        record
    }
}

fn stone(from: &Stone) -> abi::Material {
    let color = from.color;
    abi::Material {
        color: color.map(|c| c as f32),
        tint: from.vein.unwrap_or(color.map(|c| c * VEIN)).map(|c| c as f32),
        gloss: from.gloss as f32,
        ..with_pattern(blank(MaterialKind::Stone), &from.pattern)
    }
}

fn wood(from: &Wood) -> abi::Material {
    abi::Material {
        color: from.color.map(|c| c as f32),
        tint: from.late.unwrap_or(late_wood(from.color)).map(|c| c as f32),
        fuzz: GRAIN_CODES[from.grain.axis],
        gloss: from.gloss as f32,
        anisotropy: from.anisotropy as f32,
        ..with_pattern(blank(MaterialKind::Wood), &from.pattern)
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

/// The media of the pack are those of the scene, in the same order, and then those of materials.
fn filled(material: abi::Material, inside: Inside) -> abi::Material {
    let medium = inside.medium.map_or(NONE, |medium| medium as u32);
    abi::Material { medium, priority: inside.priority, ..material }
}

//! What things are made of.

use super::{Name, Rgb};
use crate::source::Span;

/// A colour that may come from an image.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Color {
    /// The same everywhere.
    Constant(Rgb),
    /// `.rgb` of a texture, index into `Scene::textures`.
    Texture(usize),
}

/// A number that may come from one channel of an image.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Scalar {
    /// The same everywhere.
    Constant(f64),
    /// One channel (0 red … 3 alpha) of a texture.
    Texture {
        /// Index into `Scene::textures`.
        texture: usize,
        /// 0 red, 1 green, 2 blue, 3 alpha.
        channel: u8,
    },
}

/// A material.
#[derive(Clone, Debug, PartialEq)]
pub struct Material {
    /// Declared name.
    pub name: Name,
    /// Model and parameters.
    pub model: MaterialModel,
    /// Tilts the shading normal.
    pub normal: Option<NormalMap>,
}

/// An image of tangent-space normals, green up.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct NormalMap {
    /// Index into `Scene::textures`.
    pub texture: usize,
    /// Factor on the tilt, 0 ..= 10.
    pub strength: f64,
}

/// How a material scatters and emits.
#[derive(Clone, Debug, PartialEq)]
pub enum MaterialModel {
    /// Lambert.
    Diffuse {
        /// Reflectance, 0 ..= 1.
        color: Color,
    },
    /// Mirror blurred by a ball of radius `fuzz`.
    Metal {
        /// Reflectance, 0 ..= 1.
        color: Color,
        /// 0 ..= 1.
        fuzz: f64,
    },
    /// Glass, smooth where the roughness is 0.
    Dielectric {
        /// Refractive index, >= 1.
        ior: f64,
        /// Perceptual roughness, 0 ..= 1.
        roughness: Scalar,
        /// What it is inside.
        inside: Inside,
    },
    /// Water.
    Water {
        /// Refractive index, >= 1.
        ior: f64,
        /// What it is inside; without a medium `sigma_a` and `depth_color` say that.
        inside: Inside,
        /// Absorption, per metre.
        sigma_a: Rgb,
        /// Radiance of what lies below the scene, seen from air.
        depth_color: Rgb,
        /// Scale of the waves' coordinates, and factor on their slopes; `None`: flat.
        waves: Option<[f64; 2]>,
    },
    /// Light source without scattering.
    Emissive {
        /// Colour, any non-negative value.
        color: Color,
        /// Factor on `color`: radiance in W/(m2 sr) up to the scene's own scale.
        strength: f64,
        /// Emits from the back side too.
        both_sides: bool,
    },
    /// glTF metallic-roughness.
    Principled(Principled),
    /// Rough metal.
    Conductor {
        /// Reflectance at normal incidence, 0 ..= 1.
        color: Color,
        /// Perceptual roughness, 0 ..= 1.
        roughness: Scalar,
        /// 0 round ..= 1 brushed along the tangent.
        anisotropy: f64,
        /// Gives back what single reflection loses.
        compensation: bool,
    },
    /// Clear coat over Lambert.
    Clearcoat {
        /// Reflectance of the base, 0 ..= 1.
        color: Color,
        /// Radius of the ball of the coat's mirror direction, 0 ..= 1.
        fuzz: f64,
        /// Refractive index of the coat, >= 1.
        coat_ior: f64,
        /// Factor on what the coat reflects.
        coat_tint: Rgb,
    },
    /// Rough, with bumps and veins.
    Stone {
        /// Reflectance, 0 ..= 1.
        color: Rgb,
        /// That of the veins.
        vein: Option<Rgb>,
        /// The field and its bumps.
        pattern: Pattern,
        /// Share of uncoloured gloss, 0 ..= 1.
        gloss: f64,
    },
    /// Rough, with bumps, rings and gloss along a grain.
    Wood {
        /// Reflectance of early wood, 0 ..= 1.
        color: Rgb,
        /// That of late wood.
        late: Option<Rgb>,
        /// Axis of the object along which the grain runs: 0 x, 1 y, 2 z.
        grain: usize,
        /// Where the text says so.
        grain_span: Span,
        /// The field and its bumps.
        pattern: Pattern,
        /// Share of uncoloured gloss, 0 ..= 1.
        gloss: f64,
        /// How far the gloss is stretched along the grain, 0 ..= 1.
        anisotropy: f64,
    },
    /// Rough thin sheet that lets light through.
    Fabric {
        /// Share of light that is not absorbed, 0 ..= 1.
        color: Color,
        /// The field and its bumps.
        pattern: Pattern,
        /// Perceptual roughness of the gloss, 0 ..= 1.
        roughness: f64,
        /// Share of uncoloured gloss, 0 ..= 1.
        gloss: f64,
        /// Share of the rest that goes through, 0 ..= 1.
        translucency: f64,
    },
    /// Thin sheet that lets light through.
    Leaf(Leaf),
    /// Fuzz and wax over a thin scattering layer.
    Petal(Petal),
}

/// A field over an object, and the bumps it makes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Pattern {
    /// Pattern coordinates are metres of the object times this; > 0.
    pub scale: f64,
    /// Step of the differences that tilt the normal, metres of the object; > 0.
    pub step: f64,
    /// Height of the bumps, metres of the object; >= 0.
    pub height: f64,
}

/// Parameters of `MaterialModel::Leaf`.
#[derive(Clone, Debug, PartialEq)]
pub struct Leaf {
    /// Reflectance, 0 ..= 1.
    pub color: Color,
    /// Coverage.
    pub alpha: Scalar,
    /// Alpha below this is not there; `None` ignores alpha.
    pub alpha_clip: Option<f64>,
    /// Share of the light that goes through, 0 ..= 1.
    pub translucency: f64,
    /// Absorption, 1/m.
    pub sigma_a: Rgb,
    /// Metres.
    pub thickness: f64,
    /// Share of the light through that keeps its direction, 0 ..= 1.
    pub forward: f64,
    /// Mean cosine of that light's blur.
    pub g: f64,
    /// Share of leaves that are not there, 0 ..= 1.
    pub gap: f64,
}

/// Parameters of `MaterialModel::Petal`.
#[derive(Clone, Debug, PartialEq)]
pub struct Petal {
    /// Factor on the light from inside, 0 ..= 1.
    pub color: Color,
    /// Coverage.
    pub alpha: Scalar,
    /// Alpha below this is not there; `None` ignores alpha.
    pub alpha_clip: Option<f64>,
    /// Share of the fuzz, 0 ..= 1.
    pub fuzz_weight: f64,
    /// Radius of the ball of the fuzz, 0 ..= 1.
    pub fuzz: f64,
    /// Radius of the ball of the wax, 0 ..= 1.
    pub wax: f64,
    /// Refractive index.
    pub ior: f64,
    /// Absorption, 1/m.
    pub sigma_a: Rgb,
    /// Scattering, 1/m.
    pub sigma_s: f64,
    /// Mean cosine of scattering.
    pub g: f64,
    /// Metres, at the rim and in the middle.
    pub thickness: [f64; 2],
    /// Lean of the normals at the rim.
    pub pillow: f64,
    /// Lean of each petal.
    pub tilt: f64,
}

/// What fills things of a material that light goes through.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Inside {
    /// Index into `Scene::media`; `None` is clear.
    pub medium: Option<usize>,
    /// Of things that overlap the greatest is there.
    pub priority: u32,
}

/// Parameters of `MaterialModel::Principled`.
#[derive(Clone, Debug, PartialEq)]
pub struct Principled {
    /// Base colour.
    pub color: Color,
    /// 0 dielectric … 1 metal.
    pub metallic: Scalar,
    /// Perceptual roughness 0 ..= 1.
    pub roughness: Scalar,
    /// Refractive index of the dielectric part.
    pub ior: f64,
    /// Factor on the reflectance of the dielectric part, 0 ..= 1.
    pub specular: Scalar,
    /// Colour of that reflectance at normal incidence, any non-negative value.
    pub specular_color: Color,
    /// Share under a clear coat, 0 ..= 1.
    pub coat: Scalar,
    /// Perceptual roughness of the coat, 0 ..= 1.
    pub coat_roughness: Scalar,
    /// Share of the light entering that goes through the sheet, 0 ..= 1.
    pub transmission: Scalar,
    /// Emitted colour.
    pub emission: Color,
    /// Factor on `emission`.
    pub emission_strength: f64,
    /// Coverage.
    pub alpha: Scalar,
    /// Alpha below this is not there; `None` ignores alpha.
    pub alpha_clip: Option<f64>,
}

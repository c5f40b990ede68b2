//! One record for all materials: a tag and shared fields whose meaning depends on it.

use super::field::abi_struct;

/// How a `Material` scatters. The numbers are part of the pack format.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
#[repr(u32)]
pub enum MaterialKind {
    /// Lambert.
    Diffuse = 0,
    /// Mirror direction perturbed by a ball of radius `fuzz`.
    Metal = 1,
    /// Smooth dielectric: exact Fresnel, Snell, total internal reflection.
    Dielectric = 2,
    /// Emits and does not scatter.
    Emissive = 3,
    /// Metallic-roughness: GGX over Lambert.
    Principled = 4,
}

impl MaterialKind {
    /// Every kind, in tag order.
    pub const ALL: [Self; 5] =
        [Self::Diffuse, Self::Metal, Self::Dielectric, Self::Emissive, Self::Principled];

    /// The kind with this tag.
    #[must_use]
    pub fn from_tag(tag: u32) -> Option<Self> {
        Self::ALL.into_iter().find(|kind| *kind as u32 == tag)
    }
}

/// Bits of `Material::flags`.
pub mod material_flag {
    /// Emits from the back as well as from the front (the side of the geometric normal).
    pub const EMIT_BOTH_SIDES: u32 = 1;
    /// Surface points with alpha below `alpha_cutoff` do not exist, for any ray.
    pub const ALPHA_CLIP: u32 = 2;
}

abi_struct! {
    /// A material, 96 bytes. Colours are linear Rec. 709.
    pub struct Material {
        /// Reflectance (diffuse, metal), base colour (principled), 0 ..= 1; factor on `color_texture`.
        pub color: [f32; 3],
        /// `MaterialKind`.
        pub kind: u32,
        /// Emitted radiance, W/(m2 sr) up to the scene's scale; factor on `emission_texture`.
        pub emission: [f32; 3],
        /// `material_flag` bits.
        pub flags: u32,
        /// Metal: radius of the ball, 0 ..= 1.
        pub fuzz: f32,
        /// Principled: perceptual roughness, 0 ..= 1 (alpha is its square); factor on the green channel.
        pub roughness: f32,
        /// Principled: 0 dielectric, 1 metal; factor on the blue channel.
        pub metallic: f32,
        /// Refractive index relative to the outside, >= 1.
        pub ior: f32,
        /// `ior - 1` rounded once from `f64`: keeps Fresnel exact near 1.
        pub ior_minus_1: f32,
        /// Alpha below this is not there.
        pub alpha_cutoff: f32,
        /// Factor on the alpha texture.
        pub alpha: f32,
        /// Unused.
        pub _pad0: u32,
        /// `Texture` id or `NONE`.
        pub color_texture: u32,
        /// `Texture` id or `NONE`.
        pub emission_texture: u32,
        /// `Texture` id or `NONE`; roughness in green, metallic in blue.
        pub metallic_roughness_texture: u32,
        /// `Texture` id or `NONE`; alpha is read from its fourth channel.
        pub alpha_texture: u32,
        /// Unused.
        pub _pad1: [u32; 4],
    }
}

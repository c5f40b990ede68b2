//! Layers of a principled surface → the record that holds them.

use pack::abi::{Material, MaterialKind, NONE};

/// What only few principled surfaces have.
#[derive(Clone, Copy, Debug)]
pub struct Layers {
    /// Factor on the reflectance of the dielectric part.
    pub specular: f32,
    /// Grey colour of that reflectance.
    pub tint: f32,
    /// Share under a coat.
    pub coat: f32,
    /// Perceptual roughness of the coat.
    pub coat_roughness: f32,
    /// Share of the light entering that goes through.
    pub transmission: f32,
    /// Grey colour of the sheen.
    pub sheen: f32,
    /// Perceptual roughness of that.
    pub sheen_roughness: f32,
    /// How far the lobe is brushed.
    pub anisotropy: f32,
    /// From the tangent to the direction of that, as a share of a turn.
    pub anisotropy_turn: f32,
}

impl Layers {
    /// None.
    pub const PLAIN: Self = Self {
        specular: 1.0,
        tint: 1.0,
        coat: 0.0,
        coat_roughness: 0.0,
        transmission: 0.0,
        sheen: 0.0,
        sheen_roughness: 0.0,
        anisotropy: 0.0,
        anisotropy_turn: 0.0,
    };
}

impl From<Layers> for Material {
    fn from(layers: Layers) -> Self {
        Self {
            kind: MaterialKind::Principled as u32,
            color: [1.0; 3],
            alpha: 1.0,
            ior: 1.5,
            ior_minus_1: 0.5,
            color_texture: NONE,
            emission_texture: NONE,
            metallic_roughness_texture: NONE,
            alpha_texture: NONE,
            normal_texture: NONE,
            normal_strength: 1.0,
            medium: NONE,
            specular: layers.specular,
            tint: [layers.tint; 3],
            coat: layers.coat,
            coat_roughness: layers.coat_roughness,
            transmission: layers.transmission,
            sheen: [layers.sheen; 3],
            sheen_roughness: layers.sheen_roughness,
            anisotropy: layers.anisotropy,
            anisotropy_turn: layers.anisotropy_turn,
            specular_texture: NONE,
            compensation: 1.0,
            coat_texture: NONE,
            transmission_texture: NONE,
            anisotropy_texture: NONE,
            sheen_texture: NONE,
            ..Self::default()
        }
    }
}

//! One record for all materials: a tag and shared fields whose meaning depends on it.

use super::NONE;
use super::field::abi_struct;
use super::tag::tags;

tags! {
    /// How a `Material` scatters. The numbers are part of the pack format; the order here is that in which
    /// kinds were added, and that of their constants in kernels.
    pub enum MaterialKind {
        /// Lambert.
        Diffuse = 0 as 10 "diffuse",
        /// Mirror direction perturbed by a ball of radius `fuzz`.
        Metal = 1 as 11 "metal",
        /// Smooth dielectric: exact Fresnel, Snell, total internal reflection.
        Dielectric = 2 as 12 "dielectric",
        /// Emits and does not scatter.
        Emissive = 3 as 13 "emissive",
        /// Metallic-roughness: GGX over Lambert.
        Principled = 4 as 14 "principled",
        /// Rough, with the bumps and veins of a field of its own.
        Stone = 8 as 40 "stone",
        /// Rough, with bumps, rings and gloss along a grain.
        Wood = 9 as 41 "wood",
        /// Rough thin sheet with bumps that lets light through.
        Fabric = 10 as 42 "fabric",
        /// Rough metal: GGX with the light of several reflections.
        Conductor = 5 as 37 "conductor",
        /// Rough dielectric: GGX reflection and refraction.
        RoughDielectric = 6 as 38 "rough dielectric",
        /// Clear coat over Lambert.
        Clearcoat = 7 as 39 "clearcoat",
        /// Fuzz and wax over a thin scattering slab.
        Petal = 11 as 43 "petal",
        /// Thin sheet: diffuse reflection, tinted transmission.
        Leaf = 12 as 44 "leaf",
        /// Smooth dielectric with waves.
        Water = 13 as 45 "water",
        /// One of two other materials, by chance.
        Mix = 14 as 47 "mix",
    }
}

/// A random number that a model's sample function takes, each drawn for a purpose of its own.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Number {
    /// A pair in the unit square, for a direction.
    Direction,
    /// Which lobe.
    Lobe,
    /// A radius.
    Radius,
}

/// Where a model sends light.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Lobes {
    /// Nowhere.
    None,
    /// Into single directions: there is nothing to evaluate.
    Delta,
    /// Around the normal, wherever it comes from: the functions do not take `wo`.
    Fixed,
    /// Into lobes that depend on where it comes from.
    Moving,
}

/// What kernels and checks know of a kind of material beside its functions.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[expect(clippy::struct_excessive_bools, reason = "each is a question with a name")]
pub struct Traits {
    /// Where it sends light.
    pub lobes: Lobes,
    /// What its sample function takes, in order.
    pub numbers: &'static [Number],
    /// Its functions are generated, because they depend on more than the kind: `dispatch_x_sample` in
    /// `scene/x.wgsl` instead of `x_sample` in `bsdf/x.wgsl`.
    pub generated: bool,
    /// `x_pattern` changes colour, roughness and normal by the place in the object; `bump_step` is read.
    pub pattern: bool,
    /// Some light goes straight through its surface. The function that says how much.
    pub straight: Option<&'static str>,
    /// `ior` is read.
    pub refracts: bool,
    /// Things made of it have an inside that light enters.
    pub inside: bool,
    /// Some light may leave on the other side.
    pub transmits: bool,
}

impl Traits {
    /// A surface with lobes, one of which is chosen.
    const ROUGH: Self = Self {
        lobes: Lobes::Moving,
        numbers: &[Number::Direction, Number::Lobe],
        generated: false,
        pattern: false,
        straight: None,
        refracts: false,
        inside: false,
        transmits: false,
    };
    const PATTERN: Self = Self { pattern: true, ..Self::ROUGH };
    const GLASS: Self = Self { refracts: true, inside: true, transmits: true, ..Self::ROUGH };
    const SMOOTH_GLASS: Self =
        Self { lobes: Lobes::Delta, numbers: &[Number::Lobe], ..Self::GLASS };
}

impl MaterialKind {
    /// What kernels and checks know of it.
    #[must_use]
    pub const fn traits(self) -> Traits {
        use Number::{Direction, Lobe, Radius};
        match self {
            Self::Diffuse => Traits { lobes: Lobes::Fixed, numbers: &[Direction], ..Traits::ROUGH },
            Self::Metal => Traits { numbers: &[Direction, Radius], ..Traits::ROUGH },
            // Whatever scatters is one of the two.
            Self::Emissive | Self::Mix => {
                Traits { lobes: Lobes::None, numbers: &[], ..Traits::ROUGH }
            }
            Self::Principled => Traits {
                generated: true,
                straight: Some("dispatch_principled_straight"),
                refracts: true,
                transmits: true,
                ..Traits::ROUGH
            },
            Self::Conductor => Traits::ROUGH,
            Self::Leaf => Traits { transmits: true, ..Traits::ROUGH },
            Self::Dielectric | Self::Water => Traits::SMOOTH_GLASS,
            Self::RoughDielectric => Traits::GLASS,
            Self::Clearcoat => {
                Traits { numbers: &[Direction, Radius, Lobe], refracts: true, ..Traits::ROUGH }
            }
            Self::Stone | Self::Wood => Traits::PATTERN,
            Self::Fabric => Traits { transmits: true, ..Traits::PATTERN },
            Self::Petal => Traits {
                numbers: &[Direction, Lobe, Radius],
                straight: Some("petal_through"),
                refracts: true,
                transmits: true,
                ..Traits::ROUGH
            },
        }
    }
}

/// Bits of `Material::flags`.
pub mod material_flag {
    /// Emits from the back as well as from the front (the side of the geometric normal).
    pub const EMIT_BOTH_SIDES: u32 = 1;
    /// Surface points with alpha below `alpha_cutoff` do not exist, for any ray.
    pub const ALPHA_CLIP: u32 = 2;
    /// Scattering depends on texture coordinates, or on the direction in which they grow.
    pub const TANGENT: u32 = 4;
    /// Scattering depends on where the point is in its object, or on which object it is.
    pub const OBJECT: u32 = 8;
    /// Has an inside: who crosses the surface is in another medium.
    pub const INTERIOR: u32 = 16;
    /// Some shadow rays go on behind the surface.
    pub const THROUGH: u32 = 32;
    /// A light that is tinted by direction: `tint` is the colour, its `Light` says towards where.
    pub const EMIT_TINT: u32 = 64;
    /// A light that shines into a cone, which its `Light` knows.
    pub const EMIT_SPOT: u32 = 128;
    /// A share of the surface is there, its alpha: each ray decides on its own whether it meets it.
    pub const ALPHA_BLEND: u32 = 256;
    /// A light whose brightness by direction is the image `color_texture`; its `Light` says how that is turned.
    pub const EMIT_PROFILE: u32 = 1024;
    /// The camera does not see it: what comes straight from there goes straight on.
    pub const UNSEEN: u32 = 512;
    /// Textures are projected along the x axis of the object, and not looked up at texture coordinates.
    pub const PROJECT_X: u32 = 2048;
    /// Along the y axis.
    pub const PROJECT_Y: u32 = 4096;
    /// Along the z axis.
    pub const PROJECT_Z: u32 = 8192;
    /// Along the axis that the surface faces.
    pub const PROJECT_BOX: u32 = PROJECT_X | PROJECT_Y | PROJECT_Z;
    /// Along the z axis, which is the third coordinate of patterns that have one.
    pub const PROJECT_SOLID: u32 = 16384;
    /// Any of these.
    pub const PROJECT: u32 = PROJECT_BOX | PROJECT_SOLID;
    /// Every bit.
    pub const ALL: u32 = PROJECT
        | EMIT_BOTH_SIDES
        | ALPHA_CLIP
        | TANGENT
        | OBJECT
        | INTERIOR
        | THROUGH
        | EMIT_TINT
        | EMIT_SPOT
        | ALPHA_BLEND
        | UNSEEN
        | EMIT_PROFILE;
}

abi_struct! {
    /// A material, 224 bytes: one record for all kinds; a field that a kind does not name is not
    /// read by it. Colours are linear Rec. 709, lengths and coefficients in normalised units.
    pub struct Material {
        /// Reflectance (diffuse, metal), reflectance at normal incidence (conductor), base colour (principled,
    /// clearcoat), 0 ..= 1; factor on `color_texture`.
        pub color: [f32; 3],
        /// `MaterialKind`.
        pub kind: u32,
        /// Emitted radiance, W/(m2 sr) up to the scene's scale; factor on `emission_texture`.
        pub emission: [f32; 3],
        /// `material_flag` bits.
        pub flags: u32,
        /// Radius of the ball of a mirror direction, 0 ..= 1. Wood: the grain, 1/6 y, 1/2 x, 5/6 z.
        pub fuzz: f32,
        /// Perceptual roughness, 0 ..= 1 (alpha is its square); factor on the green channel.
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
        /// How much narrower the lobe is along the tangent than across it, 0 ..= 1. Wood: across the
        /// grain than along it. Principled: across the direction of brushing than along it.
        pub anisotropy: f32,
        /// `Texture` id or `NONE`.
        pub color_texture: u32,
        /// `Texture` id or `NONE`.
        pub emission_texture: u32,
        /// `Texture` id or `NONE`; roughness in green, metallic in blue.
        pub metallic_roughness_texture: u32,
        /// `Texture` id or `NONE`; alpha is read from its fourth channel.
        pub alpha_texture: u32,
        /// `Texture` id or `NONE`; a tangent-space normal in red, green, blue.
        pub normal_texture: u32,
        /// Factor on the x and y of `normal_texture`.
        pub normal_strength: f32,
        /// Index of the `Medium` inside, or `NONE`.
        pub medium: u32,
        /// Which of two overlapping media counts: the greater. Mix: its two materials, indices smaller than its own,
    /// the first in bits 0 to 15.
        pub priority: u32,
        /// Second colour: what a coat reflects, the specular colour, veins of stone, late wood.
        pub tint: [f32; 3],
        /// Share of a second lobe: surface fuzz, translucency. Mix: of the second material, factor on the red of
    /// `color_texture`.
        pub weight: f32,
        /// Stretches a pattern: pattern coordinates are metres of the object times this.
        pub pattern_scale: f32,
        /// Step of the differences that tilt the normal, metres of the object.
        pub bump_step: f32,
        /// Height of the bumps, metres of the object. Water: factor on the slopes of the waves.
        pub bump_height: f32,
        /// Share of light that a rough surface reflects as gloss.
        pub gloss: f32,
        /// Absorption inside a sheet, per unit of `thickness`.
        pub sigma_a: [f32; 3],
        /// Scattering inside a sheet, per unit of `thickness`.
        pub sigma_s: f32,
        /// Mean cosine of scattering inside a sheet, -1 ..= 1.
        pub g: f32,
        /// Thickness of a sheet at its edge.
        pub thickness_edge: f32,
        /// Thickness of a sheet in its middle.
        pub thickness_middle: f32,
        /// Share of the light through a sheet that goes on forward.
        pub forward: f32,
        /// Principled: factor on the reflectance of the dielectric part. Clearcoat: mean reflectance of the
    /// coat for diffuse light from within.
        pub specular: f32,
        /// Principled: share of the surface under a clear coat.
        pub coat: f32,
        /// Principled: perceptual roughness of that coat.
        pub coat_roughness: f32,
        /// Principled: share of the light entering that is refracted, not diffused.
        pub transmission: f32,
        /// `Texture` id or `NONE`; specular colour in red, green, blue, factor in alpha.
        pub specular_texture: u32,
        /// `Texture` id or `NONE`; coat in red, its roughness in green.
        pub coat_texture: u32,
        /// `Texture` id or `NONE`; transmission in red.
        pub transmission_texture: u32,
        /// Conductor, rough dielectric, principled: 1 with the light of several reflections, 0 without.
        pub compensation: f32,
        /// Principled: from the tangent to the direction of brushing, as a share of a turn, 0 ..= 1.
        pub anisotropy_turn: f32,
        /// `Texture` id or `NONE`; the direction of brushing in red and green, 0 ..= 1 for -1 ..= 1,
        /// anisotropy in blue.
        pub anisotropy_texture: u32,
        /// `Texture` id or `NONE`; colour of the sheen in red, green, blue, its roughness in alpha.
        pub sheen_texture: u32,
        /// Principled: perceptual roughness of the sheen, 0 ..= 1.
        pub sheen_roughness: f32,
        /// Principled: colour of the sheen, 0 ..= 1.
        pub sheen: [f32; 3],
        /// Zero.
        pub _pad0: u32,
    }
}

impl Material {
    /// Every texture that it may read, each an index or `NONE`.
    #[must_use]
    pub fn textures(&self) -> [u32; 10] {
        [
            self.color_texture,
            self.emission_texture,
            self.metallic_roughness_texture,
            self.alpha_texture,
            self.normal_texture,
            self.specular_texture,
            self.coat_texture,
            self.transmission_texture,
            self.anisotropy_texture,
            self.sheen_texture,
        ]
    }

    /// Materials of which a mix can have one: those that `parts` can name.
    pub const MIXABLE: usize = 1 << 16;

    /// The two materials of a mix, as `priority` has them.
    #[must_use]
    pub fn parts(&self) -> [u32; 2] {
        [self.priority & 0xffff, self.priority >> 16]
    }

    /// A principled surface whose dielectric part does not reflect as its refractive index says.
    #[must_use]
    pub fn has_specular(&self) -> bool {
        let plain = self.specular.to_bits() == 1.0_f32.to_bits()
            && self.tint.iter().all(|c| c.to_bits() == 1.0_f32.to_bits())
            && self.specular_texture == NONE;
        self.kind == MaterialKind::Principled as u32 && !plain
    }

    /// A principled surface under a coat.
    #[must_use]
    pub fn has_coat(&self) -> bool {
        self.kind == MaterialKind::Principled as u32 && self.coat > 0.0
    }

    /// A principled surface with sheen.
    #[must_use]
    pub fn has_sheen(&self) -> bool {
        self.kind == MaterialKind::Principled as u32 && self.sheen.iter().any(|c| *c > 0.0)
    }

    /// A principled surface that is brushed.
    #[must_use]
    pub fn is_brushed(&self) -> bool {
        self.kind == MaterialKind::Principled as u32 && self.anisotropy > 0.0
    }

    /// A thin sheet that lets shadow rays through.
    #[must_use]
    pub fn is_sheet(&self) -> bool {
        let both = material_flag::THROUGH | material_flag::INTERIOR;
        self.flags & both == material_flag::THROUGH
    }

    /// A surface of which a share is there.
    #[must_use]
    pub fn is_partial(&self) -> bool {
        self.flags & material_flag::ALPHA_BLEND != 0
    }

    /// A principled surface that lets light through.
    #[must_use]
    pub fn has_transmission(&self) -> bool {
        self.kind == MaterialKind::Principled as u32 && self.transmission > 0.0
    }
}

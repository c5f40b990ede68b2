//! What a ray sees that leaves the scene.

use super::field::abi_struct;

/// How `Sky` is to be read.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
#[repr(u32)]
pub enum SkyKind {
    /// `zenith` in every direction.
    Constant = 0,
    /// Three-band gradient with glow and disc around `sun_direction`.
    Gradient = 1,
}

impl SkyKind {
    /// Every kind, in tag order.
    pub const ALL: [Self; 2] = [Self::Constant, Self::Gradient];

    /// The kind with this tag.
    #[must_use]
    pub fn from_tag(tag: u32) -> Option<Self> {
        Self::ALL.into_iter().find(|kind| *kind as u32 == tag)
    }
}

abi_struct! {
    /// Radiance by direction, linear Rec. 709, W/(m2 sr) up to the scene's own scale.
    pub struct Sky {
        /// Radiance straight up; the only colour of a constant sky.
        pub zenith: [f32; 3],
        /// `SkyKind`.
        pub kind: u32,
        /// Radiance at elevation sine `blend_high`.
        pub middle: [f32; 3],
        /// Sine of the elevation where zenith and middle bands meet.
        pub blend_high: f32,
        /// Radiance at the horizon.
        pub horizon: [f32; 3],
        /// Sine of the elevation where horizon and ground bands meet (negative).
        pub blend_low: f32,
        /// Radiance straight down.
        pub ground: [f32; 3],
        /// Exponent of the wide glow around the sun, `cos^glow_power`.
        pub glow_power: f32,
        /// Unit direction towards the sun; glow and disc are centred here.
        pub sun_direction: [f32; 3],
        /// Exponent of the narrow disc, `cos^disc_power`.
        pub disc_power: f32,
        /// Radiance added at the centre of the glow.
        pub glow: [f32; 3],
        /// Unused.
        pub _pad0: u32,
        /// Radiance added at the centre of the disc.
        pub disc: [f32; 3],
        /// Unused.
        pub _pad1: u32,
    }
}

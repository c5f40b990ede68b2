//! Where light comes from.

use super::{Name, Rgb};
use crate::source::Span;

/// A sphere light.
#[derive(Clone, Debug, PartialEq)]
pub struct Light {
    /// Declared name.
    pub name: Name,
    /// Centre at the moment 0, world frame, metres.
    pub center: [f64; 3],
    /// World frame, metres per second.
    pub velocity: [f64; 3],
    /// Radius, metres, > 0.
    pub radius: f64,
    /// Radiance, W/(m2 sr) up to the scene's own scale.
    pub radiance: Rgb,
    /// What colours part of its light.
    pub tint: Option<Tint>,
}

/// A factor on the light of a sphere light by the direction from which it comes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Tint {
    /// The factor.
    pub color: Rgb,
    /// Largest angle between a tinted ray towards the light and `direction`, radians, 0 .. pi.
    pub angle: f64,
    /// Unit vector towards the light, world frame.
    pub direction: [f64; 3],
}

/// What a ray sees that leaves the scene.
#[derive(Clone, Debug, PartialEq)]
pub struct Sky {
    /// Declared name.
    pub name: Name,
    /// Where its radiance comes from.
    pub model: SkyModel,
}

/// Sky models; all colours are radiance.
#[derive(Clone, Debug, PartialEq)]
pub enum SkyModel {
    /// One radiance for every direction.
    Constant(Rgb),
    /// Bands over the sine of the elevation: `zenith` at 1, `horizon` at `blend_low`, `middle` at
    /// `blend_high` of the way between them, `ground` from `blend_ground` below `blend_low` downwards;
    /// plus glow and disc around `sun_direction`.
    Gradient {
        /// Straight up.
        zenith: Rgb,
        /// Between horizon and zenith.
        middle: Rgb,
        /// At sine `blend_low`.
        horizon: Rgb,
        /// Lowest.
        ground: Rgb,
        /// Share of the height from `blend_low` to the zenith, in (0, 1).
        blend_high: f64,
        /// Sine of the elevation, in (-1, 1).
        blend_low: f64,
        /// How much below `blend_low` the ground is reached, > 0; beyond -1 it is not quite.
        blend_ground: f64,
        /// Unit vector towards the sun.
        sun_direction: [f64; 3],
        /// Added radiance, times `cos^glow_power`.
        glow: Rgb,
        /// Exponent, >= 1.
        glow_power: f64,
        /// Added radiance, times `cos^disc_power`.
        disc: Rgb,
        /// Exponent, >= 1.
        disc_power: f64,
    },
    /// A lat-long image: its middle towards -z, its right half towards +x, its top row straight up.
    Image {
        /// Path relative to the directory of the `.rts` file that declares it, as written.
        path: String,
        /// The path literal.
        path_span: Span,
        /// Turn about +y, radians, right-handed.
        rotate: f64,
        /// Factor on the radiance in the image.
        strength: f64,
    },
}

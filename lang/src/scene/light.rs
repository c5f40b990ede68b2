//! Where light comes from.

use super::common::{Name, Rgb};

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

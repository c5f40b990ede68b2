//! What is inside of things and between them.

use super::{Name, Rgb};

/// What fills things, or the space around them.
#[derive(Clone, Debug, PartialEq)]
pub struct Medium {
    /// Declared name.
    pub name: Name,
    /// Model and parameters.
    pub model: MediumModel,
    /// As atmosphere: length of what lies between the scene and the sky, metres.
    pub sky_distance: f64,
}

/// What a medium does with light.
#[derive(Clone, Debug, PartialEq)]
pub enum MediumModel {
    /// Absorbs and scatters.
    Homogeneous {
        /// Absorption for each channel, per metre.
        sigma_a: Rgb,
        /// Scattering for each channel, per metre.
        sigma_s: Rgb,
        /// Mean cosine of scattering, -1 ..= 1.
        g: f64,
    },
    /// Hides light behind its own.
    Fog {
        /// Extinction, per metre.
        density: f64,
        /// Radiance where it is thick.
        color: Rgb,
    },
}

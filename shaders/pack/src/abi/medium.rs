//! What fills the inside of things, and the space around them.

use super::field::abi_struct;

abi_struct! {
    /// A homogeneous medium, 48 bytes. Coefficients per normalised unit of length, linear Rec. 709.
    pub struct Medium {
        /// Absorption.
        pub sigma_a: [f32; 3],
        /// Mean cosine of scattering, -1 ..= 1 (Henyey & Greenstein 1941).
        pub g: f32,
        /// Scattering.
        pub sigma_s: [f32; 3],
        /// Length of a segment that leaves the scene inside the medium, normalised units.
        pub reach: f32,
        /// Radiance that takes the place of what a segment loses: of every segment in fog, of those
        /// that leave the scene in other media.
        pub color: [f32; 3],
        /// As `LightLink::receives`, of everything that it fills.
        pub receives: u32,
    }
}

//! What fills the inside of things.

use super::field::abi_struct;

abi_struct! {
    /// A homogeneous medium, 32 bytes. Coefficients per normalised unit of length, linear Rec. 709.
    pub struct Medium {
        /// Absorption.
        pub sigma_a: [f32; 3],
        /// Mean cosine of scattering, -1 ..= 1 (Henyey & Greenstein 1941).
        pub g: f32,
        /// Scattering.
        pub sigma_s: [f32; 3],
        /// Unused.
        pub _pad0: u32,
    }
}

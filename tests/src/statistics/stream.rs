//! Random numbers for inputs of tests: a hash of a seed and a counter, independent of the kernel's own.
//! Steele, Lea & Flood 2014, "Fast Splittable Pseudorandom Number Generators": the finaliser of `SplitMix64`.

use glam::{DVec3, Vec2};

use crate::statistics::index;

/// One stream of numbers, the same on every run.
#[derive(Clone, Debug)]
pub struct Stream {
    state: u64,
}

impl Stream {
    /// Stream number `index` of `seed`.
    #[must_use]
    pub fn new(seed: u64, index: u64) -> Self {
        Self { state: mix(seed.wrapping_mul(0x9e37_79b9_7f4a_7c15) ^ mix(index)) }
    }

    /// 64 random bits.
    pub fn bits(&mut self) -> u64 {
        self.state = self.state.wrapping_add(0x9e37_79b9_7f4a_7c15);
        mix(self.state)
    }

    /// Uniform in [0, 1).
    pub fn unit(&mut self) -> f64 {
        (self.bits() >> 11) as f64 * 2.0_f64.powi(-53)
    }

    /// A multiple of 2^-24 in [0, 1): what the kernel's own numbers are.
    pub fn unit24(&mut self) -> f32 {
        (self.bits() >> 40) as f32 * 2.0_f32.powi(-24)
    }

    /// Two of them.
    pub fn pair24(&mut self) -> Vec2 {
        Vec2::new(self.unit24(), self.unit24())
    }

    /// Uniform between `low` and `high`.
    pub fn between(&mut self, low: f64, high: f64) -> f64 {
        low + (high - low) * self.unit()
    }

    /// An index below `n`.
    pub fn index(&mut self, n: usize) -> usize {
        index(self.unit(), n)
    }

    /// A uniform direction.
    pub fn direction(&mut self) -> DVec3 {
        let z = self.between(-1.0, 1.0);
        let phi = self.between(0.0, std::f64::consts::TAU);
        let r = (1.0 - z * z).max(0.0).sqrt();
        DVec3::new(r * phi.cos(), r * phi.sin(), z).normalize()
    }
}

fn mix(mut z: u64) -> u64 {
    z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
    z ^ (z >> 31)
}

//! Radiance that the eye sees along one ray through the air, for sunlight of 1.

use std::f64::consts::PI;

use glam::DVec3;

use super::tables::{Tables, segment};
use super::{Air, EYE, GROUND, MIE_G, along, reach};

/// Steps along a ray; they grow with the square of the distance, as the air thins.
const STEPS: usize = 96;

/// Of air: Rayleigh's phase function, per steradian.
fn rayleigh_phase(cosine: f64) -> f64 {
    3.0 / (16.0 * PI) * (1.0 + cosine * cosine)
}

/// Of haze: Cornette & Shanks 1992, "Physically reasonable analytic expression for the single-scattering phase
/// function", per steradian.
fn mie_phase(cosine: f64) -> f64 {
    let g2 = MIE_G * MIE_G;
    let below = 1.0 + g2 - 2.0 * MIE_G * cosine;
    3.0 / (8.0 * PI) * (1.0 - g2) * (1.0 + cosine * cosine) / ((2.0 + g2) * below * below.sqrt())
}

/// Sky above the horizon: `mu` and `sun_mu` are cosines with the vertical of ray and sun, `cosine` is that between
/// them. `orders`: how many times light may be scattered: once, or any number.
pub(super) fn radiance(
    (air, tables): (&Air, &Tables),
    (mu, sun_mu, cosine): (f64, f64, f64),
    orders: Orders,
) -> DVec3 {
    let radius = GROUND + EYE;
    let (length, _) = reach(radius, mu);
    let phases = (rayleigh_phase(cosine), mie_phase(cosine));
    let end = |k: usize| length * (k as f64 / STEPS as f64).powi(2);
    let (mut sum, mut through) = (DVec3::ZERO, DVec3::ONE);
    for k in 0..STEPS {
        let (from, to) = (end(k), end(k + 1));
        let t = 0.5 * (from + to);
        let (there, _) = along(radius, mu, t);
        let there_mu = ((radius * sun_mu + t * cosine) / there).clamp(-1.0, 1.0);
        let media = air.at(there);
        let mut source =
            (media.rayleigh * phases.0 + media.mie * phases.1) * tables.sunlight(there, there_mu);
        if orders == Orders::All {
            source += (media.rayleigh + media.mie) * tables.multiple.get(there, there_mu);
        }
        let (gain, left) = segment(source, media.extinction, to - from);
        sum += through * gain;
        through *= left;
    }
    sum
}

/// Which light is seen.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Orders {
    /// What was scattered once.
    #[cfg(test)]
    First,
    /// All of it.
    All,
}

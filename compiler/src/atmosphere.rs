//! A clear sky: parameters of the air and a direction of the sun → radiance from all directions, and the sunlight that
//! is left at the ground.
//!
//! Air, haze and ozone in spherical layers around the Earth, with single scattering integrated along each ray and all
//! further orders as one isotropic source, after Hillaire 2020, "A Scalable and Production Ready Sky and Atmosphere
//! Rendering Technique", Computer Graphics Forum 39(4); coefficients of its table 1, in linear Rec. 709. It knows no
//! images and no language. Lengths are metres, +y is up, the eye stands on the ground.

mod picture;
mod scattering;
mod tables;

pub(crate) use picture::environment;

use glam::DVec3;
use lang::scene::SunSky;

/// Radius of the ground.
const GROUND: f64 = 6_360e3;
/// Radius at which the air ends.
const TOP: f64 = 6_460e3;
/// How high the eye is above the ground.
const EYE: f64 = 2.0;

/// Scattering of air at the ground, per metre, and the height at which it is 1/e of that.
const RAYLEIGH: DVec3 = DVec3::new(5.802e-6, 13.558e-6, 33.1e-6);
const RAYLEIGH_HEIGHT: f64 = 8e3;
/// Scattering and absorption of haze at the ground, per metre, its height, and the mean cosine of its scattering.
const MIE_SCATTERING: f64 = 3.996e-6;
const MIE_ABSORPTION: f64 = 4.40e-6;
const MIE_HEIGHT: f64 = 1.2e3;
const MIE_G: f64 = 0.8;
/// Absorption of ozone at its densest, per metre; where that is, and how far from there it ends.
const OZONE: DVec3 = DVec3::new(0.650e-6, 1.881e-6, 0.085e-6);
const OZONE_MIDDLE: f64 = 25e3;
const OZONE_REACH: f64 = 15e3;

/// What the sun gives outside of the air to a surface that faces it, lux: the luminous solar constant of the IES
/// (Lighting Handbook, 8th edition, 1993; IES 1984, "Recommended Practice for the Calculation of Daylight
/// Availability").
pub(crate) const SOLAR_ILLUMINANCE: f64 = 127.5e3;
/// Lumens to the watt of luminous power (SI Brochure, 9th edition, 2.3.1).
const EFFICACY: f64 = 683.0;

/// Air and ground of one sky.
#[derive(Clone, Copy, Debug)]
struct Air {
    /// Density of haze over the published one.
    haze: f64,
    /// Share of light that the ground returns.
    albedo: DVec3,
}

impl Air {
    /// Turbidity is the vertical optical depth of air and haze over that of air alone, in green.
    fn of(sky: &SunSky) -> Self {
        let air = RAYLEIGH.y * RAYLEIGH_HEIGHT;
        let haze = (MIE_SCATTERING + MIE_ABSORPTION) * MIE_HEIGHT;
        Self { haze: (sky.turbidity - 1.0) * air / haze, albedo: DVec3::from(sky.ground) }
    }

    /// Scattering of air and of haze, and extinction of all, at a distance from the middle of the Earth.
    fn at(&self, radius: f64) -> Media {
        let height = (radius - GROUND).max(0.0);
        let rayleigh = RAYLEIGH * libm::exp(-height / RAYLEIGH_HEIGHT);
        let haze = self.haze * libm::exp(-height / MIE_HEIGHT);
        let ozone = (1.0 - (height - OZONE_MIDDLE).abs() / OZONE_REACH).max(0.0);
        let mie = DVec3::splat(MIE_SCATTERING * haze);
        let extinction = rayleigh + mie + DVec3::splat(MIE_ABSORPTION * haze) + OZONE * ozone;
        Media { rayleigh, mie, extinction }
    }
}

/// Coefficients at a point, per metre.
#[derive(Clone, Copy, Debug)]
struct Media {
    rayleigh: DVec3,
    mie: DVec3,
    extinction: DVec3,
}

/// Distance from a point at `radius` to where the air ends, or to the ground if a ray whose angle with the vertical
/// has cosine `mu` meets it; and whether it does.
fn reach(radius: f64, mu: f64) -> (f64, bool) {
    let meets = |sphere: f64| radius * radius * (mu * mu - 1.0) + sphere * sphere;
    let ground = meets(GROUND);
    if mu < 0.0 && ground >= 0.0 {
        return ((-radius * mu - ground.sqrt()).max(0.0), true);
    }
    ((-radius * mu + meets(TOP).max(0.0).sqrt()).max(0.0), false)
}

/// Radius, and the cosine of the angle with the vertical, `t` along a ray.
fn along(radius: f64, mu: f64, t: f64) -> (f64, f64) {
    let there = (radius * radius + t * t + 2.0 * radius * mu * t).max(0.0).sqrt();
    (there, ((radius * mu + t) / there).clamp(-1.0, 1.0))
}

/// Factor by which light loses on its way out of the air from a point, by many steps of the middle rule.
fn transmittance(air: &Air, radius: f64, mu: f64) -> DVec3 {
    const STEPS: usize = 128;
    let (length, _) = reach(radius, mu);
    let step = length / STEPS as f64;
    let depth: DVec3 =
        (0..STEPS).map(|i| air.at(along(radius, mu, (i as f64 + 0.5) * step).0).extinction).sum();
    exp(-depth * step)
}

/// Of each channel.
fn exp(v: DVec3) -> DVec3 {
    DVec3::from(v.to_array().map(libm::exp))
}

/// The irradiance of the sun outside of the air on a surface that faces it, linear Rec. 709, W/m2.
fn solar(sky: &SunSky) -> DVec3 {
    DVec3::from(sky.sun) * (SOLAR_ILLUMINANCE / EFFICACY)
}

/// The irradiance of the sun at the ground on a surface that faces it, W/m2; 0 once its middle has set.
pub(crate) fn sunlight(sky: &SunSky) -> [f64; 3] {
    let mu = sky.sun_direction[1];
    let radius = GROUND + EYE;
    if reach(radius, mu).1 {
        return [0.0; 3];
    }
    (solar(sky) * transmittance(&Air::of(sky), radius, mu) * sky.strength).to_array()
}

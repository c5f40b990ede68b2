//! What every ray through the air asks for, once for all of them: transmittance to the sun, and light that was
//! scattered more than once.

use std::f64::consts::PI;

use glam::DVec3;
use rayon::prelude::*;

use super::{Air, GROUND, TOP, along, exp, reach, transmittance};

/// Values over the cosine of the sun's angle with the vertical and over height; bilinear between.
#[derive(Debug)]
pub(super) struct Table {
    columns: usize,
    rows: usize,
    values: Vec<DVec3>,
}

impl Table {
    fn new([columns, rows]: [usize; 2], value: impl Fn(f64, f64) -> DVec3 + Sync) -> Self {
        let at = |i: usize| {
            let (column, row) = (i % columns, i / columns);
            let (x, y) = (column as f64 / (columns - 1) as f64, row as f64 / (rows - 1) as f64);
            value(radius_of(y), sun_of(x))
        };
        let values = (0..columns * rows).into_par_iter().map(at).collect();
        Self { columns, rows, values }
    }

    #[expect(clippy::cast_possible_truncation, reason = "a column and a row")]
    pub(super) fn get(&self, radius: f64, mu: f64) -> DVec3 {
        let place = |x: f64, n: usize| {
            let x = x.clamp(0.0, 1.0) * (n - 1) as f64;
            let first = (x as usize).min(n - 2);
            (first, x - first as f64)
        };
        let x = 0.5 + 0.5 * mu.signum() * mu.abs().sqrt();
        let y = ((radius - GROUND).max(0.0) / (TOP - GROUND)).sqrt();
        let ((i, u), (j, v)) = (place(x, self.columns), place(y, self.rows));
        let at = |i: usize, j: usize| self.values[j * self.columns + i];
        at(i, j).lerp(at(i + 1, j), u).lerp(at(i, j + 1).lerp(at(i + 1, j + 1), u), v)
    }
}

/// Rows are closer near the ground, where most of the air is.
fn radius_of(y: f64) -> f64 {
    GROUND + (TOP - GROUND) * y * y
}

/// Columns are closer at the horizon, where light changes most.
fn sun_of(x: f64) -> f64 {
    let s = 2.0 * x - 1.0;
    s * s.abs()
}

/// Both tables of an atmosphere.
#[derive(Debug)]
pub(super) struct Tables {
    /// From a point out of the air towards the sun, 0 where the Earth is in between.
    pub(super) sun: Table,
    /// Radiance that arrives after two or more scatterings, the same from everywhere, for sunlight of 1.
    pub(super) multiple: Table,
}

impl Tables {
    pub(super) fn new(air: &Air) -> Self {
        let sun = Table::new([257, 129], |radius, mu| {
            // Below the horizon as on it: the Earth is asked for apart.
            transmittance(air, radius, mu.max(horizon(radius)))
        });
        let multiple = Table::new([33, 33], |radius, mu| multiple(air, &sun, radius, mu));
        Self { sun, multiple }
    }

    /// Sunlight of 1 at a point.
    pub(super) fn sunlight(&self, radius: f64, mu: f64) -> DVec3 {
        sunlight(&self.sun, radius, mu)
    }
}

/// Cosine with the vertical of a ray that passes the ground closely.
fn horizon(radius: f64) -> f64 {
    // A little above, where rounding does not let it hit.
    1e-7 - (1.0 - (GROUND / radius).powi(2)).max(0.0).sqrt()
}

fn sunlight(sun: &Table, radius: f64, mu: f64) -> DVec3 {
    // The sun is half a degree wide: it sets over the height of its disc, not at once.
    let width = 0.00465;
    let share = ((mu - horizon(radius) + width) / (2.0 * width)).clamp(0.0, 1.0);
    if share <= 0.0 {
        return DVec3::ZERO;
    }
    sun.get(radius, mu) * share
}

/// Equations 5 to 10 of the paper: second order from everywhere around, times the geometric series of the share that
/// is scattered again. Both phase functions are taken for even.
fn multiple(air: &Air, sun: &Table, radius: f64, sun_mu: f64) -> DVec3 {
    const SIDE: usize = 8;
    const STEPS: usize = 20;
    let even = 1.0 / (4.0 * PI);
    let radius = radius.max(GROUND + 1.0);
    let sun_side = (1.0 - sun_mu * sun_mu).max(0.0).sqrt();
    let (mut second, mut again) = (DVec3::ZERO, DVec3::ZERO);
    for i in 0..SIDE * SIDE {
        let mu = 1.0 - 2.0 * ((i / SIDE) as f64 + 0.5) / SIDE as f64;
        let phi = 2.0 * PI * ((i % SIDE) as f64 + 0.5) / SIDE as f64;
        let cosine = mu * sun_mu + (1.0 - mu * mu).sqrt() * sun_side * libm::cos(phi);
        let (length, ground) = reach(radius, mu);
        let step = length / STEPS as f64;
        let mut through = DVec3::ONE;
        for k in 0..STEPS {
            let t = (k as f64 + 0.5) * step;
            let (there, _) = along(radius, mu, t);
            let media = air.at(there);
            let scattering = media.rayleigh + media.mie;
            let (gain, left) = segment(scattering, media.extinction, step);
            let there_mu = ((radius * sun_mu + t * cosine) / there).clamp(-1.0, 1.0);
            second += through * gain * sunlight(sun, there, there_mu) * even;
            again += through * gain;
            through *= left;
        }
        if ground {
            let there_mu = ((radius * sun_mu + length * cosine) / GROUND).clamp(-1.0, 1.0);
            let light = sunlight(sun, GROUND, there_mu) * there_mu.max(0.0);
            second += through * light * air.albedo / PI;
        }
    }
    let n = (SIDE * SIDE) as f64;
    second / n / (DVec3::ONE - again / n)
}

/// Over a stretch of even air: what it scatters towards its beginning for light of 1, and the factor of light behind it.
pub(super) fn segment(scattering: DVec3, extinction: DVec3, length: f64) -> (DVec3, DVec3) {
    let left = exp(-extinction * length);
    let share = |s: f64, e: f64, left: f64| if e > 0.0 { s * (1.0 - left) / e } else { s * length };
    let gain = DVec3::new(
        share(scattering.x, extinction.x, left.x),
        share(scattering.y, extinction.y, left.y),
        share(scattering.z, extinction.z, left.z),
    );
    (gain, left)
}

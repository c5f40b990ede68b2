//! A sky as a lat-long image: as an image file of it would be read.

use std::f64::consts::PI;

use glam::DVec3;
use lang::scene::SunSky;
use rayon::prelude::*;

use super::scattering::{Orders, radiance};
use super::tables::Tables;
use super::{Air, solar, sunlight};
use crate::import::{Environment, Image, Pixels};

/// Texels across and down: 0.7 degrees each. The sun's disc is not among them.
const SIZE: [u32; 2] = [512, 256];
const COLUMNS: usize = SIZE[0] as usize;
const ROWS: usize = SIZE[1] as usize;
/// The largest half float.
const LARGEST: f64 = 65504.0;

/// The image: the sun stands above its middle. Below the horizon is the ground, lit by sun and sky.
pub(crate) fn environment(sky: &SunSky) -> Environment {
    let rows = rows(sky);
    let largest = rows.iter().flatten().map(|light| light.max_element()).fold(0.0, f64::max);
    // A power of two loses nothing.
    let scale =
        if largest > 0.0 { libm::exp2(libm::ceil(libm::log2(largest / LARGEST))) } else { 1.0 };
    let scale = scale.max(1.0);
    let half = |x: f64| half::f16::from_f64(x / scale).to_bits();
    // The left half mirrors the right one.
    let texel = |row: &[DVec3], column: usize| {
        let from_middle =
            if column < COLUMNS / 2 { COLUMNS / 2 - 1 - column } else { column - COLUMNS / 2 };
        let [r, g, b] = row[from_middle].to_array().map(half);
        [r, g, b, half::f16::ONE.to_bits()]
    };
    let bits = rows.iter().flat_map(|row| (0..COLUMNS).flat_map(move |column| texel(row, column)));
    let image = Image {
        width: SIZE[0],
        height: SIZE[1],
        has_alpha: false,
        clamped: 0,
        is_radiance: true,
        data: Pixels::Rgba16F(bits.collect()),
    };
    Environment { image, scale }
}

/// Radiance, W/(m2 sr), of each row from the top, from the sun's azimuth to the opposite one.
fn rows(sky: &SunSky) -> Vec<Vec<DVec3>> {
    let air = Air::of(sky);
    let tables = Tables::new(&air);
    let light = solar(sky) * sky.strength;
    let sun_mu = sky.sun_direction[1].clamp(-1.0, 1.0);
    let sun_side = (1.0 - sun_mu * sun_mu).sqrt();
    let row = |row: usize| {
        let theta = PI * (row as f64 + 0.5) / ROWS as f64;
        let (sin, cos) = (libm::sin(theta), libm::cos(theta));
        let texel = |column: usize| {
            let phi = 2.0 * PI * (column as f64 + 0.5) / COLUMNS as f64;
            let cosine = cos * sun_mu + sin * sun_side * libm::cos(phi);
            light * radiance((&air, &tables), (cos, sun_mu, cosine), Orders::All)
        };
        (0..COLUMNS / 2).map(texel).collect::<Vec<_>>()
    };
    let mut rows: Vec<Vec<DVec3>> = (0..ROWS / 2).into_par_iter().map(row).collect();
    let direct = DVec3::from(sunlight(sky)) * sun_mu.max(0.0);
    let ground = air.albedo / PI * (direct + irradiance(&rows));
    rows.resize(ROWS, vec![ground; COLUMNS / 2]);
    rows
}

/// What the upper half of the image gives to level ground, W/m2.
fn irradiance(rows: &[Vec<DVec3>]) -> DVec3 {
    let band = |(row, texels): (usize, &Vec<DVec3>)| {
        // The integral of cosine times sine over the row.
        let edge = |k: usize| libm::sin(PI * k as f64 / ROWS as f64).powi(2);
        let weight = PI * (edge(row + 1) - edge(row));
        texels.iter().sum::<DVec3>() / texels.len() as f64 * weight
    };
    rows.iter().enumerate().map(band).sum()
}

#[cfg(test)]
mod tests;

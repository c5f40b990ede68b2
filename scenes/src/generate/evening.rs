//! An evening sky as a lat-long image: a low sun behind thin clouds, 256 x 128 texels, Radiance HDR.

use image::Rgb;
use image::codecs::hdr::HdrEncoder;
use libm::{cosf, expf, sinf, sqrtf};
use std::f32::consts::{PI, TAU};

const COLUMNS: usize = 256;
const ROWS: usize = 128;

/// Azimuth and elevation of the sun, radians; azimuth 0 is the middle of the image.
const SUN: [f32; 2] = [0.9, 0.16];
/// Radius of the sun and its radiance: a little over one texel, so that the image resolves it.
const SUN_RADIUS: f32 = 0.03;
const SUN_RADIANCE: [f32; 3] = [900.0, 560.0, 240.0];

/// The file.
pub(super) fn hdr() -> std::io::Result<Vec<u8>> {
    let texels: Vec<Rgb<f32>> = (0..ROWS)
        .flat_map(|row| (0..COLUMNS).map(move |column| Rgb(radiance(column, row))))
        .collect();
    let mut bytes = Vec::new();
    let encoder = HdrEncoder::new(&mut bytes);
    encoder.encode(&texels, COLUMNS, ROWS).map_err(std::io::Error::other)?;
    Ok(bytes)
}

/// Radiance of a texel: bands by elevation, clouds from a few waves, a glow and the sun.
fn radiance(column: usize, row: usize) -> [f32; 3] {
    let azimuth = TAU * ((column as f32 + 0.5) / COLUMNS as f32 - 0.5);
    let elevation = PI * (0.5 - (row as f32 + 0.5) / ROWS as f32);
    let height = sinf(elevation);
    if height < 0.0 {
        let fade = expf(12.0 * height);
        return [0.06 + 0.10 * fade, 0.05 + 0.06 * fade, 0.05 + 0.04 * fade];
    }
    let mut sky = mix([0.95, 0.55, 0.30], [0.10, 0.17, 0.42], 1.0 - expf(-3.5 * height));
    let waves = sinf(3.0 * azimuth + 9.0 * height)
        + 0.6 * sinf(7.0 * azimuth - 17.0 * height + 1.3)
        + 0.3 * sinf(15.0 * azimuth + 31.0 * height + 0.4);
    let cloud = (0.35 * waves * expf(-3.0 * height)).clamp(0.0, 1.0);
    sky = mix(sky, [0.9, 0.6, 0.5], 0.6 * cloud);
    let away = angle(azimuth, elevation);
    let glow = expf(-away * away / 0.08) + 0.3 * expf(-away / 0.35);
    let sun = if away < SUN_RADIUS { 1.0 } else { 0.0 };
    [0, 1, 2].map(|k| sky[k] + glow * [2.2, 1.1, 0.4][k] + sun * SUN_RADIANCE[k])
}

/// Angle between a direction and the sun, radians, right for small ones.
fn angle(azimuth: f32, elevation: f32) -> f32 {
    let direction = |azimuth: f32, elevation: f32| {
        let across = cosf(elevation);
        [across * sinf(azimuth), sinf(elevation), across * cosf(azimuth)]
    };
    let (a, b) = (direction(azimuth, elevation), direction(SUN[0], SUN[1]));
    let square: f32 = a.iter().zip(b).map(|(x, y)| (x - y) * (x - y)).sum();
    2.0 * libm::asinf((0.5 * sqrtf(square)).min(1.0))
}

fn mix(a: [f32; 3], b: [f32; 3], t: f32) -> [f32; 3] {
    [0, 1, 2].map(|k| a[k] * (1.0 - t) + b[k] * t)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_sun_is_in_the_image_and_nothing_is_negative() {
        let all = (0..ROWS).flat_map(|row| (0..COLUMNS).map(move |column| radiance(column, row)));
        let all: Vec<[f32; 3]> = all.collect();
        assert!(all.iter().flatten().all(|x| x.is_finite() && *x >= 0.0));
        let bright = all.iter().filter(|rgb| rgb[0] > 500.0).count();
        assert!((3..20).contains(&bright), "{bright} texels of sun");
    }
}

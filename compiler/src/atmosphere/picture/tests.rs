use super::super::{GROUND, transmittance};
use super::*;

fn sky(elevation: f64, turbidity: f64) -> SunSky {
    let (sin, cos) = (libm::sin(elevation.to_radians()), libm::cos(elevation.to_radians()));
    SunSky {
        sun_direction: [0.6 * cos, sin, -0.8 * cos],
        half_angle: 0.265_f64.to_radians(),
        sun: [1.0; 3],
        turbidity,
        ground: [0.3; 3],
        strength: 1.0,
    }
}

/// Illuminance of white light, lux.
fn lux(light: DVec3) -> f64 {
    683.0 * light.dot(DVec3::new(0.2126, 0.7152, 0.0722))
}

/// Single scattering by vectors in three dimensions and many even steps, without a table.
fn brute_force(air: &Air, dir: DVec3, sun: DVec3) -> DVec3 {
    const STEPS: usize = 4000;
    let exit = |p: DVec3, d: DVec3| {
        let b = p.dot(d);
        -b + (b * b - p.length_squared() + 6_460e3_f64.powi(2)).sqrt()
    };
    let blocked = |p: DVec3, d: DVec3| {
        let b = p.dot(d);
        b < 0.0 && b * b - p.length_squared() + 6_360e3_f64.powi(2) > 0.0
    };
    let depth = |p: DVec3, d: DVec3, length: f64, n: usize| {
        let step = length / n as f64;
        let at = |i: usize| air.at((p + d * ((i as f64 + 0.5) * step)).length()).extinction;
        (0..n).map(at).sum::<DVec3>() * step
    };
    let eye = DVec3::Y * 6_360_002.0;
    let length = exit(eye, dir);
    let step = length / STEPS as f64;
    let cosine = dir.dot(sun);
    let rayleigh = 3.0 / (16.0 * PI) * (1.0 + cosine * cosine);
    let g = 0.8_f64;
    let mie = 3.0 / (8.0 * PI) * (1.0 - g * g) * (1.0 + cosine * cosine)
        / ((2.0 + g * g) * libm::pow(1.0 + g * g - 2.0 * g * cosine, 1.5));
    let (mut before, mut sum) = (DVec3::ZERO, DVec3::ZERO);
    for k in 0..STEPS {
        let p = eye + dir * ((k as f64 + 0.5) * step);
        let media = air.at(p.length());
        if !blocked(p, sun) {
            let way = before + media.extinction * (0.5 * step) + depth(p, sun, exit(p, sun), 200);
            let through = DVec3::from(way.to_array().map(|x| libm::exp(-x)));
            sum += through * (media.rayleigh * rayleigh + media.mie * mie) * step;
        }
        before += media.extinction * step;
    }
    sum
}

#[test]
fn single_scattering_is_that_of_a_brute_force_integral() {
    let directions = [[0.0, 1.0, 0.0], [0.6, 0.5, -0.8], [-0.6, 0.1, 0.8], [0.8, 0.3, 0.6]];
    for (elevation, turbidity) in [(90.0, 1.1), (40.0, 3.0), (8.0, 1.1)] {
        let sky = sky(elevation, turbidity);
        let air = Air::of(&sky);
        let tables = Tables::new(&air);
        let sun = DVec3::from(sky.sun_direction);
        for dir in directions {
            let dir = DVec3::from(dir).normalize();
            let found = radiance((&air, &tables), (dir.y, sun.y, dir.dot(sun)), Orders::First);
            let expected = brute_force(&air, dir, sun);
            let off = (found / expected - DVec3::ONE).abs().max_element();
            assert!(off < 0.01, "{elevation} {turbidity} {dir}: {found} {expected}");
        }
    }
}

#[test]
fn transmittance_upwards_is_that_of_the_vertical_depth() {
    // Exponential layers of 100 km of air, and the tent of ozone.
    let air = Air { haze: 1.0, albedo: DVec3::ZERO };
    let layer = |height: f64| height * (1.0 - libm::exp(-100e3 / height));
    let depth = super::super::RAYLEIGH * layer(8e3)
        + DVec3::splat(8.396e-6 * layer(1.2e3))
        + super::super::OZONE * 15e3;
    let expected = DVec3::from(depth.to_array().map(|x| libm::exp(-x)));
    let found = transmittance(&air, GROUND, 1.0);
    assert!((found / expected - DVec3::ONE).abs().max_element() < 5e-3, "{found} {expected}");
}

/// Direct and diffuse illuminance of a clear sky, lux.
fn daylight(sky: &SunSky) -> (f64, f64) {
    let rows = rows(sky);
    (lux(DVec3::from(sunlight(sky))), lux(irradiance(&rows[..ROWS / 2])))
}

#[test]
fn a_high_sun_gives_what_light_meters_read() {
    let (direct, diffuse) = daylight(&sky(90.0, 1.1));
    assert!((105e3..120e3).contains(&direct), "{direct}");
    assert!((8e3..12e3).contains(&diffuse), "{diffuse}");
    let (hazy, more) = daylight(&sky(90.0, 3.0));
    assert!((80e3..100e3).contains(&hazy) && (14e3..20e3).contains(&more), "{hazy} {more}");
    let (low, _) = daylight(&sky(5.0, 1.1));
    assert!(low < 0.6 * direct, "{low}");
}

#[test]
fn what_the_air_scatters_the_sun_has_lost() {
    // Of all that the direct light has lost, less than all and more than a third comes down.
    let mut clear = sky(60.0, 1.0);
    clear.ground = [0.0; 3];
    let (direct, diffuse) = daylight(&clear);
    let level = libm::sin(60.0_f64.to_radians());
    let lost = (super::super::SOLAR_ILLUMINANCE - direct) * level;
    assert!(diffuse < lost && diffuse > 0.35 * lost, "{diffuse} of {lost}");
    // Light comes back from a bright ground.
    clear.ground = [0.9; 3];
    assert!(daylight(&clear).1 > 1.02 * diffuse);
}

#[test]
fn the_sky_is_the_same_on_both_sides_of_the_sun_and_blue_above() {
    let Environment { image, scale } = environment(&sky(30.0, 1.1));
    let Pixels::Rgba16F(bits) = &image.data else { panic!("half floats") };
    let texel = |row: usize, column: usize| {
        let at = 4 * (row * COLUMNS + column);
        [0, 1, 2].map(|k| half::f16::from_bits(bits[at + k]).to_f64() * scale)
    };
    let same = |row: usize, column: usize| {
        let mirrored = texel(row, COLUMNS - 1 - column);
        assert_eq!(texel(row, column).map(f64::to_bits), mirrored.map(f64::to_bits));
    };
    (0..ROWS).for_each(|row| (0..COLUMNS / 2).for_each(|column| same(row, column)));
    let [r, _, b] = texel(0, 0);
    assert!(b > 2.0 * r, "{r} {b}");
    // Brighter towards the sun than away from it.
    let row = ROWS / 3;
    assert!(texel(row, COLUMNS / 2)[1] > 2.0 * texel(row, 0)[1]);
}

#[test]
fn nothing_is_lit_long_after_sunset() {
    let night = sky(-30.0, 1.1);
    assert_eq!(sunlight(&night).map(f64::to_bits), [0; 3]);
    let twilight = daylight(&sky(-4.0, 1.1)).1;
    assert!(twilight > 1.0 && twilight < 2000.0, "{twilight}");
    assert!(daylight(&night).1 < 1e-3 * twilight);
}

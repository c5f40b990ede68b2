//! Directions to the sky, by the tables that the compiler makes.

use std::f64::consts::{PI, TAU};

use glam::{DVec3, Vec2};
use pack::abi::Sky;
use runtime::kernel::f32 as single;
use tests::kernel::Bench;
use tests::scene;
use tests::statistics::stream::Stream;
use tests::statistics::{Counts, index};

use crate::{N, check, corners, key};

/// Chi-square tests here: one a sky.
pub(crate) const CHECKS: usize = 3;

/// Cells of a table are cut into this many along each side, to see that they are filled evenly.
const FINE: usize = 2;

/// A sky that is a light, as the compiler makes it.
struct Made {
    name: &'static str,
    sky: Sky,
    table: Vec<[f32; 4]>,
}

fn made(name: &'static str, text: &str, image: impl Fn(usize, usize) -> f32 + Sync) -> Made {
    let dir = tempfile::tempdir().expect("a temporary directory can be made");
    exr::prelude::write_rgb_file(dir.path().join("sky.exr"), 32, 16, |x, y| {
        (image(x, y), 0.5 * image(x, y), 0.1)
    })
    .expect("an image can be written");
    let text = format!(
        "rts 1
sky {text}
material m: diffuse {{ color = linear(0.5) }}
instance ball {{ shape = sphere(radius: 1m), material = m }}
camera c: perspective {{ from = (0, 0, 5)m, to = (0, 0, 0)m }}
render r: path {{ camera = c }}
"
    );
    let lowered = scene::compile_in(dir.path(), &text).lowered;
    assert_eq!((lowered.lights.len(), lowered.lights[0].pmf), (1, 1.0), "{name}");
    Made { name, sky: lowered.sky.expect("a sky"), table: lowered.sky_table }
}

fn skies() -> [Made; CHECKS] {
    let image = "s: image { file = \"sky.exr\", rotate = 70deg }";
    [
        made("uneven image", image, |x, y| ((x * 7 + y * 13) % 11) as f32),
        made("image of one bright texel", image, |x, y| if (x, y) == (3, 1) { 5e4 } else { 0.0 }),
        made(
            "gradient with a sun",
            "s: gradient { sun.direction = (0.3, 0.2, -0.5), disc.power = 30 }",
            |_, _| 0.0,
        ),
    ]
}

/// Row and column of a direction as fractions of the table, worked out with the platform's functions.
fn place(sky: &Sky, dir: DVec3) -> (f64, f64) {
    let azimuth = dir.x.atan2(-dir.z) / TAU + f64::from(sky.rotation);
    (dir.y.clamp(-1.0, 1.0).acos() / PI, azimuth.rem_euclid(1.0))
}

/// The direction at a polar angle and a column.
fn direction(sky: &Sky, theta: f64, u: f64) -> DVec3 {
    let phi = TAU * (u - f64::from(sky.rotation));
    DVec3::new(theta.sin() * phi.sin(), theta.cos(), -theta.sin() * phi.cos())
}

#[test]
fn the_sky_is_sampled_by_its_density() {
    for (i, made) in skies().into_iter().enumerate() {
        let bench = Bench::new().sky(made.sky, &made.table);
        let (mut single, mut double) = (bench.single(), bench.double());
        let (rows, columns) = (FINE * made.sky.rows as usize, FINE * made.sky.columns as usize);
        // Halves of a cell of equal solid angle: inside a row, directions are even by the cosine.
        let cell_of = |dir: DVec3| {
            let (v, u) = place(&made.sky, dir);
            let row = index(v, made.sky.rows as usize);
            let edge = |row: usize| (PI * row as f64 / f64::from(made.sky.rows)).cos();
            let depth = (edge(row) - dir.y) / (edge(row) - edge(row + 1));
            (FINE * row + index(depth, FINE)) * columns + index(u, columns)
        };
        let mut expected = Vec::with_capacity(rows * columns);
        let mut sum = 0.0;
        for row in 0..rows {
            let (theta, top) = (PI / f64::from(made.sky.rows), row / FINE);
            let height = (theta * top as f64).cos() - (theta * (top + 1) as f64).cos();
            let solid = height * TAU / (FINE * columns) as f64;
            for column in 0..columns {
                let at = (top as f64 + 0.25 + 0.5 * (row % FINE) as f64) * theta;
                let u = (column as f64 + 0.5) / columns as f64;
                let share = double.sky_light_pdf(direction(&made.sky, at, u)) * solid;
                sum += share;
                expected.push(share * N as f64);
            }
        }
        assert!((sum - 1.0).abs() < 1e-6, "{}: integrates to {sum}", made.name);
        let mut counts = Counts::new(expected);
        let mut at_edges = 0;
        for k in 0..N {
            let u = single.sample_2d(key(1400 + i, k), single::PURPOSE_LIGHT_POINT);
            let to = single.sky_light_sample(u);
            let wi = to.wi.as_dvec3();
            assert!((wi.length() - 1.0).abs() < 3e-7, "{}: {wi}", made.name);
            counts.add(cell_of(wi.normalize()));
            let pdf = double.sky_light_pdf(wi.normalize());
            let back = f64::from(single.sky_light_pdf(to.wi));
            let off = |found: f64| (found / pdf - 1.0).abs() > 1e-4;
            // Rounding may put a direction into the next cell.
            at_edges += u32::from(off(f64::from(to.pdf)) || off(back));
        }
        assert!(at_edges < 100, "{}: {at_edges} densities differ", made.name);
        check(made.name, &counts);
    }
}

#[test]
fn a_sky_can_be_sampled_at_the_corners_and_seen_from_anywhere() {
    for made in skies() {
        let bench = Bench::new().sky(made.sky, &made.table);
        let mut kernel = bench.single();
        for u in corners() {
            let to = kernel.sky_light_sample(u);
            let at = format!("{} at {u}: {to:?}", made.name);
            assert!((to.wi.length() - 1.0).abs() < 1e-6, "{at}");
            assert!(to.pdf > 0.0 && to.pdf.is_finite() && to.t > 1e9, "{at}");
        }
        let axes = [DVec3::X, DVec3::Y, DVec3::Z];
        for dir in axes.into_iter().flat_map(|axis| [axis, -axis]) {
            let pdf = kernel.sky_light_pdf(dir.as_vec3());
            assert!(pdf >= 0.0 && pdf.is_finite(), "{}: {pdf}", made.name);
        }
    }
}

/// The density may be 0 only where the sky is black: neighbours of bright texels are lit by interpolation.
#[test]
fn wherever_the_sky_is_bright_it_is_sampled() {
    let made = &skies()[1];
    let bench = Bench::new().sky(made.sky, &made.table);
    let mut kernel = bench.double();
    let mut stream = Stream::new(9, 1);
    let mut lit = 0;
    for _ in 0..200_000 {
        let dir = stream.direction();
        let (v, u) = place(&made.sky, dir);
        // The bright texel's centre is at (3.5, 1.5); its light reaches one texel far.
        let near = (32.0 * u - 3.5).abs() < 1.0 && (16.0 * v - 1.5).abs() < 1.0;
        lit += u32::from(near);
        assert!(!near || kernel.sky_light_pdf(dir) > 0.0, "{dir}");
    }
    assert!(lit > 100);
}

#[test]
fn images_16384_texels_wide_are_read_at_the_right_texel() {
    let bench = Bench::new();
    let (mut kernel, mut wide) = (bench.single(), bench.double());
    let mut stream = Stream::new(9, 2);
    for _ in 0..100_000 {
        let dir = stream.direction().as_vec3();
        let found: Vec2 = kernel.lat_long_place(dir, 0.5);
        let truth = wide.lat_long_place(dir.as_dvec3(), 0.5);
        let off = (found.as_dvec2() - truth).abs();
        let across = off.x.min(1.0 - off.x);
        assert!(across * 16384.0 < 2e-3 + 1e-3 && off.y * 8192.0 < 2e-3, "{dir}: {off}");
    }
}

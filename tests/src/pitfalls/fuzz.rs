//! The fuzzy metal: a density that the naive form does not have, and what it costs not to have it.

#![expect(
    clippy::cast_possible_truncation,
    reason = "the naive form and the kernel compute in f32"
)]

use std::f32::consts::PI;
use std::f64::consts::TAU;

use glam::{DVec3, Vec3};
use runtime::kernel::f32 as single;

use super::{Topic, estimate, row};
use crate::kernel::{Bench, Lobe};
use crate::statistics::Mean;
use crate::statistics::stream::Stream;

fn metal(fuzz: f32) -> single::Scatter {
    Lobe { normal: DVec3::Z, ..Lobe::metal(fuzz) }.single()
}

/// One sample of the kernel's metal seen from `wo`.
fn sample(
    kernel: &mut single::Kernel<'_>,
    fuzz: f32,
    wo: Vec3,
    stream: &mut Stream,
) -> single::Scattered {
    kernel.metal_sample(metal(fuzz), wo, stream.pair24(), stream.unit24())
}

/// Noise of a small light in the mirror direction, `half_angle` radians wide to each side: rays of the metal
/// alone (the naive form), and with light samples (ours), with the means in between them over the truth.
#[must_use]
pub fn small_light(fuzz: f32, half_angle: f32, n: u64) -> [Mean; 2] {
    let bench = Bench::new();
    let mut kernel = bench.single();
    let wo = Vec3::new(-0.6, 0.0, 0.8);
    let origin = Vec3::new(0.6, 0.0, 0.8);
    let edge1 = Vec3::new(half_angle.sin(), 0.0, 0.0);
    let light = single::Light { origin, edge1, ..single::Light::ZERO };
    let cone = kernel.sphere_light_cone(light, Vec3::ZERO);
    let pl = kernel.sphere_light_pdf(light, Vec3::ZERO);
    let truth = lit(fuzz, f64::from(cone));
    let mut stream = Stream::new(127, 0);
    let [mut alone, mut both] = [Mean::default(); 2];
    for _ in 0..n {
        let next = sample(&mut kernel, fuzz, wo, &mut stream);
        let hit = next.pdf > 0.0 && 0.5 * (next.wi - origin).length_squared() <= cone;
        let to = kernel.sphere_light_sample(light, Vec3::ZERO, stream.pair24());
        let f = kernel.metal_eval(metal(fuzz), wo, to.wi).f.x;
        let pb = kernel.metal_eval(metal(fuzz), wo, to.wi).pdf;
        let found = if hit { next.pdf / (pl + next.pdf) } else { 0.0 };
        alone.add(if hit { 1.0 / truth } else { 0.0 });
        both.add(f64::from(f / (to.pdf + pb) + found) / truth);
    }
    [alone, both]
}

/// What a white metal reflects of a light of radiance 1 that fills the cone of this 1 - cos around the
/// mirror direction: the integral of the kernel's density.
fn lit(fuzz: f32, cone: f64) -> f64 {
    let bench = Bench::new();
    let mut kernel = bench.double();
    let n = 1000;
    let at = |i: i32| 1.0 - cone * (f64::from(i) + 0.5) / f64::from(n);
    let density = |c: f64| {
        let d = DVec3::new((1.0 - c * c).max(0.0).sqrt(), 0.0, c);
        kernel.metal_density(d, DVec3::Z, f64::from(fuzz))
    };
    (0..n).map(at).map(density).sum::<f64>() * TAU * cone / f64::from(n)
}

/// Reflectance of a white metal at normal incidence when f cos is divided by cos / pi, and by the density of
/// the lobe.
#[must_use]
pub fn furnace(fuzz: f32, n: u64) -> [Mean; 2] {
    let bench = Bench::new();
    let mut kernel = bench.single();
    let mut stream = Stream::new(131, 0);
    let [mut cosine, mut own] = [Mean::default(); 2];
    for _ in 0..n {
        let next = sample(&mut kernel, fuzz, Vec3::Z, &mut stream);
        let f = kernel.metal_eval(metal(fuzz), Vec3::Z, next.wi).f.x;
        cosine.add(f64::from(f * PI / next.wi.z));
        own.add(f64::from(f / next.pdf));
    }
    [cosine, own]
}

/// Root mean square of the sine to the mirror direction, over that of a ball: with points
/// on the sphere, as the naive form draws them, and with the kernel's.
#[must_use]
pub fn width(fuzz: f32, n: u64) -> [f64; 2] {
    let bench = Bench::new();
    let mut kernel = bench.single();
    let mut stream = Stream::new(137, 0);
    let sine2 = |d: Vec3| f64::from(d.x * d.x + d.y * d.y);
    let mut sums = [Mean::default(); 3];
    for _ in 0..n {
        let on_sphere = stream.direction().as_vec3();
        let radius = stream.unit().cbrt() as f32;
        let in_ball = stream.direction().as_vec3() * radius;
        for (sum, xi) in sums.iter_mut().zip([on_sphere, in_ball]) {
            sum.add(sine2((Vec3::Z + xi * fuzz).normalize()));
        }
        sums[2].add(sine2(sample(&mut kernel, fuzz, Vec3::Z, &mut stream).wi));
    }
    let [sphere, ball, ours] = sums.map(|sum| sum.value().sqrt());
    [sphere / ball, ours / ball]
}

/// Integral of the kernel's density over all directions.
#[must_use]
pub fn integral(fuzz: f32) -> f64 {
    let bench = Bench::new();
    let mut kernel = bench.double();
    let a = f64::from(fuzz);
    // The sine runs from 0 to a below 1; t^2 takes the root at the rim out of the integrand.
    let (n, top) = (20_000, a.min(1.0).asin());
    let cell = |i: u32| {
        let t = (f64::from(i) + 0.5) / f64::from(n);
        let theta = top * (1.0 - t * t);
        let d = DVec3::new(theta.sin(), 0.0, theta.cos());
        TAU * theta.sin() * kernel.metal_density(d, DVec3::Z, a) * top * 2.0 * t
    };
    (0..n).map(cell).sum::<f64>() / f64::from(n)
}

/// Measures the topic.
#[must_use]
pub fn topic() -> Topic {
    let [alone, both] = small_light(0.6, 0.01, 4_000_000);
    let [cosine, own] = furnace(0.2, 400_000);
    let [sphere, ball] = width(0.1, 400_000);
    Topic {
        title: "The fuzzy metal of *Ray Tracing in One Weekend* has a density",
        places: &["shaders/wgsl/bsdf/metal.wgsl"],
        rows: vec![
            row(
                "noise of a light of half angle 0.01 in a metal of fuzz 0.6",
                format!("{:.1}", alone.deviation()),
                format!("{:.3}", both.deviation()),
            ),
            row("the same: mean", estimate(&alone), estimate(&both)),
            row("white furnace, fuzz 0.2, weighed by density", estimate(&cosine), estimate(&own)),
            row(
                "width of the lobe, fuzz 0.1, over that of a ball",
                format!("{sphere:.3}"),
                format!("{ball:.3}"),
            ),
            row(
                "integral of the density, fuzz 0.3",
                "no density",
                format!("1 {}", signed(integral(0.3) - 1.0)),
            ),
        ],
        fact: "With c the cosine to the mirror direction, s² = 1 - c² and q = √(a² - s²), the \
            density of mirror direction plus a point in a ball of radius a is q (3c² + q²) / \
            (2πa³) for a < 1 and (c + q)³ / (4πa³) otherwise. With it the metal takes part in \
            light sampling; dividing by the cosine density instead makes it reflect 28 times what \
            it receives.",
    }
}

fn signed(x: f64) -> String {
    format!("{} {:.0e}", if x < 0.0 { "-" } else { "+" }, x.abs())
}

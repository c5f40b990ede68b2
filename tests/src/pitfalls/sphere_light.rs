//! A sphere that emits, sampled at points of the whole sphere (the naive form) and in its visible cone (ours).
//!
//! The receiver is at the origin with its normal up; the light is at distance 1. The truth for a white
//! Lambert receiver that sees the whole light is ratio^2 cos.

#![expect(
    clippy::cast_possible_truncation,
    reason = "the naive form and the kernel compute in f32"
)]

use std::f32::consts::PI;

use glam::{DVec3, Vec3};
use runtime::kernel::f32 as single;

use super::{Row, Topic, estimate, row};
use crate::kernel::{Bench, Lobe};
use crate::statistics::Mean;
use crate::statistics::stream::Stream;

/// A light of radius `ratio` at distance 1, its centre at cosine `cos` to the normal.
#[derive(Clone, Copy, Debug)]
pub struct Setting {
    /// Radius over distance.
    pub ratio: f32,
    /// Cosine of the centre's direction.
    pub cos: f32,
}

/// What a shadow ray does with the light that it is sent to.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Shadow {
    /// It cannot be hit: the far half counts as well.
    LeavesLightOut,
    /// Its near half hides its far half.
    SeesLight,
}

impl Setting {
    fn center(self) -> Vec3 {
        Vec3::new((1.0 - self.cos * self.cos).max(0.0).sqrt(), 0.0, self.cos)
    }

    /// Reflected radiance of a white Lambert receiver under a light of radiance 1.
    #[must_use]
    pub fn truth(self) -> f64 {
        f64::from(self.ratio).powi(2) * f64::from(self.cos)
    }

    /// The record of the light.
    #[must_use]
    pub fn light(self) -> single::Light {
        let edge1 = Vec3::new(self.ratio, 0.0, 0.0);
        single::Light { origin: self.center(), edge1, ..single::Light::ZERO }
    }

    /// A point of the whole sphere as the naive form chooses it: direction, density, whether it is on the
    /// near half.
    fn naive_point(self, stream: &mut Stream) -> (Vec3, f32, bool) {
        let xi = stream.direction().as_vec3();
        let to = self.center() + xi * self.ratio;
        let distance = to.length();
        let wi = to / distance;
        let facing = xi.dot(-wi);
        (wi, self.naive_density(distance, facing), facing > 0.0)
    }

    /// The naive density of one point of the sphere, per steradian.
    fn naive_density(self, distance: f32, facing: f32) -> f32 {
        distance * distance / (facing.abs().max(1e-3) * 4.0 * PI * self.ratio * self.ratio)
    }

    /// The near hit of a direction: distance and cosine at the light.
    fn near_hit(self, wi: Vec3) -> Option<(f32, f32)> {
        let along = self.center().dot(wi);
        let chord = self.ratio * self.ratio - (self.center() - wi * along).length_squared();
        (along > 0.0 && chord > 0.0).then(|| {
            let t = along - chord.sqrt();
            (t, ((wi * t - self.center()) / self.ratio).dot(-wi))
        })
    }
}

/// `n` light samples of the naive form over the truth.
#[must_use]
pub fn naive(setting: Setting, shadow: Shadow, n: u64) -> Mean {
    let mut stream = Stream::new(101, u64::from(setting.ratio.to_bits()));
    let mut mean = Mean::default();
    for _ in 0..n {
        let (wi, pdf, near) = setting.naive_point(&mut stream);
        let seen = near || shadow == Shadow::LeavesLightOut;
        let value = if seen { wi.z.max(0.0) / (PI * pdf) } else { 0.0 };
        mean.add(f64::from(value) / setting.truth());
    }
    mean
}

/// The naive light samples and diffuse samples, each weighted by the balance heuristic with the naive
/// density of one point, the light left out of shadow rays; over the truth.
#[must_use]
pub fn naive_both(setting: Setting, n: u64) -> Mean {
    let mut stream = Stream::new(103, u64::from(setting.ratio.to_bits()));
    let bench = Bench::new();
    let mut kernel = bench.single();
    let lobe = Lobe { normal: DVec3::Z, ..Lobe::diffuse() }.single();
    let mut mean = Mean::default();
    for _ in 0..n {
        let (wi, pl, _) = setting.naive_point(&mut stream);
        let pb = wi.z.max(0.0) / PI;
        let mut value = pb / (pl + pb);
        let next = kernel.diffuse_sample(lobe, stream.pair24());
        if let Some((t, facing)) = setting.near_hit(next.wi) {
            value += next.pdf / (setting.naive_density(t, facing) + next.pdf);
        }
        mean.add(f64::from(value) / setting.truth());
    }
    mean
}

/// `n` samples of the kernel's cone for a surface seen from `wo`, over `truth`.
#[must_use]
pub fn ours(setting: Setting, lobe: &Lobe, wo: Vec3, truth: f64, n: u64) -> Mean {
    let mut stream = Stream::new(107, u64::from(setting.ratio.to_bits()));
    let bench = Bench::new();
    let mut kernel = bench.single();
    let (light, scatter) = (setting.light(), lobe.single());
    let mut mean = Mean::default();
    for _ in 0..n {
        let to = kernel.sphere_light_sample(light, Vec3::ZERO, stream.pair24());
        let f = kernel.dispatch_eval(scatter, wo, to.wi).f.x;
        mean.add(f64::from(f / to.pdf) / truth);
    }
    mean
}

/// The kernel's cone at a white Lambert surface, over the truth.
#[must_use]
pub fn ours_lambert(setting: Setting, n: u64) -> Mean {
    ours(setting, &Lobe { normal: DVec3::Z, ..Lobe::diffuse() }, Vec3::Z, setting.truth(), n)
}

/// The naive factor cos / pi for a metal with a ball of radius `fuzz` that mirrors the light: over what
/// the metal reflects.
#[must_use]
pub fn naive_on_metal(setting: Setting, fuzz: f32, n: u64) -> f64 {
    let c = setting.center();
    let metal = Lobe { normal: DVec3::Z, ..Lobe::metal(fuzz) };
    let truth = ours(setting, &metal, Vec3::new(-c.x, -c.y, c.z), 1.0, n).value();
    setting.truth() / truth
}

/// Noise of one light chosen out of two, the second `brighter` times brighter than the first, both seen
/// alike: the first evenly, the second by the kernel in proportion to power.
#[must_use]
pub fn choice_noise(brighter: f32, n: u64) -> [f64; 2] {
    let mut stream = Stream::new(109, 0);
    let pmf = [1.0 / (1.0 + brighter), brighter / (1.0 + brighter)];
    let record = |pmf, cdf| pack::abi::Light { pmf, cdf, ..pack::abi::Light::default() };
    let bench = Bench::new().lights(&[record(pmf[0], pmf[0]), record(pmf[1], 1.0)]);
    let mut kernel = bench.single();
    let power = [1.0, brighter].map(f64::from);
    let total = power[0] + power[1];
    let (mut even, mut ours) = (Mean::default(), Mean::default());
    for _ in 0..n {
        even.add(2.0 * power[stream.index(2)] / total);
        let i = kernel.choose_light(2, stream.unit24()) as usize;
        ours.add(power[i] / f64::from(kernel.load_light(i as u32).pmf) / total);
    }
    [even.deviation(), ours.deviation()]
}

fn rows() -> Vec<Row> {
    let small = Setting { ratio: 0.1, cos: 0.8 };
    let large = Setting { ratio: 0.8, cos: 1.0 };
    let n = 2_000_000;
    let apart = naive(small, Shadow::LeavesLightOut, n);
    let hidden = naive(small, Shadow::SeesLight, n);
    let cone = ours_lambert(small, n);
    let [even, power] = choice_noise(100.0, 200_000);
    let metal = naive_on_metal(small, 0.2, 200_000);
    vec![
        row("sphere light, left out of its own shadow rays", estimate(&apart), estimate(&cone)),
        row(
            "sphere light, occluding itself: noise",
            format!("{:.3}", hidden.deviation()),
            format!("{:.3}", cone.deviation()),
        ),
        row(
            "light samples and scattered rays, both weighted, radius / distance 0.1",
            estimate(&naive_both(small, n)),
            estimate(&super::mixture::measure(small, n).both),
        ),
        row(
            "the same at 0.8",
            estimate(&naive_both(large, n)),
            estimate(&super::mixture::measure(large, n).both),
        ),
        row(
            "mirrored in a metal of fuzz 0.2, with cos / π for the surface",
            format!("{metal:.4}"),
            "1 (the metal's own f)",
        ),
        row(
            "one of two lights, the second 100 times brighter: noise",
            format!("{even:.3}"),
            format!("{power:.3}"),
        ),
    ]
}

/// Measures the topic.
#[must_use]
pub fn topic() -> Topic {
    Topic {
        title: "Spherical lights: sample the cone, not the sphere",
        places: &[
            "shaders/wgsl/light/sphere.wgsl",
            "shaders/wgsl/kernel/direct.wgsl",
            "shaders/wgsl/light/choose.wgsl",
        ],
        rows: rows(),
        fact: "A uniform point of the whole sphere meets each direction twice: if shadow rays \
            leave the light out it is exactly twice too bright, and if the light hides its own far \
            half more than half of all shadow rays are wasted. Sampling the visible cone, with \
            density 1 / (2π (1 - cos θ)), has neither fault. (Shirley, Wang & Zimmerman 1996, \
            *Monte Carlo Techniques for Direct Lighting Calculations*.)",
    }
}

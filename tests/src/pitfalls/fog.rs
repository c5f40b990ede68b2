//! Fog and absorption along a segment: what is taken, what is given, and small exponents.

#![expect(clippy::cast_possible_truncation, reason = "both forms compute in f32")]

use glam::Vec3;
use runtime::kernel::f32::{Medium, Path};

use super::{Topic, estimate, percent, row};
use crate::kernel::Bench;
use crate::statistics::Mean;
use crate::statistics::stream::Stream;

/// Radiance of a closed room of reflectance `rho` whose walls emit 1 - rho, filled with fog of radiance 1
/// and of `density` per metre, walls some 50 to 150 m apart: exactly 1. The naive fog only takes, as the sky
/// is not to be seen; then the kernel's.
#[must_use]
pub fn room(rho: f32, density: f32, n: u64) -> [Mean; 2] {
    let fog = Medium { sigma_a: Vec3::splat(density), color: Vec3::ONE, ..Medium::ZERO };
    let bench = Bench::new();
    let mut kernel = bench.single();
    let naive = |path: &mut Path, length: f32| path.throughput *= (-density * length).exp();
    let ours = |path: &mut Path, length: f32| {
        let tau = fog.sigma_a * length;
        kernel.fog_glow(path, fog.color, tau, tau);
        path.throughput *= kernel.beer_transmittance(tau);
    };
    [bounced(rho, n, naive), bounced(rho, n, ours)]
}

/// Radiance in the room if `pass` is what a segment of so many metres does to a path.
fn bounced(rho: f32, n: u64, mut pass: impl FnMut(&mut Path, f32)) -> Mean {
    let mut mean = Mean::default();
    for i in 0..n {
        let mut stream = Stream::new(193, i);
        let mut path = Path { throughput: Vec3::ONE, ..Path::ZERO };
        while path.throughput.x > 0.0 {
            pass(&mut path, stream.between(50.0, 150.0) as f32);
            path.radiance += path.throughput * (1.0 - rho);
            path.throughput *= rho;
            let q = path.throughput.x.min(1.0);
            path.throughput = if stream.unit24() < q { path.throughput / q } else { Vec3::ZERO };
        }
        mean.add(f64::from(path.radiance.x));
    }
    mean
}

/// The naive share of fog after an optical distance.
#[must_use]
pub fn share_naive(x: f32) -> f32 {
    1.0 - (-x).exp()
}

/// Largest relative error of both around `x`.
#[must_use]
pub fn share_errors(x: f64) -> [f64; 2] {
    let bench = Bench::new();
    let mut kernel = bench.single();
    let mut worst = [0.0_f64; 2];
    for i in 0..1000 {
        let x = (x * (1.0 + f64::from(i) / 1000.0)) as f32;
        let exact = -(-f64::from(x)).exp_m1();
        let left = kernel.beer_transmittance(Vec3::splat(x));
        let ours = kernel.beer_absorptance(Vec3::splat(x), left).x;
        for (worst, found) in worst.iter_mut().zip([share_naive(x), ours]) {
            *worst = worst.max((f64::from(found) / exact - 1.0).abs());
        }
    }
    worst
}

/// Transmittance of `distance` metres of a medium that absorbs `sigma` per metre, as the naive form has it, which
/// counts 20 m at most; over the truth.
#[must_use]
pub fn water_naive(sigma: f64, distance: f64) -> f64 {
    (sigma * (distance - distance.min(20.0))).exp()
}

/// Measures the topic.
#[must_use]
pub fn topic() -> Topic {
    let room_row = |rho: f32, density: f32| {
        let [naive, ours] = room(rho, density, 400_000);
        row(
            format!("white room of reflectance {rho} in white fog of {density} per metre"),
            estimate(&naive),
            estimate(&ours),
        )
    };
    let small = |x: f64| {
        let [naive, ours] = share_errors(x);
        row(
            format!("1 - e^(-x) from x = {x:.0e} on: largest relative error"),
            percent(naive),
            format!("{ours:.0e}"),
        )
    };
    Topic {
        title: "Fog gives back what it takes",
        places: &["shaders/wgsl/kernel/fog.wgsl", "shaders/wgsl/math/beer.wgsl"],
        rows: vec![
            room_row(0.5, 1e-3),
            room_row(0.9, 1e-3),
            room_row(0.5, 1e-2),
            small(1e-6),
            small(1e-8),
            row(
                "blue light (0.025 per metre) through 100 m of water",
                format!("{:.2}", water_naive(0.025, 100.0)),
                "1",
            ),
        ],
        fact: "On every segment radiance becomes T L + (1 - T) C. A fog that only absorbs, or \
            gives on sky segments alone, darkens a white room in white fog, which must look white. \
            1 - e^(-x) is a series for thin fog; distances are not clamped.",
    }
}

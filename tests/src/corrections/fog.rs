//! Fog and absorption along a segment: what is taken, what is given, and small exponents.

#![expect(clippy::cast_possible_truncation, reason = "both forms compute in f32")]

use glam::Vec3;
use runtime::kernel::f32::{Medium, Path};

use super::{Topic, estimate, percent, row};
use crate::kernel::Bench;
use crate::statistics::Mean;
use crate::statistics::stream::Stream;

/// Radiance of a closed room of reflectance `rho` whose walls emit 1 - rho, filled with fog of radiance 1
/// and of `density` per metre, walls some 50 to 150 m apart: exactly 1. The guide's fog only takes, as the sky
/// is not to be seen; then the kernel's.
#[must_use]
pub fn room(rho: f32, density: f32, n: u64) -> [Mean; 2] {
    let fog = Medium { sigma_a: Vec3::splat(density), color: Vec3::ONE, ..Medium::ZERO };
    let bench = Bench::new();
    let mut kernel = bench.single();
    let guide = |path: &mut Path, length: f32| path.throughput *= (-density * length).exp();
    let ours = |path: &mut Path, length: f32| kernel.veil_add(path, fog, length);
    [bounced(rho, n, guide), bounced(rho, n, ours)]
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

/// The guide's share of fog after an optical distance.
#[must_use]
pub fn share_guide(x: f32) -> f32 {
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
        let left = kernel.beer_left(Vec3::splat(x));
        let ours = kernel.beer_lost(Vec3::splat(x), left).x;
        for (worst, found) in worst.iter_mut().zip([share_guide(x), ours]) {
            *worst = worst.max((f64::from(found) / exact - 1.0).abs());
        }
    }
    worst
}

/// Transmittance of `distance` metres of a medium that absorbs `sigma` per metre, as the guide has it, which
/// counts 20 m at most; over the truth.
#[must_use]
pub fn water_guide(sigma: f64, distance: f64) -> f64 {
    (sigma * (distance - distance.min(20.0))).exp()
}

/// Measures the topic.
#[must_use]
pub fn topic() -> Topic {
    let room_row = |rho: f32, density: f32| {
        let [guided, ours] = room(rho, density, 400_000);
        row(
            format!("white room of reflectance {rho} in white fog of {density} per metre"),
            estimate(&guided),
            estimate(&ours),
        )
    };
    let small = |x: f64| {
        let [guided, ours] = share_errors(x);
        row(
            format!("1 - e^(-x) from x = {x:.0e} on: largest relative error"),
            percent(guided),
            format!("{ours:.0e}"),
        )
    };
    Topic {
        title: "Fog that only takes",
        section: "4.3, 4.3.1",
        places: &["shaders/wgsl/kernel/veil.wgsl", "shaders/wgsl/math/beer.wgsl"],
        rows: vec![
            room_row(0.5, 1e-3),
            room_row(0.9, 1e-3),
            room_row(0.5, 1e-2),
            small(1e-6),
            small(1e-8),
            row(
                "blue light (0.025 per metre) through 100 m of water",
                format!("{:.2}", water_guide(0.025, 100.0)),
                "1",
            ),
        ],
        says: "Fog multiplies the throughput by e^(-σ t) on every segment, and its colour is mixed into the \
            sky, by 1 - e^(-σ D) with a fixed distance. Absorption in water counts at most 20 m of each \
            segment, against underflow."
            .into(),
        wrong: "What fog takes out of a ray it must give back as its own light, on the same segment. The \
            guide takes on all segments and gives on one: distant hills fade to black in front of a \
            bright sky. In a room where everything has radiance 1, fog included, nothing can look other than \
            1, and it does. The complement 1 - e^(-x) is a difference of near numbers for thin fog. And an \
            exponential that underflows is 0, as it should be: the clamp makes deep water bright."
            .into(),
        right: "On every segment, whatever it ends at: radiance becomes e^(-σ t) L + (1 - e^(-σ t)) C. The \
            complement is a short series where x is small. Distances are not clamped."
            .into(),
    }
}

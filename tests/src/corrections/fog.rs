//! Fog and absorption along a segment: what is taken, what is given, and small exponents.

#![expect(clippy::cast_possible_truncation, reason = "both forms compute in f32")]

use super::{Place, Topic, estimate, percent, row};
use crate::statistics::Mean;
use crate::statistics::stream::Stream;

/// Where fog adds its own light.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Glow {
    /// Where a path reaches the sky only: the guide.
    SkyOnly,
    /// On every segment.
    EverySegment,
}

/// Radiance of a closed room of reflectance `rho` whose walls emit 1 - rho, filled with fog of radiance 1
/// and of `density` per metre, walls some 50 to 150 m apart: exactly 1.
#[must_use]
pub fn room(rho: f64, density: f64, glow: Glow, n: u64) -> Mean {
    let mut mean = Mean::default();
    for i in 0..n {
        let mut stream = Stream::new(193, i);
        let (mut radiance, mut throughput) = (0.0, 1.0);
        while throughput > 0.0 {
            let optical = density * stream.between(50.0, 150.0);
            if glow == Glow::EverySegment {
                radiance -= throughput * (-optical).exp_m1();
            }
            throughput *= (-optical).exp();
            radiance += throughput * (1.0 - rho);
            throughput *= rho;
            let q = throughput.min(1.0);
            throughput = if stream.unit() < q { throughput / q } else { 0.0 };
        }
        mean.add(radiance);
    }
    mean
}

/// The guide's share of fog after an optical distance.
#[must_use]
pub fn share_guide(x: f32) -> f32 {
    1.0 - (-x).exp()
}

/// 1 - e^-x for x >= 0: below 1/100 by three terms of its series, whose rest is below 4e-8 of it.
#[must_use]
pub fn share_ours(x: f32) -> f32 {
    if x < 0.01 { x * (1.0 - x * (0.5 - x / 6.0)) } else { 1.0 - (-x).exp() }
}

/// Largest relative error of both around `x`.
#[must_use]
pub fn share_errors(x: f64) -> [f64; 2] {
    let mut worst = [0.0_f64; 2];
    for i in 0..1000 {
        let x = (x * (1.0 + f64::from(i) / 1000.0)) as f32;
        let exact = -(-f64::from(x)).exp_m1();
        for (worst, found) in worst.iter_mut().zip([share_guide(x), share_ours(x)]) {
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
    let room_row = |rho: f64, density: f64| {
        row(
            format!("white room of reflectance {rho} in white fog of {density} per metre"),
            estimate(&room(rho, density, Glow::SkyOnly, 400_000)),
            estimate(&room(rho, density, Glow::EverySegment, 400_000)),
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
        places: &[Place::Twin("tests/src/corrections/fog.rs")],
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

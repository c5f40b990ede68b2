//! Sampling Henyey and Greenstein's phase function: the naive inverse with its guard, and a form without
//! a division by g.

use glam::{DVec3, Vec2, Vec3};

use super::{Topic, row, share};
use crate::kernel::Bench;
use crate::statistics::Mean;
use crate::statistics::stream::Stream;

/// The naive cosine to the forward direction; `u` in [0, 1).
#[must_use]
pub fn naive(g: f32, u: f32) -> f32 {
    if g.abs() < 0.001 {
        return 1.0 - 2.0 * u;
    }
    let term = (1.0 - g * g) / (1.0 - g + 2.0 * g * u);
    (1.0 + g * g - term * term) / (2.0 * g.max(0.001))
}

/// The cosine in double precision, by the naive inverse without its guard; for g < 0 with u counted from
/// the other end, as `backward` says.
fn truth(g: f64, u: f64, backward: bool) -> f64 {
    let (a, sign) = if backward { (g.abs(), g.signum()) } else { (g, 1.0) };
    let d = 1.0 - a + 2.0 * a * u;
    // 1 - cos, as above: the inverse itself cancels where g is small, in any precision.
    let less = 2.0 * (1.0 - a).powi(2) * (1.0 - u) * (1.0 + a * u) / (d * d);
    sign * (1.0 - less)
}

/// What comes of sampling at one g.
#[derive(Clone, Copy, Debug)]
pub struct Sampled {
    /// Smallest and largest cosine.
    pub range: [f32; 2],
    /// Cosines that are none.
    pub outside: usize,
    /// Mean cosine, which should be g.
    pub mean: Mean,
    /// Largest error of the cosine.
    pub error: f64,
}

/// `n` samples of both forms.
#[must_use]
pub fn sample(g: f32, n: usize) -> [Sampled; 2] {
    let start =
        Sampled { range: [f32::MAX, f32::MIN], outside: 0, mean: Mean::default(), error: 0.0 };
    let mut found = [start; 2];
    let mut stream = Stream::new(179, u64::from(g.to_bits()));
    let bench = Bench::new();
    let mut kernel = bench.single();
    for _ in 0..n {
        let u = stream.unit24();
        let local = kernel.hg_local(g.abs(), 1.0 - u, Vec2::X);
        let cosines = [(naive(g, u), false), (g.signum() * local.z, true)];
        for (sampled, (cos, backward)) in found.iter_mut().zip(cosines) {
            sampled.range = [sampled.range[0].min(cos), sampled.range[1].max(cos)];
            sampled.outside += usize::from(cos.abs() > 1.0 + 1e-5);
            sampled.mean.add(f64::from(cos));
            let exact = truth(f64::from(g), f64::from(u), backward);
            sampled.error = sampled.error.max((f64::from(cos) - exact).abs());
        }
    }
    found
}

/// Largest relative error of the kernel's density against the phase function at the exact cosine.
#[must_use]
pub fn density_error(g: f32, n: usize) -> f64 {
    let mut stream = Stream::new(181, u64::from(g.to_bits()));
    let wide = f64::from(g);
    let bench = Bench::new();
    let mut kernel = bench.single();
    let mut worst = 0.0_f64;
    for _ in 0..n {
        let wi = kernel.hg_sample(Vec3::Z, g, Vec2::new(stream.unit24(), stream.unit24()));
        // From the chord to the axis: near the peak the cosine has lost what the density depends on.
        let axis = if g < 0.0 { DVec3::NEG_Z } else { DVec3::Z };
        let a = wide.abs();
        let base = (1.0 - a).powi(2) + a * (wi.as_dvec3() - axis).length_squared();
        let exact = (1.0 - a * a) / (4.0 * std::f64::consts::PI * base.powf(1.5));
        worst = worst.max((f64::from(kernel.hg_pdf(Vec3::Z, g, wi)) / exact - 1.0).abs());
    }
    worst
}

/// Measures the topic.
#[must_use]
pub fn topic() -> Topic {
    let n = 1_000_000;
    let mut rows = Vec::new();
    for g in [-0.5, -0.9] {
        let [naive, ours] = sample(g, n);
        let range = |s: &Sampled| format!("{:.4} to {:.4}", s.range[0], s.range[1]);
        rows.push(row(format!("range of the cosine, g = {g}"), range(&naive), range(&ours)));
        rows.push(row(
            "the same: cosines beyond ±1; mean cosine",
            format!("{}; {:.1}", share(naive.outside, n), naive.mean.value()),
            format!("{}; {:.4}", share(ours.outside, n), ours.mean.value()),
        ));
    }
    for g in [0.001, 0.01, 0.7, 0.9999] {
        let [naive, ours] = sample(g, n);
        let error = |s: &Sampled| format!("{:.0e}", s.error);
        rows.push(row(
            format!("largest error of the cosine, g = {g}"),
            error(&naive),
            error(&ours),
        ));
    }
    Topic {
        title: "Henyey-Greenstein in both directions",
        places: &["shaders/wgsl/bsdf/hg.wgsl"],
        rows,
        fact: "A guard max(g, 0.001) in the divisor breaks backward scattering: cosines come out \
            in the hundreds. 1 - cos and 1 + cos have closed forms with positive factors, which \
            need no branch and no division by g.",
    }
}

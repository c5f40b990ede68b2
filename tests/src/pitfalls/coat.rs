//! A clear coat: an average of two colours (the naive form), layers (ours), and the exact energy of both.

#![expect(clippy::cast_possible_truncation, reason = "the kernel computes in f32")]

use glam::{DVec3, Vec3};

use super::{Topic, fresnel, off, row};
use crate::kernel::{Bench, Lobe};

/// White share of the highlight that the naive form means to have; mixed the wrong way round it has the rest.
const WHITE: f64 = 0.7;

/// Schlick with the raised reflectance of the naive form at normal incidence, index 1.5.
fn raised_schlick(c: f64) -> f64 {
    let r0 = 0.04 * 1.5;
    r0 + (1.0 - r0) * (1.0 - c).powi(5)
}

/// The naive mean of white and base; `white`: share of white.
fn mean_color(base: f64, white: f64) -> f64 {
    white + (1.0 - white) * base
}

/// What the naive coat reflects, all of it and its highlight alone, lost rays not counted. `c`:
/// cosine; `base`: reflectance of the wood.
#[must_use]
pub fn naive(c: f64, base: f64) -> [f64; 2] {
    let highlight = raised_schlick(c) * mean_color(base, 1.0 - WHITE);
    [highlight + (1.0 - raised_schlick(c)) * 0.88 * base, highlight]
}

/// What a smooth coat of index 1.5 over a Lambert base reflects: through the interface, any number of times
/// between base and interface, and out; all of it and its highlight alone.
#[must_use]
pub fn exact(c: f64, base: f64) -> [f64; 2] {
    let n = 4000;
    let at = |i: i32| (f64::from(i) + 0.5) / f64::from(n);
    let back = (0..n).map(|i| 2.0 * at(i) * fresnel::truth(at(i), -1.0 / 3.0)).sum::<f64>();
    let back = back / f64::from(n);
    let highlight = fresnel::truth(c, 0.5);
    [highlight + (1.0 - highlight) * base * (1.0 - back) / (1.0 - base * back), highlight]
}

/// What the kernel's principled surface of index 1.5 and roughness 0 reflects.
#[must_use]
pub fn ours(c: f64, base: f64) -> [f64; 2] {
    let bench = Bench::new();
    let mut kernel = bench.single();
    let lobe = Lobe { normal: DVec3::Z, color: base as f32, ..Lobe::principled(0.0, 0.0) };
    let (scatter, wo) = (lobe.single(), lobe.at_cosine(c).as_vec3());
    let surface = kernel.principled_at(scatter, wo);
    let highlight = f64::from(kernel.principled_fresnel(surface, c as f32).x);
    let n = 4000;
    let at = |i: i32| (f64::from(i) + 0.5) / f64::from(n);
    // The base depends on the cosine alone.
    let mut eval = |mu: f64| {
        let wi = Vec3::new((1.0 - mu * mu).sqrt() as f32, 0.0, mu as f32);
        f64::from(kernel.dispatch_principled_eval(scatter, wo, wi).f.x)
    };
    let diffuse = (0..n).map(|i| eval(at(i))).sum::<f64>() * std::f64::consts::TAU / f64::from(n);
    [highlight + diffuse, highlight]
}

/// Measures the topic.
#[must_use]
pub fn topic() -> Topic {
    let off = |x: f64, truth: f64| format!("{x:.4} ({})", off(x, truth));
    let highlight = |c: f64| {
        let [_, truth] = exact(c, 0.04);
        row(
            format!("highlight on dark wood (0.04), cosine {c} (exact {truth:.4})"),
            off(naive(c, 0.04)[1], truth),
            off(ours(c, 0.04)[1], truth),
        )
    };
    let white = |c: f64| {
        let [truth, _] = exact(c, 1.0);
        row(
            format!("white base under the coat, cosine {c} (exact {truth:.4})"),
            off(naive(c, 1.0)[0], truth),
            off(ours(c, 1.0)[0], truth),
        )
    };
    let [promised, got] = [WHITE, 1.0 - WHITE].map(|white| mean_color(0.04, white));
    Topic {
        title: "A coat is a layer, not an average",
        places: &["shaders/wgsl/bsdf/principled.wgsl"],
        rows: vec![
            row(
                format!("colour of the highlight on dark wood (0.04); {promised:.3} is meant"),
                off(got, promised),
                "1 (white)",
            ),
            highlight(1.0),
            highlight(0.1),
            white(1.0),
            white(0.1),
        ],
        fact: "The highlight of a clear coat is white whatever it covers; averaging it with the \
            base tints and darkens it. The base gets what the coat does not give back, by its \
            directional albedo: a white base under it loses nothing.",
    }
}

//! Weights of samples against the model's value, and both directions exchanged.

use glam::DVec3;
use pack::abi::MaterialKind;
use runtime::kernel::f32::SampleKey;
use tests::kernel::{Bench, Lobe};
use tests::statistics::Mean;
use tests::statistics::stream::Stream;

use crate::albedo;

/// Sample `i` of test `test`.
pub(crate) fn key(test: usize, i: usize) -> SampleKey {
    let word = |x: usize| u32::try_from(x).expect("tests are few and samples fit 32 bits");
    SampleKey { pixel: word(test), sample: word(i), bounce: 0, seed: 31 }
}

fn lobes() -> Vec<Lobe> {
    let mut lobes = vec![Lobe::diffuse()];
    for roughness in [0.05, 0.2, 0.5, 1.0] {
        lobes.extend([0.0, 0.5, 1.0].map(|metallic| Lobe::principled(roughness, metallic)));
    }
    for ior in [1.0, 4.0] {
        lobes.push(Lobe { ior, color: 0.7, ..Lobe::principled(0.4, 0.1) });
    }
    lobes
}

/// A direction above the surface, sometimes grazing.
pub(crate) fn above(stream: &mut Stream, lobe: &Lobe) -> DVec3 {
    let d = stream.direction();
    let up = d.dot(lobe.normal);
    let d = if up < 0.0 { d - lobe.normal * (2.0 * up) } else { d };
    let squash = if stream.unit() < 0.3 { 0.98 } else { 0.0 };
    let d = d - lobe.normal * (squash * d.dot(lobe.normal));
    d.normalize().as_vec3().as_dvec3().normalize()
}

/// f(wo, wi) = f(wi, wo): for all models but the metal's ball, which is known not to be reciprocal.
#[test]
fn light_goes_both_ways() {
    let bench = Bench::new();
    let (mut single, mut double) = (bench.single(), bench.double());
    for (i, lobe) in lobes().into_iter().enumerate() {
        let mut stream = Stream::new(41, i as u64);
        for _ in 0..4000 {
            let (a, b) = (above(&mut stream, &lobe), above(&mut stream, &lobe));
            let (mu_a, mu_b) = (a.dot(lobe.normal), b.dot(lobe.normal));
            let s = lobe.double();
            let there = double.dispatch_eval(s, a, b).f.x / mu_b;
            let back = double.dispatch_eval(s, b, a).f.x / mu_a;
            assert!((there / back - 1.0).abs() < 1e-9, "{lobe:?} {a} {b}: {there} {back}");
            let (a, b, s) = (a.as_vec3(), b.as_vec3(), lobe.single());
            let there = single.dispatch_eval(s, a, b).f.x / s.ns.dot(b);
            let back = single.dispatch_eval(s, b, a).f.x / s.ns.dot(a);
            let bound = 1e-4 + 4e-7 / f64::from(lobe.roughness.max(0.01).powi(2));
            assert!(f64::from((there / back - 1.0).abs()) < bound, "{lobe:?}: {there} {back}");
        }
    }
}

#[test]
fn a_metals_ball_is_not_reciprocal() {
    let bench = Bench::new();
    let mut kernel = bench.double();
    let lobe = Lobe::metal(0.7);
    let (a, b) = (lobe.at_cosine(0.9), lobe.mirror(lobe.at_cosine(0.4)));
    let there = kernel.dispatch_eval(lobe.double(), a, b).f.x / b.dot(lobe.normal);
    let back = kernel.dispatch_eval(lobe.double(), b, a).f.x / a.dot(lobe.normal);
    assert!((there / back - 1.0).abs() > 0.1, "{there} {back}");
}

/// weight = f |cos| / pdf.
#[test]
fn a_weight_is_value_over_density() {
    let bench = Bench::new();
    let mut kernel = bench.single();
    let metals = [0.01, 0.3, 1.0].map(Lobe::metal);
    for (i, lobe) in lobes().into_iter().chain(metals).enumerate() {
        for mu in [1.0, 0.5, 0.1, 0.01] {
            let wo = lobe.at_cosine(mu).as_vec3();
            for k in 0..2000 {
                let out = kernel.dispatch_sample(lobe.single(), wo, key(1000 + i, k));
                if out.pdf > 0.0 {
                    let f = kernel.dispatch_eval(lobe.single(), wo, out.wi).f.x;
                    let off = (out.weight.x * out.pdf - f).abs();
                    assert!(off <= 1e-5 * f, "{lobe:?} at {mu}: {out:?}, f {f}");
                }
            }
        }
    }
}

/// The mean weight of samples is the albedo of the model: sampler, density, value and mirror agree.
#[test]
fn mean_weights_are_albedos() {
    let bench = Bench::new();
    let (mut single, mut double) = (bench.single(), bench.double());
    let smooth = [Lobe::principled(0.0, 0.0), Lobe { color: 0.5, ..Lobe::principled(0.0, 0.5) }];
    for (i, lobe) in lobes().into_iter().chain(smooth).enumerate() {
        for (j, mu) in [1.0, 0.4, 0.05].into_iter().enumerate() {
            let wo = lobe.at_cosine(mu);
            let truth = albedo(&mut double, &lobe, wo, 8);
            let mut mean = Mean::default();
            for k in 0..100_000 {
                let out =
                    single.dispatch_sample(lobe.single(), wo.as_vec3(), key(2000 + 3 * i + j, k));
                mean.add(f64::from(out.weight.x));
            }
            let off = (mean.value() - truth).abs();
            let bound = 4.5 * mean.error() + 1e-4;
            assert!(
                off < bound,
                "{lobe:?} at {mu}: {} +- {}, not {truth}",
                mean.value(),
                mean.error()
            );
        }
    }
}

/// Light from below the surface, or seen from below, is none of a reflection's.
#[test]
fn nothing_is_reflected_below_the_surface() {
    let bench = Bench::new();
    let mut kernel = bench.single();
    let mut stream = Stream::new(43, 0);
    for lobe in lobes().into_iter().chain([0.3, 1.0].map(Lobe::metal)) {
        for _ in 0..500 {
            let (o, i) = (above(&mut stream, &lobe), above(&mut stream, &lobe));
            let (wo, below) = (o.as_vec3(), (-i).as_vec3());
            assert_eq!(kernel.dispatch_eval(lobe.single(), wo, below).f.x, 0.0, "{lobe:?}");
            // A shading normal may be turned so that the geometric one says no.
            let mut bent = lobe.single();
            bent.ng = -bent.ng;
            assert_eq!(kernel.dispatch_eval(bent, wo, i.as_vec3()).f.x, 0.0, "{lobe:?}");
        }
    }
    let glass = Lobe::new(MaterialKind::Dielectric);
    let eval =
        kernel.dispatch_eval(glass.single(), glass.normal.as_vec3(), glass.normal.as_vec3()).f;
    assert_eq!(eval.x, 0.0, "a delta has no value");
}

//! Hemispherical albedo.

use glam::DVec3;
use pack::abi::{Material, MaterialKind};
use tests::kernel::{Bench, Lobe};
use tests::layers::Layers;
use tests::statistics::Mean;
use tests::statistics::grid::{Grid, Shape};

use crate::albedo;

/// Cosines of the incident direction, down to grazing.
const MU: [f64; 6] = [1.0, 0.8, 0.5, 0.2, 0.05, 0.01];

/// Rounding of the kernel's constants, and quadrature.
const SLACK: f64 = 1e-4;

#[test]
fn diffuse_reflects_its_colour() {
    let bench = Bench::new();
    let mut kernel = bench.double();
    for color in [0.0, 0.18, 0.5, 1.0] {
        let lobe = Lobe { color, ..Lobe::diffuse() };
        for mu in MU {
            let e = albedo(&mut kernel, &lobe, lobe.at_cosine(mu), 16);
            assert!((e - f64::from(color)).abs() < 2e-5, "{color} at {mu}: {e}");
        }
    }
}

/// Without the light of several reflections.
fn once() -> Bench {
    let record = Material { compensation: 0.0, ..Material::from(Layers::PLAIN) };
    Bench::new().materials(&[record])
}

/// White: every corner of the parameters and between.
#[test]
fn principled_returns_everything() {
    let bench = Bench::new();
    let mut kernel = bench.double();
    let mut largest: f64 = 0.0;
    for roughness in [0.0, 0.05, 0.1, 0.25, 0.5, 0.75, 0.9, 1.0] {
        for metallic in [0.0, 0.3, 1.0] {
            for ior in [1.0, 1.0001, 1.5, 2.5, 4.0] {
                let lobe = Lobe { ior, ..Lobe::principled(roughness, metallic) };
                // The tables of directional albedo are made for cosines down to 0.02.
                for mu in MU.into_iter().filter(|mu| *mu > 0.02) {
                    let e = albedo(&mut kernel, &lobe, lobe.at_cosine(mu), 8);
                    assert!((e - 1.0).abs() < 0.015, "{lobe:?} at {mu}: {e}");
                    largest = largest.max(e);
                }
            }
        }
    }
    // Lambert without an interface gives everything back.
    assert!(largest > 1.0 - SLACK, "{largest}");
}

#[test]
fn principled_without_colour_reflects_the_interface_only() {
    let bench = Bench::new();
    let mut kernel = bench.double();
    for (roughness, metallic, most) in [(0.3, 0.0, 1.0), (0.0, 0.0, 1.0), (1.0, 1.0, 0.05)] {
        let lobe = Lobe { color: 0.0, ..Lobe::principled(roughness, metallic) };
        let e = albedo(&mut kernel, &lobe, lobe.at_cosine(0.9), 8);
        assert!(e < 0.06_f64.min(most), "{lobe:?}: {e}");
    }
}

/// A white GGX conductor loses what its single scattering does not return. At alpha = 1 and normal
/// incidence that is ln 2 exactly.
#[test]
fn ggx_at_its_roughest_returns_one_less_ln_2() {
    let bench = once();
    let mut kernel = bench.double();
    let lobe = Lobe::principled(1.0, 1.0);
    let e = albedo(&mut kernel, &lobe, lobe.normal, 16);
    let truth = 1.0 - std::f64::consts::LN_2;
    assert!((e - truth).abs() < 1e-4, "{e}, not {truth}");
}

#[test]
fn ggx_tends_to_a_mirror() {
    let bench = once();
    let mut kernel = bench.double();
    for mu in [1.0, 0.5, 0.2] {
        let mut last = 0.0;
        for roughness in [0.8, 0.4, 0.2, 0.1, 0.05] {
            let lobe = Lobe::principled(roughness, 1.0);
            let e = albedo(&mut kernel, &lobe, lobe.at_cosine(mu), 8);
            assert!(e > last - SLACK, "{roughness} at {mu}: {e} after {last}");
            last = e;
        }
        assert!((last - 1.0).abs() < 2e-3, "{last} at {mu}");
    }
}

/// The ball's part below the horizon is lost: 1/2 + 3t/4 - t^3/4 is left, t = min(1, cos / fuzz).
#[test]
fn metal_loses_what_goes_below_the_horizon() {
    let bench = Bench::new();
    let (mut single, mut double) = (bench.single(), bench.double());
    for (i, fuzz) in [0.1_f32, 0.5, 0.999, 1.0].into_iter().enumerate() {
        let a = f64::from(fuzz);
        for (j, mu) in MU.into_iter().enumerate() {
            let lobe = Lobe::metal(fuzz);
            let wo = lobe.at_cosine(mu);
            let t = (lobe.normal.dot(wo) / a).min(1.0);
            let truth = 0.5 + 0.75 * t - 0.25 * t * t * t;
            // Cells around the mirror direction; the horizon cuts them.
            let reach = if a < 1.0 { a.asin() } else { std::f64::consts::FRAC_PI_2 };
            let shape = Shape { reach, ring_scale: reach, ..Shape::SPHERE };
            let s = lobe.double();
            let cells = Grid::new(lobe.mirror(wo), lobe.normal, shape).integrate_above(
                16,
                lobe.normal,
                |wi| double.dispatch_eval(s, wo, wi).f.x,
            );
            let e: f64 = cells.iter().sum();
            assert!((e - truth).abs() < 3e-4, "fuzz {fuzz} at {mu}: {e}, not {truth}");
            let mut mean = Mean::default();
            for k in 0..200_000 {
                let key = crate::weight::key(10 * i + j, k);
                let out = single.dispatch_sample(lobe.single(), wo.as_vec3(), key);
                mean.add(f64::from(out.weight.x));
            }
            // A constant weight has no error of its own; then it is exact.
            let off = (mean.value() - truth).abs();
            assert!(off < 5.0 * mean.error() + 1e-5, "fuzz {fuzz} at {mu}: {}", mean.value());
        }
    }
}

/// An interface keeps energy: what is not reflected goes through, at any index and from either side.
#[test]
fn dielectric_keeps_all_energy() {
    let bench = Bench::new();
    let mut kernel = bench.single();
    for ior in [1.0, 1.0 + 1e-6, 1.0001, 1.33, 1.5, 10.0] {
        for front in [true, false] {
            let lobe = Lobe { ior, front, ..Lobe::new(MaterialKind::Dielectric) };
            for mu in MU {
                let wo = lobe.at_cosine(mu).as_vec3();
                for k in 0..200 {
                    let out = kernel.dispatch_sample(lobe.single(), wo, crate::weight::key(900, k));
                    // Radiance times the square of the index behind it.
                    let kept = f64::from(out.weight.x * out.eta2);
                    assert!((kept - 1.0).abs() < 1e-6, "{lobe:?}: {out:?}");
                    if (ior - 1.0).abs() < 1e-9 {
                        assert_eq!(out.wi, -wo, "no interface bends nothing");
                    }
                }
            }
        }
    }
}

#[test]
fn an_emitter_reflects_nothing() {
    let bench = Bench::new();
    let mut kernel = bench.double();
    let lobe = Lobe::new(MaterialKind::Emissive);
    assert_eq!(albedo(&mut kernel, &lobe, lobe.normal, 1), 0.0);
    let out = kernel.emissive_sample();
    assert_eq!((out.weight, out.pdf), (DVec3::ZERO, 0.0));
}

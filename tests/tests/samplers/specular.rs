//! Directions of conductors, rough glass and clear coats.

use glam::DVec3;
use runtime::kernel::f32 as single;
use tests::features::sample_at;
use tests::kernel::Lobe;
use tests::statistics::Counts;
use tests::statistics::grid::{Grid, Shape};

use crate::bsdf::{Case, compare, lobe_grid};
use crate::{N, check, corners, key};

/// Roughness, anisotropy, compensation, cosine.
const CONDUCTOR: [(f32, f32, f32, f64); 10] = [
    (0.05, 0.0, 1.0, 0.7),
    (0.2, 0.0, 1.0, 0.9),
    (0.6, 0.0, 1.0, 0.05),
    (0.5, 0.0, 0.0, 0.4),
    (0.5, 0.0, 1.0, 0.4),
    (1.0, 0.0, 1.0, 1.0),
    (1.0, 0.0, 1.0, 0.1),
    (0.6, 0.7, 1.0, 0.6),
    (0.8, 1.0, 1.0, 0.3),
    (1.0, 1.0, 0.0, 0.8),
];
/// Roughness, index, from the front, cosine.
const GLASS: [(f32, f64, bool, f64); 8] = [
    (0.2, 1.5, true, 0.8),
    (0.2, 1.5, false, 0.9),
    (0.5, 1.5, true, 0.3),
    (0.5, 1.5, false, 0.5),
    (1.0, 1.5, true, 1.0),
    (1.0, 2.4, false, 0.6),
    (0.7, 1.1, true, 0.1),
    (0.7, 1.1, false, 0.7),
];
/// Fuzz, cosine.
const COAT: [(f32, f64); 5] = [(0.0, 0.6), (0.1, 0.9), (0.3, 0.3), (1.0, 0.6), (0.9, 0.05)];

/// Chi-square tests here: two for glass, a side each.
pub(crate) const CHECKS: usize = CONDUCTOR.len() + SPREAD.len() + 2 * GLASS.len() + COAT.len();

/// Squares of the widths for which the second lobe of conductors is sampled.
const SPREAD: [f32; 5] = [1e-6, 1e-4, 0.01, 0.2, 1.0];

/// The second lobe does not depend on the angle: bins of its cosine, even in the logarithm that is sampled.
#[test]
fn the_second_lobe_of_conductors_has_its_density() {
    let bench = Lobe::conductor(0.5, 0.0).bench();
    let (mut kernel, mut double) = (bench.single(), bench.double());
    for (test, a2) in SPREAD.into_iter().enumerate() {
        let (a, bins) = (f64::from(a2), 64_usize);
        let edge = |i: usize| {
            let t = i as f64 / bins as f64;
            (a * ((1.0 + 1.0 / a).powf(t) - 1.0)).max(0.0).sqrt()
        };
        let mass = |i: usize| {
            let (low, high, n) = (edge(i), edge(i + 1), 400);
            let step = (high - low) / f64::from(n);
            let at = |k: i32| low + (f64::from(k) + 0.5) * step;
            let sum: f64 = (0..n).map(|k| double.ggx_albedo_pdf(a, at(k))).sum();
            sum * step * std::f64::consts::TAU * N as f64
        };
        let mut counts = Counts::new((0..bins).map(mass).collect());
        for k in 0..N {
            let u = kernel.sample_2d(key(880 + test, k), single::PURPOSE_DIRECTION);
            let d = kernel.ggx_albedo_sample(a2, u).as_dvec3();
            let t = (1.0 + d.z * d.z / a).ln() / (1.0 + 1.0 / a).ln();
            counts.add(((t * bins as f64) as usize).min(bins - 1));
        }
        check(&format!("spread of width {}", a.sqrt()), &counts);
    }
}

/// Compares what `dispatch_sample` does above the plane with normal `up` with `dispatch_pdf`; the rest of the
/// samples is one cell of its own.
fn compare_side(test: usize, lobe: &Lobe, mu: f64, grid: Grid, up: DVec3) -> f64 {
    let bench = lobe.bench();
    let (mut single, mut double) = (bench.single(), bench.double());
    let wo = lobe.at_cosine(mu);
    let (scatter, truth) = (lobe.single(), lobe.double());
    compare(Case {
        name: format!("{lobe:?} at cosine {mu}, side {up}"),
        grid,
        up,
        sample: |i| {
            let out = single.dispatch_sample(scatter, wo.as_vec3(), key(test, i));
            let d = out.wi.as_dvec3().normalize();
            (out.weight.x > 0.0 && out.pdf > 0.0 && d.dot(up) > 0.0).then_some(d)
        },
        pdf: |d| double.dispatch_eval(truth, wo, d).pdf,
    })
}

#[test]
fn conductor_directions_have_their_density() {
    for (i, (roughness, anisotropy, weight, mu)) in CONDUCTOR.into_iter().enumerate() {
        let lobe = Lobe { weight, ..Lobe::conductor(roughness, anisotropy) };
        let mirror = lobe.mirror(lobe.at_cosine(mu));
        let alpha = f64::from(roughness * roughness);
        let grid = lobe_grid(mirror, lobe.normal, alpha, mu);
        compare_side(800 + i, &lobe, mu, grid, lobe.normal);
    }
}

#[test]
fn rough_glass_directions_have_their_density_on_both_sides() {
    for (i, (roughness, ior, front, mu)) in GLASS.into_iter().enumerate() {
        let lobe = Lobe::rough_dielectric(roughness, ior, front);
        let (wo, n) = (lobe.at_cosine(mu), lobe.normal);
        let alpha = f64::from(roughness * roughness);
        let above = lobe_grid(lobe.mirror(wo), n, alpha, mu);
        let transmitted = compare_side(820 + i, &lobe, mu, above, n);
        let eta = if front { ior } else { 1.0 / ior };
        let bench = lobe.bench();
        let axis = bench.double().dielectric_refract(n, wo, eta, eta - 1.0);
        let axis = if axis.dot(n) < -0.1 { axis } else { -n };
        // Refraction turns directions less than the facets are turned.
        let width = alpha * (eta - 1.0).abs().min(1.0);
        let below = if width > 0.2 {
            Grid::new(-n, wo, Shape::HEMISPHERE)
        } else {
            Grid::new(axis, n, Shape { ring_scale: width, ..Shape::SPHERE })
        };
        let reflected = compare_side(840 + i, &lobe, mu, below, -n);
        // Reflected, transmitted, absorbed: nothing else.
        let absorbed = transmitted + reflected - 1.0;
        assert!(absorbed > -1e-3 && absorbed < 0.5, "{lobe:?} at {mu}: {absorbed} is absorbed");
    }
}

#[test]
fn clearcoat_directions_have_their_density() {
    for (i, (fuzz, mu)) in COAT.into_iter().enumerate() {
        let lobe = Lobe::clearcoat(fuzz);
        let a = f64::from(fuzz);
        let grid = if a < 0.5 && a > 0.0 {
            let shape = Shape { ring_scale: a, ..Shape::SPHERE };
            Grid::new(lobe.mirror(lobe.at_cosine(mu)), lobe.normal, shape)
        } else {
            Grid::new(lobe.normal, lobe.at_cosine(mu), Shape::HEMISPHERE)
        };
        let rest = compare_side(860 + i, &lobe, mu, grid, lobe.normal);
        assert!(fuzz > 0.0 || rest > 0.09, "the mirror has a share of its own, not {rest}");
    }
}

fn lobes() -> Vec<Lobe> {
    let mut lobes = Vec::new();
    for roughness in [0.0, 0.0317, 0.1, 0.5, 1.0] {
        for color in [0.0, 0.6, 1.0] {
            lobes.extend([0.0, 0.4, 1.0].map(|a| Lobe { color, ..Lobe::conductor(roughness, a) }));
        }
        for ior in [1.0, 1.0 + 1e-6, 1.0001, 1.01, 1.5, 10.0] {
            lobes.extend([true, false].map(|front| Lobe::rough_dielectric(roughness, ior, front)));
        }
    }
    for color in [0.0, 0.5, 1.0] {
        for ior in [1.0, 1.5, 10.0] {
            lobes.extend([0.0, 0.01, 0.3, 1.0].map(|f| Lobe { color, ior, ..Lobe::clearcoat(f) }));
        }
    }
    lobes
}

#[test]
fn the_corners_of_the_unit_square_give_directions() {
    for lobe in lobes() {
        let bench = lobe.bench();
        let mut kernel = bench.single();
        for mu in [1.0, 0.5, 1e-2, 1e-4, 1e-6] {
            let wo = lobe.at_cosine(mu).as_vec3();
            for u in corners() {
                for v in corners().map(|c| c.x) {
                    let out = sample_at(&mut kernel, &lobe, wo, u, v);
                    let at = format!("{lobe:?} mu {mu} u {u} v {v}: {out:?}");
                    assert!((out.wi.length() - 1.0).abs() < 1e-6, "{at}");
                    assert!(out.pdf >= 0.0 && out.pdf.is_finite(), "{at}");
                    assert!(out.weight.is_finite() && out.weight.min_element() >= 0.0, "{at}");
                    assert!(out.eta2 > 0.0 && out.eta2.is_finite(), "{at}");
                }
            }
        }
    }
}

/// weight = f |cos| / pdf, with the density that the other side of the balance heuristic computes.
#[test]
fn samples_carry_their_density_and_weight() {
    for (i, lobe) in lobes().into_iter().enumerate() {
        let bench = lobe.bench();
        let mut kernel = bench.single();
        let s = lobe.single();
        for mu in [1.0, 0.5, 0.1, 0.01] {
            let wo = lobe.at_cosine(mu).as_vec3();
            for k in 0..1000 {
                let out = kernel.dispatch_sample(s, wo, key(900 + i, k));
                if out.pdf > 0.0 {
                    let pdf = kernel.dispatch_eval(s, wo, out.wi).pdf;
                    let off = (pdf / out.pdf - 1.0).abs();
                    assert!(off < 1e-4, "{lobe:?} mu {mu}: {} and {pdf}", out.pdf);
                    let f = kernel.dispatch_eval(s, wo, out.wi).f.x;
                    let off = (out.weight.x * out.pdf - f).abs();
                    assert!(off <= 1e-4 * f, "{lobe:?} mu {mu}: {out:?}, f {f}");
                }
            }
        }
    }
}

//! Directions of thin sheets, on both sides of them.

use pack::abi::{Material, MaterialKind};
use tests::features::sample_at;
use tests::kernel::{Bench, Lobe};
use tests::statistics::Counts;
use tests::statistics::grid::{Grid, Shape};

use crate::{N, check, corners, key};

/// Translucency, share that goes on forward, its mean cosine, cosine of the incident direction.
const LEAF: [(f32, f32, f32, f64); 6] = [
    (0.0, 0.5, 0.6, 0.7),
    (0.3, 0.0, 0.6, 0.1),
    (0.3, 0.5, 0.6, 0.9),
    (1.0, 1.0, 0.9, 0.5),
    (1.0, 1.0, 0.0, 0.05),
    (0.6, 0.8, -0.7, 0.3),
];
/// Share of fuzz, radius of fuzz, of wax, index, cosine. Nothing scatters in the slab: its density is a stand-in.
const PETAL: [(f32, f32, f32, f64, f64); 5] = [
    (0.15, 0.65, 0.2, 1.4, 0.8),
    (0.0, 0.5, 0.05, 1.01, 0.3),
    (0.5, 1.0, 0.6, 1.8, 0.95),
    (0.15, 0.3, 0.2, 1.4, 0.1),
    (0.6, 0.9, 0.5, 2.0, 0.02),
];

/// Chi-square tests here.
pub(crate) const CHECKS: usize = LEAF.len() + PETAL.len();

/// Midpoints along each side of a cell.
const FINE: usize = 64;

/// Compares `dispatch_sample` with `dispatch_pdf` over the whole sphere; deltas count as no direction.
fn compare(test: usize, lobe: Lobe, record: Material, mu: f64) {
    let bench = Bench::new().materials(&[record]);
    let (mut single, mut double) = (bench.single(), bench.double());
    let wo = lobe.at_cosine(mu);
    let (scatter, truth) = (lobe.single(), lobe.double());
    let grid = Grid::new(lobe.mirror(wo), lobe.normal, Shape::SPHERE);
    let shares = grid.integrate(FINE, |d| double.dispatch_eval(truth, wo, d).pdf);
    let sum: f64 = shares.iter().sum();
    assert!(sum < 1.001, "{record:?}: the density integrates to {sum}");
    let mut counts = Counts::new(shares.iter().map(|share| share * N as f64).collect());
    let mut none = 0;
    for i in 0..N {
        let out = single.dispatch_sample(scatter, wo.as_vec3(), key(test, i));
        let cell = grid.cell(out.wi.as_dvec3().normalize());
        match (out.pdf > 0.0, cell) {
            (true, Some(cell)) => counts.add(cell),
            _ => none += 1,
        }
    }
    let rest = 1.0 - sum;
    if rest < 3e-4 {
        assert!(none < N / 2000, "{record:?}: {none} samples without direction");
    } else {
        counts.push(none as f64, rest * N as f64);
    }
    check(&format!("{record:?} at cosine {mu}"), &counts);
}

#[test]
fn leaf_directions_have_their_density() {
    for (i, (weight, forward, g, mu)) in LEAF.into_iter().enumerate() {
        let record = Material { weight, forward, g, ..Material::default() };
        compare(700 + i, Lobe::new(MaterialKind::Leaf), record, mu);
    }
}

#[test]
fn petal_directions_have_their_density() {
    for (i, (weight, fuzz, roughness, ior, mu)) in PETAL.into_iter().enumerate() {
        let lobe = Lobe { fuzz, roughness, ior, ..Lobe::new(MaterialKind::Petal) };
        compare(750 + i, lobe, Material { weight, ..Material::default() }, mu);
    }
}

#[test]
fn sheets_give_directions_at_the_corners_of_the_unit_square() {
    let thin = Material { weight: 0.3, forward: 0.5, g: 0.6, sigma_s: 0.2, ..Material::default() };
    let thick = Material { sigma_a: [0.0, 1e3, 1e6], sigma_s: 1e3, g: -0.99, ..thin };
    let records =
        [thin, thick].map(|r| Material { thickness_edge: 1.0, thickness_middle: 1.0, ..r });
    for record in records {
        let bench = Bench::new().materials(&[record]);
        let mut kernel = bench.single();
        for kind in [MaterialKind::Leaf, MaterialKind::Petal] {
            for ior in [1.0, 1.0 + 1e-6, 1.4] {
                let lobe = Lobe { fuzz: 0.6, roughness: 0.01, ior, ..Lobe::new(kind) };
                for mu in [1.0, 0.5, 1e-2, 1e-4, 1e-6] {
                    let wo = lobe.at_cosine(mu).as_vec3();
                    for u in corners() {
                        for v in corners().map(|c| c.x) {
                            let out = sample_at(&mut kernel, &lobe, wo, u, v);
                            let at = format!("{lobe:?} {record:?} mu {mu} u {u} v {v}: {out:?}");
                            assert!((out.wi.length() - 1.0).abs() < 1e-6, "{at}");
                            assert!(out.pdf >= 0.0 && out.pdf.is_finite(), "{at}");
                            assert!(
                                out.weight.is_finite() && out.weight.min_element() >= 0.0,
                                "{at}"
                            );
                        }
                    }
                }
            }
        }
    }
}

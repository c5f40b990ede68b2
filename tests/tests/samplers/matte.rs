//! Directions of rough surfaces with gloss and of those that let light through.

use glam::DVec3;
use pack::abi::MaterialKind;
use tests::kernel::Lobe;
use tests::statistics::Counts;
use tests::statistics::grid::{Grid, Shape};

use crate::{N, check, key};

/// Kind, share of gloss, perceptual roughness, share that goes through, anisotropy, cosine.
const CASES: [(MaterialKind, f32, f32, f32, f32, f64); 9] = [
    (MaterialKind::Stone, 0.06, 0.4, 0.0, 0.0, 0.8),
    (MaterialKind::Stone, 0.06, 0.75, 0.0, 0.0, 0.1),
    (MaterialKind::Stone, 1.0, 0.55, 0.0, 0.0, 0.5),
    (MaterialKind::Wood, 0.04, 0.45, 0.0, 0.6, 0.6),
    (MaterialKind::Wood, 0.7, 0.65, 0.0, 1.0, 0.3),
    (MaterialKind::Wood, 1.0, 0.85, 0.0, 1.0, 0.9),
    (MaterialKind::Fabric, 0.04, 0.85, 0.2, 0.0, 0.7),
    (MaterialKind::Fabric, 0.0, 0.85, 1.0, 0.0, 0.4),
    (MaterialKind::Fabric, 0.5, 1.0, 0.5, 0.0, 0.05),
];

/// Chi-square tests here.
pub(crate) const CHECKS: usize = CASES.len();

/// Midpoints along each side of a cell.
const FINE: usize = 16;

#[test]
fn directions_of_rough_surfaces_have_their_density() {
    for (i, (kind, gloss, roughness, weight, anisotropy, mu)) in CASES.into_iter().enumerate() {
        let lobe = Lobe { gloss, roughness, weight, anisotropy, ..Lobe::new(kind) };
        let bench = lobe.bench();
        let (mut single, mut double) = (bench.single(), bench.double());
        let wo = lobe.at_cosine(mu);
        let mirror = lobe.mirror(wo);
        let grids = [lobe.normal, -lobe.normal].map(|up| Grid::new(up, mirror, Shape::HEMISPHERE));
        let truth = lobe.double();
        let shares: Vec<f64> = grids
            .iter()
            .flat_map(|grid| grid.integrate(FINE, |d| double.dispatch_eval(truth, wo, d).pdf))
            .collect();
        let rest = 1.0 - shares.iter().sum::<f64>();
        let mut counts = Counts::new(shares.iter().map(|share| share * N as f64).collect());
        let mut none = 0_usize;
        for k in 0..N {
            let out = single.dispatch_sample(lobe.single(), wo.as_vec3(), key(800 + i, k));
            if out.pdf <= 0.0 {
                none += 1;
                continue;
            }
            let d: DVec3 = out.wi.as_dvec3().normalize();
            let below = usize::from(d.dot(lobe.normal) < 0.0);
            let cell = grids[below].cell(d).expect("each grid is a half of the sphere");
            counts.add(below * grids[0].cells() + cell);
        }
        assert!(rest > -1e-3, "{lobe:?}: the density integrates to {}", 1.0 - rest);
        if rest < 3e-4 {
            assert!(none < N / 2000, "{lobe:?}: {none} samples without direction");
        } else {
            counts.push(none as f64, rest * N as f64);
        }
        check(&format!("{lobe:?} at cosine {mu}"), &counts);
    }
}

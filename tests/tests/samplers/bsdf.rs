//! Directions of the scattering models.

use glam::DVec3;
use pack::abi::MaterialKind;
use runtime::kernel::{f32 as single, f64 as double};
use tests::features::sample_at;
use tests::kernel::{Bench, Lobe};
use tests::layers::Layers;
use tests::statistics::grid::{Grid, Shape};
use tests::statistics::{Counts, binomial_z};

use crate::{N, check, corners, key};

/// Radii of the metal's ball.
const FUZZ: [f32; 6] = [0.01, 0.1, 0.3, 0.7, 0.999, 1.0];
/// Cosines of the incident direction for the metal.
const METAL_MU: [f64; 3] = [1.0, 0.6, 0.15];
/// Widths of the bare GGX lobe.
const ALPHA: [f32; 5] = [1e-3, 0.01, 0.1, 0.5, 1.0];
/// Cosines of the incident direction for the GGX lobe.
const GGX_MU: [f64; 4] = [1.0, 0.5, 0.1, 0.01];
/// Roughness, metallic, cosine.
const PRINCIPLED: [(f32, f32, f64); 8] = [
    (0.0, 0.0, 0.7),
    (0.1, 0.0, 0.9),
    (0.3, 0.0, 0.3),
    (0.3, 0.5, 0.6),
    (0.6, 0.0, 0.05),
    (0.6, 1.0, 0.5),
    (1.0, 0.0, 1.0),
    (1.0, 0.3, 0.1),
];
/// Roughness, metallic, layers, cosine.
const LAYERED: [(f32, f32, Layers, f64); 14] = [
    (0.3, 0.0, Layers { transmission: 1.0, ..Layers::PLAIN }, 0.6),
    (0.6, 0.3, Layers { transmission: 0.5, ..Layers::PLAIN }, 0.2),
    (1.0, 0.0, Layers { transmission: 1.0, ..Layers::PLAIN }, 0.9),
    (0.0, 0.0, Layers { coat: 1.0, coat_roughness: 0.3, transmission: 0.5, ..Layers::PLAIN }, 0.5),
    (0.5, 0.0, Layers { coat: 1.0, coat_roughness: 0.15, ..Layers::PLAIN }, 0.4),
    (0.2, 1.0, Layers { coat: 0.5, coat_roughness: 0.7, ..Layers::PLAIN }, 0.8),
    (0.4, 0.0, Layers { coat: 0.8, coat_roughness: 1.0, transmission: 0.7, ..Layers::PLAIN }, 0.1),
    (0.4, 0.2, Layers { specular: 0.3, tint: 20.0, ..Layers::PLAIN }, 0.5),
    (0.5, 0.0, Layers { sheen: 1.0, sheen_roughness: 0.3, ..Layers::PLAIN }, 0.15),
    (0.8, 1.0, Layers { sheen: 0.5, sheen_roughness: 1.0, ..Layers::PLAIN }, 0.7),
    (
        0.6,
        0.2,
        Layers { sheen: 1.0, sheen_roughness: 0.6, transmission: 0.5, ..Layers::PLAIN },
        0.5,
    ),
    (0.4, 0.0, Layers { anisotropy: 0.8, anisotropy_turn: 0.1, ..Layers::PLAIN }, 0.6),
    (0.8, 1.0, Layers { anisotropy: 1.0, anisotropy_turn: 0.8, ..Layers::PLAIN }, 0.2),
    (
        0.5,
        0.3,
        Layers {
            anisotropy: 0.5,
            coat: 0.7,
            coat_roughness: 0.4,
            transmission: 0.4,
            ..Layers::PLAIN
        },
        0.4,
    ),
];
/// Cosines of the incident direction for Lambert's model.
const DIFFUSE_MU: [f64; 2] = [1.0, 0.05];

/// Chi-square tests here.
pub(crate) const CHECKS: usize = FUZZ.len() * METAL_MU.len()
    + ALPHA.len() * GGX_MU.len()
    + PRINCIPLED.len()
    + LAYERED.len()
    + DIFFUSE_MU.len();

/// Midpoints along each side of a cell.
const FINE: usize = 16;

/// A sampler, its density in double precision, and the cells to compare them in.
pub(crate) struct Case<S, P> {
    pub(crate) name: String,
    pub(crate) grid: Grid,
    /// Normal of the surface: no direction below it.
    pub(crate) up: DVec3,
    /// Direction of sample `i`; `None` where the sampler gives none.
    pub(crate) sample: S,
    /// Density of direction `d` per steradian.
    pub(crate) pdf: P,
}

/// Compares and returns the share of samples without a direction that the density predicts.
pub(crate) fn compare<S, P>(mut case: Case<S, P>) -> f64
where
    S: FnMut(usize) -> Option<DVec3>,
    P: FnMut(DVec3) -> f64,
{
    let shares = case.grid.expect_above(FINE, case.up, &mut case.pdf);
    let sum: f64 = shares.iter().sum();
    assert!(sum < 1.001, "{}: the density integrates to {sum}", case.name);
    let rest = 1.0 - sum;
    let mut counts = Counts::new(shares.iter().map(|share| share * N as f64).collect());
    let mut none = 0;
    for i in 0..N {
        match (case.sample)(i) {
            Some(d) => match case.grid.cell(d) {
                Some(cell) => counts.add(cell),
                None => panic!("{}: a sample outside of its lobe: {d}", case.name),
            },
            None => none += 1,
        }
    }
    if rest < 3e-4 {
        // Quadrature error, or next to nothing: no cell of its own.
        assert!(none < N / 2000, "{}: {none} samples without direction", case.name);
    } else {
        counts.push(none as f64, rest * N as f64);
    }
    check(&case.name, &counts);
    rest
}

/// Compares what `dispatch_sample` does with `dispatch_pdf`.
fn compare_lobe(test: usize, lobe: Lobe, mu: f64, grid: Grid) -> f64 {
    let bench = Bench::new();
    let (mut single, mut double) = (bench.single(), bench.double());
    let wo = lobe.at_cosine(mu);
    let (scatter, truth) = (lobe.single(), lobe.double());
    compare(Case {
        name: format!("{lobe:?} at cosine {mu}"),
        grid,
        up: lobe.normal,
        sample: |i| {
            let out = single.dispatch_sample(scatter, wo.as_vec3(), key(test, i));
            (out.weight.x > 0.0 && out.pdf > 0.0).then(|| out.wi.as_dvec3().normalize())
        },
        pdf: |d| double.dispatch_eval(truth, wo, d).pdf,
    })
}

/// Cells for a lobe of width `alpha`: around its mirror direction where it is narrow, around the normal
/// where it reaches the horizon, which then is an edge of cells.
pub(crate) fn lobe_grid(mirror: DVec3, normal: DVec3, alpha: f64, mu: f64) -> Grid {
    if alpha > 0.2 {
        return Grid::new(normal, mirror, Shape::HEMISPHERE);
    }
    let ring_scale = (alpha * mu.max(0.05)).min(1.0);
    let shape = Shape { ring_scale, sector_scale: mu.clamp(0.02, 1.0), ..Shape::SPHERE };
    Grid::new(mirror, normal, shape)
}

#[test]
fn diffuse_directions_have_their_density() {
    for (i, mu) in DIFFUSE_MU.into_iter().enumerate() {
        let lobe = Lobe::diffuse();
        let grid = Grid::new(lobe.normal, DVec3::X, Shape::HEMISPHERE);
        let rest = compare_lobe(100 + i, lobe, mu, grid);
        assert!(rest.abs() < 1e-4, "{rest}");
    }
}

/// A density that is 5 % off in its exponent must not pass: the test has teeth.
#[test]
fn a_slightly_wrong_density_is_caught() {
    let bench = Bench::new();
    let mut kernel = bench.single();
    let lobe = Lobe::diffuse();
    let grid = Grid::new(lobe.normal, DVec3::X, Shape::HEMISPHERE);
    let e = 1.05;
    let expected = grid.integrate(FINE, |d| {
        N as f64 * d.dot(lobe.normal).powf(e) * (e + 1.0) / (2.0 * std::f64::consts::PI)
    });
    let mut counts = Counts::new(expected);
    for i in 0..N {
        let out = kernel.dispatch_sample(lobe.single(), lobe.normal.as_vec3(), key(99, i));
        counts.add(grid.cell(out.wi.as_dvec3().normalize()).expect("above the surface"));
    }
    assert!(counts.p_value() < 1e-9);
}

#[test]
fn metal_directions_have_their_density() {
    for (i, fuzz) in FUZZ.into_iter().enumerate() {
        for (j, mu) in METAL_MU.into_iter().enumerate() {
            let lobe = Lobe::metal(fuzz);
            let a = f64::from(fuzz);
            let reach = if a < 1.0 { a.asin() } else { std::f64::consts::FRAC_PI_2 };
            let shape = Shape { reach, ring_scale: reach, ..Shape::SPHERE };
            let wo = lobe.at_cosine(mu);
            let grid = Grid::new(lobe.mirror(wo), lobe.normal, shape);
            let rest = compare_lobe(200 + 10 * i + j, lobe, mu, grid);
            let t = (mu / a).min(1.0);
            let lost = 0.5 - 0.75 * t + 0.25 * t * t * t;
            assert!((rest - lost).abs() < 1e-3, "{fuzz} {mu}: {rest} is lost, not {lost}");
        }
    }
}

#[test]
fn ggx_directions_have_their_density() {
    let bench = Bench::new();
    let (mut single, mut double) = (bench.single(), bench.double());
    for (i, alpha) in ALPHA.into_iter().enumerate() {
        for (j, mu) in GGX_MU.into_iter().enumerate() {
            let test = 300 + 10 * i + j;
            let lobe = Lobe { normal: DVec3::Z, ..Lobe::principled(alpha.sqrt(), 1.0) };
            let wo = lobe.at_cosine(mu);
            let mirror = lobe.mirror(wo);
            let a = f64::from(alpha);
            let rest = compare(Case {
                name: format!("ggx alpha {alpha} at cosine {mu}"),
                grid: lobe_grid(mirror, DVec3::Z, a, mu),
                up: DVec3::Z,
                sample: |i| {
                    let u = single.sample_2d(key(test, i), single::PURPOSE_DIRECTION);
                    let wi = single.ggx_sample(wo.as_vec3(), alpha, u);
                    (wi.z > 0.0).then(|| wi.as_dvec3().normalize())
                },
                pdf: |d| double.ggx_pdf(wo, d, a),
            });
            // The bound of the cap is exact at normal incidence.
            assert!(mu < 1.0 || rest.abs() < 5e-4, "alpha {alpha}: {rest} below the surface");
        }
    }
}

#[test]
fn principled_directions_have_their_density() {
    for (i, (roughness, metallic, mu)) in PRINCIPLED.into_iter().enumerate() {
        let lobe = Lobe::principled(roughness, metallic);
        let alpha = f64::from(roughness * roughness);
        let smooth = alpha < 1e-3;
        let wo = lobe.at_cosine(mu);
        let grid = if smooth {
            Grid::new(lobe.normal, DVec3::X, Shape::HEMISPHERE)
        } else {
            lobe_grid(lobe.mirror(wo), lobe.normal, alpha, mu)
        };
        let rest = compare_lobe(400 + i, lobe, mu, grid);
        assert!(!smooth || rest > 0.09, "the mirror has a share of its own, not {rest}");
    }
}

/// Both sides of the surface have their cells, those of the far side mirrored.
#[test]
fn layered_directions_have_their_density() {
    for (i, (roughness, metallic, layers, mu)) in LAYERED.into_iter().enumerate() {
        let lobe = Lobe::principled(roughness, metallic);
        let bench = Bench::new().materials(&[layers.into()]);
        let (mut single, mut double) = (bench.single(), bench.double());
        let wo = lobe.at_cosine(mu);
        let (scatter, truth) = (lobe.single(), lobe.double());
        let widths = [roughness, if layers.coat > 0.0 { layers.coat_roughness } else { 1.0 }];
        let narrow = widths.map(|r| f64::from(r * r)).into_iter().filter(|a| *a >= 1e-3);
        let alpha = narrow.fold(1.0, f64::min) * (1.0 - 0.69 * f64::from(layers.anisotropy));
        let grid = lobe_grid(lobe.mirror(wo), lobe.normal, alpha, mu);
        let across = |d: DVec3| (d - lobe.normal * (2.0 * d.dot(lobe.normal))).normalize();
        let mut shares =
            grid.expect_above(FINE, lobe.normal, |d| double.dispatch_eval(truth, wo, d).pdf);
        let far = |d| double.dispatch_eval(truth, wo, across(d)).pdf;
        shares.extend(grid.expect_above(FINE, lobe.normal, far));
        let sum: f64 = shares.iter().sum();
        assert!(sum < 1.001, "{layers:?}: the density integrates to {sum}");
        let mut counts = Counts::new(shares.iter().map(|share| share * N as f64).collect());
        let mut none = 0;
        for k in 0..N {
            let out = single.dispatch_sample(scatter, wo.as_vec3(), key(800 + i, k));
            let d = out.wi.as_dvec3().normalize();
            let (d, first) =
                if d.dot(lobe.normal) < 0.0 { (across(d), grid.cells()) } else { (d, 0) };
            if out.pdf > 0.0 && out.weight.x > 0.0 {
                counts.add(first + grid.cell(d).expect("the cells reach everywhere"));
            } else {
                none += 1;
            }
        }
        if 1.0 - sum > 3e-4 {
            counts.push(f64::from(none), (1.0 - sum) * N as f64);
        } else {
            assert!(none < 500, "{layers:?}: {none} samples without direction");
        }
        check(&format!("{lobe:?} {layers:?} at cosine {mu}"), &counts);
    }
}

/// Reflection is chosen with Fresnel's probability, and both lobes are deltas.
#[test]
fn dielectric_chooses_by_fresnel() {
    let bench = Bench::new();
    let (mut single, mut double) = (bench.single(), bench.double());
    for (i, (ior, front, mu)) in
        [(1.5, true, 0.2), (1.5, false, 0.8), (1.33, true, 1.0), (2.4, true, 0.05)]
            .into_iter()
            .enumerate()
    {
        let lobe = Lobe { ior, front, ..Lobe::new(MaterialKind::Dielectric) };
        let wo = lobe.at_cosine(mu);
        let eta = if front { ior } else { 1.0 / ior };
        let share = double.fresnel_dielectric(lobe.normal.dot(wo), eta, eta - 1.0);
        let (mut reflected, n) = (0, N / 4);
        for k in 0..n {
            let out = single.dispatch_sample(lobe.single(), wo.as_vec3(), key(500 + i, k));
            assert_eq!(out.pdf, 0.0);
            reflected += usize::from(out.wi.as_dvec3().dot(lobe.normal) > 0.0);
        }
        let z = binomial_z(reflected, n, share);
        assert!(z.abs() < 4.5, "ior {ior}: {reflected} of {n}, not {share}: z = {z}");
    }
}

fn lobes() -> Vec<Lobe> {
    let mut lobes = vec![
        Lobe::diffuse(),
        Lobe::new(MaterialKind::Emissive),
        Lobe::new(MaterialKind::Dielectric),
        Lobe { front: false, ..Lobe::new(MaterialKind::Dielectric) },
    ];
    lobes.extend([0.0, 1e-4, 1e-3, 0.5, 0.999, 1.0].map(Lobe::metal));
    for roughness in [0.0, 1e-2, 0.0317, 0.3, 1.0] {
        lobes.extend([0.0, 0.5, 1.0].map(|metallic| Lobe::principled(roughness, metallic)));
    }
    let turned = lobes.clone().into_iter().map(|lobe| Lobe { normal: DVec3::NEG_Z, ..lobe });
    lobes.extend(turned.collect::<Vec<_>>());
    lobes
}

#[test]
fn the_corners_of_the_unit_square_give_directions() {
    let bench = Bench::new();
    let mut kernel = bench.single();
    for lobe in lobes() {
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

/// The density that a sample carries is the one that the other side of the balance heuristic computes.
#[test]
fn a_sample_carries_the_density_of_its_direction() {
    let bench = Bench::new();
    let mut kernel = bench.single();
    for (i, lobe) in lobes().into_iter().enumerate() {
        for mu in [1.0, 0.5, 0.1, 0.01] {
            let wo = lobe.at_cosine(mu).as_vec3();
            for k in 0..2000 {
                let out = kernel.dispatch_sample(lobe.single(), wo, key(600 + i, k));
                if out.pdf > 0.0 {
                    let pdf = kernel.dispatch_eval(lobe.single(), wo, out.wi).pdf;
                    let off = (pdf / out.pdf - 1.0).abs();
                    assert!(off < 1e-4, "{lobe:?} mu {mu}: {} and {pdf}", out.pdf);
                }
            }
        }
    }
}

/// Densities in single precision against double precision at the same directions.
#[test]
fn densities_are_those_of_double_precision() {
    let bench = Bench::new();
    let (mut single, mut double) = (bench.single(), bench.double());
    for (i, lobe) in lobes().into_iter().enumerate() {
        for mu in [1.0, 0.5, 0.1] {
            let wo = lobe.at_cosine(mu).as_vec3();
            let mut worst: f64 = 0.0;
            for k in 0..2000 {
                let out = single.dispatch_sample(lobe.single(), wo, key(700 + i, k));
                let up = out.wi.as_dvec3().dot(lobe.normal);
                // At the horizon the density goes to 0 linearly.
                if out.pdf > 0.0 && up > 0.01 {
                    let (o, d) = (wo.as_dvec3().normalize(), out.wi.as_dvec3().normalize());
                    let truth = double.dispatch_eval(lobe.double(), o, d).pdf;
                    let off = (f64::from(out.pdf) / truth - 1.0).abs();
                    worst = worst.max(off / (2e-5 + rounding(&lobe, o, d)));
                }
            }
            assert!(worst < 1.0, "{lobe:?} mu {mu}: {worst:.2} times its bound");
        }
    }
}

/// What rounding a direction does to the density of `lobe`, relative.
fn rounding(lobe: &Lobe, wo: DVec3, wi: DVec3) -> f64 {
    match lobe.kind {
        // Worst where the lobe is as narrow as the rounding allows: 2^-23 over the width, squared by the
        // lobe and by grazing.
        MaterialKind::Principled => {
            let width = (lobe.roughness * lobe.roughness).max(1e-3);
            4e-6 / f64::from(width)
        }
        // The density goes to 0 at the rim of the ball as the root of a² - s², s the sine from the mirror
        // direction: an error e of the sine is one of e s / (a² - s²). Both directions and the mirrored one
        // are rounded: e = 3 · 2^-24.
        MaterialKind::Metal => {
            let a2 = f64::from(lobe.fuzz).powi(2);
            let s2 = wi.cross(lobe.mirror(wo)).length_squared();
            3.0 * 0.5f64.powi(24) * s2.sqrt() / (a2 - s2).max(0.0)
        }
        _ => 4e-6,
    }
}

/// The normals of GGX, projected, fill the unit disc: integral of D cos = 1.
#[test]
fn ggx_normals_are_normalised() {
    let bench = Bench::new();
    let mut kernel: double::Kernel<'_> = bench.double();
    for alpha in [1e-3, 0.01, 0.1, 0.3, 0.5, 0.8, 1.0] {
        let grid = Grid::new(DVec3::Z, DVec3::X, Shape { ring_scale: alpha, ..Shape::HEMISPHERE });
        let area: f64 = grid.integrate(FINE, |h| kernel.ggx_normals(h, alpha) * h.z).iter().sum();
        assert!((area - 1.0).abs() < 1e-4, "alpha {alpha}: {area}");
    }
}

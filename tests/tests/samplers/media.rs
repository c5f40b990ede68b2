//! Directions and free paths in media.

use std::f64::consts::PI;

use glam::{DVec3, Vec2, Vec3};
use pack::abi::Medium;
use runtime::kernel::f32 as single;
use tests::kernel::Bench;
use tests::statistics::grid::{Grid, Shape};
use tests::statistics::stream::Stream;
use tests::statistics::{Counts, Mean, index};

use crate::{N, check, corners, key};

/// The phase function draws no numbers of its own.
const UNUSED_KEY: runtime::kernel::f64::SampleKey =
    runtime::kernel::f64::SampleKey { pixel: 0, sample: 0, bounce: 0, seed: 0 };

/// Mean cosines.
const G: [f32; 11] = [-0.95, -0.6, -0.1, -1e-4, 0.0, 1e-6, 1e-2, 0.3, 0.6, 0.9, 0.99];
/// Extinctions of grey media, per unit of length.
const SIGMA: [f32; 3] = [0.3, 7.0, 4000.0];

/// Chi-square tests here.
pub(crate) const CHECKS: usize = G.len() + SIGMA.len();

/// Directions of travel, none special.
const WO: DVec3 = DVec3::new(0.36, -0.48, 0.8);

fn medium(g: f32) -> Medium {
    Medium { g, ..Medium::default() }
}

#[test]
fn scattered_directions_have_their_density() {
    for (i, g) in G.into_iter().enumerate() {
        let bench = Bench::new().media(&[medium(g)]);
        let (mut single, mut double) = (bench.single(), bench.double());
        let (scatter, truth) =
            (single.phase_scatter(0, key(0, 0)), double.phase_scatter(0, UNUSED_KEY));
        let likely = if g < 0.0 { WO } else { -WO };
        let ring_scale = (1.0 - f64::from(g.abs())).max(0.01) * PI;
        let grid = Grid::new(likely, DVec3::X, Shape { ring_scale, ..Shape::SPHERE });
        let shares = grid.integrate(16, |d| double.dispatch_eval(truth, WO, d).pdf);
        let sum: f64 = shares.iter().sum();
        assert!((sum - 1.0).abs() < 1e-3, "g {g}: the density integrates to {sum}");
        let mut counts = Counts::new(shares.iter().map(|share| share * N as f64).collect());
        let mut cosine = Mean::default();
        for sample in 0..N {
            let out = single.dispatch_sample(scatter, WO.as_vec3(), key(300 + i, sample));
            let d = out.wi.as_dvec3();
            assert!((d.length() - 1.0).abs() < 3e-7 && out.weight == Vec3::ONE, "g {g}: {d}");
            let pdf = single.dispatch_eval(scatter, WO.as_vec3(), out.wi).pdf;
            assert_eq!(out.pdf, pdf, "g {g}");
            let f = single.dispatch_eval(scatter, WO.as_vec3(), out.wi).f;
            assert_eq!(f, Vec3::splat(pdf), "g {g}");
            cosine.add(-d.dot(WO));
            counts.add(grid.cell(d.normalize()).expect("the grid is a whole sphere"));
        }
        check(&format!("phase function of g {g}"), &counts);
        let z = (cosine.value() - f64::from(g)) / cosine.error();
        assert!(z.abs() < 4.5, "g {g}: mean cosine {} z {z:.1}", cosine.value());
    }
}

#[test]
fn extreme_mean_cosines_are_finite_and_close_to_their_limits() {
    for g in [-1.0, -0.999_999_9, -0.999, 0.999, 0.999_99, 1.0_f32] {
        let bench = Bench::new().media(&[medium(g)]);
        let mut kernel = bench.single();
        let scatter = kernel.phase_scatter(0, key(0, 0));
        for u in corners() {
            let out = kernel.phase_sample(scatter, WO.as_vec3(), u);
            assert!((out.wi.length() - 1.0).abs() < 3e-7 && out.pdf.is_finite(), "{g}, {u}");
            if g.abs() > 0.999_999 {
                assert_eq!((out.wi, out.pdf), (-WO.as_vec3() * g.signum(), 0.0), "{g}");
                assert_eq!(kernel.phase_eval(scatter, WO.as_vec3(), out.wi).f, Vec3::ZERO);
            }
        }
    }
}

/// The density in double precision is the formula of Henyey and Greenstein as it stands in the paper.
#[test]
fn the_phase_function_is_that_of_the_paper() {
    let mut stream = Stream::new(31, 0);
    for g in G {
        let bench = Bench::new().media(&[medium(g)]);
        let (mut single, mut double) = (bench.single(), bench.double());
        let (scatter, truth) =
            (single.phase_scatter(0, key(0, 0)), double.phase_scatter(0, UNUSED_KEY));
        for _ in 0..20_000 {
            let d = stream.direction();
            let (g, c) = (f64::from(g), -d.dot(WO));
            let paper = (1.0 - g * g) / (4.0 * PI * (1.0 + g * g - 2.0 * g * c).powf(1.5));
            let ours = double.phase_eval(truth, WO, d).pdf;
            assert!((ours / paper - 1.0).abs() < 1e-6, "g {g}, cosine {c}: {ours} {paper}");
            let ours = f64::from(single.phase_eval(scatter, WO.as_vec3(), d.as_vec3()).pdf);
            assert!((ours / paper - 1.0).abs() < 2e-5, "g {g}, cosine {c}: {ours} {paper}");
        }
    }
}

fn grey(sigma_t: f32, albedo: f32) -> single::Medium {
    let sigma_s = sigma_t * albedo;
    single::Medium {
        sigma_a: Vec3::splat(sigma_t - sigma_s),
        g: 0.0,
        sigma_s: Vec3::splat(sigma_s),
        reach: 1e20,
        color: Vec3::ZERO,
        receives: 0,
    }
}

/// What a segment ends with: weight, free path, and whether the medium scatters before `t_max`.
struct Step {
    weight: Vec3,
    t: f32,
    scatters: bool,
}

fn step(
    kernel: &mut single::Kernel<'_>,
    medium: single::Medium,
    throughput: Vec3,
    t_max: f32,
    u: Vec2,
) -> Step {
    let t = kernel.homogeneous_free_path(medium, throughput, u);
    let weight = kernel.homogeneous_weight(medium, throughput, t, t_max);
    Step { weight, t, scatters: t < t_max }
}

#[test]
fn free_paths_in_grey_media_are_exponential_and_weigh_the_albedo() {
    let bench = Bench::new();
    let mut kernel = bench.single();
    for (i, sigma) in SIGMA.into_iter().enumerate() {
        // Half of the light passes: the segment ends in the last cell.
        let t_max = std::f32::consts::LN_2 / sigma;
        let mut counts = Counts::new(vec![0.5 * N as f64 / 64.0; 64]);
        let mut passed = 0_usize;
        for sample in 0..N {
            let u = kernel.sample_2d(key(320 + i, sample), single::PURPOSE_DISTANCE);
            let step = step(&mut kernel, grey(sigma, 0.5), Vec3::ONE, t_max, u);
            assert!(step.t >= 0.0);
            if step.scatters {
                assert_eq!(step.weight, Vec3::splat(0.5), "one-sample identity");
                // The share of scattering before t, over that before the end.
                let share = 2.0 * (1.0 - (-f64::from(sigma) * f64::from(step.t)).exp());
                counts.add(index(share, 64));
            } else {
                assert_eq!(step.weight, Vec3::ONE);
                passed += 1;
            }
        }
        counts.push(passed as f64, 0.5 * N as f64);
        check(&format!("free paths at {sigma}"), &counts);
    }
}

/// Coloured media: the mean weight of passing is Beer-Lambert's in every channel, that of scattering
/// the rest times the albedo, and no weight is large.
#[test]
fn coloured_media_pass_and_scatter_what_they_should() {
    let media = [
        ([0.01, 0.1, 1.0], [1.0, 2.0, 4.0], [1.0, 1.0, 1.0], 1.0),
        ([0.0, 0.0, 0.0], [0.1, 1.0, 10.0], [1.0, 1.0, 1.0], 0.7),
        ([0.0, 0.5, 0.0], [3.0, 0.0, 0.0], [1.0, 1.0, 0.3], 0.5),
        ([0.2, 0.2, 0.2], [5.0, 0.1, 0.0], [0.01, 1.0, 0.5], 2.0),
    ];
    let bench = Bench::new();
    let mut kernel = bench.single();
    for (i, (sigma_a, sigma_s, throughput, t)) in media.into_iter().enumerate() {
        let (a, s, w) = (Vec3::from(sigma_a), Vec3::from(sigma_s), Vec3::from(throughput));
        let medium = single::Medium { sigma_a: a, sigma_s: s, ..grey(0.0, 0.0) };
        let mut sums = [[Mean::default(); 3]; 2];
        for sample in 0..N / 2 {
            let u = kernel.sample_2d(key(340 + i, sample), single::PURPOSE_DISTANCE);
            let step = step(&mut kernel, medium, w, t, u);
            for k in 0..3 {
                let value = f64::from(step.weight[k]);
                assert!(value.is_finite() && value * f64::from(w[k]) < 60.0, "{value}");
                sums[0][k].add(if step.scatters { 0.0 } else { value });
                sums[1][k].add(if step.scatters { value } else { 0.0 });
            }
        }
        for k in 0..3 {
            let sigma_t = f64::from(a[k] + s[k]);
            let pass = (-sigma_t * f64::from(t)).exp();
            let albedo = if sigma_t > 0.0 { f64::from(s[k]) / sigma_t } else { 0.0 };
            for (sum, truth) in [(&sums[0][k], pass), (&sums[1][k], (1.0 - pass) * albedo)] {
                let off = (sum.value() - truth).abs();
                let (mean, error) = (sum.value(), sum.error());
                assert!(
                    off <= 4.5 * error + 1e-6,
                    "medium {i}, {k}: {mean} +- {error}, not {truth}"
                );
            }
        }
    }
}

#[test]
fn clear_and_dense_media_have_no_surprises() {
    let bench = Bench::new();
    let mut kernel = bench.single();
    let clear = kernel.beer_transmittance(Vec3::ZERO);
    assert_eq!(clear, Vec3::ONE);
    assert_eq!(kernel.beer_absorptance(Vec3::ZERO, clear), Vec3::ZERO);
    assert_eq!(kernel.beer_transmittance(Vec3::splat(1e26)), Vec3::ZERO);
    for x in [1e-8_f64, 1e-6, 1e-3, 0.009_9, 0.010_1, 0.5, 90.0] {
        let left = kernel.beer_transmittance(Vec3::splat(x as f32));
        let loss = kernel.beer_absorptance(Vec3::splat(x as f32), left);
        let truth = -(-f64::from(x as f32)).exp_m1();
        assert!((f64::from(loss.x) / truth - 1.0).abs() < 7e-6, "{x}: {} {truth}", loss.x);
    }
    for u in corners() {
        for sigma in [1e-6, 1.0, 1e6] {
            let step = step(&mut kernel, grey(sigma, 0.5), Vec3::ONE, 1e20, u);
            assert!(step.t >= 0.0 && step.weight.is_finite(), "{sigma}, {u}");
        }
    }
    let double = bench.double().beer_depth(0.3);
    assert!((double - 0.7_f64.recip().ln()).abs() < 1e-7, "{double}");
}

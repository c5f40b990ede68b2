//! Thin sheets: what they reflect and let through, against closed forms.

use glam::DVec3;
use pack::abi::{Material, MaterialKind};
use tests::kernel::{Bench, Lobe};
use tests::statistics::Mean;
use tests::statistics::grid::{Grid, Shape};
use tests::statistics::stream::Stream;

use crate::weight::key;

/// A petal without absorption, of scattering depth `depth` across.
fn petal(weight: f32, depth: f32, g: f32) -> Material {
    let (thickness_edge, thickness_middle) = (1.0, 1.0);
    Material { weight, g, sigma_s: depth, thickness_edge, thickness_middle, ..Material::default() }
}

/// Share that a ball of radius `a` around a mirror direction at cosine `mu` leaves above the horizon.
fn ball(a: f64, mu: f64) -> f64 {
    let t = (mu / a).min(1.0);
    0.5 + 0.75 * t - 0.25 * t * t * t
}

/// Reflected and transmitted share of `n` samples.
fn shares(lobe: &Lobe, record: Material, mu: f64, test: usize, n: usize) -> [Mean; 2] {
    let bench = Bench::new().materials(&[record]);
    let mut kernel = bench.single();
    let wo = lobe.at_cosine(mu).as_vec3();
    let mut means = [Mean::default(), Mean::default()];
    for i in 0..n {
        let key = key(test, i);
        let scatter = runtime::kernel::f32::Scatter { key, ..lobe.single() };
        let out = kernel.dispatch_sample(scatter, wo, key);
        let above = out.wi.dot(scatter.ns) > 0.0;
        let weight = f64::from(out.weight.x);
        means[0].add(if above { weight } else { 0.0 });
        means[1].add(if above { 0.0 } else { weight });
    }
    means
}

#[test]
fn a_leaf_never_gives_more_than_it_gets() {
    for (weight, forward, g) in
        [(0.0, 0.5, 0.6), (0.3, 0.0, 0.6), (0.5, 0.5, 0.6), (1.0, 1.0, 0.95), (1.0, 1.0, -0.9)]
    {
        let bench =
            Bench::new().materials(&[Material { weight, forward, g, ..Material::default() }]);
        let mut kernel = bench.double();
        let lobe = Lobe::new(MaterialKind::Leaf);
        for mu in [1.0, 0.6, 0.2, 0.03] {
            let wo = lobe.at_cosine(mu);
            let s = lobe.double();
            let grid = Grid::new(-wo, lobe.normal, Shape::SPHERE);
            let mut sums = [0.0; 2];
            let cells = grid.integrate(32, |wi| kernel.dispatch_eval(s, wo, wi).x);
            sums[0] += cells.iter().sum::<f64>();
            let above =
                grid.integrate_above(32, lobe.normal, |wi| kernel.dispatch_eval(s, wo, wi).x);
            sums[1] += above.iter().sum::<f64>();
            let reflected = 1.0 - f64::from(weight);
            assert!((sums[1] - reflected).abs() < 2e-3, "{weight} {mu}: {sums:?}");
            assert!(sums[0] < 1.0 + 2e-3, "{weight} {forward} {g} at {mu}: {sums:?}");
            if forward == 0.0 {
                assert!((sums[0] - 1.0).abs() < 2e-3, "{sums:?}");
            }
        }
    }
}

#[test]
fn a_leaf_is_reciprocal_on_both_sides() {
    let record = Material { weight: 0.4, forward: 0.7, g: 0.6, ..Material::default() };
    let bench = Bench::new().materials(&[record]);
    let mut kernel = bench.double();
    let front = Lobe::new(MaterialKind::Leaf);
    let back = Lobe { normal: -front.normal, ..front };
    let mut stream = Stream::new(43, 0);
    for _ in 0..4000 {
        let (a, b) = (stream.direction(), stream.direction());
        let side = |d: DVec3| if d.dot(front.normal) > 0.0 { front } else { back };
        let there = kernel.dispatch_eval(side(a).double(), a, b).x / b.dot(front.normal).abs();
        let here = kernel.dispatch_eval(side(b).double(), b, a).x / a.dot(front.normal).abs();
        assert!((there / here - 1.0).abs() < 1e-8, "{a} {b}: {there} {here}");
    }
}

/// Share of the light at cosine `mu` that comes back unscattered, off the near side or the far side.
fn skin(lobe: &Lobe, record: Material, mu: f64) -> f64 {
    let bench = Bench::new().materials(&[record]);
    let mut kernel = bench.double();
    let slab = kernel.petal_slab(lobe.double());
    let f = kernel.fresnel_dielectric(mu, lobe.ior, lobe.ior - 1.0);
    f + (1.0 - f) * kernel.slab_passage(slab, mu).back.x
}

/// A white petal that absorbs nothing gives everything back but what fuzz and wax lose at the horizon.
#[test]
fn a_white_petal_keeps_its_energy() {
    for (i, (weight, depth, g, ior)) in [
        (0.15, 0.21, 0.7, 1.4),
        (0.15, 0.018, 0.7, 1.4),
        (0.0, 3.0, 0.0, 1.4),
        (0.3, 1.0, -0.8, 2.0),
        (0.0, 10.0, 0.8, 1.0),
    ]
    .into_iter()
    .enumerate()
    {
        for (j, mu) in [1.0, 0.5, 0.1].into_iter().enumerate() {
            let lobe = Lobe { fuzz: 0.65, roughness: 0.2, ior, ..Lobe::new(MaterialKind::Petal) };
            let means = shares(&lobe, petal(weight, depth, g), mu, 400 + 10 * i + j, 60_000);
            let skin = skin(&lobe, petal(weight, depth, g), mu);
            let q = f64::from(weight);
            let truth = q * ball(0.65, mu) + (1.0 - q) * (skin * ball(0.2, mu) + 1.0 - skin);
            let sum = means[0].value() + means[1].value();
            let se = means[0].error().hypot(means[1].error());
            assert!((sum - truth).abs() < 4.0 * se, "{i} {mu}: {sum} +- {se}, not {truth}");
            assert!(se < 0.02, "{i} {mu}: {se}");
        }
    }
}

/// A thick slab without an interface is a half space: 1 - H(mu) sqrt(1 - albedo), Chandrasekhar 1950.
#[test]
fn a_thick_petal_reflects_as_a_half_space() {
    for (j, (mu, truth)) in
        [(1.0, 0.414_947), (0.5, 0.507_939), (0.1, 0.629_336)].into_iter().enumerate()
    {
        let lobe = Lobe { fuzz: 0.5, ior: 1.0, ..Lobe::new(MaterialKind::Petal) };
        let record = Material { sigma_a: [6.0; 3], ..petal(0.0, 54.0, 0.0) };
        let [reflected, transmitted] = shares(&lobe, record, mu, 500 + j, 60_000);
        let (value, se) = (reflected.value(), reflected.error());
        assert!((value - truth).abs() < 4.0 * se, "at {mu}: {value} +- {se}, not {truth}");
        assert!(se < 0.01 && transmitted.value() < 1e-3, "{se}");
    }
}

/// A slab that only absorbs: e^(-tau / mu) goes through, nothing else comes out.
#[test]
fn an_absorbing_petal_follows_lambert_and_beer() {
    for (mu, tau) in [(1.0, 0.5), (0.5, 0.5), (0.2, 3.0)] {
        let lobe = Lobe { fuzz: 0.5, ior: 1.0, ..Lobe::new(MaterialKind::Petal) };
        let record = Material { sigma_a: [tau; 3], ..petal(0.0, 0.0, 0.0) };
        let [reflected, transmitted] = shares(&lobe, record, mu, 520, 4000);
        let truth = (-f64::from(tau) / lobe.normal.dot(lobe.at_cosine(mu))).exp();
        assert!(reflected.value() < 1e-12);
        let off = (transmitted.value() - truth).abs();
        assert!(off < 4.0 * transmitted.error() + 1e-5, "at {mu}: {off}");
    }
}

/// The walk joins both directions the same way round, in the mean.
#[test]
fn a_slab_is_reciprocal_in_the_mean() {
    let lobe = Lobe { fuzz: 0.5, roughness: 0.2, ior: 1.4, ..Lobe::new(MaterialKind::Petal) };
    let record = Material { sigma_a: [0.1, 0.4, 0.9], ..petal(0.0, 2.0, 0.6) };
    let bench = Bench::new().materials(&[record]);
    let mut kernel = bench.single();
    let mut stream = Stream::new(47, 0);
    for pair in 0..6 {
        let (a, b) = (stream.direction(), stream.direction());
        let mut means = [Mean::default(), Mean::default()];
        for i in 0..60_000 {
            for (k, (from, to)) in [(a, b), (b, a)].into_iter().enumerate() {
                let side = from.dot(lobe.normal).signum();
                let lobe = Lobe { normal: lobe.normal * side, ..lobe };
                let scatter = runtime::kernel::f32::Scatter {
                    key: key(600 + 2 * pair + k, i),
                    ..lobe.single()
                };
                let slab = kernel.petal_slab(scatter);
                let basis = kernel.basis_around(-scatter.ns);
                let o = kernel.basis_local_from_world(basis, from.as_vec3());
                let t = kernel.basis_local_from_world(basis, to.as_vec3());
                let f = kernel.slab_scattered(slab, o, t, scatter.key);
                // The first crossing of the side, which `slab_scattered` leaves to its caller.
                let enter = 1.0 - kernel.petal_fresnel(scatter, from.as_vec3());
                means[k].add(f64::from(f.y * enter / t.z.abs()));
            }
        }
        let [x, y] = means;
        let off = (x.value() - y.value()).abs();
        assert!(off < 4.0 * x.error().hypot(y.error()), "{a} {b}: {} {}", x.value(), y.value());
        assert!(x.error() < 0.05 * x.value(), "{a} {b}");
    }
}

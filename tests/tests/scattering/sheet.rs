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
fn a_white_leaf_gives_all_it_gets() {
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
            let cells = grid.integrate(32, |wi| kernel.dispatch_eval(s, wo, wi).f.x);
            sums[0] += cells.iter().sum::<f64>();
            let above =
                grid.integrate_above(32, lobe.normal, |wi| kernel.dispatch_eval(s, wo, wi).f.x);
            sums[1] += above.iter().sum::<f64>();
            let reflected = 1.0 - f64::from(weight);
            assert!((sums[1] - reflected).abs() < 2e-3, "{weight} {mu}: {sums:?}");
            assert!((sums[0] - 1.0).abs() < 0.015, "{weight} {forward} {g} at {mu}: {sums:?}");
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
        let there = kernel.dispatch_eval(side(a).double(), a, b).f.x / b.dot(front.normal).abs();
        let here = kernel.dispatch_eval(side(b).double(), b, a).f.x / a.dot(front.normal).abs();
        assert!((there / here - 1.0).abs() < 1e-8, "{a} {b}: {there} {here}");
    }
}

/// A white petal that absorbs nothing gives everything back, whatever the numbers are: each sample weighs 1.
#[test]
fn a_white_petal_keeps_its_energy() {
    let skins = [(0.15, 0.65, 0.2), (0.0, 0.03, 0.03), (1.0, 1.0, 1.0), (0.4, 0.3, 1.0)];
    let slabs = [(0.21, 0.7), (0.018, 0.7), (3.0, 0.0), (1.0, -0.8), (10.0, 0.8), (0.0, 0.0)];
    for (i, (weight, fuzz, roughness)) in skins.into_iter().enumerate() {
        for (j, (depth, g)) in slabs.into_iter().enumerate() {
            for (k, ior) in [1.0, 1.05, 1.4, 3.0].into_iter().enumerate() {
                let lobe = Lobe { fuzz, roughness, ior, ..Lobe::new(MaterialKind::Petal) };
                for (l, mu) in [1.0, 0.5, 0.1, 0.02].into_iter().enumerate() {
                    let test = 1000 + 4 * (4 * (6 * i + j) + k) + l;
                    let means = shares(&lobe, petal(weight, depth, g), mu, test, 500);
                    let sum = means[0].value() + means[1].value();
                    assert!((sum - 1.0).abs() < 2e-3, "{lobe:?} {depth} {g} at {mu}: {sum}");
                }
            }
        }
    }
}

/// The bands of directions that a mean is taken over: by the cosine with the normal, and by the side.
fn band(lobe: &Lobe, wo: DVec3, wi: DVec3) -> usize {
    let up = wi.dot(lobe.normal);
    let ahead = (wi + wo).dot(wo - lobe.normal * wo.dot(lobe.normal)) < 0.0;
    usize::from(up > 0.0) * 4 + usize::from(up.abs() > 0.5) * 2 + usize::from(ahead)
}

/// What the walk out of the slab brings is what `petal_eval` says, band by band.
#[test]
fn a_petals_samples_bring_what_its_value_says() {
    for (test, (depth, g, ior, sigma_a, mu)) in [
        (0.21, 0.7, 1.4, [0.0; 3], 0.8),
        (0.21, 0.7, 1.4, [0.3, 0.05, 0.0], 0.2),
        (3.0, -0.5, 1.8, [0.1, 0.4, 0.9], 0.6),
        (1.0, 0.2, 1.0, [2.0, 0.0, 0.5], 0.4),
    ]
    .into_iter()
    .enumerate()
    {
        let lobe = Lobe { fuzz: 0.65, roughness: 0.4, ior, ..Lobe::new(MaterialKind::Petal) };
        let record = Material { sigma_a, ..petal(0.15, depth, g) };
        let bench = Bench::new().materials(&[record]);
        let mut kernel = bench.single();
        let wo = lobe.at_cosine(mu);
        let mut stream = Stream::new(53, test as u64);
        let mut means = vec![[Mean::default(); 2]; 8 * 3];
        for i in 0..60_000 {
            let key = key(700 + test, i);
            let scatter = runtime::kernel::f32::Scatter { key, ..lobe.single() };
            let out = kernel.dispatch_sample(scatter, wo.as_vec3(), key);
            let wi = stream.direction();
            let value = kernel.dispatch_eval(scatter, wo.as_vec3(), wi.as_vec3()).f;
            // Unscattered light is no part of the value.
            let weight = if out.pdf > 0.0 { out.weight } else { glam::Vec3::ZERO };
            let bands = [band(&lobe, wo, out.wi.as_dvec3()), band(&lobe, wo, wi)];
            let sphere = 4.0 * std::f64::consts::PI;
            for (at, both) in means.iter_mut().enumerate() {
                let here = bands.map(|band| if at / 3 == band { 1.0 } else { 0.0 });
                both[0].add(here[0] * f64::from(weight[at % 3]));
                both[1].add(here[1] * f64::from(value[at % 3]) * sphere);
            }
        }
        for (at, [samples, values]) in means.iter().enumerate() {
            let off = (samples.value() - values.value()).abs();
            let se = samples.error().hypot(values.error());
            assert!(off < 4.5 * se + 1e-6, "{test} {at}: {} {}", samples.value(), values.value());
            assert!(se < 0.02, "{test} {at}: {se}");
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

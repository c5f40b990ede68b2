//! Energy, reciprocity and limits of conductors, rough glass and clear coats.

use glam::DVec3;
use tests::kernel::Lobe;
use tests::statistics::Mean;
use tests::statistics::grid::{Grid, Shape};
use tests::statistics::stream::Stream;

use crate::albedo;
use crate::weight::{above, key};

const MU: [f64; 7] = [1.0, 0.8, 0.5, 0.2, 0.05, 0.01, 0.003];
const ROUGHNESS: [f32; 10] = [0.05, 0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7, 0.85, 1.0];

/// The visible normals fill the sphere: single scattering without shadowing returns everything.
#[test]
fn visible_normals_are_all_of_the_light() {
    let bench = Lobe::conductor(0.5, 0.0).bench();
    let mut kernel = bench.double();
    for (alpha, mu) in [(1.0, 1.0), (0.5, 0.5), (0.3, 0.2), (0.1, 0.7), (1.0, 0.05)] {
        let wo = DVec3::new((1.0_f64 - mu * mu).sqrt(), 0.0, mu);
        let shape = Shape { ring_scale: alpha, ..Shape::SPHERE };
        let grid = Grid::new(DVec3::new(-wo.x, 0.0, mu), DVec3::Z, shape);
        let sum: f64 = grid
            .integrate(24, |wi| {
                let h = (wo + wi).normalize();
                if h.z > 0.0 { kernel.ggx_transmission_mirror_pdf(wo, h, alpha) } else { 0.0 }
            })
            .iter()
            .sum();
        assert!((sum - 1.0).abs() < 2e-4, "alpha {alpha} at {mu}: {sum}");
    }
}

/// One round width is the isotropic lobe, and two widths fill the disc of projected normals.
#[test]
fn two_widths_generalise_one() {
    let bench = Lobe::conductor(0.5, 0.0).bench();
    let mut kernel = bench.double();
    let mut stream = Stream::new(47, 0);
    let lobe = Lobe { normal: DVec3::Z, ..Lobe::diffuse() };
    for alpha in [1e-3, 0.1, 0.6, 1.0] {
        let both = glam::DVec2::splat(alpha);
        for _ in 0..500 {
            let (o, i) = (above(&mut stream, &lobe), above(&mut stream, &lobe));
            let (one, two) =
                (kernel.ggx_eval(o, i, alpha), kernel.ggx_anisotropic_eval(o, i, both));
            assert!((two / one - 1.0).abs() < 1e-9, "{alpha}: {one} {two}");
            let (one, two) = (kernel.ggx_pdf(o, i, alpha), kernel.ggx_anisotropic_pdf(o, i, both));
            assert!((two / one - 1.0).abs() < 1e-9, "{alpha}: {one} {two}");
        }
    }
    for (roughness, anisotropy) in [(0.3, 0.5), (0.7, 1.0), (1.0, 1.0)] {
        let alpha = kernel.ggx_anisotropic_alpha(roughness, anisotropy);
        assert!((alpha.x * (1.0 - 0.9 * anisotropy) - alpha.y).abs() < 1e-12, "{alpha}");
        let grid = Grid::new(DVec3::Z, DVec3::X, Shape { ring_scale: 0.1, ..Shape::HEMISPHERE });
        let area: f64 =
            grid.integrate(24, |h| kernel.ggx_anisotropic_normals(h, alpha) * h.z).iter().sum();
        assert!((area - 1.0).abs() < 2e-4, "{alpha}: {area}");
    }
}

#[test]
fn a_rough_conductor_without_compensation_loses_ln_2() {
    let lobe = Lobe { compensation: 0.0, ..Lobe::conductor(1.0, 0.0) };
    let e = albedo(&mut lobe.bench().double(), &lobe, lobe.normal, 16);
    assert!((e - (1.0 - std::f64::consts::LN_2)).abs() < 1e-4, "{e}");
}

/// The point of the unit square that `disk_concentric` moves `r` from the middle of the disk, `turn` turns around it.
fn square_from_disk(turn: f64, r: f64) -> glam::DVec2 {
    // The nearest axis, and eighths of a turn from it.
    let axis = (4.0 * turn).round();
    let along = r * 2.0 * (4.0 * turn - axis);
    let (sin, cos) = (axis * std::f64::consts::FRAC_PI_2).sin_cos();
    let q = glam::DVec2::new(r * cos - along * sin, r * sin + along * cos);
    0.5 * (q + glam::DVec2::splat(1.0 - 2.0_f64.powi(-24)))
}

/// Share of light from `o`, local frame, that a white conductor returns. The first lobe: its value over its
/// density, averaged over `n` x `2 n` points of the unit disk that crowd where the lobe's tail is. The second:
/// by cosine and angle, crowded towards grazing, where smooth metals send it.
fn returned(lobe: &Lobe, o: DVec3, n: usize) -> f64 {
    let bench = lobe.bench();
    let mut kernel = bench.double();
    let basis = kernel.basis_along(lobe.normal, lobe.tangent());
    let wo = kernel.basis_world_from_local(basis, o);
    let s = lobe.double();
    let shape = kernel.conductor_lobe(s, wo);
    let (mut once, mut more) = (0.0, 0.0);
    let at = |i: usize, n: usize| (i as f64 + 0.5) / n as f64;
    for i in 0..n {
        let t = 1.0 - at(i, n);
        let (y, dy) = (1.0 - t.powi(4), 4.0 * t.powi(3));
        for j in 0..2 * n {
            let u = square_from_disk(at(j, 2 * n), y.sqrt());
            let wi = kernel.ggx_anisotropic_sample(o, shape.alpha, u);
            if wi.z > 0.0 {
                let f = kernel.ggx_anisotropic_eval(o, wi, shape.alpha);
                once += f / kernel.ggx_anisotropic_pdf(o, wi, shape.alpha) * dy;
            }
        }
        let cells = 16;
        for j in 0..cells {
            let (z, dz) = (t.powi(4), 4.0 * t.powi(3));
            let (sin, cos) = (at(j, cells) * std::f64::consts::TAU).sin_cos();
            let flat = (1.0 - z * z).sqrt();
            let i = DVec3::new(flat * cos * shape.alpha.x, flat * sin * shape.alpha.y, z);
            let missing = kernel.brushed_albedo_missing(shape.albedo, i);
            more += 2.0 * shape.extra.x * missing * z * dz / cells as f64;
        }
    }
    once / (2 * n * n) as f64 + more / n as f64
}

/// `o` at cosine `mu`, turned by a part of a right angle from the tangent.
fn local(mu: f64, turn: f64) -> DVec3 {
    let (sin, cos) = (turn * std::f64::consts::FRAC_PI_2).sin_cos();
    let flat = (1.0 - mu * mu).max(0.0).sqrt();
    DVec3::new(flat * cos, flat * sin, mu)
}

/// White microfacets lose nothing once all reflections count.
#[test]
fn a_white_conductor_returns_everything() {
    let mut worst: f64 = 0.0;
    for roughness in ROUGHNESS {
        let lobe = Lobe::conductor(roughness, 0.0);
        for mu in MU {
            let e = returned(&lobe, local(mu, 0.0), 200);
            assert!((e - 1.0).abs() < 1e-3, "roughness {roughness} at {mu}: {e}");
            worst = worst.max((e - 1.0).abs());
        }
    }
    assert!(worst > 1e-5, "the fit has an error");
}

/// Seen along the brushing, across it and between.
#[test]
fn a_brushed_conductor_returns_everything() {
    for anisotropy in [0.1, 0.3, 0.6, 1.0] {
        for roughness in [0.2, 0.4, 0.6, 0.8, 1.0] {
            let lobe = Lobe::conductor(roughness, anisotropy);
            for mu in [1.0, 0.7, 0.3, 0.1, 0.02] {
                for turn in [0.0, 0.25, 0.5, 0.75, 1.0] {
                    let e = returned(&lobe, local(mu, turn), 64);
                    assert!((e - 1.0).abs() < 0.015, "{lobe:?} at {mu}, {turn}: {e}");
                }
            }
        }
    }
}

#[test]
fn conductors_reflect_the_same_both_ways() {
    for (i, roughness) in [0.05, 0.2, 0.5, 1.0].into_iter().enumerate() {
        for anisotropy in [0.0, 0.5, 1.0] {
            let lobe = Lobe { color: 0.6, ..Lobe::conductor(roughness, anisotropy) };
            let bench = lobe.bench();
            let (mut single, mut double) = (bench.single(), bench.double());
            let mut stream = Stream::new(53, i as u64);
            for _ in 0..2000 {
                let (a, b) = (above(&mut stream, &lobe), above(&mut stream, &lobe));
                let s = lobe.double();
                let there = double.dispatch_eval(s, a, b).f.x / b.dot(lobe.normal);
                let back = double.dispatch_eval(s, b, a).f.x / a.dot(lobe.normal);
                assert!((there / back - 1.0).abs() < 1e-9, "{lobe:?}: {there} {back}");
                let (a, b, s) = (a.as_vec3(), b.as_vec3(), lobe.single());
                let there = single.dispatch_eval(s, a, b).f.x / s.ns.dot(b);
                let back = single.dispatch_eval(s, b, a).f.x / s.ns.dot(a);
                let narrow = f64::from(roughness).powi(2) * (1.0 - 0.69 * f64::from(anisotropy));
                let bound = 1e-4 + 4e-7 / narrow.max(1e-3);
                assert!(f64::from((there / back - 1.0).abs()) < bound, "{lobe:?}: {there} {back}");
            }
        }
    }
}

/// Through glass radiance over the square of the index is what both ways have in common.
#[test]
fn rough_glass_is_the_same_both_ways() {
    for (i, roughness) in [0.2, 0.5, 1.0].into_iter().enumerate() {
        for ior in [1.2, 1.5, 2.4] {
            let lobe = Lobe::rough_dielectric(roughness, ior, true);
            let from_within = Lobe { normal: -lobe.normal, front: false, ..lobe };
            let bench = lobe.bench();
            let mut kernel = bench.double();
            let mut stream = Stream::new(59, i as u64);
            let mut seen = 0;
            for _ in 0..2000 {
                let (a, b) = (above(&mut stream, &lobe), above(&mut stream, &lobe));
                let (mu_a, mu_b) = (a.dot(lobe.normal), b.dot(lobe.normal));
                let there = kernel.dispatch_eval(lobe.double(), a, b).f.x / mu_b;
                let back = kernel.dispatch_eval(lobe.double(), b, a).f.x / mu_a;
                assert!((there / back - 1.0).abs() < 1e-9, "{lobe:?}: {there} {back}");
                let down = kernel.dispatch_eval(lobe.double(), a, -b).f.x / mu_b;
                let up = kernel.dispatch_eval(from_within.double(), -b, a).f.x / mu_a;
                assert!(
                    (down * ior * ior - up).abs() <= 1e-7 * up + 1e-12,
                    "{lobe:?}: {down} {up}"
                );
                seen += usize::from(up > 0.0);
            }
            assert!(seen > 100, "{lobe:?}: {seen}");
        }
    }
}

/// Shares that are reflected and transmitted: transmitted radiance counts times the square of the index.
fn shares(lobe: &Lobe, mu: f64, fine: usize) -> (f64, f64) {
    let bench = lobe.bench();
    let mut kernel = bench.double();
    let (wo, s, n) = (lobe.at_cosine(mu), lobe.double(), lobe.normal);
    let alpha = f64::from(lobe.roughness).powi(2);
    let eta = if lobe.front { lobe.ior } else { 1.0 / lobe.ior };
    let shape = Shape { n_rings: 40, ..Shape::SPHERE };
    let mut sum = |axis: DVec3, up: DVec3, width: f64| -> f64 {
        let grid = Grid::new(axis, n, Shape { ring_scale: (0.5 * width).min(1.0), ..shape });
        grid.integrate_above(fine, up, |wi| kernel.dispatch_eval(s, wo, wi).f.x).iter().sum()
    };
    let reflected = sum(lobe.mirror(wo), n, alpha);
    let axis = lobe.bench().double().dielectric_refract(n, wo, eta, eta - 1.0);
    // Refraction turns directions less than the facets are turned.
    (reflected, sum(axis, -n, alpha * (eta - 1.0).abs().min(1.0)) * eta * eta)
}

/// Both sides together keep all light.
#[test]
fn rough_glass_returns_everything() {
    for roughness in [0.1, 0.3, 0.6, 1.0] {
        for ior in [1.1, 1.5, 2.4] {
            for front in [true, false] {
                for mu in [1.0, 0.6, 0.2, 0.05] {
                    let lobe = Lobe::rough_dielectric(roughness, ior, front);
                    let (reflected, transmitted) = shares(&lobe, mu, 8);
                    let e = reflected + transmitted;
                    assert!(
                        (e - 1.0).abs() < 0.015,
                        "{lobe:?} at {mu}: {reflected} + {transmitted}"
                    );
                }
            }
        }
    }
}

#[test]
fn rough_glass_tends_to_smooth_glass() {
    for (ior, front, mu) in
        [(1.5, true, 0.8), (1.5, false, 0.9), (2.4, true, 0.3), (1.33, true, 1.0)]
    {
        let lobe = Lobe::rough_dielectric(0.06, ior, front);
        let eta = if front { ior } else { 1.0 / ior };
        let f = lobe.bench().double().fresnel_dielectric(mu, eta, eta - 1.0);
        let (reflected, transmitted) = shares(&lobe, mu, 8);
        assert!((reflected - f).abs() < 2e-3, "{lobe:?} at {mu}: {reflected}, not {f}");
        assert!((transmitted - (1.0 - f)).abs() < 2e-3, "{lobe:?} at {mu}: {transmitted}");
    }
}

/// Without an interface, or with one too smooth to tell, rough glass is smooth glass, bit for bit.
#[test]
fn glass_that_cannot_be_rough_is_smooth() {
    for (roughness, ior) in [(0.5, 1.0), (0.5, 1.0001), (0.02, 1.5), (0.0, 2.0)] {
        let rough = Lobe::rough_dielectric(roughness, ior, true);
        let bench = rough.bench();
        let mut kernel = bench.single();
        let wo = rough.at_cosine(0.4).as_vec3();
        for k in 0..500 {
            let key = key(1200, k);
            let lobe = kernel.sample_1d(key, runtime::kernel::f32::PURPOSE_LOBE);
            let smooth = kernel.dielectric_sample(rough.single(), wo, lobe);
            let out = kernel.dispatch_sample(rough.single(), wo, key);
            assert_eq!((out.wi, out.pdf, out.eta2), (smooth.wi, 0.0, smooth.eta2));
            assert!((ior - 1.0).abs() > 1e-9 || out.wi == -wo, "no interface bends nothing");
        }
    }
}

#[test]
fn a_smooth_coat_over_white_returns_everything() {
    for ior in [1.0, 1.0001, 1.33, 1.5, 1.65, 2.4] {
        let lobe = Lobe { ior, ..Lobe::clearcoat(0.0) };
        let bench = lobe.bench();
        for mu in MU {
            let mut kernel = bench.double();
            let f = kernel.fresnel_dielectric(mu, ior, ior - 1.0);
            let e = albedo(&mut kernel, &lobe, lobe.at_cosine(mu), 16) + f;
            assert!((e - 1.0).abs() < 2e-4, "index {ior} at {mu}: {e}");
        }
    }
}

/// Over black only the coat is left: 9.18 % of diffuse light at an index of 1.5, 6 % at normal incidence at 1.65.
#[test]
fn a_coat_over_black_reflects_fresnels_share() {
    let lobe = Lobe { color: 0.0, ..Lobe::clearcoat(0.0) };
    let bench = lobe.bench();
    let mut kernel = bench.single();
    let mut mean = Mean::default();
    for k in 0..200_000 {
        let u = f64::from(kernel.sample_1d(key(1300, k), 9));
        let wo = lobe.at_cosine(u.sqrt().max(1e-3)).as_vec3();
        mean.add(f64::from(kernel.dispatch_sample(lobe.single(), wo, key(1300, k)).weight.x));
    }
    assert!((mean.value() - 0.0918).abs() < 1e-3, "{}", mean.value());
    let toy = Lobe { ior: 1.65, ..lobe };
    let bench = toy.bench();
    let out = bench.single().dispatch_sample(toy.single(), toy.normal.as_vec3(), key(1300, 0));
    assert!((out.weight.x - 0.0602).abs() < 1e-4, "{}", out.weight.x);
}

#[test]
fn a_blurred_coat_never_returns_more_than_it_gets() {
    for fuzz in [0.05, 0.3, 1.0] {
        for ior in [1.0, 1.5, 4.0] {
            let lobe = Lobe { ior, ..Lobe::clearcoat(fuzz) };
            for mu in MU {
                let e = albedo(&mut lobe.bench().double(), &lobe, lobe.at_cosine(mu), 16);
                assert!(e > 0.3 && e < 1.0 + 2e-3, "{lobe:?} at {mu}: {e}");
            }
        }
    }
}

/// The mean weight of samples is the albedo: sampler, density and value agree.
#[test]
fn mean_weights_are_albedos() {
    let mut lobes = Vec::new();
    for roughness in [0.1, 0.4, 1.0] {
        for anisotropy in [0.0, 0.8] {
            lobes.push(Lobe { color: 0.7, ..Lobe::conductor(roughness, anisotropy) });
        }
    }
    lobes.extend([0.2, 1.0].map(Lobe::clearcoat));
    for (i, lobe) in lobes.into_iter().enumerate() {
        let bench = lobe.bench();
        let (mut single, mut double) = (bench.single(), bench.double());
        for (j, mu) in [1.0, 0.4, 0.05].into_iter().enumerate() {
            let wo = lobe.at_cosine(mu);
            let truth = albedo(&mut double, &lobe, wo, 12);
            let mut mean = Mean::default();
            for k in 0..100_000 {
                let out =
                    single.dispatch_sample(lobe.single(), wo.as_vec3(), key(1400 + 3 * i + j, k));
                mean.add(f64::from(out.weight.x));
            }
            let off = (mean.value() - truth).abs();
            let bound = 4.5 * mean.error() + 3e-4;
            assert!(
                off < bound,
                "{lobe:?} at {mu}: {} +- {}, not {truth}",
                mean.value(),
                mean.error()
            );
        }
    }
}

#[test]
fn mean_weights_of_rough_glass_are_its_shares() {
    for (i, (roughness, ior, front)) in
        [(0.2, 1.5, true), (0.5, 1.5, false), (1.0, 1.5, true), (0.7, 1.1, true)]
            .into_iter()
            .enumerate()
    {
        let lobe = Lobe::rough_dielectric(roughness, ior, front);
        let bench = lobe.bench();
        let mut kernel = bench.single();
        for (j, mu) in [1.0, 0.4].into_iter().enumerate() {
            let wo = lobe.at_cosine(mu).as_vec3();
            let (reflected, transmitted) = shares(&lobe, mu, 10);
            let (mut up, mut down) = (Mean::default(), Mean::default());
            for k in 0..200_000 {
                let out = kernel.dispatch_sample(lobe.single(), wo, key(1500 + 2 * i + j, k));
                let weight = f64::from(out.weight.x * out.eta2);
                let above = out.wi.as_dvec3().dot(lobe.normal) > 0.0;
                up.add(if above { weight } else { 0.0 });
                down.add(if above { 0.0 } else { weight });
            }
            for (mean, truth) in [(up, reflected), (down, transmitted)] {
                let off = (mean.value() - truth).abs();
                let bound = 4.5 * mean.error() + 1e-3;
                assert!(
                    off < bound,
                    "{lobe:?} at {mu}: {} +- {}, not {truth}",
                    mean.value(),
                    mean.error()
                );
            }
        }
    }
}

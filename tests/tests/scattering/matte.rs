//! Rough surfaces with gloss, and those that let light through: energy, both ways, weights, sides.

use glam::DVec3;
use pack::abi::MaterialKind;
use runtime::kernel::f64 as double;
use tests::kernel::{Bench, Lobe};
use tests::statistics::Mean;
use tests::statistics::grid::{Grid, Shape};
use tests::statistics::stream::Stream;

use crate::weight::key;

/// Every corner of the parameters, and between.
fn lobes() -> Vec<Lobe> {
    let mut lobes = Vec::new();
    for gloss in [0.0, 0.06, 1.0] {
        for roughness in [0.4, 0.75] {
            lobes.push(Lobe { gloss, roughness, ..Lobe::new(MaterialKind::Stone) });
        }
        for roughness in [0.45, 0.85] {
            for anisotropy in [0.0, 0.6, 1.0] {
                let wood = Lobe::new(MaterialKind::Wood);
                lobes.push(Lobe { gloss, roughness, anisotropy, ..wood });
            }
        }
        for roughness in [0.35, 0.85, 1.0] {
            for weight in [0.0, 0.2, 1.0] {
                let fabric = Lobe::new(MaterialKind::Fabric);
                lobes.push(Lobe { gloss, roughness, weight, ..fabric });
            }
        }
    }
    let dim: Vec<Lobe> = lobes.iter().map(|lobe| Lobe { color: 0.3, ..*lobe }).collect();
    lobes.extend(dim);
    lobes
}

/// Light from `wo` that goes to either side, by quadrature in double precision.
fn both_sides(kernel: &mut double::Kernel<'_>, lobe: &Lobe, wo: DVec3) -> [f64; 2] {
    let s = lobe.double();
    let mu = wo.dot(lobe.normal);
    let alpha = f64::from(lobe.roughness * lobe.roughness);
    let shape = Shape {
        ring_scale: (alpha * mu.max(0.05)).min(1.0),
        sector_scale: mu.clamp(0.02, 1.0),
        ..Shape::SPHERE
    };
    // The gloss in cells around its mirror direction; Lambert's part, which the horizon would cut there, in cells
    // of its own.
    let matte = Lobe { gloss: 0.0, ..*lobe }.bench();
    let mut matte = matte.double();
    let kept = 1.0 - f64::from(lobe.gloss);
    let mut gloss =
        |wi| kernel.dispatch_eval(s, wo, wi).f.x - kept * matte.dispatch_eval(s, wo, wi).f.x;
    let mirror = Grid::new(lobe.mirror(wo), lobe.normal, shape);
    let gloss: f64 = mirror.integrate_above(16, lobe.normal, &mut gloss).iter().sum();
    let mut sum = |up: DVec3| -> f64 {
        let grid = Grid::new(up, wo, Shape::HEMISPHERE);
        kept * grid
            .integrate_above(16, up, |wi| matte.dispatch_eval(s, wo, wi).f.x)
            .iter()
            .sum::<f64>()
    };
    let [above, below] = [sum(lobe.normal), sum(-lobe.normal)];
    [above + gloss, below]
}

#[test]
fn a_rough_surface_scatters_what_it_does_not_absorb() {
    for lobe in lobes() {
        let bench = lobe.bench();
        let mut kernel = bench.double();
        for mu in [1.0, 0.7, 0.3, 0.05, 0.01] {
            let wo = lobe.at_cosine(mu);
            let [above, below] = both_sides(&mut kernel, &lobe, wo);
            let (color, gloss) = (f64::from(lobe.color), f64::from(lobe.gloss));
            let kept = color * (1.0 - gloss) + gloss;
            assert!((above + below - kept).abs() < 0.015, "{lobe:?} at {mu}: {above} + {below}");
            // What is not gloss is Lambert's, to both sides, exactly.
            let matte = f64::from(lobe.color) * (1.0 - f64::from(lobe.gloss));
            let through = matte * f64::from(lobe.weight);
            assert!((below - through).abs() < 1e-4, "{lobe:?} at {mu}: {below}, not {through}");
            assert!(above >= matte - through - 1e-4, "{lobe:?} at {mu}: {above}");
        }
    }
}

fn any(stream: &mut Stream) -> DVec3 {
    stream.direction().as_vec3().as_dvec3().normalize()
}

/// f(wo, wi) = f(wi, wo) on both sides; seen from the other side the surface has the opposite normal.
#[test]
fn light_goes_both_ways_over_and_through() {
    for (i, lobe) in lobes().into_iter().enumerate() {
        let bench = lobe.bench();
        let mut kernel = bench.double();
        let mut stream = Stream::new(47, i as u64);
        for _ in 0..400 {
            let (a, b) = (any(&mut stream), any(&mut stream));
            let toward = |d: DVec3| {
                let side = d.dot(lobe.normal).signum();
                Lobe { normal: lobe.normal * side, ..lobe }.double()
            };
            let (from_a, from_b) = (toward(a), toward(b));
            // The tangent of the lobe's frame is the same from both sides.
            let from_b = double::Scatter { tangent: from_a.tangent, ..from_b };
            let there = kernel.dispatch_eval(from_a, a, b).f.x / b.dot(lobe.normal).abs();
            let back = kernel.dispatch_eval(from_b, b, a).f.x / a.dot(lobe.normal).abs();
            assert!((there - back).abs() <= 1e-9 * there.abs(), "{lobe:?} {a} {b}: {there} {back}");
        }
    }
}

#[test]
fn weights_are_values_over_densities_and_average_to_the_albedo() {
    for (i, lobe) in lobes().into_iter().enumerate().step_by(3) {
        let bench = lobe.bench();
        let (mut single, mut double) = (bench.single(), bench.double());
        for (j, mu) in [1.0, 0.4, 0.05].into_iter().enumerate() {
            let wo = lobe.at_cosine(mu);
            let [above, below] = both_sides(&mut double, &lobe, wo);
            let mut mean = Mean::default();
            for k in 0..20_000 {
                let key = key(3000 + 3 * i + j, k);
                let out = single.dispatch_sample(lobe.single(), wo.as_vec3(), key);
                mean.add(f64::from(out.weight.x));
                if out.pdf > 0.0 {
                    let f = single.dispatch_eval(lobe.single(), wo.as_vec3(), out.wi).f.x;
                    assert!(
                        (out.weight.x * out.pdf - f).abs() <= 1e-5 * f,
                        "{lobe:?}: {out:?}, f {f}"
                    );
                    // No fireflies. Weights that average to 1 cannot all be below it: the light of several
                    // reflections is sampled by a density that is only near its own.
                    let most = if lobe.gloss > 0.0 { 1.85 } else { 1.0 + 1e-4 };
                    assert!(out.weight.x <= most, "{lobe:?} at {mu}: {out:?}");
                    let pdf = single.dispatch_eval(lobe.single(), wo.as_vec3(), out.wi).pdf;
                    assert!((pdf / out.pdf - 1.0).abs() < 1e-4, "{lobe:?}: {} {pdf}", out.pdf);
                }
            }
            let off = (mean.value() - above - below).abs();
            let bound = 4.5 * mean.error() + 2e-4;
            assert!(off < bound, "{lobe:?} at {mu}: {}, not {}", mean.value(), above + below);
        }
    }
}

/// Light arrives from above both surfaces, or from below both: the normals may disagree.
#[test]
fn between_the_normals_there_is_no_light() {
    let mut stream = Stream::new(53, 0);
    for lobe in lobes() {
        let bench = lobe.bench();
        let mut kernel = bench.single();
        for _ in 0..200 {
            let (wo, wi, tilt) = (any(&mut stream), any(&mut stream), any(&mut stream));
            let mut s = lobe.single();
            s.ns = (lobe.normal + tilt * 0.9).normalize().as_vec3();
            let (o, d) = (wo.as_vec3(), wi.as_vec3());
            let (shading, geometric) = (s.ns.dot(d), s.ng.dot(d));
            let value = kernel.dispatch_eval(s, o, d).f.x;
            if shading * geometric <= 0.0 {
                assert_eq!(value, 0.0, "{lobe:?} {wi}");
            }
            if lobe.weight <= 0.0 && geometric <= 0.0 {
                assert_eq!(value, 0.0, "{lobe:?} {wi}: nothing goes through");
            }
        }
    }
}

/// With equal widths the lobe with two widths is the one with one.
#[test]
fn two_equal_widths_are_one() {
    let bench = Bench::new();
    let mut kernel = bench.double();
    let mut stream = Stream::new(59, 0);
    for alpha in [1e-3, 0.03, 0.4, 1.0] {
        for _ in 0..500 {
            let up = |d: DVec3| DVec3::new(d.x, d.y, d.z.abs().max(1e-3)).normalize();
            let (o, i) = (up(stream.direction()), up(stream.direction()));
            let widths = glam::DVec2::splat(alpha);
            let pairs = [
                (kernel.ggx_anisotropic_eval(o, i, widths), kernel.ggx_eval(o, i, alpha)),
                (kernel.ggx_anisotropic_pdf(o, i, widths), kernel.ggx_pdf(o, i, alpha)),
            ];
            for (two, one) in pairs {
                assert!((two / one - 1.0).abs() < 1e-9, "alpha {alpha}: {two} {one}");
            }
        }
    }
}

//! Folding at the surface: the integral of every model is kept, and samples have the density and the value that they
//! are said to have.

use std::f64::consts::{PI, TAU};

use glam::DVec3;
use pack::abi::MaterialKind;
use runtime::kernel::{f32 as single, f64 as double};
use tests::kernel::Lobe;
use tests::statistics::Mean;

/// Angles between both normals, radians; the last turns the shading normal's mirror direction below the surface.
const TILTS: [f64; 3] = [0.2, 0.7, 1.3];
const N: usize = 40_000;

fn lobes() -> Vec<Lobe> {
    let rough = |kind, roughness, fuzz| Lobe { roughness, fuzz, color: 0.8, ..Lobe::new(kind) };
    vec![
        rough(MaterialKind::Diffuse, 0.0, 0.0),
        rough(MaterialKind::Metal, 0.0, 0.6),
        rough(MaterialKind::Conductor, 0.7, 0.0),
        rough(MaterialKind::Principled, 0.7, 0.0),
        rough(MaterialKind::Clearcoat, 0.0, 0.6),
        rough(MaterialKind::RoughDielectric, 0.8, 0.0),
        Lobe { weight: 0.6, ..rough(MaterialKind::Leaf, 0.0, 0.0) },
    ]
}

/// Integral over all directions by midpoints of equal solid angle.
fn integral(mut f: impl FnMut(DVec3) -> DVec3) -> DVec3 {
    let (rings, sectors) = (300, 600);
    let mut sum = DVec3::ZERO;
    for i in 0..rings {
        for j in 0..sectors {
            let z = 1.0 - 2.0 * (f64::from(i) + 0.5) / f64::from(rings);
            let phi = TAU * (f64::from(j) + 0.5) / f64::from(sectors);
            let r = (1.0 - z * z).sqrt();
            sum += f(DVec3::new(r * phi.cos(), r * phi.sin(), z));
        }
    }
    sum * (4.0 * PI / f64::from(rings * sectors))
}

/// Three functions of a direction, 1 among them.
fn probes(d: DVec3) -> DVec3 {
    DVec3::new(1.0, 1.0 + d.dot(DVec3::new(0.6, 0.0, -0.8)), d.x * d.x + 0.5 * d.y)
}

/// The surface of `lobe` with a geometric normal that is `tilt` from the shading normal, and a direction to the eye
/// above both.
fn tilted(lobe: &Lobe, tilt: f64) -> (single::Scatter, double::Scatter, DVec3) {
    let side = lobe.normal.any_orthonormal_vector();
    let ng = (lobe.normal * tilt.cos() + side * tilt.sin()).normalize();
    let across = lobe.normal.cross(side);
    let wo = (lobe.normal + ng + across * 0.4 + side * 0.8).normalize();
    let (mut s, mut d) = (lobe.single(), lobe.double());
    s.ng = ng.as_vec3();
    d.ng = ng;
    (s, d, wo)
}

#[test]
fn folding_keeps_value_and_density_of_every_model() {
    for lobe in lobes() {
        let bench = lobe.bench();
        let mut kernel = bench.double();
        for tilt in TILTS {
            let (_, s, wo) = tilted(&lobe, tilt);
            let plain = lobe.double();
            let both = |kernel: &mut double::Kernel<'_>, s, d| {
                DVec3::new(
                    kernel.dispatch_eval(s, wo, d).f.x,
                    kernel.dispatch_eval(s, wo, d).pdf,
                    0.0,
                )
            };
            let known = integral(|d| both(&mut kernel, plain, d));
            let found = integral(|d| both(&mut kernel, s, d));
            let off = ((found - known) / known.x).abs().max_element();
            assert!(off < 2e-3, "{lobe:?}, {tilt}: {found}, not {known}");
        }
    }
}

#[test]
fn folded_samples_have_their_density_and_weight() {
    for (seed, lobe) in (31..).zip(lobes()) {
        let bench = lobe.bench();
        let (mut kernel, mut exact) = (bench.single(), bench.double());
        for tilt in TILTS {
            let (s, truth, wo) = tilted(&lobe, tilt);
            let density = integral(|d| probes(d) * exact.dispatch_eval(truth, wo, d).pdf);
            let value = integral(|d| probes(d) * exact.dispatch_eval(truth, wo, d).f.x);
            let mut found = [[Mean::default(); 3]; 2];
            for i in 0..N {
                let at = u32::try_from(i).expect("few samples");
                let key = single::SampleKey { pixel: 977, sample: at, bounce: 0, seed };
                let out = kernel.dispatch_sample(s, wo.as_vec3(), key);
                let d = out.wi.as_dvec3();
                let there = if out.pdf > 0.0 { probes(d) } else { DVec3::ZERO };
                let opaque = !lobe.kind.traits().transmits || lobe.kind == MaterialKind::Principled;
                assert!(!opaque || out.pdf <= 0.0 || d.dot(truth.ng) > -1e-6, "{lobe:?}: {d}");
                for c in 0..3 {
                    found[0][c].add(there[c]);
                    found[1][c].add(there[c] * f64::from(out.weight.x));
                }
            }
            for (what, (found, known)) in found.iter().zip([density, value]).enumerate() {
                for c in 0..3 {
                    let off = (found[c].value() - known[c]).abs();
                    assert!(
                        off < 4.5 * found[c].error() + 2e-3,
                        "{lobe:?}, {tilt}, {what}, {c}: {}, not {}",
                        found[c].value(),
                        known[c]
                    );
                }
            }
        }
    }
}

/// Where both normals are the same nothing is computed in another way.
#[test]
fn flat_surfaces_keep_every_bit() {
    for lobe in lobes() {
        let bench = lobe.bench();
        let mut kernel = bench.single();
        let s = lobe.single();
        let wo = lobe.at_cosine(0.6).as_vec3();
        for i in 0..200 {
            let key = single::SampleKey { pixel: 3, sample: i, bounce: 0, seed: 5 };
            let (a, b) = (kernel.dispatch_sample(s, wo, key), kernel.model_sample(s, wo, key));
            assert_eq!((a.wi, a.pdf.to_bits(), a.weight), (b.wi, b.pdf.to_bits(), b.weight));
            assert_eq!(kernel.dispatch_eval(s, wo, a.wi).f, kernel.model_eval(s, wo, a.wi).f);
            let [x, y] =
                [kernel.dispatch_eval(s, wo, a.wi).pdf, kernel.model_eval(s, wo, a.wi).pdf];
            assert_eq!(x.to_bits(), y.to_bits());
        }
    }
}

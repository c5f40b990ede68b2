//! Fresnel, Snell, and the cone of a sphere.

use glam::{DVec3, Vec3};
use pack::abi::MaterialKind;
use runtime::kernel::{f32 as single, f64 as double};
use tests::kernel::{Bench, Lobe};

use crate::Worst;

/// Unpolarised reflectance from the amplitudes of both polarisations; 1 beyond the critical angle.
fn fresnel(c: f64, eta: f64) -> f64 {
    let cos2 = 1.0 - (1.0 - c * c) / (eta * eta);
    if cos2 <= 0.0 {
        return 1.0;
    }
    let t = cos2.sqrt();
    let s = (c - eta * t) / (c + eta * t);
    let p = (eta * c - t) / (eta * c + t);
    0.5 * (s * s + p * p)
}

const INDICES: [f64; 7] = [1.0 + 1e-6, 1.0001, 1.01, 1.33, 1.5, 2.4, 10.0];

/// Cosines from grazing to normal, representable in single precision.
fn cosines() -> impl Iterator<Item = f64> {
    let grazing = (0..200).map(|i| 1e-5 * 1.06_f64.powi(i));
    let even = (1..=20_000).map(|i| f64::from(i) / 20_000.0);
    grazing.chain(even).filter(|c| *c <= 1.0).map(|c| f64::from(c as f32))
}

#[test]
fn fresnel_is_that_of_the_amplitudes() {
    let bench = Bench::new();
    let (mut single, mut double) = (bench.single(), bench.double());
    for index in INDICES {
        for front in [true, false] {
            let less_one = if front { index - 1.0 } else { -(index - 1.0) / index };
            let minus_1 = less_one as f32;
            // What the kernel's numbers stand for.
            let eta = 1.0 + f64::from(minus_1);
            let (mut worst, mut twin) = (Worst::default(), Worst::default());
            for c in cosines() {
                let g2 = f64::from(minus_1) * (eta + 1.0) + c * c;
                if g2.abs() < 1e-3 * c * c {
                    continue; // The critical angle has its own test.
                }
                let truth = fresnel(c, eta);
                let f = single.fresnel_dielectric(c as f32, eta as f32, minus_1);
                worst.add((f64::from(f) / truth - 1.0).abs(), c);
                let f = double.fresnel_dielectric(c, eta, f64::from(minus_1));
                // The amplitudes of the truth cancel near an index of 1.
                twin.add((f / truth - 1.0).abs(), c);
            }
            // Near the critical angle g is a difference: up to 1e3 times the rounding of its square.
            worst.check(&format!("index {index}, {front}"), if front { 1e-6 } else { 2e-4 });
            twin.check(&format!("index {index}, {front}, twin"), 2e-6);
        }
    }
}

#[test]
fn no_interface_reflects_nothing() {
    let bench = Bench::new();
    let mut kernel = bench.single();
    assert!(cosines().all(|c| kernel.fresnel_dielectric(c as f32, 1.0, 0.0) == 0.0));
}

/// Mean over a diffuse field, 2 c dc.
fn mean(kernel: &mut double::Kernel<'_>, eta: f64, minus_1: f64) -> f64 {
    let n = 100_000;
    let at = |i: u32| (f64::from(i) + 0.5) / f64::from(n);
    (0..n).map(|i| 2.0 * at(i) * kernel.fresnel_dielectric(at(i), eta, minus_1)).sum::<f64>()
        / f64::from(n)
}

#[test]
fn fresnel_means_are_the_known_ones() {
    let bench = Bench::new();
    let mut kernel = bench.double();
    for (index, outside, inside) in [(1.5, 0.09178, 0.59635), (10.0, 0.64017, 0.99640)] {
        let out = mean(&mut kernel, index, index - 1.0);
        let back = mean(&mut kernel, 1.0 / index, (1.0 - index) / index);
        assert!((out - outside).abs() < 2e-5, "{index}: {out}");
        assert!((back - inside).abs() < 2e-5, "{index}: {back}");
        // What goes through from inside is what goes through from outside over the square of the index.
        assert!((1.0 - back - (1.0 - out) / (index * index)).abs() < 1e-6);
    }
    // Schlick's form would reflect 4.8 % here.
    let faint = mean(&mut kernel, 1.0001, 1e-4);
    assert!(faint > 1e-5 && faint < 5e-5, "{faint}");
}

#[test]
fn reflection_is_continuous_at_the_critical_angle() {
    let bench = Bench::new();
    let (mut single, mut double) = (bench.single(), bench.double());
    for index in [1.0001, 1.33, 1.5, 2.4, 10.0_f64] {
        let minus_1 = (1.0 - index) / index;
        let eta = 1.0 + minus_1;
        let critical = eta.asin();
        for step in [-1e-3, -1e-6, 0.0, 1e-6, 1e-3] {
            let c = (critical + step).cos();
            let truth = fresnel(c, eta);
            let twin = double.fresnel_dielectric(c, eta, minus_1);
            assert!((twin - truth).abs() < 1e-5, "{index} {step}: {twin}, not {truth}");
            let f = f64::from(single.fresnel_dielectric(c as f32, eta as f32, minus_1 as f32));
            // 1 - F falls as the root of the distance to the critical angle: rounding of 1e-7 is 1e-3 of it.
            let bound = if step.abs() < 1e-4 { 1.5e-2 } else { 1e-3 };
            assert!((f - truth).abs() < bound, "{index} {step}: {f}, not {truth}");
            assert!(step <= 0.0 || twin == 1.0 || step < 1e-5, "{index} {step}: {twin}");
            let sin = (1.0 - c * c).sqrt();
            let wo = Vec3::new(sin as f32, 0.0, c as f32);
            let wi = single.dielectric_refract(Vec3::Z, wo, eta as f32, minus_1 as f32);
            assert!((wi.length() - 1.0).abs() < 1e-6, "{index} {step}: {wi}");
        }
    }
}

#[test]
fn refraction_obeys_snell() {
    let bench = Bench::new();
    let (mut single, mut double) = (bench.single(), bench.double());
    let (mut worst, mut twin) = (Worst::default(), Worst::default());
    for index in INDICES {
        for front in [true, false] {
            let minus_1 =
                f64::from((if front { index - 1.0 } else { (1.0 - index) / index }) as f32);
            let eta = 1.0 + minus_1;
            for c in cosines().step_by(7) {
                let n = DVec3::new(0.48, 0.6, -0.64);
                let wo = Lobe { normal: n, ..Lobe::diffuse() }.at_cosine(c);
                let c = wo.dot(n);
                let cos2 = 1.0 - (1.0 - c * c) / (eta * eta);
                if cos2 < 1e-3 {
                    continue;
                }
                // How much the refracted direction magnifies an error of the incident one.
                let ease = cos2.sqrt() * eta.min(1.0);
                let truth = (-wo + n * c) / eta - n * cos2.sqrt();
                let wi = double.dielectric_refract(n, wo, eta, minus_1);
                twin.add((wi - truth).length() * ease, c);
                let (n, wo) = (n.as_vec3(), wo.as_vec3());
                let wi = single.dielectric_refract(n, wo, eta as f32, minus_1 as f32);
                worst.add((wi.as_dvec3() - truth).length() * ease, c);
            }
        }
    }
    worst.check("refraction", 5e-7);
    twin.check("refraction in double precision", 1e-14);
}

#[test]
fn schlick_has_its_ends() {
    let bench = Bench::new();
    let mut kernel = bench.single();
    for f0 in [0.0, 0.04, 0.5, 1.0] {
        let at = |kernel: &mut single::Kernel<'_>, c| {
            kernel.fresnel_schlick_to(Vec3::splat(f0), 1.0, c).x
        };
        assert_eq!(at(&mut kernel, 1.0), f0);
        assert_eq!(at(&mut kernel, 0.0), 1.0);
        // A cosine that rounding made larger than 1.
        assert_eq!(at(&mut kernel, 1.000_000_1), f0);
        let middle = f64::from(f0) + (1.0 - f64::from(f0)) / 32.0;
        assert!((f64::from(at(&mut kernel, 0.5)) - middle).abs() < 1e-7);
    }
}

/// A shading normal that would refract to the wrong side falls back to the geometric one.
#[test]
fn refraction_always_crosses_the_surface() {
    let bench = Bench::new();
    let mut kernel = bench.single();
    let lobe = Lobe { normal: DVec3::Z, ..Lobe::new(MaterialKind::Dielectric) };
    for tilt in 0..90 {
        for c in 1..100 {
            let angle = f64::from(tilt).to_radians();
            let wo = Lobe { normal: DVec3::Z, ..lobe }.at_cosine(f64::from(c) / 100.0);
            let mut s = lobe.single();
            s.ns = DVec3::new(angle.sin(), 0.0, angle.cos()).as_vec3();
            if s.ns.dot(wo.as_vec3()) <= 0.0 {
                continue;
            }
            for front in [true, false] {
                s.front = front;
                let out = kernel.dielectric_sample(s, wo.as_vec3(), 0.999_999_9);
                let reflected = out.eta2 == 1.0 && out.weight.x == 1.0;
                assert_eq!(out.wi.z > 0.0, reflected, "tilt {tilt}, cosine {c}: {out:?}");
            }
        }
    }
}

#[test]
fn cones_of_spheres() {
    let bench = Bench::new();
    let (mut single, mut double) = (bench.single(), bench.double());
    let (mut worst, mut twin) = (Worst::default(), Worst::default());
    for i in 0..2000 {
        let ratio = 0.9995 * 1e-7_f64.powf(f64::from(i) / 1999.0);
        let way = DVec3::new(0.6, -0.64, 0.48).as_vec3();
        let light = single::Light {
            origin: way,
            edge1: Vec3::new(ratio as f32, 0.0, 0.0),
            ..single::Light::ZERO
        };
        let s2 = f64::from(light.edge1.x).powi(2) / way.as_dvec3().length_squared();
        // 1 - sqrt(1 - s2) without the difference.
        let truth = -((-s2).ln_1p() * 0.5).exp_m1();
        let cone = single.sphere_light_cone(light, Vec3::ZERO);
        worst.add((f64::from(cone) / truth - 1.0).abs(), ratio);
        let wide = double::Light {
            origin: way.as_dvec3(),
            edge1: light.edge1.as_dvec3(),
            ..double::Light::ZERO
        };
        twin.add((double.sphere_light_cone(wide, DVec3::ZERO) / truth - 1.0).abs(), ratio);
    }
    worst.check("sphere_light_cone", 4e-6);
    twin.check("sphere_light_cone in double precision", 1e-12);
}

/// The cosine of Henyey & Greenstein's phase function for the number `u`, from 1 - cos, which is a product of
/// positive factors.
fn phase_cosine(a: f64, u: f64) -> f64 {
    let k = (1.0 - a) / (1.0 - a + 2.0 * a * u);
    1.0 - 2.0 * k * k * (1.0 - u) * (1.0 + a * u)
}

#[test]
fn phase_functions_keep_their_cosines() {
    let bench = Bench::new();
    let mut kernel = bench.single();
    let mut worst = Worst::default();
    for a in [0.0_f32, 1e-6, 1e-3, 0.3, 0.9, 0.999, 0.999_99, 0.999_999] {
        for i in 0..=20_000 {
            let v = (f64::from(i) / 20_000.0) as f32;
            let wi = kernel.hg_local(a, v, glam::Vec2::new(0.6, -0.8));
            let expected = phase_cosine(f64::from(a), 1.0 - f64::from(v));
            worst.add((f64::from(wi.z) - expected).abs(), f64::from(v));
        }
    }
    worst.check("hg_local", 3.4e-7);
}

//! `--clamp-indirect`: a large value changes no bit, a small one bounds the indirect light of every pixel, what is
//! removed and what is kept are the whole, and the software adapter does as the CPU kernel.
//!
//! Direct light alone is the same scene with paths of two segments: every use of random numbers is its own.

use pack::{Checked, Pack};
use runtime::convergence::luminance;
use runtime::{Film, Job};
use tests::features::{case_pack, named};
use tests::{picture, scene, software};

/// A room with a lamp, a glass ball and a mirror, whose paths have `depth` segments.
fn room(depth: u32) -> Pack<Checked> {
    scene::pack(&format!(
        "rts 1
material white: diffuse {{ color = linear(0.8, 0.7, 0.6) }}
material lamp: emissive {{ color = linear(1, 0.9, 0.8), strength = 20 }}
material glass: dielectric {{ ior = 1.5 }}
material mirror: metal {{ color = linear(0.9), fuzz = 0.1 }}
instance walls {{ shape = box(size: (4, 4, 4)m), material = white }}
instance light {{ shape = sphere(radius: 200mm), material = lamp, at = (0, 1.4, 0)m }}
instance ball {{ shape = sphere(radius: 500mm), material = glass, at = (-0.6, -1, 0)m }}
instance other {{ shape = sphere(radius: 500mm), material = mirror, at = (0.7, -1, 0)m }}
camera eye: perspective {{ from = (0, 0, 1.9)m, to = (0, -0.2, 0)m, fov.vertical = 70deg }}
film f {{ size = (24, 24)px }}
render main: path {{ camera = eye, film = f, samples = 64, depth = {depth}, seed = 1 }}
"
    ))
}

fn film(pack: Pack<Checked>, clamp: Option<f32>) -> Film {
    picture::cpu(pack, |job: &mut Job| job.clamp_indirect = clamp).film().clone()
}

fn bits(film: &Film) -> Vec<u64> {
    film.sums.iter().flatten().map(|x| x.to_bits()).collect()
}

/// Of all samples.
fn light(film: &Film) -> f64 {
    film.sums.iter().map(|sum| luminance(*sum)).sum()
}

#[test]
fn a_value_that_nothing_exceeds_changes_no_bit() {
    for name in ["all", "petal", "smoke"] {
        let plain = film(case_pack(named(name)), None);
        let clamped = film(case_pack(named(name)), Some(f32::MAX));
        assert_eq!(bits(&plain), bits(&clamped), "{name}");
        assert_eq!(clamped.removed().to_bits(), 0, "{name}");
    }
}

#[test]
fn no_pixel_has_more_indirect_light_than_the_value() {
    let direct = film(room(2), None);
    assert_eq!(bits(&direct), bits(&film(room(2), Some(1e-3))), "direct light is left alone");
    let whole = film(room(12), None);
    for most in [1e-3_f32, 0.1, 1.0] {
        let kept = film(room(12), Some(most));
        let (mut brightest, mut least) = (0.0, f64::INFINITY);
        for i in 0..kept.sums.len() {
            let (kept, direct) = (kept.mean(i), direct.mean(i));
            for c in 0..3 {
                brightest = f64::max(brightest, kept[c] - direct[c]);
                least = f64::min(least, kept[c] - direct[c]);
            }
        }
        // Sums of direct and indirect light are rounded to 2^-24 of themselves.
        assert!(brightest <= f64::from(most) * (1.0 + 1e-5) + 1e-5, "{most}: {brightest}");
        assert!(brightest > 0.3 * f64::from(most) && least > -1e-5, "{most}: {brightest} {least}");
        let removed = kept.counters.removed;
        let sum = (light(&kept) + removed) / light(&whole);
        assert!((sum - 1.0).abs() < 1e-5, "{most}: {sum}");
        assert!((kept.removed() - removed / light(&whole)).abs() < 1e-5);
        assert!(kept.removed() > 0.01, "{most}: {}", kept.removed());
    }
}

#[test]
fn splits_of_a_clamped_picture_are_that_picture() {
    let whole = film(room(12), Some(0.2));
    let part = |start, end| {
        picture::cpu(room(12), |job| {
            job.clamp_indirect = Some(0.2);
            job.samples = runtime::SampleRange { start, end };
        })
    };
    let parts = vec![part(32, 64).picture, part(0, 32).picture];
    let merged = runtime::output::merge(parts).expect("they are parts of one picture");
    assert_eq!(bits(&merged.film), bits(&whole));
    assert!((merged.film.counters.removed / whole.counters.removed - 1.0).abs() < 1e-12);
    let mut other = part(32, 64).picture;
    other.meta.clamp_indirect = Some(0.3);
    let error = runtime::output::merge(vec![part(0, 32).picture, other]).expect_err("they differ");
    assert!(error.to_string().contains("clamp_indirect"), "{error}");
}

#[test]
fn the_software_adapter_clamps_as_the_cpu_does() {
    let this = "the_software_adapter_clamps_as_the_cpu_does";
    let Some(device) = software::device_without_optimiser(this) else { return };
    for name in ["petal", "smoke"] {
        let set = |job: &mut Job| job.clamp_indirect = Some(0.05);
        let cpu = picture::cpu(case_pack(named(name)), set);
        let gpu = picture::on(&device, case_pack(named(name)), set);
        assert_eq!(gpu.device_error, None, "{name}");
        assert_eq!(bits(cpu.film()), bits(gpu.film()), "{name}");
        assert_eq!(cpu.film().counters, gpu.film().counters, "{name}");
        assert!(cpu.film().counters.removed > 0.0, "{name}: nothing was clamped");
    }
}

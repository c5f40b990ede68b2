//! `rtr check` tells scenes that single precision holds from scenes that it does not, names the pixels, and
//! replays what was rendered.

use pack::{Checked, Pack};
use runtime::check::{Report, Verdict, compare, replay};
use runtime::{BadSample, Job, Precision, Rect, SampleRange, Scene};
use tests::{features, picture, scene};

fn report(pack: Pack<Checked>, samples: u32) -> Report {
    let scene = Scene::new(pack);
    let mut job = Job::of_scene(&scene);
    job.samples = SampleRange { start: 0, end: samples };
    compare(&scene, &job).expect("the kernel runs it")
}

/// Radius in metres of a ball that is a kilometre away.
const PEBBLE: f64 = 2e-4;

/// A ball in the middle of the picture, half as wide as it; white sky around.
fn pebble() -> Pack<Checked> {
    scene::pack(&format!(
        "rts 1
sky heaven: constant {{ color = linear(1) }}
material black: diffuse {{ color = linear(0) }}
instance ball {{ shape = sphere(radius: {PEBBLE:e}m), material = black }}
camera eye: perspective {{ from = (600, 480, 640)m, to = (0, 0, 0)m, fov.vertical = {:e}deg }}
film f {{ size = (32, 32)px }}
render main: path {{ camera = eye, film = f, samples = 16, depth = 2, seed = 7 }}
",
        2.0 * (2.0 * PEBBLE / 1000.0).atan().to_degrees()
    ))
}

#[test]
fn an_ordinary_scene_is_stable() {
    for name in ["diffuse", "lights of every kind"] {
        let report = report(features::case_pack(features::named(name)), 8);
        let verdict = Verdict::of(&report, false);
        assert!(verdict.is_stable(), "{name}: {:?}", verdict.reasons);
        assert_eq!(report.pixels.len(), 1200);
        assert!(report.means[0] > 0.01 && report.counters[0].rays > 9600, "{name}");
    }
}

#[test]
fn a_pebble_a_kilometre_away_is_not_and_its_rim_is_named() {
    let report = report(pebble(), 16);
    let verdict = Verdict::of(&report, false);
    assert!(!verdict.is_stable(), "{} of the paths part", report.share_of_paths());
    assert!(report.share_of_paths() > 0.01 && report.largest() > 1e-3);
    let radius = |x: u32, y: u32| (f64::from(x) - 15.5).hypot(f64::from(y) - 15.5);
    let worst = report.worst();
    assert!(!worst.is_empty());
    for (at, pixel) in worst {
        // The ball is 8 pixels in radius.
        assert!((4.0..12.0).contains(&radius(at.x, at.y)), "{at}");
        assert!(pixel.parted > 0, "{at}");
    }
    let corners = [0, 31, 32 * 31, 32 * 32 - 1];
    assert!(corners.iter().all(|i| report.pixels[*i].off <= 0.0), "the sky is the same");
}

#[test]
fn a_sample_that_parts_is_found_again() {
    let report = report(pebble(), 16);
    let (at, pixel) = report.worst()[0];
    let scene = Scene::new(pebble());
    let [single, double] = replay(&scene, &Job::of_scene(&scene), at).expect("it runs");
    assert_ne!(single.way, double.way);
    let off = (single.radiance[1] - double.radiance[1]).abs();
    assert!((off - pixel.worst.1).abs() < 1e-12, "{off} and {}", pixel.worst.1);
    let hits = |sample: &runtime::check::Sample| sample.steps[0].hit.is_some();
    assert_ne!(hits(&single), hits(&double), "one of the two sees the ball");
}

/// Bit for bit, in both precisions; the film keeps single precision.
#[test]
#[expect(clippy::cast_possible_truncation, reason = "as the film rounds")]
fn a_replay_is_what_was_rendered() {
    for name in ["all", "media inside each other", "instances of petals"] {
        let case = features::named(name);
        let scene = Scene::new(features::case_pack(case));
        let job = Job::of_scene(&scene);
        let mut lit = 0;
        for (x, y, sample) in [(20, 15, 0), (3, 28, 5), (22, 17, 100), (31, 11, 70_000)] {
            let found = replay(&scene, &job, BadSample { x, y, sample }).expect("it runs");
            for (precision, found) in [Precision::F32, Precision::F64].into_iter().zip(found) {
                let outcome = picture::cpu(features::case_pack(case), |job| {
                    job.crop = Rect { x, y, w: 1, h: 1 };
                    job.samples = SampleRange { start: sample, end: sample + 1 };
                    job.precision = precision;
                });
                let film = outcome.film();
                let rounded = found.radiance.map(|x| (x as f32).to_bits());
                assert_eq!(
                    film.sums[0].map(|x| (x as f32).to_bits()),
                    rounded,
                    "{name} {x},{y},{sample}"
                );
                assert_eq!(film.counters.rays, u64::from(found.rays), "{name} {x},{y},{sample}");
                assert!(
                    found.steps.len() >= found.rays as usize,
                    "a shadow ray that goes on is one"
                );
                lit += u32::from(found.radiance[1] > 0.0);
            }
        }
        assert!(lit > 0, "{name}: black is no test");
    }
}

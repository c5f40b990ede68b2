//! Things that move while the shutter is open: coverage is the share of time, light the mean over time, no
//! ray slips through a seam, and what does not move keeps every bit.

#[path = "motion/coverage.rs"]
mod coverage;
#[path = "motion/keys.rs"]
mod keys;
#[path = "motion/lighting.rs"]
mod lighting;
#[path = "motion/seams.rs"]
mod seams;
#[path = "motion/still.rs"]
mod still;

use glam::DVec3;
use pack::Pack;
use tests::console;
use tests::picture::{self, Estimate, channel};

/// The mean over a picture, by one estimator.
fn mean(bytes: &[u8], samples: u32, estimator: u32) -> Estimate {
    let pack = Pack::from_bytes(bytes.to_vec()).expect("valid");
    let outcome = picture::cpu(pack, |job| {
        job.samples = runtime::SampleRange { start: 0, end: samples };
        job.estimator = estimator;
    });
    Estimate::of(&channel(outcome.film(), 1))
}

/// Fails unless the estimate is within four standard errors of the truth, and those below `error`, relative.
fn judge(name: &str, found: Estimate, truth: f64, error: f64) {
    let line = format!(
        "{name:<44} expected {truth:.7} mean {:.7} +- {:.7} z {:+.2}",
        found.mean,
        found.error,
        found.z(truth)
    );
    console::line(&line);
    assert!((found.mean - truth).abs() <= 4.0 * found.error + 2e-6 * truth, "{line}");
    assert!(found.error <= error * truth, "not sharp: {line}");
}

/// Mean of `f` over 0 ..= 1, by Simpson's rule.
fn mean_of(f: impl Fn(f64) -> f64) -> f64 {
    const STEPS: u32 = 2000;
    let weight = |i: u32| match i {
        0 | STEPS => 1.0,
        _ if i % 2 == 1 => 4.0,
        _ => 2.0,
    };
    let at = |i: u32| f(f64::from(i) / f64::from(STEPS));
    (0..=STEPS).map(|i| weight(i) * at(i)).sum::<f64>() / f64::from(3 * STEPS)
}

fn metres(v: DVec3) -> String {
    format!("({}, {}, {})m", v.x, v.y, v.z)
}

/// `place` and `velocity` of a thing that comes from `from` to `to` while the shutter is open.
fn moving(place: &str, from: DVec3, to: DVec3) -> String {
    // The shutter opens 5 ms before the moment 0 and closes 15 ms after it.
    let v = (to - from) / 0.02;
    let velocity = format!("({}, {}, {})m/s", v.x, v.y, v.z);
    format!("{place} = {}, velocity = {velocity}", metres(from + v * 0.005))
}

/// A camera 10 m before the plane z = 0 that sees `height` metres of it.
fn front(size: [u32; 2], height: f64) -> String {
    let fov = 2.0 * (height / 20.0).atan().to_degrees();
    let [w, h] = size;
    format!(
        "camera eye: perspective {{ from = (0, 0, 10)m, to = (0, 0, 0)m, fov.vertical = {fov}deg, \
         shutter = -5ms..15ms }}
film f {{ size = ({w}, {h})px }}
render main: path {{ camera = eye, film = f, samples = 16, depth = 1, seed = 5 }}
"
    )
}

/// Glows with radiance 1.
const LAMP: &str = "rts 1\nmaterial lamp: emissive { color = linear(1) }\n";

//! Brighter lamps: the same picture, brighter by the same factor, noise and all.

use pack::Pack;

use super::{Topic, row};
use crate::picture::{self, Estimate};
use crate::scene;

/// A floor under a lamp that is small enough to be noisy when it is found by chance.
fn text(strength: f64) -> String {
    format!(
        "rts 1
material clay: diffuse {{ color = linear(0.6) }}
instance floor {{ shape = rectangle(size: (4, 4)m), material = clay }}
instance ball {{ shape = sphere(radius: 30cm), material = clay, at = (0.3, 0.3, 0)m }}
light lamp: sphere {{ center = (0, 2, 0)m, radius = 30cm, color = linear(1), strength = {strength} }}
camera eye: perspective {{ from = (0, 2, 3)m, to = (0, 0, 0)m, fov.vertical = 30deg }}
film f {{ size = (32, 32)px }}
render main: path {{ camera = eye, film = f, samples = 16, depth = 3, seed = 1 }}
"
    )
}

/// Red of each pixel; `estimator` as in `Frame`.
fn render(strength: f64, estimator: u32, seed: u32) -> Vec<f64> {
    let pack = Pack::from_bytes(scene::bytes(&scene::compile(&text(strength)))).expect("valid");
    let outcome = picture::cpu(pack, |job| {
        job.estimator = estimator;
        job.seed = seed;
    });
    picture::channel(outcome.film(), 0)
}

/// Noise of a pixel over the mean of the picture, from two renders with seeds of their own: the root mean
/// square of their difference over √2.
#[must_use]
pub fn noise(strength: f64, estimator: u32) -> f64 {
    let [a, b] = [1, 2].map(|seed| render(strength, estimator, seed));
    let squares: Vec<f64> = a.iter().zip(&b).map(|(a, b)| (a - b) * (a - b) / 2.0).collect();
    let mean = Estimate::of(&a).mean.midpoint(Estimate::of(&b).mean);
    Estimate::of(&squares).mean.sqrt() / mean
}

/// How many pixels under a lamp 1,024 times as bright are not 1,024 times as bright to the last bit.
#[must_use]
#[expect(clippy::float_cmp, reason = "a power of two scales every step exactly")]
pub fn pixels_that_differ(estimator: u32) -> usize {
    let (faint, bright) = (render(1.0, estimator, 3), render(1024.0, estimator, 3));
    faint.iter().zip(&bright).filter(|(faint, bright)| **faint * 1024.0 != **bright).count()
}

/// Measures the topic.
#[must_use]
pub fn topic() -> Topic {
    let [faint, bright] = [1.0, 1024.0].map(|strength| noise(strength, 2));
    let sampled = [1.0, 1024.0].map(|strength| noise(strength, 0));
    let figure = |x: f64| format!("{x:.4}");
    Topic {
        title: "Brighter lamps are no less noisy",
        places: &["shaders/wgsl/kernel/direct.wgsl"],
        rows: vec![
            row("noise of a pixel, lamp of strength 1", figure(faint), figure(sampled[0])),
            row("noise of a pixel, lamp of strength 1024", figure(bright), figure(sampled[1])),
            row(
                "pixels that are not exactly 1024 times as bright",
                format!("{} of 1024", pixels_that_differ(2)),
                format!("{} of 1024", pixels_that_differ(0)),
            ),
        ],
        fact: "Light is linear: a lamp 1024 times as strong scales the picture and its noise \
            alike, to the last bit. Sampling the lamp reduces noise; exposure makes a picture \
            brighter. Any clamp or threshold on radiance breaks this equality, which makes it a \
            good test.",
    }
}

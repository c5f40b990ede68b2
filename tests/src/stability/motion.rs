//! Things that move far while the shutter is open.

use std::f64::consts::PI;

use super::tools::{estimates, films, films_of, means, same};
use super::{Case, Row};
use crate::picture::Estimate;
use crate::scene;

/// The cases of this file.
pub const CASES: &[Case] = &[Case {
    id: "X18",
    input: "motion blur: velocity 0; 1e4 times its size while the shutter is open; a moving light",
    must: "mean coverage is the exact share of time, 4 se",
    measure: blur,
}];

const LAMP: &str = "material lamp: emissive { color = linear(1) }\n";

/// A ball of diameter 1 mm that crosses 10 m, seen by a film as high as it is.
fn fast(size: [u32; 2]) -> String {
    let [w, h] = size;
    format!(
        "{LAMP}instance ball {{ shape = sphere(radius: 0.5mm), material = lamp, at = (-5, 0, 0)m, velocity = (1000, 0, 0)m/s }}
instance wall {{ shape = box(size: (1, 1, 1)m), material = lamp, at = (0, 3, 0)m }}
camera eye: perspective {{ from = (0, 0, 200)m, to = (0, 0, 0)m, fov.horizontal = {:.12}deg, shutter = 0ms..10ms }}
film f {{ size = ({w}, {h})px }}
render main: path {{ camera = eye, film = f, samples = 16, depth = 1, seed = 5 }}\n",
        2.0 * (0.5 * f64::from(w) / f64::from(h) * 1e-3 / 200.0_f64).atan().to_degrees()
    )
}

fn blur() -> Vec<Row> {
    let still = |velocity: &str| {
        format!(
            "{LAMP}material m: diffuse {{ color = linear(0.7) }}
sky s: constant {{ color = linear(1) }}
instance ball {{ shape = sphere(radius: 1m), material = m{velocity} }}
camera eye: perspective {{ from = (0, 1, 5)m, to = (0, 0, 0)m, shutter = 0ms..10ms }}
film f {{ size = (16, 16)px }}
render main: path {{ camera = eye, film = f, samples = 16, depth = 4, seed = 5 }}\n"
        )
    };
    let [a, b] = ["", ", velocity = (0, 0, 0)m/s"].map(|v| films(&still(v), 16, 16));
    let equal = same(&a[0], &b[0]) && same(&a[1], &b[1]);
    let text = format!("rts 1\n{}", fast([1024, 1]));
    let bytes = scene::bytes(&scene::compile(&text));
    let found = films_of(&bytes, |job| job.samples.end = 512);
    // Binomial: the film is as high as the ball, which is over each point for the length of a chord.
    let truth = PI * 0.25e-6 / (10.0 * 1e-3);
    let error = (truth / (1024.0 * 512.0)).sqrt();
    let found = estimates(&found).map(|e| Estimate { mean: e.mean, error });
    vec![
        Row::fact("velocity 0 is the picture of a thing at rest", "bit for bit", yes(equal), equal),
        Row::mean("share of time of 1e4 times its size", truth, 0.0, found),
        Row::mean(
            "irradiance of a light that passes",
            passing(),
            1e-4,
            means(&passing_light(), 16, 1024),
        ),
    ]
}

fn yes(so: bool) -> &'static str {
    if so { "yes" } else { "no" }
}

/// A light of radius 0.1 m that goes from 0 to 2 m beside the point above which it is 1 m high.
fn passing_light() -> String {
    let view = super::tools::view([-3.0, 0.5, 0.0], [0.0; 3], 2);
    format!(
        "material white: diffuse {{ color = linear(1) }}
instance floor {{ shape = rectangle(size: (4, 4)m), material = white }}
light bulb: sphere {{ center = (0, 1, 0)m, radius = 10cm, strength = 100, velocity = (200, 0, 0)m/s }}
{}",
        view.replace("fov.vertical", "shutter = 0ms..10ms, fov.vertical")
    )
}

/// Mean over time of 100 (r / d)^2 cos = 100 r^2 h / d^3, with d^2 = x^2 + h^2 and h = 1: x / sqrt(1 + x^2) / 2 at 2.
fn passing() -> f64 {
    100.0 * 0.01 * 0.5 * 2.0 / 5.0_f64.sqrt()
}

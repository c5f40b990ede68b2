//! What `rtr` says about its error, against what the error is: five scenes, a known bias, nothing but
//! black, and the slope of plain Monte Carlo.
//!
//! Seeds are fixed, so a run that passed passes again.

use std::sync::Arc;

use pack::{Checked, Pack};
use runtime::convergence::{Measure, Point, Reference};
use runtime::{Film, Outcome, SampleRange, Stop};
use scenes::catalog::EXAMPLES;
use tests::console;
use tests::picture;
use tests::scene;

/// Pictures behind a measured error.
const SEEDS: u32 = 4;

/// Renders `samples` of each of the four replicates.
fn measured(pack: Pack<Checked>, size: [u32; 2], samples: u32, measure: Measure) -> Outcome {
    picture::cpu(pack, |job| {
        job.resize(size);
        job.samples = SampleRange { start: 0, end: samples };
        job.measure = Some(measure);
    })
}

/// A long run with another seed.
fn reference(pack: Pack<Checked>, size: [u32; 2], samples: u32) -> Film {
    let outcome = picture::cpu(pack, |job| {
        job.resize(size);
        job.seed = 77;
        job.samples = SampleRange { start: 0, end: samples };
        job.measure = Some(Measure::default());
    });
    outcome.picture.film
}

fn last(outcome: &Outcome) -> Point {
    let convergence = outcome.convergence.as_ref().expect("the run was measured");
    *convergence.points.last().expect("the run has points")
}

fn example(name: &str) -> Pack<Checked> {
    let example = EXAMPLES.iter().find(|example| example.name == name).expect("it is listed");
    let compiled = scene::example(example, &[]);
    Pack::from_bytes(scene::bytes(&compiled)).expect("what was written can be read")
}

/// A lamp over a floor, with independent samples: plain Monte Carlo.
fn plain(lamp: f64, sampler: &str) -> Pack<Checked> {
    let text = format!(
        "rts 1
material white: diffuse {{ color = linear(0.7) }}
material lamp: emissive {{ color = linear(1, 0.9, 0.8), strength = {lamp} }}
instance floor {{ shape = rectangle(size: (4, 4)m), material = white }}
instance panel {{ shape = rectangle(size: (1.6, 1.6)m), material = lamp, at = (0, 2, 0)m }}
camera eye: perspective {{ from = (0, 1.6, 5)m, to = (0, 1.0, 0)m, fov.vertical = 30deg }}
film f {{ size = (32, 32)px }}
render main: path {{
  camera = eye, film = f, samples = 16, depth = 4, seed = 1, sampler = {sampler}
}}
"
    );
    scene::pack(&text)
}

#[test]
fn the_error_without_a_reference_is_the_error_against_one() {
    for name in ["cornell", "cornell_sphere", "weekend", "materials", "gltf"] {
        let size = [24, 24];
        let truth = reference(example(name), size, 1024);
        let known = Reference::of(&truth);
        let measure = Measure { reference: Some(Arc::new(known)), ..Measure::default() };
        // The error of one picture is a random number itself: the roots of the means of four.
        let (mut estimate, mut error) = (0.0, 0.0);
        for seed in 101..=100 + SEEDS {
            let outcome = picture::cpu(example(name), |job| {
                job.resize(size);
                job.seed = seed;
                job.samples = SampleRange { start: 0, end: 64 };
                job.measure = Some(measure.clone());
            });
            let point = last(&outcome);
            let versus = point.versus.expect("there is a reference");
            assert_eq!(versus.verdict(), "unbiased", "{name}: z = {:?}", versus.z);
            estimate += point.noise.rel.powi(2) / f64::from(SEEDS);
            error += versus.rel.powi(2) / f64::from(SEEDS);
        }
        let ratio = (estimate / error).sqrt();
        let [estimate, error] = [estimate, error].map(f64::sqrt);
        console::line(&format!("{name}: estimate {estimate:.4} truth {error:.4} ratio {ratio:.3}"));
        assert!((0.8..=1.25).contains(&ratio), "{name}: ratio {ratio}");
    }
}

#[test]
fn a_picture_that_converges_to_something_else_is_called_biased() {
    let size = [24, 24];
    let mut film = reference(example("cornell"), size, 128);
    let measure = |film: &Film| Measure {
        reference: Some(Arc::new(Reference::of(film))),
        ..Measure::default()
    };
    let of = |film: &Film| {
        let point = last(&measured(example("cornell"), size, 64, measure(film)));
        point.versus.expect("there is a reference")
    };
    let good = of(&film);
    assert_eq!(good.verdict(), "unbiased", "z = {:?}", good.z);
    for sum in film.sums.iter_mut().flatten() {
        *sum *= 1.2;
    }
    let bad = of(&film);
    assert_eq!(bad.verdict(), "biased", "z = {:?}", bad.z);
    film.variance.clear();
    assert!(of(&film).verdict().starts_with("unknown"));
}

#[test]
fn plain_monte_carlo_falls_with_the_root_of_the_samples() {
    let outcome = measured(plain(5.0, "pcg"), [64, 64], 512, Measure::default());
    let points = &outcome.convergence.as_ref().expect("measured").points;
    // Against samples, not seconds: the clock of a busy machine is no part of this.
    let logs: Vec<(f64, f64)> = points
        .iter()
        .filter(|point| point.spp >= 16)
        .map(|point| (f64::from(point.spp).ln(), point.noise.rmse.ln()))
        .collect();
    let slope = slope(&logs);
    console::line(&format!("{} points, slope {slope:.4}", logs.len()));
    assert!(logs.len() >= 4 && (slope + 0.5).abs() <= 0.02, "{slope}");
}

fn slope(logs: &[(f64, f64)]) -> f64 {
    let n = logs.len() as f64;
    let x0 = logs.iter().map(|(x, _)| x).sum::<f64>() / n;
    let y0 = logs.iter().map(|(_, y)| y).sum::<f64>() / n;
    let above: f64 = logs.iter().map(|(x, y)| (x - x0) * (y - y0)).sum();
    above / logs.iter().map(|(x, _)| (x - x0) * (x - x0)).sum::<f64>()
}

#[test]
fn a_black_picture_is_exact_and_ends_at_once() {
    let black = "rts 1
material white: diffuse { color = linear(0.7) }
instance floor { shape = rectangle(size: (4, 4)m), material = white }
material lamp: emissive { color = linear(1), strength = 1, sides = front }
instance above { shape = rectangle(size: (1, 1)m), material = lamp, at = (0, 50, 0)m }
camera eye: perspective { from = (0, 1.6, 5)m, to = (0, 1.0, 0)m, fov.vertical = 30deg }
film f { size = (16, 16)px }
render main: path { camera = eye, film = f, samples = 16, depth = 4, seed = 1 }
";
    let goal = "0.01".parse().ok();
    let outcome =
        measured(scene::pack(black), [16, 16], 1 << 20, Measure { goal, ..Measure::default() });
    assert_eq!(outcome.stop, Stop::ErrorReached);
    let point = last(&outcome);
    assert!(point.spp < 10_000, "{}", point.spp);
    let noise = point.noise;
    let numbers = [noise.mse, noise.rel, noise.rel_lo, noise.rel_hi, noise.p95, noise.top];
    assert_eq!(numbers.map(f64::to_bits), [0; 6], "{noise:?}");
}

#[test]
fn the_first_replicate_is_the_usual_picture_and_the_others_are_not() {
    let usual = picture::cpu(plain(5.0, "sobol"), |job| {
        job.samples = SampleRange { start: 0, end: 1 };
    });
    let four = measured(plain(5.0, "sobol"), [32, 32], 1, Measure::default());
    let seeds = (1..4).map(|r| runtime::convergence::replicate_seed(1, r));
    let mut sums: Vec<[f64; 3]> = usual.film().sums.clone();
    for seed in seeds {
        let other = picture::cpu(plain(5.0, "sobol"), |job| {
            job.seed = seed;
            job.samples = SampleRange { start: 0, end: 1 };
        });
        assert!(other.film().sums != usual.film().sums);
        for (sum, more) in sums.iter_mut().zip(&other.film().sums) {
            *sum = [0, 1, 2].map(|c| sum[c] + more[c]);
        }
    }
    assert!(four.film().sums == sums);
}

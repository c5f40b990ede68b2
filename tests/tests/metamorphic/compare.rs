//! Films and packs → whether two pictures are the same, in bits or by statistics.

use compiler::pipeline::Compiled;
use pack::{Checked, Pack};
use runtime::Film;
use tests::picture::{self, Estimate};
use tests::{console, scene};

/// Pictures of a z-test, each with its own seed: enough for the spread to be known to 13 %.
const SEEDS: u32 = 32;

/// Width and height of the pictures of z-tests, pixels.
pub(crate) const SIZE: [u32; 2] = [24, 18];

/// Side of the blocks in which they are compared, pixels.
const BLOCK: usize = 6;

/// Standard errors that two equal pictures may differ by. The largest of 39 is beyond this once in a
/// thousand times.
const LARGEST: f64 = 4.5;

/// Standard error of a picture's mean, relative: what is wrong by 1 % is found.
const SMALL: f64 = 0.001;

pub(crate) fn pack_of(compiled: &Compiled) -> Pack<Checked> {
    Pack::from_bytes(scene::bytes(compiled)).expect("what was written can be read")
}

pub(crate) fn film(compiled: &Compiled) -> Film {
    picture::cpu(pack_of(compiled), |_| {}).film().clone()
}

/// Asserts that `film` is `base` times `factor`, bit for bit, and was made by the same rays.
pub(crate) fn assert_exact(name: &str, base: &Film, film: &Film, factor: f64) {
    let pairs = base.sums.iter().zip(&film.sums);
    let bits = |rgb: [f64; 3]| rgb.map(f64::to_bits);
    let differ = pairs.filter(|(a, b)| bits(a.map(|sum| sum * factor)) != bits(**b)).count();
    let n = base.sums.len();
    assert_eq!(n, film.sums.len(), "{name}");
    assert!(differ == 0, "{name}: {differ} of {n} pixels differ");
    assert_eq!(base.counters, film.counters, "{name}");
    let lit = base.sums.iter().filter(|rgb| rgb.iter().any(|sum| *sum > 0.0)).count();
    assert!(2 * lit > n, "{name}: only {lit} of {n} pixels have light");
}

/// Means of the whole picture and of its blocks, each in three channels.
pub(crate) struct Means(Vec<Estimate>);

impl Means {
    /// Renders `SEEDS` pictures, the first one with seed `first_seed`.
    pub(crate) fn of(compiled: &Compiled, first_seed: u32) -> Self {
        let bytes = scene::bytes(compiled);
        let pictures: Vec<Vec<f64>> = (first_seed..first_seed + SEEDS)
            .map(|seed| {
                let pack = Pack::from_bytes(bytes.clone()).expect("what was written can be read");
                let outcome = picture::cpu(pack, |job| job.seed = seed);
                assert_eq!(outcome.film().counters.bad, 0);
                means(outcome.film())
            })
            .collect();
        let values = |k: usize| pictures.iter().map(|picture| picture[k]).collect::<Vec<_>>();
        Self((0..pictures[0].len()).map(|k| Estimate::of(&values(k))).collect())
    }

    /// Those of the sum of two pictures with independent noise.
    pub(crate) fn plus(&self, other: &Self) -> Self {
        let sum = |(a, b): (&Estimate, &Estimate)| Estimate {
            mean: a.mean + b.mean,
            error: a.error.hypot(b.error),
        };
        Self(self.0.iter().zip(&other.0).map(sum).collect())
    }

    /// How many standard errors the pictures differ by where they differ most.
    pub(crate) fn distance(&self, other: &Self) -> f64 {
        assert_eq!(self.0.len(), other.0.len());
        let z = |(a, b): (&Estimate, &Estimate)| {
            if a == b { 0.0 } else { (a.mean - b.mean).abs() / a.error.hypot(b.error) }
        };
        self.0.iter().zip(&other.0).map(z).fold(0.0, f64::max)
    }
}

/// The means of one picture.
fn means(film: &Film) -> Vec<f64> {
    let [width, height] = SIZE.map(|side| side as usize);
    let pixels = film.means();
    assert_eq!(pixels.len(), width * height);
    let mean = |x0: usize, y0: usize, w: usize, h: usize, k: usize| {
        let rows = (y0..y0 + h).flat_map(|y| &pixels[y * width + x0..][..w]);
        rows.map(|rgb| rgb[k]).sum::<f64>() / (w * h) as f64
    };
    let blocks = (0..height / BLOCK).flat_map(|y| (0..width / BLOCK).map(move |x| (x, y)));
    let whole = (0..3).map(|k| mean(0, 0, width, height, k));
    let blocks = blocks.flat_map(|(x, y)| [0, 1, 2].map(|k| (x * BLOCK, y * BLOCK, k)));
    whole.chain(blocks.map(|(x, y, k)| mean(x, y, BLOCK, BLOCK, k))).collect()
}

/// Asserts that two pictures are estimates of the same one, and good enough ones to tell.
pub(crate) fn assert_same_mean(name: &str, a: &Means, b: &Means) {
    let z = a.distance(b);
    let shown = |m: &Means| format!("{:.5} +- {:.5}", m.0[1].mean, m.0[1].error);
    console::line(&format!("{name:<48} {} and {}: {z:.2}", shown(a), shown(b)));
    for estimate in [&a.0[1], &b.0[1]] {
        assert!(estimate.error < SMALL * estimate.mean, "{name}: {estimate:?} is noise");
    }
    assert!(z < LARGEST, "{name}: z = {z:.2}");
}

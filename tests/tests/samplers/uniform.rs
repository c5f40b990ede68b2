//! The uniform numbers that everything else is made of, from both samplers.

use pack::abi::SamplerKind;
use runtime::kernel::f32::{self as single, Kernel, SampleKey};
use tests::kernel::Bench;
use tests::statistics::{Counts, index};

use crate::{SEED, check};

/// Purposes that numbers are drawn for.
pub(crate) const PURPOSES: [u32; 9] = [
    single::PURPOSE_PIXEL,
    single::PURPOSE_LENS,
    single::PURPOSE_LIGHT_CHOICE,
    single::PURPOSE_LIGHT_POINT,
    single::PURPOSE_LOBE,
    single::PURPOSE_DIRECTION,
    single::PURPOSE_RADIUS,
    single::PURPOSE_ROULETTE,
    single::PURPOSE_DISTANCE,
];
/// Vertices of a path; the last one's dimensions are beyond 32,000.
pub(crate) const BOUNCES: [u32; 3] = [0, 1, 1000];
/// First sample indices: the start, beyond what single precision counts, up to the last index of all.
const FIRST: [u32; 3] = [0, (1 << 24) + 1, u32::MAX - M as u32 + 1];
/// Ways to pair two numbers that must not depend on each other.
const PAIRS: [Pair; 10] = [
    Pair::Purposes(single::PURPOSE_DIRECTION, single::PURPOSE_RADIUS),
    Pair::Purposes(single::PURPOSE_LIGHT_CHOICE, single::PURPOSE_LIGHT_POINT),
    Pair::Purposes(single::PURPOSE_PIXEL, single::PURPOSE_LENS),
    Pair::Purposes(single::PURPOSE_LOBE, single::PURPOSE_ROULETTE),
    Pair::LightAndDirection,
    Pair::NextSample,
    Pair::NextBounce,
    Pair::NextColumn,
    Pair::NextRow,
    Pair::NextSeed,
];
/// Sets of keys that differ in one thing, which is not the sample.
const WALKS: [Walk; 3] = [Walk::Pixels, Walk::Bounces, Walk::Seeds];

/// Chi-square tests here.
pub(crate) const CHECKS: usize = SamplerKind::ALL.len()
    * ((PURPOSES.len() + 1) * BOUNCES.len() * FIRST.len()
        + PAIRS.len()
        + WALKS.len() * WALK_SAMPLES.len());

/// Numbers in one test here.
const M: usize = 1 << 16;
/// Cells along each axis.
const SIDE: usize = 32;
/// Sample indices whose numbers are looked at over all keys of a walk.
const WALK_SAMPLES: [u32; 3] = [0, 3, u32::MAX];

#[derive(Clone, Copy, Debug)]
enum Pair {
    Purposes(u32, u32),
    /// At one vertex.
    LightAndDirection,
    NextSample,
    NextBounce,
    NextColumn,
    NextRow,
    NextSeed,
}

impl Pair {
    /// The first numbers of two purposes, or of two keys, at `sample`.
    fn draw(self, kernel: &mut Kernel<'_>, sample: u32) -> [f32; 2] {
        let key = SampleKey { pixel: 77, sample, bounce: 1, seed: SEED };
        let (purpose, other_purpose) = match self {
            Self::Purposes(a, b) => (a, b),
            _ => (single::PURPOSE_DIRECTION, single::PURPOSE_DIRECTION),
        };
        let other = match self {
            Self::Purposes(..) | Self::LightAndDirection => key,
            Self::NextSample => SampleKey { sample: sample + 1, ..key },
            Self::NextBounce => SampleKey { bounce: 2, ..key },
            Self::NextColumn => SampleKey { pixel: 78, ..key },
            Self::NextRow => SampleKey { pixel: 77 + (1 << 16), ..key },
            Self::NextSeed => SampleKey { seed: SEED + 1, ..key },
        };
        let first = match self {
            Self::LightAndDirection => kernel.sample_light(key).x,
            _ => kernel.sample_1d(key, purpose),
        };
        [first, kernel.sample_1d(other, other_purpose)]
    }
}

#[derive(Clone, Copy, Debug)]
enum Walk {
    Pixels,
    Bounces,
    Seeds,
}

impl Walk {
    fn key(self, kernel: &mut Kernel<'_>, sample: u32, i: u32) -> SampleKey {
        let at = match self {
            Self::Pixels => glam::UVec2::new(i % 512, i / 512),
            Self::Bounces | Self::Seeds => glam::UVec2::new(5, 9),
        };
        let key = kernel.sample_key(at, sample, SEED);
        match self {
            Self::Pixels => key,
            Self::Bounces => SampleKey { bounce: i, ..key },
            Self::Seeds => SampleKey { seed: i, ..key },
        }
    }
}

fn cell(x: f32, y: f32) -> usize {
    index(x.into(), SIDE) * SIDE + index(y.into(), SIDE)
}

/// Sobol's numbers are more even than chance, which passes too; that they are exactly as even as they
/// should be is tested in `sobol.rs`.
#[test]
fn every_purpose_bounce_and_range_is_uniform() {
    for sampler in SamplerKind::ALL {
        let bench = Bench::new().sampler(sampler);
        let mut kernel = bench.single();
        for purpose in PURPOSES {
            every_range_is_uniform(&format!("{sampler:?} {purpose}"), |key| {
                let u = kernel.sample_2d(key, purpose);
                assert_eq!(kernel.sample_1d(key, purpose), u.x);
                u
            });
        }
        every_range_is_uniform(&format!("{sampler:?} light"), |key| kernel.sample_light(key));
    }
}

/// Checks the pairs of `draw`.
fn every_range_is_uniform(name: &str, mut draw: impl FnMut(SampleKey) -> glam::Vec2) {
    for bounce in BOUNCES {
        for first in FIRST {
            let mut counts = Counts::uniform(SIDE * SIDE, M);
            for i in 0..M as u32 {
                let key = SampleKey { pixel: 0x0102_0304, sample: first + i, bounce, seed: SEED };
                let u = draw(key);
                counts.add(cell(u.x, u.y));
            }
            check(&format!("{name}, bounce {bounce}, from {first}"), &counts);
        }
    }
}

/// Samples of one pixel, two numbers of each. Sobol's samples of an aligned block of 32 share out the 32
/// parts of each number among them, so that one sample of each block is looked at: those are independent.
#[test]
fn neighbouring_streams_are_independent() {
    for sampler in SamplerKind::ALL {
        let bench = Bench::new().sampler(sampler);
        let mut kernel = bench.single();
        let sobol = sampler == SamplerKind::Sobol;
        let stride = if sobol { SIDE as u32 } else { 1 };
        for pair in PAIRS.into_iter().filter(|pair| !sobol || !matches!(pair, Pair::NextSample)) {
            let n = 4 * M;
            let mut counts = Counts::uniform(SIDE * SIDE, n);
            for i in 0..n as u32 {
                let [x, y] = pair.draw(&mut kernel, i * stride);
                counts.add(cell(x, y));
            }
            check(&format!("{sampler:?} {pair:?}"), &counts);
        }
    }
}

/// One sample each of many pixels, as one pass over an image takes them; of many bounces; of many seeds.
#[test]
fn pixels_bounces_and_seeds_are_uniform() {
    for sampler in SamplerKind::ALL {
        let bench = Bench::new().sampler(sampler);
        let mut kernel = bench.single();
        for walk in WALKS {
            for sample in WALK_SAMPLES {
                let n = 4 * M;
                let mut counts = Counts::uniform(SIDE * SIDE, n);
                for i in 0..n as u32 {
                    let key = walk.key(&mut kernel, sample, i);
                    let u = kernel.sample_2d(key, single::PURPOSE_DIRECTION);
                    counts.add(cell(u.x, u.y));
                }
                check(&format!("{sampler:?} {walk:?} at sample {sample}"), &counts);
            }
        }
    }
}

/// `pcg_words` run backwards: the key whose words are `v`, if its purpose is `purpose`.
fn key_of_words(v: [u32; 4], purpose: u32) -> Option<SampleKey> {
    let [mut x, mut y, mut z, mut w] = v;
    for round in 0..2 {
        w = w.wrapping_sub(y.wrapping_mul(z));
        z = z.wrapping_sub(x.wrapping_mul(y));
        y = y.wrapping_sub(z.wrapping_mul(x));
        x = x.wrapping_sub(y.wrapping_mul(w));
        if round == 0 {
            [x, y, z, w] = [x, y, z, w].map(|a| a ^ (a >> 16));
        }
    }
    // Newton's iteration for 1 / 1664525 mod 2^32.
    let mut inverse: u32 = 1_664_525;
    for _ in 0..5 {
        inverse = inverse.wrapping_mul(2_u32.wrapping_sub(inverse.wrapping_mul(1_664_525)));
    }
    let [pixel, sample, dimension, seed] =
        [x, y, z, w].map(|a| a.wrapping_sub(1_013_904_223).wrapping_mul(inverse));
    let (bounce, found) = (dimension / single::PURPOSE_STRIDE, dimension % single::PURPOSE_STRIDE);
    (found == purpose).then_some(SampleKey { pixel, sample, bounce, seed })
}

/// The keys that give the largest and the smallest numbers, found by running the hash backwards.
#[test]
fn the_largest_number_is_less_than_one() {
    let bench = Bench::new();
    let mut kernel = bench.single();
    for (word, wanted) in [(u32::MAX, 1.0 - 2.0_f32.powi(-24)), (0, 0.0)] {
        for purpose in PURPOSES {
            let mut keys = (0..2000).filter_map(|i| key_of_words([word, word, i, 5], purpose));
            let key = keys.next().expect("one in 32 has the purpose");
            let u = kernel.sample_2d(key, purpose);
            assert_eq!((u.x, u.y), (wanted, wanted), "purpose {purpose}");
            assert!(kernel.sample_1d(key, purpose) < 1.0);
        }
    }
    assert_eq!(kernel.sobol_unit(u32::MAX), 1.0 - 2.0_f32.powi(-24));
    assert_eq!(kernel.sobol_unit(0), 0.0);
}

/// A bijection cannot repeat itself: every word of a stream is hit by one key only.
#[test]
fn the_hash_is_a_bijection() {
    let bench = Bench::new();
    let mut kernel = bench.single();
    for i in 0..10_000_u32 {
        let purpose = i % 8;
        let key = SampleKey {
            pixel: i.wrapping_mul(2_654_435_761),
            sample: i << 12,
            bounce: i % 97,
            seed: !i,
        };
        let words = kernel.pcg_words(key, purpose);
        assert_eq!(key_of_words(words.to_array(), purpose), Some(key));
    }
}

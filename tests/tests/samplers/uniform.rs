//! The uniform numbers that everything else is made of.

use runtime::kernel::f32::{self as single, SampleKey};
use tests::kernel::Bench;
use tests::statistics::{Counts, index};

use crate::{SEED, check};

/// Purposes that numbers are drawn for.
const PURPOSES: [u32; 8] = [
    single::PURPOSE_PIXEL,
    single::PURPOSE_LENS,
    single::PURPOSE_LIGHT_CHOICE,
    single::PURPOSE_LIGHT_POINT,
    single::PURPOSE_LOBE,
    single::PURPOSE_DIRECTION,
    single::PURPOSE_RADIUS,
    single::PURPOSE_ROULETTE,
];
/// Vertices of a path.
const BOUNCES: [u32; 3] = [0, 1, 1000];
/// First sample indices: the start, beyond what single precision counts, up to the last index of all.
const FIRST: [u32; 3] = [0, (1 << 24) + 1, u32::MAX - M as u32 + 1];
/// Ways to pair two numbers that must not depend on each other.
const PAIRS: [Pair; 5] =
    [Pair::Purposes, Pair::NextSample, Pair::NextBounce, Pair::NextColumn, Pair::NextSeed];

/// Chi-square tests here.
pub(crate) const CHECKS: usize = PURPOSES.len() * BOUNCES.len() * FIRST.len() + PAIRS.len() + 1;

/// Numbers in one test here.
const M: usize = 1 << 16;
/// Cells along each axis.
const SIDE: usize = 32;

#[derive(Clone, Copy, Debug)]
enum Pair {
    Purposes,
    NextSample,
    NextBounce,
    NextColumn,
    NextSeed,
}

fn cell(x: f32, y: f32) -> usize {
    index(x.into(), SIDE) * SIDE + index(y.into(), SIDE)
}

#[test]
fn every_purpose_bounce_and_range_is_uniform() {
    let bench = Bench::new();
    let mut kernel = bench.single();
    for purpose in PURPOSES {
        for bounce in BOUNCES {
            for first in FIRST {
                let mut counts = Counts::uniform(SIDE * SIDE, M);
                for i in 0..M as u32 {
                    let sample = first + i;
                    let key = SampleKey { pixel: 0x0102_0304, sample, bounce, seed: SEED };
                    let u = kernel.sample_2d(key, purpose);
                    assert_eq!(kernel.sample_1d(key, purpose), u.x);
                    counts.add(cell(u.x, u.y));
                }
                check(&format!("purpose {purpose}, bounce {bounce}, from {first}"), &counts);
            }
        }
    }
}

#[test]
fn neighbouring_streams_are_independent() {
    let bench = Bench::new();
    let mut kernel = bench.single();
    for pair in PAIRS {
        let n = 4 * M;
        let mut counts = Counts::uniform(SIDE * SIDE, n);
        for i in 0..n as u32 {
            let key = SampleKey { pixel: 77, sample: i, bounce: 1, seed: SEED };
            let (other, purpose) = match pair {
                Pair::Purposes => (key, single::PURPOSE_RADIUS),
                Pair::NextSample => (SampleKey { sample: i + 1, ..key }, single::PURPOSE_DIRECTION),
                Pair::NextBounce => (SampleKey { bounce: 2, ..key }, single::PURPOSE_DIRECTION),
                Pair::NextColumn => (SampleKey { pixel: 78, ..key }, single::PURPOSE_DIRECTION),
                Pair::NextSeed => (SampleKey { seed: SEED + 1, ..key }, single::PURPOSE_DIRECTION),
            };
            let x = kernel.sample_1d(key, single::PURPOSE_DIRECTION);
            counts.add(cell(x, kernel.sample_1d(other, purpose)));
        }
        check(&format!("{pair:?}"), &counts);
    }
}

/// One sample each of many pixels, as one pass over an image takes them.
#[test]
fn pixels_of_one_pass_are_uniform() {
    let bench = Bench::new();
    let mut kernel = bench.single();
    let mut counts = Counts::uniform(SIDE * SIDE, 4 * M);
    for y in 0..512 {
        for x in 0..512 {
            let key = kernel.sample_key(glam::UVec2::new(x, y), 3, SEED);
            let u = kernel.sample_2d(key, single::PURPOSE_DIRECTION);
            counts.add(cell(u.x, u.y));
        }
    }
    check("pixels of one pass", &counts);
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
    (dimension % 16 == purpose).then_some(SampleKey { pixel, sample, bounce: dimension / 16, seed })
}

/// The keys that give the largest and the smallest numbers, found by running the hash backwards.
#[test]
fn the_largest_number_is_less_than_one() {
    let bench = Bench::new();
    let mut kernel = bench.single();
    for (word, wanted) in [(u32::MAX, 1.0 - 2.0_f32.powi(-24)), (0, 0.0)] {
        for purpose in PURPOSES {
            let mut keys = (0..1000).filter_map(|i| key_of_words([word, word, i, 5], purpose));
            let key = keys.next().expect("one in 16 has the purpose");
            let u = kernel.sample_2d(key, purpose);
            assert_eq!((u.x, u.y), (wanted, wanted), "purpose {purpose}");
            assert!(kernel.sample_1d(key, purpose) < 1.0);
        }
    }
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

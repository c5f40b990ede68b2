//! One 32-bit seed a sample: how many samples share one, and what a random number may round to.

use glam::UVec2;
use runtime::kernel::f32 as single;

use super::{Topic, grouped, row};
use crate::kernel::Bench;

/// Pixels of an image of 7680 x 4320.
pub const PIXELS: u64 = 7680 * 4320;
/// Samples of a pixel.
pub const SAMPLES: u64 = 256;
/// How far the naive seed moves from one sample of a pixel to the next.
pub const STRIDE: u64 = 1_234_567;

/// How many different seeds `pixels` x `samples` have, the seed of sample s of pixel p being
/// p + s `stride` in 32 bits. Sample s has the seeds of one interval; overlaps are counted once.
#[must_use]
pub fn distinct_seeds(pixels: u64, samples: u64, stride: u64) -> u64 {
    let starts = (0..samples).map(|s| s * stride);
    let mut end = 0;
    let mut count = 0;
    for start in starts {
        assert!(start + pixels <= 1 << 32, "no seed wraps around");
        count += start + pixels - end.max(start);
        end = start + pixels;
    }
    count
}

/// How many of `samples` samples of `side` x `side` pixels share the first numbers of another in the
/// kernel: equal 128-bit words.
#[must_use]
pub fn kernel_repeats(side: u32, samples: u32) -> usize {
    let bench = Bench::new();
    let mut kernel = bench.single();
    let mut words = Vec::new();
    for sample in 0..samples {
        for pixel in 0..side * side {
            let key = kernel.sample_key(UVec2::new(pixel % side, pixel / side), sample, 1);
            words.push(kernel.pcg_words(key, single::PURPOSE_PIXEL).to_array());
        }
    }
    let n = words.len();
    words.sort_unstable();
    words.dedup();
    n - words.len()
}

/// How many of the 2^32 integers become exactly 1 when they are turned into a float and divided by 2^32.
/// The conversion is monotone, so those that do are the last ones.
#[must_use]
pub fn ones() -> u32 {
    let is_one = |x: u32| (f64::from(x as f32) - 4_294_967_296.0).abs() < 0.5;
    (0..=u32::MAX).rev().take_while(|x| is_one(*x)).fold(0, |n, _| n + 1)
}

/// The largest number that the kernel's conversion makes: that of the largest integer.
#[must_use]
pub fn largest() -> f64 {
    f64::from((u32::MAX >> 8) as f32 * 2.0_f32.powi(-24))
}

/// Length of the cycle of the lowest `bits` bits of a linear congruential generator of 32 bits.
#[must_use]
pub fn low_bits_cycle(bits: u32) -> u32 {
    let step = |x: u32| x.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
    let mask = (1 << bits) - 1;
    let mut x = step(1);
    let mut n = 1;
    while x & mask != 1 & mask {
        x = step(x);
        n += 1;
    }
    n
}

/// Measures the topic.
#[must_use]
pub fn topic() -> Topic {
    let pairs = PIXELS * SAMPLES;
    let distinct = distinct_seeds(PIXELS, SAMPLES, STRIDE);
    let uses = pairs as f64 / distinct as f64;
    let ones = ones();
    let expected = pairs as f64 * f64::from(ones) / 4_294_967_296.0;
    let repeats = kernel_repeats(512, 16);
    Topic {
        title: "Seeds that repeat",
        places: &["shaders/wgsl/sampler/pcg.wgsl"],
        rows: vec![
            row(
                format!("samples that share a seed, 7680 x 4320 pixels, {SAMPLES} samples each"),
                format!("{uses:.1} ({} samples, {} seeds)", grouped(pairs), grouped(distinct)),
                format!("1 ({repeats} repeats in {})", grouped(512 * 512 * 16)),
            ),
            row(
                "pixels to the right and below at which the next sample's numbers were already used",
                format!("{} and {}", STRIDE % 7680, STRIDE / 7680),
                "none",
            ),
            row(
                "random numbers that are exactly 1, if one integer in 2³² is divided by 2³²",
                format!("{ones} in 2³²: {expected:.0} in such a picture for each use"),
                format!("0 (largest 1 - {:.1e})", 1.0 - largest()),
            ),
            row(
                "cycle of the lowest 4 bits of a 32-bit linear congruential generator",
                low_bits_cycle(4).to_string(),
                "does not iterate",
            ),
        ],
        fact: "Hashing `x + y * width + sample * 1234567` uses the same seed again a few thousand \
            pixels away. Numbers here are a bijection of pixel, sample, purpose and seed on 128 \
            bits, without state. (Jarzynski & Olano 2020, *Hash Functions for GPU Rendering*.)",
    }
}

//! The estimates of the error on noise whose error is known.
//!
//! Seeds are fixed, so a run that passed passes again.

use runtime::convergence::{Noise, REPLICATES, noise};

/// Side of the synthetic picture: 16 blocks of 32 pixels.
const SIDE: usize = 128;

/// Splitmix64: Steele, Lea & Flood 2014, "Fast Splittable Pseudorandom Number Generators".
struct Stream(u64);

impl Stream {
    fn bits(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        z ^ (z >> 31)
    }

    /// Mean 0, variance 1: the sum of four uniform numbers.
    fn normal(&mut self) -> f64 {
        let bits = self.bits();
        let sum: u64 = (0..4).map(|i| bits >> (16 * i) & 0xffff).sum();
        // Each has variance 1/12, four have 1/3.
        (sum as f64 / 65536.0 - 2.0 + 2.0 / 65536.0) * 3_f64.sqrt()
    }
}

/// Four replicates of a grey picture, each with a deviation of `sigma` in every pixel.
fn picture(seed: u64, sigma: f64) -> Vec<[f64; REPLICATES]> {
    let mut stream = Stream(seed << 32);
    (0..SIDE * SIDE).map(|_| [(); REPLICATES].map(|()| 1.0 + sigma * stream.normal())).collect()
}

#[test]
fn the_interval_covers_the_truth_as_often_as_it_says() {
    const SEEDS: u64 = 1000;
    let sigma = 0.02_f64;
    // The mean of four: variance sigma^2 / 4, over 1 + e^2; and with the mean of the other three,
    // E[1 / Y^2] = 1 + 3 var(Y).
    let variance = sigma * sigma / 4.0;
    let truth = (variance * (1.0 + sigma * sigma) / (1.0 + 1e-4)).sqrt();
    let (mut covered, mut sum) = (0, 0.0);
    for seed in 0..SEEDS {
        let sums = picture(seed, sigma);
        let found = noise(&sums, 1.0);
        // The error of this picture, which is not quite that of all pictures of its kind.
        let own = sums.iter().map(|sums| (sums.iter().sum::<f64>() / 4.0 - 1.0).powi(2));
        let own = (own.sum::<f64>() / sums.len() as f64 / (1.0 + 1e-4)).sqrt();
        covered += u32::from((found.rel_lo..=found.rel_hi).contains(&own));
        assert!((found.rel / truth - 1.0).abs() < 0.03, "seed {seed}: {}", found.rel);
        sum += found.rel;
    }
    let mean = sum / SEEDS as f64;
    assert!((mean / truth - 1.0).abs() < 0.01, "{mean} instead of {truth}");
    assert!((930..=970).contains(&covered), "{covered} of {SEEDS}");
}

#[test]
fn independent_samples_give_a_slope_of_one_half() {
    let mut stream = Stream(5);
    let mut sums = vec![[0.0; REPLICATES]; SIDE * SIDE];
    let mut logs = Vec::new();
    for n in 1_u32..=64 {
        for sum in sums.iter_mut().flatten() {
            *sum += 1.0 + 0.1 * stream.normal();
        }
        if n.is_power_of_two() {
            let rel = noise(&sums, 1.0 / f64::from(n)).rel;
            logs.push((f64::from(n).ln(), rel.ln()));
        }
    }
    let count = logs.len() as f64;
    let x0 = logs.iter().map(|(x, _)| x).sum::<f64>() / count;
    let y0 = logs.iter().map(|(_, y)| y).sum::<f64>() / count;
    let above: f64 = logs.iter().map(|(x, y)| (x - x0) * (y - y0)).sum();
    let slope = above / logs.iter().map(|(x, _)| (x - x0) * (x - x0)).sum::<f64>();
    assert!((slope + 0.5).abs() <= 0.02, "{slope}");
}

#[test]
fn a_heavy_tail_is_seen_and_an_even_one_is_not() {
    let mut sums = picture(3, 0.02);
    let even = noise(&sums, 1.0);
    assert!(!even.is_heavy_tailed() && even.top < 0.01, "{even:?}");
    assert!((2.0..4.0).contains(&even.kurtosis), "{}", even.kurtosis);
    // A firefly in one replicate of one pixel in 2,000.
    for sum in sums.iter_mut().step_by(2000) {
        sum[1] += 5.0;
    }
    let tail = noise(&sums, 1.0);
    assert!(tail.is_heavy_tailed() && tail.top > 0.5, "{tail:?}");
    assert!(tail.kurtosis > 100.0, "{}", tail.kurtosis);
}

#[test]
fn the_error_does_not_depend_on_the_unit_of_light() {
    let sums = picture(9, 0.1);
    let scaled: Vec<_> = sums.iter().map(|sums| sums.map(|sum| 1024.0 * sum)).collect();
    let (a, b) = (noise(&sums, 1.0), noise(&scaled, 1.0));
    let parts = |n: Noise| [n.rel, n.rel_lo, n.rel_hi, n.p95, n.top];
    for (a, b) in parts(a).into_iter().zip(parts(b)) {
        assert!((a / b - 1.0).abs() < 1e-9, "{a} {b}");
    }
    assert!((b.rmse / a.rmse - 1024.0).abs() < 1e-6);
    // Half a sum twice as large is the same mean.
    assert!((noise(&scaled, 1.0 / 1024.0).mse / a.mse - 1.0).abs() < 1e-9);
}

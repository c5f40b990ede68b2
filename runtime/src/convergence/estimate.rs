//! Mean luminance of every pixel in every replicate → the error of their mean.
//!
//! No reference is needed, and no model of the noise beyond this: replicates are independent.

use crate::replicate::{REPLICATES, moments};

/// Side of the blocks whose spread says whether a bias is believed, in pixels. Pixels side by side see the same
/// things, so their errors are as large or as small together.
const TILE: usize = 32;
/// Blocks that there should be at least; in small pictures they are smaller instead.
const TILES: usize = 16;
/// `e` over the mean luminance: what counts as black.
const FLOOR: f64 = 0.01;
/// Share of the pixels that are the worst ones.
const WORST: f64 = 0.001;
/// Half width of a 95 % interval in standard errors.
const Z: f64 = 1.959_964;

/// The error of a picture as its replicates show it. Everything is in luminance.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Noise {
    /// Mean of the picture.
    pub mean: f64,
    /// What counts as black: 1 % of `mean`.
    pub e: f64,
    /// Mean variance of a pixel.
    pub mse: f64,
    /// Its root.
    pub rmse: f64,
    /// `sqrt(mean(V / (Y^2 + e^2)))`, see `relative`.
    pub rel: f64,
    /// Lower end of the 95 % interval of the error that this very picture has.
    pub rel_lo: f64,
    /// Upper end.
    pub rel_hi: f64,
    /// 95th percentile of `sqrt(V) / (Y + e)`.
    pub p95: f64,
    /// Share of all variance that the worst 0.1 % of the pixels have.
    pub top: f64,
    /// Fourth moment of the relative deviations over the square of the second; 3 is Gaussian.
    pub kurtosis: f64,
}

impl Noise {
    /// Whether so much hangs on so few pixels that the error may be larger than it looks.
    #[must_use]
    pub fn is_heavy_tailed(&self) -> bool {
        self.top > 0.5 || self.kurtosis > 100.0
    }

    /// `rel` and its standard error: the picture's own error is below it in about five of six pictures.
    #[must_use]
    pub fn rel_safe(&self) -> f64 {
        let square = self.rel * self.rel;
        (square + (self.rel_hi * self.rel_hi - square) / Z).sqrt()
    }
}

/// The error of a picture. `scale` times a sum is the mean of a replicate.
#[must_use]
pub fn noise(sums: &[[f64; REPLICATES]], scale: f64) -> Noise {
    let n = sums.len() as f64;
    let pixels: Vec<(f64, f64)> = sums.iter().map(|sums| moments(sums, scale)).collect();
    let mean = pixels.iter().map(|(y, _)| y).sum::<f64>() / n;
    let mse = pixels.iter().map(|(_, v)| v).sum::<f64>() / n;
    let e = FLOOR * mean;
    let (square, variance) = squared(sums, scale, e);
    let half = Z * variance.sqrt();
    let mut worst: Vec<f64> = pixels.iter().map(|(_, v)| *v).collect();
    let mut local: Vec<f64> = pixels.iter().map(|&(y, v)| share(v.sqrt(), y.abs() + e)).collect();
    Noise {
        mean,
        e,
        mse,
        rmse: mse.sqrt(),
        rel: square.sqrt(),
        rel_lo: (square - half).max(0.0).sqrt(),
        rel_hi: (square + half).sqrt(),
        p95: percentile(&mut local, 0.95),
        top: share(sum_of_largest(&mut worst, WORST), mse * n),
        kurtosis: kurtosis(sums, scale, e),
    }
}

/// A part of a whole; no part of nothing is 0.
pub(super) fn share(part: f64, whole: f64) -> f64 {
    if part == 0.0 { 0.0 } else { part / whole }
}

/// The smallest value that `share` of all values do not exceed.
fn percentile(values: &mut [f64], share: f64) -> f64 {
    let Some(last) = values.len().checked_sub(1) else { return 0.0 };
    let at = index((values.len() as f64 * share).ceil()).saturating_sub(1).min(last);
    *values.select_nth_unstable_by(at, f64::total_cmp).1
}

/// Sum of the largest `share` of the values, at least of one.
fn sum_of_largest(values: &mut [f64], share: f64) -> f64 {
    let n = index((values.len() as f64 * share).ceil()).clamp(1, values.len().max(1));
    let Some(at) = values.len().checked_sub(n) else { return 0.0 };
    let (_, first, rest) = values.select_nth_unstable_by(at, f64::total_cmp);
    *first + rest.iter().sum::<f64>()
}

/// Mean without the largest `share` of the values.
pub(super) fn trimmed_mean(values: &mut [f64], share: f64) -> f64 {
    let n = index((values.len() as f64 * share).ceil());
    let Some(kept) = values.len().checked_sub(n).filter(|kept| *kept > 0) else { return 0.0 };
    if n > 0 {
        values.select_nth_unstable_by(kept, f64::total_cmp);
    }
    values[..kept].iter().sum::<f64>() / kept as f64
}

/// The share of the pixels that trimmed means leave out.
pub(super) const TRIM: f64 = WORST;

#[expect(clippy::cast_possible_truncation, reason = "a number of pixels")]
fn index(x: f64) -> usize {
    x as usize
}

/// Sums of the second and of the fourth powers of the deviations of the replicates from their mean,
/// each over `Y^2 + e^2` of the other replicates: an outlier makes its own pixel bright, and must not
/// be judged by that.
fn relative(sums: &[f64; REPLICATES], scale: f64, e: f64) -> [f64; 2] {
    const R: f64 = REPLICATES as f64;
    let total: f64 = sums.iter().sum();
    let (mut second, mut fourth) = (0.0, 0.0);
    for sum in sums {
        let deviation = (sum - total / R) * scale;
        let others = (total - sum) / (R - 1.0) * scale;
        let square = share(deviation * deviation, others * others + e * e);
        second += square;
        fourth += square * square;
    }
    [second, fourth]
}

/// `rel^2`, and the variance of its difference to the square of the error that the picture has.
///
/// With deviations `d` of four independent replicates from the truth, the squared error of their mean less
/// its estimate is the sum of all `d_i d_j` over 6: the squares cancel, so that an outlier that is in the
/// picture is in the estimate too. Its variance is `sigma^4 / 6` or `8/3 V^2`, and `E[v^2] = 5/3 V^2` where
/// the noise is Gaussian. Outliers make `v^2` larger than that, which stands for what is not known of the
/// luminance where they are. `docs/error.md` shows how often the interval covers.
fn squared(sums: &[[f64; REPLICATES]], scale: f64, e: f64) -> (f64, f64) {
    let n = (sums.len() as f64).max(1.0);
    let (mut square, mut squares) = (0.0, 0.0);
    for sums in sums {
        let v = squared_error(sums, scale, e);
        square += v;
        squares += v * v;
    }
    (square / n, 1.6 * squares / (n * n))
}

/// The term of a pixel in `rel^2`.
pub(super) fn squared_error(sums: &[f64; REPLICATES], scale: f64, e: f64) -> f64 {
    relative(sums, scale, e)[0] / (REPLICATES * (REPLICATES - 1)) as f64
}

/// Of the relative deviations of all replicates of all pixels.
fn kurtosis(sums: &[[f64; REPLICATES]], scale: f64, e: f64) -> f64 {
    let (mut second, mut fourth) = (0.0, 0.0);
    for sums in sums {
        let [square, power] = relative(sums, scale, e);
        second += square;
        fourth += power;
    }
    share(fourth * (sums.len() * REPLICATES) as f64, second * second)
}

/// Means of square blocks of a picture.
pub(super) struct Blocks {
    /// Mean over the picture.
    pub(super) mean: f64,
    /// Standard error of the mean, from the spread of the blocks; infinite with one block.
    pub(super) error: f64,
    /// Number of blocks.
    #[cfg(test)]
    n: usize,
}

impl Blocks {
    /// Of one value a pixel, row by row.
    pub(super) fn of(values: impl Iterator<Item = f64>, width: usize, height: usize) -> Self {
        let mut side = TILE;
        let count = |side: usize| width.div_ceil(side) * height.div_ceil(side);
        while side > 1 && count(side) < TILES {
            side /= 2;
        }
        let across = width.div_ceil(side);
        let mut blocks = vec![(0.0, 0.0); count(side)];
        for (i, value) in values.enumerate() {
            let (x, y) = (i % width, i / width);
            let (sum, n) = &mut blocks[y / side * across + x / side];
            *sum += value;
            *n += 1.0;
        }
        let pixels = (width * height) as f64;
        let mean = share(blocks.iter().map(|(sum, _)| sum).sum(), pixels);
        // Blocks at the edge are smaller and weigh less: Cochran 1977, "Sampling Techniques", 6.2.
        let square = blocks.iter().map(|(sum, n)| (sum - n * mean).powi(2)).sum::<f64>();
        let n = blocks.len();
        let error = if n > 1 {
            (square * n as f64 / (n as f64 - 1.0)).sqrt() / pixels
        } else {
            f64::INFINITY
        };
        Self {
            mean,
            error,
            #[cfg(test)]
            n,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn moments_are_those_of_the_mean() {
        // Means 1, 2, 3, 6: mean 3, squares 4 + 1 + 0 + 9 = 14.
        let (mean, variance) = moments(&[2.0, 4.0, 6.0, 12.0], 0.5);
        assert!((mean - 3.0).abs() < 1e-12 && (variance - 14.0 / 12.0).abs() < 1e-12);
    }

    #[test]
    fn black_has_no_error_and_no_nan() {
        let black = noise(&vec![[0.0; REPLICATES]; 1024], 1.0);
        assert_eq!(black, Noise::default());
        assert!(!black.is_heavy_tailed());
    }

    #[test]
    fn percentiles_and_sums_of_the_worst_count_from_the_right_end() {
        let mut values: Vec<f64> = (1..=2000).rev().map(f64::from).collect();
        assert_eq!(percentile(&mut values, 0.95).to_bits(), 1900.0_f64.to_bits());
        assert_eq!(sum_of_largest(&mut values, 0.001).to_bits(), 3999.0_f64.to_bits());
        let mean = trimmed_mean(&mut values, 0.001);
        assert!((mean - 999.5).abs() < 1e-9, "{mean}");
    }

    #[test]
    fn blocks_of_a_small_picture_are_smaller() {
        let halves = (0..64 * 64).map(|i| if i % 64 < 32 { 1.0 } else { 3.0 });
        let blocks = Blocks::of(halves, 64, 64);
        assert_eq!(blocks.n, 16);
        assert!((blocks.mean - 2.0).abs() < 1e-12);
        // 16 values of 1 and 3: standard deviation sqrt(16/15), over sqrt(16).
        assert!((blocks.error - (16.0_f64 / 15.0).sqrt() / 4.0).abs() < 1e-12);
        assert!(Blocks::of([1.0].into_iter(), 1, 1).error.is_infinite());
    }
}

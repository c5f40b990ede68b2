//! Counts → verdicts: Pearson's chi-square with pooled cells, and the level that many tests share.

pub mod grid;
pub mod stream;

use statrs::distribution::{ChiSquared, ContinuousCDF};

/// Chance that a file of statistical tests fails although nothing is wrong, for one choice of seeds.
/// Seeds are fixed, so a run that passed passes again.
pub const ALPHA: f64 = 1e-3;

/// Cells that expect fewer counts are pooled: below it the statistic is not chi-square distributed.
const LEAST_EXPECTED: f64 = 5.0;

/// Level of one test out of `n` independent ones that together fail with chance [`ALPHA`] (Šidák).
#[must_use]
pub fn level(n: usize) -> f64 {
    // 1 - (1 - alpha)^(1 / n) without the difference.
    -((-ALPHA).ln_1p() / n as f64).exp_m1()
}

/// Which of `n` equal parts of 0 ..= 1 holds `t`; the first and the last hold what is outside.
#[must_use]
#[expect(clippy::cast_possible_truncation, reason = "the part is wanted, and a cast saturates")]
pub fn index(t: f64, n: usize) -> usize {
    ((t * n as f64) as usize).min(n - 1)
}

/// Counts and what they should be.
#[derive(Clone, Debug, Default)]
pub struct Counts {
    observed: Vec<f64>,
    expected: Vec<f64>,
}

impl Counts {
    /// Nothing counted yet; `expected` in counts, not in shares.
    #[must_use]
    pub fn new(expected: Vec<f64>) -> Self {
        Self { observed: vec![0.0; expected.len()], expected }
    }

    /// The same expectation for each of `cells` cells, `n` in total.
    #[must_use]
    pub fn uniform(cells: usize, n: usize) -> Self {
        Self::new(vec![n as f64 / cells as f64; cells])
    }

    /// One more in `cell`.
    pub fn add(&mut self, cell: usize) {
        self.observed[cell] += 1.0;
    }

    /// Another cell.
    pub fn push(&mut self, observed: f64, expected: f64) {
        self.observed.push(observed);
        self.expected.push(expected);
    }

    /// Chance of a deviation at least as large as this one if the expectation is right.
    ///
    /// # Panics
    /// When fewer than two cells are left after pooling: then nothing is tested.
    #[must_use]
    pub fn p_value(&self) -> f64 {
        let (statistic, cells) = self.statistic();
        assert!(cells >= 2, "a chi-square test needs two cells, there are {cells}");
        if statistic.is_infinite() {
            return 0.0;
        }
        let freedom = (cells - 1) as f64;
        ChiSquared::new(freedom).expect("there are degrees of freedom").sf(statistic)
    }

    /// The cell that is farthest off: its number, what was observed and what was expected.
    #[must_use]
    pub fn worst(&self) -> (usize, f64, f64) {
        let off = |i: usize| {
            let d = self.observed[i] - self.expected[i];
            d * d / self.expected[i].max(1.0)
        };
        let cells = 0..self.expected.len();
        let i = cells.max_by(|a, b| off(*a).total_cmp(&off(*b))).expect("there are cells");
        (i, self.observed[i], self.expected[i])
    }

    /// Pearson's statistic and the number of cells after pooling; infinite where a count is where
    /// nothing can be.
    fn statistic(&self) -> (f64, usize) {
        let mut order: Vec<usize> = (0..self.expected.len()).collect();
        order.sort_by(|a, b| self.expected[*a].total_cmp(&self.expected[*b]));
        let (mut sum, mut cells) = (0.0, 0);
        let (mut pool_observed, mut pool_expected) = (0.0, 0.0);
        for i in order {
            let (observed, expected) = (self.observed[i], self.expected[i]);
            if expected <= 0.0 && observed > 0.0 {
                return (f64::INFINITY, self.expected.len());
            }
            pool_observed += observed;
            pool_expected += expected;
            if pool_expected >= LEAST_EXPECTED {
                let off: f64 = pool_observed - pool_expected;
                sum += off * off / pool_expected;
                cells += 1;
                (pool_observed, pool_expected) = (0.0, 0.0);
            }
        }
        (sum, cells)
    }
}

/// Distance of a count from a binomial's mean in standard deviations.
#[must_use]
pub fn binomial_z(hits: usize, n: usize, share: f64) -> f64 {
    let mean = n as f64 * share;
    (hits as f64 - mean) / (mean * (1.0 - share)).sqrt()
}

/// Sums of a random variable.
#[derive(Clone, Copy, Debug, Default)]
pub struct Mean {
    n: f64,
    sum: f64,
    square: f64,
}

impl Mean {
    /// One more value.
    pub fn add(&mut self, x: f64) {
        self.n += 1.0;
        self.sum += x;
        self.square += x * x;
    }

    /// The mean of the values.
    #[must_use]
    pub fn value(&self) -> f64 {
        self.sum / self.n
    }

    /// Standard error of [`Mean::value`].
    #[must_use]
    pub fn error(&self) -> f64 {
        self.deviation() / (self.n - 1.0).sqrt()
    }

    /// Standard deviation of the values.
    #[must_use]
    pub fn deviation(&self) -> f64 {
        let mean = self.value();
        (self.square / self.n - mean * mean).max(0.0).sqrt()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn levels_shrink_with_the_number_of_tests() {
        assert!((level(1) - ALPHA).abs() < 1e-15);
        assert!((1.0 - (1.0 - level(100)).powi(100) - ALPHA).abs() < 1e-12);
    }

    /// Table value: the upper 5 % point of chi-square with 9 degrees of freedom is 16.919.
    #[test]
    fn p_values_are_those_of_the_tables() {
        // Off by d in two of ten cells of 100: the statistic is 2 d^2 / 100.
        let off = (16.919_f64 * 50.0).sqrt();
        let mut counts = Counts::new(vec![100.0; 10]);
        counts.observed = vec![100.0; 10];
        counts.observed[0] += off;
        counts.observed[1] -= off;
        assert!((counts.p_value() - 0.05).abs() < 1e-4);
    }

    #[test]
    fn small_cells_are_pooled() {
        let mut counts = Counts::new(vec![1.0, 100.0, 2.0, 100.0, 2.5]);
        counts.observed = vec![3.0, 100.0, 0.0, 100.0, 2.5];
        assert_eq!(counts.statistic(), (0.0, 3), "0.0 rests on 5.5 pooled counts of 5.5");
    }

    #[test]
    fn a_count_where_none_can_be_is_fatal() {
        let mut counts = Counts::new(vec![50.0, 50.0, 0.0]);
        counts.observed = vec![50.0, 50.0, 1.0];
        assert!(counts.p_value() <= 0.0);
    }

    #[test]
    fn uniform_numbers_pass_and_squares_of_them_do_not() {
        let n = 100_000;
        let (mut even, mut bent) = (Counts::uniform(50, n), Counts::uniform(50, n));
        for mut stream in (0..n as u64).map(|i| stream::Stream::new(7, i)) {
            let u = stream.unit();
            even.add(index(u, 50));
            bent.add(index(u.powf(1.05), 50));
        }
        assert!(even.p_value() > ALPHA);
        assert!(bent.p_value() < 1e-9);
    }
}

//! Figures of merit of two things, a few runs each → which is better, and whether that is chance.
//!
//! The test is exact and assumes no distribution: of all ways to deal the runs to the two, how many
//! would give a difference as large? Fisher 1935, "The Design of Experiments", section 21.

/// The middle and the ends of some values.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Spread {
    /// Smallest.
    pub least: f64,
    /// Half of the values are below.
    pub median: f64,
    /// Largest.
    pub most: f64,
}

impl Spread {
    /// Of at least one value.
    #[must_use]
    pub fn of(values: &[f64]) -> Self {
        let mut sorted = values.to_vec();
        sorted.sort_by(f64::total_cmp);
        let at = |i: usize| sorted.get(i).copied().unwrap_or(f64::NAN);
        let (n, half) = (sorted.len(), sorted.len() / 2);
        let median =
            if n % 2 == 0 { f64::midpoint(at(half.wrapping_sub(1)), at(half)) } else { at(half) };
        Self { least: at(0), median, most: at(n.wrapping_sub(1)) }
    }
}

/// The second against the first.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Comparison {
    /// Ratio of the geometric means, second over first; above 1 the second is better.
    pub ratio: f64,
    /// Share of the deals that differ at least as much, two-sided.
    pub p: f64,
    /// The smallest `p` that so many runs can give.
    pub least_p: f64,
}

impl Comparison {
    /// Whether chance is ruled out at 5 %.
    #[must_use]
    pub fn is_significant(&self) -> bool {
        self.p <= 0.05
    }
}

/// Most values on both sides together: 2^20 deals take a moment.
const MAX_RUNS: usize = 20;

/// Compares positive values; up to 20 of them together. `None` where one is not positive and finite,
/// or there are too many or too few.
#[must_use]
pub fn compare(first: &[f64], second: &[f64]) -> Option<Comparison> {
    let n = first.len() + second.len();
    let all: Vec<f64> = first.iter().chain(second).map(|x| x.ln()).collect();
    if first.is_empty() || second.is_empty() || n > MAX_RUNS || !all.iter().all(|x| x.is_finite()) {
        return None;
    }
    let total: f64 = all.iter().sum();
    let (n1, n2) = (first.len() as f64, second.len() as f64);
    let difference = |sum: f64| sum / n2 - (total - sum) / n1;
    let seen = difference(all[first.len()..].iter().sum());
    let (mut deals, mut as_large) = (0_u32, 0_u32);
    for deal in 0_u32..1 << n {
        if deal.count_ones() as usize != second.len() {
            continue;
        }
        let dealt = all.iter().enumerate().filter(|(i, _)| deal >> i & 1 == 1);
        let sum: f64 = dealt.map(|(_, x)| x).sum();
        deals += 1;
        // Equal differences must count, whatever the order of their sums rounds to.
        as_large += u32::from(difference(sum).abs() >= seen.abs() * (1.0 - 1e-9) - 1e-12);
    }
    let sides = if first.len() == second.len() { 2.0 } else { 1.0 };
    Some(Comparison {
        ratio: seen.exp(),
        p: f64::from(as_large) / f64::from(deals),
        least_p: sides / f64::from(deals),
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn runs_that_do_not_overlap_are_significant_from_four_on() {
        let five = compare(&[1.0, 1.1, 1.2, 1.05, 0.9], &[2.0, 2.1, 2.2, 2.05, 1.9]).unwrap();
        assert!((five.p - 2.0 / 252.0).abs() < 1e-12 && five.is_significant());
        assert!((five.ratio - 1.96).abs() < 0.02, "{}", five.ratio);
        let three = compare(&[1.0, 1.1, 1.2], &[2.0, 2.1, 2.2]).unwrap();
        assert!((three.p - 0.1).abs() < 1e-12 && !three.is_significant());
        assert!((three.least_p - 0.1).abs() < 1e-12);
    }

    #[test]
    fn equal_things_differ_by_chance() {
        let same = compare(&[1.0, 2.0, 3.0], &[1.0, 2.0, 3.0]).unwrap();
        assert!((same.p - 1.0).abs() < 1e-12 && (same.ratio - 1.0).abs() < 1e-12);
        assert_eq!(compare(&[1.0, f64::INFINITY], &[1.0, 2.0]), None);
        assert_eq!(compare(&[1.0; 11], &[1.0; 11]), None);
    }

    #[test]
    fn false_alarms_are_as_rare_as_promised() {
        // 400 pairs of five equal runs, from a fixed generator.
        let mut state = 1_u64;
        let mut next = || {
            state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1);
            (state >> 40) as f64 / f64::from(1 << 24) + 0.5
        };
        let alarms = (0..400)
            .filter(|_| {
                let (a, b): (Vec<f64>, Vec<f64>) = (0..5).map(|_| (next(), next())).unzip();
                compare(&a, &b).is_some_and(|c| c.is_significant())
            })
            .count();
        // 5 % of 400 are 20; five standard errors of 4.4.
        assert!((1..=42).contains(&alarms), "{alarms}");
    }

    #[test]
    fn a_spread_is_the_middle_and_the_ends() {
        let spread = Spread { least: 1.0, median: 2.0, most: 9.0 };
        assert_eq!(Spread::of(&[9.0, 1.0, 2.0]), spread);
        assert_eq!(Spread::of(&[9.0, 1.0, 1.5, 2.5]), spread);
    }
}

//! Light by light group: its sums, and the values whose sum is the picture.

/// A light group and its light.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Group {
    /// Its name.
    pub name: String,
    /// Sum of radiance over the samples of each pixel, linear Rec. 709.
    pub sums: Vec<[f64; 3]>,
}

impl Group {
    /// Whether it is black everywhere.
    #[must_use]
    pub fn is_black(&self) -> bool {
        self.sums.iter().flatten().all(|x| *x == 0.0)
    }

    /// Sorts groups as the channels of a file are: the full stop that ends a name there counts.
    pub(crate) fn sort(names: &mut [String]) {
        names.sort_by_cached_key(|name| format!("{name}."));
    }
}

/// The light of each group in one pixel and channel, of which the mean is `whole`, so rounded that it adds up to
/// `whole` exactly: in `f32`, in any order.
///
/// Each is a multiple, at least 0, of the unit in the last place of `whole`, so partial sums are below 2^24 units and
/// exact. What rounding leaves over, at most .56 units a group, is given to the brightest or taken from it; if the
/// light is not that of `whole`, as on a device that rounds in its own way, from the next ones too. Where there is no
/// light the first has `whole` alone.
pub(crate) fn shares(light: &[f64], whole: f32) -> Vec<f32> {
    if !(whole > 0.0 && whole.is_finite()) {
        let first = |i| if i == 0 { whole } else { 0.0 };
        return (0..light.len()).map(first).collect();
    }
    let unit = unit(whole);
    let all = whole_number(f64::from(whole) / unit);
    let mut units: Vec<u64> = light.iter().map(|x| whole_number(x / unit).min(all)).collect();
    let sum: u64 = units.iter().sum();
    let mut over = sum.saturating_sub(all);
    while let Some(brightest) = brightest(&mut units).filter(|_| over > 0) {
        let taken = over.min(*brightest);
        *brightest -= taken;
        over -= taken;
    }
    if let Some(brightest) = brightest(&mut units) {
        *brightest += all.saturating_sub(sum);
    }
    #[expect(
        clippy::cast_possible_truncation,
        reason = "a whole number below 2^24 of units is a float"
    )]
    let value = |n: &u64| (*n as f64 * unit) as f32;
    units.iter().map(value).collect()
}

/// The first of the largest.
fn brightest(units: &mut [u64]) -> Option<&mut u64> {
    let largest = units.iter().copied().max()?;
    units.iter_mut().find(|n| **n == largest)
}

/// The unit in the last place of a positive number.
fn unit(x: f32) -> f64 {
    // Numbers below 2^-126 have that of 2^-126.
    let exponent = (x.to_bits() >> 23 & 0xff).max(1);
    f64::from_bits(u64::from(exponent + 1023 - 150) << 52)
}

/// What is more than this above a whole number is rounded up: the square root of 6, less 2. Means over 37 samples may
/// lie half a unit above one exactly, and merged parts a little off it; to no fraction is this number that close.
const UP: f64 = 0.449_489_742_783_178;

/// One of the two next whole numbers, for most the nearest; 0 for what is below it, or none.
#[expect(clippy::cast_possible_truncation, reason = "saturates on purpose")]
fn whole_number(x: f64) -> u64 {
    (x + (1.0 - UP)).floor() as u64
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Adds up from both ends, in pairs and in double precision, and compares bits.
    fn check(light: &[f64], whole: f32) -> Vec<f32> {
        let shares = shares(light, whole);
        assert!(shares.iter().all(|x| *x >= 0.0), "{light:?} {whole:e}: {shares:?}");
        let forwards = shares.iter().fold(0.0, |a: f32, b| a + b);
        let backwards = shares.iter().rev().fold(0.0, |a: f32, b| a + b);
        let pairs = shares.chunks(2).map(|pair| pair.iter().sum::<f32>()).sum::<f32>();
        let double = shares.iter().map(|x| f64::from(*x)).sum::<f64>();
        for sum in [forwards, backwards, pairs] {
            assert_eq!(sum.to_bits(), whole.to_bits(), "{light:?} {whole:e}: {shares:?}");
        }
        assert_eq!(double.to_bits(), f64::from(whole).to_bits());
        shares
    }

    /// Numbers that a linear congruence gives: of all sizes, zeros and halves of units among them.
    fn numbers() -> impl Iterator<Item = u64> {
        let next = |state: &u64| {
            Some(
                state
                    .wrapping_mul(6_364_136_223_846_793_005)
                    .wrapping_add(1_442_695_040_888_963_407),
            )
        };
        std::iter::successors(Some(7), next).map(|state| state >> 16)
    }

    #[test]
    fn groups_add_up_to_the_picture_in_any_order() {
        let mut numbers = numbers();
        let mut next = |n: u64| numbers.next().unwrap_or_default() % n;
        for _ in 0..200_000 {
            let count = 1 + next(17);
            let light: Vec<f64> = (0..count)
                .map(|_| match next(4) {
                    0 => 0.0,
                    1 => next(1 << 25) as f64 * 0.5,
                    2 => next(1 << 40) as f64 * f64::from_bits((1023 - 60 - next(900)) << 52),
                    _ => next(1 << 40) as f64 * f64::from_bits((1023 - next(80)) << 52),
                })
                .collect();
            #[expect(clippy::cast_possible_truncation, reason = "as a picture is rounded")]
            let whole = light.iter().sum::<f64>() as f32;
            let shares = check(&light, whole);
            // No group is off by more than what all have left over.
            let most = (0.56 + 0.56 * count as f64 + 1.0) * unit(whole.max(f32::MIN_POSITIVE));
            let off = light.iter().zip(&shares).map(|(a, b)| (a - f64::from(*b)).abs());
            assert!(off.fold(0.0, f64::max) <= most, "{light:?} {whole:e}: {shares:?}");
        }
    }

    #[test]
    fn a_picture_that_is_not_the_sum_is_still_met() {
        for (light, whole, expected) in [
            (&[3.0, 1.0, 0.5][..], 2.0_f32, &[0.5, 1.0, 0.5][..]),
            (&[3.0, 1.0], 8.0, &[7.0, 1.0]),
            (&[0.0, 0.0], 2.5, &[2.5, 0.0]),
            (&[3.0, 4.0], 0.0, &[0.0, 0.0]),
            (&[f64::NAN, 1.0], 1.0, &[0.0, 1.0]),
            (&[-1.0, f64::INFINITY], 1.0, &[0.0, 1.0]),
            (&[1e-45, 1e-45], 1e-45, &[0.0, 1e-45]),
        ] {
            assert_eq!(check(light, whole), expected);
        }
        assert_eq!(shares(&[], 1.0), [0.0; 0]);
    }

    #[test]
    fn names_are_in_the_order_of_channels() {
        let mut names = ["key", "key-2", "rest", "Key", "key2"].map(str::to_owned);
        Group::sort(&mut names);
        assert_eq!(names, ["Key", "key-2", "key", "key2", "rest"]);
    }
}

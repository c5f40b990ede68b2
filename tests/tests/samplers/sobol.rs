//! What Sobol's numbers promise beyond being uniform: every pair is a (0,2)-sequence, pairs are
//! scrambled and ordered independently, and sums over them converge faster than by chance.

use pack::abi::SamplerKind;
use runtime::kernel::f32::{self as single, Kernel, SampleKey};
use tests::console;
use tests::kernel::Bench;
use tests::statistics::{Mean, binomial_z};

use crate::SEED;
use crate::uniform::{BOUNCES, PURPOSES};

/// Distance in standard deviations that none of the thousands of comparisons of a test may exceed: chance
/// does so once in 1.7 million.
const FAR: f64 = 5.0;

pub(crate) fn sobol() -> Bench {
    Bench::new().sampler(SamplerKind::Sobol)
}

/// Which of 2^k equal parts of [0, 1) holds `x`.
pub(crate) fn part(x: f32, k: u32) -> u32 {
    (x * (1_u32 << k) as f32) as u32
}

/// Two numbers that are drawn together.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Pair {
    /// Those of this purpose.
    Of(u32),
    /// Those for a point on a light.
    Light,
    /// Those that the light's are stratified with.
    BeforeLight,
}

impl Pair {
    fn draw(self, kernel: &mut Kernel<'_>, key: SampleKey) -> [f32; 2] {
        let numbers = match (self, key.bounce) {
            (Self::Of(purpose), _) => kernel.sample_2d(key, purpose),
            (Self::Light, _) => kernel.sample_light(key),
            (Self::BeforeLight, 0) => kernel.sample_2d(key, single::PURPOSE_PIXEL),
            (Self::BeforeLight, bounce) => {
                let last = SampleKey { bounce: bounce - 1, ..key };
                kernel.sample_2d(last, single::PURPOSE_DIRECTION)
            }
        };
        numbers.to_array()
    }
}

/// Points of `n` samples from that of `key` on.
pub(crate) fn points(kernel: &mut Kernel<'_>, key: SampleKey, pair: Pair, n: u32) -> Vec<[f32; 2]> {
    let at = |i| SampleKey { sample: key.sample + i, ..key };
    (0..n).map(|i| pair.draw(kernel, at(i))).collect()
}

/// Every box of area 2^-k with aligned sides holds one of 2^k points, for every pair, at every aligned
/// range of samples up to the last one.
#[test]
fn every_elementary_box_holds_one_point() {
    let bench = sobol();
    let mut kernel = bench.single();
    for pair in PURPOSES.map(Pair::Of).into_iter().chain([Pair::Light]) {
        for bounce in BOUNCES {
            for k in [0, 1, 2, 3, 4, 7, 10] {
                let n = 1 << k;
                for sample in [0, 5 << k, 1 << 24, u32::MAX - (n - 1)] {
                    let key = SampleKey { pixel: 0x0010_0321 + k, sample, bounce, seed: SEED };
                    let points = points(&mut kernel, key, pair, n);
                    for columns in 0..=k {
                        let mut seen = vec![false; n as usize];
                        for [x, y] in &points {
                            let rows = k - columns;
                            let cell = part(*x, columns) << rows | part(*y, rows);
                            seen[cell as usize] = true;
                        }
                        let name = format!("{pair:?}, bounce {bounce}, from {sample}");
                        assert!(seen.iter().all(|seen| *seen), "{name}: 2^{columns} of 2^{k}");
                    }
                }
            }
        }
    }
}

/// The factors are the direction numbers of Sobol 1967: v0 = 2^31, v(k+1) = vk ^ (vk >> 1).
#[test]
fn the_second_coordinate_has_sobols_direction_numbers() {
    let bench = Bench::new();
    let mut kernel = bench.single();
    for i in (0..32).map(|k| 1 << k).chain((0..1000_u32).map(|i| i.wrapping_mul(2_654_435_761))) {
        let mut direction = 1_u32 << 31;
        let mut expected = 0;
        for k in 0..32 {
            expected ^= if i >> k & 1 == 1 { direction } else { 0 };
            direction ^= direction >> 1;
        }
        assert_eq!(kernel.sobol_pascal(i).reverse_bits(), expected, "{i:#x}");
    }
}

/// A digit decides about itself and later digits, and always about itself: so scrambling is a bijection of
/// 32 bits, no sample index is met twice, and stratification survives.
#[test]
fn scrambling_changes_a_digit_by_those_before_it_only() {
    let bench = Bench::new();
    let mut kernel = bench.single();
    for i in 0..2000_u32 {
        let digits = i.wrapping_mul(2_654_435_761);
        let seed = (!i).wrapping_mul(0x9e37_79b9).rotate_left(7);
        for digit in 0..32 {
            let one = kernel.sobol_scramble(digits, seed);
            let other = kernel.sobol_scramble(digits ^ 1 << digit, seed);
            assert_eq!((one ^ other).trailing_zeros(), digit, "{digits:#x} {seed:#x}");
        }
    }
}

/// Owen's scrambling flips the digit behind every prefix by a fair coin of its own. The coins of the 31
/// prefixes of up to four digits, over pixels, and every two of them.
#[test]
fn digits_behind_different_prefixes_flip_independently() {
    const PREFIXES: usize = 31;
    let n = 1 << 16;
    let bench = Bench::new();
    let mut kernel = bench.single();
    let mut ones = [0; PREFIXES];
    let mut equal = [[0; PREFIXES]; PREFIXES];
    for pixel in 0..n {
        let key = SampleKey { pixel, sample: 0, bounce: 0, seed: SEED };
        let seed = kernel.sobol_seeds(key, single::PURPOSE_DIRECTION).y;
        // Prefix number 2^length - 1 + digits: scrambling changes the digit behind it, a 0, to the coin.
        let coins: [bool; PREFIXES] = std::array::from_fn(|i| {
            let length = (i + 1).ilog2();
            let digits = i as u32 + 1 - (1 << length);
            kernel.sobol_scramble(digits, seed) >> length & 1 == 1
        });
        for i in 0..PREFIXES {
            ones[i] += usize::from(coins[i]);
            for (count, coin) in equal[i].iter_mut().zip(&coins[..i]) {
                *count += usize::from(coins[i] == *coin);
            }
        }
    }
    for i in 0..PREFIXES {
        let z = binomial_z(ones[i], n as usize, 0.5);
        assert!(z.abs() < FAR, "prefix {i}: {z:.1}");
        for (j, count) in equal[i].iter().enumerate().take(i) {
            let z = binomial_z(*count, n as usize, 0.5);
            assert!(z.abs() < FAR, "prefixes {i} and {j}: {z:.1}");
        }
    }
}

/// Digits of two purposes over the samples of one pixel, as signs. Two samples whose indices differ in bit
/// k - 1 and none above have opposite digits k behind the same prefix, which they share with chance
/// 2^(1 - k); all else is independent. So the sum of products of digits k and l over n samples has the
/// mean 0 and the variance n (1 + 2^(1 - k)) where k = l, and n as by chance where they differ.
#[test]
fn pairs_of_one_pixel_are_shuffled_against_each_other() {
    let n = 64;
    let bench = sobol();
    let mut kernel = bench.single();
    let digit = |x: f32, k: u32| if part(x, k) & 1 == 1 { 1.0 } else { -1.0 };
    for (a, b) in [
        (Pair::Of(single::PURPOSE_DIRECTION), Pair::Of(single::PURPOSE_LOBE)),
        (Pair::Light, Pair::Of(single::PURPOSE_LIGHT_CHOICE)),
        (Pair::Light, Pair::Of(single::PURPOSE_DIRECTION)),
        (Pair::Of(single::PURPOSE_PIXEL), Pair::Of(single::PURPOSE_LENS)),
        (Pair::Of(single::PURPOSE_DIRECTION), Pair::Of(single::PURPOSE_ROULETTE)),
    ] {
        let mut sums = [[(Mean::default(), Mean::default()); 4]; 4];
        for pixel in 0..20_000 {
            let key = SampleKey { pixel, sample: 0, bounce: 2, seed: SEED };
            let first = points(&mut kernel, key, a, n);
            let second = points(&mut kernel, key, b, n);
            for (k, row) in (1..).zip(&mut sums) {
                for (l, (mean, square)) in (1..).zip(row) {
                    let both = first.iter().zip(&second);
                    let sum: f64 = both.map(|(p, q)| digit(p[0], k) * digit(q[0], l)).sum();
                    mean.add(sum);
                    square.add(sum * sum / f64::from(n));
                }
            }
        }
        for (k, row) in (1..).zip(sums) {
            for (l, (mean, square)) in (1..).zip(row) {
                let expected = if k == l { 1.0 + 2.0_f64.powi(1 - k) } else { 1.0 };
                let off =
                    [mean.value() / mean.error(), (square.value() - expected) / square.error()];
                assert!(
                    off.iter().all(|z| z.abs() < FAR),
                    "{a:?} {b:?}, digits {k} {l}: {off:.1?}"
                );
            }
        }
    }
}

/// An integrand over the unit square, and its integral.
type Integrand = (fn(f64, f64) -> f64, f64);

/// exp(x + y).
const SMOOTH: Integrand = (|x, y| (x + y).exp(), 2.952_492_442_012_56);
/// A quarter disc: its edge crosses boxes of every size.
const DISC: Integrand =
    (|x, y| f64::from(u8::from(x * x + y * y < 1.0)), std::f64::consts::FRAC_PI_4);

/// Error of the mean over the first `n` samples.
fn error(kernel: &mut Kernel<'_>, (f, truth): Integrand, key: SampleKey, n: u32) -> f64 {
    let points = points(kernel, key, Pair::Light, n);
    points.iter().map(|[x, y]| f((*x).into(), (*y).into())).sum::<f64>() / f64::from(n) - truth
}

/// Root mean square over 256 pixels; the mean error must be 0 within its own error.
fn rmse(sampler: SamplerKind, integrand: Integrand, n: u32) -> f64 {
    let bench = Bench::new().sampler(sampler);
    let mut kernel = bench.single();
    let (mut mean, mut square) = (Mean::default(), Mean::default());
    for pixel in 0..256 {
        let key = SampleKey { pixel, sample: 0, bounce: 0, seed: SEED };
        // Numbers are the lower ends of intervals of 2^-24: on average 2^-25 too small, which moves these
        // integrals by less than 2^-22.
        let error = error(&mut kernel, integrand, key, n);
        mean.add(error);
        square.add(error * error);
    }
    let slack = 2.0_f64.powi(-22);
    assert!(mean.value().abs() < 4.0 * mean.error() + slack, "{sampler:?}, {n} samples: {mean:?}");
    square.value().sqrt()
}

/// Burley 2020 and Owen 1997: N^-1.5 for what is smooth, N^-0.75 at edges, N^-0.5 by chance.
#[test]
fn errors_fall_as_fast_as_theory_says() {
    let cases = [("smooth", SMOOTH, 1.0 / 100.0, -1.4), ("disc", DISC, 1.0 / 4.0, -0.65)];
    for (name, integrand, gain, slope) in cases {
        let sizes = [64, 1024, 4096];
        let [chance, even] = [SamplerKind::Pcg, SamplerKind::Sobol]
            .map(|sampler| sizes.map(|n| rmse(sampler, integrand, n)));
        for (i, n) in sizes.into_iter().enumerate() {
            let [chance, even] = [chance[i], even[i]];
            console::line(&format!("{name}, {n} samples: pcg {chance:.2e}, sobol {even:.2e}"));
        }
        let slope_of = |errors: [f64; 3]| (errors[2] / errors[0]).ln() / 64.0_f64.ln();
        assert!((slope_of(chance) + 0.5).abs() < 0.05, "{name}: slope {}", slope_of(chance));
        assert!(slope_of(even) < slope, "{name}: slope {}", slope_of(even));
        assert!(even[1] < gain * chance[1], "{name}: {} of {}", even[1], chance[1]);
    }
}

/// Replicates: errors of another seed, another pixel and another purpose tell nothing about each other.
#[test]
fn seeds_are_independent_randomisations() {
    type Walk = fn(SampleKey, u32) -> SampleKey;
    const N: u32 = 64;
    let bench = sobol();
    let mut kernel = bench.single();
    let first = SampleKey { pixel: 1000, sample: 0, bounce: 0, seed: SEED };
    let walks: [(&str, Walk); 3] = [
        ("seed", |key, i| SampleKey { seed: key.seed + i, ..key }),
        ("pixel", |key, i| SampleKey { pixel: key.pixel + i, ..key }),
        ("bounce", |key, i| SampleKey { bounce: i, ..key }),
    ];
    for (name, walk) in walks {
        let mut correlation = |integrand: Integrand| {
            let errors: Vec<f64> =
                (0..4096).map(|i| error(&mut kernel, integrand, walk(first, i), N)).collect();
            let square = errors.iter().map(|e| e * e).sum::<f64>();
            // Lag 1, 2 and 16: neighbours, and what a change of one bit makes neighbours.
            [1, 2, 16].map(|lag| {
                let products = errors.iter().zip(&errors[lag..]).map(|(a, b)| a * b);
                products.sum::<f64>() / square * (errors.len() as f64).sqrt()
            })
        };
        for z in [correlation(SMOOTH), correlation(DISC)].concat() {
            assert!(z.abs() < 4.0, "{name}: correlated by {z:.1} standard deviations");
        }
    }
}

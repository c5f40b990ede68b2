//! What Sobol's numbers for a point on a light promise together with those of the pair before them: the four are
//! a (0,4)-sequence in base 4.

use runtime::kernel::f32::{self as single, SampleKey};
use tests::console;
use tests::kernel::Bench;
use tests::statistics::Mean;

use crate::SEED;
use crate::sobol::{Pair, part, points, sobol};
use crate::uniform::BOUNCES;

/// Every box of volume 4^-k whose sides are aligned powers of four holds one of 4^k points, whose four
/// numbers are those for a point on a light and those before them, at every aligned range of samples.
#[test]
fn every_box_of_four_sides_holds_one_point() {
    let bench = sobol();
    let mut kernel = bench.single();
    for bounce in BOUNCES {
        for k in 0..=5 {
            let n = 1 << (2 * k);
            for sample in [0, 5 * n, 1 << 24, u32::MAX - (n - 1)] {
                let key = SampleKey { pixel: 0x0010_0321 + k, sample, bounce, seed: SEED };
                let before = points(&mut kernel, key, Pair::BeforeLight, n);
                let light = points(&mut kernel, key, Pair::Light, n);
                for sides in splits(k) {
                    let mut seen = vec![false; n as usize];
                    for ([x, y], [z, w]) in before.iter().zip(&light) {
                        let parts = [x, y, z, w].into_iter().zip(sides);
                        let cell = parts
                            .fold(0, |cell, (x, side)| cell << (2 * side) | part(*x, 2 * side));
                        seen[cell as usize] = true;
                    }
                    let name = format!("bounce {bounce}, from {sample}, 4^{sides:?}");
                    assert!(seen.iter().all(|seen| *seen), "{name}");
                }
            }
        }
    }
}

/// All ways to write `k` as a sum of four.
fn splits(k: u32) -> impl Iterator<Item = [u32; 4]> {
    let pairs = (0..=k).flat_map(move |a| (0..=k - a).map(move |b| (a, b)));
    pairs.flat_map(move |(a, b)| (0..=k - a - b).map(move |c| [a, b, c, k - a - b - c]))
}

/// Faure's generators over the field of four elements, whose sum is `^` and whose product is this table.
#[test]
fn the_third_and_fourth_coordinates_are_faures() {
    const TIMES: [[u32; 4]; 4] = [[0; 4], [0, 1, 2, 3], [0, 2, 3, 1], [0, 3, 1, 2]];
    let bench = Bench::new();
    let mut kernel = bench.single();
    // w is 3 and w^2 is 2: 3 has both digits, w (1 0) of (1 1; 1 0).
    let digit = |x: u32, j: u32| x >> (2 * j) & 3;
    for i in (0..32).map(|k| 1 << k).chain((0..1000_u32).map(|i| i.wrapping_mul(2_654_435_761))) {
        let coordinate = |a: usize| {
            let element = |row: u32, column: u32| {
                // Lucas: a binomial coefficient is odd where one number's digits are among the other's.
                let odd = row & !column == 0;
                let power = (row..column).fold(1, |power, _| TIMES[power as usize][a]);
                if odd { TIMES[power as usize][digit(i, column) as usize] } else { 0 }
            };
            let row = |row| (row..16).fold(0, |sum, column| sum ^ element(row, column));
            (0..16).fold(0, |x, k| x | row(k) << (2 * k))
        };
        let mixed = |x: u32| x ^ x >> 1 & 0x5555_5555;
        assert_eq!(kernel.sobol_third(i), coordinate(2), "{i:#x}");
        assert_eq!(kernel.sobol_fourth(i), mixed(coordinate(3)), "{i:#x}");
        assert_eq!(kernel.sobol_pascal(i), mixed(coordinate(1)), "{i:#x}");
    }
}

/// What depends on all four numbers together: a product whose integral over any of them is 0. Independent
/// pairs do no better than chance.
#[test]
fn the_light_and_what_leads_to_it_are_even_together() {
    let n = 256;
    let bench = sobol();
    let mut kernel = bench.single();
    let mut rmse = |other: Pair| {
        let mut square = Mean::default();
        for pixel in 0..1024 {
            let key = SampleKey { pixel, sample: 0, bounce: 1, seed: SEED };
            let first = points(&mut kernel, key, other, n);
            let light = points(&mut kernel, key, Pair::Light, n);
            let term = |(p, q): (&[f32; 2], &[f32; 2])| -> f64 {
                p.iter().chain(q).map(|x| 12.0_f64.sqrt() * (f64::from(*x) - 0.5)).product()
            };
            let sum: f64 = first.iter().zip(&light).map(term).sum();
            square.add((sum / f64::from(n)).powi(2));
        }
        square.value().sqrt()
    };
    let (apart, together) = (rmse(Pair::Of(single::PURPOSE_DIRECTION)), rmse(Pair::BeforeLight));
    console::line(&format!("independent {apart:.2e}, together {together:.2e}"));
    let chance = 1.0 / f64::from(n).sqrt();
    assert!(apart > 0.9 * chance, "{apart}");
    assert!(together < 0.5 * chance, "{together}");
}

//! Noise and its octaves: range, seams, lattices, far coordinates, both precisions.

use glam::{DVec3, IVec3, Vec3};
use runtime::kernel::f64 as double;
use tests::kernel::Bench;
use tests::statistics::stream::Stream;
use tests::statistics::{ALPHA, Counts, Mean, index};

use crate::Worst;

fn cell(stream: &mut Stream) -> IVec3 {
    let mut axis = || stream.bits() as i32;
    IVec3::new(axis(), axis(), axis())
}

fn point(stream: &mut Stream, low: f64, high: f64) -> DVec3 {
    let mut axis = || stream.between(low, high);
    DVec3::new(axis(), axis(), axis())
}

#[test]
fn noise_has_its_range_and_its_mean() {
    let bench = Bench::new();
    let mut kernel = bench.single();
    let mut stream = Stream::new(61, 0);
    let (mut mean, mut square) = (Mean::default(), Mean::default());
    let (mut low, mut high) = (1.0_f32, 0.0_f32);
    for _ in 0..1_000_000 {
        let at = point(&mut stream, 0.0, 1.0).as_vec3();
        let value = kernel.noise_value(cell(&mut stream), at, 7);
        assert!((0.0..=1.0).contains(&value), "{value}");
        (low, high) = (low.min(value), high.max(value));
        mean.add(f64::from(value) - 0.5);
        square.add((f64::from(value) - 0.5).powi(2));
    }
    assert!(mean.value().abs() < 4.5 * mean.error(), "{} +- {}", mean.value(), mean.error());
    // It uses its range, and its spread is that of Perlin's noise: E g^2 of the blend, halved by the range.
    assert!(low < 0.1 && high > 0.9, "{low} {high}");
    assert!((square.value().sqrt() - 0.133).abs() < 0.003, "{}", square.value().sqrt());
}

/// The largest blend of slopes there is: every corner's slope points to the place, which a search finds.
#[test]
fn no_choice_of_slopes_leaves_the_range() {
    let slope = |d: DVec3| {
        let d = d.abs();
        d.x + d.y + d.z - d.min_element()
    };
    let fade = |t: f64| t * t * t * (t * (t * 6.0 - 15.0) + 10.0);
    let mut largest: f64 = 0.0;
    for i in 0..64_000_i32 {
        let at = DVec3::new(f64::from(i % 40), f64::from(i / 40 % 40), f64::from(i / 1600)) / 39.0;
        let mut sum = 0.0;
        for corner in 0..8_u32 {
            let far = DVec3::new(
                f64::from(corner & 1),
                f64::from(corner >> 1 & 1),
                f64::from(corner >> 2),
            );
            let share = |t: f64, f: f64| if f > 0.5 { fade(t) } else { 1.0 - fade(t) };
            let weight = share(at.x, far.x) * share(at.y, far.y) * share(at.z, far.z);
            sum += weight * slope(at - far);
        }
        largest = largest.max(sum);
    }
    assert!((1.03..=1.036_353_8).contains(&largest), "{largest}");
}

#[test]
fn neighbouring_cells_meet_without_a_seam() {
    let bench = Bench::new();
    let mut kernel = bench.double();
    let mut stream = Stream::new(67, 0);
    for _ in 0..20_000 {
        let here = cell(&mut stream);
        for axis in 0..3 {
            let (mut end, mut begin) = (point(&mut stream, 0.0, 1.0), IVec3::ZERO);
            end[axis] = 1.0;
            begin[axis] = 1;
            let mut start = end;
            start[axis] = 0.0;
            let a = kernel.noise_value(here, end, 3);
            let b = kernel.noise_value(here.wrapping_add(begin), start, 3);
            assert!((a - b).abs() < 1e-12, "{a} {b}");
        }
    }
}

/// The slope at a corner of the lattice, as a number below 27.
fn corner(kernel: &mut double::Kernel<'_>, at: IVec3, seed: u32) -> usize {
    let d = 1e-4;
    let mut code = 0;
    for axis in 0..3 {
        let mut step = DVec3::ZERO;
        step[axis] = d;
        let slope = (kernel.noise_value(at, step, seed) - 0.5) / (d * double::NOISE_HALF_RANGE);
        code = code * 3 + (slope.round() + 1.0) as usize;
    }
    code
}

/// Slopes of neighbours, of octaves and of seeds are independent: pairs fill their table evenly.
#[test]
fn slopes_of_neighbours_are_independent() {
    let bench = Bench::new();
    let mut kernel = bench.double();
    let n = 60_000;
    let mut single = vec![0.0; 27];
    let mut pairs = [(); 5].map(|()| vec![0.0; 27 * 27]);
    let mut stream = Stream::new(71, 0);
    for _ in 0..n {
        let at = cell(&mut stream);
        let seed = stream.bits() as u32;
        let first = corner(&mut kernel, at, seed);
        single[first] += 1.0;
        let others = [
            corner(&mut kernel, at.wrapping_add(IVec3::X), seed),
            corner(&mut kernel, at.wrapping_add(IVec3::Y), seed),
            corner(&mut kernel, at.wrapping_add(IVec3::Z), seed),
            corner(&mut kernel, at, seed ^ 1),
            corner(&mut kernel, at, seed.wrapping_add(0x9e37_79b9)),
        ];
        for (table, other) in pairs.iter_mut().zip(others) {
            table[first * 27 + other] += 1.0;
        }
    }
    // Twelve edges of a cube; four of them have two of the sixteen codes.
    assert_eq!(single.iter().filter(|count| **count > 0.0).count(), 12);
    let share = |count: f64| (count / f64::from(n) * 16.0).round() / 16.0;
    let shares: Vec<f64> = single.iter().map(|count| share(*count)).collect();
    assert!((shares.iter().sum::<f64>() - 1.0).abs() < 1e-12, "{shares:?}");
    let chi = |observed: &[f64], expected: &dyn Fn(usize) -> f64| {
        let mut counts = Counts::default();
        for (i, observed) in observed.iter().enumerate() {
            if expected(i) > 0.0 {
                counts.push(*observed, expected(i));
            } else {
                assert_eq!(*observed, 0.0);
            }
        }
        counts.p_value()
    };
    let p = chi(&single, &|i| shares[i] * f64::from(n));
    assert!(p > ALPHA / 6.0, "slopes alone: p = {p:.1e}");
    for (i, table) in pairs.iter().enumerate() {
        let p = chi(table, &|k| shares[k / 27] * shares[k % 27] * f64::from(n));
        assert!(p > ALPHA / 6.0, "pair {i}: p = {p:.1e}");
    }
}

/// Far from the origin single precision has few digits left of a coordinate; what there is of the field keeps its
/// range and its distribution, with no sign of a lattice.
#[test]
fn octaves_far_away_are_as_octaves_near_by() {
    let bench = Bench::new();
    let mut kernel = bench.single();
    let n = 40_000;
    let mut histogram = |low: f64, high: f64, seed: u64| {
        let mut bins = vec![0.0; 40];
        let mut stream = Stream::new(73, seed);
        for _ in 0..n {
            let p = point(&mut stream, low, high).as_vec3();
            let value = kernel.fbm_value(p, 16, 5);
            assert!((0.0..=1.0).contains(&value), "{p}: {value}");
            bins[index(f64::from(value), 40)] += 1.0;
        }
        bins
    };
    let near = histogram(0.0, 5e4, 0);
    for (i, low) in [1e6, -1.05e6, 3e5].into_iter().enumerate() {
        let far = histogram(low, low + 5e4, 1 + i as u64);
        // Two samples of the same size: (a - b)^2 / (a + b) sums to chi-square.
        let mut counts = Counts::default();
        for (a, b) in near.iter().zip(&far) {
            if a + b > 20.0 {
                counts.push(*a, 0.5 * (a + b));
                counts.push(*b, 0.5 * (a + b));
            }
        }
        let p = counts.p_value();
        assert!(p > ALPHA, "at {low}: p = {p:.1e}");
    }
    for far in [1e9, 1e20, f32::MAX, f32::INFINITY] {
        for p in [Vec3::splat(far), Vec3::new(-far, 0.0, far)] {
            let value = kernel.fbm_value(p, 16, 5);
            assert!((0.0..=1.0).contains(&value), "{p}: {value}");
        }
    }
}

/// Values over cells of the first octave's lattice: their means and spreads do not depend on where in the cell.
#[test]
fn the_sum_has_no_knots_on_its_lattice() {
    let bench = Bench::new();
    let mut kernel = bench.single();
    let mut stream = Stream::new(79, 0);
    let mut spread = |at: f64| {
        let mut square = Mean::default();
        for _ in 0..60_000 {
            let p = (point(&mut stream, -5e3, 5e3).floor() + DVec3::splat(at)).as_vec3();
            square.add((f64::from(kernel.fbm_value(p, 5, 11)) - 0.5).powi(2));
        }
        square.value().sqrt()
    };
    // At the corners the first octave is 1/2 always; the others are moved so that they are not.
    let (corner, middle) = (spread(0.0), spread(0.5));
    assert!(corner > 0.4 * middle, "{corner} at corners, {middle} in the middle");
}

#[test]
fn octaves_in_both_precisions() {
    let bench = Bench::new();
    let (mut single, mut double) = (bench.single(), bench.double());
    let mut stream = Stream::new(83, 0);
    let mut worst = Worst::default();
    for _ in 0..200_000 {
        let p = point(&mut stream, -40.0, 40.0).as_vec3();
        let truth = double.fbm_value(p.as_dvec3(), 4, 9);
        worst.add((f64::from(single.fbm_value(p, 4, 9)) - truth).abs(), p.x.into());
    }
    worst.check("fbm_value", 4e-7);
}

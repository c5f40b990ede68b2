//! The veranda around the hall: planks on posts, a lacquered railing, wooden steps in front.

use super::eaves::WALLS;
use super::hall::{Hall, rail_post};
use super::noise::Rng;

/// How far the veranda reaches beyond the walls; half the width of the steps.
const REACH: f64 = 1.25;
const STEPS_HALF: f64 = 1.6;

/// Adds the veranda with its floor's top at `floor`.
pub(super) fn veranda(hall: &mut Hall, floor: f64) {
    let (x, z) = (WALLS[0] + REACH, WALLS[1] + REACH);
    let mut rng = Rng::new(23);
    let planks = 62;
    for k in 0..planks {
        let at = |k: i32| -x + 2.0 * x * f64::from(k) / f64::from(planks);
        let top = floor + 0.006 * rng.bell();
        let end = z + 0.02 * rng.bell();
        hall.floor.bar([at(k) + 0.003, floor - 0.07, -end], [at(k + 1) - 0.003, top, end], 0.007);
    }
    hall.beams_x.bar([-x, floor - 0.26, z - 0.22], [x, floor - 0.07, z - 0.06], 0.015);
    hall.beams_x.bar([-x, floor - 0.26, 0.06 - z], [x, floor - 0.07, 0.22 - z], 0.015);
    for side in [-1.0, 1.0] {
        hall.beams_z.bar(
            [side * (x - 0.14) - 0.08, floor - 0.26, -z],
            [side * (x - 0.14) + 0.08, floor - 0.07, z],
            0.015,
        );
    }
    steps(hall, floor, z);
    railing(hall, floor, x - 0.1, z - 0.1);
}

fn steps(hall: &mut Hall, floor: f64, z: f64) {
    let n = 6;
    for k in 0..n {
        let top = floor * f64::from(k + 1) / f64::from(n + 1);
        let front = z + 0.30 * f64::from(n - k);
        hall.beams_x.bar([-STEPS_HALF, top - 0.16, front - 0.34], [STEPS_HALF, top, front], 0.02);
    }
    let low = z + 0.30 * f64::from(n);
    for side in [-1.0, 1.0] {
        let x = side * (STEPS_HALF + 0.06);
        rail_post(hall, x, low - 0.1, 0.1, true);
        rail_post(hall, x, z - 0.1, floor, true);
        for (up, size) in [(0.88, [0.08, 0.07]), (0.55, [0.05, 0.05])] {
            hall.rail.beam([x, 0.1 + up, low - 0.1], [x, floor + up, z - 0.1], size, 0.008);
        }
    }
}

fn railing(hall: &mut Hall, floor: f64, x: f64, z: f64) {
    let gap = STEPS_HALF + 0.06;
    // Runs along x in front and behind, along z at the sides.
    for (from, to, at) in [(-x, -gap, z), (gap, x, z), (-x, x, -z)] {
        for (up, h) in [(0.72, 0.08), (0.46, 0.05), (0.10, 0.07)] {
            hall.rail.bar(
                [from - 0.2, floor + up, at - 0.04],
                [to + if to > gap { 0.2 } else { 0.0 }, floor + up + h, at + 0.04],
                0.01,
            );
        }
        let n = libm::round((to - from) / 1.1) as i32;
        for k in 0..=n {
            let px = from + (to - from) * f64::from(k) / f64::from(n);
            rail_post(hall, px, at, floor, k == 0 || k == n);
        }
    }
    for side in [-1.0, 1.0] {
        for (up, h) in [(0.725, 0.08), (0.465, 0.05), (0.105, 0.07)] {
            hall.rail.bar(
                [side * x - 0.04, floor + up, -z - 0.2],
                [side * x + 0.04, floor + up + h, z + 0.2],
                0.01,
            );
        }
        for k in 1..8 {
            rail_post(hall, side * x, -z + 2.0 * z * f64::from(k) / 8.0, floor, false);
        }
    }
}

//! Stone stairs up the hill, with cheek walls, paving before and behind, and lacquered handrails.

use super::kit::{Mesh, Place, V3};
use super::land::{SHORE, STAIRS_BOTTOM, STAIRS_HALF_WIDTH, STAIRS_TOP, TERRACE, stairs_height};
use super::noise::Rng;

/// Steps in each of the two flights.
const STEPS: i32 = 13;

/// Height of the step (or landing) under `z`, which lies between bottom and top of the stairs.
pub(super) fn tread(z: f64) -> f64 {
    let run = STAIRS_BOTTOM - STAIRS_TOP;
    let t = (STAIRS_BOTTOM - z) / run;
    if t < 0.0 {
        return SHORE + 0.02;
    }
    let n = f64::from(STEPS);
    let flight = |t: f64| libm::floor(t / 0.44 * n + 1.0).clamp(1.0, n);
    let steps = if t < 0.44 {
        flight(t)
    } else if t < 0.56 {
        n
    } else {
        n + flight(t - 0.56)
    };
    SHORE + (TERRACE - SHORE) * steps / (2.0 * n)
}

/// Parts by material.
#[derive(Default)]
pub(super) struct Stairs {
    /// Steps, cheeks and paving.
    pub(super) stone: Mesh,
    /// Handrails and posts.
    pub(super) rail: Mesh,
    /// Caps of the posts.
    pub(super) bronze: Mesh,
}

/// The stairs.
pub(super) fn stairs() -> Stairs {
    let mut stairs = Stairs::default();
    let mut rng = Rng::new(5);
    let run = STAIRS_BOTTOM - STAIRS_TOP;
    let rise = (TERRACE - SHORE) / f64::from(2 * STEPS);
    for flight in 0..2 {
        let start = STAIRS_BOTTOM - run * if flight == 0 { 0.0 } else { 0.56 };
        let tread = 0.44 * run / f64::from(STEPS);
        for step in 0..STEPS {
            let top = SHORE + rise * f64::from(step + 1 + flight * STEPS);
            let z = start - tread * f64::from(step);
            row(&mut stairs.stone, top, [z - tread - 0.04, z], rise + 0.12, &mut rng);
        }
    }
    let middle = 0.5 * (SHORE + TERRACE);
    paving(
        &mut stairs.stone,
        [STAIRS_BOTTOM - 0.56 * run, STAIRS_BOTTOM - 0.44 * run],
        middle,
        STAIRS_HALF_WIDTH,
        &mut rng,
    );
    paving(
        &mut stairs.stone,
        [STAIRS_BOTTOM, STAIRS_BOTTOM + 3.1],
        SHORE + 0.02,
        STAIRS_HALF_WIDTH,
        &mut rng,
    );
    paving(
        &mut stairs.stone,
        [STAIRS_TOP - 6.2, STAIRS_TOP],
        TERRACE + 0.02,
        STAIRS_HALF_WIDTH + 0.3,
        &mut rng,
    );
    for side in [-1.0, 1.0] {
        cheek(&mut stairs, side, &mut rng);
    }
    stairs
}

/// One step of several blocks, none exactly where it was laid.
fn row(stone: &mut Mesh, top: f64, [z0, z1]: [f64; 2], deep: f64, rng: &mut Rng) {
    let mut x = -STAIRS_HALF_WIDTH;
    while x < STAIRS_HALF_WIDTH - 0.01 {
        let mut next = x + rng.range(0.65, 1.2);
        if next > STAIRS_HALF_WIDTH - 0.4 {
            next = STAIRS_HALF_WIDTH;
        }
        let at = [
            0.5 * (x + next),
            top - 0.5 * deep + 0.008 * rng.bell(),
            0.5 * (z0 + z1) + 0.012 * rng.bell(),
        ];
        let half = [0.5 * (next - x) - 0.006, 0.5 * deep, 0.5 * (z1 - z0)];
        stone.block(&Place::turned(at, 0.006 * rng.bell()), half, 0.022);
        x = next;
    }
}

/// Flagstones in rows between two z.
fn paving(stone: &mut Mesh, [z0, z1]: [f64; 2], top: f64, half_width: f64, rng: &mut Rng) {
    let rows = libm::round((z1 - z0) / 0.62).max(1.0);
    for k in 0..rows as i32 {
        let at = |k: i32| z0 + (z1 - z0) * f64::from(k) / rows;
        let mut x = -half_width;
        while x < half_width - 0.01 {
            let mut next = x + rng.range(0.55, 1.15);
            if next > half_width - 0.35 {
                next = half_width;
            }
            let middle =
                [0.5 * (x + next), top - 0.1 + 0.008 * rng.bell(), 0.5 * (at(k) + at(k + 1))];
            let half = [0.5 * (next - x) - 0.011, 0.1, 0.5 * (at(k + 1) - at(k)) - 0.011];
            let up = [0.012 * rng.bell(), 1.0, 0.012 * rng.bell()];
            stone.block(&Place::upright(middle, up, [1.0, 0.0, 0.0]), half, 0.018);
            x = next;
        }
    }
}

/// The sloping wall at one side, its coping, and the handrail on it.
fn cheek(stairs: &mut Stairs, side: f64, rng: &mut Rng) {
    let x = side * (STAIRS_HALF_WIDTH + 0.2);
    let run = STAIRS_BOTTOM - STAIRS_TOP;
    let n = 15;
    let at = |k: i32| STAIRS_BOTTOM + 0.25 - (run + 0.3) * f64::from(k) / f64::from(n);
    let p = |z: f64, up: f64| -> V3 { [x, stairs_height(z) + up, z] };
    for k in 0..n {
        let (a, b) = (at(k), at(k + 1));
        let jitter = 0.01 * rng.bell();
        stairs.stone.beam(
            p(a - 0.006, 0.05 + jitter),
            p(b + 0.006, 0.05 + jitter),
            [0.4, 0.5],
            0.03,
        );
    }
    let post = |z: f64| z - 0.02;
    let posts = 11;
    let z_at = |k: i32| STAIRS_BOTTOM - 0.1 - (run - 0.3) * f64::from(k) / f64::from(posts - 1);
    for k in 0..posts {
        let z = post(z_at(k));
        let big = k == 0 || k == posts - 1 || k == posts / 2;
        let (r, top) = if big { (0.085, 1.18) } else { (0.05, 0.98) };
        let place = Place::at(p(z, 0.2));
        stairs.rail.turned(&[[r, 0.0], [r, top], [0.0, top]], 24, &place);
        stairs.bronze.turned(&[[r + 0.02, 0.0], [r + 0.02, 0.06], [r + 0.004, 0.08]], 24, &place);
        if big {
            super::bridge::giboshi(&mut stairs.bronze, &Place::at(p(z, 0.2 + top)), r);
        }
        if k + 1 < posts {
            let next = post(z_at(k + 1));
            for (up, size) in [(1.08, [0.085, 0.075]), (0.72, [0.05, 0.05]), (0.42, [0.05, 0.05])] {
                stairs.rail.beam(p(z, up), p(next, up), size, 0.008);
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_stairs_join_shore_and_terrace() {
        assert!((stairs_height(STAIRS_BOTTOM) - SHORE).abs() < 1e-9);
        assert!((stairs_height(STAIRS_TOP) - TERRACE).abs() < 1e-9);
        assert!(stairs().stone.triangles() > 4_000);
    }
}

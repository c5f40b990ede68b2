//! What closes a roof where slopes meet: ridges, gables, the finials and logs of a shrine.

use super::kit::{Mesh, Place, V3, add, cross, normalize, scale, sub};
use super::roof::{EAVES, GABLE, Roof, height};

/// Everything above the tiles.
pub(super) fn ridges(roof: &mut Roof) {
    main_ridge(roof);
    for (sx, sz) in [(1.0, 1.0), (1.0, -1.0), (-1.0, 1.0), (-1.0, -1.0)] {
        let run = EAVES[0] - GABLE + 0.35;
        // The hip, from the corner inward, ending before the corner in an upturned tile.
        let hip = |t: f64| -> V3 {
            let d = 0.18 + (run - 0.18) * t;
            let (x, z) = (sx * (EAVES[0] - d), sz * (EAVES[1] - d));
            [x, height(sx * (EAVES[0] - d).max(GABLE + 1e-6), z), z]
        };
        stack(roof, &hip, 14, 0.26);
        // Along the edge of the gable, from the skirt up to the ridge.
        let edge = |t: f64| -> V3 {
            let (x, z) = (sx * (GABLE - 0.28), sz * (EAVES[1] - 2.6) * (1.0 - t));
            [x, height(x, z), z]
        };
        stack(roof, &edge, 16, 0.22);
    }
    for side in [-1.0, 1.0] {
        gable(roof, side);
        finial(roof, side);
    }
    for k in -3..=3 {
        let x = 1.12 * f64::from(k);
        let y = ridge_height(x) + 0.60;
        let log: Vec<V3> = [-0.62, -0.2, 0.2, 0.62].map(|z| [x, y, z]).to_vec();
        roof.rafters_z.tube(&log, &[0.125, 0.15, 0.15, 0.125], 24, 1.0);
        for sign in [-1.0, 1.0] {
            let place = Place::upright([x, y, 0.60 * sign], [0.0, 0.0, sign], [1.0, 0.0, 0.0]);
            roof.gold.turned(
                &[[0.135, -0.06], [0.135, 0.025], [0.11, 0.035], [0.0, 0.035]],
                24,
                &place,
            );
        }
        roof.gold.bar([x - 0.07, y - 0.22, -0.30], [x + 0.07, y - 0.12, 0.30], 0.01);
    }
}

fn ridge_height(x: f64) -> f64 {
    height(x, 0.0) + 0.30 * libm::pow(libm::fabs(x) / GABLE, 3.0)
}

/// Courses of flat tiles with round ones on top, along a path; `size` is the height.
fn stack(roof: &mut Roof, path: &dyn Fn(f64) -> V3, n: i32, size: f64) {
    for k in 0..n {
        let (a, b) = (path(f64::from(k) / f64::from(n)), path(f64::from(k + 1) / f64::from(n)));
        for (course, width) in [(0, 0.34), (1, 0.27), (2, 0.22)] {
            let y = size * (0.16 + 0.27 * f64::from(course));
            let lift = |p: V3| add(p, [0.0, y, 0.0]);
            roof.ridges.beam(lift(a), lift(b), [width, 0.24 * size], 0.012);
        }
        let lift = |p: V3, extra: f64| add(p, [0.0, size * 0.95 + extra, 0.0]);
        roof.ridges.tube(&[lift(a, 0.012), lift(b, 0.0)], &[0.10, 0.092], 14, 1.0);
    }
    // The demon tile at the lower end: a shield with shoulders.
    let (a, b) = (path(0.0), path(0.1));
    let out = normalize(sub(a, b));
    let flat = normalize([out[0], 0.0, out[2]]);
    let place = Place::upright(
        add(a, [0.0, 0.62 * size, 0.0]),
        [0.0, 1.0, 0.0],
        cross([0.0, 1.0, 0.0], flat),
    );
    roof.ridges.block(&place, [0.21, 0.20, 0.05], 0.03);
    let horn = |s: f64| add(place.point([0.17 * s, 0.2, 0.0]), scale(flat, 0.02));
    for s in [-1.0, 1.0] {
        let tip = add(horn(s), add(scale(flat, 0.05), [0.0, 0.14, 0.0]));
        roof.ridges.tube(&[horn(s), tip], &[0.05, 0.012], 10, 1.0);
    }
    let boss = Place::upright(place.point([0.0, 0.02, 0.0]), flat, [0.0, 1.0, 0.0]);
    roof.gold.turned(&[[0.11, 0.04], [0.11, 0.065], [0.07, 0.08], [0.0, 0.085]], 24, &boss);
}

fn main_ridge(roof: &mut Roof) {
    let n = 36;
    let x_at = |k: i32| -GABLE - 0.1 + (2.0 * GABLE + 0.2) * f64::from(k) / f64::from(n);
    for k in 0..n {
        let p = |k: i32, y: f64| -> V3 { [x_at(k), ridge_height(x_at(k)) + y, 0.0] };
        for (y, width, tall) in
            [(0.02, 0.50, 0.12), (0.12, 0.40, 0.07), (0.20, 0.42, 0.07), (0.28, 0.36, 0.07)]
        {
            roof.ridges.beam(p(k, y), p(k + 1, y), [width, tall], 0.014);
        }
        roof.ridges.tube(&[p(k, 0.37), p(k + 1, 0.36)], &[0.13, 0.122], 18, 1.0);
    }
    for side in [-1.0, 1.0] {
        let x = side * (GABLE + 0.14);
        let y = ridge_height(x);
        roof.ridges.block(&Place::at([x, y + 0.12, 0.0]), [0.06, 0.36, 0.34], 0.03);
        let boss =
            Place::upright([x + side * 0.05, y + 0.16, 0.0], [side, 0.0, 0.0], [0.0, 0.0, 1.0]);
        roof.gold.turned(&[[0.17, 0.0], [0.17, 0.03], [0.10, 0.05], [0.0, 0.055]], 28, &boss);
    }
}

/// The forked finial: two boards that cross over the gable.
fn finial(roof: &mut Roof, side: f64) {
    let x = side * (GABLE - 0.12);
    let y = ridge_height(x) + 0.05;
    for sign in [-1.0, 1.0] {
        let foot = [x + side * 0.06 * sign, y - 0.25, sign * 0.55];
        let top = [x + side * 0.06 * sign, y + 1.75, -sign * 0.98];
        roof.rafters_z.beam(foot, top, [0.09, 0.24], 0.015);
        let dir = normalize(sub(top, foot));
        for (t, half) in [(0.02, 0.11), (-0.70, 0.05), (-1.35, 0.05)] {
            let a = add(top, scale(dir, t - half));
            let b = add(top, scale(dir, t + half));
            roof.gold.beam(a, b, [0.105, 0.255], 0.01);
        }
    }
}

/// The wall of the gable with its bargeboards, struts and pendant.
fn gable(roof: &mut Roof, side: f64) {
    let wall = side * (GABLE - 0.72);
    let low = height(GABLE + 0.75, 0.0) - 0.3;
    let reach = EAVES[1] - 2.2;
    let n = 24;
    let z_at = |k: i32| reach * (2.0 * f64::from(k) / f64::from(n) - 1.0);
    let top = |z: f64| height(0.0, z) - 0.10;
    for k in 0..n {
        let (a, b) = (z_at(k), z_at(k + 1));
        let p = |z: f64, y: f64| -> V3 { [wall, y.max(low), z] };
        let quad = [p(b, low), p(a, low), p(a, top(a)), p(b, top(b))];
        let quad = if side > 0.0 { quad } else { [quad[1], quad[0], quad[3], quad[2]] };
        if top(a).max(top(b)) > low {
            roof.gables.quad(quad, [b - a, 1.0]);
        }
        // Bargeboard under the edge of the upper roof, and a gilded line on it.
        let x = side * (GABLE + 0.02);
        let at = |z: f64, y: f64| -> V3 { [x, height(0.0, z) + y, z] };
        roof.rafters_z.beam(at(a, -0.22), at(b, -0.22), [0.07, 0.34], 0.008);
        roof.gold.beam(at(a, -0.355), at(b, -0.355), [0.085, 0.035], 0.006);
    }
    for z in [-1.2, -0.4, 0.4, 1.2] {
        let p = |y: f64| -> V3 { [wall + side * 0.05, y, z] };
        roof.gables.beam(p(low), p(top(z)), [0.10, 0.10], 0.01);
    }
    roof.rafters_z.beam(
        [wall + side * 0.08, low + 0.55, -2.6],
        [wall + side * 0.08, low + 0.55, 2.6],
        [0.14, 0.26],
        0.015,
    );
    pendant(roof, side);
}

/// The gilded pendant under the peak of the gable.
fn pendant(roof: &mut Roof, side: f64) {
    let x = side * (GABLE + 0.07);
    let y = height(0.0, 0.0) - 0.45;
    let mut plate = Mesh::default();
    let outline = |a: f64| {
        let r = 0.26 * (1.0 + 0.22 * libm::cos(3.0 * a + 0.5 * std::f64::consts::PI));
        [0.0, r * 1.25 * libm::sin(a) - 0.12, r * libm::cos(a)]
    };
    let n = 48;
    for k in 0..n {
        let at = |k: i32| outline(std::f64::consts::TAU * f64::from(k) / f64::from(n));
        let (a, b) = (at(k), at(k + 1));
        let out = |p: V3| [0.03, p[1], p[2]];
        plate.flat_triangle([[0.05, -0.12, 0.0], out(b), out(a)], [[0.5; 2]; 3]);
        plate.quad([b, a, out(a), out(b)], [0.1, 0.1]);
    }
    let place = if side > 0.0 {
        Place::at([x, y, 0.0])
    } else {
        Place::turned([x, y, 0.0], std::f64::consts::PI)
    };
    roof.gold.append(&plate, &place);
}

//! The gate: two leaning pillars, two lintels, the upper one curved. Origin between the pillars'
//! feet, opening along z.

use super::kit::{Mesh, Place, V3};

/// Half the distance of the pillars at their feet, and the height of their tops, metres.
const HALF_SPAN: f64 = 2.15;
const TOP: f64 = 4.9;
/// How far the pillars lean inward on their way up, metres.
const LEAN: f64 = 0.16;

/// Parts by material.
#[derive(Default)]
pub(super) struct Torii {
    /// Vermilion lacquer.
    pub(super) red: Mesh,
    /// Black lacquer: roof of the lintel, feet of the pillars.
    pub(super) black: Mesh,
    /// Gilded fittings.
    pub(super) gold: Mesh,
    /// Foundation stones.
    pub(super) stone: Mesh,
    /// The tablet with the name, uv 0..1.
    pub(super) tablet: Mesh,
}

/// Height of the upper lintel's underside at `x`: it rises towards its ends.
fn lintel(x: f64) -> f64 {
    TOP + 0.012 * x * x + 0.0016 * x * x * x * x
}

/// The gate.
pub(super) fn torii() -> Torii {
    let mut gate = Torii::default();
    for side in [-1.0, 1.0] {
        pillar(&mut gate, side);
    }
    gate.red.bar([-HALF_SPAN - 0.75, 3.72, -0.11], [HALF_SPAN + 0.75, 4.06, 0.11], 0.02);
    gate.red.bar([-0.16, 4.06, -0.1], [0.16, lintel(0.0), 0.1], 0.02);
    for x in [-HALF_SPAN - 0.76, HALF_SPAN + 0.76] {
        gate.gold.bar([x - 0.012, 3.70, -0.13], [x + 0.012, 4.08, 0.13], 0.008);
    }
    curved(&mut gate.red, [0.0, 0.24], 0.17, 3.15);
    curved(&mut gate.red, [0.24, 0.44], 0.23, 3.45);
    curved(&mut gate.black, [0.44, 0.53], 0.33, 3.62);
    curved(&mut gate.black, [0.53, 0.60], 0.20, 3.60);
    for side in [-1.0, 1.0] {
        let end = |y: f64, x: f64| [side * x, lintel(x) + y, 0.0];
        let cap = |mesh: &mut Mesh, at: V3, half: V3| mesh.block(&Place::at(at), half, 0.006);
        cap(&mut gate.gold, end(0.34, 3.46), [0.012, 0.11, 0.24]);
        cap(&mut gate.gold, end(0.12, 3.16), [0.012, 0.12, 0.18]);
    }
    tablet(&mut gate);
    gate
}

fn pillar(gate: &mut Torii, side: f64) {
    let path: Vec<V3> = (0..=24)
        .map(|k| {
            let t = f64::from(k) / 24.0;
            [side * (HALF_SPAN - LEAN * t), 0.12 + (TOP - 0.02) * t, 0.0]
        })
        .collect();
    let radius: Vec<f64> = (0..=24).map(|k| 0.235 - 0.025 * f64::from(k) / 24.0).collect();
    gate.red.tube(&path, &radius, 48, 1.0);
    let foot = Place::at([side * HALF_SPAN, 0.1, 0.0]);
    gate.black.turned(&[[0.262, 0.0], [0.262, 0.62], [0.245, 0.66], [0.2, 0.66]], 48, &foot);
    gate.gold.turned(&[[0.268, 0.56], [0.268, 0.605], [0.2, 0.605]], 48, &foot);
    let base = Place::at([side * HALF_SPAN, -0.5, 0.0]);
    gate.stone.turned(
        &[[0.5, 0.0], [0.46, 0.5], [0.40, 0.6], [0.32, 0.66], [0.0, 0.66]],
        40,
        &base,
    );
    // Ring under the lintel, and the wedges of the tie beam.
    let head = Place::at([side * (HALF_SPAN - LEAN), TOP, 0.0]);
    gate.red.turned(&[[0.22, -0.16], [0.31, -0.12], [0.31, 0.02], [0.0, 0.02]], 48, &head);
    gate.gold.turned(&[[0.22, -0.20], [0.225, -0.20], [0.225, -0.165], [0.2, -0.165]], 48, &head);
    for toward in [-1.0, 1.0] {
        let x = side * (HALF_SPAN - 0.75 * LEAN) + toward * 0.30;
        gate.black.bar([x - 0.09, 4.06, -0.08], [x + 0.09, 4.14, 0.08], 0.012);
    }
}

/// A layer of the upper lintel between two heights above its underside.
fn curved(mesh: &mut Mesh, [low, high]: [f64; 2], half_depth: f64, half_length: f64) {
    let n = 48;
    let x_at = |u: f64, y: f64| (2.0 * u - 1.0) * (half_length + 0.25 * y);
    let place = |u: f64, y: f64, z: f64| {
        let x = x_at(u, y);
        [x, lintel(x) + y, z]
    };
    let c = 0.018;
    // The outline of the cross-section, counter-clockwise seen from +x.
    let (d, l, h) = (half_depth, low, high);
    let outline = [
        [l, d - c],
        [l + c, d],
        [h - c, d],
        [h, d - c],
        [h, c - d],
        [h - c, -d],
        [l + c, -d],
        [l, c - d],
        [l, d - c],
    ];
    for pair in outline.windows(2) {
        let ([y0, z0], [y1, z1]) = (pair[0], pair[1]);
        let strip = |u: f64, v: f64| place(u, y0 + (y1 - y0) * v, z0 + (z1 - z0) * v);
        mesh.grid([n, 1], [2.0 * half_length, 0.2], strip);
    }
    for (u, sign) in [(0.0, -1.0), (1.0, 1.0)] {
        let p = [
            place(u, l, sign * d),
            place(u, l, -sign * d),
            place(u, h, -sign * d),
            place(u, h, sign * d),
        ];
        mesh.quad(p, [0.3, 0.2]);
    }
}

fn tablet(gate: &mut Torii) {
    let place = Place::upright([0.0, 4.50, 0.21], [0.0, 1.0, 0.12], [1.0, 0.0, 0.0]);
    gate.black.block(&place, [0.29, 0.42, 0.03], 0.015);
    let p = |x: f64, y: f64| place.point([x, y, 0.034]);
    gate.tablet.quad([p(-0.21, -0.33), p(0.21, -0.33), p(0.21, 0.33), p(-0.21, 0.33)], [1.0, 1.0]);
    for (a, b) in [([-0.27, -0.40], [0.27, -0.35]), ([-0.27, 0.35], [0.27, 0.40])] {
        let at = place.point([0.0, 0.5 * (a[1] + b[1]), 0.04]);
        gate.gold.block(&Place { at, ..place }, [0.27, 0.025, 0.018], 0.008);
    }
    for x in [-0.245, 0.245] {
        let at = place.point([x, 0.0, 0.04]);
        gate.gold.block(&Place { at, ..place }, [0.025, 0.40, 0.018], 0.008);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_upper_lintel_rises_towards_its_ends() {
        assert!(lintel(3.4) - lintel(0.0) > 0.2);
        let gate = torii();
        let count: usize =
            [&gate.red, &gate.black, &gate.gold, &gate.stone].map(Mesh::triangles).iter().sum();
        assert!((5_000..40_000).contains(&count), "{count}");
    }
}

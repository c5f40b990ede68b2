//! The underside of the roof: boards, two tiers of rafters with gilded ends, fascia.

use super::kit::{V3, add};
use super::roof::{EAVES, Roof, height};

/// Half extents of the walls under the roof, metres.
pub(super) const WALLS: [f64; 2] = [5.6, 3.6];

/// Adds what is seen from below.
pub(super) fn eaves(roof: &mut Roof) {
    soffit(roof);
    let n = 26;
    for k in -n..=n {
        let x = (EAVES[0] - 0.35) * f64::from(k) / f64::from(n);
        for sign in [-1.0, 1.0] {
            // Rafters end at the hip.
            let inner = WALLS[1].max(EAVES[1] - (EAVES[0] - x.abs()));
            rafter(roof, sign, x, inner, true);
        }
    }
    let n = 19;
    for k in -n..=n {
        let z = (EAVES[1] - 0.35) * f64::from(k) / f64::from(n);
        for sign in [-1.0, 1.0] {
            let inner = WALLS[0].max(EAVES[0] - (EAVES[1] - z.abs()));
            rafter(roof, sign, z, inner, false);
        }
    }
    fascia(roof);
}

/// One rafter at `side` from the wall (or hip) at `inner` outward: a long lower one, and a flying
/// one above it that reaches the eave.
fn rafter(roof: &mut Roof, sign: f64, side: f64, inner: f64, along_z: bool) {
    let outer = if along_z { EAVES[1] } else { EAVES[0] };
    let at = |d: f64, drop: f64| -> V3 {
        let (x, z) = if along_z { (side, sign * d) } else { (sign * d, side) };
        [x, height(x, z) - drop, z]
    };
    if outer - inner < 0.5 {
        return;
    }
    let wood = if along_z { &mut roof.rafters_z } else { &mut roof.rafters_x };
    let knee = (outer - 0.95).max(inner);
    for (from, to, drop) in [(inner - 0.3, knee, 0.36), (knee - 0.25, outer - 0.12, 0.20)] {
        let middle = 0.5 * (from + to);
        wood.beam(at(from, drop), at(middle, drop), [0.085, 0.11], 0.008);
        wood.beam(at(middle, drop), at(to, drop), [0.085, 0.11], 0.008);
        let cap = [at(to - 0.012, drop), at(to + 0.012, drop)];
        roof.gold.beam(cap[0], cap[1], [0.092, 0.117], 0.005);
    }
}

fn soffit(roof: &mut Roof) {
    let strip = |u: f64, v: f64, sign: f64, along_z: bool| -> V3 {
        let (long, deep) = if along_z { (EAVES[0], EAVES[1]) } else { (EAVES[1], EAVES[0]) };
        let wall = if along_z { WALLS[1] } else { WALLS[0] };
        let d = (deep - 0.06) + (wall - deep - 0.1) * v;
        let half = (long - (deep - d)).max(1.0);
        let side = (2.0 * u - 1.0) * half;
        let (x, z) = if along_z { (side * sign, sign * d) } else { (sign * d, -side * sign) };
        add([x, height(x, z), z], [0.0, -0.13, 0.0])
    };
    for sign in [-1.0, 1.0] {
        for along_z in [true, false] {
            // Boards look down: u and v are exchanged.
            roof.soffit.grid([12, 96], [3.0, 16.0], |v, u| strip(u, v, sign, along_z));
        }
    }
}

fn fascia(roof: &mut Roof) {
    let n = 48;
    for k in 0..n {
        let t = |k: i32| 2.0 * f64::from(k) / f64::from(n) - 1.0;
        for sign in [-1.0, 1.0] {
            let front = |t: f64, drop: f64| -> V3 {
                let (x, z) = (t * (EAVES[0] - 0.05), sign * (EAVES[1] - 0.05));
                [x, height(x, z) - drop, z]
            };
            roof.rafters_x.beam(front(t(k), 0.07), front(t(k + 1), 0.07), [0.06, 0.12], 0.006);
            let end = |t: f64, drop: f64| -> V3 {
                let (x, z) = (sign * (EAVES[0] - 0.05), t * (EAVES[1] - 0.05));
                [x, height(x, z) - drop, z]
            };
            roof.rafters_z.beam(end(t(k), 0.07), end(t(k + 1), 0.07), [0.06, 0.12], 0.006);
        }
    }
}

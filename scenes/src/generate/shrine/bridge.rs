//! The arched bridge over the pond: planks, girders, lacquered railings, bronze caps. Along z, its
//! middle in the origin at water level.

use super::kit::{Mesh, Place, V3};

/// Half the length and half the width, metres.
pub(super) const HALF_LENGTH: f64 = 4.3;
const HALF_WIDTH: f64 = 1.15;

/// Height of the deck's top at `z`.
pub(super) fn deck(z: f64) -> f64 {
    let t = z / HALF_LENGTH;
    0.34 + 0.92 * (1.0 - t * t)
}

/// Parts by material.
#[derive(Default)]
pub(super) struct Bridge {
    /// Planks, grain across the bridge.
    pub(super) planks: Mesh,
    /// Girders below, grain along it.
    pub(super) girders: Mesh,
    /// Lacquered railing.
    pub(super) railing: Mesh,
    /// Caps and bands of bronze.
    pub(super) bronze: Mesh,
    /// Piers in the water.
    pub(super) piers: Mesh,
}

/// The bridge.
pub(super) fn bridge() -> Bridge {
    let mut bridge = Bridge::default();
    let planks = 46;
    for k in 0..planks {
        let at = |k: i32| -HALF_LENGTH + 2.0 * HALF_LENGTH * f64::from(k) / f64::from(planks);
        let (z0, z1) = (at(k) + 0.004, at(k + 1) - 0.004);
        let up: V3 = [0.0, z1 - z0, deck(z0) - deck(z1)];
        let wobble = 0.006 * libm::sin(17.0 * f64::from(k));
        let middle = [0.0, 0.5 * (deck(z0) + deck(z1)) - 0.035 + wobble, 0.5 * (z0 + z1)];
        let place = Place::upright(middle, up, [1.0, 0.0, 0.0]);
        bridge.planks.block(&place, [HALF_WIDTH + 0.05 + wobble, 0.035, 0.5 * (z1 - z0)], 0.008);
    }
    for x in [-0.95, 0.0, 0.95] {
        arch(&mut bridge.girders, [x, HALF_LENGTH], [-0.28, -0.075], 0.09);
    }
    for x in [-HALF_WIDTH, HALF_WIDTH] {
        railing(&mut bridge, x);
        for z in [-1.5, 1.5] {
            let foot = [x * 0.85, -1.2, z];
            bridge.piers.tube(&[foot, [x * 0.83, deck(z) - 0.2, z]], &[0.13, 0.12], 20, 1.0);
        }
    }
    for z in [-1.5, 1.5] {
        bridge.piers.bar(
            [-1.15, deck(z) - 0.50, z - 0.09],
            [1.15, deck(z) - 0.27, z + 0.09],
            0.015,
        );
    }
    bridge
}

/// A curved bar that follows the deck at `x` to both ends of `reach`, between two heights over it.
fn arch(mesh: &mut Mesh, [x, reach]: [f64; 2], [low, high]: [f64; 2], half: f64) {
    let n = 26;
    let at = |k: i32| -reach + 2.0 * reach * f64::from(k) / f64::from(n);
    let middle = 0.5 * (low + high);
    for k in 0..n {
        let p = |z: f64| [x, deck(z) + middle, z];
        mesh.beam(p(at(k) - 0.004), p(at(k + 1) + 0.004), [2.0 * half, high - low], 0.006);
    }
}

fn railing(bridge: &mut Bridge, x: f64) {
    arch(&mut bridge.railing, [x, HALF_LENGTH - 0.12], [0.86, 0.95], 0.06);
    arch(&mut bridge.railing, [x, HALF_LENGTH - 0.12], [0.52, 0.59], 0.035);
    arch(&mut bridge.railing, [x, HALF_LENGTH - 0.12], [0.12, 0.21], 0.045);
    let posts = 7;
    for k in 0..posts {
        let z =
            -HALF_LENGTH + 0.12 + (2.0 * HALF_LENGTH - 0.24) * f64::from(k) / f64::from(posts - 1);
        let ends = k == 0 || k == posts - 1;
        let (r, top) = if ends { (0.105, 1.12) } else { (0.07, 0.86) };
        let place = Place::at([x, deck(z), z]);
        bridge.railing.turned(&[[r, -0.35], [r, top]], 28, &place);
        bridge.bronze.turned(
            &[[r + 0.004, 0.30], [r + 0.008, 0.31], [r + 0.008, 0.38], [r + 0.004, 0.39]],
            28,
            &place,
        );
        if ends {
            giboshi(&mut bridge.bronze, &Place::at([x, deck(z) + top, z]), r);
        } else {
            bridge.bronze.turned(
                &[[0.075, 0.955], [0.075, 0.985], [0.04, 1.0], [0.0, 1.0]],
                24,
                &place,
            );
        }
    }
    let small = 36;
    for k in 0..small {
        let z =
            -HALF_LENGTH + 0.3 + (2.0 * HALF_LENGTH - 0.6) * f64::from(k) / f64::from(small - 1);
        bridge.railing.bar(
            [x - 0.018, deck(z) + 0.2, z - 0.018],
            [x + 0.018, deck(z) + 0.54, z + 0.018],
            0.004,
        );
    }
}

/// The onion-shaped cap of a post of radius `r`.
pub(super) fn giboshi(mesh: &mut Mesh, place: &Place, r: f64) {
    let profile = [
        [1.08, -0.5],
        [1.10, 0.0],
        [1.10, 0.5],
        [1.18, 0.55],
        [1.18, 0.75],
        [0.85, 0.85],
        [0.70, 1.05],
        [0.78, 1.2],
        [1.0, 1.45],
        [1.12, 1.75],
        [1.10, 2.05],
        [0.92, 2.35],
        [0.60, 2.62],
        [0.28, 2.85],
        [0.10, 3.1],
        [0.0, 3.25],
    ];
    let profile: Vec<[f64; 2]> = profile.iter().map(|[a, b]| [a * r, b * r]).collect();
    mesh.turned(&super::super::lathe::smooth_profile(&profile, 2), 24, place);
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_deck_is_an_arch_over_the_water() {
        assert!(deck(0.0) > 1.2 && (deck(HALF_LENGTH) - 0.34).abs() < 1e-12);
        let bridge = bridge();
        assert_eq!(bridge.planks.triangles(), 46 * 44);
    }
}

//! Lanterns: of stone at the path, of paper under lintel and eaves.

use super::kit::{Mesh, Place, V3};
use std::f64::consts::TAU;

/// Parts of a stone lantern about 2.1 m high, foot in the origin.
#[derive(Default)]
pub(super) struct StoneLantern {
    /// Everything of stone.
    pub(super) stone: Mesh,
    /// The panes of the fire box, which glow; uv 0..1.
    pub(super) pane: Mesh,
    /// Wooden bars before the panes.
    pub(super) bars: Mesh,
}

/// A stone lantern with six sides.
pub(super) fn stone_lantern() -> StoneLantern {
    let mut lantern = StoneLantern::default();
    let foot = Place::at([0.0; 3]);
    let stone = &mut lantern.stone;
    stone.turned(&[[0.48, -0.3], [0.48, 0.12], [0.44, 0.16], [0.0, 0.16]], 6, &foot);
    stone.turned(
        &[[0.37, 0.16], [0.37, 0.24], [0.30, 0.31], [0.21, 0.36], [0.17, 0.40]],
        24,
        &foot,
    );
    let shaft = [
        [0.165, 0.38],
        [0.155, 0.60],
        [0.175, 0.68],
        [0.185, 0.72],
        [0.175, 0.76],
        [0.155, 0.84],
        [0.165, 1.08],
    ];
    stone.turned(&shaft, 32, &foot);
    stone.turned(
        &[[0.17, 1.06], [0.24, 1.10], [0.37, 1.20], [0.39, 1.24], [0.39, 1.30], [0.0, 1.30]],
        6,
        &foot,
    );
    // Posts and frames of the fire box.
    for k in 0..6 {
        let at = |r: f64, y: f64, k: f64| -> V3 {
            let a = TAU * k / 6.0;
            [r * libm::cos(a), y, r * libm::sin(a)]
        };
        let k = f64::from(k);
        stone.beam(at(0.265, 1.30, k), at(0.265, 1.68, k), [0.07, 0.07], 0.01);
        for y in [1.325, 1.66] {
            stone.beam(at(0.262, y, k), at(0.262, y, k + 1.0), [0.05, 0.05], 0.008);
        }
        let p = [
            at(0.245, 1.34, k + 1.0),
            at(0.245, 1.34, k),
            at(0.245, 1.65, k),
            at(0.245, 1.65, k + 1.0),
        ];
        lantern.pane.quad(p, [1.0, 1.0]);
        let middle = |t: f64, y: f64| {
            let (a, b) = (at(0.257, y, k), at(0.257, y, k + 1.0));
            [a[0] + (b[0] - a[0]) * t, y, a[2] + (b[2] - a[2]) * t]
        };
        for t in [0.36, 0.64] {
            lantern.bars.beam(middle(t, 1.34), middle(t, 1.65), [0.014, 0.014], 0.002);
        }
        lantern.bars.beam(middle(0.1, 1.49), middle(0.9, 1.49), [0.012, 0.014], 0.002);
    }
    roof(stone);
    stone.turned(
        &[
            [0.10, 1.95],
            [0.13, 1.99],
            [0.085, 2.03],
            [0.11, 2.08],
            [0.115, 2.13],
            [0.07, 2.20],
            [0.0, 2.27],
        ],
        24,
        &foot,
    );
    lantern
}

/// Six-sided roof with lips that curl up at the corners.
fn roof(stone: &mut Mesh) {
    let corner = |a: f64| {
        let within = libm::fmod(a, TAU / 6.0) / (TAU / 6.0);
        let side = 2.0 * within - 1.0;
        (side * side, libm::cos(TAU / 12.0) / libm::cos(TAU / 12.0 * side))
    };
    // Rows from the inner underside over the rim to the top: radius and height.
    let rows = [
        [0.20, 1.69],
        [0.50, 1.70],
        [0.53, 1.73],
        [0.53, 1.76],
        [0.45, 1.79],
        [0.32, 1.85],
        [0.20, 1.92],
        [0.11, 1.97],
    ];
    let n = rows.len() - 1;
    stone.grid([n, 72], [1.0, 1.0], |u, v| {
        let x = (u * n as f64).min(n as f64 - 1e-9);
        let (k, t) = (x as usize, x - libm::floor(x));
        let [r, y] = [0, 1].map(|i| rows[k][i] + (rows[k + 1][i] - rows[k][i]) * t);
        let a = TAU * v;
        let (up, wide) = corner(a);
        let rim = (r / 0.53) * (r / 0.53);
        let r = r * wide * (1.0 + 0.10 * up * rim);
        [r * libm::cos(a), y + 0.09 * up * up * rim * rim, r * libm::sin(a)]
    });
}

/// Parts of a paper lantern about 0.62 m high, the hook in the origin, hanging down.
#[derive(Default)]
pub(super) struct PaperLantern {
    /// The ribbed paper, which glows; u around, v along.
    pub(super) paper: Mesh,
    /// Black rims and the cord.
    pub(super) rim: Mesh,
    /// Rings and tassel of brass.
    pub(super) brass: Mesh,
}

/// A paper lantern.
pub(super) fn paper_lantern() -> PaperLantern {
    let mut lantern = PaperLantern::default();
    let (top, height, ribs) = (-0.16, 0.46, 14.0);
    lantern.paper.grid([28, 24], [1.0, 1.0], |v, u| {
        let a = -TAU * u;
        let belly = libm::sqrt(libm::sin(std::f64::consts::PI * (0.11 + 0.78 * v)));
        let rib = libm::fabs(libm::sin(std::f64::consts::PI * ribs * v));
        let r = 0.205 * belly * (0.975 + 0.025 * rib);
        [r * libm::cos(a), top - height * v, r * libm::sin(a)]
    });
    // u around the lantern, v down it.
    for uv in &mut lantern.paper.0.uvs {
        uv.swap(0, 1);
    }
    let hook = Place::at([0.0, top, 0.0]);
    lantern.rim.turned(
        &[[0.0, -0.02], [0.118, -0.02], [0.128, 0.0], [0.128, 0.045], [0.118, 0.055], [0.0, 0.055]],
        32,
        &hook,
    );
    let low = Place::at([0.0, top - height, 0.0]);
    lantern.rim.turned(
        &[[0.0, -0.05], [0.105, -0.05], [0.126, -0.035], [0.126, 0.0], [0.118, 0.02], [0.0, 0.02]],
        32,
        &low,
    );
    lantern.brass.turned(&[[0.130, -0.004], [0.133, 0.008], [0.130, 0.02]], 32, &hook);
    lantern.brass.turned(&[[0.0, 0.055], [0.03, 0.06], [0.022, 0.08], [0.0, 0.085]], 20, &hook);
    lantern.rim.tube(&[[0.0; 3], [0.0, -0.09, 0.0]], &[0.006, 0.006], 8, 1.0);
    for k in 0..24 {
        let a = TAU * f64::from(k) / 24.0;
        let p = |r: f64, y: f64| [r * libm::cos(a), top - height + y, r * libm::sin(a)];
        lantern.brass.tube(
            &[p(0.012, -0.05), p(0.018, -0.10), p(0.022, -0.2)],
            &[0.003, 0.003, 0.002],
            4,
            1.0,
        );
    }
    lantern
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn paper_faces_outward_and_is_uv_mapped_once_around() {
        let paper = paper_lantern().paper.0;
        for (p, n) in paper.positions.iter().zip(&paper.normals) {
            assert!(p[0] * n[0] + p[2] * n[2] > 0.0, "{p:?} {n:?}");
        }
        assert!(paper.uvs.iter().flatten().all(|x| (0.0..=1.0).contains(x)));
    }

    #[test]
    fn the_roof_of_a_stone_lantern_faces_outward() {
        let mut stone = Mesh::default();
        roof(&mut stone);
        let around = stone.0.positions.iter().zip(&stone.0.normals);
        // The top, whose rows are above the rim.
        for (p, n) in around.filter(|(p, _)| p[1] > 1.9) {
            assert!(n[1] > 0.0, "{p:?} {n:?}");
        }
    }

    #[test]
    fn a_stone_lantern_has_six_panes() {
        assert_eq!(stone_lantern().pane.triangles(), 12);
    }
}

//! The hall under the roof: podium, columns, beams and brackets, paper windows, veranda. Origin on
//! the ground under the middle, front towards +z.

use super::bridge::giboshi;
use super::eaves::WALLS;
use super::kit::{Mesh, Place, V3};
use super::roof::height;

/// Heights over the ground: top of the podium, floor, lintel, tops of the columns.
const PODIUM: f64 = 0.75;
pub(super) const FLOOR: f64 = 1.15;
const LINTEL: f64 = 3.75;
const HEAD: f64 = 5.05;
/// Where columns stand along x and z.
const COLUMNS_X: [f64; 6] = [-5.6, -3.5, -1.6, 1.6, 3.5, 5.6];
const COLUMNS_Z: [f64; 4] = [3.6, 1.2, -1.2, -3.6];

/// Parts by material.
#[derive(Default)]
pub(super) struct Hall {
    /// Columns and wall boards, grain upright.
    pub(super) columns: Mesh,
    /// Beams, grain along x.
    pub(super) beams_x: Mesh,
    /// Beams, grain along z.
    pub(super) beams_z: Mesh,
    /// Floor planks, grain along z.
    pub(super) floor: Mesh,
    /// Lime plaster; texture coordinates are metres.
    pub(super) plaster: Mesh,
    /// Paper of the windows, glowing, uv 0..1 a pane.
    pub(super) paper: Mesh,
    /// Bars before the paper, lying and upright.
    pub(super) lattice_x: Mesh,
    pub(super) lattice_y: Mesh,
    /// The gilded screen inside.
    pub(super) screen: Mesh,
    /// Podium.
    pub(super) stone: Mesh,
    /// Railing of the veranda.
    pub(super) rail: Mesh,
    /// Its caps.
    pub(super) bronze: Mesh,
    /// Nail covers and bands.
    pub(super) gold: Mesh,
}

/// The hall, empty and without a veranda.
pub(super) fn hall() -> Hall {
    let mut hall = Hall::default();
    podium(&mut hall);
    for x in COLUMNS_X {
        for z in COLUMNS_Z {
            let inside = x.abs() < 5.0 && z.abs() < 3.0;
            if !inside {
                column(&mut hall, x, z);
            }
        }
    }
    beams(&mut hall);
    for pair in COLUMNS_X.windows(2) {
        bay(&mut hall, [pair[0], pair[1]], true);
        back_bay(&mut hall, [pair[0], pair[1]]);
    }
    for side in [-1.0, 1.0] {
        for pair in COLUMNS_Z.windows(2) {
            side_bay(&mut hall, side, [pair[1], pair[0]]);
        }
    }
    hall
}

/// What stands inside.
pub(super) fn furnish(hall: &mut Hall) {
    let screen = [[-3.0, FLOOR, -2.6], [3.0, FLOOR, -2.6], [3.0, 3.6, -2.6], [-3.0, 3.6, -2.6]];
    hall.screen.quad(screen, [3.0, 1.0]);
    hall.bronze.bar([-0.9, FLOOR, -2.2], [0.9, FLOOR + 0.85, -1.5], 0.03);
}

fn podium(hall: &mut Hall) {
    let (x, z) = (WALLS[0] + 1.6, WALLS[1] + 1.6);
    hall.stone.bar([-x, -0.6, -z], [x, 0.45, z], 0.04);
    hall.stone.bar([-x + 0.25, 0.40, -z + 0.25], [x - 0.25, PODIUM, z - 0.25], 0.05);
    for column in COLUMNS_X {
        for z in COLUMNS_Z {
            let place = Place::at([column, PODIUM, z]);
            hall.stone.turned(&[[0.36, 0.0], [0.36, 0.06], [0.29, 0.12], [0.0, 0.12]], 28, &place);
        }
    }
}

fn column(hall: &mut Hall, x: f64, z: f64) {
    let path: Vec<V3> = (0..=12)
        .map(|k| [x, PODIUM + 0.1 + (HEAD - PODIUM - 0.1) * f64::from(k) / 12.0, z])
        .collect();
    let radius: Vec<f64> =
        (0..=12).map(|k| 0.205 - 0.02 * libm::pow(f64::from(k) / 12.0, 2.0)).collect();
    hall.columns.tube(&path, &radius, 36, 1.0);
    let foot = Place::at([x, PODIUM + 0.1, z]);
    hall.gold.turned(&[[0.212, 0.0], [0.212, 0.16], [0.2, 0.17]], 36, &foot);
    let neck = Place::at([x, HEAD - 0.32, z]);
    hall.gold.turned(&[[0.19, 0.0], [0.195, 0.0], [0.195, 0.07], [0.19, 0.07]], 36, &neck);
    bracket(hall, x, z);
}

/// Bearing block, two crossed arms and small blocks on their ends.
fn bracket(hall: &mut Hall, x: f64, z: f64) {
    let y = HEAD;
    hall.beams_x.bar([x - 0.23, y, z - 0.23], [x + 0.23, y + 0.20, z + 0.23], 0.04);
    for tier in 0..2 {
        let (up, reach) = (y + 0.18 + 0.30 * f64::from(tier), 0.55 + 0.35 * f64::from(tier));
        hall.beams_x.bar([x - reach, up, z - 0.07], [x + reach, up + 0.16, z + 0.07], 0.03);
        hall.beams_z.bar([x - 0.07, up, z - reach], [x + 0.07, up + 0.16, z + reach], 0.03);
        for end in [-1.0, 1.0] {
            let r = (reach - 0.12) * end;
            hall.beams_x.bar(
                [x + r - 0.11, up + 0.15, z - 0.11],
                [x + r + 0.11, up + 0.29, z + 0.11],
                0.025,
            );
            hall.beams_z.bar(
                [x - 0.11, up + 0.15, z + r - 0.11],
                [x + 0.11, up + 0.29, z + r + 0.11],
                0.025,
            );
        }
    }
}

fn beams(hall: &mut Hall) {
    let [x, z] = WALLS;
    for (y, h) in [(FLOOR + 0.02, 0.24), (LINTEL, 0.26), (HEAD - 0.22, 0.24), (HEAD + 0.80, 0.28)] {
        for s in [-1.0, 1.0] {
            hall.beams_x.bar([-x - 0.55, y, s * z - 0.11], [x + 0.55, y + h, s * z + 0.11], 0.025);
            hall.beams_z.bar(
                [s * x - 0.11, y + 0.01, -z - 0.55],
                [s * x + 0.11, y + h + 0.01, z + 0.55],
                0.025,
            );
            for end in [-1.0, 1.0] {
                let (a, b) = (x + 0.552, y - 0.012);
                hall.gold.bar(
                    [end * a - 0.012, b, s * z - 0.122],
                    [end * a + 0.012, b + h + 0.024, s * z + 0.122],
                    0.008,
                );
            }
        }
    }
    // Nail covers on the lintel, in front of each column.
    for column in COLUMNS_X {
        let place =
            Place::upright([column, LINTEL + 0.13, z + 0.11], [0.0, 0.0, 1.0], [1.0, 0.0, 0.0]);
        hall.gold.turned(
            &[[0.12, 0.0], [0.11, 0.02], [0.06, 0.035], [0.03, 0.06], [0.0, 0.07]],
            6,
            &place,
        );
    }
    for k in -2..=2 {
        let at = 1.5 * f64::from(k);
        hall.beams_z.bar([at - 0.10, HEAD + 0.1, -z], [at + 0.10, HEAD + 0.36, z], 0.02);
    }
    // Long purlins under the rafters, outside of the walls.
    for s in [-1.0, 1.0] {
        let y = |x: f64| height(x, z + 0.9) - 0.62;
        hall.beams_x.bar(
            [-x - 1.2, y(0.0), s * (z + 0.9) - 0.09],
            [x + 1.2, y(0.0) + 0.2, s * (z + 0.9) + 0.09],
            0.02,
        );
    }
}

/// A bay of the front between two columns: the door in the middle, paper windows beside it.
fn bay(hall: &mut Hall, [x0, x1]: [f64; 2], front: bool) {
    let z = if front { WALLS[1] } else { -WALLS[1] };
    let (a, b) = (x0 + 0.19, x1 - 0.19);
    plaster(hall, [a, LINTEL + 0.24, z], [b, HEAD - 0.2, z]);
    if x1 - x0 > 3.0 {
        // The open door: leaves folded against the columns.
        for (edge, sign) in [(a, 1.0), (b, -1.0)] {
            let p = |d: f64, y: f64| -> V3 { [edge + sign * 0.02, y, z - 0.1 - d] };
            hall.columns.bar(p(1.2, FLOOR + 0.05), [edge + sign * 0.07, LINTEL, z - 0.1], 0.01);
        }
        return;
    }
    let sill = FLOOR + 0.95;
    for k in 0..7 {
        let at = |k: i32| a + (b - a) * f64::from(k) / 7.0;
        hall.columns.bar(
            [at(k) + 0.003, FLOOR + 0.2, z - 0.035],
            [at(k + 1) - 0.003, sill, z + 0.03],
            0.006,
        );
    }
    hall.beams_x.bar([a, sill, z - 0.07], [b, sill + 0.10, z + 0.07], 0.012);
    window(hall, [a, sill + 0.10], [b, LINTEL], z);
}

/// A paper window with its lattice, front towards +z.
fn window(hall: &mut Hall, [x0, y0]: [f64; 2], [x1, y1]: [f64; 2], z: f64) {
    let (columns, rows) = (6, 8);
    let x = |k: i32| x0 + (x1 - x0) * f64::from(k) / f64::from(columns);
    let y = |k: i32| y0 + (y1 - y0) * f64::from(k) / f64::from(rows);
    hall.paper.quad(
        [[x0, y0, z - 0.02], [x1, y0, z - 0.02], [x1, y1, z - 0.02], [x0, y1, z - 0.02]],
        [1.0, 1.0],
    );
    for k in 0..=columns {
        let w = if k % 3 == 0 { 0.035 } else { 0.013 };
        hall.lattice_y.bar([x(k) - w, y0, z - 0.015], [x(k) + w, y1, z + 0.03 + w], 0.003);
    }
    for k in 0..=rows {
        let w = if k == 0 || k == rows { 0.03 } else { 0.012 };
        hall.lattice_x.bar([x0, y(k) - w, z - 0.012], [x1, y(k) + w, z + 0.024 + w], 0.003);
    }
}

fn plaster(hall: &mut Hall, a: V3, b: V3) {
    hall.plaster.quad(
        [[a[0], a[1], a[2]], [b[0], a[1], a[2]], [b[0], b[1], a[2]], [a[0], b[1], a[2]]],
        [b[0] - a[0], b[1] - a[1]],
    );
}

fn back_bay(hall: &mut Hall, [x0, x1]: [f64; 2]) {
    let z = -WALLS[1];
    hall.plaster
        .quad([[x1, PODIUM, z], [x0, PODIUM, z], [x0, HEAD, z], [x1, HEAD, z]], [x1 - x0, 4.0]);
    hall.columns.quad(
        [
            [x0, PODIUM, z + 0.05],
            [x1, PODIUM, z + 0.05],
            [x1, HEAD, z + 0.05],
            [x0, HEAD, z + 0.05],
        ],
        [1.0, 1.0],
    );
}

/// A bay of a side wall: boards below, plaster above.
fn side_bay(hall: &mut Hall, side: f64, [z0, z1]: [f64; 2]) {
    let x = side * WALLS[0];
    let face = |low: f64, high: f64| {
        let p = [[x, low, z1], [x, low, z0], [x, high, z0], [x, high, z1]];
        if side > 0.0 { p } else { [p[1], p[0], p[3], p[2]] }
    };
    hall.plaster.quad(face(FLOOR + 1.0, HEAD), [z1 - z0, 3.0]);
    for k in 0..8 {
        let at = |k: i32| z0 + (z1 - z0) * f64::from(k) / 8.0;
        hall.columns.bar(
            [x - 0.04, FLOOR + 0.2, at(k) + 0.003],
            [x + 0.04, FLOOR + 1.05, at(k + 1) - 0.003],
            0.006,
        );
    }
    hall.beams_z.bar([x - 0.07, FLOOR + 1.0, z0], [x + 0.07, FLOOR + 1.12, z1], 0.012);
}

/// A post of the veranda's railing with its cap.
pub(super) fn rail_post(hall: &mut Hall, x: f64, z: f64, floor: f64, big: bool) {
    let (r, top) = if big { (0.075, 0.98) } else { (0.045, 0.80) };
    hall.rail.turned(&[[r, -0.2], [r, top], [0.0, top]], 24, &Place::at([x, floor, z]));
    if big {
        giboshi(&mut hall.bronze, &Place::at([x, floor + top, z]), r);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_front_has_four_windows_and_columns_reach_the_brackets() {
        let hall = hall();
        assert_eq!(hall.paper.triangles(), 4 * 2);
        let top = hall.columns.0.positions.iter().map(|p| p[1]).fold(0.0_f32, f32::max);
        assert!((f64::from(top) - HEAD).abs() < 1e-5);
    }
}

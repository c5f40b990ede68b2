//! The roof of the hall: hip below, gable above, concave and lifted at the corners; every tile of
//! it is there. Origin on the ground under the middle, ridge along x.

use super::kit::{Mesh, Place, V3, add, cross, normalize, scale, sub};
use std::f64::consts::PI;

/// Half extent of the eaves along x and z, of the upper roof along x, metres.
pub(super) const EAVES: [f64; 2] = [8.3, 6.2];
pub(super) const GABLE: f64 = 5.3;
/// Height of the eaves in their middle.
const EAVE_HEIGHT: f64 = 4.95;
/// Distance of tile columns, length of a tile, metres.
const PITCH: f64 = 0.27;
const TILE: f64 = 0.30;

/// Height over the eave at a horizontal distance from it: steeper towards the ridge.
fn profile(d: f64) -> f64 {
    0.40 * d + 0.062 * d * d
}

/// Height of the roof's surface; `upper`: the part between the gables, else the skirt.
fn surface(x: f64, z: f64, upper: bool) -> f64 {
    let (s, t) = (libm::fabs(x) / EAVES[0], libm::fabs(z) / EAVES[1]);
    let (dx, dz) = (EAVES[0] - libm::fabs(x), EAVES[1] - libm::fabs(z));
    let d = if upper { dz } else { dx.min(dz) };
    let corner = libm::pow(s, 4.0) * libm::pow(t, 4.0);
    let sweep = 0.16 * libm::pow(s, 4.0) * (0.4 + 0.6 * t) + 0.16 * libm::pow(t, 4.0) * s * s;
    EAVE_HEIGHT + profile(d) + 0.62 * corner + sweep
}

/// Height of the roof, whatever part is there.
pub(super) fn height(x: f64, z: f64) -> f64 {
    surface(x, z, libm::fabs(x) <= GABLE)
}

/// Parts by material.
#[derive(Default)]
pub(super) struct Roof {
    /// Cover tiles.
    pub(super) covers: Mesh,
    /// Pan tiles between them.
    pub(super) pans: Mesh,
    /// Round ends at the eaves, uv 0..1.
    pub(super) discs: Mesh,
    /// Ridges.
    pub(super) ridges: Mesh,
    /// Boards under the eaves.
    pub(super) soffit: Mesh,
    /// Rafters along z, and along x.
    pub(super) rafters_z: Mesh,
    /// Rafters along x, fascia boards and logs.
    pub(super) rafters_x: Mesh,
    /// Boards of the gables.
    pub(super) gables: Mesh,
    /// Gilded ends of rafters, of the finials, and ornaments.
    pub(super) gold: Mesh,
}

/// One slope: where a column at `side` is at distance `d` from its eave.
struct Slope {
    along_x: bool,
    sign: f64,
    upper: bool,
}

impl Slope {
    fn point(&self, side: f64, d: f64) -> V3 {
        let (x, z) = if self.along_x {
            (side, self.sign * (EAVES[1] - d))
        } else {
            (self.sign * (EAVES[0] - d), side)
        };
        [x, surface(x, z, self.upper), z]
    }

    /// Which way columns follow each other so that x cross along is up.
    fn side(&self) -> V3 {
        if self.along_x { [self.sign, 0.0, 0.0] } else { [0.0, 0.0, -self.sign] }
    }
}

/// The tiles of the roof.
pub(super) fn roof() -> Roof {
    let mut roof = Roof::default();
    for sign in [1.0, -1.0] {
        let columns = libm::floor(EAVES[0] / PITCH) as i32;
        for k in -columns..=columns {
            let x = f64::from(k) * PITCH;
            let upper = libm::fabs(x) <= GABLE;
            let end = if upper { EAVES[1] } else { EAVES[0] - libm::fabs(x) };
            column(&mut roof, &Slope { along_x: true, sign, upper }, x, end);
        }
        let columns = libm::floor(EAVES[1] / PITCH) as i32;
        for k in -columns..=columns {
            let z = f64::from(k) * PITCH;
            let end = (EAVES[1] - libm::fabs(z)).min(EAVES[0] - GABLE + 0.75);
            column(&mut roof, &Slope { along_x: false, sign, upper: false }, z, end);
        }
    }
    roof
}

/// A column of cover tiles and the pans to its right, from the eave to `end`.
fn column(roof: &mut Roof, slope: &Slope, side: f64, end: f64) {
    let n = libm::ceil(end / TILE) as i32;
    let across = slope.side();
    for k in 0..n {
        let (d0, d1) = (TILE * f64::from(k), (TILE * f64::from(k + 1)).min(end));
        if d1 - d0 < 0.03 {
            continue;
        }
        let wobble = 0.004 * libm::sin(12.9 * side + 78.2 * f64::from(k));
        let lift = |p: V3, y: f64| add(p, [0.0, y + wobble, 0.0]);
        let (a, b) = (slope.point(side, d0), slope.point(side, d1));
        cover(&mut roof.covers, lift(a, 0.035), lift(b, 0.02), across);
        let half = 0.5 * PITCH;
        let shift = scale(across, half);
        pan(&mut roof.pans, add(lift(a, 0.03), shift), add(lift(b, 0.0), shift), across);
    }
    let (a, b) = (slope.point(side, 0.0), slope.point(side, 0.2));
    disc(&mut roof.discs, add(a, [0.0, 0.045, 0.0]), normalize(sub(a, b)), across);
}

/// A half cylinder, a little wider at its lower end `a`.
fn cover(mesh: &mut Mesh, a: V3, b: V3, across: V3) {
    let along = normalize(sub(b, a));
    let up = normalize(cross(across, along));
    let segments = 8;
    let mut rows = [[0_u32; 9]; 4];
    let rings = [
        (a, 0.079, -0.3),
        (a, 0.091, 0.0),
        (add(a, scale(along, 0.05)), 0.092, 0.0),
        (b, 0.080, 0.0),
    ];
    for (row, (at, r, back)) in rings.into_iter().enumerate() {
        for (s, slot) in rows[row].iter_mut().enumerate() {
            let w = PI * s as f64 / f64::from(segments);
            let out = add(scale(across, libm::cos(w)), scale(up, libm::sin(w)));
            let n = if row == 0 { scale(along, -1.0) } else { add(out, scale(along, back)) };
            let uv = [s as f64 / 8.0, 1.0 - row as f64 / 3.0];
            *slot = mesh.vertex(add(at, scale(out, r)), normalize(n), uv);
        }
    }
    for (low, high) in [(0, 1), (1, 2), (2, 3)] {
        for s in 0..8 {
            let [p, q, r, t] = [rows[low][s], rows[low][s + 1], rows[high][s + 1], rows[high][s]];
            mesh.0.indices.extend([p, r, q, p, t, r]);
        }
    }
}

/// A shallow trough with a lip at its lower end `a`.
fn pan(mesh: &mut Mesh, a: V3, b: V3, across: V3) {
    let along = normalize(sub(b, a));
    let up = normalize(cross(across, along));
    let mut rows = [[0_u32; 5]; 3];
    let rings = [(add(a, scale(up, -0.035)), true), (a, false), (b, false)];
    for (row, (at, lip)) in rings.into_iter().enumerate() {
        for (s, slot) in rows[row].iter_mut().enumerate() {
            let t = s as f64 / 2.0 - 1.0;
            let p = add(at, add(scale(across, 0.5 * PITCH * t), scale(up, 0.035 * t * t)));
            let n =
                if lip { scale(along, -1.0) } else { normalize(sub(up, scale(across, 0.5 * t))) };
            *slot = mesh.vertex(p, n, [s as f64 / 4.0, 1.0 - 0.5 * row as f64]);
        }
    }
    for (low, high) in [(0, 1), (1, 2)] {
        for s in 0..4 {
            let [p, q, r, t] = [rows[low][s], rows[low][s + 1], rows[high][s + 1], rows[high][s]];
            mesh.0.indices.extend([p, q, r, p, r, t]);
        }
    }
}

/// The round end of a column at the eave, facing `out`.
fn disc(mesh: &mut Mesh, at: V3, out: V3, across: V3) {
    let place = Place::upright(at, out, across);
    let mut disc = Mesh::default();
    disc.turned(
        &[[0.10, -0.05], [0.10, 0.012], [0.085, 0.018], [0.0, 0.018]],
        20,
        &Place::at([0.0; 3]),
    );
    for (uv, p) in disc.0.uvs.iter_mut().zip(&disc.0.positions) {
        *uv = [0.5 + 5.0 * p[0], 0.5 + 5.0 * p[2]];
    }
    mesh.append(&disc, &place);
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn corners_are_lifted_and_the_ridge_is_highest() {
        let middle = height(0.0, EAVES[1]);
        assert!(height(EAVES[0], EAVES[1]) - middle > 0.5);
        assert!(height(0.0, 0.0) - middle > 4.0);
    }

    #[test]
    fn tiles_look_up() {
        let roof = roof();
        let up = roof.pans.0.normals.iter().filter(|n| n[1] > 0.2).count();
        assert!(up * 3 >= roof.pans.0.normals.len() * 2);
        assert!(roof.covers.triangles() > 100_000, "{}", roof.covers.triangles());
    }
}

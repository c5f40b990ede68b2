//! The lie of the land: shore, pond, hill with terrace, forest beyond. Height over the plane as one
//! function that everything stands on, and the mesh of it. The water's surface is at height 0.

use super::kit::{Mesh, V3};
use super::noise::{fbm, noise};

/// Height of the shore where the gate stands, and of the hall's terrace, metres.
pub(super) const SHORE: f64 = 0.34;
pub(super) const TERRACE: f64 = 5.3;
/// Half the width of the stairs, metres.
pub(super) const STAIRS_HALF_WIDTH: f64 = 2.0;
/// Where the stairs begin and end, along z.
pub(super) const STAIRS_BOTTOM: f64 = -0.6;
pub(super) const STAIRS_TOP: f64 = -12.6;
/// Middle and half axes of the pond.
pub(super) const POND: [f64; 2] = [-1.2, 9.2];
const POND_SIZE: [f64; 2] = [12.5, 6.4];

/// Middle of the tongue of land on the near side.
const TONGUE: [f64; 2] = [4.6, 13.5];

fn smooth(low: f64, high: f64, x: f64) -> f64 {
    let t = ((x - low) / (high - low)).clamp(0.0, 1.0);
    t * t * (3.0 - 2.0 * t)
}

/// How far outside of the pond's rim a point is: below 0 in the water, about metres.
pub(super) fn shore_distance(x: f64, z: f64) -> f64 {
    let (dx, dz) = ((x - POND[0]) / POND_SIZE[0], (z - POND[1]) / POND_SIZE[1]);
    let r = libm::sqrt(dx * dx + dz * dz);
    let wobble =
        0.11 * noise([0.28 * x, 0.0, 0.28 * z], 3) + 0.04 * noise([0.9 * x, 5.0, 0.9 * z], 3);
    let pond = (r - 1.0 + wobble) * 5.5;
    // The bridge lands on a tongue of land.
    let [dx, dz] = [x - TONGUE[0], z - TONGUE[1]];
    pond.max(6.6 + 3.0 * wobble - libm::sqrt(dx * dx + dz * dz))
}

/// Height of the ground, metres.
pub(super) fn height(x: f64, z: f64) -> f64 {
    let rough = 0.05 * fbm([0.6 * x, 0.0, 0.6 * z], 11);
    // The hill; at its sides it is pushed forward and is rounder.
    let side = libm::fabs(x);
    let forward = 2.2 * smooth(3.0, 16.0, side) + 1.2 * noise([0.13 * x, 2.0, 0.13 * z], 12);
    let climb = smooth(STAIRS_BOTTOM + 0.6 + forward, STAIRS_TOP - 0.4 + forward, z);
    let hill = SHORE + (TERRACE - SHORE) * climb;
    let valley = 2.6 * smooth(13.0, 34.0, side) + 1.5 * smooth(20.0, 50.0, side);
    let back =
        16.0 * smooth(-36.0, -88.0, z) * (0.75 + 0.5 * noise([0.035 * x, 9.0, 0.03 * z], 13));
    let away = smooth(2.6, 5.0, side) + smooth(-31.0, -36.0, z);
    let bumps = 0.35 * away.min(1.0) * fbm([0.16 * x, 4.0, 0.16 * z], 14);
    let land = hill + valley * smooth(14.0, -8.0, z) + back.max(0.0) + bumps + rough;
    let d = shore_distance(x, z);
    if d > 1.6 {
        return land;
    }
    let bed = -0.95 + 0.12 * noise([0.5 * x, 1.0, 0.5 * z], 15);
    let bank = SHORE - 0.04 + rough;
    let t = smooth(-1.5, 0.35, d);
    let near = bed + (bank - bed) * t;
    near + (land - near) * smooth(0.35, 1.6, d)
}

/// Normal of the ground.
pub(super) fn normal(x: f64, z: f64) -> V3 {
    let e = 0.05;
    let (dx, dz) = (height(x + e, z) - height(x - e, z), height(x, z + e) - height(x, z - e));
    super::kit::normalize([-dx, 2.0 * e, -dz])
}

/// Height of the stairs at `z`; they start at the shore and end on the terrace.
pub(super) fn stairs_height(z: f64) -> f64 {
    let (low, high) = (SHORE, TERRACE);
    let t = ((STAIRS_BOTTOM - z) / (STAIRS_BOTTOM - STAIRS_TOP)).clamp(0.0, 1.0);
    // A landing in the middle.
    let t = if t < 0.44 {
        t / 0.44 * 0.5
    } else if t < 0.56 {
        0.5
    } else {
        0.5 + (t - 0.56) / 0.44 * 0.5
    };
    low + (high - low) * t
}

/// Under stairs and paving the ground steps back so that it does not come through.
fn under_stones(x: f64, z: f64) -> f64 {
    let y = height(x, z);
    let inside = smooth(STAIRS_HALF_WIDTH + 0.55, STAIRS_HALF_WIDTH - 0.1, libm::fabs(x));
    if !(STAIRS_TOP - 6.0..=STAIRS_BOTTOM + 3.2).contains(&z) {
        return y;
    }
    let stone = stairs_height(z) - 0.35;
    y + (stone.min(y) - y) * inside
}

/// The ground, `n` by `n` quads, finer towards the pond; texture coordinates are metres.
pub(super) fn ground(n: usize) -> Mesh {
    let spread = |t: f64, near: f64| near * t + (1.0 - near) * t * t * t;
    let mut mesh = Mesh::default();
    let place = |u: f64, v: f64| {
        let x = 74.0 * spread(2.0 * u - 1.0, 0.22);
        let s = 2.0 * v - 1.0;
        let z = if s < 0.0 { 3.0 + 15.0 * spread(-s, 0.5) } else { 3.0 - 102.0 * spread(s, 0.16) };
        [x, under_stones(x, z), z]
    };
    mesh.grid([n, n], [1.0, 1.0], place);
    for (uv, p) in mesh.0.uvs.iter_mut().zip(&mesh.0.positions) {
        *uv = [p[0], p[2]];
    }
    mesh
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_pond_is_under_water_and_its_bank_is_not() {
        assert!(height(-5.0, POND[1]) < -0.6);
        assert!(height(0.0, 1.8) > 0.15, "{}", height(0.0, 1.8));
        for k in 0..80 {
            let x = -20.0 + 0.5 * f64::from(k);
            assert!(height(x, 17.5) > 0.1, "the pond ends at {x}: {}", height(x, 17.5));
        }
    }

    #[test]
    fn the_terrace_is_flat_enough_for_the_hall() {
        // Under the podium, which reaches from 0.6 m below the terrace to 0.45 m above it.
        for (x, z) in
            [-7.0, 0.0, 7.0].into_iter().flat_map(|x| [-27.0, -22.0, -17.0].map(|z| (x, z)))
        {
            let above = height(x, z) - TERRACE;
            assert!((-0.6..0.45).contains(&above), "{above} at ({x}, {z})");
        }
    }

    #[test]
    fn the_ground_looks_up() {
        let mesh = ground(24);
        assert!(mesh.0.normals.iter().all(|n| n[1] > 0.0));
    }
}

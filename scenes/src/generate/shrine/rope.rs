//! The sacred rope between the pillars of the gate, its tassels, and zigzag paper streamers.

use super::kit::{Mesh, Place, V3, add, scale};
use super::noise::Rng;
use std::f64::consts::{PI, TAU};

/// Half the length of the rope, and how far its middle hangs, metres.
const HALF: f64 = 1.95;
const SAG: f64 = 0.34;

/// Where the rope's axis runs, `t` in -1..1; its ends are at height 0.
pub(super) fn axis(t: f64) -> V3 {
    [HALF * t, SAG * (t * t - 1.0), 0.0]
}

/// Half the thickness: thin at the ends, thick in the middle.
fn half_thickness(t: f64) -> f64 {
    0.045 + 0.085 * libm::pow(libm::cos(0.5 * PI * t), 0.8)
}

/// Three strands wound around each other.
pub(super) fn rope() -> Mesh {
    let mut mesh = Mesh::default();
    let n = 220;
    for strand in 0..3 {
        let mut path = Vec::with_capacity(n + 1);
        let mut radius = Vec::with_capacity(n + 1);
        for k in 0..=n {
            let t = 2.0 * k as f64 / n as f64 - 1.0;
            let a = TAU * (7.5 * t + f64::from(strand) / 3.0);
            let r = half_thickness(t);
            let off = [0.0, 0.62 * r * libm::cos(a), 0.62 * r * libm::sin(a)];
            path.push(add(axis(t), off));
            radius.push(0.60 * r);
        }
        mesh.tube(&path, &radius, 14, 3.0);
    }
    let mut rng = Rng::new(71);
    for t in [-0.62, -0.21, 0.21, 0.62] {
        tassel(&mut mesh, add(axis(t), [0.0, -half_thickness(t), 0.0]), &mut rng);
    }
    // Loose straw at both ends.
    for side in [-1.0, 1.0] {
        for _ in 0..60 {
            let start = add(axis(side), scale(rng.direction(), 0.03));
            let end = add(
                start,
                [side * rng.range(0.05, 0.3), rng.range(-0.12, 0.1), rng.range(-0.08, 0.08)],
            );
            mesh.tube(&[start, end], &[0.006, 0.002], 4, 4.0);
        }
    }
    mesh
}

fn tassel(mesh: &mut Mesh, top: V3, rng: &mut Rng) {
    for _ in 0..90 {
        let a = rng.range(0.0, TAU);
        let r = rng.range(0.0, 0.035);
        let out = [libm::cos(a), 0.0, libm::sin(a)];
        let start = add(top, add(scale(out, 0.6 * r), [0.0, 0.02, 0.0]));
        let knee = add(top, add(scale(out, r), [0.0, -0.1, 0.0]));
        let end = add(top, add(scale(out, r * 2.4), [0.0, rng.range(-0.42, -0.34), 0.0]));
        mesh.tube(&[start, knee, end], &[0.006, 0.006, 0.004], 4, 4.0);
    }
    mesh.turned(
        &[[0.03, -0.03], [0.045, -0.01], [0.045, 0.01], [0.03, 0.03]],
        16,
        &Place::at(add(top, [0.0, -0.09, 0.0])),
    );
}

/// The cord of the lanterns between the gate, in the origin, and the old tree at `CORD`.
pub(super) fn cord() -> Mesh {
    let mut mesh = Mesh::default();
    let path: Vec<V3> = (0..=40)
        .map(|k| {
            let t = f64::from(k) / 40.0;
            add(scale(CORD, t), [0.0, -2.2 * t * (1.0 - t), 0.0])
        })
        .collect();
    mesh.tube(&path, &[0.011; 41], 8, 4.0);
    mesh
}

/// Where the cord ends, from where it begins; it sags by 0.55 m.
const CORD: V3 = [-5.8, -0.3, 2.1];

/// The paper streamers: five, each of four folded panels, uv 0..1 a panel.
pub(super) fn streamers() -> Mesh {
    let mut mesh = Mesh::default();
    for (k, t) in [-0.82, -0.415, 0.0, 0.415, 0.82].into_iter().enumerate() {
        let top = add(axis(t), [0.0, -0.8 * half_thickness(t), 0.02]);
        let turn = 0.35 * libm::sin(2.1 * k as f64 + 0.6);
        let place = Place::turned(top, turn);
        for panel in 0..4 {
            let (x, y) = (0.055 * f64::from(panel) - 0.08, -0.115 * f64::from(panel));
            let swing = |y: f64| 0.05 * libm::sin(4.0 * y + 1.3 * k as f64) - 0.06 * y * y;
            let tilt = if panel % 2 == 0 { 0.014 } else { -0.014 };
            mesh.grid([3, 4], [1.0, 1.0], |u, v| {
                let (px, py) = (x + 0.115 * u, y - 0.17 * v);
                place.point([px, py, swing(py) + tilt * (2.0 * u - 1.0)])
            });
        }
    }
    mesh
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_rope_hangs_between_its_ends() {
        assert!(axis(1.0)[1].abs() < 1e-12 && (axis(0.0)[1] + SAG).abs() < 1e-12);
        assert!(rope().triangles() > 3 * 220 * 28 - 1);
        assert_eq!(streamers().triangles(), 5 * 4 * 24);
    }
}

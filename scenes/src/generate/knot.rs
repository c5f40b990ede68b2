//! A torus knot spun from five strands: a closed mesh of a quarter of a million triangles, as OBJ.

use std::f64::consts::TAU;

use super::obj::{Grid, grid_obj};
use super::vector::{V3, add, cross, normalize, scale, sub};

/// Segments along the knot and around its section.
#[derive(Clone, Copy, Debug)]
pub(super) struct Resolution {
    along: usize,
    around: usize,
}

impl Resolution {
    /// 1,600 x 80 quads: 256,000 triangles.
    pub(super) const FULL: Self = Self { along: 1600, around: 80 };
}

/// Strands of the rope and how often they wind around it over the whole knot.
const STRANDS: f64 = 5.0;
const TWISTS: f64 = 14.0;

/// The (2, 3) torus knot, lying in the xz plane; `t` in 0..1, metres.
fn curve(t: f64) -> V3 {
    let (a, b) = (TAU * 2.0 * t, TAU * 3.0 * t);
    let r = 1.0 + 0.42 * libm::cos(b);
    [r * libm::cos(a), 0.42 * libm::sin(b), r * libm::sin(a)]
}

/// A point of the surface; `u` along the knot, `v` around it, both periodic in 0..1.
fn surface(u: f64, v: f64) -> V3 {
    let step = 1.0 / 8192.0;
    let tangent = normalize(sub(curve(u + step), curve(u - step)));
    // The knot never passes over its own axis, so the radial direction is a stable frame.
    let side = normalize(cross(tangent, cross(curve(u), tangent)));
    let other = cross(tangent, side);
    let angle = TAU * v;
    let lobes = libm::fabs(libm::cos(0.5 * STRANDS * (angle - TAU * TWISTS * u / STRANDS)));
    let radius = 0.17 * (0.80 + 0.28 * lobes);
    let (x, y) = (radius * libm::cos(angle), radius * libm::sin(angle));
    add(curve(u), add(scale(side, x), scale(other, y)))
}

/// The knot resting on the plane y = 0, about 2.8 m across.
pub(super) fn obj(resolution: Resolution) -> Vec<u8> {
    let mut grid = Grid::periodic(resolution.along, resolution.around, surface);
    grid.rest_on_ground();
    grid_obj("knot", &grid)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_knot_is_a_closed_surface_of_finite_points() {
        for i in 0..64 {
            let u = f64::from(i) / 64.0;
            let (start, end) = (surface(u, 0.0), surface(u + 1.0, 1.0));
            for k in 0..3 {
                assert!(start[k].is_finite());
                assert!((start[k] - end[k]).abs() < 1e-9, "open at u = {u}");
            }
        }
    }

    #[test]
    fn the_full_knot_has_at_least_two_hundred_thousand_triangles() {
        let text = String::from_utf8(obj(Resolution::FULL)).expect("OBJ is text");
        let triangles: usize =
            text.lines().filter(|l| l.starts_with("f ")).map(|l| l.split(' ').count() - 3).sum();
        assert_eq!(triangles, 2 * 1600 * 80);
        assert!(triangles >= 200_000);
    }
}

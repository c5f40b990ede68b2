//! The two parts of a triangle on the sides of a plane.
//!
//! Turns a triangle, the box that its part lies in, and an axis-parallel plane into the boxes of the
//! parts on both sides. The boxes contain the real parts: what is interpolated is computed in `f64`
//! and rounded outwards.

use super::fragment::{Bounds, Fragment, round_down, round_up};

/// A plane at right angles to an axis.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Plane {
    /// 0, 1, 2.
    pub(super) axis: usize,
    /// Coordinate along the axis.
    pub(super) at: f32,
}

/// An axis-aligned box that grows outwards.
struct Part {
    lo: [f32; 3],
    hi: [f32; 3],
}

impl Part {
    const EMPTY: Self = Self { lo: [f32::INFINITY; 3], hi: [f32::NEG_INFINITY; 3] };

    fn add(&mut self, lo: [f32; 3], hi: [f32; 3]) {
        for k in 0..3 {
            self.lo[k] = self.lo[k].min(lo[k]);
            self.hi[k] = self.hi[k].max(hi[k]);
        }
    }

    /// The part that lies in `outer`, if any; touching counts.
    fn within(&self, outer: &Bounds) -> Option<([f32; 3], [f32; 3])> {
        let (lo, hi) = (outer.lo3(), outer.hi3());
        let lo = [0, 1, 2].map(|k| self.lo[k].max(lo[k]));
        let hi = [0, 1, 2].map(|k| self.hi[k].min(hi[k]));
        (0..3).all(|k| lo[k] <= hi[k]).then_some((lo, hi))
    }
}

/// The parts of `piece` below and above `plane`; `None` unless there are both. `corners` are those of
/// the whole triangle, finite, of which `piece` holds a part.
pub(super) fn clip(
    piece: &Fragment,
    corners: &[[f32; 3]; 3],
    plane: Plane,
) -> Option<[Fragment; 2]> {
    let Plane { axis, at } = plane;
    let outer = piece.bounds();
    // What lies beyond the piece along the axis is cut away first.
    let (from, to) = (outer.lo[axis], outer.hi[axis]);
    let (mut low, mut high) = (Part::EMPTY, Part::EMPTY);
    for k in 0..3 {
        let (a, b) = (&corners[k], &corners[(k + 1) % 3]);
        let (a, b) = if a[axis] <= b[axis] { (a, b) } else { (b, a) };
        if a[axis] >= from {
            if a[axis] <= at {
                low.add(*a, *a);
            }
            if a[axis] >= at && a[axis] <= to {
                high.add(*a, *a);
            }
        }
        if b[axis] <= to {
            if b[axis] >= at {
                high.add(*b, *b);
            }
            if b[axis] <= at && b[axis] >= from {
                low.add(*b, *b);
            }
        }
        for x in [from, at, to] {
            if a[axis] < x && x < b[axis] {
                let (lo, hi) = crossing(a, b, Plane { axis, at: x });
                if x <= at {
                    low.add(lo, hi);
                }
                if x >= at {
                    high.add(lo, hi);
                }
            }
        }
    }
    let (low, high) = (low.within(&outer)?, high.within(&outer)?);
    Some([piece.with_box(low.0, low.1), piece.with_box(high.0, high.1)])
}

/// A box around the point where the edge from `a` to `b` crosses the plane, which lies strictly
/// between them.
fn crossing(a: &[f32; 3], b: &[f32; 3], plane: Plane) -> ([f32; 3], [f32; 3]) {
    let [p, q] = [a, b].map(|v| v.map(f64::from));
    let (axis, at) = (plane.axis, f64::from(plane.at));
    // Differences of `f32` numbers may round in `f64`; all errors together are below 8 ulp of the edge.
    let t = (at - p[axis]) / (q[axis] - p[axis]);
    let mut lo = [0.0; 3];
    let mut hi = [0.0; 3];
    for k in 0..3 {
        let room = libm::fabs(q[k] - p[k]) * 1e-15 * 2.0;
        let x = p[k] + t * (q[k] - p[k]);
        lo[k] = round_down(x - room).max(a[k].min(b[k]));
        hi[k] = round_up(x + room).min(a[k].max(b[k]));
    }
    (lo[axis], hi[axis]) = (plane.at, plane.at);
    (lo, hi)
}

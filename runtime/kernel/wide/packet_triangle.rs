//! A ray a lane against one triangle.
//!
//! Each lane does the operations of `triangle_intersect` (`shape/triangle.wgsl`, where it says why) in their order, so
//! that its bits are the same. Which hit counts is not decided here.

use crate::kernel::{Hit, Ray, TriangleShear, v};
use crate::target;
use glam::UVec4;
use kernel_f32::kernel::NONE;

/// Rays, and for each the frame in which it runs along z.
pub(crate) struct Sheared {
    shear: TriangleShear,
    /// For each axis of that frame: which one of the world it is.
    axes: [v::U; 3],
    origin: [v::F; 3],
}

/// A corner of a triangle in that frame.
struct Corner {
    x: v::F,
    y: v::F,
    z: v::F,
    /// `x` and `y` before the shear.
    plain: [v::F; 2],
}

impl Sheared {
    #[target]
    pub(crate) fn new(ray: &Ray, shear: TriangleShear) -> Self {
        let z = shear.axis;
        let x = v::select_u(v::eq_u(z, v::u(2)), v::u(0), v::add_u(z, v::u(1)));
        let y = v::select_u(v::eq_u(z, v::u(0)), v::u(2), v::sub_u(z, v::u(1)));
        let o = ray.origin;
        let along = |axis: v::U| {
            let x_or_y = v::select_f(v::eq_u(axis, v::u(0)), o.x, o.y);
            v::select_f(v::eq_u(axis, v::u(2)), o.z, x_or_y)
        };
        Self { shear, axes: [x, y, z], origin: [along(x), along(y), along(z)] }
    }

    /// The lanes of `active` whose lines meet triangle `i`, which is `rows` of the pack, at some distance; and where.
    #[target]
    #[inline]
    pub(crate) fn intersect(&self, rows: &[UVec4; 3], i: u32, active: v::B) -> Option<(v::B, Hit)> {
        let [a, b, c] = &[self.corner(rows[0]), self.corner(rows[1]), self.corner(rows[2])];
        let (inside, [w0, w1, w2]) = edges([a, b, c], rows, active);
        if !v::any(inside) {
            return None;
        }
        let det = v::add_f(v::add_f(w0, w1), w2);
        let depth = v::add_f(v::add_f(v::mul_f(w0, a.z), v::mul_f(w1, b.z)), v::mul_f(w2, c.z));
        let mut t = v::mul_f(v::div_f(depth, det), self.shear.inv_depth);
        let slope = self.shear.slope;
        for (k, slope) in [(1, slope.y), (0, slope.x)] {
            // In a plane across an axis; that of x counts where both do.
            let [p, q, r] = [a.plain[k], b.plain[k], c.plain[k]];
            let level = v::and_b(v::eq_f(p, q), v::eq_f(q, r));
            let flat = v::and_b(level, v::ne_f(slope, v::f(0.0)));
            if v::any(v::and_b(inside, flat)) {
                let there = v::mul_f(v::div_f(p, slope), self.shear.inv_depth);
                t = v::select_f(flat, there, t);
            }
        }
        let b = v::V2 { x: v::div_f(w1, det), y: v::div_f(w2, det) };
        let met = v::and_b(inside, v::ne_f(det, v::f(0.0)));
        Some((met, Hit { t, prim: v::u(i), b, instance: v::u(NONE) }))
    }

    #[target]
    #[inline]
    fn corner(&self, row: UVec4) -> Corner {
        let row = bytemuck::cast(row.to_array());
        let from = |k: usize| v::sub_f(v::word_f(row, self.axes[k]), self.origin[k]);
        let (x, y, z) = (from(0), from(1), from(2));
        let slope = self.shear.slope;
        Corner {
            x: v::sub_f(x, v::mul_f(slope.x, z)),
            y: v::sub_f(y, v::mul_f(slope.y, z)),
            z,
            plain: [x, y],
        }
    }
}

/// The lanes of `active` that pass the triangle on the inner side of its edges, and the weights of its corners. Swapped
/// ends only change the sign of an edge function, twice, unless a ray meets the edge.
#[target]
#[inline]
fn edges([a, b, c]: [&Corner; 3], rows: &[UVec4; 3], active: v::B) -> (v::B, [v::F; 3]) {
    let weights = [edge(b, c), edge(c, a), edge(a, b)];
    let [p0, p1, p2] = weights.map(|e| v::gt_f(e, v::f(0.0)));
    let [n0, n1, n2] = weights.map(|e| v::lt_f(e, v::f(0.0)));
    let sure = v::and_b(v::and_b(v::or_b(p0, n0), v::or_b(p1, n1)), v::or_b(p2, n2));
    if v::any(v::but_b(active, sure)) {
        return edges_in_order([a, b, c], rows, active);
    }
    let inside = v::or_b(v::and_b(v::and_b(p0, p1), p2), v::and_b(v::and_b(n0, n1), n2));
    (v::and_b(active, inside), weights)
}

/// The same with the ends of every edge in the order of their ids, where a ray meets one exactly.
#[target]
fn edges_in_order([a, b, c]: [&Corner; 3], rows: &[UVec4; 3], active: v::B) -> (v::B, [v::F; 3]) {
    let [p, q, r] = rows.map(|row| row.w);
    let [(in0, w0), (in1, w1), (in2, w2)] =
        [side(b, c, q > r), side(c, a, r > p), side(a, b, p > q)];
    let outside = v::or_b(v::xor_b(in0, in1), v::xor_b(in1, in2));
    (v::but_b(active, outside), [w0, w1, w2])
}

/// The edge function of two corners.
#[target]
#[inline]
fn edge(p: &Corner, q: &Corner) -> v::F {
    v::sub_f(v::mul_f(p.x, q.y), v::mul_f(p.y, q.x))
}

/// The lanes on the inner side of an edge, one that is met exactly counts as moved; and the weight of the corner
/// opposite.
#[target]
fn side(a: &Corner, b: &Corner, swap: bool) -> (v::B, v::F) {
    let (p, q) = if swap { (b, a) } else { (a, b) };
    let (e, zero) = (edge(p, q), v::f(0.0));
    let moved = v::select_f(v::eq_f(q.y, p.y), v::sub_f(p.x, q.x), v::sub_f(q.y, p.y));
    let side = v::select_f(v::eq_f(e, zero), moved, e);
    let inside = v::xor_b(v::gt_f(side, zero), v::b(swap));
    (inside, if swap { v::neg_f(e) } else { e })
}

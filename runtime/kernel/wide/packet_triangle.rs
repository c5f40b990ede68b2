//! A ray a lane against one triangle.
//!
//! Each lane does the operations of `triangle_intersect` (`shape/triangle.wgsl`, where it says why) in their order, so
//! that its bits are the same. Which hit counts is not decided here.

use crate::kernel::{Ray, TriangleShear, v};
use crate::target;
use std::borrow::Borrow;

/// Rays, and for each the frame in which it runs along z.
pub(crate) struct Sheared {
    shear: TriangleShear,
    /// For each axis of that frame: which one of the world it is.
    axes: [v::U; 3],
    origin: [v::F; 3],
    /// The lanes that run across the planes in which x or y does not change.
    steep: [v::B; 2],
}

/// Where a ray a lane meets the plane of a triangle.
pub(crate) struct Crossing {
    /// Distance along the ray.
    pub(crate) t: v::F,
    /// Weights of the second and the third corner, and the sum of all three.
    w1: v::F,
    w2: v::F,
    det: v::F,
}

impl Crossing {
    /// Barycentric weights of the second and the third corner.
    #[target]
    #[inline]
    pub(crate) fn b(&self) -> v::V2<v::F> {
        v::V2 { x: v::div_f(self.w1, self.det), y: v::div_f(self.w2, self.det) }
    }
}

/// A corner of a triangle in that frame.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Corner {
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
        let slope = shear.slope;
        Self {
            shear,
            axes: [x, y, z],
            origin: [along(x), along(y), along(z)],
            steep: [v::ne_f(slope.x, v::f(0.0)), v::ne_f(slope.y, v::f(0.0))],
        }
    }

    /// The lanes of `active` whose rays may meet the triangle with these corners and their ids, before `t_max` or there;
    /// and where.
    #[target]
    #[inline]
    pub(crate) fn intersect(
        &self,
        corners: &[impl Borrow<Corner>; 3],
        ids: [u32; 3],
        active: v::B,
        t_max: v::F,
    ) -> Option<(v::B, Crossing)> {
        let [a, b, c] = corners.each_ref().map(Borrow::borrow);
        let (inside, [w0, w1, w2]) = edges([a, b, c], ids, active)?;
        let det = v::add_f(v::add_f(w0, w1), w2);
        let depth = v::add_f(v::add_f(v::mul_f(w0, a.z), v::mul_f(w1, b.z)), v::mul_f(w2, c.z));
        let (mut above, mut below) = (depth, det);
        let slope = [self.shear.slope.x, self.shear.slope.y];
        for k in [1, 0] {
            // In a plane across an axis; that of x counts where both do.
            let [p, q, r] = [a.plain[k], b.plain[k], c.plain[k]];
            let level = v::and_b(v::eq_f(p, q), v::eq_f(q, r));
            let flat = v::and_b(level, self.steep[k]);
            above = v::select_f(flat, p, above);
            below = v::select_f(flat, slope[k], below);
        }
        // Most of what lies behind is known by its sign, before the slow division.
        let inv_depth = self.shear.inv_depth;
        let ahead = v::and_b(inside, same_sign(above, below, inv_depth));
        if !v::any(ahead) {
            return None;
        }
        let t = v::mul_f(v::div_f(above, below), inv_depth);
        let near = v::and_b(v::gt_f(t, v::f(0.0)), v::le_f(t, t_max));
        let met = v::and_b(v::and_b(ahead, near), v::ne_f(det, v::f(0.0)));
        v::any(met).then_some((met, Crossing { t, w1, w2, det }))
    }

    /// A corner in the frame of each ray; the last number counts for nothing.
    #[target]
    #[inline]
    pub(crate) fn corner(&self, row: [f32; 4]) -> Corner {
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

/// The lanes of `active` that pass the triangle on the inner side of its edges, if any, and the weights of its corners.
/// Swapped ends only change the sign of an edge function, twice, unless a ray meets the edge.
#[target]
#[inline]
fn edges([a, b, c]: [&Corner; 3], ids: [u32; 3], active: v::B) -> Option<(v::B, [v::F; 3])> {
    let weights = [edge(b, c), edge(c, a), edge(a, b)];
    let [w0, w1, w2] = weights;
    let zero = v::f(0.0);
    let low = v::min_f(w0, v::min_f(w1, w2));
    let high = v::max_f(w0, v::max_f(w1, w2));
    // Two weights of opposite signs: outside, whatever the third is.
    let inside = v::but_b(active, v::and_b(v::lt_f(low, zero), v::gt_f(high, zero)));
    if !v::any(inside) {
        return None;
    }
    let sum = v::add_f(v::add_f(w0, w1), w2);
    let all = v::or_b(v::gt_f(low, zero), v::lt_f(high, zero));
    // A weight that is no number may be missing from `low` and `high`; the sum has it.
    let sure = v::and_b(all, v::eq_f(sum, sum));
    if v::any(v::but_b(inside, sure)) {
        return edges_in_order([a, b, c], ids, active);
    }
    Some((inside, weights))
}

/// The same with the ends of every edge in the order of their ids, where a ray meets one exactly.
#[target]
fn edges_in_order(
    [a, b, c]: [&Corner; 3],
    ids: [u32; 3],
    active: v::B,
) -> Option<(v::B, [v::F; 3])> {
    let [p, q, r] = ids;
    let [(in0, w0), (in1, w1), (in2, w2)] =
        [side(b, c, q > r), side(c, a, r > p), side(a, b, p > q)];
    let outside = v::or_b(v::xor_b(in0, in1), v::xor_b(in1, in2));
    let inside = v::but_b(active, outside);
    v::any(inside).then_some((inside, [w0, w1, w2]))
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

/// The lanes in which none or two of the three have a minus sign.
#[target]
#[inline]
fn same_sign(a: v::F, b: v::F, c: v::F) -> v::B {
    let signs = v::xor_u(v::xor_u(v::u_bits_f(a), v::u_bits_f(b)), v::u_bits_f(c));
    v::lt_u(signs, v::u(1 << 31))
}

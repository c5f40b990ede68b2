//! Leaves: four triangles at a time.
//!
//! Each lane does the operations of `triangle_intersect` (`shape/triangle.wgsl`, where it says why) in
//! their order, so that its bits are the same. Which hit counts is then asked one by one.

use crate::kernel::f32::{
    CHILD_COUNT_SHIFT, CHILD_FIRST, CHILD_SPHERES, Hit, Kernel, MOVES, Ray, TriangleShear,
};
use glam::{UVec4, Vec2, Vec3};
use wide::{f32x4, i32x4};

/// Triangles that are tested together.
const WIDTH: u32 = 4;

/// The better of `best` and the hits in the leaf with reference `child`.
#[inline]
pub(super) fn leaf(
    kernel: &mut Kernel<'_>,
    child: u32,
    ray: &Ray,
    shear: &TriangleShear,
    best: Hit,
) -> Hit {
    if child & CHILD_SPHERES != 0 {
        return kernel.leaf_trace(child, *ray, *shear, best);
    }
    let mut first = child & CHILD_FIRST;
    let end = first + ((child >> CHILD_COUNT_SHIFT) & 7) + 1;
    let mut hit = best;
    while first < end {
        let next = (first + WIDTH).min(end);
        // A lane without a triangle of its own repeats the last one.
        let corners = [0, 1, 2, 3].map(|lane| corners(kernel, (first + lane).min(next - 1)));
        let [Some(a), Some(b), Some(c), Some(d)] = corners else {
            return kernel.triangles_trace(first, end - first, *ray, *shear, hit);
        };
        if (a[0].w | b[0].w | c[0].w | d[0].w) & MOVES != 0 {
            return kernel.triangles_trace(first, end - first, *ray, *shear, hit);
        }
        let met = Lanes::intersect([a, b, c, d], ray.origin, shear);
        let mut left = met.hits & ((1 << (next - first)) - 1);
        while left != 0 {
            let lane = left.trailing_zeros();
            left &= left - 1;
            let (i, k) = (first + lane, lane as usize & 3);
            let (t, weights) = (met.t[k], Vec2::new(met.b1[k], met.b2[k]));
            let accepted = kernel.triangles_accept(hit, t, i, ray.instance)
                && !kernel.triangles_skipped(i, *ray);
            if accepted && kernel.candidate_triangle(i, weights, *ray) {
                hit = Hit { t, prim: i, b: weights, instance: ray.instance };
            }
        }
        first = next;
    }
    hit
}

/// The three corners of a triangle with their ids.
#[inline]
fn corners(kernel: &Kernel<'_>, i: u32) -> Option<[UVec4; 3]> {
    kernel.tri_words.get(3 * i as usize..)?.first_chunk().copied()
}

/// What a ray and four triangles have in common.
struct Lanes {
    /// One bit a lane: it is hit, at a distance above 0.
    hits: u32,
    t: [f32; 4],
    b1: [f32; 4],
    b2: [f32; 4],
}

/// One corner of four triangles, seen along the ray, and its ids.
struct Corner {
    x: f32x4,
    y: f32x4,
    z: f32x4,
    id: i32x4,
}

impl Corner {
    /// Corner `k`, sheared.
    #[inline]
    fn new(tris: &[[UVec4; 3]; 4], k: usize, origin: Vec3, shear: &TriangleShear) -> Self {
        let row = |lane: usize| {
            // Integers do not become floats.
            let [x, y, z, _] = tris[lane][k].to_array().map(f32::from_bits);
            f32x4::new([x, y, z, 0.0])
        };
        let [x, y, z, _] = f32x4::transpose([row(0), row(1), row(2), row(3)]);
        let x = x - f32x4::splat(origin.x);
        let y = y - f32x4::splat(origin.y);
        let z = z - f32x4::splat(origin.z);
        let (x, y, z) = match shear.axis {
            0 => (y, z, x),
            1 => (z, x, y),
            _ => (x, y, z),
        };
        // Below 2^31: triangles that move are not seen here.
        let id = i32x4::new([0, 1, 2, 3].map(|lane| tris[lane][k].w.cast_signed()));
        Self { x: x - z * shear.slope.x, y: y - z * shear.slope.y, z, id }
    }
}

/// The edge function of two corners, evaluated in the order of their ids.
struct Edge {
    e: f32x4,
    swap: f32x4,
    p: [f32x4; 2],
    q: [f32x4; 2],
}

impl Edge {
    #[inline]
    fn new(a: &Corner, b: &Corner) -> Self {
        let swap: f32x4 = bytemuck::cast(a.id.simd_gt(b.id));
        let px = swap.bitselect(b.x, a.x);
        let py = swap.bitselect(b.y, a.y);
        let qx = swap.bitselect(a.x, b.x);
        let qy = swap.bitselect(a.y, b.y);
        Self { e: px * qy - py * qx, swap, p: [px, py], q: [qx, qy] }
    }

    /// The lanes on the inner side; an edge that is met exactly counts as moved.
    #[inline]
    fn inside(&self, zero: bool) -> f32x4 {
        let mut side = self.e;
        if zero {
            let ([px, py], [qx, qy]) = (self.p, self.q);
            let moved = qy.simd_eq(py).bitselect(px - qx, qy - py);
            side = self.e.simd_eq(f32x4::ZERO).bitselect(moved, self.e);
        }
        side.simd_gt(f32x4::ZERO) ^ self.swap
    }

    /// The weight of the corner opposite.
    #[inline]
    fn weight(&self) -> f32x4 {
        self.e ^ (self.swap & f32x4::splat(-0.0))
    }
}

impl Lanes {
    #[inline]
    fn intersect(tris: [[UVec4; 3]; 4], origin: Vec3, shear: &TriangleShear) -> Self {
        let [a, b, c] = [0, 1, 2].map(|k| Corner::new(&tris, k, origin, shear));
        let edges = [Edge::new(&b, &c), Edge::new(&c, &a), Edge::new(&a, &b)];
        let [e0, e1, e2] = [&edges[0].e, &edges[1].e, &edges[2].e].map(|e| e.simd_eq(f32x4::ZERO));
        let zero = (e0 | e1 | e2).any();
        let [in0, in1, in2] = [0, 1, 2].map(|k| edges[k].inside(zero));
        let outside = (in0 ^ in1) | (in1 ^ in2);
        if outside.all() {
            return Self { hits: 0, t: [0.0; 4], b1: [0.0; 4], b2: [0.0; 4] };
        }
        let [w0, w1, w2] = [0, 1, 2].map(|k| edges[k].weight());
        let det = w0 + w1 + w2;
        let t = (w0 * a.z + w1 * b.z + w2 * c.z) / det * f32x4::splat(shear.inv_depth);
        let flat = det.simd_eq(f32x4::ZERO);
        let hits = t.simd_gt(f32x4::ZERO).to_bitmask() & !(outside | flat).to_bitmask();
        Self { hits, t: t.to_array(), b1: (w1 / det).to_array(), b2: (w2 / det).to_array() }
    }
}

//! Leaves: four triangles at a time.
//!
//! Each lane does the operations of `triangle_intersect` (`shape/triangle.wgsl`, where it says why) in
//! their order, so that its bits are the same. Which hit counts is then asked one by one.

use super::crossings::Crossings;
use super::questions::Marked;
use super::tree::{BLOCK, Block, Tree};
use crate::kernel::{Hit, Kernel, PRIM_OTHER, Ray, TriangleShear};
use bytemuck::cast;
use glam::{UVec4, Vec2};
use wide::{f32x4, i32x4};

/// A ray, and what turns it into the z axis, in all lanes.
pub(super) struct Sheared {
    /// For each axis of the frame: which one of the world it is.
    axes: [usize; 3],
    /// In that frame.
    origin: [f32x4; 3],
    slope: [f32x4; 2],
    inv_depth: f32x4,
    /// Where the first corner of the triangle lies that the ray starts on, along x; not a number if there is none in
    /// this frame.
    skipped: f32,
}

impl Sheared {
    #[inline(always)]
    pub(super) fn new(kernel: &Kernel<'_>, ray: &Ray, shear: &TriangleShear) -> Self {
        let all = f32x4::splat;
        let axes: [usize; 3] = match shear.axis {
            0 => [1, 2, 0],
            1 => [2, 0, 1],
            _ => [0, 1, 2],
        };
        let origin = ray.origin.to_array();
        Self {
            axes,
            origin: axes.map(|axis| all(origin[axis])),
            slope: [all(shear.slope.x), all(shear.slope.y)],
            inv_depth: all(shear.inv_depth),
            skipped: first_corner(kernel, ray),
        }
    }

    /// Whether triangle `i`, in a lane of `block`, is what the ray starts on. Equal triangles have equal corners, which
    /// are here, while what else is asked is often not in any cache.
    #[inline(always)]
    #[expect(clippy::float_cmp, reason = "the same number, read from two places")]
    fn skips(
        &self,
        kernel: &mut Kernel<'_>,
        block: &Block,
        lane: usize,
        i: u32,
        ray: &Ray,
    ) -> bool {
        block.corners[0][0][lane & 3] == self.skipped && kernel.order_skipped(i, *ray)
    }

    /// How far a corner of each triangle of a block lies from the ray's origin, along `axis` of the frame.
    #[inline(always)]
    fn along(&self, axis: usize, corner: &[[f32; BLOCK]; 3]) -> f32x4 {
        // Cut off, so that there is no bound to check.
        f32x4::new(corner[self.axes[axis].min(2)]) - self.origin[axis]
    }

    /// The distances `t` of the triangles of `block`, with those in a plane across an axis other than that of the ray
    /// set right; that of x counts where both do.
    #[inline(always)]
    fn flat(&self, block: &Block, t: f32x4) -> f32x4 {
        let t = self.flat_across(block, 1, t);
        self.flat_across(block, 0, t)
    }

    #[inline(always)]
    fn flat_across(&self, block: &Block, axis: usize, t: f32x4) -> f32x4 {
        let [p0, p1, p2] = [0, 1, 2].map(|corner| self.along(axis, &block.corners[corner]));
        let (zero, slope) = (f32x4::ZERO, self.slope[axis]);
        let flat = (p0 - p1).simd_eq(zero) & (p1 - p2).simd_eq(zero) & slope.simd_ne(zero);
        if flat.none() { t } else { flat.bitselect(p0 / slope * self.inv_depth, t) }
    }
}

/// The better of `best` and the hits in the leaf `child` of `tree`. Of a shadow ray a hit that hides its light, or else
/// `best`, up to the distance where `crossed` has all that the ray goes through.
#[inline(always)]
pub(super) fn leaf(
    kernel: &mut Kernel<'_>,
    (tree, child): (&Tree, u32),
    ray: &Ray,
    sheared: &Sheared,
    (best, mut crossed): (Hit, Option<&mut Crossings>),
) -> Hit {
    let mut hit = best;
    let also = tree.questions(ray.instance);
    for block in tree.blocks(child) {
        let corners = [0, 1, 2].map(|corner| Corner::new(&block.corners[corner], sheared));
        let Some(met) = Lanes::intersect(&corners, block, kernel.tri_words, sheared, hit.t) else {
            continue;
        };
        let mut left = met.hits;
        while left != 0 {
            let lane = left.trailing_zeros() as usize & 3;
            left &= left - 1;
            let marked = block.triangles[lane];
            if marked.is_none() {
                break;
            }
            let (i, questions) = (marked.index(), marked.questions() | also);
            let new = met.hit(lane, i, ray);
            if new.t <= hit.t
                && comes_first(kernel, &new, &hit, ray)
                && !sheared.skips(kernel, block, lane, i, ray)
                && (!questions.counts() || tree.alpha.is_candidate(kernel, i, new.b, ray))
            {
                match &mut crossed {
                    Some(crossed) if questions.ends() && !kernel.dispatch_ends(new) => {
                        hit.t = crossed.add(kernel, new, hit.t);
                    }
                    Some(_) => return new,
                    None => hit = new,
                }
            }
        }
    }
    hit
}

/// One corner of four triangles, seen along the ray.
struct Corner {
    x: f32x4,
    y: f32x4,
    z: f32x4,
}

impl Corner {
    #[inline(always)]
    fn new(corner: &[[f32; BLOCK]; 3], sheared: &Sheared) -> Self {
        let [x, y, z] = [0, 1, 2].map(|axis| sheared.along(axis, corner));
        let [slope_x, slope_y] = sheared.slope;
        Self { x: x - z * slope_x, y: y - z * slope_y, z }
    }
}

/// The ids of the corners of four triangles, which are rarely asked for.
#[inline(always)]
fn ids(block: &Block, words: &[UVec4]) -> [i32x4; 3] {
    [0, 1, 2].map(|corner| {
        let id = |marked: Marked| {
            let row = words.get(3 * marked.index() as usize + corner);
            row.map_or(0, |row| row.w.cast_signed())
        };
        i32x4::new(block.triangles.map(id))
    })
}

/// What a ray and four triangles have in common.
struct Lanes {
    /// One bit a lane: the ray meets it.
    hits: u32,
    /// Distances.
    t: [f32; 4],
    /// Weights of the second and the third corner, before they are divided by `det`: few hits count.
    w1: [f32; 4],
    w2: [f32; 4],
    det: [f32; 4],
}

/// The lanes that are hit, and the weights of the corners.
struct Edges {
    inside: f32x4,
    weights: [f32x4; 3],
}

impl Edges {
    /// The edge functions; swapped ends only change their signs, twice, unless the ray meets an edge.
    #[inline(always)]
    fn new([a, b, c]: &[Corner; 3], block: &Block, words: &[UVec4]) -> Self {
        let edge = |p: &Corner, q: &Corner| p.x * q.y - p.y * q.x;
        let [e0, e1, e2] = [edge(b, c), edge(c, a), edge(a, b)];
        let zero = f32x4::ZERO;
        let [p0, p1, p2] = [e0.simd_gt(zero), e1.simd_gt(zero), e2.simd_gt(zero)];
        let [n0, n1, n2] = [e0.simd_lt(zero), e1.simd_lt(zero), e2.simd_lt(zero)];
        if ((p0 | n0) & (p1 | n1) & (p2 | n2)).all() {
            Self { inside: (p0 & p1 & p2) | (n0 & n1 & n2), weights: [e0, e1, e2] }
        } else {
            let [p, q, r] = ids(block, words);
            let edges = [Edge::new(b, q, c, r), Edge::new(c, r, a, p), Edge::new(a, p, b, q)];
            Self::in_order(&edges)
        }
    }

    /// The same with the ends of every edge in the order of their ids.
    #[inline(always)]
    fn in_order([e0, e1, e2]: &[Edge; 3]) -> Self {
        let [in0, in1, in2] = [e0.inside(), e1.inside(), e2.inside()];
        let outside = (in0 ^ in1) | (in1 ^ in2);
        Self { inside: !outside, weights: [e0.weight(), e1.weight(), e2.weight()] }
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
    #[inline(always)]
    fn new(a: &Corner, id_a: i32x4, b: &Corner, id_b: i32x4) -> Self {
        let swap: f32x4 = cast(id_a.simd_gt(id_b));
        let px = swap.bitselect(b.x, a.x);
        let py = swap.bitselect(b.y, a.y);
        let qx = swap.bitselect(a.x, b.x);
        let qy = swap.bitselect(a.y, b.y);
        Self { e: px * qy - py * qx, swap, p: [px, py], q: [qx, qy] }
    }

    /// The lanes on the inner side; an edge that is met exactly counts as moved.
    #[inline(always)]
    fn inside(&self) -> f32x4 {
        let ([px, py], [qx, qy]) = (self.p, self.q);
        let moved = qy.simd_eq(py).bitselect(px - qx, qy - py);
        let side = self.e.simd_eq(f32x4::ZERO).bitselect(moved, self.e);
        side.simd_gt(f32x4::ZERO) ^ self.swap
    }

    /// The weight of the corner opposite.
    #[inline(always)]
    fn weight(&self) -> f32x4 {
        self.e ^ (self.swap & f32x4::splat(-0.0))
    }
}

impl Lanes {
    /// Nothing if no lane is hit, up to the distance `t_max`.
    #[inline(always)]
    fn intersect(
        corners: &[Corner; 3],
        block: &Block,
        words: &[UVec4],
        sheared: &Sheared,
        t_max: f32,
    ) -> Option<Self> {
        let Edges { inside, weights: [w0, w1, w2] } = Edges::new(corners, block, words);
        if inside.none() {
            return None;
        }
        let [a, b, c] = corners;
        let det = w0 + w1 + w2;
        let t = (w0 * a.z + w1 * b.z + w2 * c.z) / det * sheared.inv_depth;
        let t = sheared.flat(block, t);
        let zero = f32x4::ZERO;
        let in_range = t.simd_gt(zero) & t.simd_le(f32x4::splat(t_max));
        let hits = (inside & det.simd_ne(zero) & in_range).to_bitmask();
        let [t, w1, w2, det] = [t, w1, w2, det].map(f32x4::to_array);
        let met = Self { hits, t, w1, w2, det };
        (hits != 0).then_some(met)
    }

    /// The hit of one lane, which is triangle `i`.
    #[inline(always)]
    fn hit(&self, lane: usize, i: u32, ray: &Ray) -> Hit {
        let b = Vec2::new(self.w1[lane], self.w2[lane]) / self.det[lane];
        Hit { t: self.t[lane], prim: i, b, instance: ray.instance }
    }
}

/// Whether `new`, at a distance above 0, comes before `best` and after what the ray has met.
#[inline(always)]
fn comes_first(kernel: &mut Kernel<'_>, new: &Hit, best: &Hit, ray: &Ray) -> bool {
    let before = new.t < best.t || kernel.order_triangle(*best, new.t, new.prim, ray.instance);
    before && kernel.dispatch_triangle_after(*ray, new.t, new.prim)
}

/// Where the first corner of the triangle lies that `ray` starts on, along x.
#[inline(always)]
fn first_corner(kernel: &Kernel<'_>, ray: &Ray) -> f32 {
    let here = ray.skip.x & PRIM_OTHER == 0 && ray.skip.y == ray.instance;
    let row = kernel.tri_words.get(3 * ray.skip.x as usize).filter(|_| here);
    row.map_or(f32::NAN, |row| f32::from_bits(row.x))
}

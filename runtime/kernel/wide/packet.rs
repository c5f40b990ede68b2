//! A ray a lane at once through a tree of wide nodes.
//!
//! Turns rays into their hits, the bits that walks one by one find: a box, a triangle or a leaf of spheres is tested
//! with all rays that come to it. Of the smallest trees a list is gone through instead (`walk::Few`). Where
//! few rays come to a node they walk on one by one, and so does every ray that comes to an instance or to triangles
//! that move. Worth it in small trees, where rays visit much the same nodes, and for camera rays, which stay together;
//! in large trees others soon part.

use crate::kernel::{Hit, Kernel, Ray, TriangleShear, v};
use crate::packet_triangle::{Corner, Crossing, Sheared};
use crate::rays::{Hits, Walks};
use crate::target;
use glam::UVec4;
use kernel_f32::kernel as scalar;
use kernel_f32::walk::{self, Block, FAR_END, Few, Lanes, Marked, Node, Step, Tree};
use scalar::NONE;
use std::borrow::Borrow;

/// At a node, a packet of no more rays than this walks on ray by ray: one ray is tested with all its boxes at once.
/// Nor is it worth going through the list of a tree for so few.
const FEW: u32 = 3;

/// A child that some rays meet.
#[derive(Clone, Copy, Debug)]
struct Waiting {
    /// Its reference.
    child: u32,
    /// Where each ray enters its box; beyond everything where it does not.
    enter: v::F,
}

/// Memory that is kept from one packet to the next.
#[derive(Debug, Default)]
pub(crate) struct Scratch {
    /// Children that rays may still enter.
    waiting: Vec<Waiting>,
    /// Of a list, the corners in the frames of the rays.
    corners: Vec<Corner>,
}

/// Rays, and what is worked out once for them.
struct Packet<'r> {
    ray: &'r Ray,
    inverse: v::V3<v::F>,
    t_min: v::F,
    shear: TriangleShear,
    sheared: Sheared,
    /// The lanes of shadow rays.
    shadow: v::B,
    /// The lanes that start on a triangle, and the id of its first corner.
    skip: v::B,
    skip_id: v::U,
}

/// What the rays of `mask` meet in `tree`, which is small. For each as `walk::trace`.
#[target]
pub(crate) fn trace(kernel: &mut Kernel<'_>, tree: &Tree, mask: v::B, ray: &Ray) -> Hit {
    let mut scratch = std::mem::take(&mut kernel.companion.scratch);
    let packet = Packet::new(kernel, mask, ray);
    let hit = match tree.few() {
        Some(few) if v::bits(mask).count_ones() > FEW => {
            packet.test_all(kernel, few, &mut scratch.corners, mask)
        }
        _ => packet.walk(kernel, tree, &mut scratch.waiting, mask),
    };
    kernel.companion.scratch = scratch;
    hit
}

impl<'r> Packet<'r> {
    #[target]
    fn new(kernel: &mut Kernel<'_>, mask: v::B, ray: &'r Ray) -> Self {
        let other = v::ne_u(v::and_u(ray.skip.x, v::u(scalar::PRIM_OTHER)), v::u(0));
        let skip = v::but_b(v::and_b(mask, v::eq_u(ray.skip.y, v::u(NONE))), other);
        let skip_id =
            if v::any(skip) { kernel.load_triangle_id0(skip, ray.skip.x) } else { v::u(0) };
        let shear = kernel.triangle_shear(mask, ray.dir);
        Self {
            ray,
            inverse: kernel.box_inverse(mask, ray.dir),
            // As in `trace/bvh.wgsl`.
            t_min: v::mul_f(ray.t_min, v::f(0.9999)),
            shear,
            sheared: Sheared::new(ray, shear),
            shadow: v::and_b(mask, v::ne_u(ray.light, v::u(NONE))),
            skip,
            skip_id,
        }
    }

    #[target]
    fn walk(
        &self,
        kernel: &mut Kernel<'_>,
        tree: &Tree,
        stack: &mut Vec<Waiting>,
        mask: v::B,
    ) -> Hit {
        let mut hit = kernel.ray_miss(mask, self.ray.t_max);
        // Packets are only made in trees that have them: see `render_tile`.
        let Some(nodes) = kernel.companion.instructions.nodes(tree) else { return hit };
        let mut left = mask;
        let mut walks = None;
        stack.clear();
        stack.push(Waiting { child: tree.root(), enter: v::f(0.0) });
        while let Some(Waiting { child, enter }) = stack.pop() {
            let near = v::le_f(enter, v::mul_f(hit.t, v::f(FAR_END)));
            let active = v::and_b(left, near);
            if !v::any(active) {
                continue;
            }
            let ended = match tree.step(nodes, child) {
                Step::Node(_) if v::bits(active).count_ones() <= FEW => {
                    self.apart(kernel, &mut walks, child, active, &mut hit)
                }
                Step::Node(node) => {
                    self.visit(node, active, hit.t, stack);
                    continue;
                }
                Step::Triangles(blocks) => self.triangles(kernel, blocks, active, &mut hit),
                Step::Spheres => self.spheres(kernel, child, active, &mut hit),
                Step::Other => self.apart(kernel, &mut walks, child, active, &mut hit),
            };
            left = v::but_b(left, ended);
        }
        hit
    }

    /// Tests all that is in a list.
    #[target]
    #[inline(never)]
    fn test_all(
        &self,
        kernel: &mut Kernel<'_>,
        few: &Few,
        corners: &mut Vec<Corner>,
        mask: v::B,
    ) -> Hit {
        let mut hit = kernel.ray_miss(mask, self.ray.t_max);
        let mut left = mask;
        let mut known = 0;
        if corners.is_empty() {
            corners.resize(walk::MOST_CORNERS, self.sheared.corner([0.0; 4]));
        }
        for leaf in &few.leaves {
            let (mut active, _) = self.enter(&leaf.ends, left, hit.t);
            if !v::any(active) {
                continue;
            }
            let mut missing = leaf.corners & !known;
            known |= missing;
            while missing != 0 {
                let k = missing.trailing_zeros() as usize;
                missing &= missing - 1;
                corners[k] = self.sheared.corner(few.corners[k]);
            }
            for listed in &few.triangles[leaf.triangles.clone()] {
                let [a, b, c] = listed.corners.map(|k| &corners[usize::from(k)]);
                let named = (listed.triangle, listed.ids);
                let ended = self.triangle(kernel, named, &[a, b, c], active, &mut hit);
                (active, left) = (v::but_b(active, ended), v::but_b(left, ended));
            }
        }
        for leaf in &few.spheres {
            let (met, _) = self.enter(&leaf.ends, left, hit.t);
            if v::any(met) {
                let ended = self.spheres(kernel, leaf.child, met, &mut hit);
                left = v::but_b(left, ended);
            }
        }
        hit
    }

    /// Which rays of `active` meet a box with these ends before `t_max`, and where; as in `trace/box.wgsl`.
    #[target]
    #[inline]
    fn enter(&self, ends: &[[f32; 2]; 3], active: v::B, t_max: v::F) -> (v::B, v::F) {
        let (o, inverse) = (self.ray.origin, self.inverse);
        let plane = |end: f32, from, inverse| v::mul_f(v::sub_f(v::f(end), from), inverse);
        let [x, y, z] = ends;
        let (x0, x1) = (plane(x[0], o.x, inverse.x), plane(x[1], o.x, inverse.x));
        let (y0, y1) = (plane(y[0], o.y, inverse.y), plane(y[1], o.y, inverse.y));
        let (z0, z1) = (plane(z[0], o.z, inverse.z), plane(z[1], o.z, inverse.z));
        let near = v::max_f(v::min_f(x0, x1), v::min_f(y0, y1));
        let far = v::min_f(v::max_f(x0, x1), v::max_f(y0, y1));
        let enter = v::max_f(near, v::max_f(v::min_f(z0, z1), self.t_min));
        let leave = v::min_f(far, v::min_f(v::max_f(z0, z1), t_max));
        (v::and_b(active, v::le_f(enter, v::mul_f(leave, v::f(FAR_END)))), enter)
    }

    /// Pushes the children of `node` that rays of `active` meet, the nearest last.
    #[target]
    #[inline]
    fn visit<const W: usize>(
        &self,
        node: &Node<W>,
        active: v::B,
        t_max: v::F,
        stack: &mut Vec<Waiting>,
    ) {
        let bottom = stack.len();
        let mut keys = [0.0_f32; W];
        for (k, child) in node.children.iter().enumerate() {
            if *child == NONE {
                continue;
            }
            let ends = node.ends.map(|axis| axis.map(|ends| ends[k]));
            let (met, enter) = self.enter(&ends, active, t_max);
            if v::any(met) {
                let enter = v::select_f(met, enter, v::f(f32::INFINITY));
                let key = v::least_f(enter);
                let mut at = stack.len() - bottom;
                stack.push(Waiting { child: *child, enter });
                while at > 0 && keys[at - 1] < key {
                    keys[at] = keys[at - 1];
                    stack.swap(bottom + at, bottom + at - 1);
                    at -= 1;
                }
                keys[at] = key;
            }
        }
    }

    /// Makes the hits in `blocks` count; gives the lanes that look for no other.
    #[target]
    #[inline]
    fn triangles(
        &self,
        kernel: &mut Kernel<'_>,
        blocks: &[Block],
        active: v::B,
        hit: &mut Hit,
    ) -> v::B {
        let mut ended = v::b(false);
        for marked in blocks.iter().flat_map(|block| block.triangles) {
            let rows = kernel.tri_words.get(3 * marked.index() as usize..);
            // None for the rest of a block that is not full.
            let Some(&[a, b, c]) = rows.and_then(<[_]>::first_chunk) else { continue };
            let corner = |row: UVec4| self.sheared.corner(bytemuck::cast(row.to_array()));
            let corners = [corner(a), corner(b), corner(c)];
            let new = self.triangle(kernel, (marked, [a.w, b.w, c.w]), &corners, active, hit);
            ended = v::or_b(ended, new);
        }
        ended
    }

    /// Tests a triangle with these ids; as `triangles`.
    #[target]
    #[inline]
    fn triangle(
        &self,
        kernel: &mut Kernel<'_>,
        (marked, ids): (Marked, [u32; 3]),
        corners: &[impl Borrow<Corner>; 3],
        active: v::B,
        hit: &mut Hit,
    ) -> v::B {
        if let Some((met, new)) = self.sheared.intersect(corners, ids, active, hit.t) {
            let counts = self.counts(kernel, (marked, ids[0]), met, &new, hit);
            if v::any(counts) {
                let new =
                    Hit { t: new.t, prim: v::u(marked.index()), b: new.b(), instance: v::u(NONE) };
                *hit = Hit::select(counts, &new, hit);
                return if marked.questions().ends() {
                    self.ended(kernel, counts, hit)
                } else {
                    v::and_b(counts, self.shadow)
                };
            }
        }
        v::b(false)
    }

    /// Which of the new hits `met` of a triangle, the id of whose first corner is given, replace the old ones, which are
    /// no nearer.
    #[target]
    #[inline]
    fn counts(
        &self,
        kernel: &mut Kernel<'_>,
        (marked, first_id): (Marked, u32),
        met: v::B,
        new: &Crossing,
        hit: &Hit,
    ) -> v::B {
        let (ray, i) = (self.ray, v::u(marked.index()));
        let between = v::and_b(v::gt_f(new.t, ray.t_min), v::lt_f(new.t, hit.t));
        let mut counts = v::and_b(met, between);
        let tie = v::but_b(v::and_b(met, v::ge_f(new.t, ray.t_min)), between);
        if v::any(tie) {
            let before = kernel.order_triangle(tie, hit, new.t, i, v::u(NONE));
            let after = kernel.dispatch_triangle_after(tie, ray, new.t, i);
            counts = v::or_b(counts, v::and_b(tie, v::and_b(before, after)));
        }
        let same = v::and_b(v::and_b(counts, self.skip), v::eq_u(self.skip_id, v::u(first_id)));
        if v::any(same) {
            let skipped = kernel.order_skipped(same, i, ray);
            counts = v::but_b(counts, v::and_b(same, skipped));
        }
        if marked.questions().counts() && v::any(counts) {
            counts = v::and_b(counts, kernel.candidate_triangle(counts, i, new.b(), ray));
        }
        counts
    }

    /// As `triangles` for the leaf of spheres that `child` refers to.
    #[target]
    #[inline]
    fn spheres(&self, kernel: &mut Kernel<'_>, child: u32, active: v::B, hit: &mut Hit) -> v::B {
        let first = v::u(child & scalar::CHILD_FIRST);
        let count = v::u((child >> scalar::CHILD_COUNT_SHIFT & 7) + 1);
        let new = kernel.spheres_trace(active, first, count, self.ray, hit);
        let old = v::and_b(v::eq_f(new.t, hit.t), v::eq_u(new.prim, hit.prim));
        *hit = Hit::select(active, &new, hit);
        self.ended(kernel, v::but_b(active, old), hit)
    }

    /// Lets the rays of `active` walk on one by one below `child`; gives the lanes that look for no other hit.
    #[target]
    fn apart(
        &self,
        kernel: &mut Kernel<'_>,
        known: &mut Option<Walks>,
        child: u32,
        active: v::B,
        hit: &mut Hit,
    ) -> v::B {
        let walks = match known {
            Some(walks) => walks,
            none => none.insert(Walks::new(self.ray, self.inverse, self.shear)),
        };
        let mut hits = Hits::of(hit);
        let mut new = 0;
        let mut left = v::bits(active);
        while left != 0 {
            let lane = left.trailing_zeros() as usize;
            left &= left - 1;
            let best = hits.lane(lane);
            let companion = &mut kernel.companion;
            let (lanes, scalar) = (companion.instructions, &mut companion.scalar);
            let found = walk::trace_below(lanes, scalar, &walks.lane(lane), child, best);
            let same = found.prim == best.prim && found.instance == best.instance;
            if !same || found.t.to_bits() != best.t.to_bits() {
                hits.set(lane, &found);
                new |= 1 << lane;
            }
        }
        if new == 0 {
            return v::b(false);
        }
        *hit = hits.all();
        let new = v::ne_u(v::and_u(v::shr_u(v::u(new), v::lane()), v::u(1)), v::u(0));
        self.ended(kernel, new, hit)
    }

    /// The lanes of `new` that are shadow rays and have met something opaque.
    #[target]
    #[inline]
    fn ended(&self, kernel: &mut Kernel<'_>, new: v::B, hit: &Hit) -> v::B {
        let shadows = v::and_b(new, self.shadow);
        if v::any(shadows) {
            v::and_b(shadows, kernel.dispatch_ends(shadows, hit))
        } else {
            v::b(false)
        }
    }
}

//! A node of the tree: which of its boxes a ray meets, nearest first.

use super::lanes::Lanes;
use super::stack::{FAR_END, Stack, Waiting};
use super::tree::{Node, Tree};
use crate::kernel::Ray;
use glam::Vec3;

/// How much boxes grow, relative to the ray's origin: four times the rounding of its product with the inverse direction.
const SLACK: f32 = 1.0 / (1 << 22) as f32;

/// Beyond this, a product of origin and inverse direction may be near to overflow.
const FAR_OUT: f32 = 1e30;

/// Where a ray enters the boxes of a node. Aligned, so that all that is kept on the stack beside it is, too: sixteen
/// numbers that lie in two lines of the cache are read in twice the time.
#[repr(align(64))]
struct Entries<const W: usize>([f32; W]);

/// What is worked out once a ray, in each frame that it enters.
pub(super) struct Walker<L: Lanes<W>, const W: usize> {
    lanes: L,
    inverse: [L::Row; 3],
    /// What is added to a plane times `inverse`: for one that is entered, and for one that is left.
    near: [L::Row; 3],
    far: [L::Row; 3],
    /// For each axis 1 if the ray runs against it, so that it meets upper ends first.
    back: [usize; 3],
    t_min: L::Row,
}

impl<L: Lanes<W>, const W: usize> Walker<L, W> {
    #[inline(always)]
    pub(super) fn new(lanes: L, ray: &Ray, inverse: Vec3, t_min: f32) -> Self {
        let all = |v: Vec3| [lanes.splat(v.x), lanes.splat(v.y), lanes.splat(v.z)];
        let start = ray.origin * -inverse;
        // So far out, as in the frame of a tiny instance, an axis rules out nothing.
        let lost = start.abs().cmpgt(Vec3::splat(FAR_OUT));
        let slack = Vec3::select(lost, Vec3::INFINITY, start.abs() * SLACK);
        let [start, scale] = [start, inverse].map(|v| Vec3::select(lost, Vec3::ZERO, v));
        let against = |x: f32| usize::from(x < 0.0);
        let back = [against(inverse.x), against(inverse.y), against(inverse.z)];
        Self {
            lanes,
            inverse: all(scale),
            near: all(start - slack),
            far: all(start + slack),
            back,
            t_min: lanes.splat(t_min),
        }
    }

    /// The nearest child of `node` that the ray meets before `t_max`; the others wait on the stack, if `any` hit will
    /// do in any order.
    #[inline(always)]
    pub(super) fn visit(
        &self,
        (tree, nodes): (&Tree, &[Node<W>]),
        node: &Node<W>,
        t_max: f32,
        any: bool,
        stack: &mut Stack,
    ) -> Option<u32> {
        let (mut met, enter) = self.meet(node, t_max);
        let next = |met: &mut u32| {
            let k = met.trailing_zeros() as usize % W;
            *met &= *met - 1;
            tree.ask_for(nodes, node.children[k]);
            Waiting { child: node.children[k], distance: enter.0[k] }
        };
        if met == 0 {
            return None;
        }
        let first = next(&mut met);
        if met == 0 {
            return Some(first.child);
        }
        let second = next(&mut met);
        let (mut near, far) =
            if second.distance < first.distance { (second, first) } else { (first, second) };
        let bottom = stack.push(far);
        while met != 0 {
            let other = next(&mut met);
            let far = if other.distance < near.distance {
                core::mem::replace(&mut near, other)
            } else {
                other
            };
            if any {
                stack.push(far);
            } else {
                stack.insert(far, bottom);
            }
        }
        Some(near.child)
    }

    /// One bit for each child that the ray meets, and where it enters their boxes, or a little before: Ize 2013, "Robust
    /// BVH Ray Traversal", JCGT 2(2), as in `trace/box.wgsl`, with boxes that are larger by `SLACK`.
    #[inline(always)]
    fn meet(&self, node: &Node<W>, t_max: f32) -> (u32, Entries<W>) {
        let l = self.lanes;
        let plane = |axis: usize, end: usize, add: &[L::Row; 3]| {
            l.mul_add(l.load(&node.ends[axis][end & 1]), self.inverse[axis], add[axis])
        };
        let near = |axis: usize| plane(axis, self.back[axis], &self.near);
        let far = |axis: usize| plane(axis, 1 - self.back[axis], &self.far);
        let enter = l.max(l.max(near(0), near(1)), l.max(near(2), self.t_min));
        let leave = l.min(l.min(far(0), far(1)), l.min(far(2), l.splat(t_max)));
        (l.at_most(enter, l.mul(leave, l.splat(FAR_END))), Entries(l.array(enter)))
    }
}

#[cfg(test)]
mod tests {
    use super::super::lanes::Halves;
    use super::*;
    use pack::abi::NONE;

    /// Farther from a box than this no ray may meet it, in a space where nothing is farther away than 1.
    const NEAR: f32 = 3e-6;

    /// From -1 to 1, the same for the same state.
    fn random(state: &mut u32) -> f32 {
        *state = state.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
        (*state >> 8) as f32 / (1 << 23) as f32 - 1.0
    }

    fn vector(state: &mut u32) -> Vec3 {
        Vec3::new(random(state), random(state), random(state))
    }

    /// How long the ray is in all slabs; negative if it misses the box.
    fn inside(ray: &Ray, lo: Vec3, hi: Vec3) -> f64 {
        let (mut enter, mut leave) = (0.0_f64, f64::INFINITY);
        for axis in 0..3 {
            let [lo, hi, from, dir] =
                [lo[axis], hi[axis], ray.origin[axis], ray.dir[axis]].map(f64::from);
            let (a, b) = ((lo - from) / dir, (hi - from) / dir);
            (enter, leave) = (enter.max(a.min(b)), leave.min(a.max(b)));
        }
        leave - enter
    }

    /// Asks for boxes of which a corner is near the ray, at most twice `NEAR` away; counts those that are met, and
    /// those that are not.
    fn count<L: Lanes<W>, const W: usize>(lanes: L) -> [usize; 2] {
        let (mut state, mut counts) = (1, [0; 2]);
        for _ in 0..5_000 {
            let dir = vector(&mut state).normalize();
            let ray = Ray { origin: vector(&mut state), dir, ..Ray::default() };
            let walker = Walker::new(lanes, &ray, Vec3::ONE / ray.dir, 0.0);
            let mut node = Node { ends: [[[0.0; W]; 2]; 3], children: [NONE; W] };
            let boxes = [(); W].map(|()| {
                let off = vector(&mut state) * (NEAR * (1.0 + random(&mut state)));
                let corner = ray.origin + ray.dir * random(&mut state).abs() + off;
                let other = corner + vector(&mut state) * 1e-5;
                (corner.min(other), corner.max(other))
            });
            for (slot, (lo, hi)) in boxes.iter().enumerate() {
                for axis in 0..3 {
                    (node.ends[axis][0][slot], node.ends[axis][1][slot]) = (lo[axis], hi[axis]);
                }
            }
            let (met, _) = walker.meet(&node, f32::INFINITY);
            for (slot, &(lo, hi)) in boxes.iter().enumerate() {
                let is_met = met >> slot & 1 == 1;
                assert!(is_met || inside(&ray, lo, hi) < 0.0, "missed: {ray:?} {lo} {hi}");
                let grown = inside(&ray, lo - NEAR, hi + NEAR);
                assert!(!is_met || grown >= 0.0, "far from: {ray:?} {lo} {hi}");
                counts[usize::from(!is_met)] += 1;
            }
        }
        counts
    }

    /// Whether a ray whose origin times inverse direction overflows meets a box ahead, and one beside it along x.
    fn far_out<L: Lanes<W>, const W: usize>(lanes: L) -> [bool; 2] {
        let (origin, dir) = (Vec3::new(0.0, 3e19, -1.0), Vec3::new(0.0, -1e-20, 1.0));
        let ray = Ray { origin, dir, ..Ray::default() };
        let walker = Walker::new(lanes, &ray, Vec3::new(1e20, -1e20, 1.0), 0.0);
        let mut node = Node { ends: [[[-1.0; W], [1.0; W]]; 3], children: [NONE; W] };
        (node.ends[0][0][1], node.ends[0][1][1]) = (2.0, 3.0);
        let (met, _) = walker.meet(&node, f32::INFINITY);
        [met & 1 == 1, met & 2 == 2]
    }

    #[test]
    fn what_overflows_rules_out_nothing() {
        assert_eq!(far_out(Halves), [true, false]);
        #[cfg(target_arch = "x86_64")]
        if let Some(avx2) = pulp::x86::V3::try_new() {
            assert_eq!(far_out(avx2), [true, false]);
        }
        #[cfg(target_arch = "x86_64")]
        if let Some(avx512) = pulp::x86::V4::try_new() {
            assert_eq!(far_out(avx512), [true, false]);
        }
    }

    #[test]
    fn boxes_on_the_way_are_met_and_those_beside_it_are_not() {
        let check = |[met, missed]: [usize; 2]| {
            assert!(met > 10_000 && missed > 1_000, "{met} {missed}");
        };
        check(count(Halves));
        #[cfg(target_arch = "x86_64")]
        if let Some(avx2) = pulp::x86::V3::try_new() {
            check(count(avx2));
        }
        #[cfg(target_arch = "x86_64")]
        if let Some(avx512) = pulp::x86::V4::try_new() {
            check(count(avx512));
        }
    }
}

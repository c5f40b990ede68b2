//! A node of the tree of eights: which of its boxes a ray meets, nearest first.

use super::lanes::Lanes;
use super::stack::{FAR_END, Stack, Waiting};
use super::tree::{Node, Tree};
use crate::kernel::Ray;
use glam::Vec3;

/// What is worked out once a ray, in each frame that it enters.
pub(super) struct Walker<L: Lanes> {
    lanes: L,
    origin: [L::Eight; 3],
    inverse: [L::Eight; 3],
    /// For each axis 1 if the ray runs against it, so that it meets upper ends first.
    back: [usize; 3],
    t_min: L::Eight,
}

impl<L: Lanes> Walker<L> {
    #[inline(always)]
    pub(super) fn new(lanes: L, ray: &Ray, inverse: Vec3, t_min: f32) -> Self {
        let all = |v: Vec3| [lanes.splat(v.x), lanes.splat(v.y), lanes.splat(v.z)];
        let against = |x: f32| usize::from(x < 0.0);
        let back = [against(inverse.x), against(inverse.y), against(inverse.z)];
        Self {
            lanes,
            origin: all(ray.origin),
            inverse: all(inverse),
            back,
            t_min: lanes.splat(t_min),
        }
    }

    /// The nearest child of `node` that the ray meets before `t_max`; the others wait on the stack, if `any` hit will
    /// do in any order.
    #[inline(always)]
    pub(super) fn visit(
        &self,
        tree: &Tree,
        node: &Node,
        t_max: f32,
        any: bool,
        stack: &mut Stack,
    ) -> Option<u32> {
        let (mut met, enter) = self.meet(node, t_max);
        let next = |met: &mut u32| {
            let k = met.trailing_zeros() as usize & 7;
            *met &= *met - 1;
            tree.ask_for(node.children[k]);
            Waiting { child: node.children[k], distance: enter[k] }
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

    /// One bit for each child that the ray meets, and where it enters their boxes. Ize 2013, "Robust BVH Ray
    /// Traversal", JCGT 2(2), as in `trace/box.wgsl`.
    #[inline(always)]
    fn meet(&self, node: &Node, t_max: f32) -> (u32, [f32; 8]) {
        let l = self.lanes;
        let plane = |axis: usize, end: usize| {
            let row = l.load(&node.ends[axis][end & 1]);
            l.mul(l.sub(row, self.origin[axis]), self.inverse[axis])
        };
        let near = |axis: usize| plane(axis, self.back[axis]);
        let far = |axis: usize| plane(axis, 1 - self.back[axis]);
        let enter = l.max(l.max(near(0), near(1)), l.max(near(2), self.t_min));
        let leave = l.min(l.min(far(0), far(1)), l.min(far(2), l.splat(t_max)));
        (l.at_most(enter, l.mul(leave, l.splat(FAR_END))), l.array(enter))
    }
}

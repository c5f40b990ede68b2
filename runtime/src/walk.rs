//! The walk through wide nodes on the CPU: `trace` of the kernel by hand, four lanes at a time.
//!
//! Turns a ray into the hit that `generated_trace` finds, bit for bit: nodes only decide what is tested,
//! and of triangles each lane does the operations of `triangle_intersect` in their order. What is rare
//! (spheres, triangles that move, the way into an instance) is left to the generated functions, as is
//! every question about a hit: which of two counts, whether it is cut out, whether it ends a shadow ray.
//! It does not know how a kernel is bound, and renders nothing.
//!
//! The same source is compiled for the baseline and for AVX2, between which the processor decides: with
//! the longer encodings it takes fewer instructions, and no product is fused with a sum in either. What
//! is compiled for AVX2 is what is inlined into it, hence `inline(always)` in all of it.
#![expect(clippy::inline_always, reason = "what is not inlined is not compiled for the processor")]

mod node;
mod stack;
mod triangles;

use crate::kernel::f32::{
    CHILD_INDEX, CHILD_INNER, CHILD_OUT, CHILD_SPHERES, Hit, Kernel, NONE, Ray,
};
use node::Walker;
use pulp::{Arch, Simd, WithSimd};
use stack::{Stack, Waiting};
use triangles::Sheared;

/// The frame's words for wide nodes that are to be walked here: `UNCUT` where no material has holes.
const NATIVE: u32 = 1;
const UNCUT: u32 = 3;

/// The nearest hit before `ray.t_max`, or a miss. For a shadow ray: some opaque hit on the way, else the nearest.
#[inline]
pub(crate) fn trace(kernel: &mut Kernel<'_>, ray: Ray) -> Hit {
    match kernel.load_frame_wide() {
        word @ (NATIVE | UNCUT) => Arch::new().dispatch(Walk { kernel, ray, uncut: word == UNCUT }),
        _ => kernel.generated_trace(ray),
    }
}

/// A walk that is to be done.
struct Walk<'k, 'a> {
    kernel: &'k mut Kernel<'a>,
    ray: Ray,
    uncut: bool,
}

impl WithSimd for Walk<'_, '_> {
    type Output = Hit;

    #[inline(always)]
    fn with_simd<S: Simd>(self, _: S) -> Hit {
        walk(self.kernel, self.ray, self.uncut)
    }
}

#[inline(always)]
fn walk(kernel: &mut Kernel<'_>, ray: Ray, uncut: bool) -> Hit {
    let mut hit = kernel.ray_miss(ray.t_max);
    let mut child = kernel.load_frame_root();
    let mut walk = kernel.walk_begin(ray);
    let mut walker = Walker::new((kernel.node_words, kernel.tri_words), &walk.ray, walk.inverse);
    let mut sheared = Sheared::new(walk.ray.origin, &walk.leaf);
    let mut stack = Stack::new();
    // As in `trace/bvh.wgsl`.
    let t_min = ray.t_min * 0.9999;
    // Such a ray can be hit by every triangle.
    let all = uncut && ray.light == NONE;
    if child == NONE {
        return hit;
    }
    loop {
        if child & CHILD_INNER != 0 {
            if let Some(nearest) = walker.visit(child & CHILD_INDEX, t_min, hit.t, &mut stack) {
                child = nearest;
                continue;
            }
        } else if child & CHILD_SPHERES != 0 && kernel.dispatch_is_instance_leaf(child) {
            child = kernel.dispatch_instance_leaf(child, ray, &mut walk);
            walker = Walker::new((kernel.node_words, kernel.tri_words), &walk.ray, walk.inverse);
            sheared = Sheared::new(walk.ray.origin, &walk.leaf);
            if child != NONE {
                // Nothing lies before it: it is never left out.
                stack.push_one(Waiting { child: CHILD_OUT, distance: 0 });
                continue;
            }
        } else {
            if child & CHILD_SPHERES != 0 {
                hit = kernel.leaf_trace(child, walk.ray, walk.leaf, hit);
            } else {
                hit = triangles::leaf(kernel, child, &walk, &sheared, all, hit);
            }
            if ray.light != NONE && hit.prim != NONE && kernel.dispatch_ends(hit) {
                return hit;
            }
        }
        let Some(next) = stack.pop(hit.t) else { return hit };
        child = next;
    }
}

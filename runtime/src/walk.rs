//! The walk through wide nodes on the CPU: `trace` of the kernel by hand, four lanes at a time.
//!
//! Turns a ray into the hit that `generated_trace` finds, bit for bit: nodes only decide what is tested,
//! and of triangles each lane does the operations of `triangle_intersect` in their order. What is rare
//! (spheres, triangles that move, the way into an instance) is left to the generated functions, as is
//! every question about a hit: which of two counts, whether it is cut out, whether it ends a shadow ray.
//! It does not know how a kernel is bound, and renders nothing.

mod node;
mod triangles;

use crate::kernel::f32::{CHILD_INDEX, CHILD_INNER, CHILD_OUT, Hit, Kernel, NONE, Ray};
use glam::UVec2;
use node::Walker;

/// The frame's word for wide nodes that are to be walked here.
const NATIVE: u32 = 1;

/// The nearest hit before `ray.t_max`, or a miss. For a shadow ray: some opaque hit on the way, else the nearest.
#[inline]
pub(crate) fn trace(kernel: &mut Kernel<'_>, ray: Ray) -> Hit {
    if kernel.load_frame_wide() == NATIVE { walk(kernel, ray) } else { kernel.generated_trace(ray) }
}

fn walk(kernel: &mut Kernel<'_>, ray: Ray) -> Hit {
    let mut hit = kernel.ray_miss(ray.t_max);
    let mut child = kernel.load_frame_root();
    let mut walk = kernel.walk_begin(ray);
    let mut walker = Walker::new(kernel.node_words, &walk.ray, walk.inverse);
    let mut n_stack = 0;
    while child != NONE {
        if child & CHILD_INNER != 0 {
            let met = walker.meet(child & CHILD_INDEX, hit.t);
            let Some((nearest, others)) = met.split() else {
                child = pop(kernel, &mut n_stack, hit.t);
                continue;
            };
            child = nearest.child;
            for other in others {
                if let Some(place) = kernel.stack.get_mut(n_stack) {
                    *place = UVec2::new(other.child, other.distance());
                    n_stack += 1;
                }
            }
            continue;
        }
        if kernel.dispatch_is_door(child) {
            child = kernel.dispatch_door(child, ray, &mut walk);
            walker = Walker::new(kernel.node_words, &walk.ray, walk.inverse);
            if child == NONE {
                child = pop(kernel, &mut n_stack, hit.t);
            } else if let Some(place) = kernel.stack.get_mut(n_stack) {
                // Nothing lies before it: it is never left out.
                *place = UVec2::new(CHILD_OUT, 0);
                n_stack += 1;
            }
            continue;
        }
        hit = triangles::leaf(kernel, child, &walk.ray, &walk.leaf, hit);
        if ray.light != NONE && hit.prim != NONE && kernel.dispatch_ends(hit) {
            break;
        }
        child = pop(kernel, &mut n_stack, hit.t);
    }
    hit
}

/// The last child on the stack that a ray may enter before `t_max`, or `NONE`.
#[inline]
fn pop(kernel: &Kernel<'_>, n_stack: &mut usize, t_max: f32) -> u32 {
    while let Some(below) = n_stack.checked_sub(1) {
        *n_stack = below;
        let Some(top) = kernel.stack.get(below) else { break };
        if f32::from_bits(top.y) <= t_max * node::FAR_END {
            return top.x;
        }
    }
    NONE
}

//! Rays that have nothing in common, each walked by itself.
//!
//! Turns them into their hits, in code that is compiled for the instructions of its crate. It does not know of packets.

use crate::kernel::{self, v};
use crate::rays::{Hits, Walks};
use crate::{Instructions, target};
use kernel_f32::{kernel as scalar, walk};

/// The hits of a ray a lane.
#[target]
pub(crate) fn trace(kernel: &mut kernel::Kernel<'_>, mask: v::B, ray: &kernel::Ray) -> kernel::Hit {
    let mut hits = Hits::of(&kernel.ray_miss(mask, ray.t_max));
    let (inverse, shear) =
        (kernel.box_inverse(mask, ray.dir), kernel.triangle_shear(mask, ray.dir));
    let walks = Walks::new(ray, inverse, shear);
    let (scalar, instructions) = (&mut kernel.companion.scalar, kernel.companion.instructions);
    walk_is_inlined();
    let mut left = v::bits(mask);
    while left != 0 {
        let lane = left.trailing_zeros() as usize % v::LANES;
        left &= left - 1;
        hits.set(lane, &walk::trace_here(instructions, scalar, &walks.lane(lane), lane));
    }
    hits.all()
}

/// The hits of `rays` with the scalar kernel's bindings, as `trace` finds them, added to `hits`.
#[expect(unsafe_code, reason = "who has the first argument has the instructions")]
pub fn trace_all(
    instructions: Instructions,
    scalar: &mut scalar::Kernel<'_>,
    rays: &[scalar::Ray],
    hits: &mut Vec<scalar::Hit>,
) {
    // SAFETY: `Instructions` are made only where the processor has all that `trace_each` is compiled for.
    unsafe { trace_each(instructions, scalar, rays, hits) }
}

#[target]
fn trace_each(
    instructions: Instructions,
    scalar: &mut scalar::Kernel<'_>,
    rays: &[scalar::Ray],
    hits: &mut Vec<scalar::Hit>,
) {
    walk_is_inlined();
    for ray in rays {
        let begun = scalar.walk_begin(*ray);
        hits.push(walk::trace_here(instructions, scalar, &begun, 0));
    }
}

/// Does nothing, but whoever calls it must be compiled for what the walk of a lone ray is made of: otherwise each of
/// its instructions would be a call.
#[target]
#[inline]
fn walk_is_inlined() {}

//! The walk through a tree of wide nodes on the CPU: `trace` of the kernel by hand.
//!
//! Turns a ray into the hit that `generated_trace` finds, bit for bit: nodes only decide what is tested, and of triangles
//! each lane does the operations of `triangle_intersect` in their order. What is rare (spheres, triangles that move, the
//! way into an instance) is left to the generated functions, as is every question about a hit: which of two counts,
//! whether it is cut out, whether it ends a shadow ray. It does not know how a kernel is bound, and renders nothing.
//!
//! The same source is compiled for the baseline, for AVX2 and for AVX-512, between which the processor decides; in tests
//! of triangles no product is fused with a sum in any. What is compiled for an instruction set is what is inlined into
//! it, hence `inline(always)` in all of it.
#![expect(clippy::inline_always, reason = "what is not inlined is not compiled for the processor")]

mod alpha_map;
mod build;
mod collapse;
mod crossings;
mod few;
mod lanes;
mod node;
mod questions;
mod stack;
mod tree;
mod triangles;

pub use build::Geometry;
pub use few::{Ends, Few, Leaf, Listed, MOST_CORNERS, SphereLeaf};
pub use lanes::Lanes;
pub use questions::{Marked, Questions};
pub use stack::FAR_END;
pub use tree::{Block, Companion, Node, Step, Tree, Width};

use crate::kernel::{
    self, CHILD_INNER, CHILD_OUT, CHILD_SPHERES, Hit, Kernel, NONE, PRIM_OTHER, Ray,
};
use crossings::Crossings;
use lanes::Halves;
#[cfg(target_arch = "x86_64")]
use lanes::Pairs;
use node::Walker;
use stack::{Stack, Waiting};
use tree::{MOVING, Nodes};
use triangles::Sheared;

/// The nearest hit from `ray.t_min` to `ray.t_max`, or a miss. For a shadow ray: some opaque hit on the way, else the
/// nearest.
pub fn trace(kernel: &mut Kernel<'_>, ray: Ray) -> Hit {
    let Some(tree) = kernel.companion.tree else { return kernel.generated_trace(ray) };
    let begun = kernel.walk_begin(ray);
    match &tree.nodes {
        Nodes::Eights(nodes) => {
            let walk = Walk { kernel, tree, nodes: nodes.as_slice(), begun: &begun, lane: 0 };
            #[cfg(target_arch = "x86_64")]
            if let Some(avx2) = pulp::x86::V3::try_new() {
                return avx2.vectorize(With(walk, avx2));
            }
            walk.walk(Halves)
        }
        #[cfg(target_arch = "x86_64")]
        Nodes::Sixteens(nodes, avx512) => {
            let walk = Walk { kernel, tree, nodes: nodes.as_slice(), begun: &begun, lane: 0 };
            // Not with AVX-512: this kernel is not compiled for it, and measured slower with it (`docs/cpu.md`).
            let avx2: pulp::x86::V3 = **avx512;
            avx2.vectorize(With(walk, Pairs(avx2)))
        }
    }
}

/// The same for a walk that has `begun`, inlined into callers that are compiled for `lanes`. `lane`, below sixteen, tells
/// paths apart.
#[inline(always)]
pub fn trace_here<L: Lanes<W>, const W: usize>(
    lanes: L,
    kernel: &mut Kernel<'_>,
    begun: &kernel::Walk,
    lane: usize,
) -> Hit {
    let Some(tree) = kernel.companion.tree else { return kernel.generated_trace(begun.ray) };
    let Some(nodes) = lanes.nodes(tree) else { return trace(kernel, begun.ray) };
    let hit = Walk { kernel: &mut *kernel, tree, nodes, begun, lane }.walk(lanes);
    ask_for(kernel, &hit);
    hit
}

/// Has the records of the triangle that was hit brought near: the wide kernel reads them when all paths have been traced.
#[inline(always)]
fn ask_for(kernel: &Kernel<'_>, hit: &Hit) {
    if hit.prim & PRIM_OTHER == 0 {
        let first = 3 * hit.prim as usize;
        for rows in [kernel.tri_words, kernel.shade_words] {
            if let Some([row, _, last]) = rows.get(first..first + 3) {
                tree::prefetch(row);
                tree::prefetch(last);
            }
        }
    }
}

/// The better of `best` and what lies below `child`, a reference of the tree, for a ray whose walk has `begun`. Of a
/// shadow ray that is any hit: the nearest surface that it goes through, or one that hides its light.
#[inline(always)]
pub fn trace_below<L: Lanes<W>, const W: usize>(
    lanes: L,
    kernel: &mut Kernel<'_>,
    begun: &kernel::Walk,
    child: u32,
    best: Hit,
) -> Hit {
    let Some(tree) = kernel.companion.tree else { return best };
    // Packets are only made in trees that have them.
    let Some(nodes) = lanes.nodes(tree) else { return best };
    let mut stack = std::mem::take(&mut kernel.companion.stack);
    stack.clear();
    let hit = Walk::with(kernel, (tree, nodes), (begun, child, best), lanes, &mut stack, None);
    kernel.companion.stack = stack;
    hit
}

/// A walk that is to be done.
struct Walk<'k, 'a, const W: usize> {
    kernel: &'k mut Kernel<'a>,
    tree: &'a Tree,
    /// Those of the tree.
    nodes: &'a [Node<W>],
    begun: &'k kernel::Walk,
    lane: usize,
}

/// A walk that is to be done with these instructions.
#[cfg(target_arch = "x86_64")]
struct With<'k, 'a, L, const W: usize>(Walk<'k, 'a, W>, L);

#[cfg(target_arch = "x86_64")]
impl<L: Lanes<W>, const W: usize> pulp::NullaryFnOnce for With<'_, '_, L, W> {
    type Output = Hit;

    #[inline(always)]
    fn call(self) -> Hit {
        self.0.walk(self.1)
    }
}

impl<const W: usize> Walk<'_, '_, W> {
    #[inline(always)]
    fn walk<L: Lanes<W>>(self, lanes: L) -> Hit {
        let Self { kernel, tree, nodes, begun, lane } = self;
        let mut stack = std::mem::take(&mut kernel.companion.stack);
        stack.clear();
        let mut crossings = std::mem::take(&mut kernel.companion.crossings);
        let mut crossed = crossings.get_mut(lane).filter(|_| begun.ray.light != NONE);
        let known = crossed.as_mut().and_then(|crossed| crossed.next(&begun.ray));
        let hit = if let Some(hit) = known {
            hit
        } else {
            let best = kernel.ray_miss(begun.ray.t_max);
            let from = (begun, tree.root, best);
            Self::with(kernel, (tree, nodes), from, lanes, &mut stack, crossed)
        };
        kernel.companion.crossings = crossings;
        kernel.companion.stack = stack;
        hit
    }

    #[inline(always)]
    fn with<L: Lanes<W>>(
        kernel: &mut Kernel<'_>,
        (tree, nodes): (&Tree, &[Node<W>]),
        (begun, mut child, mut hit): (&kernel::Walk, u32, Hit),
        lanes: L,
        stack: &mut Stack,
        mut crossed: Option<&mut Crossings>,
    ) -> Hit {
        // In the frame of the world, or in that of an instance: read where it is, as it is large.
        let mut walk = begun;
        let mut inside;
        // As in `trace/bvh.wgsl`.
        let t_min = walk.ray.t_min * 0.9999;
        let mut walker = Walker::new(lanes, &walk.ray, walk.inverse, t_min);
        let mut sheared = Sheared::new(kernel, &walk.ray, &walk.leaf);
        let shadow = walk.ray.light != NONE;
        if let Some(crossed) = &mut crossed {
            crossed.clear();
        }
        if child == NONE {
            return hit;
        }
        loop {
            if child & CHILD_INNER != 0 {
                // No tree leads elsewhere.
                let Some(node) = tree::node(nodes, child) else { return hit };
                let visited = walker.visit((tree, nodes), node, hit.t, shadow, stack);
                if let Some(nearest) = visited {
                    child = nearest;
                    continue;
                }
            } else if child & CHILD_SPHERES != 0 && kernel.dispatch_is_instance_leaf(child) {
                walk = begun;
                if child != CHILD_OUT {
                    inside = *begun;
                    kernel.dispatch_instance_leaf(child, begun.ray, &mut inside);
                    walk = &inside;
                }
                walker = Walker::new(lanes, &walk.ray, walk.inverse, t_min);
                sheared = Sheared::new(kernel, &walk.ray, &walk.leaf);
                if child != CHILD_OUT {
                    // Nothing lies before it: it is never left out.
                    stack.push(Waiting { child: CHILD_OUT, distance: 0.0 });
                    child = tree.root_of_instance(child);
                    continue;
                }
            } else {
                if child & (CHILD_SPHERES | MOVING) == 0 {
                    let best = (hit, crossed.as_deref_mut());
                    hit = triangles::leaf(kernel, (tree, child), &walk.ray, &sheared, best);
                } else {
                    let leaf = if child & CHILD_SPHERES != 0 { child } else { tree.moving(child) };
                    let found = kernel.leaf_trace(leaf, walk.ray, walk.leaf, hit);
                    match &mut crossed {
                        Some(crossed) if found.prim != NONE && !kernel.dispatch_ends(found) => {
                            hit.t = crossed.add_last(kernel, found, hit.t);
                        }
                        _ => hit = found,
                    }
                }
                if shadow && hit.prim != NONE && (crossed.is_some() || kernel.dispatch_ends(hit)) {
                    return hit;
                }
            }
            let Some(next) = stack.pop(hit.t) else { break };
            child = next;
        }
        crossed.map_or(hit, |crossed| crossed.first(begun.ray, hit))
    }
}

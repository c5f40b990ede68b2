//! A measure of trees that giant primitives do not upset.
//!
//! Turns a tree into the number of nodes and primitives that sample segments visit. The surface-area
//! heuristic weighs boxes by rays from far outside; a few ground quads of a thousand times the size
//! of everything else then decide alone which of two trees is "better". Segments between primitives
//! are where rays really are. Exact integer counts, the same on every machine.

use glam::Vec3;
use pack::abi::ChildRef;
use rayon::prelude::*;

use super::join::Joined;

/// Sample segments.
const N_SEGMENTS: usize = 2048;
/// Steps through the samples, coprime to their number: far ends are spread evenly.
const STRIDE: usize = 1231;
/// Part of the way to the far end: rays rarely cross half a scene before they hit something.
const REACH: f32 = 0.25;

/// Nodes visited plus primitives tested over all segments; nothing is counted as hit.
pub(super) fn visits(tree: &Joined, triangles: &[[[f32; 3]; 3]]) -> u64 {
    let corner = |sample: usize| {
        let index = sample % N_SEGMENTS * triangles.len() / N_SEGMENTS;
        Vec3::from_array(triangles[index][0])
    };
    if triangles.is_empty() {
        return 0;
    }
    let segment = |i| (corner(i), (corner(i * STRIDE + N_SEGMENTS / 2) - corner(i)) * REACH);
    (0..N_SEGMENTS)
        .into_par_iter()
        .map(segment)
        .map(|(from, along)| visits_of(tree, from, along))
        .sum()
}

fn visits_of(tree: &Joined, from: Vec3, along: Vec3) -> u64 {
    // Finite for every direction, so that no product below is NaN.
    let inv = along.map(|x| 1.0 / if x.abs() < 1e-18 { 1e-18_f32.copysign(x) } else { x });
    let crossed = |lo: [f32; 3], hi: [f32; 3]| {
        let (a, b) = ((Vec3::from(lo) - from) * inv, (Vec3::from(hi) - from) * inv);
        a.min(b).max_element().max(0.0) <= a.max(b).min_element().min(1.0)
    };
    let (mut visits, mut stack) = (0, vec![tree.root]);
    while let Some(word) = stack.pop() {
        match ChildRef::decode(word) {
            ChildRef::Inner(index) => {
                visits += 1;
                let node = &tree.nodes[index as usize];
                stack.extend(crossed(node.left_lo, node.left_hi).then_some(node.left));
                stack.extend(crossed(node.right_lo, node.right_hi).then_some(node.right));
            }
            ChildRef::Triangles { count, .. } | ChildRef::Spheres { count, .. } => {
                visits += u64::from(count);
            }
            ChildRef::Instance(_) => visits += 1,
            ChildRef::Empty => {}
        }
    }
    visits
}

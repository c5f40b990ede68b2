//! Proof that a tree is what the traversal expects.
//!
//! Turns child words into their depth, or into the reason why they are no tree: the builder's own
//! result and untrusted cache entries pass the same check. Nodes must be in depth-first order and
//! leaves in ascending order without gaps; hence every node and every primitive is reached exactly
//! once, and there are no cycles.

use pack::abi::ChildRef;
use thiserror::Error;

use super::build::MAX_INNER_LEVELS;

/// Why a tree was refused.
#[derive(Clone, Copy, Debug, Error, PartialEq, Eq)]
pub enum TreeFault {
    /// A reference leads to a node other than the next in depth-first order.
    #[error("node reference out of depth-first order")]
    NodeOrder,
    /// A leaf does not begin where the one before it ended.
    #[error("leaf ranges do not tile the primitives")]
    LeafOrder,
    /// Nodes that no reference reaches.
    #[error("unreachable nodes")]
    Unreachable,
    /// Primitives in no leaf.
    #[error("primitives in no leaf")]
    Lost,
    /// The order of the primitives names one twice or not at all.
    #[error("the primitive order is not a permutation")]
    Permutation,
    /// More inner nodes on a path than traversal stacks hold.
    #[error("tree too deep")]
    Depth,
    /// A split of what is not there, is not a triangle, or does not cross the plane.
    #[error("a split of an empty node")]
    Split,
    /// A box of a wide node that is smaller than what is in it.
    #[error("a quantised box does not contain the original box")]
    Grid,
    /// A reference to spheres or to nothing where triangles are expected.
    #[error("unexpected kind of child reference")]
    Kind,
}

/// Checks a tree of `n_nodes` nodes over `n_prims` primitives; `children` gives the two words of a
/// node. Returns the number of inner nodes on the longest path.
pub(super) fn tree_depth(
    n_nodes: usize,
    n_prims: usize,
    root: u32,
    children: impl Fn(usize) -> [u32; 2],
) -> Result<u32, TreeFault> {
    let (mut next_node, mut next_prim, mut deepest) = (0, 0, 0);
    let mut stack = Vec::with_capacity(64);
    if n_prims > 0 || root != pack::abi::NONE {
        stack.push((root, 0));
    }
    while let Some((word, depth)) = stack.pop() {
        match ChildRef::decode(word) {
            ChildRef::Inner(index) => {
                let index = index as usize;
                if index != next_node || index >= n_nodes {
                    return Err(TreeFault::NodeOrder);
                }
                if depth >= MAX_INNER_LEVELS {
                    return Err(TreeFault::Depth);
                }
                next_node += 1;
                deepest = deepest.max(depth + 1);
                let [left, right] = children(index);
                stack.push((right, depth + 1));
                stack.push((left, depth + 1));
            }
            ChildRef::Triangles { first, count } => {
                if first as usize != next_prim {
                    return Err(TreeFault::LeafOrder);
                }
                next_prim += count as usize;
            }
            ChildRef::Spheres { .. } | ChildRef::Instance(_) | ChildRef::Empty => {
                return Err(TreeFault::Kind);
            }
        }
    }
    if next_node != n_nodes {
        return Err(TreeFault::Unreachable);
    }
    if next_prim != n_prims {
        return Err(TreeFault::Lost);
    }
    Ok(deepest)
}

/// Checks that `order` holds each of `0 .. order.len()` exactly once.
pub(super) fn permutation(order: &[u32]) -> Result<(), TreeFault> {
    let mut seen = vec![0_u64; order.len().div_ceil(64)];
    for &index in order {
        let index = index as usize;
        if index >= order.len() || seen[index / 64] >> (index % 64) & 1 == 1 {
            return Err(TreeFault::Permutation);
        }
        seen[index / 64] |= 1 << (index % 64);
    }
    Ok(())
}

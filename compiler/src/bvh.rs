//! Bounding volume hierarchies: binned surface-area heuristic, binary, leaves of at most 8.
//!
//! Turns boxes of primitives into flat arrays of `pack::abi::Node` in depth-first order. Keeps these
//! invariants: every primitive is in exactly one leaf (checked after each build), leaf ranges tile
//! the primitives, a child's index is greater than its parent's, no path has more than
//! `pack::abi::MAX_DEPTH` nodes, and the bytes depend on the boxes alone, not on threads.
//! It does not know the scene language, materials or files; `cache` keeps trees on disk.

mod binned;
mod build;
mod check;
mod fragment;
mod join;
mod probe;
mod refit;
mod scene;
mod sweep;
mod top;
mod words;

use pack::abi::{NONE, Node};
use thiserror::Error;

pub use check::TreeFault;
pub use fragment::{Bounds, COORD_MAX, Fragment, MAX_PRIMITIVES};
pub use join::{Group, GroupKind, Joined, join};
pub use scene::{BuildReport, Primitives, SMALL_MESH, build_scene, plan};

/// Name and version of the builder. Any change of its results must change this.
pub const BUILDER: &str = "binned16-sweep24-v1";

/// What else the shape of a tree depends on.
pub const PARAMETERS: &str = "leaf 8, inner levels 47, node cost 1";

/// The tree of one group of primitives, with indices local to the group. Leaves are written as
/// triangles whatever they hold.
#[derive(Clone, Debug, PartialEq)]
pub struct Tree {
    /// Inner nodes in depth-first order.
    pub nodes: Vec<Node>,
    /// Reference to the root: `NONE` for no primitives, a leaf for few of them.
    pub root: u32,
    /// Primitive indices in leaf order, a permutation of `0 .. n`.
    pub order: Vec<u32>,
    /// Box of everything; `Bounds::EMPTY` for no primitives.
    pub bounds: Bounds,
    /// Most inner nodes on a path from the root to a leaf, at most 47.
    pub depth: u32,
}

/// Why no tree was built.
#[derive(Clone, Debug, Error, PartialEq, Eq)]
pub enum BvhError {
    /// More primitives than leaf references can address.
    #[error("{count} primitives of one kind, but at most {MAX_PRIMITIVES} are possible")]
    TooMany {
        /// How many there are.
        count: usize,
    },
    /// The sizes of the meshes do not add up: a bug of ours.
    #[error("the sizes of the meshes do not add up to {count} triangles")]
    Sizes {
        /// How many triangles there are.
        count: usize,
    },
    /// The builder made something that is no tree: a bug of ours.
    #[error("the tree builder failed its own check: {0}")]
    Fault(#[from] TreeFault),
}

/// Builds the tree of a group. `fragments[i]` must have index `i`.
pub fn build(mut fragments: Vec<Fragment>) -> Result<Tree, BvhError> {
    let count = fragments.len();
    if count > MAX_PRIMITIVES {
        return Err(BvhError::TooMany { count });
    }
    if count == 0 {
        let (nodes, order, bounds) = (Vec::new(), Vec::new(), Bounds::EMPTY);
        return Ok(Tree { nodes, root: NONE, order, bounds, depth: 0 });
    }
    let built = build::build(&mut fragments);
    let order: Vec<u32> = fragments.iter().map(Fragment::index).collect();
    drop(fragments);
    let bounds = built.bounds.without_lanes();
    let (nodes, root) = built.flatten();
    check::permutation(&order)?;
    let depth = check::tree_depth(nodes.len(), count, root, |i| [nodes[i].left, nodes[i].right])?;
    Ok(Tree { nodes, root, order, bounds, depth })
}

/// A tree from its shape alone: the references of all nodes and the order of the primitives, from a
/// source that is not trusted. The boxes are those of the fragments, so that a shape which passes the
/// checks is a correct tree, if not a good one.
pub fn from_shape(
    root: u32,
    children: &[[u32; 2]],
    order: Vec<u32>,
    fragments: &[Fragment],
) -> Result<Tree, TreeFault> {
    if order.len() != fragments.len() {
        return Err(TreeFault::Permutation);
    }
    check::permutation(&order)?;
    let depth = check::tree_depth(children.len(), order.len(), root, |i| children[i])?;
    let (nodes, bounds) = refit::refit(root, children, &order, fragments);
    Ok(Tree { nodes, root, order, bounds, depth })
}

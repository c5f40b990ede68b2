//! Bounding volume hierarchies: binary, leaves of at most 8, by one of several builders (`Preset`).
//!
//! Turns boxes of primitives, and corners of triangles where these may be split, into flat arrays of
//! `pack::abi::Node` in depth-first order. Keeps these invariants: every piece of a primitive is in
//! exactly one leaf and the pieces cover it (checked after each build), leaf ranges tile the pieces, a
//! child's index is greater than its parent's, no path has more than `pack::abi::MAX_DEPTH` nodes, and
//! the bytes depend on the input alone, not on threads. The finished tree becomes wide at the end
//! ([`widen`]); everything before that, the cache too, is about binary trees.
//! It does not know the scene language, materials or files; `cache` keeps trees on disk.

mod binned;
mod build;
mod check;
mod clip;
mod collapse;
mod cut;
mod fragment;
mod input;
mod join;
mod path;
mod pieces;
mod plan;
mod preset;
mod probe;
mod quantize;
mod range;
mod refit;
mod sbvh;
mod scene;
mod spatial;
mod sweep;
mod top;
mod wide;
mod words;

use pack::abi::{NONE, Node};
use thiserror::Error;

use input::Corners;

pub use check::TreeFault;
pub use fragment::{Bounds, COORD_MAX, Fragment, MAX_PRIMITIVES};
pub use input::Input;
pub use join::{Group, GroupKind, Joined, join, stack_need};
pub use path::{Motion, Path, Piece, about};
pub use pieces::Split;
pub use plan::{SMALL_MESH, plan};
pub use preset::{Preset, UnknownPreset};
pub use scene::{BuildReport, Primitives, Shared, build_instanced, build_scene};
pub use wide::{Layout, UnknownLayout, widen, widen_all};

/// The tree of one group of primitives, with indices local to the group. Leaves are written as
/// triangles whatever they hold.
#[derive(Clone, Debug, PartialEq)]
pub struct Tree {
    /// Inner nodes in depth-first order.
    pub nodes: Vec<Node>,
    /// Reference to the root: `NONE` for no primitives, a leaf for few of them.
    pub root: u32,
    /// Pieces in leaf order, a permutation of `0 .. n_primitives + splits.len()`. The first pieces are
    /// the primitives themselves.
    pub order: Vec<u32>,
    /// How the other pieces came to be: piece `n_primitives + k` by `splits[k]`.
    pub splits: Vec<Split>,
    /// Box of everything; `Bounds::EMPTY` for no primitives.
    pub bounds: Bounds,
    /// Most inner nodes on a path from the root to a leaf, at most 47.
    pub depth: u32,
}

/// Why no tree was built.
#[derive(Clone, Debug, Error, PartialEq, Eq)]
pub enum BvhError {
    /// More primitives than leaf references can address.
    #[error(
        "{count} primitives of one kind are too many; {MAX_PRIMITIVES} triangles and half as many spheres are \
         possible"
    )]
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

impl Tree {
    /// How many primitives there are.
    #[must_use]
    pub fn n_primitives(&self) -> usize {
        self.order.len() - self.splits.len()
    }

    /// The primitives in leaf order, those twice or more that were split.
    #[must_use]
    pub fn primitives(&self) -> Vec<u32> {
        let n = self.n_primitives();
        let owners = pieces::owners(&self.splits, n);
        let owner = |&piece: &u32| match (piece as usize).checked_sub(n) {
            Some(k) => owners[k],
            None => piece,
        };
        self.order.iter().map(owner).collect()
    }

    fn empty() -> Self {
        let (nodes, order, splits) = (Vec::new(), Vec::new(), Vec::new());
        Self { nodes, root: NONE, order, splits, bounds: Bounds::EMPTY, depth: 0 }
    }
}

/// Builds the tree of a group.
///
/// # Errors
/// When there are too many primitives, or the builder is broken.
pub fn build(preset: Preset, input: Input<'_>) -> Result<Tree, BvhError> {
    let count = input.fragments.len();
    if count > MAX_PRIMITIVES {
        return Err(BvhError::TooMany { count });
    }
    if count == 0 {
        return Ok(Tree::empty());
    }
    match preset.spatial().filter(|_| input.corners.len() == count) {
        Some(rules) => build_with_splits(rules, input),
        None => build_whole(preset.rule(), input.fragments),
    }
}

fn build_whole(rule: build::Rule, mut fragments: Vec<Fragment>) -> Result<Tree, BvhError> {
    let (bounds, part) = build::build(&mut fragments, rule);
    let order: Vec<u32> = fragments.iter().map(Fragment::index).collect();
    drop(fragments);
    let (build::Flat { nodes, .. }, root) = part.string();
    finish(Tree { nodes, root, order, splits: Vec::new(), bounds, depth: 0 })
}

fn build_with_splits(rules: preset::SpatialRules, input: Input<'_>) -> Result<Tree, BvhError> {
    let Input { mut fragments, corners } = input;
    let n = fragments.len();
    let extra = (n * rules.extra / 100).min(MAX_PRIMITIVES - n);
    fragments.resize(n + extra, Fragment::new([0.0; 3], [0.0; 3], 0));
    let mut splits = vec![Split::UNUSED; extra];
    let corners = Corners::new(&corners);
    let (bounds, part) = sbvh::build(&mut fragments, n, &mut splits, corners, rules);
    drop(fragments);
    let (build::Flat { nodes, mut order }, root) = part.string();
    pieces::compact(&mut splits, &mut order, n);
    finish(Tree { nodes, root, order, splits, bounds, depth: 0 })
}

/// Checks what was built.
fn finish(mut tree: Tree) -> Result<Tree, BvhError> {
    tree.bounds = tree.bounds.without_lanes();
    let Tree { nodes, order, root, .. } = &tree;
    let children = |i: usize| [nodes[i].left, nodes[i].right];
    let (complete, depth) = rayon::join(
        || check::permutation(order),
        || check::tree_depth(nodes.len(), order.len(), *root, children),
    );
    complete?;
    tree.depth = depth?;
    Ok(tree)
}

fn word_of(len: usize) -> u32 {
    u32::try_from(len).expect("at most 2^28 primitives have fewer than 2^31 nodes")
}

/// A tree from its shape alone, which comes from a source that is not trusted.
#[derive(Clone, Debug)]
pub(crate) struct Shape {
    pub(crate) root: u32,
    /// The references of all nodes.
    pub(crate) children: Vec<[u32; 2]>,
    /// Pieces in leaf order.
    pub(crate) order: Vec<u32>,
    pub(crate) splits: Vec<Split>,
}

/// The tree of this shape over `input`. The boxes are recomputed, so that a shape which passes the
/// checks is a correct tree, if not a good one.
pub(crate) fn from_shape(shape: Shape, input: &Input<'_>) -> Result<Tree, TreeFault> {
    let Shape { root, children, order, splits } = shape;
    if order.len() != input.fragments.len() + splits.len() {
        return Err(TreeFault::Permutation);
    }
    if !splits.is_empty() && input.corners.len() != input.fragments.len() {
        return Err(TreeFault::Split);
    }
    check::permutation(&order)?;
    let depth = check::tree_depth(children.len(), order.len(), root, |i| children[i])?;
    let pieces;
    let fragments = if splits.is_empty() {
        &input.fragments
    } else {
        let mut all = Vec::with_capacity(order.len());
        all.extend_from_slice(&input.fragments);
        pieces::replay(&mut all, &splits, Corners::new(&input.corners))?;
        pieces = all;
        &pieces
    };
    let (nodes, bounds) = refit::refit(root, &children, &order, fragments);
    Ok(Tree { nodes, root, order, splits, bounds, depth })
}

//! What the tree can have wrong.

use super::words::{Reference, axis};
use crate::abi;
use crate::kind::Kind;

/// What the tree can have wrong.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
pub enum BvhFault {
    /// Geometry, but no root.
    #[error("root is none, but there is geometry")]
    NoRoot,
    /// Inner nodes, but the root is not node 0.
    #[error("root is {}, but a tree with nodes starts at node 0", Reference(*found))]
    Root {
        /// The reference word.
        found: u32,
    },
    /// A child that is nothing.
    #[error("{side} is none: an inner node has two children")]
    NoChild {
        /// `left`, `right` or `child0` to `child3`.
        side: &'static str,
    },
    /// The place of a child that is not there has a box that could be hit.
    #[error("{side} is none, but its box is not 255 to 0")]
    EmptyBox {
        /// `child2` or `child3`.
        side: &'static str,
    },
    /// A child behind one that is not there.
    #[error("{side} is none, but a child follows it")]
    Gap {
        /// `child2`.
        side: &'static str,
    },
    /// A node that comes before its parent.
    #[error("{side} is node {child}, a child must come after its parent")]
    Backwards {
        /// `left`, `right` or `child0` to `child3`.
        side: &'static str,
        /// The child.
        child: u32,
    },
    /// A node that does not exist.
    #[error("{side} is node {child}, but {kind} has {count} elements")]
    NoSuchNode {
        /// `left`, `right` or `child0` to `child3`.
        side: &'static str,
        /// The child.
        child: u32,
        /// NODE or WIDENODE.
        kind: Kind,
        /// Of the section.
        count: usize,
    },
    /// A leaf beyond the primitives.
    #[error("{side} is {}, but {target} has {count} elements", Reference(*word))]
    Leaf {
        /// `left`, `right`, `child0` to `child3` or `root`.
        side: &'static str,
        /// The reference word.
        word: u32,
        /// TRIANGLE or SPHERE.
        target: Kind,
        /// Its elements.
        count: usize,
    },
    /// A node with two parents.
    #[error("{side} is node {child}, which already has a parent")]
    SharedNode {
        /// `left`, `right` or `child0` to `child3`.
        side: &'static str,
        /// The child.
        child: u32,
    },
    /// A primitive in two leaves.
    #[error("{side} is {}, but a primitive of it is in another leaf already", Reference(*word))]
    SharedLeaf {
        /// `left`, `right` or `child0` to `child3`.
        side: &'static str,
        /// The reference word.
        word: u32,
    },
    /// A reference to an instance that does not exist.
    #[error("{side} is instance {index}, but INSTANCE has {count} elements")]
    NoSuchInstance {
        /// `left`, `right` or `root`.
        side: &'static str,
        /// The instance.
        index: u32,
        /// Of the section.
        count: usize,
    },
    /// An instance in two leaves.
    #[error("{side} is instance {index}, which is in another leaf already")]
    SharedInstance {
        /// `left`, `right` or `root`.
        side: &'static str,
        /// The instance.
        index: u32,
    },
    /// The root of an instance that is neither a node nor triangles.
    #[error("root is {}, an instance shows a node or triangles", Reference(*found))]
    MeshRoot {
        /// The reference word.
        found: u32,
    },
    /// Spheres or an instance in the tree of an instance.
    #[error("{side} is {}, but the tree of an instance holds triangles", Reference(*word))]
    InMesh {
        /// `left` or `right`.
        side: &'static str,
        /// The reference word.
        word: u32,
    },
    /// Triangles of an instance outside of it, or others inside, or a light inside.
    #[error(
        "{side} is {}, of which one {}", Reference(*word),
        if *inside { "belongs to no instance, or is a light" } else { "belongs to an instance" }
    )]
    Frame {
        /// `left`, `right` or `root`.
        side: &'static str,
        /// The reference word.
        word: u32,
        /// Whether the leaf is in the tree of an instance.
        inside: bool,
    },
    /// A node that no parent names.
    #[error("no parent refers to this node")]
    Unreachable,
    /// A primitive in no leaf.
    #[error("no leaf holds this primitive")]
    Lost,
    /// A box whose lower corner is above its upper one.
    #[error("the {side} box is inverted on axis {}", axis(*axis_index))]
    Inverted {
        /// `left`, `right` or `child0` to `child3`.
        side: &'static str,
        /// 0, 1, 2.
        axis_index: usize,
    },
    /// A child's boxes reach out of the parent's box for that child.
    #[error("the boxes of node {child} exceed the {side} box on axis {}", axis(*axis_index))]
    NotNested {
        /// `left`, `right` or `child0` to `child3`.
        side: &'static str,
        /// The child.
        child: u32,
        /// 0, 1, 2.
        axis_index: usize,
    },
    /// Deeper than any stack.
    #[error("the tree needs {need} stack entries, at most {} are allowed", abi::MAX_STACK)]
    TooDeep {
        /// Recomputed.
        need: u32,
    },
    /// The stored need is not the real one.
    #[error("stack_need is {found}, but the tree needs {need}")]
    StackNeed {
        /// In the file.
        found: u32,
        /// Recomputed.
        need: u32,
    },
}

//! The tree that the CPU walks: nodes of eight or sixteen boxes in `f32`, triangles in blocks of four, lane by lane.
//!
//! It is not in the pack: `build` makes it from the pack's wide nodes when a scene is first rendered on a CPU. What it
//! decides is only which triangles a ray is tested with, and in what order.

use super::alpha_map::AlphaMaps;
use super::crossings::Crossings;
use super::few::Few;
use super::questions::{Marked, Questions};
use super::stack::Stack;
use pack::abi::{CHILD_INNER, CHILD_INSTANCE, CHILD_SPHERES, NONE};
#[cfg(target_arch = "x86_64")]
use pulp::x86::V4;

/// Triangles of a block.
pub(super) const BLOCK: usize = 4;

/// References are those of the pack, see `pack::abi::ChildRef`, but for inner nodes, whose index is that of a `Node`, and
/// triangles: bits 0 to 26 are the index of a `Block`, of two if this bit is set.
pub(super) const TWO_BLOCKS: u32 = 1 << 27;
/// A leaf that is left to the generated kernel: bits 0 to 26 are an index of `Tree::moving`.
pub(super) const MOVING: u32 = 1 << 28;
/// The bits of an index of blocks.
pub(super) const BLOCK_INDEX: u32 = TWO_BLOCKS - 1;

/// Paths that one kernel takes forward side by side, at most.
const LANES: usize = 16;

/// The most children that all nodes of a small tree have room for: some 100,000 triangles.
pub(super) const SMALL: usize = 65_536;

/// Up to `W` children. That of a child that is not there is inside out: no ray meets it.
#[derive(Clone, Copy, Debug)]
#[repr(C, align(64))]
pub struct Node<const W: usize> {
    /// For each axis the lower ends of all boxes, then the upper ones.
    pub ends: [[[f32; W]; 2]; 3],
    /// References.
    pub children: [u32; W],
}

/// How many children a node has.
#[derive(Clone, Copy, Debug, Default)]
pub enum Width {
    /// Up to eight.
    #[default]
    Eight,
    /// Up to sixteen, where the processor tests so many boxes at once.
    #[cfg(target_arch = "x86_64")]
    Sixteen(V4),
}

impl Width {
    /// What suits this processor best.
    #[must_use]
    pub fn of_processor() -> Self {
        #[cfg(target_arch = "x86_64")]
        return V4::try_new().map_or(Self::Eight, Self::Sixteen);
        #[cfg(not(target_arch = "x86_64"))]
        return Self::Eight;
    }
}

/// The nodes of a tree.
#[derive(Debug)]
pub(super) enum Nodes {
    Eights(Vec<Node<8>>),
    #[cfg(target_arch = "x86_64")]
    Sixteens(Vec<Node<16>>, V4),
}

impl Nodes {
    /// Those of eight, if they are.
    #[inline(always)]
    pub(super) fn eights(&self) -> Option<&[Node<8>]> {
        match self {
            Self::Eights(nodes) => Some(nodes),
            #[cfg(target_arch = "x86_64")]
            Self::Sixteens(..) => None,
        }
    }

    /// Those of sixteen, if they are.
    #[cfg(target_arch = "x86_64")]
    #[inline(always)]
    pub(super) fn sixteens(&self) -> Option<&[Node<16>]> {
        if let Self::Sixteens(nodes, _) = self { Some(nodes) } else { None }
    }
}

/// Up to four triangles that stand still.
#[derive(Clone, Copy, Debug)]
#[repr(C, align(32))]
pub struct Block {
    /// For each corner x, y and z; lanes without a triangle of their own repeat the last.
    pub(super) corners: [[[f32; BLOCK]; 3]; 3],
    /// Which triangles they are; none in the other lanes.
    pub triangles: [Marked; BLOCK],
}

/// A tree, and those of its instances.
#[derive(Debug)]
pub struct Tree {
    pub(super) nodes: Nodes,
    pub(super) blocks: Vec<Block>,
    /// References, as in the pack, of leaves of triangles that move.
    pub(super) moving: Vec<u32>,
    pub(super) root: u32,
    /// Roots of the instances.
    pub(super) roots: Vec<u32>,
    /// Entries that the stack needs.
    pub(super) need: usize,
    /// What is to be asked about a triangle in an instance beside its own questions.
    pub(super) in_instances: Questions,
    /// Where triangles are cut out by alpha.
    pub(super) alpha: AlphaMaps,
    /// All that is in it, if that is little.
    pub(super) few: Option<Few>,
    /// See `is_small`.
    pub(super) small: bool,
}

/// What a reference leads to.
#[derive(Clone, Copy, Debug)]
pub enum Step<'a, const W: usize> {
    /// More references.
    Node(&'a Node<W>),
    /// A leaf of triangles that stand still.
    Triangles(&'a [Block]),
    /// A leaf of spheres, as in the pack.
    Spheres,
    /// An instance, triangles that move, or nothing.
    Other,
}

impl Tree {
    /// The reference of the root of the world, or `NONE`.
    #[must_use]
    #[inline(always)]
    pub fn root(&self) -> u32 {
        self.root
    }

    /// Few nodes, over what stands still in the world: rays of a packet share enough of them.
    #[must_use]
    pub fn is_small(&self) -> bool {
        self.small
    }

    /// All that is in it, if that is little.
    #[must_use]
    #[inline(always)]
    pub fn few(&self) -> Option<&Few> {
        self.few.as_ref()
    }

    /// What is to be asked about a triangle in `instance`, or in none, beside its own questions.
    #[inline(always)]
    pub(super) fn questions(&self, instance: u32) -> Questions {
        if instance == NONE { Questions::default() } else { self.in_instances }
    }

    /// What the reference `child` leads to, where `nodes` are those of this tree.
    #[must_use]
    #[inline(always)]
    pub fn step<'a, const W: usize>(&'a self, nodes: &'a [Node<W>], child: u32) -> Step<'a, W> {
        if child & CHILD_INNER != 0 {
            node(nodes, child).map_or(Step::Other, Step::Node)
        } else if child & CHILD_SPHERES != 0 {
            if child & CHILD_INSTANCE == CHILD_INSTANCE { Step::Other } else { Step::Spheres }
        } else if child & MOVING != 0 {
            Step::Other
        } else {
            Step::Triangles(self.blocks(child))
        }
    }

    /// Has what `child` refers to brought near, where the processor can be asked: most of it is far away in memory,
    /// and what is worked out meanwhile hides some of the way.
    #[inline(always)]
    pub(super) fn ask_for<const W: usize>(&self, nodes: &[Node<W>], child: u32) {
        if child & CHILD_INNER != 0 {
            if let Some(node) = node(nodes, child) {
                for axis in &node.ends {
                    prefetch(axis);
                    if W > 8 {
                        prefetch(&axis[1]);
                    }
                }
                prefetch(&node.children);
            }
        } else if child & CHILD_SPHERES == 0
            && let Some(block) = self.blocks.get((child & BLOCK_INDEX) as usize)
        {
            prefetch(&block.corners[0]);
            prefetch(&block.corners[1][1]);
            prefetch(&block.triangles);
        }
    }

    /// The blocks of the leaf `child`.
    #[inline(always)]
    pub(super) fn blocks(&self, child: u32) -> &[Block] {
        let first = (child & BLOCK_INDEX) as usize;
        let n = if child & TWO_BLOCKS == 0 { 1 } else { 2 };
        self.blocks.get(first..first + n).unwrap_or_default()
    }

    /// The reference, as in the pack, of the leaf `child` of triangles that move.
    #[inline(always)]
    pub(super) fn moving(&self, child: u32) -> u32 {
        self.moving.get((child & BLOCK_INDEX) as usize).copied().unwrap_or(NONE)
    }

    /// The root of the instance that the leaf `child` refers to.
    #[inline(always)]
    pub(super) fn root_of_instance(&self, child: u32) -> u32 {
        self.roots.get((child & !CHILD_INSTANCE) as usize).copied().unwrap_or(NONE)
    }
}

/// The one of `nodes` that `child`, which is an inner one, refers to.
#[inline(always)]
pub(super) fn node<const W: usize>(nodes: &[Node<W>], child: u32) -> Option<&Node<W>> {
    nodes.get((child & !CHILD_INNER) as usize)
}

/// What a kernel needs to walk a tree; without one the generated kernel walks the nodes of the pack.
#[derive(Debug, Default)]
pub struct Companion<'a> {
    pub(super) tree: Option<&'a Tree>,
    pub(super) stack: Stack,
    /// Of as many paths as are traced side by side, what their shadow rays go through.
    pub(super) crossings: Vec<Crossings>,
}

impl<'a> Companion<'a> {
    /// For walks through `tree`, if there is one.
    #[must_use]
    pub fn new(tree: Option<&'a Tree>) -> Self {
        let (need, paths) = tree.map_or((0, 0), |tree| (tree.need, LANES));
        Self { tree, stack: Stack::new(need), crossings: vec![Crossings::default(); paths] }
    }

    /// The tree, if there is one.
    #[must_use]
    #[inline(always)]
    pub fn tree(&self) -> Option<&'a Tree> {
        self.tree
    }
}

/// Asks for the line of the cache in which this begins.
#[inline(always)]
pub(super) fn prefetch<T>(what: &T) {
    #[cfg(target_arch = "x86_64")]
    safe_arch::prefetch_t0(what);
    #[cfg(not(target_arch = "x86_64"))]
    let _ = what;
}

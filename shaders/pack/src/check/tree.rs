//! Checks that the tree is a tree over exactly the primitives that are there, and that the trees of instances
//! are such trees of their own.
//!
//! Turns nodes and roots into the first broken rule. Children come after their parent, so there are
//! no cycles; no node has two parents, and only roots have none, so the root and those of instances reach all;
//! leaves hold every primitive once and the world's every instance once; triangles know whether they are in the
//! tree of an instance; boxes are finite and nested; the traversal stack is as long as it says. Both
//! layouts of nodes obey the same rules; boxes of a wide node are nested up to a step of their own
//! grid, because the upper end of a grid cannot be placed everywhere.

use std::collections::BTreeSet;

use rayon::prelude::*;

use crate::abi::{
    ChildRef, EMPTY_BOX, Instance, MAX_STACK, NONE, Node, OBJECT_OF_INSTANCE, TRI_SMOOTH, WideNode,
};
use crate::bvh::{self, InnerNode};
use crate::contents::Contents;
use crate::error::{PackError, Place};
use crate::fault::BvhFault;
use crate::kind::Kind;

use super::broken::{CHUNK, element};
use super::rules::Ruled;

/// The whole tree. Structure is reported before boxes.
pub(super) fn check(contents: &Contents<'_>) -> Result<(), PackError> {
    let Contents { nodes, wide_nodes, .. } = *contents;
    if wide_nodes.is_empty() {
        return check_nodes(contents, nodes);
    }
    if !nodes.is_empty() {
        return Err(PackError::Unwanted { kind: Kind::NODE, because: ", the nodes are wide" });
    }
    check_nodes(contents, wide_nodes)
}

fn check_nodes<N: Boxes>(contents: &Contents<'_>, nodes: &[N]) -> Result<(), PackError> {
    let (structure, (boxes, need)) = rayon::join(
        || structure(contents, nodes),
        || rayon::join(|| boxes(contents, nodes), || stack(contents, nodes)),
    );
    structure.and(boxes).and(need)
}

type Corners = ([f32; 3], [f32; 3]);

/// What the checks ask a node of either layout beyond its children.
trait Boxes: InnerNode + Ruled {
    /// Children that every node has.
    const FEWEST: usize;

    /// The box of child `side`.
    fn corners(&self, side: usize) -> Corners;

    /// The box around all children, if what `structure` asks of the node is true of it.
    fn hull(&self) -> Corners;

    /// How far the box of child `side` may reach above the box that its parent has for this node.
    fn excess(&self) -> [f32; 3];

    /// What is wrong with the place of a child that is not there.
    fn empty_fault(&self, side: usize) -> Option<BvhFault>;

    /// The first axis along which the box of child `side` is inside out.
    fn inverted(&self, side: usize) -> Option<usize>;
}

impl Boxes for Node {
    const FEWEST: usize = 2;

    #[inline]
    fn corners(&self, side: usize) -> Corners {
        [(self.left_lo, self.left_hi), (self.right_lo, self.right_hi)][side]
    }

    #[inline]
    fn hull(&self) -> Corners {
        // A number wins over a NaN.
        let low = |axis: usize| self.left_lo[axis].min(self.right_lo[axis]);
        let high = |axis: usize| self.left_hi[axis].max(self.right_hi[axis]);
        ([low(0), low(1), low(2)], [high(0), high(1), high(2)])
    }

    #[inline]
    fn excess(&self) -> [f32; 3] {
        [0.0; 3]
    }

    fn empty_fault(&self, _: usize) -> Option<BvhFault> {
        None
    }

    #[inline]
    fn inverted(&self, side: usize) -> Option<usize> {
        let (lo, hi) = self.corners(side);
        (0..3).find(|axis| lo[*axis] > hi[*axis])
    }
}

impl Boxes for WideNode {
    const FEWEST: usize = 2;

    #[inline]
    fn corners(&self, side: usize) -> Corners {
        WideNode::corners(self, side).into()
    }

    #[inline]
    fn hull(&self) -> Corners {
        WideNode::hull(self).into()
    }

    #[inline]
    fn excess(&self) -> [f32; 3] {
        self.scale
    }

    fn empty_fault(&self, side: usize) -> Option<BvhFault> {
        let name = Self::SIDES[side];
        if (side + 1..Self::SIDES.len()).any(|later| self.child(later) != NONE) {
            return Some(BvhFault::Gap { side: name });
        }
        let open = self.steps(side) != EMPTY_BOX.map(|end| [end; 3]);
        open.then_some(BvhFault::EmptyBox { side: name })
    }

    #[inline]
    fn inverted(&self, side: usize) -> Option<usize> {
        let [lo, hi] = self.steps(side);
        (0..3).find(|axis| lo[*axis] > hi[*axis])
    }
}

/// One bit an element; `take` says whether all of a range were still free.
struct Taken(Vec<u64>, usize);

impl Taken {
    fn new(len: usize) -> Self {
        Self(vec![0; len.div_ceil(64)], len)
    }

    /// Marks `first..first + count`, 1 to 64 elements, all inside; false when one was marked.
    fn take(&mut self, first: usize, count: usize) -> bool {
        let (word, bit) = (first / 64, first % 64);
        let mask = u64::MAX >> (64 - count);
        let low = mask << bit;
        let mut free = self.0[word] & low == 0;
        self.0[word] |= low;
        if bit + count > 64 {
            let high = mask >> (64 - bit);
            free &= self.0[word + 1] & high == 0;
            self.0[word + 1] |= high;
        }
        free
    }

    /// Whether an element inside is marked.
    fn has(&self, index: usize) -> bool {
        self.0[index / 64] >> (index % 64) & 1 == 1
    }

    /// First element that nobody took.
    fn first_free(&self) -> Option<usize> {
        let word = self.0.iter().position(|word| *word != u64::MAX)?;
        let index = word * 64 + self.0[word].trailing_ones() as usize;
        (index < self.1).then_some(index)
    }
}

/// Root, order of children, one parent a node, one leaf a primitive.
fn structure<N: Boxes>(contents: &Contents<'_>, nodes: &[N]) -> Result<(), PackError> {
    let mut walk = Walk {
        contents,
        kind: N::KIND,
        nodes: Taken::new(nodes.len()),
        in_mesh: Taken::new(nodes.len()),
        triangles: Taken::new(contents.triangles.len()),
        spheres: Taken::new(contents.spheres.len()),
        instances: Taken::new(contents.instances.len()),
    };
    walk.root().map_err(|fault| PackError::Bvh { at: root_place(), fault })?;
    walk.meshes()?;
    for (index, node) in nodes.iter().enumerate() {
        for (side, name) in N::SIDES.iter().enumerate() {
            let word = node.child(side);
            let fault = if word == NONE && side >= N::FEWEST {
                node.empty_fault(side).map_or(Ok(()), Err)
            } else {
                walk.child(index, name, word)
            };
            fault.map_err(|fault| node_error::<N>(index, fault))?;
        }
    }
    let lost = |kind: Kind, index: usize, size: usize, fault| {
        let at = Place { kind, index, offset: index * size };
        Err(PackError::Bvh { at, fault })
    };
    if let Some(index) = walk.nodes.first_free() {
        return lost(N::KIND, index, size_of::<N>(), BvhFault::Unreachable);
    }
    if let Some(index) = walk.triangles.first_free() {
        return lost(Kind::TRIANGLE, index, size_of::<crate::abi::Triangle>(), BvhFault::Lost);
    }
    if let Some(index) = walk.spheres.first_free() {
        return lost(Kind::SPHERE, index, size_of::<crate::abi::Sphere>(), BvhFault::Lost);
    }
    if let Some(index) = walk.instances.first_free() {
        return lost(Kind::INSTANCE, index, size_of::<Instance>(), BvhFault::Lost);
    }
    Ok(())
}

/// What has been reached so far.
struct Walk<'a> {
    contents: &'a Contents<'a>,
    /// Of the nodes.
    kind: Kind,
    nodes: Taken,
    /// Nodes that were reached from the root of an instance.
    in_mesh: Taken,
    triangles: Taken,
    spheres: Taken,
    instances: Taken,
}

impl Walk<'_> {
    fn root(&mut self) -> Result<(), BvhFault> {
        let word = self.contents.render.root;
        let contents = self.contents;
        let empty = contents.triangles.is_empty() && contents.spheres.is_empty();
        match ChildRef::decode(word) {
            ChildRef::Empty if !empty => Err(BvhFault::NoRoot),
            // Nodes without a root would be unreachable, which is what the caller finds.
            ChildRef::Empty => Ok(()),
            ChildRef::Inner(0) if self.nodes.1 > 0 => {
                self.nodes.take(0, 1);
                Ok(())
            }
            ChildRef::Inner(_) => Err(BvhFault::Root { found: word }),
            ChildRef::Triangles { .. } | ChildRef::Spheres { .. } | ChildRef::Instance(_) => {
                self.end("root", word, false)
            }
        }
    }

    /// The roots of instances, of which several may show the same tree.
    fn meshes(&mut self) -> Result<(), PackError> {
        let mut known = BTreeSet::new();
        for (index, instance) in self.contents.instances.iter().enumerate() {
            if known.insert(instance.root) {
                let at =
                    Place { kind: Kind::INSTANCE, index, offset: index * size_of::<Instance>() };
                self.mesh(instance.root).map_err(|fault| PackError::Bvh { at, fault })?;
            }
        }
        Ok(())
    }

    fn mesh(&mut self, word: u32) -> Result<(), BvhFault> {
        match ChildRef::decode(word) {
            ChildRef::Inner(child) => self.node("root", child, true),
            ChildRef::Triangles { .. } => self.end("root", word, true),
            ChildRef::Spheres { .. } | ChildRef::Instance(_) | ChildRef::Empty => {
                Err(BvhFault::MeshRoot { found: word })
            }
        }
    }

    #[inline]
    fn child(&mut self, parent: usize, side: &'static str, word: u32) -> Result<(), BvhFault> {
        let in_mesh = self.in_mesh.has(parent);
        match ChildRef::decode(word) {
            ChildRef::Inner(child) if child as usize <= parent => {
                Err(BvhFault::Backwards { side, child })
            }
            ChildRef::Inner(child) => self.node(side, child, in_mesh),
            ChildRef::Empty => Err(BvhFault::NoChild { side }),
            ChildRef::Triangles { .. } | ChildRef::Spheres { .. } | ChildRef::Instance(_) => {
                self.end(side, word, in_mesh)
            }
        }
    }

    #[inline]
    fn node(&mut self, side: &'static str, child: u32, in_mesh: bool) -> Result<(), BvhFault> {
        let (index, kind, count) = (child as usize, self.kind, self.nodes.1);
        if index >= count {
            return Err(BvhFault::NoSuchNode { side, child, kind, count });
        }
        if in_mesh {
            self.in_mesh.take(index, 1);
        }
        if self.nodes.take(index, 1) { Ok(()) } else { Err(BvhFault::SharedNode { side, child }) }
    }

    /// A leaf or an instance.
    #[inline]
    fn end(&mut self, side: &'static str, word: u32, in_mesh: bool) -> Result<(), BvhFault> {
        match ChildRef::decode(word) {
            ChildRef::Triangles { first, count } => {
                leaf(&mut self.triangles, Kind::TRIANGLE, side, word, (first, count))?;
                let shades = &self.contents.shades[first as usize..][..count as usize];
                let fits = shades.iter().all(|shade| {
                    let of_instance = shade.object & !TRI_SMOOTH == OBJECT_OF_INSTANCE;
                    of_instance == in_mesh && !(in_mesh && shade.light != NONE)
                });
                if fits { Ok(()) } else { Err(BvhFault::Frame { side, word, inside: in_mesh }) }
            }
            _ if in_mesh => Err(BvhFault::InMesh { side, word }),
            ChildRef::Spheres { first, count } => {
                leaf(&mut self.spheres, Kind::SPHERE, side, word, (first, count))
            }
            ChildRef::Instance(index) => {
                let count = self.contents.instances.len();
                if index as usize >= count {
                    return Err(BvhFault::NoSuchInstance { side, index, count });
                }
                let free = self.instances.take(index as usize, 1);
                if free { Ok(()) } else { Err(BvhFault::SharedInstance { side, index }) }
            }
            ChildRef::Inner(_) | ChildRef::Empty => Err(BvhFault::NoChild { side }),
        }
    }
}

/// A range of primitives that are in no other leaf.
#[inline]
fn leaf(
    taken: &mut Taken,
    target: Kind,
    side: &'static str,
    word: u32,
    (first, count): (u32, u32),
) -> Result<(), BvhFault> {
    // 27 and 3 bits: the sum cannot wrap.
    if (first + count) as usize > taken.1 {
        return Err(BvhFault::Leaf { side, word, target, count: taken.1 });
    }
    let free = taken.take(first as usize, count as usize);
    if free { Ok(()) } else { Err(BvhFault::SharedLeaf { side, word }) }
}

/// Finite, not inside out, and inside the box that the parent has for them.
fn boxes<N: Boxes>(contents: &Contents<'_>, nodes: &[N]) -> Result<(), PackError> {
    let bad = nodes.par_chunks(CHUNK).enumerate().find_map_first(|(chunk, part)| {
        (chunk * CHUNK..).zip(part).find_map(|(index, node)| {
            if let Some(broken) = node.broken(contents) {
                return Some(element::<N>(index, broken));
            }
            let mut there = (0..N::SIDES.len()).filter(|side| node.child(*side) != NONE);
            let fault = there.find_map(|side| box_fault(nodes, node, side))?;
            Some(node_error::<N>(index, fault))
        })
    });
    bad.map_or(Ok(()), Err)
}

/// What is wrong with the box of a child that is there.
#[inline]
fn box_fault<N: Boxes>(nodes: &[N], node: &N, side: usize) -> Option<BvhFault> {
    let name = N::SIDES[side];
    if let Some(axis_index) = node.inverted(side) {
        return Some(BvhFault::Inverted { side: name, axis_index });
    }
    let ChildRef::Inner(child) = ChildRef::decode(node.child(side)) else { return None };
    // An index beyond the nodes is the structure's fault.
    let inner = nodes.get(child as usize)?;
    let ((lo, hi), excess) = (node.corners(side), inner.excess());
    let (low, high) = inner.hull();
    // A NaN is reported at the node that has it: it is not outside here.
    let outside = |axis: usize| low[axis] < lo[axis] || high[axis] > hi[axis] + excess[axis];
    let axis_index = (0..3).find(|axis| outside(*axis))?;
    Some(BvhFault::NotNested { side: name, child, axis_index })
}

/// The stack is as long as the settings say, and not longer than any kernel's.
fn stack<N: Boxes>(contents: &Contents<'_>, nodes: &[N]) -> Result<(), PackError> {
    let need = bvh::stack_need(nodes, contents.instances, contents.render.root);
    let found = contents.render.stack_need;
    let fault = if need > MAX_STACK {
        BvhFault::TooDeep { need }
    } else if found != need {
        BvhFault::StackNeed { found, need }
    } else {
        return Ok(());
    };
    Err(PackError::Bvh { at: root_place(), fault })
}

fn root_place() -> Place {
    Place { kind: Kind::RENDER, index: 0, offset: 0 }
}

fn node_error<N: Boxes>(index: usize, fault: BvhFault) -> PackError {
    let at = Place { kind: N::KIND, index, offset: index * size_of::<N>() };
    PackError::Bvh { at, fault }
}

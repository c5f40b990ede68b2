//! Checks that the tree is a tree over exactly the primitives that are there.
//!
//! Turns nodes and root into the first broken rule. Children come after their parent, so there are
//! no cycles; no node has two parents and none has none, so node 0 reaches all; leaves hold every
//! primitive once; boxes are finite and nested; the traversal stack is as long as it says.

use rayon::prelude::*;

use crate::abi::{ChildRef, MAX_STACK, Node};
use crate::bvh;
use crate::contents::Contents;
use crate::error::{PackError, Place};
use crate::fault::BvhFault;
use crate::kind::Kind;

use super::rules::Ruled;
use super::{CHUNK, element};

/// The whole tree. Structure is reported before boxes.
pub(super) fn check(contents: &Contents<'_>) -> Result<(), PackError> {
    let (structure, (boxes, need)) =
        rayon::join(|| structure(contents), || rayon::join(|| boxes(contents), || stack(contents)));
    structure.and(boxes).and(need)
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

    /// First element that nobody took.
    fn first_free(&self) -> Option<usize> {
        let word = self.0.iter().position(|word| *word != u64::MAX)?;
        let index = word * 64 + self.0[word].trailing_ones() as usize;
        (index < self.1).then_some(index)
    }
}

/// Root, order of children, one parent a node, one leaf a primitive.
fn structure(contents: &Contents<'_>) -> Result<(), PackError> {
    let mut walk = Walk {
        contents,
        nodes: Taken::new(contents.nodes.len()),
        triangles: Taken::new(contents.triangles.len()),
        spheres: Taken::new(contents.spheres.len()),
    };
    walk.root().map_err(|fault| PackError::Bvh { at: root_place(), fault })?;
    for (index, node) in contents.nodes.iter().enumerate() {
        for (side, word) in [("left", node.left), ("right", node.right)] {
            walk.child(index, side, word).map_err(|fault| node_error(index, fault))?;
        }
    }
    let lost = |kind: Kind, index: usize, size: usize, fault| {
        let at = Place { kind, index, offset: index * size };
        Err(PackError::Bvh { at, fault })
    };
    if let Some(index) = walk.nodes.first_free() {
        return lost(Kind::NODE, index, size_of::<Node>(), BvhFault::Unreachable);
    }
    if let Some(index) = walk.triangles.first_free() {
        return lost(Kind::TRIANGLE, index, size_of::<crate::abi::Triangle>(), BvhFault::Lost);
    }
    if let Some(index) = walk.spheres.first_free() {
        return lost(Kind::SPHERE, index, size_of::<crate::abi::Sphere>(), BvhFault::Lost);
    }
    Ok(())
}

/// What has been reached so far.
struct Walk<'a> {
    contents: &'a Contents<'a>,
    nodes: Taken,
    triangles: Taken,
    spheres: Taken,
}

impl Walk<'_> {
    fn root(&mut self) -> Result<(), BvhFault> {
        let word = self.contents.render.root;
        let empty = self.contents.triangles.is_empty() && self.contents.spheres.is_empty();
        match ChildRef::decode(word) {
            ChildRef::Empty if !empty => Err(BvhFault::NoRoot),
            // Nodes without a root would be unreachable, which is what the caller finds.
            ChildRef::Empty => Ok(()),
            ChildRef::Inner(0) if !self.contents.nodes.is_empty() => {
                self.nodes.take(0, 1);
                Ok(())
            }
            ChildRef::Inner(_) => Err(BvhFault::Root { found: word }),
            ChildRef::Triangles { first, count } | ChildRef::Spheres { first, count } => {
                self.leaf("root", word, first, count)
            }
        }
    }

    #[inline]
    fn child(&mut self, parent: usize, side: &'static str, word: u32) -> Result<(), BvhFault> {
        match ChildRef::decode(word) {
            ChildRef::Inner(child) => {
                let count = self.contents.nodes.len();
                if child as usize >= count {
                    return Err(BvhFault::NoSuchNode { side, child, count });
                }
                if child as usize <= parent {
                    return Err(BvhFault::Backwards { side, child });
                }
                let free = self.nodes.take(child as usize, 1);
                if free { Ok(()) } else { Err(BvhFault::SharedNode { side, child }) }
            }
            ChildRef::Triangles { first, count } | ChildRef::Spheres { first, count } => {
                self.leaf(side, word, first, count)
            }
            ChildRef::Empty => Err(BvhFault::NoChild { side }),
        }
    }

    #[inline]
    fn leaf(
        &mut self,
        side: &'static str,
        word: u32,
        first: u32,
        count: u32,
    ) -> Result<(), BvhFault> {
        let (target, taken) = match ChildRef::decode(word) {
            ChildRef::Spheres { .. } => (Kind::SPHERE, &mut self.spheres),
            _ => (Kind::TRIANGLE, &mut self.triangles),
        };
        // 27 and 3 bits: the sum cannot wrap.
        if (first + count) as usize > taken.1 {
            return Err(BvhFault::Leaf { side, word, target, count: taken.1 });
        }
        let free = taken.take(first as usize, count as usize);
        if free { Ok(()) } else { Err(BvhFault::SharedLeaf { side, word }) }
    }
}

/// Finite, not inside out, and inside the box that the parent has for them.
fn boxes(contents: &Contents<'_>) -> Result<(), PackError> {
    let nodes = contents.nodes;
    let bad = nodes.par_chunks(CHUNK).enumerate().find_map_first(|(chunk, part)| {
        (chunk * CHUNK..).zip(part).find_map(|(index, node)| {
            if let Some(broken) = node.broken(contents) {
                return Some(element::<Node>(index, broken));
            }
            let fault = box_fault(nodes, "left", (node.left_lo, node.left_hi), node.left).or_else(
                || box_fault(nodes, "right", (node.right_lo, node.right_hi), node.right),
            )?;
            Some(node_error(index, fault))
        })
    });
    bad.map_or(Ok(()), Err)
}

type Corners = ([f32; 3], [f32; 3]);

#[inline]
fn box_fault(nodes: &[Node], side: &'static str, outer: Corners, word: u32) -> Option<BvhFault> {
    let (lo, hi) = outer;
    if let Some(axis_index) = (0..3).find(|axis| lo[*axis] > hi[*axis]) {
        return Some(BvhFault::Inverted { side, axis_index });
    }
    let ChildRef::Inner(child) = ChildRef::decode(word) else { return None };
    // An index beyond the nodes is the structure's fault.
    let inner = nodes.get(child as usize)?;
    // A NaN is reported at the node that has it: it is not outside here.
    let axis_index = (0..3).find(|&axis| {
        inner.left_lo[axis] < lo[axis]
            || inner.right_lo[axis] < lo[axis]
            || inner.left_hi[axis] > hi[axis]
            || inner.right_hi[axis] > hi[axis]
    })?;
    Some(BvhFault::NotNested { side, child, axis_index })
}

/// The stack is as long as the settings say, and not longer than any kernel's.
fn stack(contents: &Contents<'_>) -> Result<(), PackError> {
    let need = bvh::stack_need(contents.nodes, contents.render.root);
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

fn node_error(index: usize, fault: BvhFault) -> PackError {
    let at = Place { kind: Kind::NODE, index, offset: index * size_of::<Node>() };
    PackError::Bvh { at, fault }
}

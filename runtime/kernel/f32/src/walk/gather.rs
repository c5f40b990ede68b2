//! Which children a node of eight has.
//!
//! Turns an inner node of a pack into at most eight children: from the top down, the largest child is replaced by its own
//! children while there is room. The triangles of small subtrees share a block, and so do those of leaves whose common
//! box is no larger than their own together. It does not number anything.

use super::tree::{BLOCK, WIDTH};
use pack::abi::{ChildRef, MOVES, Triangle, WideNode};

/// Lower and upper corner.
type Corners = [[f32; 3]; 2];

/// The tree of a pack.
pub(super) struct Source<'a> {
    pub(super) nodes: &'a [WideNode],
    pub(super) triangles: &'a [Triangle],
}

/// What a child is.
#[derive(Clone, Copy, Debug)]
pub(super) enum Item {
    /// An inner node of the pack.
    Inner(u32),
    /// Triangles that fit into a block.
    Few {
        /// The first `n` count.
        triangles: [u32; BLOCK],
        /// How many.
        n: usize,
    },
    /// Triangles that take two blocks.
    Many {
        /// First triangle.
        first: u32,
        /// How many.
        count: u32,
    },
    /// The reference of a leaf with triangles that move.
    Moving(u32),
    /// The reference of spheres or of an instance.
    Other(u32),
}

/// A child and its box.
#[derive(Clone, Copy, Debug)]
pub(super) struct Child {
    pub(super) corners: Corners,
    pub(super) item: Item,
}

impl Source<'_> {
    /// The children of a node that stands for inner node `index`.
    pub(super) fn gather(&self, index: u32) -> Vec<Child> {
        let mut children = Vec::with_capacity(WIDTH);
        self.open(index, &mut children);
        while self.open_largest(&mut children) || share_block(&mut children) {}
        children
    }

    /// What the reference `word` of the pack is, in a box.
    pub(super) fn child(&self, word: u32, corners: Corners) -> Child {
        let mut few = Few::default();
        let item = if self.collect(word, &mut few) {
            Item::Few { triangles: few.triangles, n: few.n }
        } else {
            match ChildRef::decode(word) {
                ChildRef::Inner(index) => Item::Inner(index),
                ChildRef::Triangles { first, count } if self.moves(first, count) => {
                    Item::Moving(word)
                }
                ChildRef::Triangles { first, count } => Item::Many { first, count },
                ChildRef::Spheres { .. } | ChildRef::Instance(_) | ChildRef::Empty => {
                    Item::Other(word)
                }
            }
        };
        Child { corners, item }
    }

    /// Appends the children of inner node `index`.
    fn open(&self, index: u32, children: &mut Vec<Child>) {
        let node = &self.nodes[index as usize];
        let there = |(_, word): &(usize, u32)| ChildRef::decode(*word) != ChildRef::Empty;
        let words = node.words().into_iter().enumerate().filter(there);
        children.extend(words.map(|(slot, word)| self.child(word, node.corners(slot))));
    }

    /// Replaces the largest child of which there is room for its children.
    fn open_largest(&self, children: &mut Vec<Child>) -> bool {
        let room = WIDTH + 1 - children.len();
        let fits = |index: u32| {
            let words = self.nodes[index as usize].words();
            words.iter().filter(|word| ChildRef::decode(**word) != ChildRef::Empty).count() <= room
        };
        let inner = children.iter().enumerate().filter_map(|(slot, child)| match child.item {
            Item::Inner(index) if fits(index) => Some((slot, index, area(&child.corners))),
            _ => None,
        });
        let Some((slot, index, _)) = inner.max_by(|a, b| a.2.total_cmp(&b.2)) else { return false };
        children.swap_remove(slot);
        self.open(index, children);
        true
    }

    /// Appends the triangles of a leaf, or of a node that has nothing but leaves; false if they are too many, or if there
    /// is anything else.
    fn collect(&self, word: u32, few: &mut Few) -> bool {
        match ChildRef::decode(word) {
            ChildRef::Inner(index) => {
                let words = self.nodes[index as usize].words();
                let refs = words.map(ChildRef::decode);
                let end = |child: &ChildRef| !matches!(child, ChildRef::Inner(_));
                refs.iter().all(end)
                    && words.into_iter().all(|word| {
                        ChildRef::decode(word) == ChildRef::Empty || self.collect(word, few)
                    })
            }
            ChildRef::Triangles { first, count } => {
                let n = few.n + count as usize;
                if n > BLOCK || self.moves(first, count) {
                    return false;
                }
                for (place, i) in few.triangles[few.n..n].iter_mut().zip(first..) {
                    *place = i;
                }
                few.n = n;
                true
            }
            ChildRef::Spheres { .. } | ChildRef::Instance(_) | ChildRef::Empty => false,
        }
    }

    /// Whether one of these triangles moves while the shutter is open.
    fn moves(&self, first: u32, count: u32) -> bool {
        let triangles = &self.triangles[first as usize..(first + count) as usize];
        triangles.iter().any(|triangle| triangle.id0 & MOVES != 0)
    }
}

/// Triangles that fit into a block.
#[derive(Default)]
struct Few {
    triangles: [u32; BLOCK],
    n: usize,
}

/// Lets two leaves share a block: those whose common box is smallest beside their own, if it is no larger.
fn share_block(children: &mut Vec<Child>) -> bool {
    let mut best: Option<(f32, usize, usize)> = None;
    for (k, b) in children.iter().enumerate() {
        for (j, a) in children[..k].iter().enumerate() {
            let (Item::Few { n: n_a, .. }, Item::Few { n: n_b, .. }) = (a.item, b.item) else {
                continue;
            };
            let more = area(&around(&a.corners, &b.corners)) - area(&a.corners) - area(&b.corners);
            if n_a + n_b <= BLOCK && more <= best.map_or(0.0, |(least, ..)| least) {
                best = Some((more, j, k));
            }
        }
    }
    let Some((_, j, k)) = best else { return false };
    let b = children.swap_remove(k);
    if let (Item::Few { triangles, n }, Item::Few { triangles: more, n: n_more }) =
        (&mut children[j].item, b.item)
    {
        triangles[*n..*n + n_more].copy_from_slice(&more[..n_more]);
        *n += n_more;
    }
    children[j].corners = around(&children[j].corners, &b.corners);
    true
}

/// The box around two.
fn around([a, b]: &Corners, [c, d]: &Corners) -> Corners {
    let each = |f: fn(f32, f32) -> f32, a: &[f32; 3], c: &[f32; 3]| {
        [f(a[0], c[0]), f(a[1], c[1]), f(a[2], c[2])]
    };
    [each(f32::min, a, c), each(f32::max, b, d)]
}

/// Half the surface of a box.
fn area([lo, hi]: &Corners) -> f32 {
    let [x, y, z] = [0, 1, 2].map(|axis| hi[axis] - lo[axis]);
    x * y + y * z + z * x
}

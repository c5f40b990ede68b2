//! Which children a node has: the collapse of a tree into wider nodes that costs rays least.
//!
//! Turns inner nodes of a pack into a binary tree, and finds for each subtree, from the leaves up, what it costs at least
//! in each number of places of a node above: as nodes of its own, opened, or as a block of triangles (Ylitie, Karras &
//! Laine 2017, "Efficient Incoherent Ray Traversal on GPUs Through Compressed Wide BVHs", HPG, section 3.1). A node and a
//! block cost the area of their boxes, as the surface-area heuristic has it. It does not number anything.

use super::questions::{Marked, Questions};
use super::tree::BLOCK;
use pack::abi::{ChildRef, MOVES, Material, TriShade, Triangle, WideNode};

/// Lower and upper corner.
type Corners = [[f32; 3]; 2];

/// The tree of a pack.
pub(super) struct Source<'a> {
    pub(super) nodes: &'a [WideNode],
    pub(super) triangles: &'a [Triangle],
    pub(super) shades: &'a [TriShade],
    pub(super) materials: &'a [Material],
}

/// What a child is.
#[derive(Clone, Copy, Debug)]
pub(super) enum Item {
    /// A subtree of the plan that becomes a node.
    Node(usize),
    /// An inner node of the pack that is no part of the plan.
    Inner(u32),
    /// Triangles that fit into a block.
    Few(Few),
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

/// Triangles that fit into a block.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Few {
    triangles: [u32; BLOCK],
    n: usize,
}

/// A child and its box.
#[derive(Clone, Copy, Debug)]
pub(super) struct Child {
    pub(super) corners: Corners,
    pub(super) item: Item,
}

/// The collapse of a tree into nodes of up to `W` children.
pub(super) struct Plan<const W: usize> {
    /// Those below come before those above.
    subtrees: Vec<Subtree<W>>,
    root: Option<usize>,
}

/// A subtree of the binary tree, and what it costs.
struct Subtree<const W: usize> {
    corners: Corners,
    content: Content,
    /// The least cost in one place, in two, and so on.
    costs: [f32; W],
    /// How many of these places the first half takes; 0: the last place stays free.
    firsts: [u8; W],
    /// The same for a node of its own.
    own: u8,
}

#[derive(Clone, Copy)]
enum Content {
    End(Item),
    Halves {
        halves: [usize; 2],
        /// All that is in both, if a block holds that.
        few: Option<Few>,
    },
}

impl Few {
    /// Which they are.
    pub(super) fn triangles(&self) -> &[u32] {
        &self.triangles[..self.n]
    }

    fn range(first: u32, count: u32) -> Option<Self> {
        let mut few = Self { n: count as usize, ..Self::default() };
        let places = few.triangles.get_mut(..few.n)?;
        places.iter_mut().zip(first..).for_each(|(place, i)| *place = i);
        Some(few)
    }

    /// All of both, if there is room.
    fn and(mut self, other: &Self) -> Option<Self> {
        let n = self.n + other.n;
        self.triangles.get_mut(self.n..n)?.copy_from_slice(other.triangles());
        Some(Self { n, ..self })
    }
}

impl Source<'_> {
    /// What the reference `word` of the pack is.
    pub(super) fn item(&self, word: u32) -> Item {
        match ChildRef::decode(word) {
            ChildRef::Inner(index) => Item::Inner(index),
            ChildRef::Triangles { first, count } if self.moves(first, count) => Item::Moving(word),
            ChildRef::Triangles { first, count } => {
                Few::range(first, count).map_or(Item::Many { first, count }, Item::Few)
            }
            ChildRef::Spheres { .. } | ChildRef::Instance(_) | ChildRef::Empty => Item::Other(word),
        }
    }

    /// Triangle `i`, and what has to be asked about it.
    pub(super) fn marked(&self, i: u32) -> Marked {
        Marked::new(i, Questions::of(self.materials, self.shades.get(i as usize)))
    }

    /// Whether one of these triangles moves while the shutter is open.
    fn moves(&self, first: u32, count: u32) -> bool {
        let triangles = &self.triangles[first as usize..(first + count) as usize];
        triangles.iter().any(|triangle| triangle.id0 & MOVES != 0)
    }

    /// The children of an inner node.
    fn children(&self, index: u32) -> impl Iterator<Item = Child> {
        let node = &self.nodes[index as usize];
        let there = |(_, word): &(usize, u32)| ChildRef::decode(*word) != ChildRef::Empty;
        let words = node.words().into_iter().enumerate().filter(there);
        words.map(|(slot, word)| Child { corners: node.corners(slot), item: self.item(word) })
    }
}

impl<const W: usize> Plan<W> {
    /// Collapses the tree below inner node `index` of the pack. Takes the pack's nodes breadth first until more than
    /// `left` wait; these stay `Item::Inner`.
    pub(super) fn new(source: &Source<'_>, index: u32, left: usize) -> Self {
        let mut opened = vec![index];
        // Where the children of each begin.
        let mut starts = Vec::new();
        while starts.len() < opened.len() && opened.len() - starts.len() <= left {
            starts.push(opened.len());
            let inner = |child: Child| if let Item::Inner(i) = child.item { Some(i) } else { None };
            opened.extend(source.children(opened[starts.len() - 1]).filter_map(inner));
        }
        let mut plan = Self { subtrees: Vec::with_capacity(4 * starts.len()), root: None };
        let mut roots = vec![None; starts.len()];
        for (at, &start) in starts.iter().enumerate().rev() {
            let mut next = start..;
            let subtree = |child: Child| match child.item {
                Item::Inner(_) => match next.next().and_then(|at| roots.get(at)) {
                    Some(root) => root.map(|root| plan.fit(root, child.corners)),
                    None => Some(plan.push(child.corners, Content::End(child.item))),
                },
                _ => Some(plan.push(child.corners, Content::End(child.item))),
            };
            let children = source.children(opened[at]).filter_map(subtree).collect();
            roots[at] = plan.join(children);
        }
        plan.root = roots[0];
        plan
    }

    /// The children of the topmost node.
    pub(super) fn top(&self) -> Vec<Child> {
        match self.root {
            Some(root) if self.is_node(root) => self.children(root),
            root => root.map(|root| self.child(root)).into_iter().collect(),
        }
    }

    /// The children of the node that a subtree becomes.
    pub(super) fn children(&self, subtree: usize) -> Vec<Child> {
        let mut children = Vec::with_capacity(W);
        if let Content::Halves { halves: [a, b], .. } = self.subtrees[subtree].content {
            let own = usize::from(self.subtrees[subtree].own);
            self.place(a, own, &mut children);
            self.place(b, W - own, &mut children);
        }
        children
    }

    /// Puts a subtree into so many places.
    fn place(&self, subtree: usize, places: usize, children: &mut Vec<Child>) {
        let Subtree { content, firsts, .. } = &self.subtrees[subtree];
        let used = (2..=places).rev().find(|n| firsts[n - 1] != 0);
        if let (Content::Halves { halves: [a, b], .. }, Some(places)) = (content, used) {
            let first = usize::from(firsts[places - 1]);
            self.place(*a, first, children);
            self.place(*b, places - first, children);
        } else {
            children.push(self.child(subtree));
        }
    }

    fn is_node(&self, subtree: usize) -> bool {
        matches!(self.child(subtree).item, Item::Node(_))
    }

    /// A subtree in one place.
    fn child(&self, subtree: usize) -> Child {
        let Subtree { corners, content, .. } = self.subtrees[subtree];
        let item = match content {
            Content::End(item) => item,
            Content::Halves { few, .. } => few.map_or(Item::Node(subtree), Item::Few),
        };
        Child { corners, item }
    }

    /// One subtree of several, of which those with the smallest common box come together first.
    fn join(&mut self, mut subtrees: Vec<usize>) -> Option<usize> {
        loop {
            let mut best: Option<(f32, usize, usize)> = None;
            for (k, b) in subtrees.iter().enumerate() {
                for (j, a) in subtrees[..k].iter().enumerate() {
                    let area = area(&self.around([*a, *b]));
                    if best.is_none_or(|(least, ..)| area < least) {
                        best = Some((area, j, k));
                    }
                }
            }
            let Some((_, j, k)) = best else { return subtrees.pop() };
            let halves = [subtrees[j], subtrees.swap_remove(k)];
            let few = match halves.map(|half| self.child(half).item) {
                [Item::Few(a), Item::Few(b)] => a.and(&b),
                _ => None,
            };
            let corners = self.around(halves);
            subtrees[j] = self.push(corners, Content::Halves { halves, few });
        }
    }

    /// The box around two subtrees.
    fn around(&self, halves: [usize; 2]) -> Corners {
        let [[a, b], [c, d]] = halves.map(|half| self.subtrees[half].corners);
        let each = |f: fn(f32, f32) -> f32, a: [f32; 3], c: [f32; 3]| {
            [f(a[0], c[0]), f(a[1], c[1]), f(a[2], c[2])]
        };
        [each(f32::min, a, c), each(f32::max, b, d)]
    }

    fn push(&mut self, corners: Corners, content: Content) -> usize {
        let (costs, firsts) = ([0.0; W], [0; W]);
        self.subtrees.push(Subtree { corners, content, costs, firsts, own: 0 });
        self.fit(self.subtrees.len() - 1, corners)
    }

    /// Gives a subtree its box, and finds what it costs.
    fn fit(&mut self, subtree: usize, corners: Corners) -> usize {
        let area = area(&corners);
        let content = self.subtrees[subtree].content;
        let (costs, firsts, own) = match content {
            // The same whatever is around it.
            Content::End(Item::Node(_) | Item::Inner(_)) => ([0.0; W], [0; W], 0),
            Content::End(Item::Many { .. }) => ([2.0 * area; W], [0; W], 0),
            Content::End(_) => ([area; W], [0; W], 0),
            Content::Halves { halves, few } => self.costs(halves, few.is_some(), area),
        };
        self.subtrees[subtree] = Subtree { corners, content, costs, firsts, own };
        subtree
    }

    /// What two halves cost at least, in a box of that area; with what is kept of how that is done.
    fn costs(&self, halves: [usize; 2], few: bool, area: f32) -> ([f32; W], [u8; W], u8) {
        let [a, b] = halves.map(|half| &self.subtrees[half].costs);
        // In so many places, of which the first half has how many?
        let apart = |places: usize| {
            let ways = (1..).zip(a.iter().zip(b[..places - 1].iter().rev()));
            ways.fold(
                (f32::INFINITY, 1),
                |best, (first, (a, b))| {
                    if a + b < best.0 { (a + b, first) } else { best }
                },
            )
        };
        let (inside, own) = apart(W);
        let (mut costs, mut firsts) = ([if few { area } else { area + inside }; W], [0; W]);
        for places in 2..=W {
            let (cost, first) = apart(places);
            costs[places - 1] = costs[places - 2];
            if cost < costs[places - 1] {
                (costs[places - 1], firsts[places - 1]) = (cost, first);
            }
        }
        (costs, firsts, own)
    }
}

/// Half the surface of a box.
fn area([lo, hi]: &Corners) -> f32 {
    let [x, y, z] = [0, 1, 2].map(|axis| hi[axis] - lo[axis]);
    x * y + y * z + z * x
}

#[cfg(test)]
mod tests;

//! Wide nodes → the tree that the CPU walks.
//!
//! Turns each tree of the pack, from the top down, into nodes of up to eight or sixteen children. What is below the top
//! is made in parallel, in pieces that do not depend on the number of threads, and joined in their order.

use super::alpha_map::AlphaMaps;
use super::collapse::{Child, Item, Plan, Source};
use super::few::{Content, Few};
use super::questions::{Marked, Questions};
use super::tree::{BLOCK, Block, MOVING, Node, Nodes, SMALL, TWO_BLOCKS, Tree, Width};
use pack::abi::{
    CHILD_INNER, CHILD_SPHERES, ChildRef, Instance, Material, NONE, Texture, TriShade, Triangle,
    WideNode,
};
use rayon::prelude::*;
use std::collections::BTreeMap;

/// Pieces that are made in parallel, about.
const PIECES: usize = 256;

/// Wide nodes and what they are over, as in a pack that passed its checks.
#[derive(Clone, Copy, Debug)]
pub struct Geometry<'a> {
    /// Inner nodes of all trees.
    pub nodes: &'a [WideNode],
    /// Triangles in the order of leaves.
    pub triangles: &'a [Triangle],
    /// Instances of meshes that have trees of their own.
    pub instances: &'a [Instance],
    /// The root of the world, a `ChildRef`.
    pub root: u32,
    /// How they look; tells what has to be asked about a hit.
    pub shades: &'a [TriShade],
    /// All materials.
    pub materials: &'a [Material],
    /// All textures.
    pub textures: &'a [Texture],
    /// The texels of all textures.
    pub texels: &'a [u32],
}

impl Tree {
    /// The tree over the same triangles, spheres and instances as the nodes of `geometry`.
    #[must_use]
    pub fn new(geometry: &Geometry<'_>, width: Width) -> Self {
        match width {
            Width::Eight => Self::with(geometry, Nodes::Eights),
            #[cfg(target_arch = "x86_64")]
            Width::Sixteen(avx512) => Self::with(geometry, |nodes| Nodes::Sixteens(nodes, avx512)),
        }
    }

    fn with<const W: usize>(geometry: &Geometry<'_>, wrap: impl Fn(Vec<Node<W>>) -> Nodes) -> Self {
        let Geometry { nodes, triangles, instances, root, shades, materials, .. } = *geometry;
        let source = Source { nodes, triangles, shades, materials };
        let mut top = Piece::<W>::default();
        let mut roots: BTreeMap<u32, u32> = BTreeMap::new();
        for word in std::iter::once(root).chain(instances.iter().map(|instance| instance.root)) {
            roots.entry(word).or_insert_with(|| top.root(&source, word, PIECES));
        }
        let whole = |(place, word)| {
            let mut piece = Piece::default();
            piece.root(&source, word, usize::MAX);
            (place, piece)
        };
        let pieces: Vec<(Place, Piece<W>)> =
            std::mem::take(&mut top.waiting).into_par_iter().map(whole).collect();
        let Piece { nodes, blocks, moving, .. } = join(top, pieces);
        let small = W * nodes.len() <= SMALL && moving.is_empty() && instances.is_empty();
        let mut tree = Self {
            nodes: Nodes::Eights(Vec::new()),
            blocks,
            moving,
            root: roots[&root],
            roots: instances.iter().map(|instance| roots[&instance.root]).collect(),
            need: 0,
            alpha: AlphaMaps::new(materials, geometry.textures, geometry.texels),
            in_instances: Questions::of_instances(materials, instances),
            few: None,
            small,
        };
        tree.need = stack_need(&tree, &nodes);
        tree.few = few(&tree, &nodes, triangles);
        tree.nodes = wrap(nodes);
        tree
    }
}

/// Which child of which node.
type Place = (usize, usize);

/// A part of a tree, numbered from 0.
#[derive(Default)]
struct Piece<const W: usize> {
    nodes: Vec<Node<W>>,
    blocks: Vec<Block>,
    moving: Vec<u32>,
    /// Inner nodes of the pack that are left to others, and where their numbers are to go.
    waiting: Vec<(Place, u32)>,
}

impl<const W: usize> Piece<W> {
    /// Makes what the word of the pack refers to, until so many inner nodes are left for others.
    fn root(&mut self, source: &Source<'_>, word: u32, others: usize) -> u32 {
        let ChildRef::Inner(inner) = ChildRef::decode(word) else {
            return self.end(source, &source.item(word));
        };
        let plan = Plan::<W>::new(source, inner, others);
        let root = number(self.nodes.len()) | CHILD_INNER;
        let mut open = Vec::new();
        let mut children = plan.top();
        loop {
            let at = self.node(source, &children);
            let nodes = children.iter().enumerate().filter_map(|(slot, child)| match child.item {
                Item::Node(subtree) => Some(((at, slot), subtree)),
                _ => None,
            });
            open.extend(nodes);
            let Some(((parent, slot), subtree)) = open.pop() else { return root };
            self.nodes[parent].children[slot] = number(self.nodes.len()) | CHILD_INNER;
            children = plan.children(subtree);
        }
    }

    /// A node with the leaves among its children. Those that are nodes of the pack wait.
    fn node(&mut self, source: &Source<'_>, children: &[Child]) -> usize {
        let at = self.nodes.len();
        self.nodes.push(Node::of(children));
        for (slot, child) in children.iter().enumerate() {
            match child.item {
                Item::Node(_) => {}
                Item::Inner(index) => self.waiting.push(((at, slot), index | CHILD_INNER)),
                _ => self.nodes[at].children[slot] = self.end(source, &child.item),
            }
        }
        at
    }

    /// A leaf.
    fn end(&mut self, source: &Source<'_>, item: &Item) -> u32 {
        match *item {
            Item::Node(_) | Item::Inner(_) => NONE,
            Item::Other(word) => word,
            Item::Moving(word) => {
                self.moving.push(word);
                number(self.moving.len() - 1) | MOVING
            }
            Item::Few(few) => self.block(source, few.triangles()),
            Item::Many { first, count } => {
                let all: Vec<u32> = (first..first + count).collect();
                let (one, two) = all.split_at(BLOCK);
                let at = self.block(source, one);
                self.block(source, two);
                at | TWO_BLOCKS
            }
        }
    }

    /// A block of up to four.
    fn block(&mut self, source: &Source<'_>, triangles: &[u32]) -> u32 {
        let last = triangles.len() - 1;
        let triangle = |lane: usize| &source.triangles[triangles[lane.min(last)] as usize];
        let index = |lane: usize| triangles.get(lane).map_or(Marked::NONE, |i| source.marked(*i));
        self.blocks.push(Block::of([0, 1, 2, 3].map(triangle), [0, 1, 2, 3].map(index)));
        number(self.blocks.len() - 1)
    }
}

/// All in one: first the top, then the pieces below it, the roots of which go to their places.
fn join<const W: usize>(mut top: Piece<W>, below: Vec<(Place, Piece<W>)>) -> Piece<W> {
    let mut before = [top.nodes.len(), top.blocks.len(), top.moving.len()].map(number);
    let mut starts = vec![[0; 3]];
    for ((parent, slot), piece) in &below {
        top.nodes[*parent].children[*slot] = before[0] | CHILD_INNER;
        starts.push(before);
        let lengths = [piece.nodes.len(), piece.blocks.len(), piece.moving.len()].map(number);
        before = [0, 1, 2].map(|k| before[k] + lengths[k]);
    }
    let pieces: Vec<Piece<W>> =
        std::iter::once(top).chain(below.into_iter().map(|(_, piece)| piece)).collect();
    // Of the top only those below have their numbers already.
    let place = |k: usize, node: &Node<W>| Node {
        children: node.children.map(|word| if k == 0 { word } else { moved(word, starts[k]) }),
        ..*node
    };
    Piece {
        nodes: concatenated(&pieces, |piece| &piece.nodes, place),
        blocks: concatenated(&pieces, |piece| &piece.blocks, |_, block| *block),
        moving: concatenated(&pieces, |piece| &piece.moving, |_, word| *word),
        waiting: Vec::new(),
    }
}

/// A table of all pieces, in parallel; `change` is given the number of the piece.
fn concatenated<T: Send + Sync, const W: usize>(
    pieces: &[Piece<W>],
    table: impl Fn(&Piece<W>) -> &[T] + Sync,
    change: impl Fn(usize, &T) -> T + Sync,
) -> Vec<T> {
    let mut ends = Vec::with_capacity(pieces.len());
    let mut end = 0;
    for piece in pieces {
        end += table(piece).len();
        ends.push(end);
    }
    let element = |i: usize| {
        let piece = ends.partition_point(|end| *end <= i);
        let table = table(&pieces[piece]);
        change(piece, &table[i + table.len() - ends[piece]])
    };
    (0..end).into_par_iter().map(element).collect()
}

/// The reference `word` of a piece before which there are so many nodes, blocks and leaves that move.
fn moved(word: u32, [nodes, blocks, moving]: [u32; 3]) -> u32 {
    if word == NONE || word & (CHILD_INNER | CHILD_SPHERES) == CHILD_SPHERES {
        word
    } else if word & CHILD_INNER != 0 {
        word + nodes
    } else if word & MOVING != 0 {
        word + moving
    } else {
        word + blocks
    }
}

/// The checks of a pack bound all of its tables.
fn number(n: usize) -> u32 {
    u32::try_from(n).expect("no more than there are nodes or triangles in a pack")
}

impl<const W: usize> Node<W> {
    /// Boxes of the children; their references follow.
    fn of(children: &[Child]) -> Self {
        let mut ends = [[[f32::INFINITY; W], [f32::NEG_INFINITY; W]]; 3];
        for (slot, child) in children.iter().enumerate() {
            for (axis, ends) in ends.iter_mut().enumerate() {
                let [lo, hi] = child.corners;
                (ends[0][slot], ends[1][slot]) = (lo[axis], hi[axis]);
            }
        }
        Self { ends, children: [NONE; W] }
    }
}

impl Block {
    fn of(each: [&Triangle; BLOCK], triangles: [Marked; BLOCK]) -> Self {
        let mut corners = [[[0.0; BLOCK]; 3]; 3];
        for (lane, triangle) in each.into_iter().enumerate() {
            for (lanes, corner) in corners.iter_mut().zip([triangle.v0, triangle.v1, triangle.v2]) {
                for (lanes, x) in lanes.iter_mut().zip(corner) {
                    lanes[lane] = x;
                }
            }
        }
        Self { corners, triangles }
    }
}

/// All that is in `tree`, if that is little and stands still in the world. A tree of one leaf is as good as a list.
fn few<const W: usize>(tree: &Tree, nodes: &[Node<W>], triangles: &[Triangle]) -> Option<Few> {
    let leaves = nodes.iter().flat_map(|node| {
        let children = node.children.into_iter().enumerate();
        let leaves = children.filter(|(_, child)| *child != NONE && child & CHILD_INNER == 0);
        leaves.map(|(k, child)| {
            let ends = node.ends.map(|axis| axis.map(|ends| ends[k]));
            if child & CHILD_SPHERES != 0 {
                return (ends, Content::Spheres(child));
            }
            let indices = tree.blocks(child).iter().flat_map(|block| block.triangles);
            (ends, Content::Triangles(indices.filter(|marked| !marked.is_none()).collect()))
        })
    });
    if tree.is_small() && !nodes.is_empty() { Few::of(leaves, triangles) } else { None }
}

/// Entries that the stack needs, as `pack::bvh::stack_need` of the pack's own nodes.
fn stack_need<const W: usize>(tree: &Tree, nodes: &[Node<W>]) -> usize {
    let closed = needs(nodes, |_| 0);
    let need = |word: u32| need_of(&closed, &|_| 0, word);
    let instance = |index: u32| tree.roots.get(index as usize).map_or(0, |root| 1 + need(*root));
    need_of(&needs(nodes, instance), &instance, tree.root)
}

/// The need of every node, where `instance` is that of an instance.
fn needs<const W: usize>(nodes: &[Node<W>], instance: impl Fn(u32) -> usize) -> Vec<usize> {
    let mut needs = vec![0; nodes.len()];
    for (index, node) in nodes.iter().enumerate().rev() {
        let children = node.children.iter().filter(|word| **word != NONE);
        let below = children.clone().map(|word| need_of(&needs, &instance, *word)).max();
        needs[index] = below.unwrap_or(0) + children.count().saturating_sub(1);
    }
    needs
}

/// The need of what `word` stands for.
fn need_of(needs: &[usize], instance: &impl Fn(u32) -> usize, word: u32) -> usize {
    match ChildRef::decode(word) {
        ChildRef::Inner(index) => needs.get(index as usize).copied().unwrap_or(0),
        ChildRef::Instance(index) => instance(index),
        ChildRef::Triangles { .. } | ChildRef::Spheres { .. } | ChildRef::Empty => 0,
    }
}

//! The tree above the groups.
//!
//! Turns the trees of several groups into *pieces* (whole groups or subtrees of them) and a binary
//! tree over those. Groups whose boxes overlap would make every ray in the common part visit them
//! one after the other, so the largest pieces that overlap another group are opened, that is,
//! replaced by their two children, until [`budget`] is spent ("re-braiding", Benthin et al. 2017,
//! "Improved Two-Level BVHs using Partial Re-Braiding"). All nodes live in one frame, so opening
//! costs nothing at traversal: the opened nodes are simply not written. Instances of meshes that are stored
//! once are pieces, too, which cannot be opened.

use std::collections::{BTreeMap, BTreeSet, BinaryHeap};

use glam::Vec4;
use pack::abi::{ChildRef, NONE, Node};
use rayon::prelude::*;

use super::Tree;
use super::fragment::{Bounds, ordered_bits};

/// Most inner nodes above a piece; with the 47 of a group this stays within a stack of 96.
pub(super) const MAX_TOP_LEVELS: u32 = 48;

/// A subtree of a group, or all of it.
#[derive(Clone, Copy, Debug)]
pub(super) struct Piece {
    pub(super) bounds: Bounds,
    /// Index of the group; instances come after the groups.
    pub(super) group: usize,
    /// Reference into the group's tree, or to the instance; not `NONE`.
    pub(super) word: u32,
    /// Number of primitives: what a visit may cost.
    weight: f32,
}

impl Piece {
    fn new(trees: &[&Tree], group: usize, word: u32, bounds: Bounds) -> Self {
        let span = span(trees[group], word);
        let weight = (span.prims.end - span.prims.start) as f32;
        Self { bounds, group, word, weight }
    }

    /// All of a tree that is not empty.
    pub(super) fn whole(trees: &[&Tree], group: usize) -> Self {
        Self::new(trees, group, trees[group].root, trees[group].bounds)
    }

    fn node<'a>(&self, trees: &[&'a Tree]) -> Option<&'a Node> {
        match ChildRef::decode(self.word) {
            ChildRef::Inner(index) => Some(&trees[self.group].nodes[index as usize]),
            _ => None,
        }
    }
}

/// An instance of a mesh that has a tree of its own.
#[derive(Clone, Copy, Debug)]
pub(super) struct InstanceLeaf {
    pub(super) bounds: Bounds,
    /// Number of its triangles.
    pub(super) weight: usize,
}

/// What a subtree covers in the arrays of its tree.
pub(super) struct Span {
    pub(super) nodes: std::ops::Range<usize>,
    pub(super) prims: std::ops::Range<usize>,
}

/// The ranges of a subtree; both are contiguous because trees are in depth-first order.
pub(super) fn span(tree: &Tree, word: u32) -> Span {
    let inner = |word| match ChildRef::decode(word) {
        ChildRef::Inner(index) => Some(index as usize),
        _ => None,
    };
    let leaf_end = |word, right: bool| match ChildRef::decode(word) {
        ChildRef::Triangles { first, count } | ChildRef::Spheres { first, count } => {
            (if right { first + count } else { first }) as usize
        }
        _ => 0,
    };
    let (mut left, mut right, mut last) = (word, word, word);
    while let Some(index) = inner(left) {
        left = tree.nodes[index].left;
    }
    while let Some(index) = inner(right) {
        right = tree.nodes[index].right;
    }
    let prims = leaf_end(left, false)..leaf_end(right, true);
    let Some(begin) = inner(word) else { return Span { nodes: 0..0, prims } };
    // The last node in depth-first order: to the right where there are nodes, else to the left.
    let mut end = begin;
    while let Some(index) = inner(last) {
        end = index;
        let node = &tree.nodes[index];
        last = if inner(node.right).is_some() { node.right } else { node.left };
    }
    Span { nodes: begin..end + 1, prims }
}

/// Most pieces for a number of groups and instances.
fn budget(n_groups: usize, n_instances: usize) -> usize {
    // One group needs no opening. Looking for overlaps is quadratic, hence the end of it.
    match n_groups + n_instances {
        n @ (0 | 1) => n,
        n if n_instances > MANY_INSTANCES => n,
        _ => n_groups.max(8192) + n_instances,
    }
}

/// Beyond this many instances looking for overlaps would take longer than it saves.
const MANY_INSTANCES: usize = 1 << 15;

/// The two children of a node as boxes and references.
pub(super) fn children(node: &Node) -> [(Bounds, u32); 2] {
    let corner = |c: [f32; 3]| Vec4::new(c[0], c[1], c[2], 0.0);
    let side = |lo, hi| Bounds { lo: corner(lo), hi: corner(hi) };
    [
        (side(node.left_lo, node.left_hi), node.left),
        (side(node.right_lo, node.right_hi), node.right),
    ]
}

/// Whole groups and instances first, then opened while that separates them. Empty groups give no piece. Also
/// tells whether the budget ended that, so that groups are still overlapping.
pub(super) fn pieces(trees: &[&Tree], instances: &[InstanceLeaf]) -> (Vec<Piece>, bool) {
    let roots = (0..trees.len()).filter(|group| trees[*group].root != NONE);
    let mut pieces: Vec<Piece> = roots.map(|group| Piece::whole(trees, group)).collect();
    let n_groups = pieces.len();
    let budget = budget(n_groups, instances.len());
    pieces.extend((0..).zip(instances).map(|(i, instance)| Piece {
        bounds: instance.bounds,
        group: trees.len() + i as usize,
        word: ChildRef::Instance(i).encode().expect("fewer than 2^26 instances"),
        weight: instance.weight as f32,
    }));
    // Largest first, equal areas in order of their place in the list.
    let key = |p: &Piece, at: usize| (ordered_bits(p.bounds.half_area()), std::cmp::Reverse(at));
    let mut queue: BinaryHeap<_> = pieces.iter().enumerate().map(|(i, p)| key(p, i)).collect();
    while pieces.len() < budget
        && let Some((_, std::cmp::Reverse(at))) = queue.pop()
    {
        let piece = pieces[at];
        let Some(node) = piece.node(trees) else { continue };
        if !pieces.iter().any(|p| p.group != piece.group && overlap(&p.bounds, &piece.bounds)) {
            continue;
        }
        let [left, right] =
            children(node).map(|(bounds, word)| Piece::new(trees, piece.group, word, bounds));
        queue.push(key(&left, at));
        queue.push(key(&right, pieces.len()));
        pieces[at] = left;
        pieces.push(right);
    }
    let overlapping = n_groups > 1 && !queue.is_empty();
    (pieces, overlapping)
}

/// Sets of groups, each of two or more in ascending order, that fill the same space: groups that are tied to each
/// other, and to which others are tied. Two are tied where of each of them a share of [`TANGLED`] or more of the
/// primitives is in pieces that meet pieces of the other. All groups are below `n_groups`.
pub(super) fn clusters(n_groups: usize, pieces: &[Piece]) -> Vec<Vec<usize>> {
    let mut weights = vec![0.0_f32; n_groups];
    let mut shared = BTreeMap::<(usize, usize), f32>::new();
    // Quadratic, hence side by side.
    let met = |a: &Piece| -> BTreeSet<usize> {
        let meets = |b: &&Piece| b.group != a.group && overlap(&a.bounds, &b.bounds);
        pieces.iter().filter(meets).map(|b| b.group).collect()
    };
    let met: Vec<BTreeSet<usize>> = pieces.par_iter().map(met).collect();
    for (a, met) in pieces.iter().zip(met) {
        weights[a.group] += a.weight;
        for other in met {
            *shared.entry((a.group, other)).or_default() += a.weight;
        }
    }
    let mut cluster_of: Vec<usize> = (0..n_groups).collect();
    let share = |a: usize, b: usize| shared.get(&(a, b)).map_or(0.0, |weight| weight / weights[a]);
    for &(a, b) in shared.keys() {
        if share(a, b).min(share(b, a)) >= TANGLED {
            let (from, to) = (cluster_of[a].max(cluster_of[b]), cluster_of[a].min(cluster_of[b]));
            cluster_of
                .iter_mut()
                .filter(|cluster| **cluster == from)
                .for_each(|cluster| *cluster = to);
        }
    }
    let members = |cluster| (0..n_groups).filter(|group| cluster_of[*group] == cluster).collect();
    let all = (0..n_groups).map(members);
    all.filter(|members: &Vec<usize>| members.len() > 1).collect()
}

/// Share of a group's primitives in the space of another from which on both are one cluster: leaves among twigs, not
/// a bridge over a pond.
const TANGLED: f32 = 0.25;

/// Whether the boxes have a common inside or touch.
fn overlap(a: &Bounds, b: &Bounds) -> bool {
    let apart = a.lo.cmpgt(b.hi) | b.lo.cmpgt(a.hi);
    // The three lowest bits are x, y and z.
    apart.bitmask().trailing_zeros() >= 3
}

/// A binary tree over pieces.
pub(super) enum Top {
    Piece(Piece),
    Fork { sides: Box<[Top; 2]>, bounds: [Bounds; 2] },
}

/// Builds the tree over at least one piece, never deeper than `MAX_TOP_LEVELS`.
pub(super) fn build(pieces: &mut [Piece], levels: u32) -> Top {
    if let [piece] = pieces {
        return Top::Piece(*piece);
    }
    let n_left = divide(pieces, levels - 1);
    let all = |part: &[Piece]| part.iter().fold(Bounds::EMPTY, |b, p| b.union(p.bounds));
    let (left, right) = pieces.split_at_mut(n_left);
    let bounds = [all(left), all(right)];
    let (left, right) = (build(left, levels - 1), build(right, levels - 1));
    Top::Fork { sides: Box::new([left, right]), bounds }
}

/// Sorts so that the best split is at the returned position; every split of all axes is tried, and
/// primitives are counted instead of pieces. Of equal costs the more even split wins.
fn divide(pieces: &mut [Piece], levels: u32) -> usize {
    let n = pieces.len();
    let mut best = (f32::INFINITY, usize::MAX);
    let centroids =
        pieces.iter().fold(Bounds::EMPTY, |b, p| b.with_point(p.bounds.lo + p.bounds.hi));
    let mut found = (centroids.widest_axis(), n / 2);
    let mut above = vec![0.0_f32; n];
    let fits = |k: usize| k.max(n - k).next_power_of_two().trailing_zeros() <= levels;
    for axis in 0..3 {
        sort(pieces, axis);
        let (mut acc, mut weight) = (Bounds::EMPTY, 0.0);
        for k in (1..n).rev() {
            acc = acc.union(pieces[k].bounds);
            weight += pieces[k].weight;
            above[k] = acc.half_area() * weight;
        }
        let (mut acc, mut weight) = (Bounds::EMPTY, 0.0);
        for k in 1..n {
            acc = acc.union(pieces[k - 1].bounds);
            weight += pieces[k - 1].weight;
            let cost = acc.half_area() * weight + above[k];
            let key = (cost, k.abs_diff(n - k));
            if cost > 0.0 && cost.is_finite() && key < best && fits(k) {
                best = key;
                found = (axis, k);
            }
        }
    }
    sort(pieces, found.0);
    found.1
}

/// Sorts by centroid; equal centroids by group and reference.
fn sort(pieces: &mut [Piece], axis: usize) {
    pieces.sort_unstable_by_key(|p| {
        (ordered_bits(p.bounds.lo[axis] + p.bounds.hi[axis]), p.group, p.word)
    });
}

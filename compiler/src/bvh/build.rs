//! The recursion: fragments in, nodes in depth-first order out.
//!
//! Every step permutes its own range of the fragments and knows where that range begins, so leaves
//! are ranges from the start and tile the primitives. Subtrees above [`PARALLEL_MIN`] primitives
//! are built by `rayon::join` into arenas of their own, which are strung together afterwards: the
//! bytes are the same for any number of threads.

use pack::abi::{CHILD_INNER, ChildRef, MAX_LEAF, Node};
use rayon::prelude::*;

use super::binned::{self, Bins, Mapping};
use super::fragment::{Bounds, Fragment};
use super::sweep::{self, SWEEP_MAX};
use super::words::{leaf_word, shift_word};

/// Smaller subtrees are one piece of work.
const PARALLEL_MIN: usize = 1 << 12;
/// Smaller ranges are binned on one thread.
const PARALLEL_BINS_MIN: usize = 1 << 16;
/// Most inner nodes on a path from the root to a leaf, so the leaf is at depth 47 (root: 0).
pub(super) const MAX_INNER_LEVELS: u32 = pack::abi::MAX_DEPTH - 1;
/// Cost of visiting a node in units of one primitive test.
const NODE_COST: f32 = 1.0;

/// A range of fragments to turn into a subtree.
struct Range<'a> {
    frags: &'a mut [Fragment],
    /// Position of the range in the whole list.
    first: u32,
    /// Inner levels that may still be used.
    levels: u32,
    bounds: Bounds,
    /// Bounds of the doubled centroids.
    centroids: Bounds,
}

/// A built subtree.
enum Part {
    Chunk { nodes: Vec<Node>, root: u32 },
    Fork { node: Node, sides: Box<[Part; 2]> },
}

/// Inner levels that median splits need to get `n` primitives into leaves.
fn levels_needed(n: usize) -> u32 {
    n.div_ceil(MAX_LEAF as usize).next_power_of_two().trailing_zeros()
}

/// Builds the nodes and the root word; permutes `frags` into leaf order. The list is not empty and
/// has at most `MAX_PRIMITIVES` entries.
pub(super) fn build(frags: &mut [Fragment]) -> Built {
    let measure = |part: &[Fragment]| {
        part.iter().fold([Bounds::EMPTY; 2], |[b, c], f| {
            [b.union(f.bounds()), c.with_point(f.centroid2())]
        })
    };
    let [bounds, centroids] = frags
        .par_chunks(1 << 16)
        .map(measure)
        .reduce(|| [Bounds::EMPTY; 2], |a, b| [a[0].union(b[0]), a[1].union(b[1])]);
    let part = fork(Range { frags, first: 0, levels: MAX_INNER_LEVELS, bounds, centroids });
    Built { bounds, part }
}

/// The result of [`build`], still in pieces: the caller may drop the fragments before stringing it
/// together.
pub(super) struct Built {
    pub(super) bounds: Bounds,
    part: Part,
}

impl Built {
    /// The nodes in depth-first order and the root word.
    pub(super) fn flatten(self) -> (Vec<Node>, u32) {
        let mut nodes = Vec::with_capacity(self.part.n_nodes());
        let root = self.part.flatten(&mut nodes);
        (nodes, root)
    }
}

impl Part {
    fn n_nodes(&self) -> usize {
        match self {
            Self::Chunk { nodes, .. } => nodes.len(),
            Self::Fork { sides, .. } => 1 + sides[0].n_nodes() + sides[1].n_nodes(),
        }
    }

    /// Appends the nodes and returns the word of the subtree's root.
    fn flatten(self, out: &mut Vec<Node>) -> u32 {
        let base = index_of(out);
        match self {
            Self::Chunk { nodes, root } => {
                out.extend(nodes.iter().map(|n| Node {
                    left: shift_word(n.left, base, 0),
                    right: shift_word(n.right, base, 0),
                    ..*n
                }));
                shift_word(root, base, 0)
            }
            Self::Fork { node, sides } => {
                let [left, right] = *sides;
                out.push(node);
                let left = left.flatten(out);
                let right = right.flatten(out);
                let node = &mut out[base as usize];
                (node.left, node.right) = (left, right);
                CHILD_INNER | base
            }
        }
    }
}

/// Index of the next node.
fn index_of(nodes: &[Node]) -> u32 {
    u32::try_from(nodes.len()).expect("a tree has fewer nodes than its 2^27 primitives")
}

/// A node whose children are not known yet.
fn node_of(left: &Bounds, right: &Bounds) -> Node {
    Node {
        left_lo: left.lo3(),
        left_hi: left.hi3(),
        right_lo: right.lo3(),
        right_hi: right.hi3(),
        ..Node::default()
    }
}

fn fork(mut range: Range) -> Part {
    if range.frags.len() <= PARALLEL_MIN {
        // Two primitives per leaf is typical; growing is rare.
        let mut nodes = Vec::with_capacity(range.frags.len() / 2);
        let root = grow(range, &mut nodes);
        return Part::Chunk { nodes, root };
    }
    let [left, right] = split(&mut range);
    let node = node_of(&left.bounds, &right.bounds);
    let (left, right) = rayon::join(|| fork(left), || fork(right));
    Part::Fork { node, sides: Box::new([left, right]) }
}

/// Appends the subtree's nodes and returns the word of its root.
fn grow(mut range: Range, out: &mut Vec<Node>) -> u32 {
    if range.frags.len() <= SWEEP_MAX {
        range.frags.sort_unstable_by_key(Fragment::index);
        return grow_small(range.frags, range.first, range.levels, &range.bounds, out);
    }
    let at = out.len();
    let word = CHILD_INNER | index_of(out);
    let [left, right] = split(&mut range);
    out.push(node_of(&left.bounds, &right.bounds));
    let left = grow(left, out);
    let right = grow(right, out);
    (out[at].left, out[at].right) = (left, right);
    word
}

/// Divides a range of more than `SWEEP_MAX` fragments in two.
fn split<'a>(range: &'a mut Range) -> [Range<'a>; 2] {
    let n = range.frags.len();
    let levels = range.levels - 1;
    let mapping = Mapping::new(&range.centroids);
    let bins = if n >= PARALLEL_BINS_MIN && rayon::current_num_threads() > 1 {
        Bins::fill_parallel(range.frags, &mapping)
    } else {
        Bins::fill(range.frags, &mapping)
    };
    let fits = |n_left: usize| levels_needed(n_left.max(n - n_left)) <= levels;
    let (n_left, bounds, centroids) = match bins.best().filter(|s| fits(s.n_left)) {
        Some(s) => (s.n_left, [s.left, s.right], binned::partition(range.frags, &mapping, &s)),
        None => median(range.frags, range.centroids.widest_axis()),
    };
    let (left, right) = range.frags.split_at_mut(n_left);
    let mid = range.first + u32::try_from(n_left).expect("at most 2^27 primitives");
    let side = |frags, first, k: usize| Range {
        frags,
        first,
        levels,
        bounds: bounds[k],
        centroids: centroids[k],
    };
    [side(left, range.first, 0), side(right, mid, 1)]
}

/// Halves the range along `axis`, equal centroids by index.
fn median(frags: &mut [Fragment], axis: usize) -> (usize, [Bounds; 2], [Bounds; 2]) {
    let n_left = frags.len() / 2;
    frags.select_nth_unstable_by_key(n_left, |f| f.key(axis));
    let (left, right) = frags.split_at(n_left);
    let both = |part: &[Fragment]| {
        part.iter().fold((Bounds::EMPTY, Bounds::EMPTY), |(b, c), f| {
            (b.union(f.bounds()), c.with_point(f.centroid2()))
        })
    };
    let ((lb, lc), (rb, rc)) = (both(left), both(right));
    (n_left, [lb, rb], [lc, rc])
}

/// The subtree of at most `SWEEP_MAX` fragments, which are sorted by index.
fn grow_small(
    frags: &mut [Fragment],
    first: u32,
    levels: u32,
    bounds: &Bounds,
    out: &mut Vec<Node>,
) -> u32 {
    let n = frags.len();
    let may_be_leaf = n <= MAX_LEAF as usize;
    if n == 1 || (may_be_leaf && levels == 0) {
        return leaf_word(first, n);
    }
    let levels = levels - 1;
    let best = sweep::best(frags);
    if may_be_leaf {
        let as_leaf = bounds.half_area() * (n as f32 - NODE_COST);
        if best.is_none_or(|s| s.cost >= as_leaf) {
            return leaf_word(first, n);
        }
    }
    let fits = |s: &sweep::SweepSplit| levels_needed(s.n_left.max(n - s.n_left)) <= levels;
    let s = best.filter(fits).unwrap_or_else(|| sweep::median(frags));
    sweep::partition(frags, &s);
    let at = out.len();
    let word = ChildRef::Inner(index_of(out)).encode().expect("a tree has few enough nodes");
    out.push(node_of(&s.left, &s.right));
    let (left, right) = frags.split_at_mut(s.n_left);
    let mid = first + u32::try_from(s.n_left).expect("at most 24");
    let left = grow_small(left, first, levels, &s.left, out);
    let right = grow_small(right, mid, levels, &s.right, out);
    (out[at].left, out[at].right) = (left, right);
    word
}

//! The recursion: fragments in, nodes in depth-first order out.
//!
//! Every step permutes its own range of the fragments and knows where that range begins, so leaves
//! are ranges from the start and tile the primitives. Subtrees above [`PARALLEL_MIN`] primitives
//! are built by `rayon::join` into arenas of their own, which are strung together afterwards: the
//! bytes are the same for any number of threads.

use pack::abi::{CHILD_INNER, ChildRef, MAX_LEAF, NONE, Node};
use rayon::prelude::*;

use super::binned::{self, Bins, Mapping};
use super::fragment::{Bounds, Fragment};
use super::sweep::{self, SWEEP_MAX};
use super::words::{leaf_word, shift_word};

/// Smaller subtrees are one piece of work.
pub(super) const PARALLEL_MIN: usize = 1 << 12;
/// Smaller ranges are binned on one thread.
pub(super) const PARALLEL_BINS_MIN: usize = 1 << 16;
/// Most inner nodes on a path from the root to a leaf, so the leaf is at depth 47 (root: 0).
pub(super) const MAX_INNER_LEVELS: u32 = pack::abi::MAX_DEPTH - 1;
/// Cost of visiting a node in units of one primitive test.
pub(super) const NODE_COST: f32 = 1.0;
/// Leaves of trees that are built without regard to cost: about what the others have on average.
const MEDIAN_LEAF: usize = 2;

/// Where ranges are divided.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Rule {
    /// Where it costs least by the surface-area heuristic.
    Cost,
    /// In the middle of the list.
    ObjectMedian,
    /// In the middle of the space that centroids take.
    SpatialMedian,
}

/// A range of fragments to turn into a subtree.
pub(super) struct Range<'a> {
    pub(super) frags: &'a mut [Fragment],
    /// Position of the range in the whole list.
    pub(super) first: u32,
    /// Inner levels that may still be used.
    pub(super) levels: u32,
    pub(super) rule: Rule,
    pub(super) bounds: Bounds,
    /// Bounds of the doubled centroids.
    pub(super) centroids: Bounds,
}

/// A built subtree.
pub(super) enum Part {
    /// Built on one thread. `order` holds the numbers of the pieces in its leaves; it is empty where
    /// leaves say positions in the whole list.
    Chunk {
        nodes: Vec<Node>,
        root: u32,
        order: Vec<u32>,
    },
    Fork {
        node: Node,
        sides: Box<[Part; 2]>,
    },
}

/// Subtrees strung together.
#[derive(Default)]
pub(super) struct Flat {
    /// In depth-first order.
    pub(super) nodes: Vec<Node>,
    /// Pieces in leaf order, where leaves do not say positions.
    pub(super) order: Vec<u32>,
}

/// Inner levels that median splits need to get `n` primitives into leaves.
pub(super) fn levels_needed(n: usize) -> u32 {
    n.div_ceil(MAX_LEAF as usize).next_power_of_two().trailing_zeros()
}

/// The box of all fragments and the box of their doubled centroids.
pub(super) fn measure(frags: &[Fragment]) -> [Bounds; 2] {
    let measure = |part: &[Fragment]| {
        part.iter().fold([Bounds::EMPTY; 2], |[b, c], f| {
            [b.union(f.bounds()), c.with_point(f.centroid2())]
        })
    };
    frags
        .par_chunks(1 << 16)
        .map(measure)
        .reduce(|| [Bounds::EMPTY; 2], |a, b| [a[0].union(b[0]), a[1].union(b[1])])
}

/// Builds the tree, still in pieces: the caller may drop the fragments before stringing it together.
/// Permutes `frags` into leaf order. The list is not empty and has at most `MAX_PRIMITIVES` entries.
pub(super) fn build(frags: &mut [Fragment], rule: Rule) -> (Bounds, Part) {
    let [bounds, centroids] = measure(frags);
    let levels = MAX_INNER_LEVELS;
    (bounds, fork(Range { frags, first: 0, levels, rule, bounds, centroids }))
}

impl Part {
    fn n_nodes(&self) -> usize {
        match self {
            Self::Chunk { nodes, .. } => nodes.len(),
            Self::Fork { sides, .. } => 1 + sides[0].n_nodes() + sides[1].n_nodes(),
        }
    }

    fn n_pieces(&self) -> usize {
        match self {
            Self::Chunk { order, .. } => order.len(),
            Self::Fork { sides, .. } => sides[0].n_pieces() + sides[1].n_pieces(),
        }
    }

    /// Everything in depth-first order, and the root word.
    pub(super) fn string(self) -> (Flat, u32) {
        // Memory that the system hands out as zeros is first touched where it is filled.
        let mut nodes: Vec<Node> = bytemuck::zeroed_vec(self.n_nodes());
        let mut order: Vec<u32> = bytemuck::zeroed_vec(self.n_pieces());
        let root = self.put(&mut nodes, &mut order, [0, 0]);
        (Flat { nodes, order }, root)
    }

    /// Fills what the subtree takes of nodes and pieces, which begins at `nodes_from` and `pieces_from` of all;
    /// returns the word of its root.
    fn put(
        self,
        nodes: &mut [Node],
        order: &mut [u32],
        [nodes_from, pieces_from]: [usize; 2],
    ) -> u32 {
        let (base, prims) = (index_of(nodes_from), index_of(pieces_from));
        match self {
            Self::Chunk { nodes: own, root, order: pieces } => {
                order.copy_from_slice(&pieces);
                for (slot, n) in nodes.iter_mut().zip(own) {
                    let (left, right) =
                        (shift_word(n.left, base, prims), shift_word(n.right, base, prims));
                    *slot = Node { left, right, ..n };
                }
                shift_word(root, base, prims)
            }
            Self::Fork { node, sides } => {
                let [left, right] = *sides;
                let (n_nodes, n_pieces) = (left.n_nodes(), left.n_pieces());
                let Some((slot, rest)) = nodes.split_first_mut() else { return NONE };
                let (left_nodes, right_nodes) = rest.split_at_mut(n_nodes);
                let (left_order, right_order) = order.split_at_mut(n_pieces);
                let left_from = [nodes_from + 1, pieces_from];
                let right_from = [nodes_from + 1 + n_nodes, pieces_from + n_pieces];
                let (left, right) = rayon::join(
                    || left.put(left_nodes, left_order, left_from),
                    || right.put(right_nodes, right_order, right_from),
                );
                *slot = Node { left, right, ..node };
                CHILD_INNER | base
            }
        }
    }
}

/// A position as words hold it.
fn index_of(position: usize) -> u32 {
    u32::try_from(position).expect("a tree has fewer nodes than its 2^27 pieces")
}

/// A node whose children are not known yet.
pub(super) fn node_of(left: &Bounds, right: &Bounds) -> Node {
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
        return Part::Chunk { nodes, root, order: Vec::new() };
    }
    let [left, right] = split(&mut range);
    let node = node_of(&left.bounds, &right.bounds);
    let (left, right) = rayon::join(|| fork(left), || fork(right));
    Part::Fork { node, sides: Box::new([left, right]) }
}

/// Appends the subtree's nodes and returns the word of its root.
pub(super) fn grow(mut range: Range, out: &mut Vec<Node>) -> u32 {
    if range.frags.len() <= SWEEP_MAX {
        range.frags.sort_unstable_by_key(Fragment::index);
        if range.rule == Rule::Cost {
            return grow_small(range.frags, range.first, range.levels, &range.bounds, out);
        }
        // Without levels left there are at most `MAX_LEAF`.
        if range.frags.len() <= MEDIAN_LEAF || range.levels == 0 {
            return leaf_word(range.first, range.frags.len());
        }
    }
    let at = out.len();
    let word = CHILD_INNER | index_of(out.len());
    let [left, right] = split(&mut range);
    out.push(node_of(&left.bounds, &right.bounds));
    let left = grow(left, out);
    let right = grow(right, out);
    (out[at].left, out[at].right) = (left, right);
    word
}

/// Divides a range in two; with `Rule::Cost` one of more than `SWEEP_MAX` fragments.
fn split<'a>(range: &'a mut Range) -> [Range<'a>; 2] {
    let n = range.frags.len();
    let levels = range.levels - 1;
    let rule = range.rule;
    let fits = |n_left: usize| levels_needed(n_left.max(n - n_left)) <= levels;
    let halves = match rule {
        Rule::Cost => cheapest(range, fits),
        Rule::ObjectMedian => None,
        Rule::SpatialMedian => middle(range, fits),
    };
    let (n_left, bounds, centroids) =
        halves.unwrap_or_else(|| median(range.frags, range.centroids.widest_axis()));
    let (left, right) = range.frags.split_at_mut(n_left);
    let mid = range.first + u32::try_from(n_left).expect("at most 2^27 primitives");
    let side = |frags, first, k: usize| Range {
        frags,
        first,
        levels,
        rule,
        bounds: bounds[k],
        centroids: centroids[k],
    };
    [side(left, range.first, 0), side(right, mid, 1)]
}

/// How many go left, and the boxes of both sides and of their doubled centroids.
pub(super) type Halves = (usize, [Bounds; 2], [Bounds; 2]);

/// The best plane between bins.
fn cheapest(range: &mut Range, fits: impl Fn(usize) -> bool) -> Option<Halves> {
    let mapping = Mapping::new(&range.centroids);
    let bins = if range.frags.len() >= PARALLEL_BINS_MIN && rayon::current_num_threads() > 1 {
        Bins::fill_parallel(range.frags, &mapping)
    } else {
        Bins::fill(range.frags, &mapping)
    };
    let s = bins.best().filter(|s| fits(s.n_left))?;
    Some((s.n_left, [s.left, s.right], binned::partition(range.frags, &mapping, &s)))
}

/// The plane in the middle of the centroids along their widest axis, if both sides get something.
fn middle(range: &mut Range, fits: impl Fn(usize) -> bool) -> Option<Halves> {
    let axis = range.centroids.widest_axis();
    let middle = 0.5 * (range.centroids.lo[axis] + range.centroids.hi[axis]);
    let is_left = |f: &Fragment| f.centroid2()[axis] < middle;
    let n_left = range.frags.iter().filter(|f| is_left(f)).count();
    if n_left == 0 || n_left == range.frags.len() || !fits(n_left) {
        return None;
    }
    // By index within a side: the order does not depend on what was done before.
    range.frags.sort_unstable_by_key(|f| (!is_left(f), f.index()));
    Some(measure_halves(range.frags, n_left))
}

/// Halves the range along `axis`, equal centroids by index.
pub(super) fn median(frags: &mut [Fragment], axis: usize) -> Halves {
    let n_left = frags.len() / 2;
    frags.select_nth_unstable_by_key(n_left, |f| f.key(axis));
    measure_halves(frags, n_left)
}

fn measure_halves(frags: &[Fragment], n_left: usize) -> Halves {
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
    let word = ChildRef::Inner(index_of(out.len())).encode().expect("a tree has few enough nodes");
    out.push(node_of(&s.left, &s.right));
    let (left, right) = frags.split_at_mut(s.n_left);
    let mid = first + u32::try_from(s.n_left).expect("at most 24");
    let left = grow_small(left, first, levels, &s.left, out);
    let right = grow_small(right, mid, levels, &s.right, out);
    (out[at].left, out[at].right) = (left, right);
    word
}

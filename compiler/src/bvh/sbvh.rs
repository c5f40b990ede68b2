//! The recursion with spatial splits: fragments and room for more in, nodes and pieces out.
//!
//! Every range owns a slice of the fragments that ends in free places, as many as references may be
//! added below it. A spatial split turns fragments that cross its plane into two pieces: the left one
//! keeps its number, the right one takes the next free place, whose position is its number. So numbers
//! and bytes are the same for any number of threads. [`Split`]s tell how pieces came to be; replayed in
//! order (`pieces`) they give the same boxes again.
//!
//! What decides is relative to the node and never to the scene: a few giant triangles do not switch
//! splits off elsewhere.
//!
//! Looking for spatial splits costs several times what the other splits do, and in most meshes it is in vain. Where they
//! pay, they pay from large nodes downwards. So large ranges ask a sample of their fragments first, and small ranges look
//! only where one of the last splits above them was worth it; elsewhere the tree is that of `build`. Both look only
//! along axes on which the bins of the object split leave something to gain.

use pack::abi::{CHILD_INNER, MAX_LEAF, Node};

use super::binned::{self, Axes, Bins, Mapping};
use super::build::{self, NODE_COST, PARALLEL_BINS_MIN, PARALLEL_MIN, Part, Rule};
use super::cut::Cut;
use super::fragment::{Bounds, Fragment};
use super::input::Corners;
use super::pieces::Split;
use super::preset::{Fineness, SpatialRules};
use super::range::{Range, Sides};
use super::spatial::{Slabs, SpatialBins, SpatialSplit};
use super::sweep::{self, SWEEP_MAX};
use super::words::leaf_word;

/// A spatial split must cost at most this part of the best object split: pieces take memory.
const MAX_COST: f32 = 0.985;

/// Ranges of more fragments look for spatial splits whatever was above them, if a sample says so.
const SAMPLED_FROM: usize = 1 << 11;
/// A sample is every so manyth fragment, or of few fragments this many: rare long ones decide.
const SAMPLE: (usize, usize) = (32, 128);
/// Trees of more fragments begin with a sample. For fewer, which may miss the few that are worth it, looking is cheap.
const LARGE: usize = 1 << 15;

/// What does not change during a build.
#[derive(Clone, Copy)]
struct Context<'a> {
    corners: Corners<'a>,
    rules: SpatialRules,
}

impl Context<'_> {
    /// Whether spatial splits were looked for in vain too often above the range.
    fn gives_up(&self, range: &Range) -> bool {
        self.rules.patience.is_some() && range.patience == 0
    }
}

/// Builds the nodes over `n` fragments, which are followed by free places. Returns the tree in pieces
/// and what happened at the free places; those not used keep `Split::UNUSED`.
pub(super) fn build(
    frags: &mut [Fragment],
    n: usize,
    splits: &mut [Split],
    corners: Corners,
    rules: SpatialRules,
) -> (Bounds, Part) {
    // A large range has nothing above it that speaks for splits.
    let patience = rules.patience.filter(|_| n <= LARGE).unwrap_or(0);
    let range = Range::whole(frags, n, splits, patience);
    (range.bounds, fork(range, Context { corners, rules }))
}

fn fork(range: Range, context: Context) -> Part {
    if range.n <= PARALLEL_MIN {
        let mut chunk = Chunk {
            nodes: Vec::with_capacity(range.n / 2),
            order: Vec::with_capacity(range.n + range.splits.len()),
        };
        let root = chunk.grow(range, context);
        let Chunk { nodes, order } = chunk;
        return Part::Chunk { nodes, root, order };
    }
    let [left, right] = divide(range, context);
    let node = build::node_of(&left.bounds, &right.bounds);
    let (left, right) = rayon::join(|| fork(left, context), || fork(right, context));
    Part::Fork { node, sides: Box::new([left, right]) }
}

/// A subtree that is built on one thread.
struct Chunk {
    nodes: Vec<Node>,
    /// Numbers of pieces in leaf order.
    order: Vec<u32>,
}

impl Chunk {
    /// Appends the subtree's nodes and returns the word of its root.
    fn grow(&mut self, mut range: Range, context: Context) -> u32 {
        if range.splits.is_empty() || (context.gives_up(&range) && range.n <= SAMPLED_FROM) {
            return self.plain(range);
        }
        let sides = if range.n <= SWEEP_MAX {
            match small(&mut range, context) {
                Some(sides) => range.part(&sides),
                None => return self.leaf(&range),
            }
        } else {
            divide(range, context)
        };
        let [left, right] = sides;
        let at = self.nodes.len();
        self.nodes.push(build::node_of(&left.bounds, &right.bounds));
        let left = self.grow(left, context);
        let right = self.grow(right, context);
        (self.nodes[at].left, self.nodes[at].right) = (left, right);
        CHILD_INNER | u32::try_from(at).expect("a tree has few enough nodes")
    }

    /// As `grow`, without spatial splits.
    fn plain(&mut self, range: Range) -> u32 {
        let Range { frags, n, levels, bounds, centroids, .. } = range;
        let frags = &mut frags[..n];
        let first = u32::try_from(self.order.len()).expect("a chunk is small");
        let rule = Rule::Cost;
        let range = build::Range { frags, first, levels, rule, bounds, centroids };
        let word = build::grow(range, &mut self.nodes);
        self.order.extend(frags.iter().map(Fragment::piece));
        word
    }

    fn leaf(&mut self, range: &Range) -> u32 {
        let first = u32::try_from(self.order.len()).expect("a chunk is small");
        self.order.extend(range.frags[..range.n].iter().map(Fragment::piece));
        leaf_word(first, range.n)
    }
}

/// Divides a range of more than `SWEEP_MAX` fragments in two.
fn divide<'a>(mut range: Range<'a>, context: Context) -> [Range<'a>; 2] {
    let frags = &range.frags[..range.n];
    let parallel = range.n >= PARALLEL_BINS_MIN && rayon::current_num_threads() > 1;
    let mapping = Mapping::new(&range.centroids);
    let bins =
        if parallel { Bins::fill_parallel(frags, &mapping) } else { Bins::fill(frags, &mapping) };
    let object = bins.best().filter(|s| range.fits([s.n_left, range.n - s.n_left]));
    let limit = match &object {
        Some(s) if range.overlaps(&s.left, &s.right, context.rules.min_overlap) => s.cost(range.n),
        Some(_) => 0.0,
        None => range.bounds.half_area() * range.n as f32,
    };
    if let Some(sides) = spatial(&mut range, context, limit, Some(&bins), parallel) {
        return range.part(&sides);
    }
    let frags = &mut range.frags[..range.n];
    let (n_left, bounds, centroids) = match object {
        Some(s) => (s.n_left, [s.left, s.right], binned::partition(frags, &mapping, &s)),
        None => build::median(frags, range.centroids.widest_axis()),
    };
    let counts = [n_left, frags.len() - n_left];
    range.part(&Sides { counts, bounds, centroids })
}

/// Divides a range of at most `SWEEP_MAX` fragments in two, or `None` if it is to be a leaf.
fn small(range: &mut Range, context: Context) -> Option<Sides> {
    let n = range.n;
    let may_be_leaf = n <= MAX_LEAF as usize;
    range.frags[..n].sort_unstable_by_key(Fragment::index);
    if n == 1 || (may_be_leaf && range.levels == 0) {
        return None;
    }
    let best = sweep::best(&range.frags[..n]);
    let cost = best.map_or(f32::INFINITY, |s| s.cost);
    let as_leaf =
        if may_be_leaf { range.bounds.half_area() * (n as f32 - NODE_COST) } else { f32::INFINITY };
    let fitting = best.filter(|s| range.fits([s.n_left, n - s.n_left]));
    let looks = match &fitting {
        Some(s) => range.overlaps(&s.left, &s.right, context.rules.min_overlap),
        None => true,
    };
    let limit = if looks { cost.min(as_leaf) } else { 0.0 };
    if let Some(sides) = spatial(range, context, limit, None, false) {
        return Some(sides);
    }
    if may_be_leaf && cost >= as_leaf {
        return None;
    }
    let frags = &mut range.frags[..n];
    let s = fitting.unwrap_or_else(|| sweep::median(frags));
    sweep::partition(frags, &s);
    let (left, right) = frags.split_at(s.n_left);
    let centroids = [left, right]
        .map(|part| part.iter().fold(Bounds::EMPTY, |b, f| b.with_point(f.centroid2())));
    Some(Sides { counts: [s.n_left, n - s.n_left], bounds: [s.left, s.right], centroids })
}

/// What a spatial split is looked for with.
#[derive(Clone, Copy)]
struct Search {
    /// It must cost less than this.
    limit: f32,
    /// Axes of its plane.
    axes: Axes,
    /// On all threads.
    parallel: bool,
}

/// Makes the best spatial split if it costs less than `MAX_COST * limit` and there is room for its
/// pieces; remembers whether it was worth looking. `bins` are those of the object split, if it has any.
fn spatial(
    range: &mut Range,
    context: Context,
    limit: f32,
    bins: Option<&Bins>,
    parallel: bool,
) -> Option<Sides> {
    if range.splits.is_empty() || !(limit > 0.0 && limit.is_finite()) {
        return None;
    }
    let limit = limit * MAX_COST;
    let axes = bins.map_or([true; 3], |bins| bins.axes_worth_cutting(limit));
    let looks =
        axes.contains(&true) && (!context.gives_up(range) || is_promising(range, context, axes));
    let search = Search { limit, axes, parallel };
    let sides = if looks { cheaper(range, context, search) } else { None };
    range.patience = match &sides {
        Some(_) => context.rules.patience.unwrap_or(0),
        None => range.patience.saturating_sub(1),
    };
    sides
}

/// Whether a spatial split of some of the fragments along `axes` costs less than an object split of them. Both are of
/// the same sample, whose boxes are too small for either.
fn is_promising(range: &Range, context: Context, axes: Axes) -> bool {
    let (every, least) = SAMPLE;
    let step = every.min(range.n / least).max(1);
    let sample: Vec<Fragment> = range.frags[..range.n].iter().step_by(step).copied().collect();
    let object = Bins::fill(&sample, &Mapping::new(&range.centroids)).best();
    let Some(object) = object else { return true };
    let slabs = Slabs::<16>::new(&range.bounds, axes);
    let spatial = SpatialBins::fill(&sample, context.corners, &slabs).best(&slabs);
    spatial.is_some_and(|s| s.cost < object.cost(sample.len()))
}

/// The best spatial split, see [`spatial`].
fn cheaper(range: &mut Range, context: Context, search: Search) -> Option<Sides> {
    let limit = search.limit;
    let best = match context.rules.bins {
        Fineness::Coarse if range.n <= SWEEP_MAX => candidate::<8>(range, context, search),
        Fineness::Fine if range.n > SWEEP_MAX => candidate::<32>(range, context, search),
        Fineness::Coarse | Fineness::Fine => candidate::<16>(range, context, search),
    };
    let best = best.filter(|s| s.cost < limit)?;
    let mut cut = Cut::new(&range.frags[..range.n], context.corners, best.plane);
    cut.limit_pieces(&range.frags[..range.n], range.splits.len());
    let [n_left, n_right] = cut.counts;
    let sound = n_left > 0
        && n_right > 0
        && cut.n_pieces() <= range.splits.len()
        && cut.cost() < limit
        && range.fits(cut.counts);
    sound.then(|| cut.make(range))
}

/// The best plane between `N` slabs.
fn candidate<const N: usize>(
    range: &Range,
    context: Context,
    search: Search,
) -> Option<SpatialSplit> {
    let slabs = Slabs::<N>::new(&range.bounds, search.axes);
    let frags = &range.frags[..range.n];
    let bins = if search.parallel {
        SpatialBins::fill_parallel(frags, context.corners, &slabs)
    } else {
        SpatialBins::fill(frags, context.corners, &slabs)
    };
    bins.best(&slabs)
}

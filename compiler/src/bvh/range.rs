//! A range of fragments with room for more, before and after it is divided.

use super::build;
use super::fragment::{Bounds, Fragment};
use super::pieces::Split;

/// No range is given room for more than this many references for each that it has.
const MOST_PER_REFERENCE: usize = 4;
/// Fragments of a range that are asked for their length, about; all of fewer.
const ASKED: usize = 1 << 13;
/// Steps of a fragment's length, by the length of its node.
const SIZE_STEPS: f32 = 1_073_741_824.0; // 2^30

/// A range of fragments to turn into a subtree.
pub(super) struct Range<'a> {
    /// The fragments, then free places.
    pub(super) frags: &'a mut [Fragment],
    /// How many fragments there are.
    pub(super) n: usize,
    /// What becomes of the free places; as many as there are.
    pub(super) splits: &'a mut [Split],
    /// Number of the piece that takes the first free place.
    pub(super) next: u32,
    /// Inner levels that may still be used.
    pub(super) levels: u32,
    pub(super) bounds: Bounds,
    /// Bounds of the doubled centroids.
    pub(super) centroids: Bounds,
    /// How many more spatial splits may be looked for in vain.
    pub(super) patience: u32,
}

/// The two sides of a split: how many go where, and their bounds.
pub(super) struct Sides {
    pub(super) counts: [usize; 2],
    pub(super) bounds: [Bounds; 2],
    pub(super) centroids: [Bounds; 2],
}

impl<'a> Range<'a> {
    /// The range of `n` fragments, which are followed by free places.
    pub(super) fn whole(
        frags: &'a mut [Fragment],
        n: usize,
        splits: &'a mut [Split],
        patience: u32,
    ) -> Self {
        let [bounds, centroids] = build::measure(&frags[..n]);
        let next = u32::try_from(n).expect("at most 2^27 primitives");
        let levels = build::MAX_INNER_LEVELS;
        Self { frags, n, splits, next, levels, bounds, centroids, patience }
    }

    /// Whether median splits would get both sides into leaves within the levels below this one.
    pub(super) fn fits(&self, counts: [usize; 2]) -> bool {
        self.levels > 0 && build::levels_needed(counts[0].max(counts[1])) < self.levels
    }

    /// Whether two children share so much of this node that a spatial split may be better.
    pub(super) fn overlaps(&self, left: &Bounds, right: &Bounds, min_overlap: f32) -> bool {
        left.overlap(*right) > min_overlap * self.bounds.half_area()
    }

    /// The two sides as ranges of their own; free places go with them.
    pub(super) fn part(self, sides: &Sides) -> [Range<'a>; 2] {
        let Range { frags, n, splits, next, levels, bounds, patience, .. } = self;
        let [n_left, n_right] = sides.counts;
        debug_assert_eq!(n, n_left + n_right);
        let free = splits.len();
        let unit = bounds.half_area().sqrt();
        let for_left = share(free, [&frags[..n_left], &frags[n_left..n]], unit);
        // The first of the right side make room for the left side's free places.
        let moved = for_left.min(n_right);
        frags.copy_within(n_left..n_left + moved, n + for_left - moved);
        let (left, right) = frags.split_at_mut(n_left + for_left);
        let (left_splits, right_splits) = splits.split_at_mut(for_left);
        let right_next = next + u32::try_from(for_left).expect("at most 2^27 pieces");
        let side = |frags, splits, next, k: usize| Range {
            frags,
            n: sides.counts[k],
            splits,
            next,
            levels: levels - 1,
            bounds: sides.bounds[k],
            centroids: sides.centroids[k],
            patience,
        };
        [side(left, left_splits, next, 0), side(right, right_splits, right_next, 1)]
    }
}

/// How many of the free places the left side gets: its part of the sum of the fragments' sizes, in
/// units of the size `unit`; of many fragments some are asked. Long fragments among short ones are what is split.
fn share(free: usize, sides: [&[Fragment]; 2], unit: f32) -> usize {
    if free == 0 {
        return 0;
    }
    let step = (sides[0].len() + sides[1].len()).div_ceil(ASKED).max(1);
    let scale = SIZE_STEPS / unit;
    let wants = |part: &[Fragment]| {
        let asked = part.iter().step_by(step).map(|f| u64::from(size(f, scale)));
        asked.sum::<u64>().saturating_mul(step as u64)
    };
    let [l, r] = sides.map(|part| u128::from(wants(part)) + part.len() as u128);
    let for_left = free as u128 * l / (l + r);
    let for_left = usize::try_from(for_left).expect("at most `free`");
    let most = sides.map(|part| part.len() * MOST_PER_REFERENCE);
    // What the right side could not use is better off on the left.
    for_left.min(most[0]).max(free.saturating_sub(most[1]))
}

/// The length of a fragment, in units of `1 / scale`, as a whole number, so that sums do not depend on their order.
fn size(f: &Fragment, scale: f32) -> u32 {
    let parts = f.bounds().half_area().sqrt() * scale;
    if f.is_whole() || !parts.is_finite() {
        return 0;
    }
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "0 to 2^30")]
    {
        parts as u32
    }
}

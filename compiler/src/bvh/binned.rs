//! Binned surface-area heuristic for large nodes.
//!
//! Turns a range of fragments into the best of 3 x 15 split planes between 16 bins per axis. Bins
//! divide the bounds of the *centroids*, so coincident boxes of any size still separate. Minimum,
//! maximum and counting are exact, so the result does not depend on the order of the fragments nor
//! on how they were divided among threads.
//!
//! Wald 2007, "On fast Construction of SAH-based Bounding Volume Hierarchies".

use glam::Vec4;
use rayon::prelude::*;

use super::fragment::{Bounds, Fragment};

/// Bins per axis.
pub(super) const N_BINS: usize = 16;

/// Fragments per parallel piece of work.
const CHUNK: usize = 1 << 14;

/// 1.5 * 2^23: adding it to `x` in [0, 2^22) leaves round(x) in the low bits of the sum.
const ROUND: f32 = 12_582_912.0;

/// Centroid to bin, per axis.
#[derive(Clone, Copy, Debug)]
pub(super) struct Mapping {
    origin: Vec4,
    scale: Vec4,
}

impl Mapping {
    /// Spreads the bins over the given bounds of doubled centroids. An axis without extent maps
    /// everything to bin 0.
    pub(super) fn new(centroids: &Bounds) -> Self {
        let extent = (centroids.hi - centroids.lo).to_array();
        // 1 - 2^-20: keeps the last centroid below the end of the last bin after rounding.
        let span = N_BINS as f32 * (1.0 - 1.0 / 1_048_576.0);
        let scale = [0, 1, 2].map(|k| {
            let s = span / extent[k];
            if s.is_finite() { s } else { 0.0 }
        });
        Self { origin: centroids.lo, scale: Vec4::new(scale[0], scale[1], scale[2], 0.0) }
    }

    /// The bins of a doubled centroid on all axes; the fourth lane means nothing.
    #[inline]
    fn bins(&self, centroid2: Vec4) -> [u32; 4] {
        let x = (centroid2 - self.origin) * self.scale - Vec4::splat(0.5);
        let x = x.min(Vec4::splat((N_BINS - 1) as f32)) + Vec4::splat(ROUND);
        x.to_array().map(f32::to_bits)
    }
}

/// Which of the three axes.
pub(super) type Axes = [bool; 3];

/// Boxes and counts per axis and bin.
#[derive(Clone)]
pub(super) struct Bins {
    bounds: [[Bounds; N_BINS]; 3],
    counts: [[u32; N_BINS]; 3],
}

/// A split plane: bins `0 ..= last_left` of `axis` go left.
#[derive(Clone, Copy, Debug)]
pub(super) struct BinSplit {
    pub(super) axis: usize,
    pub(super) last_left: u32,
    pub(super) n_left: usize,
    pub(super) left: Bounds,
    pub(super) right: Bounds,
}

impl BinSplit {
    /// Half-areas weighted by counts, of `n` fragments.
    pub(super) fn cost(&self, n: usize) -> f32 {
        self.left.half_area() * self.n_left as f32
            + self.right.half_area() * (n - self.n_left) as f32
    }
}

impl Bins {
    const EMPTY: Self = Self { bounds: [[Bounds::EMPTY; N_BINS]; 3], counts: [[0; N_BINS]; 3] };

    /// Fills the bins on this thread.
    pub(super) fn fill(frags: &[Fragment], mapping: &Mapping) -> Self {
        let mut bins = Self::EMPTY;
        for f in frags {
            let at = mapping.bins(f.centroid2());
            let b = f.bounds();
            for (axis, &bin) in at.iter().enumerate().take(3) {
                let bin = bin as usize % N_BINS;
                let slot = &mut bins.bounds[axis][bin];
                *slot = slot.union(b);
                bins.counts[axis][bin] += 1;
            }
        }
        bins
    }

    /// Fills the bins on all threads; equal to [`Bins::fill`] bit for bit.
    pub(super) fn fill_parallel(frags: &[Fragment], mapping: &Mapping) -> Self {
        frags
            .par_chunks(CHUNK)
            .map(|chunk| Self::fill(chunk, mapping))
            .reduce(|| Self::EMPTY, |a, b| a.merge(&b))
    }

    fn merge(mut self, other: &Self) -> Self {
        for axis in 0..3 {
            for bin in 0..N_BINS {
                let slot = &mut self.bounds[axis][bin];
                *slot = slot.union(other.bounds[axis][bin]);
                self.counts[axis][bin] += other.counts[axis][bin];
            }
        }
        self
    }

    /// The cheapest plane with primitives on both sides, or `None` when there is no plane or areas
    /// cannot tell planes apart (all of them zero or infinite). Of equal costs the more even split
    /// wins, then the lower axis, then the lower plane.
    pub(super) fn best(&self) -> Option<BinSplit> {
        let mut best = (f32::INFINITY, u32::MAX);
        let mut found = None;
        for axis in 0..3 {
            let (bounds, counts) = (&self.bounds[axis], &self.counts[axis]);
            let mut above = [(0.0_f32, 0_u32); N_BINS];
            let (mut acc, mut n) = (Bounds::EMPTY, 0);
            for bin in (1..N_BINS).rev() {
                acc = acc.union(bounds[bin]);
                n += counts[bin];
                above[bin] = (if n > 0 { acc.half_area() * n as f32 } else { 0.0 }, n);
            }
            let (mut acc, mut n) = (Bounds::EMPTY, 0);
            for bin in 0..N_BINS - 1 {
                acc = acc.union(bounds[bin]);
                n += counts[bin];
                let (cost_above, n_above) = above[bin + 1];
                if n == 0 || n_above == 0 {
                    continue;
                }
                let cost = acc.half_area() * n as f32 + cost_above;
                let key = (cost, n.abs_diff(n_above));
                if cost > 0.0 && cost.is_finite() && key < best {
                    best = key;
                    found = Some((axis, bin));
                }
            }
        }
        found.map(|(axis, bin)| self.split_at(axis, bin))
    }

    /// The axes along which a spatial split may cost less than `limit`: those with a plane that would, if fragments
    /// could be cut at it without being counted twice, and those that have no plane to tell by.
    pub(super) fn axes_worth_cutting(&self, limit: f32) -> Axes {
        [0, 1, 2].map(|axis| {
            let (bounds, counts) = (&self.bounds[axis], &self.counts[axis]);
            let mut above = [Side::EMPTY; N_BINS];
            let mut right = Side::EMPTY;
            for bin in (1..N_BINS).rev() {
                right = right.with(bounds[bin], counts[bin]);
                above[bin] = right;
            }
            let mut left = Side::EMPTY;
            let mut has_plane = false;
            for bin in 0..N_BINS - 1 {
                left = left.with(bounds[bin], counts[bin]);
                let right = above[bin + 1];
                if left.n > 0 && right.n > 0 {
                    has_plane = true;
                    if cost_of_free_cut(axis, left, right) < limit {
                        return true;
                    }
                }
            }
            !has_plane
        })
    }

    fn split_at(&self, axis: usize, bin: usize) -> BinSplit {
        let (low, high) = self.bounds[axis].split_at(bin + 1);
        let all = |part: &[Bounds]| part.iter().fold(Bounds::EMPTY, |a, b| a.union(*b));
        BinSplit {
            axis,
            last_left: u32::try_from(bin).expect("there are 16 bins"),
            n_left: self.counts[axis][..=bin].iter().map(|&n| n as usize).sum(),
            left: all(low),
            right: all(high),
        }
    }
}

/// What is on one side of a plane.
#[derive(Clone, Copy)]
struct Side {
    bounds: Bounds,
    n: u32,
}

impl Side {
    const EMPTY: Self = Self { bounds: Bounds::EMPTY, n: 0 };

    fn with(self, bounds: Bounds, n: u32) -> Self {
        Self { bounds: self.bounds.union(bounds), n: self.n + n }
    }
}

/// The least cost of two sides that a plane cuts somewhere between the beginning of the right one and the end of the
/// left one. The cost is linear in the place of the plane, so one of these two ends is best.
fn cost_of_free_cut(axis: usize, left: Side, right: Side) -> f32 {
    let overlap = (left.bounds.hi[axis] - right.bounds.lo[axis]).max(0.0);
    let [(a, saved_a), (b, saved_b)] = [left, right].map(|Side { bounds, n }| {
        let d = (bounds.hi - bounds.lo).to_array();
        let girth = d[(axis + 1) % 3] + d[(axis + 2) % 3];
        (bounds.half_area() * n as f32, overlap.min(d[axis]) * girth * n as f32)
    });
    a + b - saved_a.max(saved_b)
}

/// Moves the fragments of the left side to the front. Returns the bounds of the doubled centroids
/// of both sides. Which fragments go where is decided by value; their order within a side is
/// settled later, when leaves are sorted.
pub(super) fn partition(
    frags: &mut [Fragment],
    mapping: &Mapping,
    split: &BinSplit,
) -> [Bounds; 2] {
    let (origin, scale) = (mapping.origin[split.axis], mapping.scale[split.axis]);
    // The same operations as in `Mapping::bins`, on one lane: the same bits.
    let threshold = ROUND + split.last_left as f32;
    let is_left = |f: &Fragment| {
        let x = (f.centroid2()[split.axis] - origin) * scale - 0.5;
        x.min((N_BINS - 1) as f32) + ROUND <= threshold
    };
    let mut sides = [Bounds::EMPTY; 2];
    let (mut i, mut j) = (0, frags.len());
    loop {
        while i < j && is_left(&frags[i]) {
            sides[0] = sides[0].with_point(frags[i].centroid2());
            i += 1;
        }
        while i < j && !is_left(&frags[j - 1]) {
            sides[1] = sides[1].with_point(frags[j - 1].centroid2());
            j -= 1;
        }
        if i >= j {
            break;
        }
        frags.swap(i, j - 1);
    }
    debug_assert_eq!(i, split.n_left);
    sides
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Part of the best other split's cost that a spatial split must stay below.
    const LESS: f32 = 0.985;

    /// Boxes of `size` in a row along x, 1 apart.
    fn row(size: [f32; 3]) -> Vec<Fragment> {
        let at = |i: u8| {
            let lo = [f32::from(i), 0.0, 0.0];
            Fragment::new(lo, [lo[0] + size[0], size[1], size[2]], u32::from(i))
        };
        (0..64).map(at).collect()
    }

    fn worth_cutting(frags: &[Fragment]) -> Axes {
        let centroids = frags.iter().fold(Bounds::EMPTY, |b, f| b.with_point(f.centroid2()));
        let bins = Bins::fill(frags, &Mapping::new(&centroids));
        let cost = bins.best().map_or(f32::INFINITY, |split| split.cost(frags.len()));
        bins.axes_worth_cutting(LESS * cost)
    }

    #[test]
    fn only_what_overlaps_is_worth_cutting() {
        // Along y and z nothing tells what a cut would give.
        assert_eq!(worth_cutting(&row([0.9, 1.0, 1.0])), [false, true, true]);
        assert_eq!(worth_cutting(&row([30.0, 1.0, 1.0])), [true, true, true]);
        // Apart along x; along the other axes a split costs more even if what it cuts counts once.
        let stairs = (0..64_u8).map(|i| {
            let lo = [f32::from(i), f32::from(i % 8) * 0.125, 0.0];
            Fragment::new(lo, [lo[0] + 0.9, lo[1] + 1.0, f32::from(1 + i % 2)], u32::from(i))
        });
        assert_eq!(worth_cutting(&stairs.collect::<Vec<_>>()), [false; 3]);
    }
}

//! Candidates for spatial splits.
//!
//! Turns a range of fragments into the best of the n - 1 planes of each axis asked for that cut the box of the range
//! into n equal slabs. A fragment that crosses planes counts on both sides, with the boxes of its parts.
//! The parts are in `f32` and only guide the choice; `clip` makes the real ones. Minimum, maximum and
//! counting are exact, so threads change nothing.
//!
//! Stich, Friedrich, Dietrich 2009, "Spatial Splits in Bounding Volume Hierarchies".

use glam::Vec4;
use rayon::prelude::*;

use super::binned::Axes;
use super::clip::Plane;
use super::fragment::{Bounds, Fragment};
use super::input::Corners;

/// Fragments per parallel piece of work.
const CHUNK: usize = 1 << 13;

/// 1.5 * 2^23: see `binned`.
const ROUND: f32 = 12_582_912.0;

/// Cuts a box into `N` slabs along some axes; `N` is a power of two.
#[derive(Clone, Copy, Debug)]
pub(super) struct Slabs<const N: usize> {
    lo: Vec4,
    extent: Vec4,
    scale: Vec4,
    axes: Axes,
}

/// The cheapest plane and its cost: half-areas weighted by counts.
#[derive(Clone, Copy, Debug)]
pub(super) struct SpatialSplit {
    pub(super) plane: Plane,
    pub(super) cost: f32,
}

impl<const N: usize> Slabs<N> {
    pub(super) fn new(bounds: &Bounds, axes: Axes) -> Self {
        let bounds = bounds.without_lanes();
        let extent = bounds.hi - bounds.lo;
        let scale = extent.to_array().map(|e| {
            let s = N as f32 / e;
            if s.is_finite() { s } else { 0.0 }
        });
        Self { lo: bounds.lo, extent, scale: Vec4::from_array(scale), axes }
    }

    #[inline]
    fn axes(&self) -> impl Iterator<Item = usize> {
        let axes = self.axes;
        (0..3).filter(move |axis| axes[*axis])
    }

    /// The slabs that a point is in; the fourth lane means nothing.
    #[inline]
    fn of(&self, p: Vec4) -> [usize; 4] {
        let x = (p - self.lo) * self.scale - Vec4::splat(0.5);
        let x = x.max(Vec4::ZERO).min(Vec4::splat((N - 1) as f32)) + Vec4::splat(ROUND);
        x.to_array().map(|x| x.to_bits() as usize % N)
    }

    /// The slab that a coordinate is in: the same operations, on one lane.
    #[inline]
    fn along(&self, axis: usize, x: f32) -> usize {
        let x = (x - self.lo[axis]) * self.scale[axis] - 0.5;
        (x.max(0.0).min((N - 1) as f32) + ROUND).to_bits() as usize % N
    }

    /// The lower face of slab `k`.
    #[inline]
    fn face(&self, axis: usize, k: usize) -> f32 {
        self.lo[axis] + self.extent[axis] * (k as f32 / N as f32)
    }
}

/// Boxes and counts per axis and slab.
#[derive(Clone)]
pub(super) struct SpatialBins<const N: usize> {
    bounds: [[Bounds; N]; 3],
    enter: [[u32; N]; 3],
    leave: [[u32; N]; 3],
}

impl<const N: usize> SpatialBins<N> {
    const EMPTY: Self =
        Self { bounds: [[Bounds::EMPTY; N]; 3], enter: [[0; N]; 3], leave: [[0; N]; 3] };

    /// Fills the bins on this thread.
    pub(super) fn fill(frags: &[Fragment], corners: Corners, slabs: &Slabs<N>) -> Self {
        let mut bins = Self::EMPTY;
        let mut parts = [Bounds::EMPTY; N];
        for f in frags {
            let b = f.bounds();
            let (from, to) = (slabs.of(b.lo), slabs.of(b.hi));
            let mut points = None;
            for axis in slabs.axes() {
                let (from, to) = (from[axis], to[axis]);
                bins.enter[axis][from] += 1;
                bins.leave[axis][to] += 1;
                let row = &mut bins.bounds[axis];
                if from == to {
                    row[from] = row[from].union(b);
                } else if f.is_whole() {
                    row[from..=to].iter_mut().for_each(|slot| *slot = slot.union(b));
                } else {
                    let corners = corners.of(f);
                    let points = points
                        .get_or_insert_with(|| corners.map(|[x, y, z]| Vec4::new(x, y, z, 0.0)));
                    let part = Part {
                        axis,
                        from,
                        to,
                        lowest: b.lo[axis],
                        highest: b.hi[axis],
                        along: corners.map(|c| c[axis]),
                        points,
                    };
                    part.cut(slabs, &mut parts);
                    for (slot, part) in row[from..=to].iter_mut().zip(&parts[from..=to]) {
                        *slot = slot.union(part.intersection(b));
                    }
                }
            }
        }
        bins
    }

    /// Fills the bins on all threads; equal to [`SpatialBins::fill`] bit for bit.
    pub(super) fn fill_parallel(frags: &[Fragment], corners: Corners, slabs: &Slabs<N>) -> Self {
        frags
            .par_chunks(CHUNK)
            .map(|chunk| Self::fill(chunk, corners, slabs))
            .reduce(|| Self::EMPTY, |a, b| a.merge(&b))
    }

    fn merge(mut self, other: &Self) -> Self {
        for axis in 0..3 {
            for bin in 0..N {
                let slot = &mut self.bounds[axis][bin];
                *slot = slot.union(other.bounds[axis][bin]);
                self.enter[axis][bin] += other.enter[axis][bin];
                self.leave[axis][bin] += other.leave[axis][bin];
            }
        }
        self
    }

    /// The cheapest plane with something on both sides. Of equal costs the lower axis wins, then the
    /// lower plane.
    pub(super) fn best(&self, slabs: &Slabs<N>) -> Option<SpatialSplit> {
        let mut best: Option<SpatialSplit> = None;
        for axis in slabs.axes().filter(|axis| slabs.scale[*axis] != 0.0) {
            let bounds = &self.bounds[axis];
            let mut above = [(0.0_f32, 0_u32); N];
            let (mut acc, mut n) = (Bounds::EMPTY, 0);
            for bin in (1..N).rev() {
                acc = acc.union(bounds[bin]);
                n += self.leave[axis][bin];
                above[bin] = (if n > 0 { acc.half_area() * n as f32 } else { 0.0 }, n);
            }
            let (mut acc, mut n) = (Bounds::EMPTY, 0);
            for bin in 0..N - 1 {
                acc = acc.union(bounds[bin]);
                n += self.enter[axis][bin];
                let (cost_above, n_above) = above[bin + 1];
                if n == 0 || n_above == 0 {
                    continue;
                }
                let cost = acc.half_area() * n as f32 + cost_above;
                if cost > 0.0 && cost < best.map_or(f32::INFINITY, |b| b.cost) {
                    let plane = Plane { axis, at: slabs.face(axis, bin + 1) };
                    best = Some(SpatialSplit { plane, cost });
                }
            }
        }
        best
    }
}

/// The part of a triangle between two planes at right angles to an axis.
struct Part<'a> {
    axis: usize,
    /// The slabs that it is in.
    from: usize,
    to: usize,
    /// The planes.
    lowest: f32,
    highest: f32,
    /// The corners of the triangle, along the axis and in space.
    along: [f32; 3],
    points: &'a [Vec4; 3],
}

impl Part<'_> {
    /// Fills `parts[from ..= to]` with the boxes of what is in each slab.
    #[inline]
    fn cut<const N: usize>(&self, slabs: &Slabs<N>, parts: &mut [Bounds; N]) {
        let Self { axis, from, to, lowest, highest, .. } = *self;
        let width = slabs.extent[axis] * (1.0 / N as f32);
        parts[from..=to].fill(Bounds::EMPTY);
        for [i, j] in [[0, 1], [1, 2], [2, 0]] {
            let [i, j] = if self.along[i] <= self.along[j] { [i, j] } else { [j, i] };
            let (x, y) = (self.along[i], self.along[j]);
            if x > highest || y < lowest {
                continue;
            }
            let (a, b) = (self.points[i], self.points[j]);
            let slope = (b - a) * (1.0 / (y - x).max(f32::MIN_POSITIVE));
            let at = |plane: f32| a + slope * (plane - x);
            let (first, start) = if x < lowest {
                (from, at(lowest))
            } else {
                (slabs.along(axis, x).clamp(from, to), a)
            };
            let (last, end) = if y > highest {
                (to, at(highest))
            } else {
                (slabs.along(axis, y).clamp(first, to), b)
            };
            parts[first] = parts[first].with_point(start);
            let mut p = at(slabs.face(axis, first + 1));
            for slab in first..last {
                parts[slab] = parts[slab].with_point(p);
                parts[slab + 1] = parts[slab + 1].with_point(p);
                p += slope * width;
            }
            parts[last] = parts[last].with_point(end);
        }
    }
}

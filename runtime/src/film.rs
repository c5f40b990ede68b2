//! Batch sums of tiles → the film: `f64` sums of radiance and the number of samples of every pixel.
//!
//! Invariant: batches are added in ascending order, each exactly once, and only when the whole
//! region has arrived. So the film never depends on the order in which tiles finish, and it is
//! evenly sampled at every moment. It does not know devices or files.

use crate::region::{Rect, SampleRange};
use crate::replicate::{REPLICATES, REPLICATES_U32, luminance};
use crate::zeros::{NoMemory, zeros};
use pack::abi::BATCH;
use std::borrow::Cow;
use std::fmt;

mod accumulator;
mod rows;

pub(crate) use accumulator::Accumulator;

/// A sample whose radiance was not finite; enough to render it again.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct BadSample {
    /// Column in the image.
    pub x: u32,
    /// Row in the image.
    pub y: u32,
    /// Sample index.
    pub sample: u32,
}

impl fmt::Display for BadSample {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{},{},{}", self.x, self.y, self.sample)
    }
}

/// What was counted beside the radiance.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Counters {
    /// Rays traced: camera, bounce and shadow.
    pub rays: u64,
    /// Samples that were not finite and count as black.
    pub bad: u64,
    /// The bad sample with the lowest batch, then row, then column.
    pub first_bad: Option<BadSample>,
    /// Longest path in segments.
    pub depth: u32,
    /// Times that a path was inside of more things than it can remember: the least of them was lost.
    pub overflows: u64,
    /// Times that a path left a thing which it had never entered: a mesh is open or inside out.
    pub leaks: u64,
    /// Sum of the luminance that `Job::clamp_indirect` has taken away from the samples.
    pub removed: f64,
}

impl Counters {
    /// Adds what another part of the picture counted.
    pub fn add(&mut self, other: &Self) {
        self.rays += other.rays;
        self.bad += other.bad;
        let order = |bad: &BadSample| (bad.sample / BATCH, bad.y, bad.x);
        self.first_bad = self.first_bad.into_iter().chain(other.first_bad).min_by_key(order);
        self.depth = self.depth.max(other.depth);
        self.overflows += other.overflows;
        self.leaks += other.leaks;
        self.removed += other.removed;
    }
}

/// The accumulated picture of `region`.
#[derive(Clone, PartialEq)]
pub struct Film {
    /// Whole image in pixels; `region` lies inside it.
    pub image_size: [u32; 2],
    /// The pixels that exist here, row by row.
    pub region: Rect,
    /// Sample indices in the sums: sorted, disjoint, joined where they touch.
    pub ranges: Vec<SampleRange>,
    /// Sum of radiance over the samples, linear Rec. 709; `region.pixels()` entries.
    pub sums: Vec<[f64; 3]>,
    /// Samples behind each sum. All equal unless a run failed or stopped in its first batch.
    pub counts: Vec<u32>,
    /// Rays, bad samples, longest path.
    pub counters: Counters,
    /// Variance of the mean luminance of each pixel, where the picture is the mean of replicates;
    /// else empty. Then `ranges` are those of one replicate.
    pub variance: Vec<f64>,
}

/// Without the pixels, which nobody could read.
impl fmt::Debug for Film {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Film")
            .field("image_size", &self.image_size)
            .field("region", &self.region)
            .field("ranges", &self.ranges)
            .field("samples", &self.samples())
            .field("counters", &self.counters)
            .finish_non_exhaustive()
    }
}

impl Film {
    /// A film without samples.
    #[must_use]
    pub fn new(image_size: [u32; 2], region: Rect) -> Self {
        Self::try_new(image_size, region).expect("there is memory; where not, use `try_new`")
    }

    /// A film without samples, when there is memory for it.
    pub fn try_new(image_size: [u32; 2], region: Rect) -> Result<Self, NoMemory> {
        let n = region.pixels();
        Ok(Self { sums: zeros(n)?, counts: zeros(n)?, ..Self::without_pixels(image_size, region) })
    }

    /// What is left of a film whose pixels were taken.
    pub(crate) fn without_pixels(image_size: [u32; 2], region: Rect) -> Self {
        Self {
            image_size,
            region,
            ranges: Vec::new(),
            sums: Vec::new(),
            counts: Vec::new(),
            counters: Counters::default(),
            variance: Vec::new(),
        }
    }

    /// A copy, when there is memory for it.
    pub(crate) fn try_clone(&self) -> Result<Self, NoMemory> {
        Ok(Self {
            ranges: self.ranges.clone(),
            sums: copied(&self.sums)?,
            counts: copied(&self.counts)?,
            counters: self.counters,
            variance: copied(&self.variance)?,
            ..Self::without_pixels(self.image_size, self.region)
        })
    }

    /// Pictures of independent noise whose mean this is.
    #[must_use]
    pub fn replicates(&self) -> u32 {
        if self.variance.is_empty() { 1 } else { REPLICATES_U32 }
    }

    /// Mean radiance of pixel `i` of the region; without samples what stands in for it, or black.
    #[must_use]
    pub fn mean(&self, i: usize) -> [f64; 3] {
        let n = f64::from(self.counts[i].max(1));
        self.sums[i].map(|sum| sum / n)
    }

    /// Mean radiance of every pixel, row by row.
    #[must_use]
    pub fn means(&self) -> Vec<[f64; 3]> {
        (0..self.sums.len()).map(|i| self.mean(i)).collect()
    }

    /// Share of the light that `Counters::removed` is, from 0 to 1; 0 where there is no light.
    #[must_use]
    pub fn removed(&self) -> f64 {
        self.removed_of(self.sums.iter().map(|sum| luminance(*sum)).sum())
    }

    /// The same where the luminance of all samples is known.
    pub(crate) fn removed_of(&self, kept: f64) -> f64 {
        let removed = self.counters.removed;
        if removed > 0.0 { removed / (removed + kept) } else { 0.0 }
    }

    /// Fewest and most samples that any pixel has.
    #[must_use]
    pub fn samples(&self) -> (u32, u32) {
        let least = self.counts.iter().copied().min().unwrap_or(0);
        (least, self.counts.iter().copied().max().unwrap_or(0))
    }

    /// Whether every pixel has the same number of samples.
    #[must_use]
    pub fn is_even(&self) -> bool {
        let (least, most) = self.samples();
        least == most
    }

    /// Samples of all pixels together.
    #[must_use]
    pub fn total_samples(&self) -> u64 {
        self.counts.iter().map(|&n| u64::from(n)).sum()
    }

    /// Place of a pixel of the region in `sums` and `counts`.
    pub(crate) fn index(&self, x: u32, y: u32) -> usize {
        let row = u64::from(y - self.region.y) * u64::from(self.region.w);
        usize::try_from(row + u64::from(x - self.region.x)).expect("a pixel of the region")
    }
}

fn copied<T: Copy>(from: &[T]) -> Result<Vec<T>, NoMemory> {
    let mut to = Vec::new();
    to.try_reserve_exact(from.len()).map_err(|_| NoMemory { bytes: size_of_val(from) as u64 })?;
    to.extend_from_slice(from);
    Ok(to)
}

/// Luminance of every pixel in every replicate.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Lumas<'a> {
    /// Sums over the samples.
    pub(crate) sums: &'a [[f64; REPLICATES]],
    /// Samples of a replicate where a pixel has most.
    pub(crate) samples: u32,
    /// Samples of every pixel, all replicates together.
    pub(crate) counts: &'a [u32],
}

impl<'a> Lumas<'a> {
    /// Sums, and what makes means of them.
    pub(crate) fn means(&self) -> (Cow<'a, [[f64; REPLICATES]]>, f64) {
        let whole = self.samples * REPLICATES_U32;
        if self.counts.iter().all(|count| *count == whole) {
            return (Cow::Borrowed(self.sums), 1.0 / f64::from(self.samples.max(1)));
        }
        let mean = |(sums, count): (&[f64; REPLICATES], &u32)| {
            sums.map(|sum| sum / f64::from((count / REPLICATES_U32).max(1)))
        };
        (self.sums.iter().zip(self.counts).map(mean).collect(), 1.0)
    }

    /// Samples of all pixels together.
    pub(crate) fn total(&self) -> u64 {
        self.counts.iter().map(|count| u64::from(*count)).sum()
    }
}

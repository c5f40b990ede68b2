//! Errors of pixels → which blocks of a picture get fewer samples.
//!
//! For a given sum of samples the mean square error is least where each block has samples in proportion to its
//! error (Neyman 1934): so a block with half the error takes part in every second batch. That is decided once,
//! from the first samples, which stay in the picture: blocks that look better than they are get fewer samples to
//! put that right, so the picture is slightly biased and is labelled. It knows neither schedule nor film.

use crate::region::{Rect, SampleRange};
use pack::abi::BATCH;
use std::fmt;

/// Side of a block in pixels.
const SIDE: u32 = 8;
/// Blocks with more error than this share of all have all samples.
const FULL: f64 = 0.95;
/// Fewest: every fourth batch. An outlier that nobody has seen yet is still met in time.
const MOST_SHIFT: u32 = 2;

/// How often every block of a picture takes part.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct Allocation {
    /// Blocks in a row.
    across: usize,
    /// A block takes part in the batches that are multiples of two to this power, row by row.
    shifts: Vec<u32>,
}

impl Allocation {
    /// From the squared relative errors of pixels, row by row of `width`.
    pub(crate) fn new(squares: &[f64], width: u32) -> Self {
        let width = width.max(1) as usize;
        let (side, height) = (SIDE as usize, squares.len() / width);
        let (across, down) = (width.div_ceil(side), height.div_ceil(side));
        let mut blocks = vec![(0.0, 0.0); across * down];
        for (i, square) in squares.iter().enumerate() {
            let (sum, n) = &mut blocks[i / width / side * across + i % width / side];
            *sum += square;
            *n += 1.0;
        }
        let own: Vec<f64> = blocks.iter().map(|(sum, n)| sum / n).collect();
        let errors: Vec<f64> = (0..own.len()).map(|i| around(&own, across, i).sqrt()).collect();
        let mut sorted = errors.clone();
        sorted.sort_unstable_by(f64::total_cmp);
        #[expect(clippy::cast_possible_truncation, reason = "a share of a number of blocks")]
        let full = sorted.get((sorted.len() as f64 * FULL) as usize).copied().unwrap_or(0.0);
        // Without error there is nothing to tell blocks apart by; else the one at `full` has all samples.
        let fits = |error: f64, shift: u32| full > 0.0 && error * f64::from(1_u32 << shift) <= full;
        let shift = |error: &f64| (1..=MOST_SHIFT).rev().find(|s| fits(*error, *s)).unwrap_or(0);
        Self { across, shifts: errors.iter().map(shift).collect() }
    }

    /// What takes part in a pass over `samples`, which are part of one batch: rectangles without overlap.
    pub(crate) fn parts(&self, region: Rect, samples: SampleRange) -> Vec<Rect> {
        let batch = samples.start / BATCH;
        let takes_part = |shift: &u32| batch.is_multiple_of(1 << shift);
        let mut parts: Vec<Rect> = Vec::new();
        for (row, y) in self.shifts.chunks(self.across.max(1)).zip((0..).step_by(SIDE as usize)) {
            let (y, h) = (region.y + y, SIDE.min(region.h - y));
            let mut open: Option<Rect> = None;
            for (shift, x) in row.iter().zip((0..).step_by(SIDE as usize)) {
                let (x, w) = (region.x + x, SIDE.min(region.w - x));
                match (&mut open, takes_part(shift)) {
                    (Some(run), true) => run.w += w,
                    (None, true) => open = Some(Rect { x, y, w, h }),
                    (_, false) => join(&mut parts, open.take()),
                }
            }
            join(&mut parts, open);
        }
        parts.reverse();
        parts
    }

    /// Mean share of the samples that a block has.
    fn share(&self) -> f64 {
        let shares = self.shifts.iter().map(|shift| 1.0 / f64::from(1_u32 << shift));
        shares.sum::<f64>() / self.shifts.len().max(1) as f64
    }
}

/// `adaptive: from here on a block of 8x8 pixels gets 57 % of the samples on average`.
impl fmt::Display for Allocation {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let share = 100.0 * self.share();
        write!(
            f,
            "adaptive: from here on a block of {SIDE}x{SIDE} pixels gets {share:.0} % of the samples on average"
        )
    }
}

/// The squared error of block `i`, at least half of the mean of those around it: their neighbour may have the same
/// outliers and not have met one yet.
fn around(own: &[f64], across: usize, i: usize) -> f64 {
    let (x, y) = (i % across, i / across);
    let rows = y.saturating_sub(1)..(y + 2).min(own.len() / across);
    let (mut sum, mut n) = (0.0, 0.0);
    for row in rows {
        for value in &own[row * across + x.saturating_sub(1)..row * across + (x + 2).min(across)] {
            sum += value;
            n += 1.0;
        }
    }
    f64::max(own[i], 0.5 * sum / n)
}

/// Adds a run of blocks to the one right above it, or as a part of its own.
fn join(parts: &mut Vec<Rect>, run: Option<Rect>) {
    let Some(run) = run else { return };
    let above = |part: &&mut Rect| (part.x, part.w, part.y + part.h) == (run.x, run.w, run.y);
    match parts.iter_mut().rev().take(16).find(above) {
        Some(part) => part.h += run.h,
        None => parts.push(run),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const REGION: Rect = Rect { x: 3, y: 5, w: 20, h: 17 };

    fn samples(start: u32) -> SampleRange {
        SampleRange { start, end: start + 4 }
    }

    /// The left block of the picture has four times the error of the others.
    fn allocation() -> Allocation {
        let squares: Vec<f64> =
            (0..20 * 17).map(|i| if i % 20 < 8 { 16.0 } else { 0.25 }).collect();
        Allocation::new(&squares, REGION.w)
    }

    #[test]
    fn all_parts_together_are_the_region_once() {
        for start in [0, 16, 32, 48, 64] {
            let parts = allocation().parts(REGION, samples(start));
            let mut seen = vec![0; 20 * 17];
            for part in &parts {
                assert!(
                    part.x >= 3 && part.y >= 5 && part.x + part.w <= 23 && part.y + part.h <= 22
                );
                for y in part.y - 5..part.y - 5 + part.h {
                    for x in part.x - 3..part.x - 3 + part.w {
                        seen[(y * 20 + x) as usize] += 1;
                    }
                }
            }
            let n: u64 = parts.iter().map(|part| part.pixels()).sum();
            assert!(seen.iter().all(|n| *n <= 1) && n == seen.iter().sum::<i32>() as u64);
            assert_eq!(n == REGION.pixels(), start % 64 == 0, "{start}: {parts:?}");
            assert!(seen.iter().step_by(20).all(|n| *n == 1), "the noisy part is always in");
        }
        // A run of rows is one part.
        assert_eq!(allocation().parts(REGION, samples(64)).len(), 1);
    }

    #[test]
    fn an_even_picture_gets_even_samples() {
        for squares in [vec![1.0; 20 * 17], vec![0.0; 20 * 17]] {
            let allocation = Allocation::new(&squares, 20);
            let parts = allocation.parts(REGION, samples(16));
            assert_eq!(parts, [REGION]);
        }
    }
}

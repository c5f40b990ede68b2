//! Films of a few samples → the picture so far, how wrong it is, and its bytes for the page.
//!
//! Four replicates take turns, as when the error of a picture is measured, so that their spread tells the error of
//! their mean. It renders nothing.

use super::plane::single;
use crate::film::Film;
use crate::region::{Rect, SampleRange};
use crate::replicate::{REPLICATES, luminance, moments};
use crate::zeros::{NoMemory, zeros};
use half::f16;
use pack::abi::BATCH;

/// A picture on its way.
pub(super) struct Sums {
    /// Sums of radiance over all samples, linear Rec. 709, row by row.
    radiance: Vec<[f64; 3]>,
    /// Sums of luminance of each replicate.
    lumas: Vec<[f64; REPLICATES]>,
    /// Samples of every pixel in each replicate.
    counts: [u32; REPLICATES],
}

impl Sums {
    /// Nothing of an image of so many pixels, when there is memory for it.
    pub(super) fn new(size: [u32; 2]) -> Result<Self, NoMemory> {
        let n = Rect::whole(size).pixels();
        Ok(Self { radiance: zeros(n)?, lumas: zeros(n)?, counts: [0; REPLICATES] })
    }

    /// Samples of every pixel.
    pub(super) fn samples(&self) -> u32 {
        self.counts.iter().sum()
    }

    /// Which replicate is next, and which of its samples: at most `most`, and none of a batch after the next. All
    /// replicates of a round get the same, and no round more than all before it, so that the error is told on the way
    /// of even the fastest picture.
    pub(super) fn next(&self, most: u32) -> (u32, SampleRange) {
        let start = self.counts.iter().copied().min().unwrap_or(0);
        let (replicate, _) = (0..).zip(self.counts).find(|(_, n)| *n == start).unwrap_or_default();
        let end = self.counts.iter().copied().max().filter(|end| *end > start);
        let end = end.unwrap_or(start + most.clamp(1, start.clamp(1, BATCH - start % BATCH)));
        (replicate, SampleRange { start, end })
    }

    /// Whether all replicates have the same number of samples.
    pub(super) fn is_round(&self) -> bool {
        self.counts.iter().all(|n| *n == self.counts[0])
    }

    /// Adds a film of an evenly sampled image of the same size.
    pub(super) fn add(&mut self, film: &Film, replicate: u32) {
        let replicate = replicate as usize % REPLICATES;
        for ((sum, lumas), more) in self.radiance.iter_mut().zip(&mut self.lumas).zip(&film.sums) {
            for (sum, more) in sum.iter_mut().zip(more) {
                *sum += more;
            }
            lumas[replicate] += luminance(*more);
        }
        self.counts[replicate] += film.samples().0;
    }

    /// The mean of every pixel as three 16-bit floats, little endian, row by row.
    pub(super) fn bytes(&self) -> Vec<u8> {
        let scale = 1.0 / f64::from(self.samples().max(1));
        let mut bytes = Vec::with_capacity(6 * self.radiance.len());
        let most = f64::from(f16::MAX);
        for value in self.radiance.as_flattened() {
            let mean = (value * scale).clamp(0.0, most);
            bytes.extend(f16::from_f64(mean).to_le_bytes());
        }
        bytes
    }

    /// The relative standard error of every pixel, whose root mean square is `error`; `None` where that is.
    pub(super) fn errors(&self) -> Option<Vec<f32>> {
        let (scale, floor) = self.scale_and_floor()?;
        let of_pixel = |sums| single(relative_variance(sums, scale, floor).sqrt());
        Some(self.lumas.iter().map(of_pixel).collect())
    }

    /// The relative error, as `rel` of a measured run but that a pixel is judged by its own mean; none before every
    /// replicate has a sample, and none of a black picture.
    pub(super) fn error(&self) -> Option<f64> {
        let (scale, floor) = self.scale_and_floor()?;
        let of_pixel = |sums| relative_variance(sums, scale, floor);
        let n = self.lumas.len().max(1) as f64;
        Some((self.lumas.iter().map(of_pixel).sum::<f64>() / n).sqrt())
    }

    /// What makes means of sums, and what is added to squares of means, so that dark pixels do not count for all.
    fn scale_and_floor(&self) -> Option<(f64, f64)> {
        if !self.is_round() || self.counts[0] == 0 {
            return None;
        }
        let scale = 1.0 / f64::from(self.counts[0]);
        let n = self.lumas.len().max(1) as f64;
        let mean = self.lumas.iter().map(|sums| moments(sums, scale).0).sum::<f64>() / n;
        let floor = 1e-4 * mean * mean;
        (floor > 0.0).then_some((scale, floor))
    }
}

fn relative_variance(sums: &[f64; REPLICATES], scale: f64, floor: f64) -> f64 {
    let (mean, variance) = moments(sums, scale);
    variance / (mean * mean + floor)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn film(value: f64, samples: u32) -> Film {
        let mut film = Film::new([2, 1], Rect::whole([2, 1]));
        film.sums = vec![[value * f64::from(samples); 3]; 2];
        film.counts = vec![samples; 2];
        film
    }

    #[test]
    fn replicates_take_turns_and_share_their_rounds() {
        let mut sums = Sums::new([2, 1]).unwrap();
        for most in [1, 9, 9, 9, 1, 2, 2, 2, 100] {
            let (replicate, samples) = sums.next(most);
            sums.add(&film(1.0, samples.count()), replicate);
        }
        assert_eq!(sums.counts, [4, 2, 2, 2]);
    }

    #[test]
    fn no_round_is_larger_than_all_before_it_or_leaves_its_batch() {
        let mut sums = Sums::new([2, 1]).unwrap();
        let mut ends = Vec::new();
        while sums.samples() < 4 * 4 * BATCH {
            let (replicate, samples) = sums.next(u32::MAX);
            assert_eq!(samples.start / BATCH, (samples.end - 1) / BATCH);
            sums.add(&film(1.0, samples.count()), replicate);
            ends.extend((replicate == 3).then_some(samples.end));
        }
        let doubled = (0..).map(|i| 1 << i).take_while(|end| *end < BATCH);
        assert_eq!(ends, doubled.chain((1..=4).map(|i| i * BATCH)).collect::<Vec<_>>());
    }

    #[test]
    fn the_spread_of_the_replicates_is_the_error() {
        let mut sums = Sums::new([2, 1]).unwrap();
        for (replicate, value) in [(0, 1.0), (1, 1.0), (2, 3.0), (3, 3.0)] {
            assert_eq!(sums.error(), None);
            sums.add(&film(value, 1), replicate);
        }
        // Deviations of 1 from a mean of 2: a variance of 4 / (4 * 3).
        let expected = (1.0 / 3.0 / (4.0 + 4e-4_f64)).sqrt();
        assert!(sums.error().is_some_and(|error| (error - expected).abs() < 1e-12));
        assert_eq!(sums.errors(), Some(vec![single(expected); 2]));
        let two = f16::from_f64(2.0).to_le_bytes();
        assert_eq!(sums.bytes(), [two; 6].concat());
    }
}

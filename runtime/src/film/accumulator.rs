//! Tiles in any order → whole batches, added to the film in ascending order.
//!
//! Holds the batches that are not complete. It does not know who renders tiles.

use super::{BadSample, Counters, Film, Lumas};
use crate::region::{Rect, SampleRange, insert_range};
use crate::replicate::{REPLICATES, REPLICATES_U32, luminance, moments};
use crate::schedule::WorkItem;
use crate::zeros::{NoMemory, zeros};
use pack::abi::FilmPixel;
use std::collections::BTreeMap;

mod so_far;

/// One batch on its way into the film: `f32` sums of the whole region.
struct Plane {
    samples: SampleRange,
    sums: Vec<[f32; 3]>,
    /// Tiles that arrived.
    done: Vec<Rect>,
    /// Pixels of the pass.
    pixels: u64,
    /// Those that have neither arrived nor failed.
    left: u64,
    counters: Counters,
    /// `Counters::removed` in units of `REMOVED`: whole numbers, so that the sum does not depend on the tiles.
    removed: u128,
}

/// Collects tiles in any order and adds whole batches to the film in ascending order.
pub(crate) struct Accumulator {
    film: Film,
    /// By first sample and replicate.
    open: BTreeMap<(u32, u32), Plane>,
    /// Sums of planes that were added, to be used again.
    spare: Vec<Vec<[f32; 3]>>,
    /// Sums of luminance of each replicate; empty where there is only one.
    lumas: Vec<[f64; REPLICATES]>,
    /// Samples behind each of them.
    per_replicate: u32,
    /// Batches that may be open at once.
    most_open: usize,
}

/// Luminance that is as good as none: 2^-40.
const REMOVED: f64 = 1.0 / (1_u64 << 40) as f64;

/// Luminance in units of `REMOVED`. All that `f32` holds fits, but for the largest, which are cut off.
fn units(luminance: f32) -> u128 {
    #[expect(clippy::cast_possible_truncation, reason = "saturates on purpose")]
    let units = (f64::from(luminance) / REMOVED) as u128;
    units
}

/// Bytes of open batches, unless a single round of batches takes more: a block that hangs must not make
/// the others fill the memory with batches that never end.
const MOST_OPEN: usize = 1 << 28;

impl Accumulator {
    /// With room for a first batch.
    pub(crate) fn new(film: Film) -> Result<Self, NoMemory> {
        Self::with(film, Vec::new(), 1)
    }

    /// Keeps the replicates apart too, and adds whole rounds of them only.
    pub(crate) fn in_rounds(film: Film) -> Result<Self, NoMemory> {
        let lumas = zeros(film.region.pixels())?;
        Self::with(film, lumas, REPLICATES)
    }

    fn with(film: Film, lumas: Vec<[f64; REPLICATES]>, first: usize) -> Result<Self, NoMemory> {
        let n = film.region.pixels();
        let spare = (0..first).map(|_| zeros(n)).collect::<Result<_, _>>()?;
        let each = film.sums.len() * size_of::<[f32; 3]>();
        let most_open = (MOST_OPEN / each.max(1)).max(first);
        Ok(Self { film, open: BTreeMap::new(), spare, lumas, per_replicate: 0, most_open })
    }

    /// What is complete, and nothing of it stays here.
    pub(crate) fn take(&mut self) -> Self {
        let Film { image_size, region, .. } = self.film;
        let film = Film::without_pixels(image_size, region);
        let nothing = Self {
            film,
            open: BTreeMap::new(),
            spare: Vec::new(),
            lumas: Vec::new(),
            per_replicate: 0,
            most_open: 0,
        };
        std::mem::replace(self, nothing)
    }

    /// Whether another batch may be opened now; otherwise when one that is open has ended.
    pub(crate) fn has_room(&mut self) -> bool {
        if self.spare.is_empty() && self.open.len() < self.most_open {
            self.spare.extend(zeros(self.film.region.pixels()));
        }
        !self.spare.is_empty()
    }

    /// Sums of luminance of each replicate, and the samples behind each sum.
    pub(crate) fn lumas(&self) -> Lumas<'_> {
        Lumas { sums: &self.lumas, samples: self.per_replicate, counts: &self.film.counts }
    }

    fn replicates(&self) -> usize {
        if self.lumas.is_empty() { 1 } else { REPLICATES }
    }

    /// What is complete so far.
    pub(crate) fn film(&self) -> &Film {
        &self.film
    }

    /// Announces a batch of so many pixels, for which there `has_room`. Batches must be announced in ascending order,
    /// before their first tile.
    pub(crate) fn open(&mut self, samples: SampleRange, replicate: u32, pixels: u64) {
        let sums = self.spare.pop().expect("whoever opens a batch has asked for room");
        let left = pixels;
        let (done, counters) = (Vec::new(), Counters::default());
        let plane = Plane { samples, sums, done, pixels, left, counters, removed: 0 };
        self.open.insert((samples.start, replicate), plane);
    }

    /// Takes a tile of an open batch, row by row.
    pub(crate) fn deposit(&mut self, item: &WorkItem, pixels: &[FilmPixel]) {
        let WorkItem { tile, samples, replicate, .. } = *item;
        let region_w = self.film.region.w as usize;
        let mut at = self.film.index(tile.x, tile.y);
        let plane = self.open.get_mut(&(samples.start, replicate));
        let plane = plane.expect("tiles belong to open batches");
        for (row, y) in pixels.chunks_exact(tile.w as usize).zip(tile.y..) {
            for (pixel, x) in row.iter().zip(tile.x..) {
                let bad = BadSample { x, y, sample: samples.start + pixel.first_bad() };
                plane.counters.rays += u64::from(pixel.rays);
                plane.counters.depth = plane.counters.depth.max(pixel.depth);
                plane.counters.overflows += u64::from(pixel.stack_errors & 0xffff);
                plane.counters.leaks += u64::from(pixel.stack_errors >> 16);
                // Hardly any has lost something, and units are slow.
                if pixel.removed > 0.0 {
                    plane.removed = plane.removed.saturating_add(units(pixel.removed));
                }
                if pixel.n_bad() > 0 {
                    plane.counters.bad += u64::from(pixel.n_bad());
                    let first = plane.counters.first_bad;
                    if first.is_none_or(|first| (y, x) < (first.y, first.x)) {
                        plane.counters.first_bad = Some(bad);
                    }
                }
            }
            for (sum, pixel) in plane.sums[at..at + row.len()].iter_mut().zip(row) {
                *sum = pixel.sum;
            }
            at += region_w;
        }
        plane.done.push(tile);
        plane.left -= tile.pixels();
        self.add_complete();
    }

    /// Gives a tile of an open batch up: its pixels keep the samples they have.
    pub(crate) fn give_up(&mut self, item: &WorkItem) {
        let plane = self.open.get_mut(&(item.samples.start, item.replicate));
        plane.expect("tiles belong to open batches").left -= item.tile.pixels();
        self.add_complete();
    }

    fn add_complete(&mut self) {
        if self.replicates() > 1 {
            return self.add_rounds();
        }
        while self.open.first_key_value().is_some_and(|(_, plane)| plane.left == 0) {
            if let Some((_, plane)) = self.open.pop_first() {
                self.add(plane, 0);
            }
        }
    }

    /// A round with a tile that was given up never becomes whole.
    fn add_rounds(&mut self) {
        let is_whole = |plane: &Plane| {
            plane.pixels == plane.done.iter().map(|tile| tile.pixels()).sum::<u64>()
        };
        while let Some((&(start, _), plane)) = self.open.first_key_value() {
            let count = plane.samples.count();
            let round = self.open.range((start, 0)..(start, REPLICATES_U32));
            if round.filter(|(_, plane)| is_whole(plane)).count() < REPLICATES {
                return;
            }
            for replicate in 0..REPLICATES {
                if let Some((_, plane)) = self.open.pop_first() {
                    self.add(plane, replicate);
                }
            }
            self.per_replicate += count;
        }
    }

    fn add(&mut self, plane: Plane, replicate: usize) {
        if !self.lumas.is_empty() {
            self.add_lumas(&plane, replicate);
        }
        plane.add_to(&mut self.film);
        let removed = plane.removed as f64 * REMOVED;
        self.film.counters.add(&Counters { removed, ..plane.counters });
        // That of the first replicate stands for all.
        insert_range(&mut self.film.ranges, plane.samples);
        self.spare.push(plane.sums);
    }

    fn add_lumas(&mut self, plane: &Plane, replicate: usize) {
        for tile in &plane.done {
            for y in tile.y..tile.y + tile.h {
                let at = self.film.index(tile.x, y);
                let row = at..at + tile.w as usize;
                for (lumas, sum) in self.lumas[row.clone()].iter_mut().zip(&plane.sums[row]) {
                    lumas[replicate] += luminance(sum.map(f64::from));
                }
            }
        }
    }

    /// The film with every complete batch. A run that ended inside its first batch leaves the tiles
    /// of that batch that arrived: better than nothing, and marked by uneven counts.
    pub(crate) fn finish(mut self) -> Film {
        if self.replicates() > 1 {
            let (sums, scale) = self.lumas().means();
            let variance = sums.iter().map(|sums| moments(sums, scale).1).collect();
            self.film.variance = variance;
            return self.film;
        }
        if self.film.ranges.is_empty()
            && let Some((_, plane)) = self.open.pop_first()
            && !plane.done.is_empty()
        {
            self.add(plane, 0);
        }
        self.film
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const REGION: Rect = Rect { x: 2, y: 1, w: 16, h: 8 };

    fn range(start: u32, end: u32) -> SampleRange {
        SampleRange::new(start, end).unwrap()
    }

    fn tile(rect: Rect, samples: SampleRange) -> Vec<FilmPixel> {
        let pixel = |x: u32, y: u32| FilmPixel {
            sum: [1.0 / (1.0 + x as f32), 1e-3 * y as f32, (samples.start + 1) as f32 / 3.0],
            rays: 3,
            ..FilmPixel::default()
        };
        (rect.y..rect.y + rect.h)
            .flat_map(|y| (rect.x..rect.x + rect.w).map(move |x| pixel(x, y)))
            .collect()
    }

    fn item(samples: SampleRange, tile: Rect) -> WorkItem {
        WorkItem { tile, samples, replicate: 0, probe: false }
    }

    fn halves() -> [Rect; 2] {
        let (a, b) = REGION.halves().unwrap();
        [a, b]
    }

    #[test]
    fn the_order_of_tiles_does_not_change_the_film() {
        let batches: Vec<_> = range(0, 64).batches().collect();
        let run = |order: &[usize]| {
            let mut sum = Accumulator::new(Film::new([20, 10], REGION)).unwrap();
            for batch in &batches {
                assert!(sum.has_room());
                sum.open(*batch, 0, REGION.pixels());
            }
            for &i in order {
                let (batch, rect) = (batches[i / 2], halves()[i % 2]);
                sum.deposit(&item(batch, rect), &tile(rect, batch));
            }
            sum.finish()
        };
        let film = run(&[0, 1, 2, 3, 4, 5, 6, 7]);
        assert_eq!(film, run(&[7, 6, 5, 4, 3, 2, 1, 0]));
        assert_eq!(film, run(&[3, 1, 5, 7, 0, 2, 6, 4]));
        assert_eq!((film.samples(), film.counters.rays), ((64, 64), 4 * 128 * 3));
        assert_eq!(film.ranges, [range(0, 64)]);
    }

    #[test]
    fn an_unfinished_batch_is_left_out() {
        let mut sum = Accumulator::new(Film::new([20, 10], REGION)).unwrap();
        for batch in range(0, 32).batches() {
            assert!(sum.has_room());
            sum.open(batch, 0, REGION.pixels());
        }
        sum.deposit(&item(range(0, 16), REGION), &tile(REGION, range(0, 16)));
        sum.deposit(&item(range(16, 32), halves()[0]), &tile(halves()[0], range(16, 32)));
        let film = sum.finish();
        assert_eq!((film.samples(), film.is_even()), ((16, 16), true));
    }

    #[test]
    fn tiles_of_a_first_batch_that_never_ended_are_kept_and_marked() {
        let mut sum = Accumulator::new(Film::new([20, 10], REGION)).unwrap();
        sum.open(range(0, 16), 0, REGION.pixels());
        sum.deposit(&item(range(0, 16), halves()[1]), &tile(halves()[1], range(0, 16)));
        let film = sum.finish();
        assert_eq!((film.samples(), film.is_even()), ((0, 16), false));
        assert!(film.mean(0).iter().all(|x| *x == 0.0));
    }

    #[test]
    fn a_given_up_tile_does_not_hold_the_others_back() {
        let mut sum = Accumulator::new(Film::new([20, 10], REGION)).unwrap();
        sum.open(range(0, 16), 0, REGION.pixels());
        sum.give_up(&item(range(0, 16), halves()[0]));
        sum.deposit(&item(range(0, 16), halves()[1]), &tile(halves()[1], range(0, 16)));
        assert_eq!(sum.film().samples(), (0, 16));
    }

    #[test]
    fn the_first_bad_sample_is_the_topmost_of_the_earliest_batch() {
        let run = |order: [usize; 2]| {
            let mut sum = Accumulator::new(Film::new([20, 10], REGION)).unwrap();
            sum.open(range(0, 16), 0, REGION.pixels());
            for i in order {
                let mut pixels = tile(halves()[i], range(0, 16));
                pixels[9].bad = (5 << 16) | 2;
                sum.deposit(&item(range(0, 16), halves()[i]), &pixels);
            }
            sum.finish().counters
        };
        let counters = run([0, 1]);
        assert_eq!(counters, run([1, 0]));
        assert_eq!(counters.bad, 4);
        assert_eq!(counters.first_bad, Some(BadSample { x: 3, y: 2, sample: 5 }));
    }

    #[test]
    fn batches_that_do_not_end_are_not_joined_by_ever_more() {
        let side = 1 << 13;
        let film = Film::new([side; 2], Rect::whole([side; 2]));
        // 805 MB a batch, of which the memory is not touched.
        let mut sum = Accumulator::new(film).unwrap();
        assert!(sum.has_room());
        sum.open(range(0, 16), 0, 1);
        assert!(!sum.has_room());
        let mut small = Accumulator::new(Film::new([20, 10], REGION)).unwrap();
        for batch in range(0, 16 * 99).batches() {
            assert!(small.has_room());
            small.open(batch, 0, REGION.pixels());
        }
    }

    #[test]
    fn only_whole_rounds_of_replicates_count() {
        let mut sum = Accumulator::in_rounds(Film::new([20, 10], REGION)).unwrap();
        for (samples, last) in [(range(0, 1), 4), (range(1, 2), 3)] {
            for replicate in 0..4 {
                assert!(sum.has_room());
                sum.open(samples, replicate, REGION.pixels());
            }
            for replicate in 0..last {
                let mut pixels = tile(REGION, samples);
                for pixel in &mut pixels {
                    pixel.sum = [replicate as f32; 3];
                }
                sum.deposit(&WorkItem { replicate, ..item(samples, REGION) }, &pixels);
            }
        }
        assert_eq!(sum.lumas().samples, 1);
        let film = sum.finish();
        assert_eq!((film.samples(), film.replicates()), ((4, 4), 4));
        assert_eq!(film.ranges, [range(0, 1)]);
        // 0, 1, 2, 3: mean 1.5, squares of the deviations 5, over 4 times 3.
        assert_eq!(film.mean(0).map(f64::to_bits), [1.5_f64.to_bits(); 3]);
        assert!((film.variance[5] - 5.0 / 12.0).abs() < 1e-12);
    }
}

//! Which pixels and which samples: rectangles, sample ranges, canonical batches, tiles.
//!
//! Pure arithmetic. It keeps the rule on which every reproducible picture rests: a unit of
//! accumulation never crosses a multiple of `BATCH`.

use pack::abi::BATCH;
use std::fmt;
use std::ops::Range;

/// Pixels `x .. x + w`, `y .. y + h`; origin top left.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct Rect {
    /// First column.
    pub x: u32,
    /// First row.
    pub y: u32,
    /// Columns.
    pub w: u32,
    /// Rows.
    pub h: u32,
}

impl Rect {
    /// The whole of an image.
    #[must_use]
    pub fn whole(size: [u32; 2]) -> Self {
        Self { x: 0, y: 0, w: size[0], h: size[1] }
    }

    /// Number of pixels.
    #[must_use]
    pub fn pixels(self) -> u64 {
        u64::from(self.w) * u64::from(self.h)
    }

    /// Whether it has at least one pixel and lies inside an image of `size`.
    #[must_use]
    pub fn fits(self, size: [u32; 2]) -> bool {
        let end = |from: u32, len: u32| u64::from(from) + u64::from(len);
        self.w > 0
            && self.h > 0
            && end(self.x, self.w) <= u64::from(size[0])
            && end(self.y, self.h) <= u64::from(size[1])
    }

    /// Some of its rows, counted from its first.
    #[must_use]
    pub(crate) fn rows(self, rows: &Range<u32>) -> Self {
        Self { y: self.y + rows.start, h: rows.end - rows.start, ..self }
    }

    /// Two parts along the longer side, cut at a multiple of 8 pixels; `None` at 8 × 8 or less.
    #[must_use]
    pub fn halves(self) -> Option<(Self, Self)> {
        let cut = |len: u32| (len / 2).next_multiple_of(8);
        if self.w >= self.h && self.w > 8 {
            let w = cut(self.w);
            return Some((Self { w, ..self }, Self { x: self.x + w, w: self.w - w, ..self }));
        }
        if self.h > 8 {
            let h = cut(self.h);
            return Some((Self { h, ..self }, Self { y: self.y + h, h: self.h - h, ..self }));
        }
        None
    }
}

impl fmt::Display for Rect {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{},{},{},{}", self.x, self.y, self.w, self.h)
    }
}

/// Sample indices `start .. end` of every pixel; never empty.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct SampleRange {
    /// First sample index.
    pub start: u32,
    /// One past the last.
    pub end: u32,
}

impl SampleRange {
    /// The range, or `None` when it is empty or turned round.
    #[must_use]
    pub fn new(start: u32, end: u32) -> Option<Self> {
        (start < end).then_some(Self { start, end })
    }

    /// Number of samples.
    #[must_use]
    pub fn count(self) -> u32 {
        self.end - self.start
    }

    /// The part of the range inside the canonical batch that its first sample belongs to.
    #[must_use]
    pub fn first_batch(self) -> Self {
        let batch_end = u64::from(self.start / BATCH + 1) * u64::from(BATCH);
        let end = u32::try_from(batch_end).map_or(self.end, |end| end.min(self.end));
        Self { start: self.start, end }
    }

    /// What follows `part`, which must begin where the range begins.
    #[must_use]
    pub fn after(self, part: Self) -> Option<Self> {
        Self::new(part.end, self.end)
    }

    /// The range cut at every multiple of `BATCH`, ascending.
    pub fn batches(self) -> impl Iterator<Item = Self> {
        let mut rest = Some(self);
        std::iter::from_fn(move || {
            let batch = rest?.first_batch();
            rest = rest?.after(batch);
            Some(batch)
        })
    }

    /// Whether both contain a common index.
    #[must_use]
    pub fn overlaps(self, other: Self) -> bool {
        self.start < other.end && other.start < self.end
    }
}

impl fmt::Display for SampleRange {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}..{}", self.start, self.end)
    }
}

/// Adds `range` to a sorted list of disjoint ranges, joining neighbours. False, and no change,
/// when it overlaps one of them.
pub(crate) fn insert_range(list: &mut Vec<SampleRange>, range: SampleRange) -> bool {
    if list.iter().any(|r| r.overlaps(range)) {
        return false;
    }
    let at = list.partition_point(|r| r.start < range.start);
    list.insert(at, range);
    list.dedup_by(|next, previous| {
        let joins = previous.end == next.start;
        if joins {
            previous.end = next.end;
        }
        joins
    });
    true
}

/// Walks a region in tiles, band by band, with a tile size that may change from tile to tile.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Tiler {
    region: Rect,
    x: u32,
    y: u32,
    band: u32,
}

impl Tiler {
    pub(crate) fn new(region: Rect) -> Self {
        Self { region, x: 0, y: 0, band: 0 }
    }

    /// The next tile, of about `pixels` pixels, as square as the region allows; sides are multiples
    /// of 8 except at the region's edges.
    pub(crate) fn next(&mut self, pixels: u64) -> Option<Rect> {
        let Rect { x, y, w, h } = self.region;
        if self.y >= h {
            return None;
        }
        let eights = |n: u64| u32::try_from(n / 8 * 8).unwrap_or(u32::MAX - 7).max(8);
        if self.x == 0 {
            self.band = eights(pixels.isqrt()).min(h);
        }
        let width = eights(pixels / u64::from(self.band)).min(w - self.x);
        let height = self.band.min(h - self.y);
        let tile = Rect { x: x + self.x, y: y + self.y, w: width, h: height };
        self.x += width;
        if self.x >= w {
            self.x = 0;
            self.y += self.band;
        }
        Some(tile)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn range(start: u32, end: u32) -> SampleRange {
        SampleRange::new(start, end).unwrap()
    }

    #[test]
    fn batches_cover_the_range_and_stay_inside_multiples_of_sixteen() {
        for (start, end) in [(0, 1), (0, 16), (0, 64), (5, 64), (5, 9), (15, 17), (31, 100)] {
            let batches: Vec<_> = range(start, end).batches().collect();
            assert_eq!(batches[0].start, start);
            assert_eq!(batches.last().unwrap().end, end);
            assert!(batches.windows(2).all(|pair| pair[0].end == pair[1].start));
            assert!(batches.iter().all(|b| b.start / BATCH == (b.end - 1) / BATCH));
        }
    }

    #[test]
    fn the_last_batch_may_end_at_the_largest_index() {
        let batches: Vec<_> = range(u32::MAX - 20, u32::MAX).batches().collect();
        assert_eq!(batches.last().unwrap().end, u32::MAX);
        assert_eq!(batches.iter().map(|b| b.count()).sum::<u32>(), 20);
    }

    #[test]
    fn ranges_join_and_refuse_overlaps() {
        let mut list = Vec::new();
        assert!(insert_range(&mut list, range(32, 64)));
        assert!(insert_range(&mut list, range(0, 16)));
        assert!(!insert_range(&mut list, range(10, 20)));
        assert_eq!(list, [range(0, 16), range(32, 64)]);
        assert!(insert_range(&mut list, range(16, 32)));
        assert_eq!(list, [range(0, 64)]);
    }

    #[test]
    fn tiles_cover_every_pixel_once_whatever_their_size() {
        let region = Rect { x: 3, y: 5, w: 101, h: 67 };
        for sizes in [&[1024_u64][..], &[64, 64, 4096, 100, 1 << 40], &[1]] {
            let mut seen = vec![0_u8; 101 * 67];
            let (mut tiler, mut n) = (Tiler::new(region), 0);
            while let Some(tile) = tiler.next(sizes[n % sizes.len()]) {
                n += 1;
                for y in tile.y..tile.y + tile.h {
                    for x in tile.x..tile.x + tile.w {
                        seen[((y - 5) * 101 + (x - 3)) as usize] += 1;
                    }
                }
            }
            assert!(seen.iter().all(|&count| count == 1), "{sizes:?}");
        }
    }

    #[test]
    fn tiles_of_1024_pixels_are_32_by_32_up_to_the_edges() {
        let mut tiler = Tiler::new(Rect { x: 0, y: 0, w: 72, h: 40 });
        let sizes: Vec<_> =
            std::iter::from_fn(|| tiler.next(1024)).map(|tile| (tile.w, tile.h)).collect();
        assert_eq!(sizes, [(32, 32), (32, 32), (8, 32), (32, 8), (32, 8), (8, 8)]);
        // A thin region gets long tiles instead of small ones.
        let thin = Tiler::new(Rect { x: 0, y: 0, w: 4096, h: 4 }).next(1024);
        assert_eq!(thin.map(|tile| (tile.w, tile.h)), Some((256, 4)));
    }

    #[test]
    fn halves_of_a_tile_are_the_tile() {
        let tile = Rect { x: 8, y: 16, w: 100, h: 40 };
        let (a, b) = tile.halves().unwrap();
        assert_eq!(a.pixels() + b.pixels(), tile.pixels());
        assert_eq!((a.x, a.w % 8, b.x), (8, 0, 8 + a.w));
        assert!(Rect { x: 0, y: 0, w: 8, h: 8 }.halves().is_none());
        assert!(Rect { x: 0, y: 0, w: 9, h: 3 }.halves().is_some());
    }

    #[test]
    fn fits_survives_extreme_numbers() {
        let size = [640, 360];
        assert!(Rect::whole(size).fits(size));
        assert!(!Rect { x: u32::MAX, y: 0, w: u32::MAX, h: 1 }.fits(size));
        assert!(!Rect { x: 0, y: 0, w: 0, h: 1 }.fits(size));
    }
}

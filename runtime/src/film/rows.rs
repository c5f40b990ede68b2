//! Rows of a film, and crops that are put in their place.

use super::Film;
use crate::plane::{pixels, place};
use std::ops::Range;

impl Film {
    /// Some rows of the region, counted from its first; a film that was written row by row.
    pub(crate) fn rows(&self, rows: &Range<u32>) -> Self {
        let region = self.region.rows(rows);
        let at = pixels(self.region.w, rows);
        let variance = self.variance.get(at.clone()).unwrap_or_default();
        Self {
            ranges: self.ranges.clone(),
            counters: self.counters,
            sums: self.sums[at.clone()].to_vec(),
            counts: self.counts[at].to_vec(),
            variance: variance.to_vec(),
            ..Self::without_pixels(self.image_size, region)
        }
    }

    /// Takes the pixels of a film whose region lies inside of this one's.
    pub(crate) fn place(&mut self, part: &Self) {
        place((&mut self.sums, self.region), (&part.sums, part.region));
        place((&mut self.counts, self.region), (&part.counts, part.region));
        place((&mut self.variance, self.region), (&part.variance, part.region));
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::region::Rect;

    #[test]
    fn rows_of_crops_come_together_where_they_were() {
        let size = [5, 4];
        let mut whole = Film::new(size, Rect { x: 1, y: 1, w: 4, h: 3 });
        for (i, (sum, count)) in (1..).zip(whole.sums.iter_mut().zip(&mut whole.counts)) {
            (*sum, *count) = ([f64::from(i); 3], i);
        }
        let mut again = Film::new(size, whole.region);
        for rows in [2..3, 0..2] {
            let part = whole.rows(&rows);
            assert_eq!(
                part.region,
                Rect { x: 1, y: 1 + rows.start, w: 4, h: rows.end - rows.start }
            );
            again.place(&part);
        }
        assert_eq!(again, whole);
        let corner = Film {
            sums: vec![[9.0; 3]],
            counts: vec![9],
            ..Film::without_pixels(size, Rect { x: 4, y: 3, w: 1, h: 1 })
        };
        again.place(&corner);
        assert_eq!((again.counts[11], again.counts[10], again.sums[11]), (9, 11, [9.0; 3]));
    }
}

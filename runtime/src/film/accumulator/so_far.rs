//! What has arrived of a picture, whole batches or not → a film to look at.
//!
//! Its pixels have different numbers of samples, so nobody takes it for a part of a picture: `merge` refuses it.

use super::{Accumulator, Plane};
use crate::film::Film;
use crate::zeros::NoMemory;

impl Accumulator {
    /// A copy of the film with every tile that has arrived. A pixel without samples shows its own of `stand_in`, where
    /// there is one, and counts none.
    pub(crate) fn so_far(&self, stand_in: Option<&[[f64; 3]]>) -> Result<Film, NoMemory> {
        let mut film = self.film.try_clone()?;
        self.open.values().for_each(|plane| plane.add_to(&mut film));
        let pixels = film.sums.iter_mut().zip(&film.counts).zip(stand_in.unwrap_or_default());
        for ((sum, _), radiance) in pixels.filter(|((_, count), _)| **count == 0) {
            *sum = *radiance;
        }
        Ok(film)
    }
}

impl Plane {
    /// Adds the tiles that arrived, as sums and counts.
    pub(super) fn add_to(&self, film: &mut Film) {
        let width = film.region.w as usize;
        for tile in &self.done {
            let first = film.index(tile.x, tile.y);
            for at in (0..tile.h as usize).map(|row| first + row * width) {
                let row = at..at + tile.w as usize;
                let sums = film.sums[row.clone()].iter_mut().zip(&self.sums[row.clone()]);
                for (sum, batch) in sums {
                    for (sum, batch) in sum.iter_mut().zip(batch) {
                        *sum += f64::from(*batch);
                    }
                }
                for count in &mut film.counts[row] {
                    *count += self.samples.count();
                }
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::region::{Rect, SampleRange};
    use crate::schedule::WorkItem;
    use pack::abi::FilmPixel;

    #[test]
    fn tiles_that_arrived_count_and_the_others_show_what_stands_in() {
        let region = Rect::whole([16, 8]);
        let mut sum = Accumulator::new(Film::new([16, 8], region)).unwrap();
        let (tile, _) = region.halves().unwrap();
        for (start, value) in [(0, 16.0), (16, 48.0)] {
            let samples = SampleRange { start, end: start + 16 };
            assert!(sum.has_room());
            sum.open(samples, 0, region.pixels());
            let pixel = FilmPixel { sum: [value; 3], ..FilmPixel::default() };
            let item = WorkItem { tile, samples, replicate: 0, probe: false };
            sum.deposit(&item, &[pixel; 64]);
        }
        let film = sum.so_far(Some(&[[9.0; 3]; 128])).unwrap();
        assert_eq!([film.mean(0), film.mean(15)], [[2.0; 3], [9.0; 3]]);
        assert_eq!((film.samples(), film.ranges.len()), ((0, 32), 0));
        assert!(sum.so_far(None).unwrap().mean(15).iter().all(|x| *x == 0.0));
        assert_eq!(sum.film().samples(), (0, 0));
    }
}

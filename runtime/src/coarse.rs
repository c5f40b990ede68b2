//! Scene + job → a coarse picture of it: one sample for each block of pixels, so that there is something to see at once.
//!
//! It costs at most 1/256 of a first batch and no sample of the picture depends on it. It does not know files.

use crate::cpu;
use crate::film::Film;
use crate::job::{CpuWay, Job, Precision};
use crate::layers::Wanted;
use crate::preview::Coarse;
use crate::region::{Rect, SampleRange};
use crate::run::{Framing, Run};
use crate::scene::Scene;
use crate::signals::Signals;

/// Least side of a block, pixels.
const LEAST: u32 = 4;
/// Most blocks: they take a third of a second of one core where paths are long.
const MOST: u64 = 1 << 13;

/// Renders it on the CPU, whatever renders the picture; `None` when `signals` break it off, or it cannot be rendered, of
/// which the run will tell.
pub(crate) fn coarse(scene: &Scene, job: &Job, signals: &Signals) -> Option<Coarse> {
    let block = block(job.crop.pixels());
    let small = small(scene, job, block);
    let run = Run::new(&small, signals, None, Framing::default()).ok()?;
    cpu::render(&scene.setup(&small), &small, &run).ok()?;
    let film = run.shared().take()?.film;
    let is_whole = film.samples() == (1, 1);
    let film = if is_whole { stretched(&film, job) } else { None };
    film.map(|film| Coarse { block, film })
}

/// Side of the blocks of so many pixels.
fn block(pixels: u64) -> u32 {
    let side = pixels.div_ceil(MOST).isqrt();
    let side = if side * side * MOST < pixels { side + 1 } else { side };
    u32::try_from(side).unwrap_or(u32::MAX).max(LEAST)
}

/// A sample of each pixel of an image that has a pixel for each block.
fn small(scene: &Scene, job: &Job, block: u32) -> Job {
    let size = job.image_size.map(|side| side.div_ceil(block));
    let Rect { x, y, w, h } = job.crop;
    let ([left, top], [right, bottom]) = (
        at([x, y], job.image_size, size),
        at([x + w.saturating_sub(1), y + h.saturating_sub(1)], job.image_size, size),
    );
    let start = job.samples.start;
    Job {
        image_size: size,
        crop: Rect { x: left, y: top, w: right - left + 1, h: bottom - top + 1 },
        samples: SampleRange { start, end: start.saturating_add(1) },
        precision: Precision::F32,
        // It does not wait for the tree that the picture walks.
        way: CpuWay {
            by_hand: job.way.by_hand && scene.finished_tree(job.way.width()).is_some(),
            ..job.way
        },
        time_limit: None,
        measure: None,
        strict: false,
        wanted: Wanted::default(),
        ..job.clone()
    }
}

/// The pixel of an image of `to` that is where `pixel` is in one of `from`.
fn at(pixel: [u32; 2], from: [u32; 2], to: [u32; 2]) -> [u32; 2] {
    [0, 1].map(|axis| {
        let [pixel, from, to] = [pixel[axis], from[axis], to[axis]].map(u64::from);
        let middle = (2 * pixel + 1) * to / (2 * from.max(1));
        u32::try_from(middle.min(to.saturating_sub(1))).unwrap_or(0)
    })
}

/// A film of the job without samples, where each pixel shows that of the small film which stands for it.
fn stretched(small: &Film, job: &Job) -> Option<Film> {
    let mut film = Film::try_new(job.image_size, job.crop).ok()?;
    let pixels = (job.crop.y..job.crop.y + job.crop.h)
        .flat_map(|y| (job.crop.x..job.crop.x + job.crop.w).map(move |x| [x, y]));
    for (sum, pixel) in film.sums.iter_mut().zip(pixels) {
        let [x, y] = at(pixel, job.image_size, small.image_size);
        *sum = small.mean(small.index(x, y));
    }
    Some(film)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn there_are_few_blocks_and_none_is_small() {
        assert_eq!([1, 72 * 40, 16 * MOST, 16 * MOST + 1].map(block), [4, 4, 4, 5]);
        assert_eq!([640 * 360, 1920 * 1080, crate::job::MAX_PIXELS].map(block), [6, 16, 182]);
    }

    #[test]
    fn every_pixel_lies_in_a_block_of_the_coarse_image() {
        for (from, to) in [([9, 5], [3, 2]), ([640, 360], [160, 90]), ([1, 1], [1, 1])] {
            let all: Vec<_> = (0..from[0]).map(|x| at([x, 0], from, to)[0]).collect();
            assert!(all.is_sorted() && all.first() == Some(&0) && all.last() == Some(&(to[0] - 1)));
            assert!(all.windows(2).all(|pair| pair[1] - pair[0] <= 1), "{all:?}");
        }
    }
}

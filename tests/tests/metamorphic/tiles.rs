//! Tiles, threads and batches of the richest scene: the same bits, however the work is cut. The runtime's own
//! tests cut a scene of one material; here every feature might look at where its tile begins.

use runtime::{Film, Job, Rect, SampleRange};
use tests::features::{compiled, named};
use tests::picture;

use crate::compare::{assert_exact, pack_of};

/// Two batches and a half.
const SAMPLES: SampleRange = SampleRange { start: 0, end: 40 };

fn part(set: impl FnOnce(&mut Job)) -> Film {
    let outcome = picture::cpu(pack_of(&compiled(named("all"))), |job| {
        job.samples = SAMPLES;
        set(job);
    });
    outcome.film().clone()
}

#[test]
fn tiles_threads_and_batches_do_not_change_a_bit() {
    let whole = part(|job| job.threads = Some(2));
    let [width, height] = whole.image_size;

    // Three columns and two rows that are no multiples of anything.
    let mut stitched = Film::new(whole.image_size, whole.region);
    let (columns, rows) = ([0, 7, 12, width], [0, 19, height]);
    for y in rows.windows(2) {
        for x in columns.windows(2) {
            let crop = Rect { x: x[0], y: y[0], w: x[1] - x[0], h: y[1] - y[0] };
            let film = part(|job| (job.crop, job.threads) = (crop, Some(1)));
            for (i, row) in film.sums.chunks(crop.w as usize).enumerate() {
                let at = (crop.y as usize + i) * width as usize + crop.x as usize;
                stitched.sums[at..][..row.len()].copy_from_slice(row);
            }
            stitched.counters.add(&film.counters);
        }
    }
    assert_exact("tiles", &whole, &stitched, 1.0);

    // Batches are of sixteen samples; their sums are added in ascending order.
    let mut summed = Film::new(whole.image_size, whole.region);
    for range in SAMPLES.batches() {
        let film = part(|job| job.samples = range);
        for (sum, batch) in summed.sums.iter_mut().flatten().zip(film.sums.iter().flatten()) {
            *sum += batch;
        }
        summed.counters.add(&film.counters);
    }
    assert_exact("batches", &whole, &summed, 1.0);
}

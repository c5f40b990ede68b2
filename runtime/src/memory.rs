//! How much memory a film takes, and whether that much is free: before rendering, not in the middle of it.
//!
//! How much is free `pack::memory` says; where nothing is known, nothing is refused.

use crate::convergence::REPLICATES;
use crate::job::Job;
use thiserror::Error;

/// A film of which the size is told before it is made.
const LARGE: u64 = 1 << 30;
/// Bytes of a pixel: its sum and the number of its samples.
const KEPT: u64 = size_of::<[f64; 3]>() as u64 + size_of::<u32>() as u64;
/// Bytes of a pixel in a batch that is not complete, of which there is one of each replicate.
const BATCH: u64 = size_of::<[f32; 3]>() as u64;
/// More bytes of a pixel whose error is measured: luminances of the replicates, and their variance.
const MEASURED: u64 = (size_of::<f64>() * (REPLICATES + 1)) as u64;

/// A film that does not fit.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Error)]
#[error("a film of {pixels} pixels takes {} of memory while it is rendered, and {} are free: render less of it with --crop or --size", gigabytes(*need), gigabytes(*free))]
pub struct TooLarge {
    /// Pixels of the film.
    pub pixels: u64,
    /// Bytes that it takes.
    pub need: u64,
    /// Bytes that are free.
    pub free: u64,
}

/// Bytes of memory that the film of `job` takes while it is rendered; `saved`: with a copy of it that is written to
/// a checkpoint meanwhile.
#[must_use]
pub fn film_bytes(job: &Job, saved: bool) -> u64 {
    let pixel = match (job.measure.is_some(), saved) {
        (true, _) => KEPT + MEASURED + BATCH * REPLICATES as u64,
        (false, true) => 2 * KEPT + BATCH,
        (false, false) => KEPT + BATCH,
    };
    job.crop.pixels() * pixel
}

/// What is to be said of a film before it is made; nothing of one that most machines have room for.
///
/// # Errors
/// When it is large, and larger than what is `free`.
pub(crate) fn announce(
    job: &Job,
    saved: bool,
    free: Option<u64>,
) -> Result<Option<String>, TooLarge> {
    let (need, pixels) = (film_bytes(job, saved), job.crop.pixels());
    if need < LARGE {
        return Ok(None);
    }
    match free {
        Some(free) if need > free => Err(TooLarge { pixels, need, free }),
        _ => Ok(Some(format!("the film takes {} of memory while it is rendered", gigabytes(need)))),
    }
}

fn gigabytes(bytes: u64) -> String {
    format!("{:.1} GB", bytes as f64 / 1e9)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::convergence::Measure;
    use crate::region::{Rect, SampleRange};
    use std::time::Duration;

    fn job(side: u32, measure: Option<Measure>) -> Job {
        Job {
            image_size: [side; 2],
            crop: Rect::whole([side; 2]),
            samples: SampleRange { start: 0, end: 1 },
            seed: 0,
            estimator: 0,
            precision: crate::job::Precision::F32,
            native_walk: true,
            time_limit: None,
            threads: None,
            strict: false,
            submission: Duration::from_millis(100),
            measure,
        }
    }

    #[test]
    fn large_films_are_announced_and_those_that_do_not_fit_are_refused() {
        let large = job(16_384, None);
        assert_eq!(film_bytes(&large, false), 40 << 28);
        let said = announce(&large, false, Some(11 << 30)).expect("it fits");
        assert_eq!(said.as_deref(), Some("the film takes 10.7 GB of memory while it is rendered"));
        assert_eq!(
            announce(&large, false, None),
            Ok(said),
            "where nothing is known nothing is refused"
        );
        let error =
            announce(&large, false, Some(4_000_000_000)).expect_err("it does not fit").to_string();
        let expected = "a film of 268435456 pixels takes 10.7 GB of memory while it is rendered, and \
            4.0 GB are free: render less of it with --crop or --size";
        assert_eq!(error, expected);
        assert_eq!(film_bytes(&large, true), 68 << 28, "with its copy");
        // Four more numbers of double precision, their variance, and three more batches.
        assert_eq!(film_bytes(&job(1, Some(Measure::default())), true), 40 + 40 + 36);
        // Small ones are not worth a word, and are never refused; a crop counts by its own pixels.
        assert_eq!(announce(&job(1920, None), true, Some(1 << 20)), Ok(None));
        let part = Job { crop: Rect { x: 0, y: 0, w: 16, h: 16 }, ..large };
        assert_eq!(announce(&part, true, Some(1 << 20)), Ok(None));
    }
}

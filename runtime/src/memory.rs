//! How much memory a film takes, and whether that much is free: before rendering, not in the middle of it.
//!
//! Linux promises memory that it does not have and kills whoever uses it, so an allocation that succeeds says
//! nothing. It does say what is free, for the machine and for the group that a process is in. Elsewhere
//! nothing is known, and nothing is refused. A limit of the process (`ulimit -v`) is another matter: what does
//! not fit into that is refused however small it is.

use crate::job::Job;
use crate::replicate::REPLICATES;
use crate::zeros::{amount, zeros};
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
#[error("a film of {pixels} pixels takes {} of memory while it is rendered, and {} are free: render less of it with --crop or --size", amount(*need), amount(*free))]
pub struct TooLarge {
    /// Pixels of the film.
    pub pixels: u64,
    /// Bytes that it takes.
    pub need: u64,
    /// Bytes that are free.
    pub free: u64,
}

/// Bytes of memory that the film of `job` takes while it is rendered, in a scene of so many light groups; `saved`: with
/// a copy of it that is written to a checkpoint meanwhile.
#[must_use]
pub fn film_bytes(job: &Job, groups: u64, saved: bool) -> u64 {
    let pixel = match (job.measure.is_some(), saved) {
        (true, _) => KEPT + MEASURED + BATCH * REPLICATES as u64,
        (false, true) => 2 * KEPT + BATCH,
        (false, false) => KEPT + BATCH,
    };
    job.crop.pixels() * (pixel + job.wanted.bytes(groups))
}

/// Bytes of a pixel while it is written, at most: means, planes of an EXR with residuals, and the file.
const WRITTEN: u64 = 24 + 24 + 24 + 24;
/// Bytes of other things that a run needs.
const REST: u64 = 4 << 20;

/// What is free: on the machine, and of what this process may have.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Free {
    /// Bytes that this process can use without making others swap, where the system tells.
    machine: Option<u64>,
    /// Bytes that it may still ask for, where it is limited.
    limit: Option<u64>,
}

/// What is to be said of a film before it is made; nothing of one that most machines have room for.
///
/// # Errors
/// When it is large, and larger than what is free; when it does not fit into the limit of the process, be it while
/// it is rendered or while it is written.
pub(crate) fn announce(
    job: &Job,
    groups: u64,
    saved: bool,
    free: Free,
) -> Result<Option<String>, TooLarge> {
    let (need, pixels) = (film_bytes(job, groups, saved), job.crop.pixels());
    if let Some(free) = free.limit {
        let need = need.max(pixels * (KEPT + WRITTEN)) + REST;
        // What `malloc` has set aside for threads counts as used, and may hold it all the same.
        // The black box keeps an allocation that nobody uses from being left out.
        if need > free && std::hint::black_box(zeros::<u8>(need)).is_err() {
            return Err(TooLarge { pixels, need, free });
        }
    }
    let free = free.machine;
    if need < LARGE {
        return Ok(None);
    }
    match free {
        Some(free) if need > free => Err(TooLarge { pixels, need, free }),
        _ => Ok(Some(format!("the film takes {} of memory while it is rendered", amount(need)))),
    }
}

/// Whether there is room for a copy of a film of so many pixels and for writing it, beside all that is there.
pub(crate) fn has_room_to_write(pixels: u64) -> bool {
    let Free { machine, limit } = free();
    let need = pixels * (KEPT + WRITTEN) + REST;
    [machine, limit].into_iter().flatten().all(|free| need <= free)
}

/// What is free now.
pub(crate) fn free() -> Free {
    Free { machine: host::machine(), limit: host::room().map(|room| room.free) }
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
            camera: None,
            crop: Rect::whole([side; 2]),
            samples: SampleRange { start: 0, end: 1 },
            seed: 0,
            estimator: 0,
            clamp_indirect: None,
            precision: crate::job::Precision::F32,
            way: crate::job::CpuWay::default(),
            time_limit: None,
            threads: None,
            strict: false,
            submission: Duration::from_millis(100),
            timestamps: true,
            measure,
            wanted: crate::layers::Wanted::default(),
        }
    }

    #[test]
    fn large_films_are_announced_and_those_that_do_not_fit_are_refused() {
        let large = job(16_384, None);
        assert_eq!(film_bytes(&large, 0, false), 40 << 28);
        let free = |machine: u64| Free { machine: Some(machine), limit: None };
        let said = announce(&large, 0, false, free(11 << 30)).expect("it fits");
        assert_eq!(said.as_deref(), Some("the film takes 10.7 GB of memory while it is rendered"));
        assert_eq!(
            announce(&large, 0, false, Free::default()),
            Ok(said),
            "where nothing is known nothing is refused"
        );
        let error = announce(&large, 0, false, free(4_000_000_000))
            .expect_err("it does not fit")
            .to_string();
        let expected = "a film of 268435456 pixels takes 10.7 GB of memory while it is rendered, and \
            4.0 GB are free: render less of it with --crop or --size";
        assert_eq!(error, expected);
        assert_eq!(film_bytes(&large, 0, true), 68 << 28, "with its copy");
        // Four more numbers of double precision, their variance, and three more batches.
        assert_eq!(film_bytes(&job(1, Some(Measure::default())), 0, true), 40 + 40 + 36);
        // Small ones are not worth a word, and are never refused; a crop counts by its own pixels.
        assert_eq!(announce(&job(1920, None), 0, true, free(1 << 20)), Ok(None));
        let part = Job { crop: Rect { x: 0, y: 0, w: 16, h: 16 }, ..large };
        assert_eq!(announce(&part, 0, true, free(1 << 20)), Ok(None));
    }

    #[test]
    fn a_limit_of_the_process_is_never_passed_however_small_the_film() {
        let limited = |limit: u64| Free { machine: None, limit: Some(limit) };
        let job = job(1920, None);
        let most = 1920 * 1920 * (28 + 96) + (4 << 20);
        assert_eq!(announce(&job, 0, false, limited(most)), Ok(None));
        // Whether there is room all the same is tried out.
        assert_eq!(announce(&job, 0, false, limited(most - 1)), Ok(None));
        let vast = Job { crop: Rect::whole([1 << 24; 2]), ..job };
        let error = announce(&vast, 0, false, limited(most)).expect_err("no room").to_string();
        let end = "and 461 MB are free: render less of it with --crop or --size";
        assert!(error.ends_with(end), "{error}");
        assert!(zeros::<u64>(1 << 60).is_err() && zeros::<u64>(u64::MAX).is_err());
    }
}

//! How much to hand to the GPU at once: measured durations → sizes of tiles and submissions.
//!
//! A submission should take long enough to hide what it costs to make one, and short enough that
//! the desktop stays alive and no watchdog bites. Pure arithmetic, no device.

use std::time::{Duration, Instant};

/// Pixel samples of the first submission: about 64 × 64 pixels with a whole batch.
const FIRST: f64 = 65_536.0;
/// Fewest pixel samples: one workgroup with a whole batch.
const LEAST: f64 = 1024.0;
/// Most pixels of a tile; its film takes 8 MiB.
pub(super) const MAX_TILE: u64 = 512 * 512;
/// Tiles of a submission, once they are large enough: their tails overlap.
pub(super) const MAX_TILES: usize = 4;
/// A submission is cut into several tiles only above this many pixels each.
const MIN_SPLIT: f64 = 64.0 * 64.0;
/// No submission is planned to take longer, whatever was asked for.
const CAP: Duration = Duration::from_secs(1);
/// A submission grows at most by this factor over the one before.
const GROWTH: f64 = 4.0;

/// The controller.
pub(super) struct Pace {
    target: f64,
    /// Pixel samples of the next submission.
    cost: f64,
    /// Never more than this; shrinks when a device is lost.
    ceiling: f64,
}

impl Pace {
    pub(super) fn new(target: Duration) -> Self {
        let target = target.clamp(Duration::from_millis(1), CAP).as_secs_f64();
        Self { target, cost: FIRST, ceiling: f64::INFINITY }
    }

    /// Pixel samples that the next submission is to have.
    pub(super) fn cost(&self) -> f64 {
        self.cost
    }

    /// A submission that was to have `planned` pixel samples, and had `cost`, kept the device busy for `busy`.
    pub(super) fn measured(&mut self, planned: f64, cost: u64, busy: Duration) {
        let ideal = cost as f64 * self.target / busy.as_secs_f64().max(1e-6);
        self.cost = ideal.min(planned * GROWTH).clamp(LEAST, self.ceiling.max(LEAST));
    }

    /// The device was lost: half of what it last got is the most it gets from now on.
    pub(super) fn halve(&mut self) {
        self.ceiling = (self.cost * 0.5).max(LEAST);
        self.cost = self.ceiling.min(FIRST);
    }

    /// Number of tiles of the next submission and pixels of each, for a batch of `samples`.
    pub(super) fn tiles(&self, samples: u32) -> (usize, u64) {
        let pixels = self.cost / f64::from(samples.max(1));
        let split = MAX_TILES as f64;
        let (n, each) =
            if pixels / split >= MIN_SPLIT { (MAX_TILES, pixels / split) } else { (1, pixels) };
        #[expect(clippy::cast_possible_truncation, reason = "bounded by MAX_TILE")]
        let each = each.min(MAX_TILE as f64) as u64;
        (n, each.max(64))
    }
}

/// How long the device was at work, submission after submission.
pub(super) struct Busy {
    began: Instant,
    last_end: Instant,
    total: Duration,
    /// Submissions that the device timed itself, and all.
    timed: [u32; 2],
}

impl Busy {
    pub(super) fn new(now: Instant) -> Self {
        Self { began: now, last_end: now, total: Duration::ZERO, timed: [0; 2] }
    }

    /// A submission has ended; `own` is what the device says that it took. Without that it was busy
    /// from the submission, or from the end of the one before, until now.
    pub(super) fn ended(
        &mut self,
        submitted: Instant,
        now: Instant,
        own: Option<Duration>,
    ) -> Duration {
        let wall = now.saturating_duration_since(submitted.max(self.last_end));
        let time = own.unwrap_or(wall);
        self.last_end = now;
        self.total += time;
        self.timed[0] += u32::from(own.is_some());
        self.timed[1] += 1;
        time
    }

    /// One line for the user; `None` when there was no submission.
    pub(super) fn text(&self, now: Instant) -> Option<String> {
        let [timed, all] = self.timed;
        let run = now.saturating_duration_since(self.began).as_secs_f64();
        let how = if timed == all { "its timestamps" } else { "wall time" };
        let share = 100.0 * self.total.as_secs_f64() / run.max(1e-9);
        (all > 0).then(|| {
            format!("the GPU was busy for {share:.0} % of {run:.2}s, {all} submissions, by {how}")
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Runs submissions on a device of `rate` pixel samples a second; returns their durations.
    fn durations(rate: f64, pace: &mut Pace, n: usize) -> Vec<f64> {
        (0..n)
            .map(|_| {
                let (tiles, pixels) = pace.tiles(16);
                let cost = tiles as u64 * pixels * 16;
                let seconds = cost as f64 / rate;
                pace.measured(pace.cost(), cost, Duration::from_secs_f64(seconds));
                seconds
            })
            .collect()
    }

    #[test]
    fn submissions_approach_the_wanted_duration() {
        // From one that does a tile of 64 x 64 in a second to a large GPU.
        for rate in [65_536.0, 1e6, 1e7, 1e8] {
            let times = durations(rate, &mut Pace::new(Duration::from_millis(100)), 12);
            assert!((0.05..=0.11).contains(times.last().unwrap()), "{rate}: {times:?}");
        }
    }

    #[test]
    fn no_submission_after_the_first_takes_longer_than_a_second() {
        for rate in [2e4, 1e5, 1e6, 1e9] {
            let times = durations(rate, &mut Pace::new(Duration::from_mins(1)), 20);
            assert!(times[1..].iter().all(|t| *t <= 1.01), "{rate}: {times:?}");
        }
    }

    #[test]
    fn a_lost_device_never_gets_as_much_again() {
        let mut pace = Pace::new(Duration::from_millis(100));
        durations(1e7, &mut pace, 10);
        let before = pace.cost;
        pace.halve();
        durations(1e7, &mut pace, 10);
        assert!(pace.cost <= before / 2.0);
    }

    #[test]
    fn a_device_that_does_not_say_is_timed_by_the_wall() {
        let ms = Duration::from_millis;
        let start = Instant::now();
        let mut busy = Busy::new(start);
        assert_eq!(busy.text(start), None);
        // Both were submitted at once: the second began when the first ended.
        assert_eq!(busy.ended(start, start + ms(30), None), ms(30));
        assert_eq!(busy.ended(start, start + ms(50), None), ms(20));
        assert_eq!(busy.ended(start + ms(60), start + ms(80), Some(ms(15))), ms(15));
        let text = busy.text(start + ms(100));
        let expected = "the GPU was busy for 65 % of 0.10s, 3 submissions, by wall time";
        assert_eq!(text.as_deref(), Some(expected));
    }

    #[test]
    fn what_is_left_at_an_edge_does_not_make_the_next_tiles_small() {
        let mut pace = Pace::new(Duration::from_millis(100));
        durations(1e6, &mut pace, 10);
        let before = pace.cost();
        pace.measured(before, 1024, Duration::from_secs_f64(1024e-6));
        assert!(pace.cost() > 0.9 * before, "{before} to {}", pace.cost());
    }

    #[test]
    fn tiles_of_few_samples_have_more_pixels() {
        let pace = Pace::new(Duration::from_millis(100));
        let cost = |samples| {
            let (n, pixels) = pace.tiles(samples);
            n as u64 * pixels * u64::from(samples)
        };
        assert_eq!([1, 4, 16].map(cost), [65_536; 3]);
    }

    #[test]
    fn tiles_stay_within_their_film() {
        let mut pace = Pace::new(Duration::from_millis(100));
        for _ in 0..40 {
            pace.measured(pace.cost(), u64::MAX / 2, Duration::from_nanos(1));
        }
        assert_eq!(pace.tiles(1), (MAX_TILES, MAX_TILE));
        assert_eq!(pace.tiles(16), (MAX_TILES, MAX_TILE));
    }
}

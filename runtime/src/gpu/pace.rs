//! How much to hand to the GPU at once: measured durations → sizes of tiles and submissions.
//!
//! A submission should take long enough to hide what it costs to make one, and short enough that
//! the desktop stays alive and no watchdog bites. It also has to fill the device, see `fill`. Pure arithmetic,
//! no device.

use super::fill::Fill;
use super::work::{CAP, GROWTH, Work};
use std::time::Duration;

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

/// What is left per submission of the slowest pixel samples seen.
const FORGET: f64 = 0.9;

/// The controller.
pub(super) struct Pace {
    target: f64,
    /// Pixel samples of a submission.
    wanted: f64,
    /// Those of the next one.
    cost: f64,
    /// Never more than this; shrinks when a device is lost.
    ceiling: f64,
    /// The slowest pixel samples of late, in seconds each.
    slowest: f64,
    fill: Fill,
}

impl Pace {
    pub(super) fn new(target: Duration) -> Self {
        let target = target.clamp(Duration::from_millis(1), CAP).as_secs_f64();
        let (ceiling, fill) = (f64::INFINITY, Fill::climbing(FIRST));
        Self { target, wanted: FIRST, cost: FIRST, ceiling, slowest: 0.0, fill }
    }

    /// Plans the next submission. Returns the pixel samples that it is to have.
    pub(super) fn next(&mut self) -> f64 {
        self.cost = self.fill.next().unwrap_or(self.wanted).min(self.ceiling.max(LEAST));
        self.cost
    }

    /// A submission has ended.
    pub(super) fn measured(&mut self, work: Work) {
        let each = work.seconds() / work.samples.max(1) as f64;
        let has_grown = self.fill.climb(work);
        self.slowest = if has_grown {
            each
        } else if work.planned < 0.5 * self.fill.least() && work.busy < CAP {
            // It left most of the device idle: its time is that of one thread.
            self.slowest * FORGET
        } else {
            each.max(self.slowest * FORGET)
        };
        let ideal = (self.target / each).min(work.planned * GROWTH);
        let longest = CAP.as_secs_f64() / self.slowest;
        let least = self.fill.measured(work, ideal, longest);
        self.wanted = ideal.max(least.min(longest)).clamp(LEAST, self.ceiling.max(LEAST));
    }

    /// The device was lost: half of what it last got is the most it gets from now on.
    pub(super) fn halve(&mut self) {
        self.ceiling = (self.cost * 0.5).max(LEAST);
        self.wanted = self.ceiling.min(FIRST);
        self.cost = self.wanted;
        self.fill = Fill::default();
    }

    /// Number of tiles of the submission that was planned last and pixels of each, for a batch of `samples`.
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

#[cfg(test)]
mod tests {
    use super::*;

    const TARGET: Duration = Duration::from_millis(100);

    /// Runs `n` submissions on a device that takes `seconds` for a number of pixel samples; returns their
    /// durations.
    fn run(pace: &mut Pace, n: usize, seconds: impl Fn(f64) -> f64) -> Vec<f64> {
        (0..n)
            .map(|_| {
                let planned = pace.next();
                let (tiles, pixels) = pace.tiles(16);
                let samples = tiles as u64 * pixels * 16;
                let time = seconds(samples as f64);
                let busy = Duration::from_secs_f64(time);
                pace.measured(Work { planned, samples, rays: 5 * samples, busy });
                time
            })
            .collect()
    }

    /// A device of `rate` pixel samples a second that any tile fills.
    fn durations(rate: f64, pace: &mut Pace, n: usize) -> Vec<f64> {
        run(pace, n, |samples| samples / rate)
    }

    #[test]
    fn submissions_approach_the_wanted_duration() {
        // From one that does a tile of 64 x 64 in a second to a large GPU.
        for rate in [65_536.0, 1e6, 1e7, 1e8] {
            let times = durations(rate, &mut Pace::new(TARGET), 30);
            let near = times.iter().filter(|t| (0.05..=0.11).contains(*t)).count();
            assert!(near >= 15, "{rate}: {times:?}");
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
    fn a_large_device_is_filled_though_its_slowest_thread_takes_longer_than_wanted() {
        // 4.8 million pixel samples fill it.
        let (latency, rate) = (0.12, 4e7);
        let mut pace = Pace::new(TARGET);
        let times = run(&mut pace, 60, |samples| (samples / rate).max(latency));
        assert!(times.iter().all(|t| *t <= 1.01), "{times:?}");
        assert!(pace.wanted >= 4e6, "{}", pace.wanted);
    }

    #[test]
    fn a_device_whose_slowest_thread_takes_far_longer_than_wanted_is_filled_at_once() {
        // 40 million pixel samples fill it; a submission may have a second.
        let (latency, rate) = (0.4, 1e8);
        let mut pace = Pace::new(TARGET);
        let times = run(&mut pace, 12, |samples| (samples / rate).max(latency));
        assert!(times.iter().all(|t| *t <= 1.01), "{times:?}");
        assert_eq!(pace.tiles(16), (MAX_TILES, MAX_TILE), "{}", pace.wanted);
    }

    #[test]
    fn a_slow_part_of_the_picture_makes_submissions_small_for_a_while() {
        let mut pace = Pace::new(TARGET);
        run(&mut pace, 40, |samples| (samples / 4e7).max(0.12));
        let before = pace.wanted;
        run(&mut pace, 3, |samples| (samples / 2e6).max(0.12));
        assert!(pace.wanted < 0.5 * before, "{before} to {}", pace.wanted);
        run(&mut pace, 60, |samples| (samples / 4e7).max(0.12));
        assert!(pace.wanted >= 0.9 * before, "{before} to {}", pace.wanted);
    }

    #[test]
    fn a_larger_size_that_gains_nothing_is_tried_rarely() {
        let times = durations(1e6, &mut Pace::new(TARGET), 1000);
        let long = times.iter().filter(|t| **t > 0.2).count();
        assert!((4..40).contains(&long), "{long}");
    }

    #[test]
    fn a_lost_device_never_gets_as_much_again() {
        let mut pace = Pace::new(TARGET);
        durations(1e7, &mut pace, 10);
        let before = pace.next();
        pace.halve();
        durations(1e7, &mut pace, 10);
        assert!(pace.next() <= before / 2.0);
    }

    #[test]
    fn what_is_left_at_an_edge_does_not_make_the_next_tiles_small() {
        let mut pace = Pace::new(TARGET);
        durations(1e6, &mut pace, 30);
        let planned = pace.next();
        let busy = Duration::from_secs_f64(1024e-6);
        pace.measured(Work { planned, samples: 1024, rays: 5120, busy });
        assert!(pace.next() > 0.9 * planned, "{planned} to {}", pace.next());
    }

    #[test]
    fn tiles_of_few_samples_have_more_pixels() {
        let pace = Pace::new(TARGET);
        let cost = |samples| {
            let (n, pixels) = pace.tiles(samples);
            n as u64 * pixels * u64::from(samples)
        };
        assert_eq!([1, 4, 16].map(cost), [65_536; 3]);
    }

    #[test]
    fn tiles_stay_within_their_film() {
        let mut pace = Pace::new(TARGET);
        run(&mut pace, 40, |_| 1e-9);
        assert_eq!(pace.tiles(1), (MAX_TILES, MAX_TILE));
        assert_eq!(pace.tiles(16), (MAX_TILES, MAX_TILE));
    }
}

//! How much to hand to the GPU at once: measured durations → sizes of tiles and submissions.
//!
//! A submission should take long enough to hide what it costs to make one, and short enough that
//! the desktop stays alive and no watchdog bites. Pure arithmetic, no device.

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

    /// A submission of `cost` pixel samples kept the device busy for `busy`.
    pub(super) fn measured(&mut self, cost: u64, busy: Duration) {
        let cost = cost as f64;
        let ideal = cost * self.target / busy.as_secs_f64().max(1e-6);
        self.cost = ideal.min(cost.max(LEAST) * GROWTH).clamp(LEAST, self.ceiling.max(LEAST));
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
                pace.measured(cost, Duration::from_secs_f64(seconds));
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
    fn tiles_stay_within_their_film() {
        let mut pace = Pace::new(Duration::from_millis(100));
        for _ in 0..40 {
            pace.measured(u64::MAX / 2, Duration::from_nanos(1));
        }
        assert_eq!(pace.tiles(1), (MAX_TILES, MAX_TILE));
        assert_eq!(pace.tiles(16), (MAX_TILES, MAX_TILE));
    }
}

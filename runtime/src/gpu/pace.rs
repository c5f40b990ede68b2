//! How much to hand to the GPU at once: measured durations → sizes of tiles and submissions.
//!
//! A submission should take long enough to hide what it costs to make one, and short enough that
//! the desktop stays alive and no watchdog bites. It also has to fill the device: one that leaves
//! most of a large GPU idle takes as long as its slowest thread, however few threads there are, and
//! making it smaller gains nothing. Pure arithmetic, no device.

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

/// Measured submissions of each size before two sizes are compared.
const ROUNDS: u32 = 4;
/// A larger size is kept when it raises the rate at least by this factor.
const GAIN: f64 = 1.2;
/// Submissions from a failed trial to the next, at first and at most; twice as many each time.
const WAIT: [u32; 2] = [32, 1024];
/// What is left per submission of the slowest pixel samples seen.
const FORGET: f64 = 0.9;

/// A finished submission.
#[derive(Clone, Copy, Debug)]
pub(super) struct Work {
    /// Pixel samples that it was to have: [`Pace::next`].
    pub(super) planned: f64,
    /// Pixel samples that it had: fewer at the end of a pass.
    pub(super) samples: u64,
    /// Rays that they took.
    pub(super) rays: u64,
    /// How long it kept the device busy.
    pub(super) busy: Duration,
}

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
        let (ceiling, fill) = (f64::INFINITY, Fill::default());
        Self { target, wanted: FIRST, cost: FIRST, ceiling, slowest: 0.0, fill }
    }

    /// Plans the next submission. Returns the pixel samples that it is to have.
    pub(super) fn next(&mut self) -> f64 {
        self.cost = self.fill.next().unwrap_or(self.wanted).min(self.ceiling.max(LEAST));
        self.cost
    }

    /// A submission has ended.
    pub(super) fn measured(&mut self, work: Work) {
        let seconds = work.busy.as_secs_f64().max(1e-6);
        let each = seconds / work.samples.max(1) as f64;
        self.slowest = each.max(self.slowest * FORGET);
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

/// The least size that fills the device. From time to time a larger one is tried in turns with the
/// wanted one, so that both see the same parts of the picture: if its rate is higher, the device
/// was not full.
#[derive(Default)]
struct Fill {
    /// Pixel samples below which the device is known not to be full.
    least: f64,
    trial: Option<Trial>,
    /// Submissions until the next trial.
    wait: u32,
    /// Trials that failed one after the other.
    failed: u32,
}

/// Two sizes in turns.
struct Trial {
    /// The larger one, in pixel samples.
    cost: f64,
    /// Whether it is next.
    is_next: bool,
    /// What the usual size and the larger one achieve.
    rates: [Rate; 2],
    /// Submissions after which the trial ends in any case.
    left: u32,
}

/// Rays and the time they took.
#[derive(Clone, Copy, Default)]
struct Rate {
    rays: f64,
    seconds: f64,
    n: u32,
}

impl Rate {
    fn add(&mut self, work: Work) {
        self.rays += work.rays as f64;
        self.seconds += work.busy.as_secs_f64().max(1e-6);
        self.n += 1;
    }

    fn per_second(self) -> f64 {
        self.rays / self.seconds.max(1e-6)
    }
}

impl Fill {
    /// The size of the next submission, if a trial decides it.
    fn next(&mut self) -> Option<f64> {
        let trial = self.trial.as_mut()?;
        trial.is_next = !trial.is_next;
        (!trial.is_next).then_some(trial.cost)
    }

    /// The least size of submissions, after one has ended. `ideal` takes the wanted duration,
    /// `longest` the longest that is allowed.
    fn measured(&mut self, work: Work, ideal: f64, longest: f64) -> f64 {
        // What is left at the end of a pass says nothing of its planned size.
        let is_full = work.samples as f64 >= 0.5 * work.planned;
        self.wait = self.wait.saturating_sub(1);
        if let Some(trial) = &mut self.trial {
            let k = usize::from(work.planned >= 0.9 * trial.cost);
            if is_full {
                trial.rates[k].add(work);
            }
            trial.left -= 1;
            let [usual, larger] = trial.rates;
            if trial.left == 0 || usual.n.min(larger.n) >= ROUNDS {
                let gains = larger.n > 0 && larger.per_second() >= GAIN * usual.per_second();
                let kept = gains.then_some(trial.cost);
                self.end(kept);
            }
        } else if self.wait == 0 && is_full && ideal < 1.5 * work.planned {
            // It does not grow by itself any more.
            let cost = (work.planned * GROWTH).min(longest);
            if cost >= 1.5 * work.planned {
                let rates = [Rate::default(); 2];
                self.trial = Some(Trial { cost, is_next: false, rates, left: 4 * ROUNDS });
            }
        }
        self.least
    }

    /// Ends the trial, with the size that is kept.
    fn end(&mut self, kept: Option<f64>) {
        self.trial = None;
        if let Some(cost) = kept {
            (self.least, self.failed) = (cost, 0);
        } else {
            self.wait = WAIT[0].saturating_mul(1 << self.failed.min(8)).min(WAIT[1]);
            self.failed += 1;
        }
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

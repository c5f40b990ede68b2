//! Submissions that have ended → the least size that fills the device.
//!
//! The first submissions grow as long as that raises the rate of rays: a device that is not full takes the same
//! time for more, that of its slowest thread, which says nothing of how much it could do. Later a larger size is
//! tried now and then in turns with the wanted one, so that both see the same parts of the picture.

use super::work::{CAP, GROWTH, Work};

/// Measured submissions of each size before two sizes are compared.
const ROUNDS: u32 = 4;
/// A larger size is kept when it raises the rate at least by this factor.
const GAIN: f64 = 1.2;
/// A size that is not this much larger is not tried.
const STEP: f64 = 1.5;
/// Submissions of a size that raises the rate by less, before growing ends: as many as are under way together.
const TRIES: u32 = 3;
/// Submissions from a failed trial to the next, at first and at most; twice as many each time.
const WAIT: [u32; 2] = [32, 1024];

/// What is known of the least size that fills the device.
#[derive(Default)]
pub(super) struct Fill {
    /// Pixel samples below which the device is known not to be full.
    least: f64,
    /// At the beginning.
    climb: Option<Climb>,
    trial: Option<Trial>,
    /// Submissions until the next trial.
    wait: u32,
    /// Trials that failed one after the other.
    failed: u32,
}

/// Sizes that grow.
struct Climb {
    /// Pixel samples.
    cost: f64,
    /// What the size before and this one achieve.
    rates: [Rate; 2],
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
        self.seconds += work.seconds();
        self.n += 1;
    }

    fn per_second(self) -> f64 {
        self.rays / self.seconds.max(1e-6)
    }
}

impl Fill {
    /// Begins with submissions of `cost` pixel samples, and grows from there.
    pub(super) fn climbing(cost: f64) -> Self {
        let climb = Some(Climb { cost, rates: [Rate::default(); 2] });
        Self { climb, ..Self::default() }
    }

    /// Pixel samples below which the device is known not to be full.
    pub(super) fn least(&self) -> f64 {
        self.least
    }

    /// The size of the next submission, if growing or a trial decides it.
    pub(super) fn next(&mut self) -> Option<f64> {
        if let Some(climb) = &self.climb {
            return Some(climb.cost);
        }
        let trial = self.trial.as_mut()?;
        trial.is_next = !trial.is_next;
        (!trial.is_next).then_some(trial.cost)
    }

    /// Grows if the size of `work` has raised the rate; returns whether it has.
    pub(super) fn climb(&mut self, work: Work) -> bool {
        let Some(climb) = self.climb.as_mut().filter(|_| work.is_full()) else { return false };
        let k = usize::from(work.planned >= 0.9 * climb.cost);
        climb.rates[k].add(work);
        let [before, now] = climb.rates;
        if k == 0 || now.per_second() < GAIN * before.per_second() {
            if now.n >= TRIES {
                self.climb = None;
            }
            return false;
        }
        if before.n > 0 {
            self.least = work.planned;
        }
        let growth = (CAP.as_secs_f64() / work.seconds()).min(GROWTH);
        self.climb = (growth >= STEP)
            .then(|| Climb { cost: work.planned * growth, rates: [now, Rate::default()] });
        true
    }

    /// The least size of submissions, after one has ended. `ideal` takes the wanted duration,
    /// `longest` the longest that is allowed.
    pub(super) fn measured(&mut self, work: Work, ideal: f64, longest: f64) -> f64 {
        self.wait = self.wait.saturating_sub(1);
        if let Some(trial) = &mut self.trial {
            let k = usize::from(work.planned >= 0.9 * trial.cost);
            if work.is_full() {
                trial.rates[k].add(work);
            }
            trial.left -= 1;
            let [usual, larger] = trial.rates;
            if trial.left == 0 || usual.n.min(larger.n) >= ROUNDS {
                let gains = larger.n > 0 && larger.per_second() >= GAIN * usual.per_second();
                let kept = gains.then_some(trial.cost);
                self.end(kept);
            }
        } else if self.climb.is_none()
            && self.wait == 0
            && work.is_full()
            && ideal < STEP * work.planned
        {
            // It does not grow by itself any more.
            let cost = (work.planned * GROWTH).min(longest);
            if cost >= STEP * work.planned {
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

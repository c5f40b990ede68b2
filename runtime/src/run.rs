//! One run as the backends see it: claim a tile, render it, deposit it.
//!
//! Everything that decides about the picture happens here, under one lock; backends only turn work
//! items into pixels. A tile that fails is reported and left out, the others go on.

use crate::control::Control;
use crate::film::{Accumulator, Film};
use crate::job::Job;
use crate::region::{Rect, SampleRange};
use crate::saver::Saver;
use crate::schedule::{Claim, Scheduler, Stop, WorkItem};
use pack::abi::FilmPixel;
use std::sync::{Condvar, Mutex, MutexGuard, PoisonError};
use std::time::{Duration, Instant};

/// A tile that could not be rendered.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct TileFailure {
    /// Its pixels.
    pub tile: Rect,
    /// Its first sample.
    pub sample: u32,
    /// What happened.
    pub message: String,
}

/// The state of a run, shared by the threads of its backend.
pub(crate) struct Run<'a> {
    state: Mutex<State>,
    /// Told whenever an item has ended.
    ended: Condvar,
    control: &'a Control,
    started: Instant,
    strict: bool,
    saver: Option<&'a Saver<'a>>,
}

struct State {
    scheduler: Scheduler,
    sum: Accumulator,
    failures: Vec<TileFailure>,
}

/// What a run leaves behind.
pub(crate) struct Finished {
    pub(crate) film: Film,
    pub(crate) stop: Stop,
    pub(crate) failures: Vec<TileFailure>,
    pub(crate) elapsed: Duration,
}

impl<'a> Run<'a> {
    /// A run that goes on from `film`, which `Checkpoint::can_hold`, or begins.
    pub(crate) fn new(
        job: &Job,
        control: &'a Control,
        film: Option<Film>,
        saver: Option<&'a Saver<'a>>,
    ) -> Self {
        let film = film.unwrap_or_else(|| Film::new(job.image_size, job.crop));
        let rest = match film.ranges.last() {
            Some(done) => SampleRange::new(done.end, job.samples.end),
            None => Some(job.samples),
        };
        let total = job.crop.pixels() * u64::from(job.samples.count());
        control.begin(total, film.total_samples());
        let state = State {
            scheduler: Scheduler::new(job.crop, rest, job.time_limit),
            sum: Accumulator::new(film),
            failures: Vec::new(),
        };
        Self {
            state: Mutex::new(state),
            ended: Condvar::new(),
            control,
            started: Instant::now(),
            strict: job.strict,
            saver,
        }
    }

    /// No code panics while it holds the lock; a poisoned one would still hold whole batches.
    fn lock(&self) -> MutexGuard<'_, State> {
        self.state.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// The next tile of about `pixels` pixels; `Wait` when there may be more later.
    #[cfg(feature = "gpu")]
    pub(crate) fn claim(&self, pixels: u64) -> Claim {
        self.claim_locked(&mut self.lock(), pixels)
    }

    fn claim_locked(&self, state: &mut State, pixels: u64) -> Claim {
        if self.control.is_cancelled() {
            state.scheduler.stop(Stop::Cancelled);
        }
        let claim = state.scheduler.claim(self.started.elapsed(), pixels);
        if let Claim::FirstOf(item) = claim {
            state.sum.open(item.samples);
        }
        claim
    }

    /// As `claim`, but waits.
    pub(crate) fn claim_blocking(&self, pixels: u64) -> Option<WorkItem> {
        let mut state = self.lock();
        loop {
            match self.claim_locked(&mut state, pixels) {
                Claim::Work(item) | Claim::FirstOf(item) => return Some(item),
                Claim::Done => return None,
                Claim::Wait => {
                    // The timeout makes a cancel from outside seen.
                    let wait = self.ended.wait_timeout(state, Duration::from_millis(50));
                    state = wait.unwrap_or_else(PoisonError::into_inner).0;
                }
            }
        }
    }

    /// Takes the pixels of a claimed item, row by row.
    pub(crate) fn deposit(&self, item: &WorkItem, pixels: &[FilmPixel]) {
        let mut state = self.lock();
        state.scheduler.finished(item);
        if !item.probe {
            state.sum.deposit(item.samples, item.tile, pixels);
            if self.strict && pixels.iter().any(|pixel| pixel.bad > 0) {
                state.scheduler.stop(Stop::Failed);
            }
            let rays = pixels.iter().map(|pixel| u64::from(pixel.rays)).sum();
            self.control.advance(item.cost(), rays);
            if let Some(saver) = self.saver {
                saver.offer(state.sum.film(), self.started.elapsed());
            }
        }
        drop(state);
        self.ended.notify_all();
    }

    /// A claimed item was not rendered and may be claimed again.
    #[cfg(feature = "gpu")]
    pub(crate) fn give_back(&self, item: WorkItem) {
        self.lock().scheduler.give_back(item);
        self.ended.notify_all();
    }

    /// A claimed item cannot be rendered. The pass goes on without it and is the last one.
    pub(crate) fn fail(&self, item: &WorkItem, message: String) {
        let mut state = self.lock();
        state.scheduler.finished(item);
        state.scheduler.stop(Stop::Failed);
        if !item.probe {
            state.sum.give_up(item.samples, item.tile);
        }
        state.failures.push(TileFailure { tile: item.tile, sample: item.samples.start, message });
        drop(state);
        self.ended.notify_all();
    }

    /// Ends the run now.
    pub(crate) fn abort(&self) {
        self.lock().scheduler.stop(Stop::Failed);
    }

    pub(crate) fn note(&self, text: &str) {
        self.control.note(text);
    }

    /// What the owner says.
    pub(crate) fn control(&self) -> &Control {
        self.control
    }

    /// Whether anything has been deposited.
    #[cfg(feature = "gpu")]
    pub(crate) fn done(&self) -> u64 {
        self.control.progress().done
    }

    pub(crate) fn finish(self) -> Finished {
        let elapsed = self.started.elapsed();
        let state = self.state.into_inner().unwrap_or_else(PoisonError::into_inner);
        let stop = state.scheduler.why();
        Finished { film: state.sum.finish(), stop, failures: state.failures, elapsed }
    }
}

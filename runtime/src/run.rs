//! One run as the backends see it: claim a tile, render it, deposit it.
//!
//! Everything that decides about the picture happens here, under one lock; backends only turn work
//! items into pixels. A tile that fails is reported and left out, the others go on.

use crate::control::Control;
use crate::convergence::{Convergence, Moment, REPLICATES_U32, Times, Tracker};
use crate::film::{Accumulator, Film};
use crate::job::Job;
use crate::region::{Rect, SampleRange};
use crate::saver::Saver;
use crate::schedule::{Claim, Scheduler, Stop, TileSize, WorkItem};
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
    /// When the first tile was claimed, since the run began.
    first: Option<Duration>,
    /// When the last one was deposited.
    last: Duration,
    /// Time that deposits took.
    readback: Duration,
    /// Time that submissions took by the device's own clock; `None` as soon as it has not timed one.
    #[cfg(feature = "gpu")]
    device: Option<Duration>,
    tracker: Option<Tracker>,
}

/// What a run leaves behind.
pub(crate) struct Finished {
    pub(crate) film: Film,
    pub(crate) stop: Stop,
    pub(crate) failures: Vec<TileFailure>,
    pub(crate) elapsed: Duration,
    /// The error curve, of a run that was measured.
    pub(crate) convergence: Option<Convergence>,
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
        let total = job.crop.pixels() * u64::from(job.spp());
        control.begin(total, film.total_samples());
        let mut scheduler = Scheduler::new(job.crop, rest, job.time_limit);
        let mut sum = Accumulator::new(film);
        let mut tracker = None;
        if let Some(measure) = &job.measure {
            scheduler = scheduler.in_rounds(REPLICATES_U32);
            sum = sum.in_rounds();
            tracker = Some(Tracker::new(measure.clone(), job.crop.w));
        }
        let (failures, first) = (Vec::new(), None);
        let (last, readback) = (Duration::ZERO, Duration::ZERO);
        let state = State {
            scheduler,
            sum,
            failures,
            first,
            last,
            readback,
            #[cfg(feature = "gpu")]
            device: Some(Duration::ZERO),
            tracker,
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

    /// The next tile of about this size; `Wait` when there may be more later.
    #[cfg(feature = "gpu")]
    pub(crate) fn claim(&self, size: TileSize<'_>) -> Claim {
        self.claim_locked(&mut self.lock(), size)
    }

    fn claim_locked(&self, state: &mut State, size: TileSize<'_>) -> Claim {
        if self.control.is_cancelled() {
            state.scheduler.stop(Stop::Cancelled);
        }
        let now = self.started.elapsed();
        let first = *state.first.get_or_insert(now);
        let claim = state.scheduler.claim(now.saturating_sub(first), size);
        if let Claim::FirstOf(item) = claim {
            state.sum.open(item.samples, item.replicate);
        }
        claim
    }

    /// The next tile of about `pixels` pixels; waits while there may be more later.
    pub(crate) fn claim_blocking(&self, pixels: u64) -> Option<WorkItem> {
        let mut state = self.lock();
        loop {
            match self.claim_locked(&mut state, &|_| pixels) {
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
        let began = self.started.elapsed();
        state.scheduler.finished(item);
        if !item.probe {
            state.sum.deposit(item, pixels);
            let ended = self.started.elapsed();
            state.last = ended;
            state.readback += ended.saturating_sub(began);
            self.track(&mut state);
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

    /// Tells a point of the error curve when a round has become whole and one is due.
    fn track(&self, state: &mut State) {
        let now = state.moment();
        let State { sum, tracker: Some(tracker), scheduler, .. } = state else { return };
        let (sums, samples) = sum.lumas();
        if !tracker.is_news(samples) {
            return;
        }
        if let Some(point) = tracker.round(now, sums, samples) {
            self.control.note(&point.to_string());
            if tracker.is_met() {
                scheduler.stop(Stop::ErrorReached);
            }
        }
    }

    /// A claimed item was not rendered and may be claimed again.
    #[cfg(feature = "gpu")]
    pub(crate) fn give_back(&self, item: WorkItem) {
        self.lock().scheduler.give_back(item);
        self.ended.notify_all();
    }

    /// A submission has ended, which took `own` by the device's own clock.
    #[cfg(feature = "gpu")]
    pub(crate) fn timed(&self, own: Option<Duration>) {
        let mut state = self.lock();
        state.device = state.device.zip(own).map(|(sum, own)| sum + own);
    }

    /// A claimed item cannot be rendered. The pass goes on without it and is the last one.
    pub(crate) fn fail(&self, item: &WorkItem, message: String) {
        let mut state = self.lock();
        state.scheduler.finished(item);
        state.scheduler.stop(Stop::Failed);
        if !item.probe {
            state.sum.give_up(item);
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
        let mut state = self.state.into_inner().unwrap_or_else(PoisonError::into_inner);
        let stop = state.scheduler.why();
        let convergence = state.tracker.take().map(|tracker| {
            let (sums, samples) = state.sum.lumas();
            let compile = state.first.unwrap_or(elapsed).as_secs_f64();
            let readback = state.readback.as_secs_f64();
            #[cfg(feature = "gpu")]
            let device = state.device.filter(|time| !time.is_zero()).map(|time| time.as_secs_f64());
            #[cfg(not(feature = "gpu"))]
            let device = None;
            let times = Times { compile, readback, device, ..Times::default() };
            tracker.finish(sums, samples, times)
        });
        Finished { film: state.sum.finish(), stop, failures: state.failures, elapsed, convergence }
    }
}

impl State {
    /// The last deposit, as the error curve sees it.
    fn moment(&self) -> Moment {
        let counters = &self.sum.film().counters;
        Moment {
            elapsed: self.last.saturating_sub(self.first.unwrap_or_default()),
            total: self.last,
            rays: counters.rays,
            bad: counters.bad,
        }
    }
}

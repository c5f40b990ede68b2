//! One run as the backends see it: claim a tile, render it, deposit it.
//!
//! Everything that decides about the picture happens here, under one lock; backends only turn work
//! items into pixels. A tile that fails is reported and left out, the others go on.

use crate::convergence::{Convergence, Decision, Moment, Point, Times, Tracker};
use crate::film::{Accumulator, Film};
use crate::job::Job;
use crate::outcome::{Outcome, TileFailure};
use crate::output::{Meta, Picture};
use crate::preview::Previewer;
use crate::region::SampleRange;
use crate::replicate::REPLICATES_U32;
use crate::saver::Saver;
use crate::schedule::{Claim, Scheduler, Stop, TileSize, WorkItem, slack};
use crate::signals::Signals;
use crate::zeros::NoMemory;
use pack::abi::FilmPixel;
use std::sync::atomic::{AtomicU64, Ordering};
use std::sync::{Arc, Condvar, Mutex, MutexGuard, PoisonError};
use std::time::{Duration, Instant};

/// A run, as the threads of its backend see it.
pub(crate) struct Run<'a> {
    shared: Arc<Shared>,
    signals: &'a Signals,
    strict: bool,
}

/// The state of a run. It borrows nothing: what is complete can be taken out of it whatever became of
/// the threads that work on it.
pub(crate) struct Shared {
    state: Mutex<State>,
    /// Told whenever an item has ended.
    ended: Condvar,
    started: Instant,
    /// Microseconds since `started` after which items are broken off; all ones: never.
    deadline: AtomicU64,
    /// And after which the run should have ended.
    overdue: AtomicU64,
    frame: Framing,
}

/// What a picture is framed in, and where the run is saved.
#[derive(Default)]
pub(crate) struct Framing {
    /// What is known of the picture before it is rendered.
    pub(crate) meta: Meta,
    /// Time of the runs before this one.
    pub(crate) before: Duration,
    /// Devices of the runs before this one.
    pub(crate) devices: Vec<String>,
    /// `None`: it is not saved.
    pub(crate) saver: Option<Saver>,
    /// `None`: nobody waits for pictures.
    pub(crate) previewer: Option<Previewer>,
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
    /// Devices that rendered it, in order.
    devices: Vec<String>,
    /// Whether what is complete was taken; the rest is of no use to anybody.
    taken: bool,
}

/// What a run leaves behind.
pub(crate) struct Finished {
    pub(crate) film: Film,
    pub(crate) stop: Stop,
    pub(crate) failures: Vec<TileFailure>,
    pub(crate) elapsed: Duration,
    /// The error curve, of a run that was measured.
    pub(crate) convergence: Option<Convergence>,
    /// Devices that rendered it, in order.
    pub(crate) devices: Vec<String>,
}

impl<'a> Run<'a> {
    /// A run that goes on from `film`, which `Checkpoint::can_hold`, or begins.
    pub(crate) fn new(
        job: &Job,
        signals: &'a Signals,
        film: Option<Film>,
        frame: Framing,
    ) -> Result<Self, NoMemory> {
        let film = match film {
            Some(film) => film,
            None => Film::try_new(job.image_size, job.crop)?,
        };
        let rest = match film.ranges.last() {
            Some(done) => SampleRange::new(done.end, job.samples.end),
            None => Some(job.samples),
        };
        let total = job.crop.pixels() * u64::from(job.spp());
        signals.begin(total, film.total_samples());
        let mut scheduler = Scheduler::new(job.crop, rest, job.time_limit);
        let (sum, tracker) = match &job.measure {
            None => (Accumulator::new(film)?, None),
            Some(measure) => {
                scheduler = scheduler.in_rounds(REPLICATES_U32);
                let tracker = Tracker::new(measure.clone(), job.crop.w);
                tracker.decision().into_iter().for_each(|end| scheduler.up_to(end));
                (Accumulator::in_rounds(film)?, Some(tracker))
            }
        };
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
            devices: frame.devices.clone(),
            taken: false,
        };
        let shared = Arc::new(Shared {
            state: Mutex::new(state),
            ended: Condvar::new(),
            started: Instant::now(),
            deadline: AtomicU64::new(u64::MAX),
            overdue: AtomicU64::new(u64::MAX),
            frame,
        });
        Ok(Self { shared, signals, strict: job.strict })
    }

    /// Its state, which does not depend on the threads that work on it.
    pub(crate) fn shared(&self) -> &Arc<Shared> {
        &self.shared
    }

    fn lock(&self) -> MutexGuard<'_, State> {
        self.shared.lock()
    }

    /// Whether items are to be broken off now, rather than rendered to their end.
    pub(crate) fn is_broken_off(&self) -> bool {
        self.signals.is_cancelled() || self.shared.is_past(&self.shared.deadline)
    }

    /// The device that renders from now on.
    pub(crate) fn device(&self, name: String) {
        let mut state = self.lock();
        if state.devices.last() != Some(&name) {
            state.devices.push(name);
        }
        if let Some(saver) = &self.shared.frame.saver {
            saver.device(state.devices.join(" + "));
        }
    }

    /// The next tile of about this size; `Wait` when there may be more later.
    #[cfg(feature = "gpu")]
    pub(crate) fn claim(&self, size: TileSize<'_>) -> Claim {
        self.claim_locked(&mut self.lock(), size)
    }

    fn claim_locked(&self, state: &mut State, size: TileSize<'_>) -> Claim {
        if state.taken {
            return Claim::Done;
        }
        if self.signals.is_cancelled() {
            state.scheduler.stop(Stop::Cancelled);
        }
        let now = self.shared.started.elapsed();
        let first = *state.first.get_or_insert_with(|| {
            self.shared.limit(now, &state.scheduler);
            now
        });
        let has_room = state.sum.has_room();
        state.scheduler.hold(!has_room);
        let claim = state.scheduler.claim(now.saturating_sub(first), size);
        if let Claim::FirstOf(item) = claim {
            let pixels = state.scheduler.pixels(item.samples);
            state.sum.open(item.samples, item.replicate, pixels);
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
                    let wait = self.shared.ended.wait_timeout(state, Duration::from_millis(50));
                    state = wait.unwrap_or_else(PoisonError::into_inner).0;
                }
            }
        }
    }

    /// Takes the pixels of a claimed item, row by row.
    pub(crate) fn deposit(&self, item: &WorkItem, pixels: &[FilmPixel]) {
        let mut state = self.lock();
        if state.taken {
            return;
        }
        let began = self.shared.started.elapsed();
        state.scheduler.finished(item);
        if !item.probe {
            state.sum.deposit(item, pixels);
            let ended = self.shared.started.elapsed();
            state.last = ended;
            state.readback += ended.saturating_sub(began);
            self.track(&mut state);
            if self.strict && pixels.iter().any(|pixel| pixel.n_bad() > 0) {
                state.scheduler.stop(Stop::Failed);
            }
            let rays = pixels.iter().map(|pixel| u64::from(pixel.rays)).sum();
            self.signals.advance(item.cost(), rays);
            if let Some(saver) = &self.shared.frame.saver {
                saver.offer(state.sum.film(), self.shared.started.elapsed());
            }
            if let Some(previewer) = self.shared.previewer() {
                let meta = || self.shared.meta(&state.devices, self.shared.started.elapsed());
                previewer.offer(&state.sum, self.signals, meta);
            }
        }
        drop(state);
        self.shared.ended.notify_all();
    }

    /// Tells a point of the error curve when a round has become whole and one is due.
    fn track(&self, state: &mut State) {
        let now = state.moment();
        let State { sum, tracker: Some(tracker), scheduler, .. } = state else { return };
        let lumas = sum.lumas();
        if !tracker.is_news(lumas.samples) {
            return;
        }
        if let Some(point) = tracker.round(now, &lumas) {
            self.signals.note(&point.to_string());
            match tracker.decide() {
                None => {}
                Some(Decision::UpTo(end)) => {
                    if let Some(allocation) = tracker.allocate(&lumas) {
                        self.signals.note(&allocation.to_string());
                        scheduler.allocate(allocation);
                    }
                    scheduler.up_to(end);
                }
                Some(Decision::Met) => scheduler.stop(Stop::ErrorReached),
            }
        }
    }

    /// A claimed item was not rendered and may be claimed again.
    pub(crate) fn give_back(&self, item: WorkItem) {
        self.lock().scheduler.give_back(item);
        self.shared.ended.notify_all();
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
        if state.taken {
            return;
        }
        state.scheduler.finished(item);
        state.scheduler.stop(Stop::Failed);
        if !item.probe {
            state.sum.give_up(item);
        }
        state.failures.push(TileFailure { tile: item.tile, sample: item.samples.start, message });
        drop(state);
        self.shared.ended.notify_all();
    }

    /// Ends the run now.
    pub(crate) fn abort(&self) {
        self.lock().scheduler.stop(Stop::Failed);
    }

    pub(crate) fn note(&self, text: &str) {
        self.signals.note(text);
    }

    /// What the owner says.
    pub(crate) fn signals(&self) -> &Signals {
        self.signals
    }

    /// Whether anything has been deposited.
    #[cfg(feature = "gpu")]
    pub(crate) fn done(&self) -> u64 {
        self.signals.progress().done
    }
}

impl Shared {
    /// No code panics while it holds the lock; a poisoned one would still hold whole batches.
    fn lock(&self) -> MutexGuard<'_, State> {
        self.state.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// Sets the times that follow from the limit, `first` being that of the first claim.
    fn limit(&self, first: Duration, scheduler: &Scheduler) {
        let micros = |time: Duration| u64::try_from(time.as_micros()).unwrap_or(u64::MAX);
        if let (Some(deadline), Some(limit)) = (scheduler.deadline(), scheduler.limit()) {
            self.deadline.store(micros(first + deadline), Ordering::Relaxed);
            self.overdue.store(micros(first + limit + slack(limit)), Ordering::Relaxed);
        }
    }

    fn is_past(&self, time: &AtomicU64) -> bool {
        let time = time.load(Ordering::Relaxed);
        time != u64::MAX && self.started.elapsed() >= Duration::from_micros(time)
    }

    pub(crate) fn is_overdue(&self) -> bool {
        self.is_past(&self.overdue)
    }

    pub(crate) fn saver(&self) -> Option<&Saver> {
        self.frame.saver.as_ref()
    }

    /// Devices, and the last point of the error curve.
    pub(crate) fn latest(&self) -> (String, Option<Point>) {
        let state = self.lock();
        let point = state.tracker.as_ref().and_then(|tracker| tracker.last().copied());
        (state.devices.join(" + "), point)
    }

    pub(crate) fn previewer(&self) -> Option<&Previewer> {
        self.frame.previewer.as_ref()
    }

    /// What is known of a picture that is not complete, now.
    pub(crate) fn meta_now(&self) -> Meta {
        let devices = self.lock().devices.clone();
        self.meta(&devices, self.started.elapsed())
    }

    /// What is known of a picture that is not complete after `elapsed`, made by `devices`.
    fn meta(&self, devices: &[String], elapsed: Duration) -> Meta {
        Meta {
            device: devices.join(" + "),
            seconds: (self.frame.before + elapsed).as_secs_f64(),
            complete: false,
            ..self.frame.meta.clone()
        }
    }

    /// See `Control::salvage`.
    pub(crate) fn salvage(&self, signals: &Signals) -> Option<Outcome> {
        let cancelled = signals.is_cancelled();
        let why = if cancelled { Stop::Cancelled } else { Stop::TimeLimit };
        let mut state = self.lock();
        if !cancelled && !state.scheduler.is_under_way() {
            return None;
        }
        state.scheduler.stop(why);
        drop(state);
        let finished = self.take()?;
        self.previewer().into_iter().for_each(Previewer::close);
        let error = "the kernel or the driver did not respond in time";
        let error = (!cancelled).then(|| error.to_owned());
        Some(self.outcome(finished, error, signals))
    }

    /// Takes what is complete; `None` when that was done already.
    pub(crate) fn take(&self) -> Option<Finished> {
        let elapsed = self.started.elapsed();
        let mut state = self.lock();
        if std::mem::replace(&mut state.taken, true) {
            return None;
        }
        let stop = state.scheduler.why();
        let (sum, failures) = (state.sum.take(), std::mem::take(&mut state.failures));
        let (tracker, devices) = (state.tracker.take(), std::mem::take(&mut state.devices));
        let compile = state.first.unwrap_or(elapsed).as_secs_f64();
        let readback = state.readback.as_secs_f64();
        #[cfg(feature = "gpu")]
        let device = state.device.filter(|time| !time.is_zero()).map(|time| time.as_secs_f64());
        #[cfg(not(feature = "gpu"))]
        let device = None;
        drop(state);
        let convergence = tracker.map(|tracker| {
            let times = Times { compile, readback, device, ..Times::default() };
            tracker.finish(&sum.lumas(), times)
        });
        Some(Finished { film: sum.finish(), stop, failures, elapsed, convergence, devices })
    }

    /// What a run leaves, framed; its last checkpoint is written if it did not end well.
    pub(crate) fn outcome(
        &self,
        finished: Finished,
        device_error: Option<String>,
        signals: &Signals,
    ) -> Outcome {
        let Finished { mut film, stop, failures, elapsed, convergence, devices } = finished;
        let well = matches!(stop, Stop::Complete | Stop::TimeLimit | Stop::ErrorReached);
        let well = well && device_error.is_none();
        let saver = self.saver();
        if let (Some(saver), false) = (saver, well) {
            film = saver.last(film, elapsed, signals);
        }
        let complete = stop == Stop::Complete && failures.is_empty();
        let meta = Meta { complete, ..self.meta(&devices, elapsed) };
        let elapsed = self.frame.before + elapsed;
        Outcome {
            picture: Picture::new(film, meta),
            stop,
            failures,
            device_error,
            elapsed,
            saved: saver.is_some_and(Saver::has_written),
            checkpoint: saver.and_then(Saver::mark),
            convergence,
        }
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

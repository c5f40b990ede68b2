//! Films on their way → checkpoints, every so often, on a thread of its own.
//!
//! The run offers its film after every tile; a copy is taken only when one is due and another batch
//! is whole, so rendering waits for a copy in memory and never for a disk. What cannot be written is
//! told once and tried again the next time. A checkpoint that is not of this run is kept aside, never
//! replaced.

use crate::checkpoint::Checkpoint;
use crate::film::Film;
use crate::job::Job;
use crate::mark::{Mark, make_way};
use crate::output::Identity;
use crate::region::SampleRange;
use crate::scene::Scene;
use crate::signals::Signals;
use crate::zeros::NoMemory;
use files::ShowPath as _;
use std::error::Error;
use std::path::PathBuf;
use std::sync::{Condvar, Mutex, MutexGuard, PoisonError};
use std::time::{Duration, Instant};

/// How long the end of a run waits for a checkpoint that is being written.
const PATIENCE: Duration = Duration::from_secs(1);

/// Where and how often a run is saved.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Keep {
    /// The file.
    pub path: PathBuf,
    /// Time between two checkpoints.
    pub every: Duration,
}

/// What a run goes on from, and where it is saved.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Session {
    /// What an earlier run left; it must be of this run, see `Checkpoint::check`.
    pub from: Option<Checkpoint>,
    /// Where this run is saved; `None`: nowhere. What is there already is kept under another name, unless
    /// the run goes on `from` a checkpoint: then that is the one.
    pub keep: Option<Keep>,
}

/// Saves one run.
pub(crate) struct Saver {
    keep: Keep,
    identity: Identity,
    samples: SampleRange,
    state: Mutex<State>,
    wake: Condvar,
}

struct State {
    /// When the next checkpoint is due.
    next: Instant,
    /// Last sample of the newest checkpoint, plus one.
    end: u32,
    task: Task,
    over: bool,
    device: String,
    /// Seconds of the runs before this one.
    before: f64,
    /// The checkpoint of this run as it is on the disk.
    own: Option<Mark>,
    written: bool,
    failed: bool,
}

/// What the thread has to do.
enum Task {
    Nothing,
    Write(Result<Box<Checkpoint>, NoMemory>),
    /// It is at it.
    UnderWay,
}

impl Saver {
    pub(crate) fn new(keep: Keep, scene: &Scene, job: &Job, from: Option<&Checkpoint>) -> Self {
        let state = State {
            next: Instant::now() + keep.every,
            end: from.and_then(|from| from.film.ranges.last()).map_or(0, |range| range.end),
            task: Task::Nothing,
            over: false,
            device: String::new(),
            before: from.map_or(0.0, |from| from.seconds),
            own: from.and_then(|_| Mark::of(&keep.path)),
            written: false,
            failed: false,
        };
        Self {
            keep,
            identity: Identity::of(scene, job),
            samples: job.samples,
            state: Mutex::new(state),
            wake: Condvar::new(),
        }
    }

    fn lock(&self) -> MutexGuard<'_, State> {
        self.state.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// The device that renders from now on.
    pub(crate) fn device(&self, name: String) {
        self.lock().device = name;
    }

    /// Takes a copy of the film if it is time to, `elapsed` into the run.
    pub(crate) fn offer(&self, film: &Film, elapsed: Duration) {
        let mut state = self.lock();
        if !matches!(state.task, Task::Nothing) || Instant::now() < state.next {
            return;
        }
        if self.is_news(&state, film) {
            let copy = film.try_clone();
            state.task =
                Task::Write(copy.map(|film| Box::new(self.checkpoint(&state, film, elapsed))));
            drop(state);
            self.wake.notify_all();
        }
    }

    /// Saves what a run that did not end well has left, in this thread, and gives it back.
    pub(crate) fn last(&self, film: Film, elapsed: Duration, signals: &Signals) -> Film {
        let state = self.lock();
        let busy = |state: &mut State| matches!(state.task, Task::UnderWay);
        // A disk that hangs is not waited for.
        let wait = self.wake.wait_timeout_while(state, PATIENCE, busy);
        let state = wait.unwrap_or_else(PoisonError::into_inner).0;
        if matches!(state.task, Task::UnderWay) || !self.is_news(&state, &film) {
            return film;
        }
        let checkpoint = self.checkpoint(&state, film, elapsed);
        drop(state);
        self.write(&checkpoint, signals);
        checkpoint.film
    }

    /// Whether this run has written a checkpoint.
    pub(crate) fn has_written(&self) -> bool {
        self.lock().written
    }

    /// The checkpoint of this run, written by it or by the one that it goes on from.
    pub(crate) fn mark(&self) -> Option<Mark> {
        self.lock().own.clone()
    }

    fn is_news(&self, state: &State, film: &Film) -> bool {
        let end = film.ranges.last().map(|range| range.end);
        end.is_some_and(|end| end > state.end) && Checkpoint::can_hold(film, self.samples)
    }

    fn checkpoint(&self, state: &State, film: Film, elapsed: Duration) -> Checkpoint {
        Checkpoint {
            identity: self.identity.clone(),
            samples: self.samples,
            film,
            device: state.device.clone(),
            seconds: state.before + elapsed.as_secs_f64(),
        }
    }

    /// Writes what is offered until `close`.
    pub(crate) fn work(&self, signals: &Signals) {
        let mut state = self.lock();
        loop {
            match std::mem::replace(&mut state.task, Task::Nothing) {
                Task::Write(checkpoint) => {
                    state.task = Task::UnderWay;
                    drop(state);
                    match checkpoint {
                        Ok(checkpoint) => self.write(&checkpoint, signals),
                        Err(error) => self.warn(&error, signals),
                    }
                    state = self.lock();
                    state.task = Task::Nothing;
                    state.next = Instant::now() + self.keep.every;
                    self.wake.notify_all();
                }
                _ if state.over => return,
                _ => state = self.wake.wait(state).unwrap_or_else(PoisonError::into_inner),
            }
        }
    }

    /// Ends `work`, after what it has taken is written.
    pub(crate) fn close(&self) {
        self.lock().over = true;
        self.wake.notify_all();
    }

    fn write(&self, checkpoint: &Checkpoint, signals: &Signals) {
        // The copy was taken before this is asked, so what is wrong with it is known by now.
        if !signals.may_keep() {
            return;
        }
        let path = &self.keep.path;
        match make_way(path, self.mark().as_ref()) {
            Ok(None) => {}
            Ok(Some(aside)) => {
                let (path, aside) = (path.shown(), aside.shown());
                signals.note(&format!(
                    "{path} belongs to another run and was renamed to {aside}; to resume that one: --resume={aside}"
                ));
            }
            Err(error) => return self.warn(&error, signals),
        }
        if let Err(error) = checkpoint.write(path) {
            return self.warn(&error, signals);
        }
        let mut state = self.lock();
        state.own = Mark::of(path);
        state.written = true;
        state.end = checkpoint.film.ranges.last().map_or(0, |range| range.end);
    }

    fn warn(&self, error: &dyn Error, signals: &Signals) {
        if !std::mem::replace(&mut self.lock().failed, true) {
            let path = self.keep.path.shown();
            signals.note(&format!(
                "warning: cannot write the checkpoint {path}: {error}; rendering continues"
            ));
        }
    }
}

//! What a run and its owner tell each other while it goes on: progress, events, the wish to stop.

use crate::render::Outcome;
use crate::run::Shared;
use std::sync::atomic::{AtomicBool, AtomicU64, Ordering};
use std::sync::{Arc, Mutex, PoisonError};

/// Shared between a run and whoever watches it. Counters only grow.
pub struct Control {
    cancel: AtomicBool,
    total: AtomicU64,
    done: AtomicU64,
    before: AtomicU64,
    rays: AtomicU64,
    /// The run, while it goes on.
    run: Mutex<Option<Arc<Shared>>>,
    observer: Box<Observer>,
    gate: Box<dyn Fn() -> bool + Send + Sync>,
}

/// Is told what happens, on the thread on which it happens.
pub type Observer = dyn Fn(Event<'_>) + Send + Sync;

/// Something that happens in a run.
#[derive(Clone, Copy, Debug)]
pub enum Event<'a> {
    /// One line that is worth telling: which device, what went wrong with it. From any thread.
    Note(&'a str),
    /// The CPU kernel is about to render a block, on the thread that renders it. A panic of the observer is one of
    /// the block.
    Block,
    /// A GPU was opened for the run.
    #[cfg(feature = "gpu")]
    Device(&'a wgpu::Device),
    /// A submission to the GPU is about to be waited for.
    #[cfg(feature = "gpu")]
    Submission,
}

/// How far a run is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Progress {
    /// Pixel samples of the whole job.
    pub total: u64,
    /// Pixel samples that were rendered.
    pub done: u64,
    /// Pixel samples that an earlier run had done already; part of `done`.
    pub before: u64,
    /// Rays that this run traced.
    pub rays: u64,
}

impl Default for Control {
    fn default() -> Self {
        Self::new(|_| ())
    }
}

impl Control {
    /// `observer` is told what happens.
    pub fn new(observer: impl Fn(Event<'_>) + Send + Sync + 'static) -> Self {
        Self {
            cancel: AtomicBool::new(false),
            total: AtomicU64::new(0),
            done: AtomicU64::new(0),
            before: AtomicU64::new(0),
            rays: AtomicU64::new(0),
            run: Mutex::new(None),
            observer: Box::new(observer),
            gate: Box::new(|| true),
        }
    }

    /// `gate` is asked, by any thread, before each checkpoint is written, and may take its time. What was rendered is
    /// kept only if it says yes.
    #[must_use]
    pub fn gated(self, gate: impl Fn() -> bool + Send + Sync + 'static) -> Self {
        Self { gate: Box::new(gate), ..self }
    }

    /// Asks the run to end soon, with every complete batch.
    pub fn cancel(&self) {
        self.cancel.store(true, Ordering::Relaxed);
    }

    /// Whether `cancel` was called.
    #[must_use]
    pub fn is_cancelled(&self) -> bool {
        self.cancel.load(Ordering::Relaxed)
    }

    /// Whether the run should have ended for its time limit: 10 % or one second ago, whatever is longer.
    #[must_use]
    pub fn is_overdue(&self) -> bool {
        self.run().is_some_and(|run| run.is_overdue())
    }

    /// Takes what is complete out of a run that does not end, because a block of the kernel or a driver
    /// does not come back, and saves it where the run was to be saved. It waits for neither. `None` when
    /// there is no run, or it has just ended by itself. The run is over with that: should it come back
    /// after all, it gives `RenderError::Salvaged`.
    #[must_use]
    pub fn salvage(&self) -> Option<Outcome> {
        self.run()?.salvage(self)
    }

    fn run(&self) -> Option<Arc<Shared>> {
        self.run.lock().unwrap_or_else(PoisonError::into_inner).clone()
    }

    pub(crate) fn set_run(&self, run: Option<Arc<Shared>>) {
        *self.run.lock().unwrap_or_else(PoisonError::into_inner) = run;
    }

    /// How far the run is.
    #[must_use]
    pub fn progress(&self) -> Progress {
        let load = |counter: &AtomicU64| counter.load(Ordering::Relaxed);
        Progress {
            total: load(&self.total),
            done: load(&self.done),
            before: load(&self.before),
            rays: load(&self.rays),
        }
    }

    /// Whether what was rendered so far may be kept.
    pub(crate) fn may_keep(&self) -> bool {
        (self.gate)()
    }

    pub(crate) fn tell(&self, event: Event<'_>) {
        (self.observer)(event);
    }

    pub(crate) fn note(&self, text: &str) {
        self.tell(Event::Note(text));
    }

    /// A run of `total` pixel samples begins, of which `before` were done by an earlier one.
    pub(crate) fn begin(&self, total: u64, before: u64) {
        self.before.store(before, Ordering::Relaxed);
        self.done.store(before, Ordering::Relaxed);
        self.total.store(total, Ordering::Relaxed);
    }

    pub(crate) fn advance(&self, samples: u64, rays: u64) {
        self.done.fetch_add(samples, Ordering::Relaxed);
        self.rays.fetch_add(rays, Ordering::Relaxed);
    }
}

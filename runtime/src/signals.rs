//! What a run and its owner tell each other while it goes on: progress, events, the wish to stop.

use std::sync::atomic::{AtomicBool, AtomicU64, Ordering};

/// Shared between a run and its owner. Counters only grow.
pub(crate) struct Signals {
    cancel: AtomicBool,
    total: AtomicU64,
    done: AtomicU64,
    before: AtomicU64,
    rays: AtomicU64,
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

impl Signals {
    /// `observer` is told what happens.
    pub(crate) fn new(observer: impl Fn(Event<'_>) + Send + Sync + 'static) -> Self {
        Self {
            cancel: AtomicBool::new(false),
            total: AtomicU64::new(0),
            done: AtomicU64::new(0),
            before: AtomicU64::new(0),
            rays: AtomicU64::new(0),
            observer: Box::new(observer),
            gate: Box::new(|| true),
        }
    }

    /// With `gate`, which is asked before each checkpoint is written whether what was rendered may be kept.
    pub(crate) fn gated(self, gate: impl Fn() -> bool + Send + Sync + 'static) -> Self {
        Self { gate: Box::new(gate), ..self }
    }

    /// Asks the run to end soon, with every complete batch.
    pub(crate) fn cancel(&self) {
        self.cancel.store(true, Ordering::Relaxed);
    }

    /// Whether `cancel` was called.
    pub(crate) fn is_cancelled(&self) -> bool {
        self.cancel.load(Ordering::Relaxed)
    }

    /// How far the run is.
    pub(crate) fn progress(&self) -> Progress {
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

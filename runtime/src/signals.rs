//! What a run and its owner tell each other while it goes on: progress, notes, the wish to stop.

use std::sync::atomic::{AtomicBool, AtomicU64, Ordering};

/// Shared between a run and its owner. Counters only grow.
pub(crate) struct Signals {
    cancel: AtomicBool,
    total: AtomicU64,
    done: AtomicU64,
    before: AtomicU64,
    rays: AtomicU64,
    /// See `break_block`; 0 is never.
    broken_block: AtomicU64,
    /// See `stall_block`; 0 is never.
    stalled_block: AtomicU64,
    /// See `lose_device`.
    lost_after: AtomicU64,
    losses: AtomicU64,
    /// See `ignore_timestamps`.
    untimed: AtomicBool,
    note: Box<dyn Fn(&str) + Send + Sync>,
    gate: Box<dyn Fn() -> bool + Send + Sync>,
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
    /// `note` gets one line for everything worth telling, from any thread.
    pub(crate) fn new(note: impl Fn(&str) + Send + Sync + 'static) -> Self {
        Self {
            cancel: AtomicBool::new(false),
            total: AtomicU64::new(0),
            done: AtomicU64::new(0),
            before: AtomicU64::new(0),
            rays: AtomicU64::new(0),
            broken_block: AtomicU64::new(0),
            stalled_block: AtomicU64::new(0),
            lost_after: AtomicU64::new(0),
            losses: AtomicU64::new(0),
            untimed: AtomicBool::new(false),
            note: Box::new(note),
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

    /// For tests: the CPU kernel panics in its `n`th block from now, counted from 1.
    pub(crate) fn break_block(&self, n: u64) {
        self.broken_block.store(n, Ordering::Relaxed);
    }

    /// For tests: the `n`th block from now, counted from 1, never comes back; on a GPU the `n`th submission.
    pub(crate) fn stall_block(&self, n: u64) {
        self.stalled_block.store(n, Ordering::Relaxed);
    }

    /// For tests: the next `times` GPU devices are lost after `n` tiles each.
    pub(crate) fn lose_device(&self, n: u64, times: u64) {
        self.lost_after.store(n, Ordering::Relaxed);
        self.losses.store(times, Ordering::Relaxed);
    }

    /// For tests: GPU devices are opened as if they had no timestamps.
    pub(crate) fn ignore_timestamps(&self) {
        self.untimed.store(true, Ordering::Relaxed);
    }

    #[cfg(feature = "gpu")]
    pub(crate) fn ignores_timestamps(&self) -> bool {
        self.untimed.load(Ordering::Relaxed)
    }

    /// Whether the block that begins now is to break.
    pub(crate) fn breaks_now(&self) -> bool {
        let left = |n: u64| n.checked_sub(1);
        self.broken_block.fetch_update(Ordering::Relaxed, Ordering::Relaxed, left) == Ok(1)
    }

    /// Never comes back if the block that begins now is the one to stall.
    pub(crate) fn stall_if_asked(&self) {
        let left = |n: u64| n.checked_sub(1);
        if self.stalled_block.fetch_update(Ordering::Relaxed, Ordering::Relaxed, left) == Ok(1) {
            loop {
                std::thread::park();
            }
        }
    }

    /// Whether a device that has rendered `n` tiles is to be lost now.
    #[cfg(feature = "gpu")]
    pub(crate) fn loses_device_after(&self, n: u64) -> bool {
        let left = |times: u64| times.checked_sub(1);
        n >= self.lost_after.load(Ordering::Relaxed)
            && self.losses.fetch_update(Ordering::Relaxed, Ordering::Relaxed, left).is_ok()
    }

    /// Whether what was rendered so far may be kept.
    pub(crate) fn may_keep(&self) -> bool {
        (self.gate)()
    }

    pub(crate) fn note(&self, text: &str) {
        (self.note)(text);
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

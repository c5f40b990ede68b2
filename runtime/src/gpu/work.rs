//! A submission that has ended, and what bounds the size of the next: what `pace` and `fill` reckon with.

use std::time::Duration;

/// No submission is planned to take longer, whatever was asked for.
pub(super) const CAP: Duration = Duration::from_secs(1);
/// A submission grows at most by this factor over the one before.
pub(super) const GROWTH: f64 = 4.0;

/// A finished submission.
#[derive(Clone, Copy, Debug)]
pub(super) struct Work {
    /// Pixel samples that it was to have: `Pace::next`.
    pub(super) planned: f64,
    /// Pixel samples that it had: fewer at the end of a pass.
    pub(super) samples: u64,
    /// Rays that they took.
    pub(super) rays: u64,
    /// How long it kept the device busy.
    pub(super) busy: Duration,
}

impl Work {
    /// How long it kept the device busy, never 0.
    pub(super) fn seconds(self) -> f64 {
        self.busy.as_secs_f64().max(1e-6)
    }

    /// Whether it had about what was planned: what is left at the end of a pass says nothing of its planned size.
    pub(super) fn is_full(self) -> bool {
        self.samples as f64 >= 0.5 * self.planned
    }
}

//! The owner's end of a run: progress, events, the wish to stop, and what can be saved of one that hangs.

use crate::convergence::Point;
use crate::film::Film;
use crate::job::Job;
use crate::outcome::Outcome;
use crate::preview::Preview;
use crate::run::{Finished, Framing, Run, Shared};
use crate::signals::{Event, Progress, Signals};
use crate::zeros::NoMemory;
use std::sync::{Arc, Mutex, PoisonError};

/// Shared between a run and whoever watches it.
pub struct Control {
    signals: Signals,
    /// The run, while it goes on.
    run: Mutex<Option<Arc<Shared>>>,
    /// Is shown pictures of the run.
    preview: Option<Arc<Preview>>,
}

/// What is known of a run that goes on, beside the counters.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Latest {
    /// Devices that render it, in order.
    pub device: String,
    /// The last point of the error curve, of a run that is measured.
    pub point: Option<Point>,
}

impl Default for Control {
    fn default() -> Self {
        Self::new(|_| ())
    }
}

impl Control {
    /// `observer` is told what happens, from any thread.
    pub fn new(observer: impl Fn(Event<'_>) + Send + Sync + 'static) -> Self {
        Self { signals: Signals::new(observer), run: Mutex::new(None), preview: None }
    }

    /// `gate` is asked, by any thread, before each checkpoint is written, and may take its time. What was rendered is
    /// kept only if it says yes.
    #[must_use]
    pub fn gated(self, gate: impl Fn() -> bool + Send + Sync + 'static) -> Self {
        Self { signals: self.signals.gated(gate), ..self }
    }

    /// `preview` is shown pictures of the run while it goes on; not the last one, which `render` gives. Nothing is
    /// shown before the `gate` has said yes.
    #[must_use]
    pub fn previewed(self, preview: Option<Preview>) -> Self {
        Self { preview: preview.map(Arc::new), ..self }
    }

    /// Asks the run to end soon, with every complete batch.
    pub fn cancel(&self) {
        self.signals.cancel();
    }

    /// Whether `cancel` was called.
    #[must_use]
    pub fn is_cancelled(&self) -> bool {
        self.signals.is_cancelled()
    }

    /// How far the run is.
    #[must_use]
    pub fn progress(&self) -> Progress {
        self.signals.progress()
    }

    /// What is known of the run, while it goes on.
    #[must_use]
    pub fn latest(&self) -> Option<Latest> {
        self.run().map(|run| {
            let (device, point) = run.latest();
            Latest { device, point }
        })
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
        self.run()?.salvage(&self.signals)
    }

    /// Is shown pictures of the run.
    pub(crate) fn preview(&self) -> Option<&Arc<Preview>> {
        self.preview.as_ref()
    }

    pub(crate) fn signals(&self) -> &Signals {
        &self.signals
    }

    /// Begins a run that can be salvaged from here, from `film`, which `Checkpoint::can_hold`, or from nothing.
    pub(crate) fn start(
        &self,
        job: &Job,
        film: Option<Film>,
        frame: Framing,
    ) -> Result<Run<'_>, NoMemory> {
        let run = Run::new(job, &self.signals, film, frame)?;
        self.set_run(Some(Arc::clone(run.shared())));
        Ok(run)
    }

    /// Takes what is complete of `run`, which is over; `None` when that was done already.
    pub(crate) fn finish(&self, run: &Run<'_>) -> Option<Finished> {
        self.set_run(None);
        run.shared().take()
    }

    fn run(&self) -> Option<Arc<Shared>> {
        self.run.lock().unwrap_or_else(PoisonError::into_inner).clone()
    }

    fn set_run(&self, run: Option<Arc<Shared>>) {
        *self.run.lock().unwrap_or_else(PoisonError::into_inner) = run;
    }
}

//! The wgpu backend: adapters, device, upload, and a schedule that measures itself.
//!
//! It turns work items into pixels and nothing else: what to render and what to keep is decided by
//! `run`. Every failure of the device is a value here; the caller decides what to try next.

mod adapter;
mod aovs;
mod busy;
mod device;
mod error;
mod fill;
mod pace;
mod queue;
mod record;
mod slot;
mod stopwatch;
mod trial;
mod upload;
mod work;

pub use self::adapter::{Adapter, adapters, describe};
pub use self::aovs::layers_kernel;
pub(crate) use self::aovs::{aovs, kernel as aov_kernel, tiles as aov_tiles};
pub use self::error::GpuError;

use self::device::{Device, Module};
use self::pace::Pace;
use self::record::Entry;
use self::trial::open;
use crate::job::Job;
use crate::run::Run;
use crate::setup::Setup;
use crate::trust::{Trust, judge};
use std::time::Duration;

/// Losses after which the device is not tried again, unless it rendered something in between.
const MAX_LOSSES: u32 = 3;

/// A device with one kernel, to be used again and again.
pub(crate) struct Ready {
    device: Device,
    pace: Pace,
}

impl Ready {
    /// Without runtime checks: the kernel of `setup` must be known, or be ours.
    pub(crate) fn open(adapter: &Adapter, setup: &Setup<'_>, job: &Job) -> Result<Self, GpuError> {
        let device = open(adapter, setup, (Module::Trusted, Entry::Render), true)?;
        Ok(Self { device, pace: Pace::new(job.submission) })
    }

    /// What building the pipeline took.
    pub(crate) fn built(&self) -> Duration {
        self.device.built
    }

    /// Renders until the run has nothing left, or the device fails.
    pub(crate) fn render(&mut self, setup: &Setup<'_>, run: &Run<'_>) -> Result<(), GpuError> {
        self.device.render(setup, run, &mut self.pace)
    }
}

/// Renders until the run has nothing left, rebuilding the device when it is lost: first as it was
/// wanted, then with checked modules and ever smaller tiles.
pub(crate) fn render(
    adapter: &Adapter,
    setup: &Setup<'_>,
    job: &Job,
    run: &Run<'_>,
) -> Result<(), GpuError> {
    let mut module = match judge(setup) {
        Trust::Known => {
            run.note("kernel: every line is known, runtime checks are off");
            Module::Trusted
        }
        Trust::Unknown { line } => {
            run.note(&format!("kernel: line {line} is not from this rtr, runtime checks are on"));
            Module::Checked
        }
    };
    let mut pace = Pace::new(job.submission);
    let mut losses = 0;
    loop {
        let before = run.done();
        let opened = open(adapter, setup, (module, Entry::Render), job.timestamps);
        let error = match opened.and_then(|mut device| device.render(setup, run, &mut pace)) {
            Ok(()) => return Ok(()),
            Err(error) => error,
        };
        losses = if run.done() > before { 1 } else { losses + 1 };
        let again = match &error {
            GpuError::Lost(_) | GpuError::Wrong(_) | GpuError::Api(_) => losses < MAX_LOSSES,
            GpuError::Kernel(_) => module == Module::Trusted,
            GpuError::Device(_) | GpuError::Limit { .. } | GpuError::Memory(_) => false,
        };
        if !again {
            return Err(error);
        }
        run.note(&format!("{error}; trying again with runtime checks and smaller tiles"));
        module = Module::Checked;
        pace.halve();
        std::thread::sleep(Duration::from_millis(200));
    }
}

//! Scene + job + time → the outcome of a run of which only the time counts: watched and guarded as any other, not saved.

use super::console::{Console, Watched};
use super::exit::Exit;
use super::guard::Guard;
use super::progress::Wanted;
use crate::control::Control;
use crate::job::Job;
use crate::outcome::Outcome;
use crate::region::SampleRange;
use crate::render::{DeviceChoice, render};
use crate::scene::Scene;
use crate::schedule::Stop;
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::Duration;

/// More samples than any time is long.
const ENDLESS: SampleRange = SampleRange { start: 0, end: 1 << 28 };

/// Renders for so long on a device, as `--device` names it; `job` gets the samples and the time. Fails, and has said why,
/// if the user interrupts or the device fails.
pub(super) fn timed(
    console: &Console,
    guard: &Guard,
    (scene, job): (&Scene, &mut Job),
    (device, time): (&str, Duration),
) -> Result<Outcome, Exit> {
    (job.samples, job.time_limit) = (ENDLESS, Some(time));
    let job = &*job;
    let (control, over) = (Control::default(), AtomicBool::new(false));
    let watched = Watched { wanted: Wanted::of(job), change: None };
    let rescue = || {
        if control.is_cancelled() {
            console.give_up();
        }
    };
    let outcome = std::thread::scope(|scope| {
        let watcher = scope.spawn(|| console.watch(&control, &watched, &over, &rescue));
        let choice = DeviceChoice::parse(device);
        let outcome = guard.during(&control, || render(scene, job, &choice, &control));
        over.store(true, Ordering::Relaxed);
        watcher.thread().unpark();
        outcome
    });
    let outcome = outcome?.map_err(|error| console.fail(&error, Exit::World))?;
    if outcome.stop == Stop::Cancelled {
        return Err(Exit::Interrupted);
    }
    if let Some(error) = &outcome.device_error {
        console.warn(&format!("error: {error}"));
        return Err(Exit::World);
    }
    Ok(outcome)
}

//! Renders what a session wants: a quarter of the size first, then half, then all of it, sample by sample.
//!
//! The coarse picture is never broken off, so that there is something to see while a camera is dragged; everything
//! after it is, at once. Steps are as long as the eye is patient.

use super::session::{Session, Task};
use super::state::Progress;
use super::sums::Sums;
use crate::control::Control;
use crate::job::Job;
use crate::outcome::Outcome;
use crate::region::SampleRange;
use crate::render::render;
use crate::replicate::{REPLICATES_U32, replicate_seed};
use std::sync::Arc;
use std::time::{Duration, Instant};

/// Length of a step, once samples are fast enough.
const STEP: Duration = Duration::from_millis(250);
/// A picture of the whole size that comes this soon needs none of half the size before it.
const SOON: Duration = Duration::from_millis(120);

/// Which of the pictures of a scene a run is for.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Pass {
    /// A quarter of the size: rendered to its end whatever happens.
    Quarter,
    /// Half of the size: rendered also when the session is stopped, so that a stopped one can be looked around in.
    Half,
    /// All of it.
    Whole,
}

/// What a run of some samples gives.
enum Step {
    Done(Box<Outcome>, Duration),
    /// Another picture is wanted by now.
    Stale,
    Failed(String),
}

/// Begins to render what the session wants, until it is over.
///
/// # Errors
/// When the system gives no thread.
pub fn start(session: &Arc<Session>) -> std::io::Result<()> {
    let session = Arc::clone(session);
    let thread = std::thread::Builder::new().name("rtr-view".to_owned());
    thread.spawn(move || work(&session)).map(drop)
}

fn work(session: &Session) {
    let mut epoch = 0;
    while let Some(task) = session.next_task(epoch) {
        epoch = task.epoch;
        if let Err(message) = picture(session, &task) {
            session.give_up(epoch, message);
        }
    }
}

/// One picture, until it is done or another one is wanted.
fn picture(session: &Session, task: &Task) -> Result<(), String> {
    let mut expected = Duration::MAX;
    for (pass, divisor) in [(Pass::Quarter, 4), (Pass::Half, 2)] {
        if expected <= SOON {
            break;
        }
        let size = task.job.image_size.map(|side| side.div_ceil(divisor));
        let mut job = resized(&task.job, size);
        // The first picture of a scene does not wait for the tree that the others walk.
        job.way.by_hand =
            pass != Pass::Quarter || task.scene.finished_tree(job.way.width()).is_some();
        match step(session, task, &job, pass)? {
            None => return Ok(()),
            Some((outcome, took)) => {
                let mut sums = Sums::new(size).map_err(|error| format!("error: {error}"))?;
                sums.add(outcome.film(), 0);
                let progress =
                    Progress { rays_per_second: rate(&outcome, took), ..Progress::default() };
                session.publish(task, size, &sums, progress);
                expected = took * divisor * divisor;
            }
        }
    }
    whole(session, task)
}

/// The picture of the whole size.
fn whole(session: &Session, task: &Task) -> Result<(), String> {
    let size = task.job.image_size;
    let mut sums = Sums::new(size).map_err(|error| format!("error: {error}"))?;
    let (mut most, mut spent, mut rays) = (1, Duration::ZERO, 0);
    let mut error = None;
    while sums.samples() < task.spp {
        let left = (task.spp - sums.samples()).div_ceil(REPLICATES_U32);
        let (replicate, samples) = sums.next(most.min(left));
        let seed = replicate_seed(task.job.seed, replicate);
        let job = Job { samples, seed, ..task.job.clone() };
        let Some((outcome, took)) = step(session, task, &job, Pass::Whole)? else { return Ok(()) };
        sums.add(outcome.film(), replicate);
        spent += took;
        rays += outcome.film().counters.rays;
        let sample = spent / sums.samples().max(1);
        most = samples_in(STEP, sample);
        error = sums.error().or(error);
        let left = task.spp.saturating_sub(sums.samples());
        let progress = Progress {
            done: left == 0,
            error,
            rays_per_second: rays as f64 / spent.as_secs_f64().max(1e-9),
            seconds: spent.as_secs_f64(),
            seconds_left: Some((sample * left).as_secs_f64()),
        };
        session.publish(task, size, &sums, progress);
    }
    Ok(())
}

/// Renders a job, if its picture is still wanted; `None` if not.
fn step(
    session: &Session,
    task: &Task,
    job: &Job,
    pass: Pass,
) -> Result<Option<(Box<Outcome>, Duration)>, String> {
    match run(session, task, job, pass) {
        Step::Done(outcome, took) => Ok(Some((outcome, took))),
        Step::Stale => Ok(None),
        Step::Failed(message) => Err(message),
    }
}

fn run(session: &Session, task: &Task, job: &Job, pass: Pass) -> Step {
    let control = Arc::new(Control::default());
    if pass == Pass::Whole && !session.wait_for_go(task.epoch) {
        return Step::Stale;
    }
    if !session.begin(task.epoch, (pass != Pass::Quarter).then_some(&control)) {
        return Step::Stale;
    }
    let began = Instant::now();
    match render(&task.scene, job, session.device(), &control) {
        Err(error) => Step::Failed(format!("error: {error}")),
        Ok(outcome) => match (outcome.failures.first(), &outcome.device_error) {
            (Some(failure), _) => Step::Failed(format!(
                "error: bug in rtr: block {} from sample {} failed: {}",
                failure.tile, failure.sample, failure.message
            )),
            (None, Some(error)) => Step::Failed(format!("error: {error}")),
            // What was broken off lacks pixels.
            (None, None) if outcome.film().samples().0 < job.samples.count() => Step::Stale,
            (None, None) => Step::Done(Box::new(outcome), began.elapsed()),
        },
    }
}

fn resized(job: &Job, size: [u32; 2]) -> Job {
    let mut job = Job { samples: SampleRange { start: 0, end: 1 }, ..job.clone() };
    job.resize(size);
    job
}

/// Samples that fit into `time`, at least one.
fn samples_in(time: Duration, sample: Duration) -> u32 {
    let samples = time.as_micros() / sample.as_micros().max(1);
    u32::try_from(samples).unwrap_or(u32::MAX).max(1)
}

fn rate(outcome: &Outcome, took: Duration) -> f64 {
    outcome.film().counters.rays as f64 / took.as_secs_f64().max(1e-9)
}

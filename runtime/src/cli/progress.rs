//! How far a run is → what is said of that: a text for people, a line of JSON for programs.
//!
//! The JSON is described in `docs/json.md`. This module reads no clock and prints nothing.

use crate::control::Latest;
use crate::convergence::Point;
use crate::job::Job;
use crate::outcome::Outcome;
use crate::signals::Progress;
use serde::Serialize;
use std::time::Duration;

/// What turns counters into text.
#[derive(Clone, Copy, Debug)]
pub(super) struct Wanted {
    /// Samples of every pixel of the whole job.
    pub(super) spp: u32,
    /// When the run is going to stop anyway.
    pub(super) limit: Option<Duration>,
}

impl Wanted {
    pub(super) fn of(job: &Job) -> Self {
        Self { spp: job.spp(), limit: job.time_limit }
    }
}

/// `12.4 of 64 spp, 3.21 Mrays/s, 1m05s left`.
pub(super) fn text(progress: Progress, wanted: &Wanted, elapsed: Duration) -> String {
    let spp = spp(progress, wanted);
    let rate = mrays(progress.rays, elapsed);
    let mut text = format!("{spp:.1} of {} spp, {rate:.2} Mrays/s", wanted.spp);
    if let Some(left) = left(progress, wanted, elapsed)
        && let Ok(left) = Duration::try_from_secs_f64(left)
    {
        text += ", ";
        text += &duration_text(left);
        text += " left";
    }
    text
}

/// Samples of a pixel, on average.
fn spp(progress: Progress, wanted: &Wanted) -> f64 {
    progress.done as f64 / progress.total.max(1) as f64 * f64::from(wanted.spp)
}

/// Seconds to the end, as far as is known.
fn left(progress: Progress, wanted: &Wanted, elapsed: Duration) -> Option<f64> {
    // What an earlier run did says nothing about the speed of this one.
    let done = progress.done.saturating_sub(progress.before) as f64;
    let to_do = progress.total.saturating_sub(progress.done) as f64;
    let left = (done > 0.0).then(|| elapsed.as_secs_f64() * to_do / done);
    let until = wanted.limit.map(|limit| limit.saturating_sub(elapsed).as_secs_f64());
    match (left, until) {
        (Some(left), Some(until)) => Some(left.min(until)),
        (left, until) => left.or(until),
    }
}

/// Millions of rays a second.
pub(super) fn mrays(rays: u64, elapsed: Duration) -> f64 {
    rays as f64 / 1e6 / elapsed.as_secs_f64().max(1e-9)
}

/// `0.52s`, `12.3s`, `1m05s`, `2h05m`.
pub(super) fn duration_text(duration: Duration) -> String {
    let seconds = duration.as_secs_f64();
    let whole = duration.as_secs();
    match whole {
        0..10 => format!("{seconds:.2}s"),
        10..60 => format!("{seconds:.1}s"),
        60..3600 => format!("{}m{:02}s", whole / 60, whole % 60),
        _ => format!("{}h{:02}m", whole / 3600, whole / 60 % 60),
    }
}

/// A line of `--progress json`.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub(super) struct Line {
    schema: &'static str,
    /// Why the run ended; `null` while it goes on.
    stop: Option<&'static str>,
    /// Samples of a pixel, on average.
    spp: f64,
    spp_wanted: u32,
    /// Samples of all pixels.
    samples: u64,
    samples_wanted: u64,
    /// Since the run began, without those that it resumed.
    seconds: f64,
    /// Rays that this run traced.
    rays: u64,
    rays_per_second: f64,
    /// Relative error; `null` where it is not measured, or not yet.
    rel: Option<f64>,
    rel_lo: Option<f64>,
    rel_hi: Option<f64>,
    p95: Option<f64>,
    /// Seconds to the end, as far as is known.
    eta: Option<f64>,
    device: String,
}

/// Name of the lines of `--progress json`, and their version.
const SCHEMA: &str = "rtr.progress/1";

impl Line {
    /// Of a run that goes on.
    pub(super) fn of(
        progress: Progress,
        wanted: &Wanted,
        elapsed: Duration,
        latest: Option<Latest>,
    ) -> Self {
        let Latest { device, point } = latest.unwrap_or_default();
        let seconds = elapsed.as_secs_f64();
        let error = |of: fn(&Point) -> f64| point.as_ref().map(of).filter(|x| x.is_finite());
        Self {
            schema: SCHEMA,
            stop: None,
            spp: spp(progress, wanted),
            spp_wanted: wanted.spp,
            samples: progress.done,
            samples_wanted: progress.total,
            seconds,
            rays: progress.rays,
            rays_per_second: 1e6 * mrays(progress.rays, elapsed),
            rel: error(|point| point.noise.rel),
            rel_lo: error(|point| point.noise.rel_lo),
            rel_hi: error(|point| point.noise.rel_hi),
            p95: error(|point| point.noise.p95),
            eta: left(progress, wanted, elapsed),
            device,
        }
    }

    /// Of a run that has ended: the last line.
    pub(super) fn ended(progress: Progress, job: &Job, outcome: &Outcome) -> Self {
        let film = outcome.film();
        let point = outcome.convergence.as_ref().and_then(|curve| curve.points.last().copied());
        let latest = Latest { device: outcome.picture.meta.device.clone(), point };
        // What is complete counts now.
        let (done, rays) = (film.total_samples(), film.counters.rays);
        let progress = Progress { done, rays, ..progress };
        let line = Self::of(progress, &Wanted::of(job), outcome.elapsed, Some(latest));
        Self { stop: Some(outcome.stop.name()), eta: None, ..line }
    }

    /// One line, without a line break.
    pub(super) fn json(&self) -> String {
        serde_json::to_string(self).expect("numbers and texts can be written")
    }
}

/// Anything else that is said where programs read: one line, without a line break.
pub(super) fn message(text: &str) -> String {
    let (level, message) = ["error", "warning"]
        .iter()
        .find_map(|level| Some((*level, text.strip_prefix(level)?.strip_prefix(": ")?)))
        .unwrap_or(("note", text));
    let object = serde_json::json!({
        "schema": "rtr.message/1", "level": level, "message": message,
    });
    object.to_string()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn progress_names_samples_rate_and_time_left() {
        let progress = Progress { total: 6400, done: 1600, before: 0, rays: 30_000_000 };
        let wanted = Wanted { spp: 64, limit: None };
        let said = text(progress, &wanted, Duration::from_secs(10));
        assert_eq!(said, "16.0 of 64 spp, 3.00 Mrays/s, 30.0s left");
        let wanted = Wanted { limit: Some(Duration::from_secs(15)), ..wanted };
        let said = text(progress, &wanted, Duration::from_secs(10));
        assert_eq!(said, "16.0 of 64 spp, 3.00 Mrays/s, 5.00s left");
        let (progress, wanted) =
            (Progress { before: 1200, ..progress }, Wanted { limit: None, ..wanted });
        let said = text(progress, &wanted, Duration::from_secs(10));
        assert_eq!(said, "16.0 of 64 spp, 3.00 Mrays/s, 2m00s left");
    }

    #[test]
    fn durations_stay_short() {
        let text = |seconds| duration_text(Duration::from_secs_f64(seconds));
        assert_eq!(text(0.523), "0.52s");
        assert_eq!(text(65.0), "1m05s");
        assert_eq!(text(7500.0), "2h05m");
    }

    #[test]
    fn a_line_for_programs_is_one_object_with_everything() {
        let progress = Progress { total: 6400, done: 1600, before: 0, rays: 30_000_000 };
        let wanted = Wanted { spp: 64, limit: None };
        let line = Line::of(progress, &wanted, Duration::from_secs(10), None).json();
        let expected = r#"{"schema":"rtr.progress/1","stop":null,"spp":16.0,"spp_wanted":64,"samples":1600,"samples_wanted":6400,"seconds":10.0,"rays":30000000,"rays_per_second":3000000.0,"rel":null,"rel_lo":null,"rel_hi":null,"p95":null,"eta":30.0,"device":""}"#;
        assert_eq!(line, expected);
        let said = message("error: a \"b\"\n");
        assert_eq!(said, r#"{"level":"error","message":"a \"b\"\n","schema":"rtr.message/1"}"#);
        assert!(message("device: CPU").contains(r#""level":"note","message":"device: CPU""#));
    }
}

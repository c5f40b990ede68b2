//! Rounds of replicates → points of the error curve, and when the picture is good enough.
//!
//! It reads no clock: the run says what time it is. Points lie at 4, 8, ... 64 samples, then at every
//! 1.25-fold time, never so close that measuring takes more than 0.5 % of the time. Where there is a goal
//! more of them lie where it may be met; these follow from the samples alone, and so does the end of the run.

use super::estimate::{Noise, noise, squared_error};
use super::goal::{Goal, Measure, Quantity};
use super::reference::Versus;
use crate::allocation::Allocation;
use crate::film::Lumas;
use crate::replicate::REPLICATES_U32;
use std::fmt;
use std::time::{Duration, Instant};

/// Samples up to which every doubling is a point, and below which no run is good enough.
const EARLY: u32 = 64;
/// Between two later points.
const STEP: f64 = 1.25;
/// Time between two points over the time that one takes: 0.5 %.
const PATIENCE: f64 = 200.0;
/// Points behind a slope.
const SLOPE_POINTS: usize = 4;

/// Samples of a replicate between two decisions are a multiple of this ...
const GRAIN: u32 = 4;
/// ... and at least this share of those that there are.
const LEAST: u32 = 32;

impl Goal {
    /// The square of what there is over what is wanted: how many times as many samples plain Monte Carlo needs.
    fn excess(&self, noise: &Noise) -> f64 {
        let value = match self.quantity {
            Quantity::Rel => noise.rel_safe(),
            Quantity::P95 => noise.p95,
        };
        (value / self.limit).powi(2)
    }
}

/// What to do after a round at which the goal was to be looked at.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Decision {
    /// Render up to so many samples of each replicate and look again.
    UpTo(u32),
    /// The goal is met.
    Met,
}

/// When to look again, after `samples` of each replicate: most of the way to where the goal is expected. Well
/// spread samples get there sooner than plain Monte Carlo, and the error is not known well to begin with.
fn look_again(samples: u32, excess: f64) -> u32 {
    // Not a number, too: then nothing is known.
    let factor = if excess < 2.0_f64.powf(4.0 / 3.0) { excess.powf(0.75) } else { 2.0 };
    #[expect(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "saturates, 0 or more"
    )]
    let more = (f64::from(samples) * (factor - 1.0)) as u32;
    let more = more.clamp((samples / LEAST).max(1), 1 << 31).next_multiple_of(GRAIN);
    samples.saturating_add(more)
}

/// One point of an error curve.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Point {
    /// Seconds of rendering: from the first tile, without the time that points took.
    pub t_render: f64,
    /// Seconds since the device was asked for.
    pub t_total: f64,
    /// Samples of every pixel, all replicates together.
    pub spp: u32,
    /// Samples of all pixels.
    pub samples: u64,
    /// Rays traced.
    pub rays: u64,
    /// Samples that were not finite.
    pub bad: u64,
    /// The error.
    pub noise: Noise,
    /// The error against the reference.
    pub versus: Option<Versus>,
    /// Exponent of `rel` over time, from the last four points.
    pub slope: Option<f64>,
}

impl Point {
    /// Figure of merit `1 / (rel^2 t)`, per second; twice as large: half the time for the same error.
    #[must_use]
    pub fn fom(&self) -> f64 {
        1.0 / (self.noise.rel * self.noise.rel * self.t_render)
    }

    /// Seconds to an error of 1 %, if it goes on to fall with the root of time.
    #[must_use]
    pub fn ttu(&self) -> f64 {
        self.noise.rel * self.noise.rel * self.t_render / 1e-4
    }
}

/// `12.4 s  256 spp  rel 0.0131 [0.0129,0.0133]  p95 0.041  slope -0.58  1 % in ~18 s  ...`.
impl fmt::Display for Point {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Noise { rel, rel_lo, rel_hi, p95, .. } = self.noise;
        let slope = self.slope.map_or("-".to_owned(), |slope| format!("{slope:.2}"));
        let [t, rel, lo, hi] = [self.t_render, rel, rel_lo, rel_hi].map(|x| digits(x, 3));
        let [p95, ttu, fom] =
            [(p95, 2), (self.ttu(), 2), (self.fom(), 3)].map(|(x, n)| digits(x, n));
        write!(f, "{t} s  {} spp  rel {rel} [{lo},{hi}]  p95 {p95}  slope {slope}", self.spp)?;
        write!(f, "  1 % in ~{ttu} s  fom {fom}/s  nan {}", self.bad)?;
        if let Some(versus) = &self.versus {
            write!(f, "  reference {} ({})", digits(versus.rel, 3), versus.verdict())?;
        }
        if self.noise.is_heavy_tailed() {
            write!(f, "  heavy tail: error bar is a lower bound")?;
        }
        Ok(())
    }
}

/// `x` with `n` significant digits, never in powers of ten.
pub(super) fn digits(x: f64, n: i32) -> String {
    if x == 0.0 || !x.is_finite() {
        return format!("{x}");
    }
    #[expect(clippy::cast_possible_truncation, reason = "a decimal exponent is small")]
    let exponent = x.abs().log10().floor() as i32;
    let decimals = usize::try_from(n - 1 - exponent).unwrap_or(0).min(12);
    format!("{x:.decimals$}")
}

/// Where the time of a run went, in seconds.
#[derive(Clone, Copy, Debug, Default, PartialEq, serde::Serialize)]
pub struct Times {
    /// Opening and checking the pack; known to the command line only.
    pub load: f64,
    /// From asking for the device to the first tile: uploads, and on a GPU the compiler.
    pub compile: f64,
    /// From the first tile to the end of the first round.
    pub first_frame: f64,
    /// From the first tile to the end, without `estimate`.
    pub render: f64,
    /// Adding finished tiles to the sums, on a GPU out of its mapped memory; part of `render`.
    pub readback: f64,
    /// What the GPU's own timestamps say that its passes took, all added up; part of `render`. `None` on the CPU and
    /// where the GPU has not timed every pass.
    pub device: Option<f64>,
    /// Measuring the points.
    pub estimate: f64,
    /// Writing pictures; known to the command line only.
    pub write: f64,
}

/// What a run that is measured gives beside the picture.
#[derive(Clone, Debug, PartialEq)]
pub struct Convergence {
    /// The error curve, in order of time.
    pub points: Vec<Point>,
    /// Where the time went.
    pub times: Times,
    /// What was to be reached.
    pub goal: Option<Goal>,
}

/// What the run knows when a round is whole.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Moment {
    /// Since the first tile.
    pub(crate) elapsed: Duration,
    /// Since the run began.
    pub(crate) total: Duration,
    pub(crate) rays: u64,
    pub(crate) bad: u64,
}

/// Measures one run.
#[derive(Debug)]
pub(crate) struct Tracker {
    measure: Measure,
    /// Columns of the picture.
    width: u32,
    points: Vec<Point>,
    /// Seconds of rendering at which the next point is due.
    next: f64,
    first_frame: f64,
    estimate: Duration,
    /// Samples of the rounds that are whole.
    seen: u32,
    /// When the last one became so.
    latest: Moment,
    /// Samples of each replicate at which the goal is looked at next.
    decision: Option<u32>,
}

impl Tracker {
    pub(crate) fn new(measure: Measure, width: u32) -> Self {
        let (points, estimate) = (Vec::new(), Duration::ZERO);
        let latest = Moment::default();
        let decision = measure.goal.map(|_| EARLY / REPLICATES_U32);
        Self {
            measure,
            width,
            points,
            next: 0.0,
            first_frame: 0.0,
            estimate,
            seen: 0,
            latest,
            decision,
        }
    }

    /// Whether rounds up to `samples` samples were not seen yet.
    pub(crate) fn is_news(&mut self, samples: u32) -> bool {
        std::mem::replace(&mut self.seen, samples) != samples
    }

    /// A round is whole: each sum is of `samples` samples. Gives a point when one is due.
    pub(crate) fn round(&mut self, now: Moment, lumas: &Lumas<'_>) -> Option<&Point> {
        let samples = lumas.samples;
        self.latest = now;
        if self.first_frame == 0.0 {
            self.first_frame = now.elapsed.as_secs_f64();
        }
        let spp = samples * REPLICATES_U32;
        let early = spp <= EARLY && spp.is_power_of_two();
        let seconds = self.rendering(now);
        let decides = self.decision.is_some_and(|decision| samples >= decision);
        if !early && !decides && seconds < self.next {
            return None;
        }
        let began = Instant::now();
        self.measure(now, lumas);
        let cost = began.elapsed();
        self.estimate += cost;
        self.next = (seconds * STEP).max(seconds + PATIENCE * cost.as_secs_f64());
        self.points.last()
    }

    /// The last point.
    pub(crate) fn last(&self) -> Option<&Point> {
        self.points.last()
    }

    /// Seconds of rendering.
    fn rendering(&self, now: Moment) -> f64 {
        now.elapsed.saturating_sub(self.estimate).as_secs_f64()
    }

    fn measure(&mut self, now: Moment, lumas: &Lumas<'_>) {
        let (sums, scale) = lumas.means();
        let noise = noise(&sums, scale);
        let reference = self.measure.reference.as_ref();
        let samples = lumas.total();
        let spp = samples.checked_div(sums.len() as u64).unwrap_or(0);
        self.points.push(Point {
            t_render: self.rendering(now),
            t_total: now.total.as_secs_f64(),
            spp: u32::try_from(spp).unwrap_or(u32::MAX),
            samples,
            rays: now.rays,
            bad: now.bad,
            noise,
            versus: reference.map(|reference| reference.judge(&sums, scale, noise.e)),
            slope: None,
        });
        let slope = slope(&self.points);
        if let Some(point) = self.points.last_mut() {
            point.slope = slope;
        }
    }

    /// Samples of each replicate that may be rendered before the next decision, if there is a goal.
    pub(crate) fn decision(&self) -> Option<u32> {
        self.decision
    }

    /// What the last point means for the goal, if that was to be looked at.
    pub(crate) fn decide(&mut self) -> Option<Decision> {
        let (goal, decision) = (self.measure.goal?, self.decision?);
        let point = self.points.last()?;
        let samples = self.seen;
        if samples < decision {
            return None;
        }
        let excess = goal.excess(&point.noise);
        if excess <= 1.0 {
            return Some(Decision::Met);
        }
        let next = look_again(samples, excess);
        self.decision = Some(next);
        Some(Decision::UpTo(next))
    }

    /// Which parts of the picture get fewer samples, if that is wanted and not said yet.
    pub(crate) fn allocate(&mut self, lumas: &Lumas<'_>) -> Option<Allocation> {
        if !std::mem::take(&mut self.measure.adaptive) {
            return None;
        }
        let (sums, scale) = lumas.means();
        let e = self.points.last()?.noise.e;
        let squares: Vec<f64> = sums.iter().map(|sums| squared_error(sums, scale, e)).collect();
        Some(Allocation::new(&squares, self.width))
    }

    /// The curve, with a point at the end of it.
    pub(crate) fn finish(mut self, lumas: &Lumas<'_>, times: Times) -> Convergence {
        let last = self.points.last().map_or(0, |point| point.samples);
        if lumas.samples > 0 && last != lumas.total() {
            let began = Instant::now();
            self.measure(self.latest, lumas);
            self.estimate += began.elapsed();
        }
        let times = Times {
            first_frame: self.first_frame,
            render: self.points.last().map_or(0.0, |point| point.t_render),
            estimate: self.estimate.as_secs_f64(),
            ..times
        };
        Convergence { points: self.points, times, goal: self.measure.goal }
    }
}

/// Least squares of `log rel` on `log t` over the last four points.
fn slope(points: &[Point]) -> Option<f64> {
    let last = points.len().checked_sub(SLOPE_POINTS).map(|first| &points[first..])?;
    let logs: Vec<_> = last.iter().map(|p| (p.t_render.ln(), p.noise.rel.ln())).collect();
    let n = logs.len() as f64;
    let (x0, y0) = (
        logs.iter().map(|(x, _)| x).sum::<f64>() / n,
        logs.iter().map(|(_, y)| y).sum::<f64>() / n,
    );
    let above = logs.iter().map(|(x, y)| (x - x0) * (y - y0)).sum::<f64>();
    let below = logs.iter().map(|(x, _)| (x - x0) * (x - x0)).sum::<f64>();
    Some(above / below).filter(|slope| slope.is_finite())
}

#[cfg(test)]
mod tests {
    use super::*;

    fn point(t_render: f64, rel: f64) -> Point {
        let noise =
            Noise { rel, rel_lo: 0.9 * rel, rel_hi: 1.1 * rel, p95: 3.0 * rel, ..Noise::default() };
        Point {
            t_render,
            t_total: t_render,
            spp: 256,
            samples: 0,
            rays: 0,
            bad: 0,
            noise,
            versus: None,
            slope: None,
        }
    }

    fn tracker(goal: &str, points: Vec<Point>) -> Tracker {
        let measure = Measure { goal: Some(goal.parse().unwrap()), ..Measure::default() };
        let seen = points.last().map_or(0, |point| point.spp / REPLICATES_U32);
        Tracker { points, seen, ..Tracker::new(measure, 8) }
    }

    #[test]
    fn a_goal_is_met_by_the_error_and_its_standard_error() {
        // The interval ends at 1.1 times the error: its square is 0.21 above, a standard error is 0.107.
        let safe = 0.009 * 1.107_f64.sqrt();
        assert!((point(1.0, 0.009).noise.rel_safe() - safe).abs() < 1e-6);
        let decide = |goal: &str, point| tracker(goal, vec![point]).decide();
        assert_eq!(decide("0.0095", point(1.0, 0.009)), Some(Decision::Met));
        assert_eq!(decide("p95:0.028", point(1.0, 0.009)), Some(Decision::Met));
        assert_eq!(decide("p95:0.026", point(1.0, 0.009)), Some(Decision::UpTo(68)));
        let few = Point { spp: 32, ..point(1.0, 0.009) };
        assert_eq!(decide("0.0095", few), None);
        let unknown = point(1.0, f64::NAN);
        assert_eq!(decide("0.0095", unknown), Some(Decision::UpTo(128)));
    }

    #[test]
    fn decisions_come_closer_together_near_the_goal() {
        assert_eq!(look_again(16, 1.01), 20);
        assert_eq!(look_again(16, 100.0), 32);
        assert_eq!(look_again(64, f64::INFINITY), 128);
        assert_eq!(look_again(6400, 1.0001), 6600);
        // 1.5^0.75 = 1.355.
        assert_eq!(look_again(1000, 1.5), 1356);
        assert_eq!(look_again(u32::MAX - 1, 4.0), u32::MAX);
    }

    #[test]
    fn goals_are_read_and_nonsense_is_refused() {
        assert_eq!("p95:0.05".parse(), Ok(Goal { quantity: Quantity::P95, limit: 0.05 }));
        assert_eq!("0.01".parse::<Goal>().unwrap().to_string(), "rel 0.01");
        for text in ["", "0", "-1", "nan", "inf", "p96:1", "p95:", "1%"] {
            assert!(text.parse::<Goal>().is_err(), "{text}");
        }
    }

    #[test]
    fn the_slope_of_a_power_is_its_exponent() {
        let at = |t: f64| point(t, 0.3 * t.powf(-0.75));
        let points: Vec<_> = [1.0, 1.3, 2.0, 3.0, 5.0].map(at).into();
        assert!((slope(&points).unwrap() + 0.75).abs() < 1e-9);
        assert_eq!(slope(&points[..3]), None);
        assert_eq!(slope(&[point(1.0, 0.0); 4]), None);
    }

    #[test]
    fn a_line_has_the_numbers_that_matter() {
        let point = Point { slope: Some(-0.576), ..point(12.41, 0.01312) };
        let text = "12.4 s  256 spp  rel 0.0131 [0.0118,0.0144]  p95 0.039  slope -0.58  \
                    1 % in ~21 s  fom 468/s  nan 0";
        assert_eq!(point.to_string(), text);
        assert_eq!(digits(0.000_123_45, 2), "0.00012");
        assert_eq!(digits(12345.0, 3), "12345");
    }

    #[test]
    fn points_come_at_doublings_first_and_then_with_time() {
        let mut tracker = Tracker::new(Measure::default(), 4);
        let sums = [[1.0, 2.0, 3.0, 4.0]; 16];
        let mut spp = Vec::new();
        for samples in [1, 2, 4, 8, 16].into_iter().chain((40..=320).step_by(16)) {
            let elapsed = Duration::from_secs(u64::from(samples));
            let now = Moment { elapsed, total: elapsed, rays: 0, bad: 0 };
            let counts = [4 * samples; 16];
            let lumas = Lumas { sums: &sums, samples, counts: &counts };
            spp.extend(tracker.round(now, &lumas).map(|point| point.spp));
        }
        // After 16 s at every 1.25-fold time, at the next multiple of 16 s after 40 s.
        assert_eq!(spp, [4, 8, 16, 32, 64, 160, 224, 288, 416, 544, 736, 928, 1184]);
    }
}

//! An error curve and where it comes from → JSON and CSV.
//!
//! JSON is one object with everything, CSV one row a point. Numbers that do not exist are `null` in
//! the one and empty in the other.

use crate::convergence::{Convergence, Point, Times};
use crate::job::Job;
use crate::left_out::LeftOut;
use crate::outcome::Outcome;
use crate::replicate::REPLICATES;
use crate::scene::Scene;
use serde::Serialize;

/// Columns of the CSV file. `flip` stays empty, see `docs/error.md`.
const COLUMNS: &str = "t_render_s,t_total_s,spp,samples,rays,mrays_per_s,rmse,rel,rel_lo,rel_hi,\
    p95,top,fom,ttu_s,slope,nan,ref_rmse,ref_rel,ref_rel_trim,flip,bias2,smape,z";

/// Pixels of the image and of the part that was rendered.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Resolution {
    /// The whole image.
    pub image: [u32; 2],
    /// Column, row, columns, rows.
    pub crop: [u32; 4],
}

/// Everything that a report says.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Report {
    /// Name of this kind of document and its version, see `docs/json.md`.
    pub schema: &'static str,
    /// Of `rtr`.
    pub version: &'static str,
    /// Hexadecimal name of what was rendered.
    pub scene: String,
    /// What the kernel of the pack was compiled with; all else was left out.
    pub features: Vec<&'static str>,
    /// The commit that `rtr` was built from, where that is known.
    pub commit: Option<&'static str>,
    /// What is in the kernel, why, and what was left out of it.
    pub kernel: LeftOut,
    /// Devices that rendered it.
    pub device: String,
    /// Seed of the first replicate.
    pub seed: u32,
    /// Pictures of independent noise.
    pub replicates: usize,
    /// What indirect light was clamped to, and the share of the light that this has taken away; `null` where it
    /// was not.
    pub clamp_indirect: Option<Clamped>,
    /// Size of the picture.
    pub resolution: Resolution,
    /// Why it ended: `complete`, `time limit`, `error reached`, `interrupted`, `failed`.
    pub stop: &'static str,
    /// The error that was asked for.
    pub goal: Option<String>,
    /// Where the time went, in seconds.
    pub times: Times,
    /// What was counted.
    pub counters: Counts,
    /// The curve.
    pub checkpoints: Vec<Row>,
}

/// What `--clamp-indirect` has done.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Clamped {
    /// Largest channel of the indirect light of a sample.
    pub most: f32,
    /// Share of all light that was taken away, from 0 to 1.
    pub removed: f64,
}

/// What was counted over the whole run.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
pub struct Counts {
    /// Rays traced.
    rays: u64,
    /// Samples that were not finite.
    nan: u64,
    /// Segments of the longest path.
    longest_path: u32,
    /// Times that a path was inside of more things than it can remember.
    medium_overflow: u64,
    /// Times that a path left a thing that it had never entered.
    medium_leaks: u64,
}

/// One point, as files name its numbers.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Row {
    t_render_s: f64,
    t_total_s: f64,
    spp: u32,
    samples: u64,
    rays: u64,
    mrays_per_s: f64,
    mean: f64,
    e: f64,
    rmse: f64,
    rel: f64,
    rel_lo: f64,
    rel_hi: f64,
    p95: f64,
    top: f64,
    kurtosis: f64,
    heavy_tail: bool,
    fom: f64,
    ttu_s: f64,
    slope: Option<f64>,
    nan: u64,
    ref_rmse: Option<f64>,
    ref_rel: Option<f64>,
    ref_rel_trim: Option<f64>,
    smape: Option<f64>,
    bias2: Option<f64>,
    z: Option<f64>,
    verdict: Option<&'static str>,
}

impl Row {
    fn of(point: &Point) -> Self {
        let (noise, versus) = (point.noise, point.versus);
        Self {
            t_render_s: point.t_render,
            t_total_s: point.t_total,
            spp: point.spp,
            samples: point.samples,
            rays: point.rays,
            mrays_per_s: point.rays as f64 / 1e6 / point.t_render,
            mean: noise.mean,
            e: noise.e,
            rmse: noise.rmse,
            rel: noise.rel,
            rel_lo: noise.rel_lo,
            rel_hi: noise.rel_hi,
            p95: noise.p95,
            top: noise.top,
            kurtosis: noise.kurtosis,
            heavy_tail: noise.is_heavy_tailed(),
            fom: point.fom(),
            ttu_s: point.ttu(),
            slope: point.slope,
            nan: point.bad,
            ref_rmse: versus.map(|v| v.rmse),
            ref_rel: versus.map(|v| v.rel),
            ref_rel_trim: versus.map(|v| v.rel_trim),
            smape: versus.map(|v| v.smape),
            bias2: versus.map(|v| v.bias2),
            z: versus.and_then(|v| v.z),
            verdict: versus.map(|v| v.verdict()),
        }
    }

    /// The columns of `COLUMNS`.
    fn csv(&self) -> String {
        let some = |x: f64| if x.is_finite() { x.to_string() } else { String::new() };
        let maybe = |x: Option<f64>| x.map_or(String::new(), some);
        [
            some(self.t_render_s),
            some(self.t_total_s),
            self.spp.to_string(),
            self.samples.to_string(),
            self.rays.to_string(),
            some(self.mrays_per_s),
            some(self.rmse),
            some(self.rel),
            some(self.rel_lo),
            some(self.rel_hi),
            some(self.p95),
            some(self.top),
            some(self.fom),
            some(self.ttu_s),
            maybe(self.slope),
            self.nan.to_string(),
            maybe(self.ref_rmse),
            maybe(self.ref_rel),
            maybe(self.ref_rel_trim),
            String::new(),
            maybe(self.bias2),
            maybe(self.smape),
            maybe(self.z),
        ]
        .join(",")
    }
}

impl Report {
    /// Of a run that was measured. `times` are those of its `convergence` with what only its owner
    /// knows.
    #[must_use]
    pub fn new(
        scene: &Scene,
        job: &Job,
        outcome: &Outcome,
        convergence: &Convergence,
        times: Times,
    ) -> Self {
        let counters = &outcome.film().counters;
        let crop = job.crop;
        Self {
            schema: "rtr.report/1",
            version: env!("CARGO_PKG_VERSION"),
            scene: scene.render_id(),
            features: pack::features::names(scene.pack().features()),
            commit: commit::COMMIT,
            kernel: LeftOut::of(scene),
            device: outcome.picture.meta.device.clone(),
            seed: job.seed,
            replicates: REPLICATES,
            clamp_indirect: job
                .clamp_indirect
                .map(|most| Clamped { most, removed: outcome.film().removed() }),
            resolution: Resolution {
                image: job.image_size,
                crop: [crop.x, crop.y, crop.w, crop.h],
            },
            stop: outcome.stop.name(),
            goal: convergence.goal.map(|goal| goal.to_string()),
            times,
            counters: Counts {
                rays: counters.rays,
                nan: counters.bad,
                longest_path: counters.depth,
                medium_overflow: counters.overflows,
                medium_leaks: counters.leaks,
            },
            checkpoints: convergence.points.iter().map(Row::of).collect(),
        }
    }

    /// One JSON object.
    #[must_use]
    pub fn json(&self) -> String {
        let text = serde_json::to_string_pretty(self);
        text.expect("numbers, texts and lists can be written") + "\n"
    }

    /// A line of names, then a line for each point.
    #[must_use]
    pub fn csv(&self) -> String {
        let rows = self.checkpoints.iter().map(Row::csv);
        let lines: Vec<String> = std::iter::once(COLUMNS.to_owned()).chain(rows).collect();
        lines.join("\n") + "\n"
    }
}

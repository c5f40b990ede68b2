//! `cargo run --release -p tests --bin stopping [SCENE ..]`: renders every scene 200 times until its error is small
//! enough, and rewrites its rows of the tables in `docs/error.md`.
//!
//! What each picture really is off by comes from a reference of the same pixels with another seed, whose own
//! variance is taken out. The samples that a goal needs are those after which that error, as the root of the mean
//! square over all runs, is the goal: near there its square falls as one over the samples.

use std::error::Error;
use std::path::Path;

use pack::Pack;
use rayon::prelude::*;
use runtime::convergence::{Goal, Measure, Quantity, luminance};
use runtime::{Control, DeviceChoice, Film, Job, SampleRange, Scene, Stop, render};
use scenes::catalog::EXAMPLES;
use tests::scene;
use tests::truth::Truth;

/// Pixels of each picture.
const SIZE: [u32; 2] = [64, 48];
/// Pictures of each scene.
const RUNS: u32 = 200;
/// Samples of each of the four replicates behind a reference.
const REFERENCE: u32 = 1 << 12;
/// Scenes and goals: some hundred samples each.
const SCENES: [(&str, f64); 4] =
    [("cornell", 0.05), ("cornell_sphere", 0.1), ("materials", 0.06), ("weekend", 0.07)];

fn main() -> Result<(), Box<dyn Error>> {
    let wanted: Vec<String> = std::env::args().skip(1).collect();
    for (name, goal) in SCENES {
        if wanted.is_empty() || wanted.iter().any(|other| other == name) {
            let known = Known::new(name)?;
            let even = known.until(goal, false)?;
            put("stopping", name, &stopping(name, goal, &even))?;
            let adaptive = known.until(goal, true)?;
            put("adaptive", name, &known.adaptive(name, goal, &even, &adaptive))?;
        }
    }
    Ok(())
}

/// A scene and what it looks like.
struct Known {
    bytes: Vec<u8>,
    truth: Truth,
}

/// One picture.
struct Run {
    spp: f64,
    /// Square of the error that it has.
    square: f64,
    /// Mean luminance.
    light: f64,
    /// Ends of the interval that was told.
    interval: [f64; 2],
    is_flagged: bool,
}

impl Known {
    fn new(name: &str) -> Result<Self, Box<dyn Error>> {
        let example = EXAMPLES.iter().find(|example| example.name == name);
        let compiled = scene::example(example.ok_or("it is no example")?, &[]);
        let bytes = scene::bytes(&compiled);
        let scene = Scene::new(Pack::from_bytes(bytes.clone())?);
        let mut job = job(&scene, Measure::default());
        (job.seed, job.samples.end, job.threads) = (77, REFERENCE, None);
        let outcome = render(&scene, &job, &DeviceChoice::Cpu, &Control::default())?;
        Ok(Self { bytes, truth: Truth::of(outcome.film()) })
    }

    /// Every run until its error is `goal`; `adaptive` as in `Measure`.
    fn until(&self, goal: f64, adaptive: bool) -> Result<Vec<Run>, Box<dyn Error>> {
        let scene = Scene::new(Pack::from_bytes(self.bytes.clone())?);
        let goal = Goal { quantity: Quantity::Rel, limit: goal };
        let runs = (0..RUNS).into_par_iter().map(|run| {
            let mut job = job(&scene, Measure { goal: Some(goal), adaptive, ..Measure::default() });
            job.seed = 1000 + run;
            let outcome = render(&scene, &job, &DeviceChoice::Cpu, &Control::default());
            let outcome = outcome.map_err(|error| error.to_string())?;
            let points = outcome.convergence.as_ref().map(|c| c.points.as_slice());
            let last = points.and_then(<[_]>::last).filter(|_| outcome.stop == Stop::ErrorReached);
            let noise = last.ok_or("the goal was not reached")?.noise;
            let film = outcome.film();
            Ok(Run {
                spp: film.total_samples() as f64 / film.counts.len() as f64,
                square: self.truth.rel_mse(&film.means()),
                light: lumas(film).sum::<f64>() / film.counts.len() as f64,
                interval: [noise.rel_lo, noise.rel_hi],
                is_flagged: noise.is_heavy_tailed(),
            })
        });
        Ok(runs.collect::<Result<_, String>>()?)
    }
}

impl Known {
    /// What fewer samples for parts of the picture save, at the same true error, and what they do to its light.
    fn adaptive(&self, name: &str, goal: f64, even: &[Run], runs: &[Run]) -> String {
        let n = runs.len() as f64;
        let (truth, own) = (self.truth.light(), self.truth.variance_of_light());
        let light = runs.iter().map(|run| run.light).sum::<f64>() / n;
        let spread = runs.iter().map(|run| (run.light - light).powi(2)).sum::<f64>() / (n - 1.0);
        let within = runs.iter().filter(|run| run.square <= (1.1 * goal).powi(2)).count() as f64;
        let spp = |runs: &[Run]| {
            let mut spp: Vec<f64> = runs.iter().map(|run| run.spp).collect();
            spp.sort_unstable_by(f64::total_cmp);
            quantile(&spp, 0.5)
        };
        let [before, after] = [even, runs].map(|runs| needed(goal, runs));
        format!(
            "| `{name}` | {goal} | {:.0} | {:.0} | {:.2} | {:.1} % | {:+.3} ± {:.3} % |",
            spp(even),
            spp(runs),
            before / after,
            100.0 * within / n,
            100.0 * (light / truth - 1.0),
            196.0 * (spread / n + own).sqrt() / truth,
        )
    }
}

/// A measured run on one thread.
fn job(scene: &Scene, measure: Measure) -> Job {
    let mut job = Job::of_scene(scene);
    job.resize(SIZE);
    job.samples = SampleRange { start: 0, end: 1 << 18 };
    job.threads = Some(1);
    job.measure = Some(measure);
    job
}

fn lumas(film: &Film) -> impl Iterator<Item = f64> {
    film.means().into_iter().map(luminance)
}

/// Samples that a goal needs: the error of these runs, carried along one over the root of the samples.
fn needed(goal: f64, runs: &[Run]) -> f64 {
    let product = runs.iter().map(|run| run.square * run.spp).sum::<f64>() / runs.len() as f64;
    product / (goal * goal)
}

fn stopping(name: &str, goal: f64, runs: &[Run]) -> String {
    let needed = needed(goal, runs);
    let percent = |n: usize| 100.0 * n as f64 / runs.len() as f64;
    let count = |is: &dyn Fn(&Run) -> bool| percent(runs.iter().filter(|run| is(run)).count());
    let within = |most: f64| count(&move |run: &Run| run.square <= (most * goal).powi(2));
    let covered = count(&|run: &Run| {
        let [low, high] = run.interval;
        (low..=high).contains(&run.square.max(0.0).sqrt())
    });
    let flagged = count(&|run: &Run| run.is_flagged);
    let mut spp: Vec<f64> = runs.iter().map(|run| run.spp).collect();
    spp.sort_unstable_by(f64::total_cmp);
    let at = |share: f64| quantile(&spp, share);
    format!(
        "| `{name}` | {goal} | {needed:.0} | {:.0} ({:.0} to {:.0}) | {:.2} | {:.1} % | {:.1} % | {covered:.1} % | {flagged:.0} % |",
        at(0.5),
        at(0.05),
        at(0.95),
        at(0.5) / needed,
        within(1.0),
        within(1.1),
    )
}

/// Of sorted values.
fn quantile(values: &[f64], share: f64) -> f64 {
    #[expect(
        clippy::cast_possible_truncation,
        reason = "a share of a length is at most the length"
    )]
    let rank = ((values.len() as f64 * share).ceil() as usize).clamp(1, values.len());
    values[rank - 1]
}

/// Replaces the row of `name` in the table that follows `<!-- table -->` in `docs/error.md`.
fn put(table: &str, name: &str, row: &str) -> Result<(), Box<dyn Error>> {
    tests::console::line(row);
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../docs/error.md");
    let text = std::fs::read_to_string(&path)?;
    let (before, after) =
        text.split_once(&format!("<!-- {table} -->\n")).ok_or("there is no such table")?;
    let start = format!("| `{name}` |");
    let row_of =
        |line: &str| if line.starts_with(&start) { row.to_owned() } else { line.to_owned() };
    let (rows, rest) = after.split_once("\n\n").ok_or("the table has no end")?;
    let rows: Vec<String> = rows.lines().map(row_of).collect();
    let text = format!("{before}<!-- {table} -->\n{}\n\n{rest}", rows.join("\n"));
    Ok(std::fs::write(&path, text)?)
}

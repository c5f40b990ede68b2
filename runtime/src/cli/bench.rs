//! `rtr bench A.pack B.pack`: two packs in turns, equal time each → which has less error, and whether
//! that could be chance.

use super::args::{BenchArgs, Verify};
use super::console::{Console, reset_interrupts};
use super::exit::Exit;
use super::guard::Guard;
use super::open::{How, open};
use super::outputs::{Claim, Use, prove, save};
use super::timed::timed;
use crate::convergence::{Comparison, Measure, Point, Spread, compare};
use crate::job::Job;
use crate::report::Report;
use crate::scene::Scene;
use files::ShowPath as _;
use serde::Serialize;
use std::path::Path;

/// One of the two.
struct Side<'a> {
    path: &'a Path,
    scene: Scene,
    points: Vec<Point>,
    reports: Vec<Report>,
}

impl Side<'_> {
    fn foms(&self) -> Vec<f64> {
        self.points.iter().map(Point::fom).collect()
    }
}

/// What the file says, see `docs/json.md`.
#[derive(Serialize)]
struct Verdict<'a> {
    schema: &'static str,
    packs: [String; 2],
    time_s: f64,
    fom: [Vec<f64>; 2],
    ratio: Option<f64>,
    p: Option<f64>,
    test: &'static str,
    runs: [&'a [Report]; 2],
}

const TEST: &str = "exact two-sided permutation test on log fom";

pub(super) fn command(args: &BenchArgs) -> Exit {
    let console = Console::with_progress(args.quiet);
    reset_interrupts();
    let inputs = [&args.first, &args.second].map(|path| Use { path, what: "a pack" });
    let report = args.report.iter().map(|path| Claim::new(path, "the report", 0));
    if let Err(exit) = prove(&console, &inputs, &report.collect::<Vec<_>>()) {
        return exit;
    }
    let mut sides = Vec::new();
    for path in [&args.first, &args.second] {
        match open(path, How::Map) {
            Ok(pack) => {
                let scene = Scene::new(pack);
                sides.push(Side { path, scene, points: Vec::new(), reports: Vec::new() });
            }
            Err(error) => return console.fail_about(path, &error, Exit::World),
        }
    }
    let guard = |side: &Side<'_>| {
        Guard::new(&console, side.path, side.scene.pack(), Verify::First).map(drop)
    };
    if let Err(exit) = sides.iter().try_for_each(guard) {
        return exit;
    }
    for run in 0..args.runs {
        // Who is first changes, so that what warms up or slows down favours neither.
        let order = if run % 2 == 0 { [0, 1] } else { [1, 0] };
        for i in order {
            if let Err(exit) = one(args, &console, run, &mut sides[i]) {
                return exit;
            }
        }
    }
    conclude(args, &console, &sides)
}

/// One run of one side.
fn one(args: &BenchArgs, console: &Console, run: u32, side: &mut Side<'_>) -> Result<(), Exit> {
    let mut job = Job::of_scene(&side.scene);
    if let Some(size) = args.size {
        job.resize(size);
    }
    job.seed = args.seed.wrapping_add(run);
    job.threads = args.threads;
    job.measure = Some(Measure::default());
    let guard = Guard::new(console, side.path, side.scene.pack(), Verify::First)?;
    let outcome = timed(console, &guard, (&side.scene, &mut job), (&args.device, args.time))?;
    let Some(convergence) = &outcome.convergence else { return Err(Exit::Bug) };
    let Some(point) = convergence.points.last().filter(|_| outcome.failures.is_empty()) else {
        console.warn("error: a run ended without a picture");
        return Err(Exit::Bug);
    };
    console.note(&format!("{} run {}: {point}", side.path.shown(), run + 1));
    side.points.push(*point);
    side.reports.push(Report::new(&side.scene, &job, &outcome, convergence, convergence.times));
    Ok(())
}

fn conclude(args: &BenchArgs, console: &Console, sides: &[Side<'_>]) -> Exit {
    let [a, b] = sides else { return Exit::Bug };
    for side in [a, b] {
        let of = |f: fn(&Point) -> f64| Spread::of(&side.points.iter().map(f).collect::<Vec<_>>());
        let (fom, rel) = (of(Point::fom), of(|point| point.noise.rel));
        console.result(&format!(
            "{}: fom {:.1}/s ({:.1} to {:.1}), rel {:.5} ({:.5} to {:.5}), median of {} runs of {:.1} s",
            side.path.shown(),
            fom.median,
            fom.least,
            fom.most,
            rel.median,
            rel.least,
            rel.most,
            side.points.len(),
            of(|point| point.t_render).median,
        ));
    }
    let comparison = compare(&a.foms(), &b.foms());
    console.result(&verdict(a.path, b.path, comparison));
    if let Some(text) = other_picture(a, b) {
        console.warn(&text);
    }
    if let Some(path) = &args.report {
        let result = Verdict {
            schema: "rtr.bench/1",
            packs: [a, b].map(|side| side.path.shown().to_string()),
            time_s: args.time.as_secs_f64(),
            fom: [a.foms(), b.foms()],
            ratio: comparison.map(|c| c.ratio),
            p: comparison.map(|c| c.p),
            test: TEST,
            runs: [&a.reports, &b.reports],
        };
        let text = serde_json::to_string_pretty(&result).expect("numbers and texts") + "\n";
        if let Err(exit) = save(console, path, text.as_bytes()) {
            return exit;
        }
    }
    Exit::Done
}

/// `b.pack is better: 1.52 times the fom (p = 0.008, significant; ...)`.
fn verdict(a: &Path, b: &Path, comparison: Option<Comparison>) -> String {
    let Some(found) = comparison else {
        return "no comparison: one picture has no error".to_owned();
    };
    let (better, ratio) =
        if found.ratio >= 1.0 { (b, found.ratio) } else { (a, 1.0 / found.ratio) };
    let significance = if found.is_significant() {
        "significant"
    } else if found.least_p > 0.05 {
        "too few runs to be significant"
    } else {
        "not significant"
    };
    let name = if found.is_significant() { "is better" } else { "seems better" };
    format!(
        "{} {name}: {ratio:.3} times the fom, {:.1} % of the time for the same error (p = {:.3}, \
         {significance}; {TEST})",
        better.shown(),
        100.0 / ratio,
        found.p,
    )
}

/// Packs whose means differ do not show the same, and less noise is then no merit.
fn other_picture(a: &Side<'_>, b: &Side<'_>) -> Option<String> {
    let means = |side: &Side<'_>| side.points.iter().map(|p| p.noise.mean).collect::<Vec<_>>();
    let (a, b) = (Spread::of(&means(a)), Spread::of(&means(b)));
    let apart = a.most < b.least || b.most < a.least;
    let far = (a.median - b.median).abs() > 0.01 * a.median.max(b.median);
    (apart && far).then(|| {
        format!(
            "warning: the pictures have mean luminances of {:.4} and {:.4}: the packs show different scenes",
            a.median, b.median
        )
    })
}

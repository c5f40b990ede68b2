//! `--report`, `--plot`, `--until-error`, `--reference`: what a run that is measured is asked, and
//! where its answer goes.

use super::args::RenderArgs;
use super::console::Console;
use super::exit::Exit;
use super::outputs::save;
use crate::convergence::{Convergence, Measure, Reference, Times, chart_png, chart_svg};
use crate::job::Job;
use crate::outcome::Outcome;
use crate::output;
use crate::region::SampleRange;
use crate::replicate::REPLICATES_U32;
use crate::report::Report;
use crate::scene::Scene;
use files::ShowPath as _;
use std::path::Path;
use std::sync::Arc;
use std::time::Duration;

/// Samples of every pixel after which a run without `--spp` ends even if its error is too large.
const MOST_SPP: u32 = 1 << 20;

/// A file that is written about a run.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Kind {
    Json,
    Csv,
    Svg,
    Png,
}

impl Kind {
    fn of(path: &Path, allowed: [Self; 2]) -> Result<Self, String> {
        let extension = path.extension().and_then(|e| e.to_str()).map(str::to_ascii_lowercase);
        let name = |kind: &Self| match kind {
            Self::Json => "json",
            Self::Csv => "csv",
            Self::Svg => "svg",
            Self::Png => "png",
        };
        let found = allowed.iter().find(|kind| extension.as_deref() == Some(name(kind)));
        let [a, b] = allowed.map(|kind| name(&kind));
        found.copied().ok_or(format!("{}: the name must end in .{a} or .{b}", path.shown()))
    }
}

const REPORTS: [Kind; 2] = [Kind::Json, Kind::Csv];
const PLOTS: [Kind; 2] = [Kind::Svg, Kind::Png];

/// Makes a run one that is measured, when that is wanted.
pub(super) fn prepare(args: &RenderArgs, console: &Console, job: &mut Job) -> Result<(), Exit> {
    let error = &args.error;
    if !error.any() {
        return Ok(());
    }
    for (paths, kinds) in [(&error.report, REPORTS), (&error.plot, PLOTS)] {
        for path in paths {
            Kind::of(path, kinds).map_err(|text| {
                console.warn(&format!("error: {text}"));
                Exit::World
            })?;
        }
    }
    let reference = match &error.reference {
        None => None,
        Some(path) => match output::read_exr(path) {
            Ok(picture) if picture.film.samples().0 == 0 => {
                let path = path.shown();
                console.warn(&format!("error: the reference {path} has pixels without samples"));
                return Err(Exit::World);
            }
            Ok(picture) => Some(Arc::new(Reference::of(&picture.film))),
            Err(error) => return Err(console.fail(&error, Exit::World)),
        },
    };
    let goal = error.until_error;
    let spp = match args.spp {
        None if goal.is_some() => MOST_SPP,
        _ => job.samples.count(),
    };
    job.samples = SampleRange { start: 0, end: spp.div_ceil(REPLICATES_U32) };
    job.measure = Some(Measure { goal, adaptive: error.adaptive, reference });
    Ok(())
}

/// Times that only the command line knows.
#[derive(Clone, Copy, Debug)]
pub(super) struct Outside {
    /// Opening the pack.
    pub(super) load: Duration,
    /// Writing pictures.
    pub(super) write: Duration,
}

/// Writes what was asked for and says why the run ended. `None` when all is well.
pub(super) fn write(
    args: &RenderArgs,
    console: &Console,
    scene: &Scene,
    job: &Job,
    outcome: &Outcome,
    outside: &Outside,
) -> Option<Exit> {
    let convergence = outcome.convergence.as_ref()?;
    let times = Times {
        load: outside.load.as_secs_f64(),
        write: outside.write.as_secs_f64(),
        ..convergence.times
    };
    console.note(&times_text(&times));
    for line in summary(convergence) {
        console.note(&line);
    }
    let report = Report::new(scene, job, outcome, convergence, times);
    let title = args.pack.as_deref().and_then(Path::file_stem).unwrap_or_default();
    let title = title.to_string_lossy();
    let mut failed = None;
    for path in args.error.report.iter().chain(&args.error.plot) {
        let kind = Kind::of(path, REPORTS).or_else(|_| Kind::of(path, PLOTS));
        let bytes = match kind {
            Ok(Kind::Json) => report.json().into_bytes(),
            Ok(Kind::Csv) => report.csv().into_bytes(),
            Ok(Kind::Svg) => chart_svg(&title, convergence).into_bytes(),
            Ok(Kind::Png) => chart_png(&title, convergence),
            Err(_) => continue,
        };
        failed = save(console, path, &bytes).err().or(failed);
    }
    failed
}

/// What the last point means.
fn summary(convergence: &Convergence) -> Vec<String> {
    let mut lines = Vec::new();
    let Some(last) = convergence.points.last() else { return lines };
    let scale = last.noise.e;
    lines.push(format!("black is below e = {scale:.3e}, 1 % of the mean luminance"));
    if last.noise.is_heavy_tailed() {
        lines.push(format!(
            "warning: heavy tail: the worst 0.1 % of the pixels have {:.0} % of the variance, \
             kurtosis {:.0}; the error is a lower bound",
            100.0 * last.noise.top,
            last.noise.kurtosis,
        ));
    }
    if let Some(versus) = &last.versus {
        lines.push(format!(
            "against the reference: rmse {:.3e}, relMSE {:.3e} (trimmed {:.3e}), SMAPE {:.4}, \
             bias^2 {:.2e}{}: {}",
            versus.rmse,
            versus.rel * versus.rel,
            versus.rel_trim * versus.rel_trim,
            versus.smape,
            versus.bias2,
            versus.z.map_or(String::new(), |z| format!(" (z = {z:.1})")),
            versus.verdict(),
        ));
    }
    lines
}

fn times_text(times: &Times) -> String {
    let Times { load, compile, first_frame, render, readback, device, estimate, write } = *times;
    let device =
        device.map_or(String::new(), |time| format!(", on the device {:.1} ms", 1e3 * time));
    format!(
        "times: load {load:.2} s, compile {compile:.2} s, first frame {first_frame:.2} s, \
         render {render:.2} s (readback {readback:.2} s{device}), estimate {estimate:.2} s, write {write:.2} s"
    )
}

//! `rtr scene.pack`: opens, renders, writes, and says what happened.

use super::Exit;
use super::args::{Every, PrecisionArg, RenderArgs};
use super::console::{Console, Watched, duration_text, mrays, reset_interrupts};
use super::measure;
use super::watch::Change;
use crate::checkpoint::{Checkpoint, CheckpointError};
use crate::control::Control;
use crate::job::{Job, Precision};
use crate::output::{self, Format};
use crate::region::SampleRange;
use crate::render::{DeviceChoice, Outcome, render_session};
use crate::saver::{Keep, Session};
use crate::scene::Scene;
use crate::schedule::Stop;
use pack::{MapMode, Pack};
use std::ffi::OsStr;
use std::path::{Component, Path, PathBuf};
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::{Duration, Instant};

/// `change`: what makes the picture pointless while it is rendered; then nothing is written.
pub(super) fn command(args: &RenderArgs, change: Option<&Change>) -> Exit {
    let began = Instant::now();
    let console = Console::with_progress(args.quiet);
    let Some(path) = &args.pack else {
        console.warn("error: no pack was named");
        return Exit::Usage;
    };
    if path.extension().is_some_and(|e| e.eq_ignore_ascii_case("rts")) {
        let pack = path.with_extension("pack");
        console.warn(&format!(
            "error: {0} is a scene source, compile it first: rtc {0} -o {1}",
            path.display(),
            pack.display()
        ));
        return Exit::World;
    }
    // A mapped file must not change; one that is watched is going to.
    let mode = if args.no_mmap || args.watch { MapMode::Read } else { MapMode::Map };
    let scene = match Pack::open(path, mode) {
        Ok(pack) => Scene::new(pack),
        Err(error) => {
            return console.fail_about(path, &error, Exit::World);
        }
    };
    let mut job = job(args, &scene);
    if let Err(exit) = measure::prepare(args, &console, &mut job) {
        return exit;
    }
    if let Err(error) = job.check() {
        return console.fail(&error, Exit::Usage);
    }
    let outputs = outputs(args, path, &scene);
    if let Err(text) = check_outputs(&outputs) {
        console.warn(&format!("error: {text}"));
        return Exit::World;
    }
    let load = began.elapsed();
    let checkpoint = checkpoint_path(&outputs);
    let from = match earlier(args, &console, &checkpoint, &scene, &job) {
        Ok(from) => from,
        Err(error) => return console.fail(&error, Exit::World),
    };
    console.note(&headline(path, &scene, &job));
    if let Some(from) = &from {
        let done = from.film.samples().1;
        console.note(&format!(
            "going on from {}: {done} of {} spp are there",
            checkpoint.display(),
            job.samples.count()
        ));
    }
    let keep = match args.checkpoint_every {
        Every::After(every) if !args.watch => Some(Keep { path: checkpoint, every }),
        _ => None,
    };
    let plan = Plan { scene: &scene, job: &job, outputs: &outputs, change, load };
    run(args, &console, &plan, Session { from, keep })
}

fn job(args: &RenderArgs, scene: &Scene) -> Job {
    let mut job = Job::of_scene(scene);
    if let Some(size) = args.size {
        job.resize(size);
    }
    job.crop = args.crop.unwrap_or(job.crop);
    if let Some(spp) = args.spp {
        job.samples = SampleRange { start: 0, end: spp };
    }
    job.samples = args.samples.unwrap_or(job.samples);
    job.seed = args.seed.unwrap_or(job.seed);
    job.time_limit = args.time;
    job.threads = args.threads;
    job.strict = args.strict;
    job.submission = args.submission;
    job.estimator = args.estimator as u32;
    job.precision = match args.precision {
        PrecisionArg::F32 => Precision::F32,
        PrecisionArg::F64 => Precision::F64,
    };
    job
}

/// What is rendered, and where it goes.
struct Plan<'a> {
    scene: &'a Scene,
    job: &'a Job,
    outputs: &'a [PathBuf],
    change: Option<&'a Change>,
    /// Time that opening the pack took.
    load: Duration,
}

fn run(args: &RenderArgs, console: &Console, plan: &Plan<'_>, session: Session) -> Exit {
    let Plan { scene, job, outputs, change, load } = *plan;
    if change.is_none() {
        reset_interrupts();
    }
    let notes = console.clone();
    let control = Control::new(move |text| notes.note(text));
    let watched = Watched { spp: job.spp(), limit: job.time_limit, change };
    let over = AtomicBool::new(false);
    let outcome = std::thread::scope(|scope| {
        let watcher = scope.spawn(|| console.watch(&control, &watched, &over));
        let choice = DeviceChoice::parse(&args.device);
        let outcome = render_session(scene, job, &choice, &control, session);
        over.store(true, Ordering::Relaxed);
        watcher.thread().unpark();
        outcome
    });
    let outcome = match outcome {
        Ok(outcome) => outcome,
        Err(error) => return console.fail(&error, Exit::World),
    };
    if outcome.stop == Stop::Cancelled && change.is_some_and(Change::has_come) {
        return Exit::Done;
    }
    report(console, &outcome, job);
    if outcome.film().samples().1 == 0 {
        console.warn("error: no sample was complete, nothing is written");
        return exit(&outcome).unwrap_or(Exit::World);
    }
    let residual =
        args.samples.is_some() || job.time_limit.is_some() || !outcome.picture.meta.complete;
    let (mut failed, began) = (None, Instant::now());
    for path in outputs {
        match output::write(path, &outcome.picture, residual) {
            Ok(()) => console.result(&format!("wrote {}", path.display())),
            // The other file may still succeed.
            Err(error) => failed = Some(console.fail(&error, Exit::World)),
        }
    }
    let times = measure::Outside { load, write: began.elapsed() };
    if let Some(exit) = measure::write(args, console, scene, job, &outcome, &times) {
        failed = Some(exit);
    }
    let exit = failed.or_else(|| exit(&outcome)).unwrap_or(Exit::Done);
    settle(&checkpoint_path(outputs), args, console, &outcome, exit);
    exit
}

/// Removes the checkpoint of a picture that is done, or says how to go on.
fn settle(path: &Path, args: &RenderArgs, console: &Console, outcome: &Outcome, exit: Exit) {
    let ours = outcome.saved || args.resume;
    if exit == Exit::Done && ours {
        if let Err(error) = std::fs::remove_file(path)
            && error.kind() != std::io::ErrorKind::NotFound
        {
            console.warn(&format!("warning: cannot remove {}: {error}", path.display()));
        }
    } else if ours && path.is_file() {
        console.note(&format!("to go on, run the same with --resume ({})", path.display()));
    }
}

/// Beside the first output: `a.png.checkpoint`.
fn checkpoint_path(outputs: &[PathBuf]) -> PathBuf {
    with_extension(outputs.first().map_or(Path::new("picture"), PathBuf::as_path), "checkpoint")
}

/// What an earlier run left to go on from, when that is wanted.
fn earlier(
    args: &RenderArgs,
    console: &Console,
    path: &Path,
    scene: &Scene,
    job: &Job,
) -> Result<Option<Checkpoint>, CheckpointError> {
    if !args.resume {
        if path.is_file() && !args.watch {
            let path = path.display();
            console.note(&format!("{path} is of an unfinished run; --resume would go on with it"));
        }
        return Ok(None);
    }
    let from = Checkpoint::read(path)?;
    match &from {
        Some(from) => from.check(path, scene, job)?,
        None => console.note(&format!("there is no {}, so this run begins", path.display())),
    }
    Ok(from)
}

/// `None` when all is well.
fn exit(outcome: &Outcome) -> Option<Exit> {
    if !outcome.failures.is_empty() {
        Some(Exit::Bug)
    } else if outcome.device_error.is_some() {
        Some(Exit::World)
    } else if outcome.too_many_bad() || outcome.stop == Stop::Failed {
        Some(Exit::NotFinite)
    } else if outcome.stop == Stop::Cancelled {
        Some(Exit::Interrupted)
    } else {
        None
    }
}

fn headline(path: &Path, scene: &Scene, job: &Job) -> String {
    let [w, h] = job.image_size;
    let crop = if job.crop.pixels() == u64::from(w) * u64::from(h) {
        String::new()
    } else {
        format!(" (crop {})", job.crop)
    };
    let triangles = scene.pack().records::<pack::abi::Triangle>().len();
    let spheres = scene.pack().records::<pack::abi::Sphere>().len();
    format!(
        "{}: {w}x{h}{crop}, samples {}, {triangles} triangles, {spheres} spheres, {} lights",
        path.display(),
        job.samples,
        scene.settings().n_lights,
    )
}

fn report(console: &Console, outcome: &Outcome, job: &Job) {
    let film = outcome.film();
    let counters = &film.counters;
    let (least, most) = film.samples();
    let why = match outcome.stop {
        Stop::Complete => "",
        Stop::TimeLimit => ", time limit",
        Stop::ErrorReached => ", error reached",
        Stop::Cancelled => ", interrupted",
        Stop::Failed => ", failed",
    };
    console.note(&format!(
        "{most} of {} spp in {}{why}: {:.2} Mrays/s, {} rays, longest path {}",
        job.spp(),
        duration_text(outcome.elapsed),
        mrays(counters.rays, outcome.elapsed),
        counters.rays,
        counters.depth,
    ));
    if least != most {
        console.warn(&format!("warning: pixels have between {least} and {most} samples"));
    }
    if let Some(error) = &outcome.device_error {
        console.warn(&format!("error: {error}; what was complete before that is kept"));
    }
    for failure in &outcome.failures {
        console.warn(&format!(
            "error: bug in rtr: block {} from sample {} failed: {}",
            failure.tile, failure.sample, failure.message
        ));
    }
    if counters.overflows > 0 {
        console.warn(&format!(
            "warning: {} times a path was inside of more than four things at once, and the least of \
             them was forgotten",
            counters.overflows,
        ));
    }
    if counters.leaks as f64 > LEAKS * film.total_samples() as f64 {
        console.warn(&format!(
            "warning: {} times a path left a thing that it had never entered: a mesh is open, or \
             surfaces touch",
            counters.leaks,
        ));
    }
    if let Some(bad) = counters.first_bad {
        let grade = if outcome.too_many_bad() { "error" } else { "warning" };
        let (x, y, sample) = (bad.x, bad.y, bad.sample);
        console.warn(&format!(
            "{grade}: {} of {} samples were not finite and count as black; the first again: \
             --crop {x},{y},1,1 --samples {sample}..{} --seed {}",
            counters.bad,
            film.total_samples(),
            sample.saturating_add(1),
            job.seed,
        ));
    }
}

/// Rounding at edges lets one path in 100,000 slip past a surface; more than that is a hole.
const LEAKS: f64 = 1e-4;

/// What `-o` says; else what the scene says; else the pack's name, in the working folder.
fn outputs(args: &RenderArgs, pack: &Path, scene: &Scene) -> Vec<PathBuf> {
    if !args.output.is_empty() {
        return args.output.clone();
    }
    let wanted = scene.pack().manifest().ok().and_then(|manifest| manifest.output);
    let stem = wanted.as_deref().and_then(safe_stem);
    let name = pack.file_stem().unwrap_or(OsStr::new("picture"));
    let stem = stem.unwrap_or_else(|| PathBuf::from(name));
    ["exr", "png"].map(|extension| with_extension(&stem, extension)).into()
}

/// Adds an extension; a dot in the stem stays.
fn with_extension(stem: &Path, extension: &str) -> PathBuf {
    let mut name = stem.as_os_str().to_owned();
    name.push(".");
    name.push(extension);
    PathBuf::from(name)
}

/// The path without `.exr` or `.png`. A pack is a stranger's file: it may name places below the
/// working folder only.
fn safe_stem(output: &str) -> Option<PathBuf> {
    let path = Path::new(output);
    let below = path.components().all(|c| matches!(c, Component::Normal(_) | Component::CurDir));
    path.file_name().filter(|_| below)?;
    let known = Format::of(path).is_ok();
    Some(if known { path.with_extension("") } else { path.to_owned() })
}

/// Finds out before rendering, not after, that a file cannot be written.
fn check_outputs(outputs: &[PathBuf]) -> Result<(), String> {
    for path in outputs {
        Format::of(path).map_err(|error| error.to_string())?;
        let folder = path.parent().filter(|p| !p.as_os_str().is_empty()).unwrap_or(Path::new("."));
        if !folder.is_dir() {
            return Err(format!(
                "cannot write {}: there is no folder {}",
                path.display(),
                folder.display()
            ));
        }
        if path.is_dir() {
            return Err(format!("cannot write {}: it is a folder", path.display()));
        }
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_pack_may_name_outputs_below_the_working_folder_only() {
        assert_eq!(safe_stem("pic.png"), Some(PathBuf::from("pic")));
        assert_eq!(safe_stem("out/pic.v2"), Some(PathBuf::from("out/pic.v2")));
        assert_eq!(safe_stem("/etc/pic.png"), None);
        assert_eq!(safe_stem("../pic.png"), None);
        assert_eq!(safe_stem("out/../../pic.exr"), None);
        assert_eq!(safe_stem(""), None);
        assert_eq!(with_extension(Path::new("a/pic.v2"), "exr"), PathBuf::from("a/pic.v2.exr"));
    }
}

//! `rtr scene.pack`: opens, renders and writes.

use super::args::{PrecisionArg, RenderArgs};
use super::change::Change;
use super::console::{Console, Watched, quit, reset_interrupts};
use super::denoise;
use super::exit::Exit;
use super::guard::{Guard, ThreadError};
use super::layers;
use super::measure;
use super::open::{How, is_stdin, open};
use super::outputs::{Claim, Output, Use, outputs, prove, room, with_extension};
use super::pictures::Pictures;
use super::progress::{Line, Wanted};
use super::summary::{exit, headline, summarize};
use super::values::Every;
use crate::checkpoint::{Checkpoint, CheckpointError};
use crate::control::Control;
use crate::denoise::Denoiser;
use crate::job::{Job, Precision};
use crate::mark::Mark;
use crate::outcome::Outcome;
use crate::output::{self, Format, read_exr};
use crate::region::SampleRange;
use crate::render::{DeviceChoice, RenderError, render_session};
use crate::saver::{Keep, Session};
use crate::scene::Scene;
use crate::schedule::Stop;
use crate::signals::{Event, Observer, Progress};
use files::ShowPath as _;
use std::path::{Path, PathBuf};
use std::sync::OnceLock;
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::{Duration, Instant};

/// A pack that is rendered again whenever it changes.
#[derive(Clone, Copy)]
pub(super) struct Watching<'a> {
    /// Makes the picture pointless while it is rendered; then nothing is written.
    pub(super) change: &'a Change,
    /// Names of the pictures, which stay what they were for the first.
    pub(super) names: &'a OnceLock<Vec<Output>>,
}

impl Watching<'_> {
    /// The names of the pictures; `first` makes them where there are none yet.
    fn names<E>(self, first: impl FnOnce() -> Result<Vec<Output>, E>) -> Result<Vec<Output>, E> {
        match self.names.get() {
            Some(names) => Ok(names.clone()),
            None => first().map(|names| self.names.get_or_init(|| names).clone()),
        }
    }
}

/// Renders a pack once.
pub(super) fn command(
    args: &RenderArgs,
    observer: &'static Observer,
    watching: Option<Watching<'_>>,
) -> Exit {
    let began = Instant::now();
    let console = Console::of_render(args).beside(&args.output);
    let path = match pack_path(args, &console) {
        Ok(path) => path,
        Err(exit) => return exit,
    };
    // A mapped file must not change; one that is watched is going to.
    let scene = match open(path, How::of(args.no_mmap || args.watch)) {
        Ok(pack) => Scene::new(pack),
        Err(error) => {
            return console.fail_about(path, &error, Exit::World);
        }
    };
    let guard = match Guard::new(&console, path, scene.pack(), args.verify) {
        Ok(guard) => guard,
        Err(exit) => return exit,
    };
    let mut job = job(args, &scene);
    if let Err(exit) = measure::prepare(args, &console, &mut job) {
        return exit;
    }
    if let Err(error) = job.check() {
        return console.fail(&error, Exit::Usage);
    }
    let first = || outputs(args, &console, path, &scene);
    let outputs = match watching.map_or_else(first, |watching| watching.names(first)) {
        Ok(outputs) => outputs,
        Err(text) => {
            console.warn(&format!("error: {text}"));
            return Exit::World;
        }
    };
    let formats: Vec<_> = outputs.iter().map(|output| output.format).collect();
    let denoiser = match beside(args, &console, &scene, &mut job, &formats) {
        Ok(denoiser) => denoiser,
        Err(exit) => return exit,
    };
    let checkpoint = checkpoint_path(args, &outputs);
    if let Err(exit) = prove_all(args, &console, &job, &outputs, &checkpoint) {
        return exit;
    }
    if let Some(exit) = complete(args, &console, (&scene, &job), &outputs) {
        return exit;
    }
    let load = began.elapsed();
    let resumed = args.resume.as_ref().and_then(|_| Mark::of(&checkpoint));
    let from = match earlier(args, &console, &checkpoint, &scene, &job) {
        Ok(from) => from,
        Err(error) => return console.fail(&error, Exit::World),
    };
    console.note(&headline(path, &scene, &job));
    if let Some(from) = &from {
        let done = from.film.samples().1;
        console.note(&format!(
            "resuming from {}: {done} of {} spp done",
            checkpoint.shown(),
            job.samples.count()
        ));
    }
    let keep = match args.checkpoint_every {
        Every::After(every) if !args.watch => Some(Keep { path: checkpoint, every }),
        _ => None,
    };
    let (scene, guard, job, console) = (&scene, &guard, &job, &console);
    let pictures = &Pictures::new(args, console, &outputs, job, denoiser);
    let plan =
        Plan { args, observer, console, scene, guard, job, pictures, watching, load, resumed };
    run(&plan, Session { from, keep })
}

/// `--skip-complete`: how the run ends if all pictures are there already. What is no whole picture of this run is
/// rendered again.
fn complete(
    args: &RenderArgs,
    console: &Console,
    (scene, job): (&Scene, &Job),
    outputs: &[Output],
) -> Option<Exit> {
    if !args.skip_complete {
        return None;
    }
    let mut pictures = outputs.iter().filter(|output| output.format == Format::Exr).peekable();
    if pictures.peek().is_none() {
        console.warn(
            "error: --skip-complete needs an .exr output: other pictures do not say whose they are",
        );
        return Some(Exit::Usage);
    }
    let is_whole = |output: &Output| {
        read_exr(&output.path).is_ok_and(|picture| output::is_whole(&picture, scene, job))
    };
    if !(pictures.all(is_whole) && outputs.iter().all(|output| output.path.exists())) {
        return None;
    }
    let names: Vec<String> = outputs.iter().map(|o| o.path.shown().to_string()).collect();
    console.note(&format!("{} complete already", names.join(", ")));
    Some(Exit::Done)
}

/// Sets what is wanted beside radiance; gives the denoiser, if one is.
fn beside(
    args: &RenderArgs,
    console: &Console,
    scene: &Scene,
    job: &mut Job,
    formats: &[Format],
) -> Result<Option<Denoiser>, Exit> {
    job.wanted = args.layers.wanted(scene, job, formats, &args.denoise);
    layers::check(console, scene, job, formats, &args.denoise)?;
    denoise::open(&args.denoise, console, formats, args.threads)
}

/// The pack that is named, if it can be one.
fn pack_path<'a>(args: &'a RenderArgs, console: &Console) -> Result<&'a Path, Exit> {
    let Some(path) = &args.pack else {
        console.warn("error: no pack was named");
        return Err(Exit::Usage);
    };
    if path.extension().is_some_and(|e| e.eq_ignore_ascii_case("rts")) {
        let (path, pack) = (path.shown(), path.with_extension("pack"));
        console.warn(&format!(
            "error: {path} is a scene source, compile it first: rtc {path} -o {}",
            pack.shown()
        ));
        return Err(Exit::World);
    }
    if args.watch && is_stdin(path) {
        console.warn("error: standard input cannot be watched, name a file");
        return Err(Exit::Usage);
    }
    Ok(path)
}

/// Everything that this run reads and writes.
fn prove_all(
    args: &RenderArgs,
    console: &Console,
    job: &Job,
    outputs: &[Output],
    checkpoint: &Path,
) -> Result<(), Exit> {
    let error = &args.error;
    let pack = args.pack.iter().map(|path| Use { path, what: "the pack" });
    let reference = error.reference.iter().map(|path| Use { path, what: "the reference" });
    let inputs: Vec<_> = pack.chain(reference).collect();
    let pictures = outputs.iter().map(|output| {
        Claim::new(&output.path, "the picture", room(output.format, job, residual(args)))
    });
    let reports = error.report.iter().map(|path| Claim::new(path, "the report", 0));
    let plots = error.plot.iter().map(|path| Claim::new(path, "the plot", 0));
    let saves = args.checkpoint_every != Every::Never && !args.watch && job.measure.is_none();
    let bytes = 24 * job.crop.pixels();
    let saved = saves.then(|| Claim::new(checkpoint, "the checkpoint", bytes));
    let claims: Vec<_> = pictures.chain(reports).chain(plots).chain(saved).collect();
    prove(console, &inputs, &claims)
}

/// Whether the picture is going to be merged with others, or may be.
fn residual(args: &RenderArgs) -> bool {
    args.samples.is_some() || args.time.is_some()
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
    job.clamp_indirect = args.clamp_indirect;
    job.precision = match args.precision {
        PrecisionArg::F32 => Precision::F32,
        PrecisionArg::F64 => Precision::F64,
    };
    job
}

/// What is rendered, and where it goes.
struct Plan<'a> {
    args: &'a RenderArgs,
    observer: &'static Observer,
    console: &'a Console,
    scene: &'a Scene,
    guard: &'a Guard<'a>,
    job: &'a Job,
    pictures: &'a Pictures<'a>,
    watching: Option<Watching<'a>>,
    /// Time that opening the pack took.
    load: Duration,
    /// The checkpoint that the run goes on from.
    resumed: Option<Mark>,
}

fn run(plan: &Plan<'_>, session: Session) -> Exit {
    let Plan { args, observer, console, scene, guard, job, watching, .. } = *plan;
    let change = watching.map(|watching| watching.change);
    if change.is_none() {
        reset_interrupts();
    }
    let notes = console.clone();
    let control = Control::new(move |event| {
        if let Event::Note(text) = event {
            notes.note(text);
        }
        observer(event);
    });
    let control = control.gated(guard.gate()).previewed(plan.pictures.preview(args));
    let watched = Watched { wanted: Wanted::of(job), change };
    let over = AtomicBool::new(false);
    let rescue = || rescue(plan, &control);
    let outcome = std::thread::scope(|scope| {
        let watch = || console.watch(&control, &watched, &over, &rescue);
        let watcher = std::thread::Builder::new().name("rtr-watch".to_owned());
        let watcher = match watcher.spawn_scoped(scope, watch) {
            Ok(watcher) => watcher,
            Err(error) => return Err(Failure::Thread(ThreadError(error))),
        };
        let choice = DeviceChoice::parse(&args.device);
        let outcome = guard.during(&control, || {
            let outcome = render_session(scene, job, &choice, &control, session);
            if matches!(outcome, Err(RenderError::Salvaged)) {
                // What was complete is being written, and the process ends with that.
                loop {
                    std::thread::park();
                }
            }
            if outcome.is_err() {
                guard.abandon();
            }
            outcome
        });
        over.store(true, Ordering::Relaxed);
        watcher.thread().unpark();
        outcome.map_err(Failure::Pack)
    });
    match outcome {
        Ok(Ok(outcome)) => conclude(plan, outcome, control.progress()),
        Ok(Err(error)) => console.fail(&error, Exit::World),
        Err(Failure::Pack(exit)) => exit,
        Err(Failure::Thread(error)) => console.fail(&error, Exit::World),
    }
}

/// A run that gives nothing.
enum Failure {
    Thread(ThreadError),
    /// The pack is to blame, and that has been said.
    Pack(Exit),
}

/// Writes what is complete of a run that hangs, and ends the process. Comes back when it has ended.
fn rescue(plan: &Plan<'_>, control: &Control) {
    // A kernel may hang because the pack is damaged. Then its guard ends the process.
    if !control.signals().may_keep() {
        return;
    }
    if let Some(outcome) = control.salvage() {
        if outcome.stop == Stop::Cancelled {
            let text = "warning: the kernel or the driver hangs; what is complete is written";
            plan.console.warn(text);
        }
        let end = || conclude(plan, outcome, control.progress());
        quit(plan.guard.settle().err().unwrap_or_else(end));
    }
    // Nothing has begun: the driver hangs.
    if control.progress().total == 0 {
        plan.console.give_up();
    }
}

/// Writes the picture and says how the run ended.
fn conclude(plan: &Plan<'_>, mut outcome: Outcome, progress: Progress) -> Exit {
    let Plan { args, console, scene, job, watching, load, .. } = *plan;
    let change = watching.map(|watching| watching.change);
    if outcome.stop == Stop::Cancelled && change.is_some_and(Change::has_come) {
        return Exit::Done;
    }
    console.progress(|| Line::ended(progress, job, &outcome));
    summarize(console, &outcome, job);
    if outcome.film().samples().1 == 0 {
        if outcome.device_error.is_none() {
            console.warn("error: no sample was completed, nothing is written");
        }
        return exit(&outcome).unwrap_or(Exit::World);
    }
    let residual = residual(args) || !outcome.picture.meta.complete;
    let noisy = plan.pictures.denoise(&mut outcome.picture, residual);
    let began = Instant::now();
    let mut failed = plan.pictures.write(&outcome.picture, residual).or(noisy);
    let times = measure::Outside { load, write: began.elapsed() };
    if let Some(exit) = measure::write(args, console, scene, job, &outcome, &times) {
        failed = Some(exit);
    }
    let exit = failed.or_else(|| exit(&outcome)).unwrap_or(Exit::Done);
    settle(plan, &outcome, exit);
    exit
}

/// Removes the checkpoint of a picture that is done, if it is the one that this run wrote or went on from;
/// or says how to go on.
fn settle(plan: &Plan<'_>, outcome: &Outcome, exit: Exit) {
    let Some(own) = outcome.checkpoint.as_ref().or(plan.resumed.as_ref()) else { return };
    let (path, console) = (own.path().shown(), plan.console);
    if exit == Exit::Done {
        if let Err(error) = own.remove() {
            console.warn(&format!("warning: cannot remove {path}: {error}"));
        }
    } else if own.is_there() {
        let named = plan.args.resume.as_ref().is_some_and(Option::is_some);
        let (flag, of) = if named {
            (format!("--resume={path}"), String::new())
        } else {
            ("--resume".to_owned(), format!(" ({path})"))
        };
        console.note(&format!("to resume, run the same command with {flag}{of}"));
    }
}

/// The one that is named, or beside the first output that is a file: `a.png.checkpoint`.
fn checkpoint_path(args: &RenderArgs, outputs: &[Output]) -> PathBuf {
    if let Some(Some(path)) = &args.resume {
        return path.clone();
    }
    let file = outputs.iter().find(|output| !files::is_stream(&output.path));
    with_extension(file.map_or(Path::new("picture"), |output| &output.path), "checkpoint")
}

/// What an earlier run left to go on from, when that is wanted.
fn earlier(
    args: &RenderArgs,
    console: &Console,
    path: &Path,
    scene: &Scene,
    job: &Job,
) -> Result<Option<Checkpoint>, CheckpointError> {
    let Some(named) = &args.resume else {
        if path.is_file() && !args.watch {
            let path = path.shown();
            console.note(&format!(
                "{path} belongs to an unfinished run; --resume would continue it, this run leaves it alone"
            ));
        }
        return Ok(None);
    };
    let from = Checkpoint::read(path)?;
    match &from {
        Some(from) => from.check(path, scene, job)?,
        None if named.is_some() => {
            let (action, path) = ("read", path.to_owned());
            let source = std::io::ErrorKind::NotFound.into();
            return Err(files::FileError::Io { action, path, source }.into());
        }
        None => console.note(&format!("there is no {}; starting afresh", path.shown())),
    }
    Ok(from)
}

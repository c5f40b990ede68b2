//! Scene + job + device → film: chooses the device, renders, and survives its loss.

use crate::coarse::coarse;
use crate::control::Control;
use crate::cpu;
use crate::gather::{GatherError, Pass, gather};
use crate::job::{Job, JobError};
use crate::lights::LightGroups;
use crate::memory::{self, TooLarge};
use crate::outcome::Outcome;
use crate::output::Meta;
use crate::preview::{Preview, Previewer};
use crate::run::{Framing, Run, Shared};
use crate::saver::{Saver, Session};
use crate::scene::Scene;
use crate::schedule::Stop;
use crate::signals::Signals;
use crate::zeros::NoMemory;
use std::sync::Arc;
use std::thread::Scope;
use std::time::Duration;
use thiserror::Error;

#[cfg(feature = "gpu")]
use crate::{gpu, job::Precision};

/// Where to render.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum DeviceChoice {
    /// The best real GPU; without one, the CPU kernel.
    Auto,
    /// The CPU kernel.
    Cpu,
    /// The best real GPU.
    Gpu,
    /// The first adapter with this text in its name, software adapters included.
    Named(String),
}

impl DeviceChoice {
    /// The choice that a word on the command line stands for.
    #[must_use]
    pub fn parse(word: &str) -> Self {
        match word {
            "auto" => Self::Auto,
            "cpu" => Self::Cpu,
            "gpu" => Self::Gpu,
            name => Self::Named(name.to_owned()),
        }
    }
}

/// A run that gives no picture at all.
#[derive(Debug, Error)]
pub enum RenderError {
    /// The job cannot be run.
    #[error(transparent)]
    Job(#[from] JobError),
    /// The film does not fit into memory.
    #[error(transparent)]
    Memory(#[from] TooLarge),
    /// The system gives less memory than it says that there is.
    #[error(transparent)]
    NoMemory(#[from] NoMemory),
    /// `Control::salvage` has taken what was complete.
    #[error("the run was cancelled")]
    Salvaged,
    /// No adapter is what was asked for.
    #[error("{0}")]
    NoDevice(String),
}

/// Renders `job`. Whatever goes wrong on the way, the outcome holds every batch that was complete.
pub fn render(
    scene: &Scene,
    job: &Job,
    choice: &DeviceChoice,
    control: &Control,
) -> Result<Outcome, RenderError> {
    render_session(scene, job, choice, control, Session::default())
}

/// As `render`, from where an earlier run was, and saving where this one is. The film is the same to
/// the last bit, however often it was interrupted.
pub fn render_session(
    scene: &Scene,
    job: &Job,
    choice: &DeviceChoice,
    control: &Control,
    session: Session,
) -> Result<Outcome, RenderError> {
    job.check()?;
    let device = select(choice, job)?;
    let Session { from, keep } = session;
    // A run that is measured has four pictures to keep, which no checkpoint holds.
    let (from, keep) = if job.measure.is_some() { (None, None) } else { (from, keep) };
    let groups = LightGroups::count(scene, job);
    if let Some(text) = memory::announce(job, groups, keep.is_some(), memory::free())? {
        control.signals().note(&text);
    }
    let done = from.as_ref().and_then(|from| from.film.ranges.last()).map_or(0, |done| done.end);
    let previewer = |preview: &Arc<Preview>| Previewer::new(Arc::clone(preview), job, done);
    let mut frame = Framing {
        meta: meta(scene, job),
        saver: keep.map(|keep| Saver::new(keep, scene, job, from.as_ref())),
        previewer: control.preview().map(previewer),
        ..Framing::default()
    };
    let film = from.map(|from| {
        frame.before = Duration::try_from_secs_f64(from.seconds).unwrap_or_default();
        frame.devices = from.device.split(" + ").map(str::to_owned).collect();
        from.film
    });
    let run = control.start(job, film, frame)?;
    let (finished, device_error) = std::thread::scope(|scope| {
        start_keepers(scope, (scene, job), run.shared(), control.signals());
        let backends = Backends {
            scene,
            job,
            #[cfg(feature = "gpu")]
            choice,
        };
        let error = backends.render(&device, &run);
        // Before the last checkpoint is waited for: from here on nothing can hang but a disk.
        let finished = control.finish(&run);
        if let Some(saver) = run.shared().saver() {
            saver.close();
        }
        run.shared().previewer().into_iter().for_each(Previewer::close);
        (finished, error)
    });
    let finished = finished.ok_or(RenderError::Salvaged)?;
    let mut outcome = run.shared().outcome(finished, device_error, control.signals());
    if !job.wanted.is_empty() {
        add_layers(scene, job, &device, &mut outcome, control.signals());
    }
    Ok(outcome)
}

/// Gives a picture that has come to its end its layers. One that was interrupted has none, and is not transparent: it is
/// there to be gone on with.
fn add_layers(
    scene: &Scene,
    job: &Job,
    device: &Selected,
    outcome: &mut Outcome,
    signals: &Signals,
) {
    let ended = matches!(outcome.stop, Stop::Complete | Stop::TimeLimit | Stop::ErrorReached);
    if !ended || outcome.device_error.is_some() || outcome.film().samples().1 == 0 {
        signals.note("warning: the picture is not finished: it has no layers");
        return;
    }
    let name = match device {
        Selected::Cpu => cpu::name(job),
        #[cfg(feature = "gpu")]
        Selected::Gpu(adapter) => adapter.describe(),
    };
    signals.note(&format!("layers: {} ({name})", job.wanted.text()));
    let pass = Pass {
        scene,
        job,
        signals,
        #[cfg(feature = "gpu")]
        adapter: match device {
            Selected::Cpu => None,
            Selected::Gpu(adapter) => Some(adapter),
        },
    };
    match gather(&pass, &mut outcome.picture.film) {
        Ok(layers) => outcome.picture.layers = Some(layers),
        Err(GatherError::Cancelled) => {
            signals.note("warning: interrupted while layers were made: the picture has none");
            outcome.stop = Stop::Cancelled;
        }
        Err(error @ (GatherError::Cpu(_) | GatherError::Bug(_))) => {
            outcome.device_error = Some(format!("the picture has no layers: {error}"));
        }
    }
}

/// Starts the threads that save what is rendered and show it.
fn start_keepers<'scope>(
    scope: &'scope Scope<'scope, '_>,
    (scene, job): (&'scope Scene, &'scope Job),
    shared: &'scope Shared,
    signals: &'scope Signals,
) {
    let thread = |name: &str| std::thread::Builder::new().name(name.to_owned());
    if let Some(saver) = shared.saver()
        && let Err(error) = thread("rtr-saver").spawn_scoped(scope, move || saver.work(signals))
    {
        signals.note(&format!("warning: no checkpoints during this run: {error}"));
    }
    let show = move |previewer: &Previewer| {
        previewer.work(signals, |signals| coarse(scene, job, signals), || shared.meta_now());
    };
    if let Some(previewer) = shared.previewer()
        && let Err(error) = thread("rtr-preview").spawn_scoped(scope, move || show(previewer))
    {
        signals.note(&format!("warning: no picture before the last one: {error}"));
    }
}

/// What is known of a picture before it is rendered.
fn meta(scene: &Scene, job: &Job) -> Meta {
    Meta {
        render_id: render_id(scene, job),
        seed: job.seed,
        estimator: job.estimator,
        clamp_indirect: job.clamp_indirect,
        adaptive: job.measure.as_ref().is_some_and(|measure| measure.adaptive),
        precision: job.precision.name().to_owned(),
        commit: commit::COMMIT.unwrap_or_default().to_owned(),
        exposure: scene.settings().exposure,
        tone_map: scene.settings().tone_map,
        ..Meta::default()
    }
}

/// Another camera than the pack's makes another picture, which is no part of one of the pack's.
fn render_id(scene: &Scene, job: &Job) -> String {
    let Some(camera) = &job.camera else { return scene.render_id() };
    let mut hasher = blake3::Hasher::new();
    hasher.update(&scene.pack().render_id()).update(bytemuck::bytes_of(camera));
    hasher.finalize().to_hex().to_string()
}

/// What the backends are given.
struct Backends<'a> {
    scene: &'a Scene,
    job: &'a Job,
    #[cfg(feature = "gpu")]
    choice: &'a DeviceChoice,
}

impl Backends<'_> {
    /// Renders on the device; with `auto`, the CPU finishes what a GPU could not. Gives what became
    /// of the device when nothing went on.
    fn render(&self, device: &Selected, run: &Run<'_>) -> Option<String> {
        let setup = self.scene.setup(self.job);
        match device {
            Selected::Cpu => {}
            #[cfg(feature = "gpu")]
            Selected::Gpu(adapter) => {
                begin(adapter.describe(), run);
                let error = gpu::render(adapter, &setup, self.job, run).err()?;
                if *self.choice != DeviceChoice::Auto {
                    run.abort();
                    return Some(error.to_string());
                }
                run.note(&format!("{error}; continuing on the CPU"));
            }
        }
        begin(cpu::name(self.job), run);
        let error = cpu::render(&setup, self.job, run).err()?;
        run.abort();
        Some(error.to_string())
    }
}

fn begin(name: String, run: &Run<'_>) {
    run.note(&format!("device: {name}"));
    run.device(name);
}

enum Selected {
    Cpu,
    #[cfg(feature = "gpu")]
    Gpu(Box<gpu::Adapter>),
}

#[cfg(not(feature = "gpu"))]
fn select(choice: &DeviceChoice, _job: &Job) -> Result<Selected, RenderError> {
    match choice {
        DeviceChoice::Auto | DeviceChoice::Cpu => Ok(Selected::Cpu),
        DeviceChoice::Gpu | DeviceChoice::Named(_) => Err(RenderError::NoDevice(
            "this rtr was built without GPU support: use --device cpu".to_owned(),
        )),
    }
}

#[cfg(feature = "gpu")]
fn select(choice: &DeviceChoice, job: &Job) -> Result<Selected, RenderError> {
    if *choice == DeviceChoice::Cpu {
        return Ok(Selected::Cpu);
    }
    if job.precision == Precision::F64 {
        return match choice {
            DeviceChoice::Auto => Ok(Selected::Cpu),
            _ => Err(JobError::Precision.into()),
        };
    }
    let mut adapters = gpu::adapters();
    let found = match choice {
        DeviceChoice::Named(name) => adapters.iter().position(|adapter| adapter.matches(name)),
        _ => adapters.iter().position(|adapter| !adapter.is_software()),
    };
    match (found, choice) {
        (Some(i), _) => Ok(Selected::Gpu(Box::new(adapters.swap_remove(i)))),
        (None, DeviceChoice::Auto) => Ok(Selected::Cpu),
        (None, DeviceChoice::Named(name)) => {
            Err(RenderError::NoDevice(format!("no adapter named `{name}`{}", list(&adapters))))
        }
        (None, _) => Err(RenderError::NoDevice(format!("no GPU was found{}", list(&adapters)))),
    }
}

#[cfg(feature = "gpu")]
fn list(adapters: &[gpu::Adapter]) -> String {
    if adapters.is_empty() {
        return "; this machine has no adapter, use --device cpu".to_owned();
    }
    let names: Vec<String> = adapters.iter().map(gpu::Adapter::describe).collect();
    format!("; available: {}", names.join("; "))
}

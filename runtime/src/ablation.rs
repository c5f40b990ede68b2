//! Pack + device → what specialising its kernel is worth: the same scene with its own kernel, with the one
//! that has all features, and with each feature that it lacks added alone.
//!
//! Every kernel is timed in turns with the pack's own, so that a machine that warms up or is busy with
//! something else favours neither, and every picture is compared with the pack's own. The CPU has one kernel,
//! translated when `rtr` was built, with every feature in it: there is nothing to leave out there, and its
//! picture is what software adapters must give bit for bit.

use crate::control::Control;
use crate::convergence::{Measure, Reference};
use crate::film::Film;
use crate::gpu::{Adapter, GpuError, Ready, adapters};
use crate::job::Job;
use crate::render::{DeviceChoice, RenderError, render};
use crate::run::{Framing, Run};
use crate::scene::Scene;
use crate::schedule::Stop;
use crate::setup::Setup;
use crate::trust::{FULL, RENDER, Trust, Wanted, is_same, judge, relink};
use pack::features as bit;
use pack::manifest::KernelSize;
use serde::Serialize;
use std::sync::Arc;
use std::time::Duration;
use thiserror::Error;

/// Standard errors beyond which two pictures of independent noise do not show the same. One in 30,000 is
/// beyond by chance, and there are up to fifty pictures.
const BELIEVED: f64 = 4.0;

/// Makes the seed of a picture whose noise is another, also in its replicates.
const OTHER_NOISE: u32 = 0x5bd1_e995;

/// How much is measured.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Plan {
    /// Timed renders of each kernel; the median counts.
    pub rounds: u32,
    /// Whether the kernel with all features is measured. Some drivers take minutes to build it.
    pub full: bool,
    /// Whether each absent feature is measured alone.
    pub each: bool,
}

/// Nothing could be compared.
#[derive(Debug, Error)]
pub enum AblationError {
    /// The reference picture on the CPU, or the choice of a device.
    #[error(transparent)]
    Render(#[from] RenderError),
    /// The device failed.
    #[error(transparent)]
    Gpu(#[from] GpuError),
    /// The pack was not made by this version.
    #[error(
        "line {line} of the pack's kernel is not from this rtr: compile the scene again to compare kernels"
    )]
    Unknown {
        /// Line in the kernel.
        line: usize,
    },
}

/// A kernel and what it costs.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Row {
    /// `specialised`, `full`, or the feature that was added.
    pub kernel: String,
    /// Lines of WGSL, see `KernelSize::lines_of`.
    pub wgsl_lines: u32,
    /// Words of SPIR-V, without names and checks; `None` where this build cannot write it.
    pub spirv_words: Option<u32>,
    /// What the device made of it; `None` where there is none.
    pub measured: Option<Measured>,
}

/// A kernel on a device.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Measured {
    /// Building the pipeline, seconds. A driver that keeps compiled kernels on disk makes it short.
    pub build_s: f64,
    /// One sample of every pixel, milliseconds.
    pub ms: f64,
    /// The specialised kernel in the same rounds.
    pub specialised_ms: f64,
    /// Pixels whose bits differ from those of the specialised kernel on the same device.
    pub differ: usize,
    /// Pixels whose bits differ from those of the CPU kernel.
    pub differ_cpu: usize,
    /// Where bits differ on a real GPU, which may round sums as it likes: the difference of two pictures of
    /// independent noise beyond that noise, in standard errors.
    pub z: Option<f64>,
}

impl Measured {
    /// Time against that of the specialised kernel.
    #[must_use]
    pub fn ratio(&self) -> f64 {
        self.ms / self.specialised_ms
    }
}

/// The whole comparison.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Ablation {
    /// Name of this kind of document and its version, see `docs/json.md`.
    pub schema: &'static str,
    /// Of `rtr`.
    pub version: &'static str,
    /// Hexadecimal name of what was rendered.
    pub scene: String,
    /// Pixels.
    pub image: [u32; 2],
    /// Samples of every pixel in each round.
    pub samples: u32,
    /// Rounds of each kernel.
    pub rounds: u32,
    /// The adapter; `None`: there is none, and only texts were compared.
    pub device: Option<String>,
    /// Whether the adapter is software, which must give the bits of the CPU.
    pub software: bool,
    /// One sample of every pixel with the CPU kernel, which has all features, milliseconds.
    pub cpu_ms: f64,
    /// The specialised kernel first, then what the plan asks for: the full one, then one feature each.
    pub rows: Vec<Row>,
    /// Whether it ended early; then rows are missing.
    pub interrupted: bool,
}

impl Ablation {
    /// Rows that do not show what the specialised kernel shows: other bits than the CPU on a software adapter,
    /// more than noise on a GPU.
    #[must_use]
    pub fn wrong(&self) -> Vec<&Row> {
        let wrong = |row: &&Row| {
            row.measured.is_some_and(|measured| match measured.z {
                Some(z) => z > BELIEVED,
                None => measured.differ > 0 || (self.software && measured.differ_cpu > 0),
            })
        };
        self.rows.iter().filter(wrong).collect()
    }
}

/// What a comparison tells while it goes on.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Event<'a> {
    /// The kernel of this name is built and timed.
    Begin(&'a str),
    /// That is done.
    End(&'a Row),
}

/// Compares the kernels. Ends early when `control` is cancelled.
///
/// # Errors
/// When there is nothing to compare with, or the device fails.
pub fn ablate(
    scene: &Scene,
    job: &Job,
    choice: &DeviceChoice,
    plan: Plan,
    control: &Control,
    tell: &mut dyn FnMut(Event<'_>),
) -> Result<Ablation, AblationError> {
    let setup = scene.setup(job);
    if let Trust::Unknown { line } = judge(&setup) {
        return Err(AblationError::Unknown { line });
    }
    let adapter = adapter(choice)?;
    let cpu = render(scene, job, &DeviceChoice::Cpu, control)?;
    let mut ablation = Ablation {
        schema: "rtr.ablation/1",
        version: env!("CARGO_PKG_VERSION"),
        scene: scene.render_id(),
        image: job.image_size,
        samples: job.spp(),
        rounds: plan.rounds,
        device: adapter.as_ref().map(Adapter::describe),
        software: adapter.as_ref().is_some_and(Adapter::is_software),
        cpu_ms: ms(cpu.elapsed, job),
        rows: Vec::new(),
        interrupted: cpu.stop == Stop::Cancelled,
    };
    let mut bench = match &adapter {
        None => None,
        Some(adapter) => Some(Bench::open(adapter, scene, job, control)?),
    };
    for (name, text) in kernels(&setup, plan) {
        if ablation.interrupted || control.is_cancelled() {
            ablation.interrupted = true;
            break;
        }
        tell(Event::Begin(&name));
        let measured = match &mut bench {
            None => None,
            Some(bench) => match bench.measure(&text, plan.rounds, cpu.film())? {
                None => continue,
                measured => measured,
            },
        };
        let wgsl_lines = KernelSize::lines_of(&text);
        let row = Row { kernel: name, wgsl_lines, spirv_words: words(&text), measured };
        tell(Event::End(&row));
        ablation.rows.push(row);
    }
    ablation.interrupted |= control.is_cancelled();
    Ok(ablation)
}

/// Name and text of the kernels that `ablate` compares, the pack's own first.
#[must_use]
pub fn kernel_texts(scene: &Scene, each: bool) -> Vec<(String, String)> {
    kernels(&scene.setup(&Job::of_scene(scene)), Plan { rounds: 0, full: true, each })
}

/// The pack's own kernel, put together again from the table of declarations as the others are: the same declarations,
/// in another order. `None` if it has one that the table does not know.
#[must_use]
pub fn relinked(scene: &Scene) -> Option<String> {
    let job = Job::of_scene(scene);
    let setup = scene.setup(&job);
    relink(&setup, Wanted::of(&setup), RENDER)
}

/// Name and text of every kernel that can render the scene of `setup` and is another than those before it.
fn kernels(setup: &Setup<'_>, plan: Plan) -> Vec<(String, String)> {
    let own = setup.kernel().to_owned();
    let mut all = vec![("specialised".to_owned(), own.clone())];
    let fits = setup.stack_need() <= crate::kernel::f32::STACK_SIZE && !has_windows(&own);
    if plan.full && fits {
        all.push(("full".to_owned(), FULL.to_owned()));
    }
    if plan.each {
        let wanted = Wanted::of(setup);
        let bits = bit::NAMES.iter().filter(|(more, _)| wanted.features & more == 0);
        // These are other ways to do what the kernel does, and no additions to it.
        let other = bit::SAMPLER_PCG | bit::WIDE_NODES | bit::CAMERAS | bit::FILTERS;
        let bits = bits.filter(|(more, _)| more & other == 0);
        let mut more: Vec<(&str, Wanted)> =
            bits.map(|(more, name)| (*name, wanted.with(*more))).collect();
        if !wanted.smooth {
            more.push(("smooth normals", Wanted { smooth: true, ..wanted }));
        }
        for (name, wanted) in more {
            let text = relink(setup, wanted, RENDER).filter(|text| !is_same(text, &own));
            all.extend(text.map(|text| (name.to_owned(), text)));
        }
    }
    all
}

/// Whether a section is so large that it is bound in several windows, which the full kernel is not made for.
fn has_windows(kernel: &str) -> bool {
    kernel.contains("_words_1")
}

fn adapter(choice: &DeviceChoice) -> Result<Option<Adapter>, AblationError> {
    let mut all = adapters();
    let found = match choice {
        DeviceChoice::Cpu => return Ok(None),
        // Better a software adapter than nothing to compare.
        DeviceChoice::Auto => return Ok(all.into_iter().next()),
        DeviceChoice::Gpu => all.iter().position(|adapter| !adapter.is_software()),
        DeviceChoice::Named(name) => all.iter().position(|adapter| adapter.matches(name)),
    };
    match (found, choice) {
        (Some(i), _) => Ok(Some(all.swap_remove(i))),
        (None, DeviceChoice::Named(name)) => {
            let text = format!("no adapter named `{name}`; rtr --list-devices shows them");
            Err(RenderError::NoDevice(text).into())
        }
        (None, _) => Err(RenderError::NoDevice("no GPU was found".to_owned()).into()),
    }
}

fn ms(time: Duration, job: &Job) -> f64 {
    time.as_secs_f64() * 1e3 / f64::from(job.spp().max(1))
}

/// The specialised kernel on a device, ready to be compared with.
struct Bench<'a> {
    adapter: &'a Adapter,
    scene: &'a Scene,
    job: &'a Job,
    control: &'a Control,
    own: Ready,
    film: Option<Film>,
}

impl<'a> Bench<'a> {
    fn open(
        adapter: &'a Adapter,
        scene: &'a Scene,
        job: &'a Job,
        control: &'a Control,
    ) -> Result<Self, AblationError> {
        let own = Ready::open(adapter, &scene.setup(job), job)?;
        Ok(Self { adapter, scene, job, control, own, film: None })
    }

    /// `None` when it was interrupted.
    fn measure(
        &mut self,
        text: &str,
        rounds: u32,
        cpu: &Film,
    ) -> Result<Option<Measured>, AblationError> {
        let Self { adapter, scene, job, control, .. } = *self;
        let own_setup = scene.setup(job);
        let setup = scene.setup(job).with_kernel(text);
        let is_own = text == scene.pack().kernel();
        let mut other = if is_own { None } else { Some(Ready::open(adapter, &setup, job)?) };
        let (mut own_times, mut times, mut film) = (Vec::new(), Vec::new(), None);
        // The first round finds the pace of the device and is not timed.
        for round in 0..=rounds {
            let own = timed(&mut self.own, &own_setup, job, control)?;
            let turn = match &mut other {
                None => own.clone(),
                Some(ready) => timed(ready, &setup, job, control)?,
            };
            if control.is_cancelled() {
                return Ok(None);
            }
            if round > 0 {
                own_times.push(ms(own.0, job));
                times.push(ms(turn.0, job));
            }
            self.film.get_or_insert(own.1);
            film = Some(turn.1);
        }
        let (Some(film), Some(own_film)) = (film, &self.film) else { return Ok(None) };
        let built = other.as_ref().unwrap_or(&self.own).built();
        let differ = differing(&film, own_film);
        let z = match &mut other {
            Some(ready) if differ > 0 && !adapter.is_software() => {
                self.beyond_noise(ready, text)?
            }
            _ => None,
        };
        Ok(Some(Measured {
            build_s: built.as_secs_f64(),
            ms: median(times),
            specialised_ms: median(own_times),
            differ,
            differ_cpu: differing(&film, cpu),
            z,
        }))
    }

    /// The difference of the two kernels beyond the noise of their pictures, which have different seeds.
    fn beyond_noise(
        &mut self,
        other: &mut Ready,
        text: &str,
    ) -> Result<Option<f64>, AblationError> {
        let Self { scene, job, control, .. } = *self;
        let first = Job { measure: Some(Measure::default()), ..job.clone() };
        let (_, film) = timed(&mut self.own, &scene.setup(&first), &first, control)?;
        let reference = Some(Arc::new(Reference::of(&film)));
        let measure = Some(Measure { reference, ..Measure::default() });
        let second = Job { measure, seed: job.seed ^ OTHER_NOISE, ..job.clone() };
        let run = new_run(&second, control)?;
        other.render(&scene.setup(&second).with_kernel(text), &run)?;
        let convergence = control.finish(&run).and_then(|finished| finished.convergence);
        let last = convergence.and_then(|convergence| convergence.points.last().copied());
        Ok(last.and_then(|point| point.versus).and_then(|versus| versus.z))
    }
}

fn timed(
    ready: &mut Ready,
    setup: &Setup<'_>,
    job: &Job,
    control: &Control,
) -> Result<(Duration, Film), AblationError> {
    let run = new_run(job, control)?;
    ready.render(setup, &run)?;
    let finished = control.finish(&run).ok_or(RenderError::Salvaged)?;
    Ok((finished.elapsed, finished.film))
}

fn new_run<'a>(job: &Job, control: &'a Control) -> Result<Run<'a>, RenderError> {
    Ok(control.start(job, None, Framing::default())?)
}

/// Pixels whose bits are not the same.
fn differing(a: &Film, b: &Film) -> usize {
    let bits = |rgb: [f64; 3]| rgb.map(f64::to_bits);
    let (a, b) = (a.means(), b.means());
    let pairs = a.iter().zip(&b).filter(|(a, b)| bits(**a) != bits(**b)).count();
    pairs + a.len().abs_diff(b.len())
}

fn median(mut values: Vec<f64>) -> f64 {
    values.sort_by(f64::total_cmp);
    let n = values.len();
    if n == 0 { f64::NAN } else { f64::midpoint(values[(n - 1) / 2], values[n / 2]) }
}

/// Words of a kernel in SPIR-V, as `rtc` counts them.
#[cfg(not(target_vendor = "apple"))]
fn words(kernel: &str) -> Option<u32> {
    use wgpu::naga::{back::spv, front::wgsl, valid};
    let module = wgsl::parse_str(kernel).ok()?;
    let mut validator =
        valid::Validator::new(valid::ValidationFlags::all(), valid::Capabilities::empty());
    let info = validator.validate(&module).ok()?;
    let options = spv::Options { flags: spv::WriterFlags::empty(), ..spv::Options::default() };
    let words = spv::write_vec(&module, &info, &options, None).ok()?;
    u32::try_from(words.len()).ok()
}

/// Metal alone needs no SPIR-V.
#[cfg(target_vendor = "apple")]
fn words(_kernel: &str) -> Option<u32> {
    None
}

//! Scene + job + device → film: chooses the device, renders, and survives its loss.

use crate::control::Control;
use crate::cpu;
use crate::film::Film;
use crate::job::{Job, JobError};
use crate::output::{Meta, Picture};
use crate::run::{Run, TileFailure};
use crate::scene::Scene;
use crate::schedule::Stop;
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
    /// No adapter is what was asked for.
    #[error("{0}")]
    NoDevice(String),
}

/// What a run gives.
#[derive(Clone, Debug, PartialEq)]
pub struct Outcome {
    /// The film and what is known about it.
    pub picture: Picture,
    /// Why the run ended.
    pub stop: Stop,
    /// Tiles that could not be rendered; bugs.
    pub failures: Vec<TileFailure>,
    /// What became of the device, when it could not finish.
    pub device_error: Option<String>,
    /// Time from the first claim to the last deposit.
    pub elapsed: Duration,
}

impl Outcome {
    /// The film.
    #[must_use]
    pub fn film(&self) -> &Film {
        &self.picture.film
    }

    /// Whether more than one sample in 10^7 was not finite.
    #[must_use]
    pub fn too_many_bad(&self) -> bool {
        self.film().counters.bad as f64 > 1e-7 * self.film().total_samples() as f64
    }
}

/// Renders `job`. Whatever goes wrong on the way, the outcome holds every batch that was complete.
pub fn render(
    scene: &Scene,
    job: &Job,
    choice: &DeviceChoice,
    control: &Control,
) -> Result<Outcome, RenderError> {
    job.check()?;
    let device = select(choice, job)?;
    let setup = scene.setup(job);
    let run = Run::new(job, control);
    let mut names: Vec<String> = Vec::new();
    let mut device_error = None;
    let mut on_cpu = matches!(device, Selected::Cpu);
    #[cfg(feature = "gpu")]
    if let Selected::Gpu(adapter) = device {
        run.note(&format!("device: {}", adapter.describe()));
        names.push(adapter.describe());
        if let Err(error) = gpu::render(&adapter, &setup, job, &run) {
            if *choice == DeviceChoice::Auto {
                run.note(&format!("{error}; the CPU goes on"));
                on_cpu = true;
            } else {
                device_error = Some(error.to_string());
                run.abort();
            }
        }
    }
    if std::mem::take(&mut on_cpu) {
        let name = cpu::name(job);
        run.note(&format!("device: {name}"));
        names.push(name);
        if let Err(error) = cpu::render(&setup, job, &run) {
            device_error = Some(error.to_string());
            run.abort();
        }
    }
    let finished = run.finish();
    let meta = Meta {
        render_id: scene.render_id(),
        seed: job.seed,
        estimator: job.estimator,
        precision: job.precision.name().to_owned(),
        device: names.join(" + "),
        seconds: finished.elapsed.as_secs_f64(),
        exposure: scene.settings().exposure,
        tone_map: scene.settings().tone_map,
        complete: finished.stop == Stop::Complete && finished.failures.is_empty(),
    };
    Ok(Outcome {
        picture: Picture { film: finished.film, meta },
        stop: finished.stop,
        failures: finished.failures,
        device_error,
        elapsed: finished.elapsed,
    })
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
            "this rtr was built without GPUs: use --device cpu".to_owned(),
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
            Err(RenderError::NoDevice(format!("no adapter is called `{name}`{}", list(&adapters))))
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
    format!("; there are: {}", names.join("; "))
}

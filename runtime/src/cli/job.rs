//! `rtr job scene.pack`: writes the files of a job that renders a picture on many machines.

use super::args::Verify;
use super::console::{Console, reset_interrupts};
use super::exit::Exit;
use super::guard::Guard;
use super::job_args::{JobArgs, JobFormat};
use super::open::{How, is_stdin, open};
use super::outputs::{Claim, Use, prove, save};
use super::progress::duration_text;
use super::timed::timed;
use crate::farm::{self, Engine, Plan, chunk_for};
use crate::job::Job;
use crate::scene::Scene;
use pack::abi::BATCH;
use std::path::PathBuf;
use std::time::Duration;

pub(super) fn command(args: &JobArgs) -> Exit {
    let console = Console::with_progress(args.quiet);
    reset_interrupts();
    match write(args, &console) {
        Ok(()) => Exit::Done,
        Err(exit) => exit,
    }
}

fn write(args: &JobArgs, console: &Console) -> Result<(), Exit> {
    let path = &args.pack;
    if is_stdin(path) {
        console.warn("error: the tasks of a job open the pack by its name: name a file");
        return Err(Exit::Usage);
    }
    let pack = open(path, How::Map).map_err(|e| console.fail_about(path, &e, Exit::World))?;
    let scene = Scene::new(pack);
    let guard = Guard::new(console, path, scene.pack(), Verify::First)?;
    let mut job = Job::of_scene(&scene);
    if let Some(size) = args.size {
        job.resize(size);
    }
    job.seed = args.seed.unwrap_or(job.seed);
    job.threads = args.threads;
    let (size, samples) = (job.image_size, args.spp.unwrap_or(job.samples.count()));
    job.check().map_err(|error| console.fail(&error, Exit::Usage))?;
    let batches = samples.div_ceil(BATCH);
    let chunk = if let Some(chunk) = args.chunk {
        chunk.min(batches)
    } else {
        let frame = measured(args, console, (&scene, &guard), job)?;
        let batch = frame.mul_f64(share_of_task(size, args.tile));
        let chunk = chunk_for(batch, args.task_time, batches);
        console.note(&format!(
            "a batch of {BATCH} samples takes about {} here, {chunk} of them {}",
            duration_text(batch),
            duration_text(batch * chunk)
        ));
        if batch > args.task_time * 2 {
            console.warn(
                "warning: no task can be shorter than a batch; --tile cuts the frame into crops, too",
            );
        }
        chunk
    };
    let plan = plan(args, size, samples, chunk);
    let (files, commands) = farm::files(&plan, engine(args.format));
    let folder = args.output.clone().unwrap_or_default();
    let paths: Vec<PathBuf> = files.iter().map(|file| folder.join(&file.name)).collect();
    let claims: Vec<_> = paths.iter().map(|path| Claim::new(path, "the job", 0)).collect();
    prove(console, &[Use { path, what: "the pack" }], &claims)?;
    for (path, file) in paths.iter().zip(&files) {
        save(console, path, file.text.as_bytes())?;
    }
    console.note(&format!("{} tasks of {}; submit them with", plan.tasks(), plan.task_text()));
    for line in commands {
        console.note(&format!("  {line}"));
    }
    Ok(())
}

fn engine(format: JobFormat) -> Engine {
    match format {
        JobFormat::Openjd => Engine::OpenJd,
        JobFormat::Slurm => Engine::Slurm,
        JobFormat::Sh => Engine::Shell,
    }
}

/// How many of the frame's pixels a task has.
fn share_of_task(size: [u32; 2], tile: Option<[u32; 2]>) -> f64 {
    let pixels = |[w, h]: [u32; 2]| f64::from(w) * f64::from(h);
    tile.map_or(1.0, |tile| (pixels(tile) / pixels(size)).min(1.0))
}

fn plan(args: &JobArgs, size: [u32; 2], samples: u32, chunk: u32) -> Plan {
    let mut flags = Vec::new();
    if let Some([width, height]) = args.size {
        flags.extend(["--size".to_owned(), format!("{width}x{height}")]);
    }
    if let Some(seed) = args.seed {
        flags.extend(["--seed".to_owned(), seed.to_string()]);
    }
    if args.device != "auto" {
        flags.extend(["--device".to_owned(), args.device.clone()]);
    }
    if !args.layers.is_empty() {
        let names: Vec<&str> = args.layers.iter().map(|layer| layer.name()).collect();
        flags.extend(["--layers".to_owned(), names.join(",")]);
    }
    let name = args.pack.file_stem().map_or_else(|| "job".into(), |stem| stem.to_string_lossy());
    let (name, pack) = (name.into_owned(), args.pack.display().to_string());
    Plan { name, pack, size, tile: args.tile, samples, chunk, flags }
}

/// What a batch of the whole frame takes on this machine.
fn measured(
    args: &JobArgs,
    console: &Console,
    (scene, guard): (&Scene, &Guard),
    mut job: Job,
) -> Result<Duration, Exit> {
    let outcome = timed(console, guard, (scene, &mut job), (&args.device, args.measure))?;
    let mean = outcome.film().total_samples() as f64 / job.crop.pixels() as f64;
    if mean <= 0.0 {
        console.warn(
            "error: the measurement was too short for one sample; give it more with --measure 60s",
        );
        return Err(Exit::World);
    }
    Ok(Duration::from_secs_f64(outcome.elapsed.as_secs_f64() * f64::from(BATCH) / mean))
}

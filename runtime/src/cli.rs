//! The command line of `rtr`: arguments → a run → files and an exit code.
//!
//! This module and its children are the only place of the crate that prints. Exit codes: 0 done;
//! 1 too many samples were not finite, or `check` found the scene not
//! stable, or `--ablate` pictures that differ; 2 usage; 3 input, output or device; 70 a bug of ours; 130
//! interrupted, after everything complete was written.

mod ablate;
mod args;
mod bench;
mod change;
mod check;
mod console;
mod denoise;
mod denoise_args;
mod exit;
mod guard;
mod job;
mod job_args;
mod layer_args;
mod layers;
mod measure;
mod open;
mod outputs;
mod pick;
mod pictures;
mod progress;
mod render;
mod timed;
mod values;
mod view;
mod viewer;
mod watch;

use self::args::{Args, Command, MergeArgs};
use self::console::Console;
use self::exit::Exit;
use self::outputs::{Claim, prove, save};
use crate::output;
use crate::region::SampleRange;
use crate::signals::Observer;
use clap::Parser as _;
use files::ShowPath as _;
use std::ffi::OsString;
use std::path::Path;
use std::process::ExitCode;

/// Runs `rtr` with these arguments, the program's name first. May be called several times in one
/// process.
pub fn run(args: impl IntoIterator<Item = impl Into<OsString> + Clone>) -> ExitCode {
    run_observed(args, &|_| ())
}

/// The same; `observer` is told what happens while a picture is rendered.
pub fn run_observed(
    args: impl IntoIterator<Item = impl Into<OsString> + Clone>,
    observer: &'static Observer,
) -> ExitCode {
    let args = match Args::try_parse_from(args) {
        Ok(args) => args,
        Err(error) => {
            // Help and version arrive here too, with code 0. Nothing is left to do if printing fails.
            let _ = error.print();
            let usage = error.use_stderr();
            return code(if usage { Exit::Usage } else { Exit::Done });
        }
    };
    let wanted = match &args.command {
        Some(Command::Merge(_)) => None,
        Some(Command::Bench(bench)) => bench.threads,
        Some(Command::Check(check)) => check.threads,
        Some(Command::View(view)) => view.threads,
        Some(Command::Job(job)) => job.threads,
        None => args.render.threads,
    };
    if let Err(error) = host::start_pool(wanted) {
        return code(Console::new(false).fail(&error, Exit::World));
    }
    let exit = match &args.command {
        Some(Command::Merge(merge)) => merge_command(merge),
        Some(Command::Bench(bench)) => bench::command(bench),
        Some(Command::Check(args)) => check::command(args),
        Some(Command::View(args)) => view::command(args),
        Some(Command::Job(args)) => job::command(args),
        None if args.render.list_devices => list_devices(),
        None if args.render.ablate.is_some() => ablate::command(&args.render),
        None if args.render.pick.is_some() => pick::command(&args.render),
        None if args.render.watch => watch::command(&args.render, observer),
        None => render::command(&args.render, observer, None),
    };
    // What could not be printed is an output that could not be written.
    code(if console::has_lost_output() && exit == Exit::Done { Exit::World } else { exit })
}

fn code(exit: Exit) -> ExitCode {
    ExitCode::from(exit as u8)
}

fn list_devices() -> Exit {
    let console = Console::new(false);
    let threads = host::threads();
    console.result(&format!("cpu: CPU kernel ({threads} threads)"));
    #[cfg(feature = "gpu")]
    {
        let adapters = crate::gpu::adapters();
        for adapter in &adapters {
            let kind = if adapter.is_software() { "by name only" } else { "gpu" };
            console.result(&format!("{kind}: {}", adapter.describe()));
        }
        if !adapters.iter().any(|adapter| !adapter.is_software()) {
            console.result("no GPU was found; `auto` is the CPU kernel");
        }
    }
    Exit::Done
}

fn merge_command(args: &MergeArgs) -> Exit {
    let console = Console::new(args.quiet).beside(&args.output);
    let formats: Result<Vec<_>, String> =
        args.output.iter().map(|path| outputs::format(path, args.format)).collect();
    let formats = match formats {
        Ok(formats) => formats,
        Err(text) => {
            console.warn(&format!("error: {text}"));
            return Exit::World;
        }
    };
    let inputs: Vec<_> =
        args.parts.iter().map(|path| outputs::Use { path, what: "a part" }).collect();
    let claims = args.output.iter().map(|path| Claim::new(path, "the merged picture", 0));
    if let Err(exit) = prove(&console, &inputs, &claims.collect::<Vec<_>>()) {
        return exit;
    }
    let denoiser = match denoise::open(&args.denoise, &console, &formats, None) {
        Ok(denoiser) => denoiser,
        Err(exit) => return exit,
    };
    let mut parts = Vec::new();
    for path in &args.parts {
        match output::read_exr(path) {
            Ok(picture) => parts.push(picture),
            Err(error) => return console.fail(&error, Exit::World),
        }
    }
    let mut picture = match output::merge(parts) {
        Ok(picture) => picture,
        Err(error) => {
            for (i, path) in (1..).zip(&args.parts) {
                console.note(&format!("part {i} is {}", path.shown()));
            }
            return console.fail(&error, Exit::World);
        }
    };
    if let Some(whole) = args.samples {
        let ranges = &picture.film.ranges;
        let missing = output::missing(ranges, whole);
        if !missing.is_empty() {
            return missing_parts(&console, args, &missing);
        }
        if ranges.as_slice() != [whole] {
            let found = ranges.iter().map(ToString::to_string).collect::<Vec<_>>().join(",");
            console.warn(&format!("error: the parts have samples {found}, more than {whole}"));
            return Exit::World;
        }
    }
    let mut exit = Exit::Done;
    if let Some(denoiser) = &denoiser {
        exit = denoise::denoise(&console, denoiser, &mut picture).err().unwrap_or(exit);
    }
    for (path, format) in args.output.iter().zip(formats) {
        let bytes = match output::encode(format, &picture, true) {
            Ok(bytes) => bytes,
            Err(error) => return console.fail(&error, Exit::Bug),
        };
        exit = save(&console, path, &bytes).err().unwrap_or(exit);
    }
    exit
}

/// Says which samples no part has, and the command that renders them.
fn missing_parts(console: &Console, args: &MergeArgs, missing: &[SampleRange]) -> Exit {
    let text = missing.iter().map(ToString::to_string).collect::<Vec<_>>().join(",");
    console.warn(&format!("error: samples {text} are missing"));
    let folder = args.parts.first().and_then(|part| part.parent()).unwrap_or(Path::new(""));
    for range in missing {
        let part = folder.join(format!("samples-{}-{}.exr", range.start, range.end));
        console.warn(&format!(
            "help: render them with the flags of the other parts: rtr SCENE.pack --samples {range} -o {}",
            part.shown()
        ));
    }
    Exit::World
}

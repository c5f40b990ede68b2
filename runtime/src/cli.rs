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
mod merge;
mod merge_args;
mod open;
mod outputs;
mod pick;
mod pictures;
mod progress;
mod render;
mod summary;
mod timed;
mod values;
mod view;
mod viewer;
mod watch;

use self::args::{Args, Command};
use self::console::Console;
use self::exit::Exit;
use crate::signals::Observer;
use clap::Parser as _;
use std::ffi::OsString;
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
        Some(Command::Merge(merge)) => merge::command(merge),
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

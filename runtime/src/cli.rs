//! The command line of `rtr`: arguments → a run → files and an exit code.
//!
//! This module and its children are the only place of the crate that prints. Exit codes: 0 done;
//! 1 too many samples were not finite, or `check` found the scene not
//! stable, or `--ablate` pictures that differ; 2 usage; 3 input, output or device; 70 a bug of ours; 130
//! interrupted, after everything complete was written.

mod ablate;
mod args;
mod bench;
mod check;
mod console;
mod measure;
mod render;
mod watch;

use self::args::{Args, Command, MergeArgs};
use self::console::Console;
use crate::output;
use clap::Parser as _;
use std::ffi::OsString;
use std::process::ExitCode;

/// How a command ended.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Exit {
    Done = 0,
    NotFinite = 1,
    Usage = 2,
    World = 3,
    Bug = 70,
    Interrupted = 130,
}

/// Runs `rtr` with these arguments, the program's name first. May be called several times in one
/// process.
pub fn run(args: impl IntoIterator<Item = impl Into<OsString> + Clone>) -> ExitCode {
    let args = match Args::try_parse_from(args) {
        Ok(args) => args,
        Err(error) => {
            // Help and version arrive here too, with code 0. Nothing is left to do if printing fails.
            let _ = error.print();
            let usage = error.use_stderr();
            return code(if usage { Exit::Usage } else { Exit::Done });
        }
    };
    code(match &args.command {
        Some(Command::Merge(merge)) => merge_command(merge),
        Some(Command::Bench(bench)) => bench::command(bench),
        Some(Command::Check(args)) => check::command(args),
        None if args.render.list_devices => list_devices(),
        None if args.render.ablate.is_some() => ablate::command(&args.render),
        None if args.render.watch => watch::command(&args.render),
        None => render::command(&args.render, None),
    })
}

fn code(exit: Exit) -> ExitCode {
    ExitCode::from(exit as u8)
}

fn list_devices() -> Exit {
    let console = Console::new(false);
    let threads = rayon::current_num_threads();
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
    let console = Console::new(args.quiet);
    let mut parts = Vec::new();
    for path in &args.parts {
        match output::read_exr(path) {
            Ok(picture) => parts.push(picture),
            Err(error) => return console.fail(&error, Exit::World),
        }
    }
    let picture = match output::merge(parts) {
        Ok(picture) => picture,
        Err(error) => {
            for (i, path) in (1..).zip(&args.parts) {
                console.note(&format!("part {i} is {}", path.display()));
            }
            return console.fail(&error, Exit::World);
        }
    };
    for path in &args.output {
        if let Err(error) = output::write(path, &picture, true) {
            return console.fail(&error, Exit::World);
        }
        console.result(&format!("wrote {}", path.display()));
    }
    Exit::Done
}

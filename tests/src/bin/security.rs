//! `cargo run --release -p tests --bin security`: attacks the built `rtc` and `rtr` and rewrites `docs/security.md`.
//!
//! Both programs are taken from the folder of this one: `cargo build --release` comes first. It writes to a temporary
//! folder only, and takes some ten minutes, most of them for ten thousand packs with a flipped bit. Exit code 1 when an
//! attack did not end as it must.

use std::path::{Path, PathBuf};
use std::process::ExitCode;

use clap::Parser;
use tests::attacks::{self, Lab};
use tests::console;

/// Attacks `rtc` and `rtr` and writes down how it ended.
#[derive(Debug, Parser)]
struct Args {
    /// Folder of `rtc` and `rtr` [default: that of this program].
    #[arg(long, value_name = "DIR")]
    programs: Option<PathBuf>,
    /// Try the parts with this text in their titles only, and print their tables: `docs/security.md` stays.
    #[arg(long, value_name = "TEXT")]
    only: Option<String>,
}

const HEADER: &str = "# Security\n\n\
    Made by `cargo build --release && cargo run --release -p tests --bin security`; edit the program, not this page. \
    What is promised, and how to report a gap, is in [SECURITY.md](../SECURITY.md).\n\n\
    Each row is one attack, tried in several ways on the programs as users have them. A try holds when the exit code \
    is one of those named, in time, without a trace of a panic, and nothing was replaced that must stay. Parsers and \
    decoders are fuzzed as well: `cargo run --release -p tests --bin fuzz -- --help`; the seeds in `tests/corpus` are \
    replayed by `cargo test`.\n";

fn main() -> Result<ExitCode, Box<dyn std::error::Error>> {
    let args = Args::parse();
    let own = std::env::current_exe()?;
    let programs = args.programs.or_else(|| own.parent().map(Path::to_owned)).unwrap_or_default();
    let only = args.only.as_deref().unwrap_or_default();
    let parts = attacks::all(&Lab::new(&programs)?, only, &console::line)?;
    let rows = || parts.iter().flat_map(|(_, rows)| rows);
    let (tries, bad): (usize, usize) =
        rows().fold((0, 0), |(tries, bad), row| (tries + row.tries(), bad + row.bad.len()));
    let text = format!(
        "{HEADER}\n{} of {tries} tries hold, of {} attacks.\n{}",
        tries - bad,
        rows().count(),
        attacks::tables(&parts)
    );
    console::line(&text);
    if args.only.is_none() {
        std::fs::write(Path::new(env!("CARGO_MANIFEST_DIR")).join("../docs/security.md"), text)?;
    }
    Ok(if bad == 0 { ExitCode::SUCCESS } else { ExitCode::FAILURE })
}

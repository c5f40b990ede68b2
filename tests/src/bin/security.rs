//! `cargo run --release -p tests --bin security`: attacks the built `rtc` and `rtr` and rewrites `docs/security.md`.
//!
//! Both programs are taken from the folder of this one: `cargo build --release` comes first. It writes to a temporary
//! folder only, and takes some ten minutes, most of them for ten thousand packs with a flipped bit. Exit code 1 when an
//! attack did not end as it must.

use std::fmt::Write as _;
use std::path::{Path, PathBuf};
use std::process::ExitCode;

use clap::Parser;
use tests::attacks::{self, Lab};
use tests::{console, flips};

/// Attacks `rtc` and `rtr` and writes down how it ended.
#[derive(Debug, Parser)]
struct Args {
    /// Folder of `rtc` and `rtr` [default: that of this program].
    #[arg(long, value_name = "DIR")]
    programs: Option<PathBuf>,
    /// Try the parts with this text in their titles only, and print their tables: `docs/security.md` stays.
    #[arg(long, value_name = "TEXT")]
    only: Option<String>,
    /// Packs that are rendered with a flipped bit.
    #[arg(long, value_name = "N", default_value_t = 10_000)]
    flips: usize,
}

const HEADER: &str = "# Security\n\n\
    Made by `cargo build --release && cargo run --release -p tests --bin security`; edit the program, not this page. \
    What is promised, and how to report a gap, is in [SECURITY.md](../SECURITY.md).\n\n\
    Each row is one attack, tried in several ways on the programs as users have them. A try holds when the exit code \
    is one of those named, in time, without a trace of a panic, and nothing was replaced that must stay. Parsers and \
    decoders are fuzzed as well: `cargo run --release -p tests --bin fuzz -- --help`; the seeds in `tests/corpus` are \
    replayed by `cargo test`.\n";

/// The part about packs on a bad disk.
const FLIPPED: &str = "Bits that flip";
const FLIPPED_HOW: &str = "Each try flips one bit of a pack and renders it as a user would, with checkpoints as often as \
    can be. The pack must be refused in one line, or give the same picture.";

fn main() -> Result<ExitCode, Box<dyn std::error::Error>> {
    let args = Args::parse();
    let own = std::env::current_exe()?;
    let programs = args.programs.or_else(|| own.parent().map(Path::to_owned)).unwrap_or_default();
    let only = args.only.as_deref().unwrap_or_default();
    let lab = Lab::new(&programs)?;
    let parts = attacks::all(&lab, only, &console::line)?;
    let rows = || parts.iter().flat_map(|(_, rows)| rows);
    let (tries, bad): (usize, usize) =
        rows().fold((0, 0), |(tries, bad), row| (tries + row.tries(), bad + row.bad.len()));
    let mut text = format!(
        "{HEADER}\n{} of {tries} tries hold, of {} attacks; flipped bits are counted below.\n{}",
        tries - bad,
        rows().count(),
        attacks::tables(&parts)
    );
    let mut wrong = 0;
    if FLIPPED.contains(only) {
        console::line(FLIPPED);
        let (table, n) = flips::table(lab.rtr(), args.flips)?;
        wrong = n;
        let _ = write!(text, "\n## {FLIPPED}\n\n{FLIPPED_HOW}\n\n{table}\n");
    }
    console::line(&text);
    if args.only.is_none() {
        std::fs::write(Path::new(env!("CARGO_MANIFEST_DIR")).join("../docs/security.md"), text)?;
    }
    Ok(if bad + wrong == 0 { ExitCode::SUCCESS } else { ExitCode::FAILURE })
}

//! `cargo run --release -p tests --bin benchmarks`: measures and rewrites `docs/benchmarks.md`. With names of
//! tables, as in `benchmarks open first`, it only prints those.

use std::error::Error;
use std::path::Path;
use std::process::ExitCode;

use clap::Parser;
use clap::builder::{PossibleValue, PossibleValuesParser};
use tests::{benchmarks, console};

/// Measures the tables of `docs/benchmarks.md`, in CPU seconds of this machine.
#[derive(Debug, Parser)]
#[command(after_help = "Examples:\n  \
    benchmarks               measures all tables (this takes long) and rewrites docs/benchmarks.md\n  \
    benchmarks open first    prints two tables and writes nothing")]
struct Args {
    /// Tables to print, instead of all in `docs/benchmarks.md`.
    #[arg(value_name = "TABLE", value_parser = tables())]
    tables: Vec<String>,
}

fn tables() -> PossibleValuesParser {
    let each = benchmarks::TABLES.iter();
    PossibleValuesParser::new(each.map(|table| PossibleValue::new(table.name).help(table.about)))
}

fn main() -> Result<ExitCode, Box<dyn Error>> {
    let mut arguments = std::env::args().skip(1);
    let first = arguments.next().unwrap_or_default();
    if let Some(code) = benchmarks::child(&first, arguments) {
        return Ok(ExitCode::from(code));
    }
    let Args { tables } = Args::parse();
    let text = benchmarks::page(&tables)?;
    if tables.is_empty() {
        std::fs::write(Path::new(env!("CARGO_MANIFEST_DIR")).join("../docs/benchmarks.md"), &text)?;
    }
    console::line(&text);
    Ok(ExitCode::SUCCESS)
}

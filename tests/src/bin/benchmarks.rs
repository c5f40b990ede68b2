//! `cargo run --release -p tests --bin benchmarks`: measures and rewrites `docs/benchmarks.md`. With names of
//! tables, as in `benchmarks open first`, it only prints those.

use std::error::Error;
use std::path::Path;
use std::process::ExitCode;

use tests::benchmarks;

fn main() -> Result<ExitCode, Box<dyn Error>> {
    let mut arguments = std::env::args().skip(1).peekable();
    let first = arguments.peek().cloned().unwrap_or_default();
    if let Some(code) = benchmarks::child(&first, arguments.by_ref().skip(1)) {
        return Ok(ExitCode::from(code));
    }
    let names: Vec<String> = std::env::args().skip(1).collect();
    let text = benchmarks::page(&names)?;
    if names.is_empty() {
        std::fs::write(Path::new(env!("CARGO_MANIFEST_DIR")).join("../docs/benchmarks.md"), &text)?;
    }
    tests::console::line(&text);
    Ok(ExitCode::SUCCESS)
}

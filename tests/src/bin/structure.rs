//! `cargo run -p tests --bin structure`: how the product's sources are made: circles between files, lines, and what a
//! new kind touches.
//!
//! With `--before COMMIT` it compares earlier commits, with `--write` the tables become `docs/structure.md`.

use std::error::Error;
use std::path::{Path, PathBuf};
use std::process::Command;

use clap::Parser;
use tests::console;
use tests::structure::page::{State, page};

/// Counts circles between files, lines, and the files of a new kind.
#[derive(Debug, Parser)]
struct Args {
    /// Commit to compare with; may be given several times.
    #[arg(long, value_name = "COMMIT")]
    before: Vec<String>,
    /// Tree to measure [default: that of this program's sources].
    #[arg(long, value_name = "DIR")]
    tree: Option<PathBuf>,
    /// Write `docs/structure.md`.
    #[arg(long)]
    write: bool,
}

fn main() -> Result<(), Box<dyn Error>> {
    let args = Args::parse();
    let tree = args.tree.unwrap_or_else(|| Path::new(env!("CARGO_MANIFEST_DIR")).join(".."));
    let mut states = Vec::new();
    for commit in &args.before {
        states.push(at(&tree, commit)?);
    }
    let now = State::read("now", &tree)?;
    console::line(&now.circles());
    states.push(now);
    let text = page(&states);
    console::line(&text);
    if args.write {
        std::fs::write(tree.join("docs/structure.md"), text)?;
    }
    Ok(())
}

/// The state of `tree` at a commit, read in a temporary folder.
fn at(tree: &Path, commit: &str) -> Result<State, Box<dyn Error>> {
    let folder = tempfile::tempdir()?;
    let archive = folder.path().join("tree.tar");
    let sources = folder.path().join("tree");
    std::fs::create_dir(&sources)?;
    let git = ["archive", "--output"];
    run(Command::new("git").args(git).arg(&archive).arg(commit).current_dir(tree))?;
    run(Command::new("tar").arg("-xf").arg(&archive).current_dir(&sources))?;
    Ok(State::read(commit, &sources)?)
}

fn run(command: &mut Command) -> Result<(), Box<dyn Error>> {
    let status = command.status()?;
    if status.success() { Ok(()) } else { Err(format!("{command:?}: {status}").into()) }
}

//! Tables of `docs/benchmarks.md`, each of which can be asked for by its name.
//!
//! Turns what this machine does now into Markdown. Everything is measured in this process or in children of
//! it that are the same program under another name: CPU seconds (user + system of the whole process, so that
//! threads of a software adapter count), medians of interleaved rounds.

mod agreement;
mod compiling;
mod devices;
mod embree;
mod first;
mod open;
mod packs;
mod profile;
mod trees;
mod walks;
mod writing;

use std::error::Error;
use std::fmt::Write as _;

use crate::{ablation, edits};
use packs::Packs;

/// What a table gives.
pub type Outcome = Result<(), Box<dyn Error>>;

/// A table: its name, what it tells, and what measures it and writes it into the text.
pub struct Table {
    /// Which word asks for it.
    pub name: &'static str,
    /// For those who ask which there are.
    pub about: &'static str,
    /// Measures and writes.
    pub write: fn(&mut Packs, &mut String) -> Outcome,
}

/// All of them, in the order of the page.
pub const TABLES: [Table; 13] = [
    Table { name: "devices", about: "path tracing on the CPU and others", write: devices::table },
    Table {
        name: "agreement",
        about: "pictures of GPUs against those of the CPU",
        write: agreement::table,
    },
    Table {
        name: "features",
        about: "every feature on GPUs against the CPU",
        write: agreement::features,
    },
    Table { name: "walks", about: "the walk through the tree", write: walks::table },
    Table {
        name: "profile",
        about: "tracing and shading apart, and how busy lanes are",
        write: profile::table,
    },
    Table { name: "embree", about: "rays beside Embree's", write: embree::table },
    Table { name: "trees", about: "building a tree", write: trees::table },
    Table { name: "compile", about: "text to pack, cold and warm", write: compiling::table },
    Table { name: "edits", about: "compiling again after edits", write: compiling::edits },
    Table { name: "open", about: "mapping and checking packs", write: open::table },
    Table { name: "first", about: "process start to first pixel", write: first::table },
    Table { name: "writing", about: "pictures while rendering", write: writing::table },
    Table { name: "ablation", about: "gain from kernel specialisation", write: ablated },
];

/// Scenes that tables are about.
pub(crate) const SCENES: [&str; 3] = ["mesh", "materials", "shrine"];
/// Rounds of each measurement; odd, so that the median is a measured value.
pub(crate) const ROUNDS: usize = 3;

fn ablated(_: &mut Packs, text: &mut String) -> Outcome {
    ablation::tables(text, &ablation::all_scenes())
}

/// What a child of this program does, if `name` is one's first argument: its exit code.
pub fn child(name: &str, arguments: impl Iterator<Item = String>) -> Option<u8> {
    match name {
        edits::CHILD => Some(edits::child(arguments)),
        first::CHILD => Some(first::child(arguments)),
        writing::CHILD => Some(writing::child(arguments)),
        _ => None,
    }
}

/// The tables with these names, in the order of the page; all of them if no name is given.
///
/// # Errors
/// When no temporary folder can be made. What cannot be measured is said in its place.
pub fn page(names: &[String]) -> Result<String, Box<dyn Error>> {
    let wanted = |table: &&Table| names.is_empty() || names.iter().any(|name| name == table.name);
    let mut packs = Packs::new()?;
    let mut text = header(names);
    for table in TABLES.iter().filter(wanted) {
        // What others took minutes to measure is not lost.
        if let Err(error) = (table.write)(&mut packs, &mut text) {
            let _ = writeln!(text, "\nThe table `{}` is not whole: {error}.", table.name);
        }
    }
    Ok(text)
}

fn header(names: &[String]) -> String {
    let mut text = String::from("# Benchmarks\n\n");
    let command = "cargo run --release -p tests --bin benchmarks";
    let _ = match names {
        [] => write!(
            text,
            "Made by `{command}`; edit the program, not this page. With names of tables \
             (`benchmarks open first`) it only prints those. "
        ),
        _ => write!(text, "Printed by `{command} {}`. ", names.join(" ")),
    };
    let _ = writeln!(
        text,
        "CPU seconds are user + system time of the process, medians of {ROUNDS} interleaved rounds. \
         Compare rows of one page, not pages: machines differ.\n\n{}",
        machine(),
    );
    text
}

/// On which kind of machine this runs, as a line of a page.
#[must_use]
pub fn machine() -> String {
    let threads = std::thread::available_parallelism().map_or(1, std::num::NonZero::get);
    let [arch, system] = [std::env::consts::ARCH, std::env::consts::OS];
    format!("Machine: {arch} {system}, {threads} hardware threads, {}.", processor())
}

fn processor() -> String {
    let info = std::fs::read_to_string("/proc/cpuinfo").unwrap_or_default();
    let line = info.lines().find_map(|line| line.strip_prefix("model name"));
    let name = line.and_then(|line| line.split_once(':')).map(|(_, name)| name.trim().to_owned());
    name.unwrap_or_else(|| "unknown processor".to_owned())
}

/// The median; of an even number the upper one.
pub(crate) fn median(values: impl IntoIterator<Item = f64>) -> f64 {
    let mut values: Vec<f64> = values.into_iter().collect();
    values.sort_by(f64::total_cmp);
    values.get(values.len() / 2).copied().unwrap_or(f64::NAN)
}

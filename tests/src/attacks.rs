//! Attacks on the two programs, as the programs themselves see them: processes, files, limits and signals.
//!
//! Turns built programs into rows of `docs/security.md`: what was tried, how often, and how it ended. A try ends
//! well when the exit code is one that is allowed, in time, with no trace of a panic, and with what must not change
//! unchanged.

mod files;
mod input;
mod lab;
mod limits;
mod packs;
mod stop;

use std::collections::BTreeMap;
use std::fmt::Write as _;

pub use lab::{Lab, Outcome};

/// One attack, tried in several ways.
#[derive(Debug)]
pub struct Row {
    /// What was tried.
    pub attack: String,
    /// How it must end.
    pub must: &'static str,
    /// How the tries ended, and how often.
    pub ends: BTreeMap<String, usize>,
    /// Tries that ended in another way.
    pub bad: Vec<String>,
}

impl Row {
    /// An attack that has not been tried yet.
    #[must_use]
    pub fn new(attack: impl Into<String>, must: &'static str) -> Self {
        Self { attack: attack.into(), must, ends: BTreeMap::new(), bad: Vec::new() }
    }

    /// Notes a try; `fault` says what is wrong with its end, if anything is.
    pub fn note(&mut self, what: &str, outcome: &Outcome, fault: Option<String>) {
        *self.ends.entry(outcome.end()).or_default() += 1;
        if let Some(fault) = outcome.trace().or(fault) {
            self.bad.push(format!("{what}: {fault}: {}", outcome.first_line()));
        }
    }

    /// Tries so far.
    #[must_use]
    pub fn tries(&self) -> usize {
        self.ends.values().sum()
    }

    /// The row of the table.
    #[must_use]
    pub fn line(&self) -> String {
        let ends: Vec<String> = self.ends.iter().map(|(end, n)| format!("{end}: {n}")).collect();
        let verdict = match self.bad.len() {
            0 => "holds".to_owned(),
            n => format!("**{n} do not hold**"),
        };
        format!(
            "| {} | {} | {} | {} | {verdict} |",
            self.attack,
            self.must,
            self.tries(),
            ends.join(", ")
        )
    }
}

/// Tries the attacks of one part.
type Part = fn(&Lab) -> std::io::Result<Vec<Row>>;

/// Tries the attacks of every part with `only` in its name; `note` is told what is tried next.
pub fn all(
    lab: &Lab,
    only: &str,
    note: &dyn Fn(&str),
) -> std::io::Result<Vec<(&'static str, Vec<Row>)>> {
    let mut parts = Vec::new();
    for (name, part) in [
        ("Files that are written", files::rows as Part),
        ("Packs", packs::rows),
        ("Scenes, meshes and images", input::rows),
        ("Limits of the system", limits::rows),
        ("Ending a run", stop::rows),
    ] {
        if !name.contains(only) {
            continue;
        }
        note(name);
        parts.push((name, part(lab)?));
    }
    Ok(parts)
}

/// The tables, part by part, and what did not hold.
#[must_use]
pub fn tables(parts: &[(&str, Vec<Row>)]) -> String {
    let mut text = String::new();
    for (name, rows) in parts {
        let _ = write!(
            text,
            "\n## {name}\n\n| attack | must end with | tries | ends | |\n|---|---|---|---|---|\n"
        );
        for row in rows {
            let _ = writeln!(text, "{}", row.line());
        }
        for bad in rows.iter().flat_map(|row| &row.bad) {
            let _ = writeln!(text, "\n- {bad}");
        }
    }
    text
}

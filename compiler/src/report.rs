//! The only place of the compiler that prints.
//!
//! Diagnostics go to standard error as pictures (`human`), lines (`short`) or one JSON object a
//! line (`json`); what was asked for goes to standard output. It does not know what is wrong with a
//! scene, only how to say it. Texts of the scene may come from strangers: nothing of them reaches the
//! terminal that could steer it, and no line of them makes more than a few lines here.

mod excerpt;
mod human;
mod json;
mod short;
mod text;

use std::io::{BufWriter, IsTerminal, Write};

use lang::diagnostic::Diagnostic;
use lang::source::SourceSet;

use crate::counted::counted;

/// How diagnostics look.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, clap::ValueEnum)]
pub enum ErrorFormat {
    /// Source excerpts with marks, notes and proposed edits.
    #[default]
    Human,
    /// `file:line:column: error[E0201]: message (why)`, one line each.
    Short,
    /// One JSON object a line, modelled on rustc's.
    Json,
}

/// Whether to use colours on the terminal.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, clap::ValueEnum)]
pub enum Color {
    /// When standard error is a terminal and `NO_COLOR` is not set.
    #[default]
    Auto,
    /// Always.
    Always,
    /// Never.
    Never,
}

/// Prints in one format.
#[derive(Clone, Copy, Debug)]
pub struct Reporter {
    format: ErrorFormat,
    color: bool,
    max_errors: usize,
}

impl Reporter {
    /// A reporter that shows at most `max_errors` errors, and as many warnings.
    #[must_use]
    pub fn new(format: ErrorFormat, color: Color, max_errors: usize) -> Self {
        let color = match color {
            Color::Always => true,
            Color::Never => false,
            Color::Auto => {
                std::io::stderr().is_terminal() && std::env::var_os("NO_COLOR").is_none()
            }
        };
        Self { format, color, max_errors }
    }

    /// Prints diagnostics, at most so many of each severity, how many more there are, and a summary.
    pub fn diagnostics(&self, sources: &SourceSet, diagnostics: &[Diagnostic]) {
        let n_errors = diagnostics.iter().filter(|d| d.is_error()).count();
        let n_warnings = diagnostics.len() - n_errors;
        let mut out = BufWriter::new(std::io::stderr().lock());
        let mut left = [self.max_errors; 2];
        for diagnostic in diagnostics {
            let left = &mut left[usize::from(diagnostic.is_error())];
            if *left == 0 {
                continue;
            }
            *left -= 1;
            let _ = writeln!(out, "{}", self.drawn(sources, diagnostic));
        }
        if let Some(more) = hidden(n_errors, n_warnings, self.max_errors) {
            let more = if self.format == ErrorFormat::Json { json::note(&more) } else { more };
            let _ = writeln!(out, "{more}");
        }
        if let Some(line) = summary(n_errors, n_warnings)
            && self.format != ErrorFormat::Json
        {
            let _ = writeln!(out, "{line}");
        }
        let _ = out.flush();
    }

    fn drawn(&self, sources: &SourceSet, diagnostic: &Diagnostic) -> String {
        match self.format {
            ErrorFormat::Human => human::render(sources, diagnostic, self.color) + "\n",
            ErrorFormat::Short => short::render(sources, diagnostic),
            ErrorFormat::Json => json::render(sources, diagnostic),
        }
    }

    /// What `diagnostics` would print as JSON, as a list: all of it, of whatever format this is.
    #[must_use]
    pub fn list(sources: &SourceSet, diagnostics: &[Diagnostic]) -> serde_json::Value {
        diagnostics.iter().map(|diagnostic| json::object(sources, diagnostic)).collect()
    }

    /// One object of JSON on standard output, in one line; says whether it could be written, as `output`.
    #[must_use]
    pub fn document(&self, object: &serde_json::Value) -> bool {
        self.output(&json::one_line(object))
    }

    /// A failure of the world: a file that cannot be read or written, a cache out of order.
    pub fn failure(&self, message: &str) {
        match self.format {
            ErrorFormat::Json => to_stderr(&json::failure(message)),
            ErrorFormat::Human | ErrorFormat::Short => {
                to_stderr(&format!("error: {}", text::escape_lines(message)));
            }
        }
    }

    /// A warning that is not about a place in the scene.
    pub fn warning(&self, message: &str) {
        match self.format {
            ErrorFormat::Json => to_stderr(&json::warning(message)),
            ErrorFormat::Human | ErrorFormat::Short => {
                to_stderr(&format!("warning: {}", text::escape_lines(message)));
            }
        }
    }

    /// Progress and summaries, on standard error; silent in JSON.
    pub fn status(&self, line: &str) {
        if self.format != ErrorFormat::Json {
            to_stderr(&text::escape_lines(line));
        }
    }

    /// What the user asked for, on standard output. Says whether it could be written; if not, that is reported.
    #[must_use]
    pub fn output(&self, text: &str) -> bool {
        let end = if text.ends_with('\n') { "" } else { "\n" };
        match files::write_stdout(&format!("{text}{end}")) {
            Ok(()) => true,
            Err(error) => {
                self.failure(&format!("cannot write to standard output: {error}"));
                false
            }
        }
    }
}

/// What is not shown of so many errors and warnings.
fn hidden(n_errors: usize, n_warnings: usize, max: usize) -> Option<String> {
    let counts = summary(n_errors.saturating_sub(max), n_warnings.saturating_sub(max))?;
    Some(format!("not shown: {counts}; --max-errors 0 shows all"))
}

fn summary(n_errors: usize, n_warnings: usize) -> Option<String> {
    let counts = [(n_errors, "error", "errors"), (n_warnings, "warning", "warnings")];
    let counts = counts.into_iter().filter(|(n, ..)| *n > 0);
    let counts: Vec<String> = counts.map(|(n, one, several)| counted(n, one, several)).collect();
    (!counts.is_empty()).then(|| counts.join(", "))
}

fn to_stderr(text: &str) {
    let mut err = std::io::stderr().lock();
    let _ = writeln!(err, "{text}");
}

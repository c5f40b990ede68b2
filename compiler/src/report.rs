//! The only place of the compiler that prints.
//!
//! Diagnostics go to standard error as pictures (`human`), lines (`short`) or one JSON object a
//! line (`json`); what was asked for goes to standard output. It does not know what is wrong with a
//! scene, only how to say it.

mod human;
mod json;

use std::io::{IsTerminal, Write};

use lang::diagnostic::{self, Diagnostic};
use lang::source::SourceSet;

/// How diagnostics look.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, clap::ValueEnum)]
pub enum ErrorFormat {
    /// Source excerpts with marks, notes and proposed edits.
    #[default]
    Human,
    /// `file:line:column: error[E0201]: message`, one line each.
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
    /// A reporter that shows at most `max_errors` errors in full.
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

    /// Prints all diagnostics and a summary.
    pub fn diagnostics(&self, sources: &SourceSet, diagnostics: &[Diagnostic]) {
        let n_errors = diagnostics.iter().filter(|d| d.is_error()).count();
        let n_warnings = diagnostics.len() - n_errors;
        let mut shown = 0;
        for diagnostic in diagnostics {
            if diagnostic.is_error() {
                shown += 1;
                if shown > self.max_errors {
                    continue;
                }
            }
            self.diagnostic(sources, diagnostic);
        }
        if self.format != ErrorFormat::Json {
            if n_errors > self.max_errors {
                let hidden = n_errors - self.max_errors;
                self.status(&format!("{hidden} more errors; --max-errors 0 shows all"));
            }
            if let Some(line) = summary(n_errors, n_warnings) {
                self.status(&line);
            }
        }
    }

    fn diagnostic(&self, sources: &SourceSet, diagnostic: &Diagnostic) {
        let text = match self.format {
            ErrorFormat::Human => human::render(sources, diagnostic, self.color) + "\n",
            ErrorFormat::Short => diagnostic::short(sources, diagnostic),
            ErrorFormat::Json => json::render(sources, diagnostic),
        };
        to_stderr(&text);
    }

    /// A failure of the world: a file that cannot be read or written, a cache out of order.
    pub fn failure(&self, message: &str) {
        match self.format {
            ErrorFormat::Json => to_stderr(&json::failure(message)),
            ErrorFormat::Human | ErrorFormat::Short => to_stderr(&format!("error: {message}")),
        }
    }

    /// A warning that is not about a place in the scene.
    pub fn warning(&self, message: &str) {
        match self.format {
            ErrorFormat::Json => to_stderr(&json::warning(message)),
            ErrorFormat::Human | ErrorFormat::Short => to_stderr(&format!("warning: {message}")),
        }
    }

    /// Progress and summaries, on standard error; silent in JSON.
    pub fn status(&self, line: &str) {
        if self.format != ErrorFormat::Json {
            to_stderr(line);
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

fn summary(n_errors: usize, n_warnings: usize) -> Option<String> {
    let count = |n: usize, what: &str| match n {
        0 => None,
        1 => Some(format!("1 {what}")),
        n => Some(format!("{n} {what}s")),
    };
    match (count(n_errors, "error"), count(n_warnings, "warning")) {
        (None, None) => None,
        (Some(one), None) | (None, Some(one)) => Some(one),
        (Some(errors), Some(warnings)) => Some(format!("{errors}, {warnings}")),
    }
}

fn to_stderr(text: &str) {
    let mut err = std::io::stderr().lock();
    let _ = writeln!(err, "{text}");
}

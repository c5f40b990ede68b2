//! The only place of the demo that prints.

use std::io::Write;

/// A line on standard output.
pub fn line(text: &str) {
    let _ = writeln!(std::io::stdout().lock(), "{text}");
}

/// A failure on standard error.
pub fn problem(text: &str) {
    let _ = writeln!(std::io::stderr().lock(), "error: {text}");
}

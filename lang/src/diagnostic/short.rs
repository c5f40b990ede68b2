//! A diagnostic as one line.

use super::{Diagnostic, Severity};
use crate::source::SourceSet;

/// One short line, `file:line:column: error[E0101]: message`, for logs and tests.
#[must_use]
pub fn short(sources: &SourceSet, diagnostic: &Diagnostic) -> String {
    let kind = match diagnostic.severity {
        Severity::Error => "error",
        Severity::Warning => "warning",
    };
    let (code, message) = (diagnostic.code.0, &diagnostic.message);
    match diagnostic.span() {
        None => format!("{kind}[{code}]: {message}"),
        Some(span) => {
            let (name, at) = (sources.name(span.file), sources.start(span));
            format!("{name}:{}:{}: {kind}[{code}]: {message}", at.line, at.column)
        }
    }
}

//! A diagnostic as one line: place, code, message, and in brackets why.

use lang::diagnostic::{self, Diagnostic};
use lang::source::SourceSet;

use super::text::line;

/// The line, without a line break.
pub(super) fn render(sources: &SourceSet, diagnostic: &Diagnostic) -> String {
    let mut text = line(&diagnostic::short(sources, diagnostic)).into_owned();
    let place = diagnostic.span();
    let labels = diagnostic.labels.iter().filter(|label| !label.text.is_empty()).map(|label| {
        let said = line(&label.text);
        if place.is_some_and(|span| span.file == label.span.file && span.start == label.span.start)
        {
            return said.into_owned();
        }
        let at = sources.start(label.span);
        let name = sources.name(label.span.file);
        format!("{said} at {}:{}:{}", line(name), at.line, at.column)
    });
    let notes = diagnostic.notes.iter().map(|note| line(note).into_owned());
    let why: Vec<String> = labels.chain(notes).collect();
    if !why.is_empty() {
        text = format!("{text} ({})", why.join("; "));
    }
    text
}

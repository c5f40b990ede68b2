//! A diagnostic as a picture of the source, drawn by annotate-snippets.

use std::fmt::Write as _;
use std::ops::Range;

use annotate_snippets::{AnnotationKind, Group, Level, Patch, Renderer, Snippet};
use lang::diagnostic::{Diagnostic, Fix, Label, Severity};
use lang::source::{FileId, SourceSet, Span};

/// The whole message, without a line break at its end.
pub(super) fn render(sources: &SourceSet, diagnostic: &Diagnostic, color: bool) -> String {
    let level = match diagnostic.severity {
        Severity::Error => Level::ERROR,
        Severity::Warning => Level::WARNING,
    };
    let title = level.primary_title(diagnostic.message.as_str()).id(diagnostic.code.0);
    let mut main = Group::with_title(title);
    for (file, labels) in by_file(diagnostic) {
        main = main.element(excerpt(sources, file, &labels));
    }
    for note in &diagnostic.notes {
        main = main.element(Level::NOTE.message(note.as_str()));
    }
    for help in &diagnostic.helps {
        main = main.element(Level::HELP.message(help.as_str()));
    }
    if let Some(lint) = diagnostic.lint {
        main = main.element(Level::NOTE.message(format!("this is the lint `{lint}`")));
    }
    let mut groups = vec![main];
    groups.extend(diagnostic.fixes.iter().map(|fix| proposal(sources, fix)));
    let renderer = if color { Renderer::styled() } else { Renderer::plain() };
    let mut text = renderer.render(&groups);
    let _ = write!(text, "\n   = for more: rtc explain {}", diagnostic.code.0);
    text
}

/// Labels a file at a time: the file of the primary label first, the others as they come.
fn by_file(diagnostic: &Diagnostic) -> Vec<(FileId, Vec<&Label>)> {
    let mut files: Vec<(FileId, Vec<&Label>)> = Vec::new();
    let (primary, secondary): (Vec<&Label>, Vec<&Label>) =
        diagnostic.labels.iter().partition(|label| label.primary);
    for label in primary.into_iter().chain(secondary) {
        match files.iter_mut().find(|(file, _)| *file == label.span.file) {
            Some((_, labels)) => labels.push(label),
            None => files.push((label.span.file, vec![label])),
        }
    }
    files
}

fn excerpt<'a>(
    sources: &'a SourceSet,
    file: FileId,
    labels: &[&'a Label],
) -> Snippet<'a, annotate_snippets::Annotation<'a>> {
    let text = sources.text(file);
    let annotations = labels.iter().map(|label| {
        let kind = if label.primary { AnnotationKind::Primary } else { AnnotationKind::Context };
        let annotation = kind.span(range(text, label.span));
        if label.text.is_empty() { annotation } else { annotation.label(label.text.as_str()) }
    });
    Snippet::source(text).path(sources.name(file)).annotations(annotations)
}

fn proposal<'a>(sources: &'a SourceSet, fix: &'a Fix) -> Group<'a> {
    let mut group = Group::with_title(Level::HELP.secondary_title(fix.message.as_str()));
    let mut files: Vec<FileId> = fix.edits.iter().map(|edit| edit.span.file).collect();
    files.sort_unstable();
    files.dedup();
    for file in files {
        let text = sources.text(file);
        let edits = fix.edits.iter().filter(|edit| edit.span.file == file);
        let patches =
            edits.map(|edit| Patch::new(range(text, edit.span), edit.replacement.as_str()));
        group = group.element(Snippet::source(text).path(sources.name(file)).patches(patches));
    }
    group
}

/// The span as a range that lies in the text, on character boundaries.
fn range(text: &str, span: Span) -> Range<usize> {
    let clamp = |offset: u32| {
        let mut offset = (offset as usize).min(text.len());
        while !text.is_char_boundary(offset) {
            offset -= 1;
        }
        offset
    };
    let (start, end) = (clamp(span.start), clamp(span.end));
    start..end.max(start)
}

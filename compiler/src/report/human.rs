//! A diagnostic as a picture of the source, drawn by annotate-snippets.

use std::fmt::Write as _;

use annotate_snippets::{AnnotationKind, Element, Group, Level, Patch, Renderer, Snippet};
use lang::diagnostic::{Diagnostic, Fix, Label, Severity};
use lang::source::{FileId, SourceSet, Span};

use super::excerpt::{Excerpt, excerpts};
use super::text::{escape_lines, is_short, line};

/// The whole message, without a line break at its end.
pub(super) fn render(sources: &SourceSet, diagnostic: &Diagnostic, color: bool) -> String {
    let level = match diagnostic.severity {
        Severity::Error => Level::ERROR,
        Severity::Warning => Level::WARNING,
    };
    let title = level.primary_title(line(&diagnostic.message)).id(diagnostic.code.0);
    let mut main = Group::with_title(title);
    let mut shifted = Vec::new();
    for (file, labels) in by_file(diagnostic) {
        main = main.elements(marked(sources, file, &labels, &mut shifted));
    }
    for note in &diagnostic.notes {
        main = main.element(Level::NOTE.message(line(note)));
    }
    for help in &diagnostic.helps {
        main = main.element(Level::HELP.message(line(help)));
    }
    if let Some(lint) = diagnostic.lint {
        main = main.element(Level::NOTE.message(format!("this is the lint `{lint}`")));
    }
    let mut groups = vec![main];
    groups.extend(shown_fixes(diagnostic).map(|fix| proposal(sources, fix)));
    let renderer = if color { Renderer::styled() } else { Renderer::plain() };
    let mut text = renderer.render(&groups);
    correct(&mut text, &shifted);
    let _ = write!(text, "\n   = for more: rtc explain {}", diagnostic.code.0);
    text
}

/// The fixes that are told. Whoever has names of thousands of letters finds them without us.
pub(super) fn shown_fixes(diagnostic: &Diagnostic) -> impl Iterator<Item = &Fix> {
    let fixes = diagnostic.fixes.iter();
    fixes.filter(|fix| fix.edits.iter().all(|edit| is_short(&edit.replacement)))
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

/// A place as the library writes it, which counts columns in the excerpt; and as it is.
type Shifted = (String, String);

/// Excerpts of one file with its labels.
fn marked<'a>(
    sources: &'a SourceSet,
    file: FileId,
    labels: &[&'a Label],
    shifted: &mut Vec<Shifted>,
) -> Vec<Element<'a>> {
    let spans: Vec<Span> = labels.iter().map(|label| label.span).collect();
    let name = line(sources.name(file));
    let mut elements = Vec::new();
    for excerpt in excerpts(sources, file, &spans) {
        let mut annotations = Vec::with_capacity(excerpt.places.len());
        for (index, range) in &excerpt.places {
            let Some(label) = labels.get(*index) else { continue };
            if excerpt.shifted {
                let at = sources.start(label.span);
                let column = excerpt.column(range.start);
                let place = |column| format!("{name}:{}:{column}", at.line);
                shifted.push((place(column), place(at.column as usize)));
            }
            let primary = label.primary;
            let kind = if primary { AnnotationKind::Primary } else { AnnotationKind::Context };
            let annotation = kind.span(range.clone());
            annotations.push(match label.text.as_str() {
                "" => annotation,
                said => annotation.label(line(said)),
            });
        }
        let snippet = Snippet::source(excerpt.text).line_start(excerpt.line);
        elements.push(snippet.path(name.clone()).annotations(annotations).into());
    }
    elements
}

/// Writes the columns of the source for those of excerpts, in the lines that name a place.
fn correct(text: &mut String, shifted: &[Shifted]) {
    for (wrong, right) in shifted.iter().filter(|(wrong, right)| wrong != right) {
        // The first line is the message.
        let from = text.find('\n').unwrap_or(text.len());
        let is_whole = |at: usize| {
            let after = text.get(at + wrong.len()..).and_then(|rest| rest.chars().next());
            !after.is_some_and(|c| c.is_ascii_digit())
        };
        let found = text.match_indices(wrong.as_str()).map(|(at, _)| at);
        if let Some(at) = found.into_iter().find(|at| *at > from && is_whole(*at)) {
            text.replace_range(at..at + wrong.len(), right);
        }
    }
}

fn proposal<'a>(sources: &'a SourceSet, fix: &'a Fix) -> Group<'a> {
    let mut group = Group::with_title(Level::HELP.secondary_title(line(&fix.message)));
    let mut files: Vec<FileId> = fix.edits.iter().map(|edit| edit.span.file).collect();
    files.sort_unstable();
    files.dedup();
    for file in files {
        let edits: Vec<_> = fix.edits.iter().filter(|edit| edit.span.file == file).collect();
        let spans: Vec<Span> = edits.iter().map(|edit| edit.span).collect();
        for Excerpt { line: first, text, places, .. } in excerpts(sources, file, &spans) {
            let patches: Vec<Patch<'_>> = places
                .into_iter()
                .filter_map(|(index, range)| Some((edits.get(index)?, range)))
                .map(|(edit, range)| Patch::new(range, escape_lines(&edit.replacement)))
                .collect();
            let name = line(sources.name(file));
            group =
                group.element(Snippet::source(text).line_start(first).path(name).patches(patches));
        }
    }
    group
}

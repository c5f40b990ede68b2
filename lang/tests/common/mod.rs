//! What the checking tests share: files in memory, and diagnostics as text.

#![allow(dead_code, unreachable_pub, reason = "each test file uses its own part of this module")]

use std::collections::BTreeMap;
use std::fmt::Write as _;

use lang::diagnostic::{Applicability, Diagnostic, Fix, Severity};
use lang::source::{LoadError, Loader, SourceSet, Span};
use lang::{Analysis, Options, analyze};

/// Name of the root file of every test.
pub const ROOT: &str = "scene.rts";

/// Files by path; an import finds them relative to nothing.
pub struct Memory(pub BTreeMap<String, String>);

impl Loader for Memory {
    fn load(&mut self, _: &str, path: &str) -> Result<(String, String), LoadError> {
        match self.0.get(path) {
            Some(text) => Ok((path.to_owned(), text.clone())),
            None => match self.0.keys().find(|name| name.eq_ignore_ascii_case(path)) {
                Some(real) => Err(LoadError::WrongCase(real.clone())),
                None => Err(LoadError::NotFound),
            },
        }
    }
}

/// Analyses a text alone.
pub fn check_text(text: &str) -> Analysis {
    check_files(&BTreeMap::from([(ROOT.to_owned(), text.to_owned())]), &[])
}

/// Analyses the root among files, with definitions.
pub fn check_files(files: &BTreeMap<String, String>, defines: &[(String, String)]) -> Analysis {
    let mut loader = Memory(files.clone());
    let options = Options { defines: defines.to_vec() };
    analyze(ROOT, &files[ROOT], &mut loader, &options)
}

/// The diagnostics as the header lines of a case.
pub fn describe(analysis: &Analysis) -> String {
    let mut out = String::new();
    for d in &analysis.diagnostics {
        describe_one(&mut out, &analysis.sources, d);
    }
    out
}

fn place(sources: &SourceSet, span: Span) -> String {
    let (a, b) = (sources.start(span), sources.start(span.after()));
    let file = match sources.name(span.file) {
        ROOT => String::new(),
        other => format!("{other}:"),
    };
    format!("{file}{}:{}-{}:{}", a.line, a.column, b.line, b.column)
}

fn describe_one(out: &mut String, sources: &SourceSet, d: &Diagnostic) {
    let kind = if d.severity == Severity::Error { "Error" } else { "Warning" };
    let at = d.span().map_or(String::new(), |span| place(sources, span));
    let _ = writeln!(out, "// {kind}: {at} {} {}", d.code.0, d.message);
    for label in &d.labels {
        let mark = if label.primary { "Here" } else { "Because" };
        let line = format!("//   {mark}: {} {}", place(sources, label.span), label.text);
        let _ = writeln!(out, "{}", line.trim_end());
    }
    for note in &d.notes {
        let _ = writeln!(out, "//   Note: {note}");
    }
    for help in &d.helps {
        let _ = writeln!(out, "//   Help: {help}");
    }
    for fix in &d.fixes {
        let sure = fix.applicability == Applicability::MachineApplicable;
        let mark = if sure { "Fix" } else { "Maybe" };
        for edit in &fix.edits {
            let (at, to) = (place(sources, edit.span), &edit.replacement);
            let _ = writeln!(out, "//   {mark}: {at} {to:?} {}", fix.message);
        }
    }
}

/// The files after a fix.
pub fn apply(
    sources: &SourceSet,
    files: &BTreeMap<String, String>,
    fix: &Fix,
) -> BTreeMap<String, String> {
    let mut files = files.clone();
    let mut edits = fix.edits.clone();
    edits.sort_by_key(|edit| std::cmp::Reverse(edit.span.start));
    for edit in edits {
        let Some(text) = files.get_mut(sources.name(edit.span.file)) else { continue };
        text.replace_range(edit.span.start as usize..edit.span.end as usize, &edit.replacement);
    }
    files
}

//! Syntax: what is read, what is said about what cannot be read, and that the formatter keeps it.
//!
//! Cases are data in `tests/syntax/*.rts`: `--- name`, the expected diagnostics as comments, then the
//! text. `UPDATE=1 cargo test -p lang` writes the diagnostics as they are; review the difference.

use std::fmt::Write as _;
use std::path::{Path, PathBuf};

use lang::diagnostic::{Applicability, Diagnostic, Edit, Severity};
use lang::parse::parse;
use lang::source::{FileId, SourceSet, Span};
use lang::syntax::{File, ItemKind};

fn folder() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/syntax")
}

fn read(name: &str) -> String {
    std::fs::read_to_string(folder().join(name)).expect("the test's own file")
}

fn parse_text(text: &str) -> (SourceSet, File, Vec<Diagnostic>) {
    let mut sources = SourceSet::new();
    let file = sources.add("scene.rts", text);
    let (tree, diagnostics) = parse(&sources, file);
    (sources, tree, diagnostics)
}

/// The header lines of a case.
fn describe(sources: &SourceSet, diagnostics: &[Diagnostic]) -> String {
    let mut out = String::new();
    let place = |span: Span| {
        let (a, b) = (sources.start(span), sources.start(span.after()));
        format!("{}:{}-{}:{}", a.line, a.column, b.line, b.column)
    };
    for d in diagnostics {
        let kind = if d.severity == Severity::Error { "Error" } else { "Warning" };
        let at = d.span().map_or(String::new(), place);
        let _ = writeln!(out, "// {kind}: {at} {} {}", d.code.0, d.message);
        for label in &d.labels {
            let mark = if label.primary { "Here" } else { "Because" };
            let _ = writeln!(out, "//   {mark}: {} {}", place(label.span), label.text);
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
                let (at, to) = (place(edit.span), &edit.replacement);
                let _ = writeln!(out, "//   {mark}: {at} {to:?} {}", fix.message);
            }
        }
    }
    out
}

/// Checks every case of a file; with `UPDATE=1`, rewrites it.
fn check_cases(name: &str) {
    let text = read(name);
    let mut rewritten = String::new();
    for case in text.split("--- ").skip(1) {
        let (title, rest) = case.split_once('\n').expect("a line with the name");
        let is_header = |line: &&str| {
            ["// Error:", "// Warning:", "//   "].iter().any(|start| line.starts_with(start))
        };
        let header = rest.split_inclusive('\n').take_while(is_header).map(str::len).sum();
        let (expected, body) = rest.split_at(header);
        let (sources, _, diagnostics) = parse_text(body);
        let found = describe(&sources, &diagnostics);
        let _ = write!(rewritten, "--- {title}\n{found}{body}");
        if std::env::var_os("UPDATE").is_none() {
            assert_eq!(expected, found, "case `{title}` of {name}");
        }
    }
    if std::env::var_os("UPDATE").is_some() {
        std::fs::write(folder().join(name), rewritten).expect("the test's own file");
    }
}

#[test]
fn faults_are_worded_and_placed() {
    check_cases("faults.rts");
}

#[test]
fn the_whole_language_reads_without_complaint() {
    let (sources, tree, diagnostics) = parse_text(&read("shrine.rts"));
    assert_eq!(describe(&sources, &diagnostics), "");
    assert_eq!(tree.edition.map(|e| e.number), Some(1));
    assert_eq!(tree.items.len(), 38);
    assert!(!tree.items.iter().any(|item| matches!(item.kind, ItemKind::Poisoned(_))));
    assert_eq!(tree.items[0].span.file, FileId(0));
}

/// The text with the edits made.
fn apply(text: &str, edits: &[Edit]) -> String {
    let mut edits: Vec<&Edit> = edits.iter().collect();
    edits.sort_by_key(|edit| edit.span);
    let mut text = text.to_owned();
    for edit in edits.iter().rev() {
        text.replace_range(edit.span.start as usize..edit.span.end as usize, &edit.replacement);
    }
    text
}

#[test]
fn every_sure_fix_cures_its_fault_and_brings_no_other() {
    let mut n_fixes = 0;
    for case in read("faults.rts").split("--- ").skip(1) {
        let (title, body) = case.split_once('\n').expect("a line with the name");
        let (_, _, diagnostics) = parse_text(body);
        for fix in diagnostics.iter().flat_map(|d| &d.fixes) {
            if fix.applicability != Applicability::MachineApplicable {
                continue;
            }
            let (sources, _, after) = parse_text(&apply(body, &fix.edits));
            let left = describe(&sources, &after);
            assert_eq!(
                after.len(),
                diagnostics.len() - 1,
                "{title}: {} leaves\n{left}",
                fix.message
            );
            n_fixes += 1;
        }
    }
    assert!(n_fixes >= 8, "only {n_fixes}");
}

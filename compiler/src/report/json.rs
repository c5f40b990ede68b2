//! A diagnostic as one line of JSON, modelled on rustc's `--error-format=json`.
//!
//! `{"schema", "message", "code", "level", "lint", "spans": [...], "children": [...], "rendered"}`; byte
//! offsets count from 0, lines and columns from 1, columns in characters. Texts are not escaped but for
//! what JSON needs and what steers terminals; texts of thousands of characters lose their middle. Where
//! not all are told, a last line of level `note` says how many more there are. `docs/json.md` has the keys.

use lang::diagnostic::{Applicability, Diagnostic, Edit, Fix, Severity};
use lang::source::{SourceSet, Span};
use serde_json::{Value, json};

use super::text::{escape_json, shortened};

/// Name of these objects, and their version.
const SCHEMA: &str = "rtc.diagnostic/1";

/// One line, without a line break.
pub(super) fn render(sources: &SourceSet, diagnostic: &Diagnostic) -> String {
    one_line(&object(sources, diagnostic))
}

/// The object of that line.
pub(super) fn object(sources: &SourceSet, diagnostic: &Diagnostic) -> Value {
    let level = match diagnostic.severity {
        Severity::Error => "error",
        Severity::Warning => "warning",
    };
    let spans: Vec<Value> = diagnostic
        .labels
        .iter()
        .map(|label| {
            let mut object = place(sources, label.span);
            object["is_primary"] = json!(label.primary);
            object["label"] = json!(shortened(&label.text));
            object
        })
        .collect();
    let remark = |level: &str, text: &String| json!({ "level": level, "message": shortened(text), "spans": [] });
    let notes = diagnostic.notes.iter().map(|note| remark("note", note));
    let helps = diagnostic.helps.iter().map(|help| remark("help", help));
    let fixes = super::human::shown_fixes(diagnostic).map(|fix| suggestion(sources, fix));
    let children: Vec<Value> = notes.chain(helps).chain(fixes).collect();
    json!({
        "schema": SCHEMA,
        "message": shortened(&diagnostic.message),
        "code": diagnostic.code.0,
        "level": level,
        "lint": diagnostic.lint,
        "spans": spans,
        "children": children,
        "rendered": super::human::render(sources, diagnostic, false),
    })
}

/// A failure that has no place in a source text.
pub(super) fn failure(message: &str) -> String {
    bare("error", message)
}

/// What is said of the list itself.
pub(super) fn note(message: &str) -> String {
    bare("note", message)
}

/// A warning that has no place in a source text.
pub(super) fn warning(message: &str) -> String {
    bare("warning", message)
}

fn bare(level: &str, message: &str) -> String {
    one_line(&json!({
        "schema": SCHEMA, "message": message, "code": null, "level": level, "lint": null,
        "spans": [], "children": [], "rendered": null,
    }))
}

/// Strings keep their characters; those that steer a terminal are written as JSON's escapes.
pub(super) fn one_line(value: &Value) -> String {
    let json = value.to_string();
    escape_json(&json).into_owned()
}

fn place(sources: &SourceSet, span: Span) -> Value {
    let start = sources.start(span);
    let end = sources.place(span.file, span.end);
    json!({
        "file": sources.name(span.file),
        "byte_start": span.start,
        "byte_end": span.end,
        "line_start": start.line,
        "column_start": start.column,
        "line_end": end.line,
        "column_end": end.column,
    })
}

fn suggestion(sources: &SourceSet, fix: &Fix) -> Value {
    let applicability = match fix.applicability {
        Applicability::MachineApplicable => "MachineApplicable",
        Applicability::MaybeIncorrect => "MaybeIncorrect",
    };
    let edit = |edit: &Edit| {
        let mut object = place(sources, edit.span);
        object["suggested_replacement"] = json!(edit.replacement);
        object["suggestion_applicability"] = json!(applicability);
        object
    };
    let spans: Vec<Value> = fix.edits.iter().map(edit).collect();
    json!({ "level": "help", "message": shortened(&fix.message), "spans": spans })
}

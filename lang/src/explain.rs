//! `rtc explain`: pages about codes, and tables of fields and functions out of the schema.
//!
//! Every page about a code has an example that fails with exactly that code; a test runs them.

use std::fmt::Write as _;

use crate::eval::function::{self, FUNCTIONS};
use crate::reference;
use crate::schema::{self, Kind};
use crate::units;

/// Pages as Markdown; each starts with a line `# CODE: title`.
const PAGES: [&str; 6] = [
    include_str!("explain/syntax.md"),
    include_str!("explain/names.md"),
    include_str!("explain/types.md"),
    include_str!("explain/values.md"),
    include_str!("explain/view.md"),
    include_str!("explain/files.md"),
];

/// Every code that has a page, in order of the pages.
pub fn codes() -> impl Iterator<Item = &'static str> {
    pages().map(|(code, _)| code)
}

/// A Markdown page about a code (`E0301`), a lint (`unused`), a kind (`camera`), a type
/// (`material.diffuse` or just `diffuse`), a field of one (`metal.fuzz`), a function (`polar`) or a
/// unit (`mm`).
#[must_use]
pub fn explain(code_or_name: &str) -> Option<String> {
    let name = code_or_name.trim();
    code_page(name)
        .or_else(|| type_page(name))
        .or_else(|| field_page(name))
        .or_else(|| function_page(name))
        .or_else(|| unit_page(name))
}

/// `(code, page)` of every page.
fn pages() -> impl Iterator<Item = (&'static str, &'static str)> {
    PAGES.iter().flat_map(|file| file.split("\n# ")).map(|page| {
        let page = page.trim_start_matches("# ");
        (page.split(':').next().unwrap_or(page), page)
    })
}

fn code_page(name: &str) -> Option<String> {
    let lint = format!("(`{name}`)");
    let is_it = |(code, page): &(&str, &str)| {
        code.eq_ignore_ascii_case(name)
            || page.lines().next().is_some_and(|title| title.ends_with(&lint))
    };
    pages().find(is_it).map(|(_, page)| format!("# {}\n", page.trim_end()))
}

fn type_page(name: &str) -> Option<String> {
    if let Some(kind) = Kind::from_name(name) {
        let pages: Vec<String> = kind.types().iter().map(|t| reference::type_page(t)).collect();
        return Some(pages.join("\n"));
    }
    let found: Vec<String> = schema::all_types()
        .filter(|schema| schema.path() == name || schema.name == name)
        .map(reference::type_page)
        .collect();
    (!found.is_empty()).then(|| found.join("\n"))
}

/// `metal.fuzz`, `camera.lens`, `material.metal.fuzz`.
fn field_page(name: &str) -> Option<String> {
    let mut page = String::new();
    for schema in schema::all_types() {
        let owners = [schema.path(), schema.name.to_owned(), schema.kind.name().to_owned()];
        for field in schema.fields {
            if owners.iter().any(|owner| format!("{owner}.{}", field.name) == name) {
                let _ = writeln!(page, "{}", reference::field_page(schema, field));
            }
        }
    }
    (!page.is_empty()).then_some(page)
}

fn function_page(name: &str) -> Option<String> {
    let function = function::find(name)?;
    Some(format!("# {}\n\n{}\n", function.signature(), function.doc))
}

fn unit_page(name: &str) -> Option<String> {
    let unit = units::find(name)?;
    let (dim, factor) = (unit.dim, units::show_number(unit.factor));
    let si = if dim.is_none() { String::new() } else { format!(" {}", dim.si_unit()) };
    Some(format!("# {name}\n\nThe {}: {dim}. 1{name} is {factor}{si}.\n", unit.doc))
}

/// Names that `explain` knows beside the codes.
#[must_use]
pub fn explained_names() -> Vec<String> {
    let types = schema::all_types().map(schema::TypeSchema::path);
    let kinds = Kind::ALL.into_iter().map(|kind| kind.name().to_owned());
    let functions = FUNCTIONS.iter().map(|function| function.name.to_owned());
    let mut names: Vec<String> = types.chain(kinds).chain(functions).collect();
    names.sort();
    names.dedup();
    names
}

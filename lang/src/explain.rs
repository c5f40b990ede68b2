//! `rtc explain`: pages about codes, and tables of fields and functions out of the schema.
//!
//! Every page about a code has an example that fails with exactly that code; a test runs them.

mod code;

pub(crate) use code::code_page;
pub use code::codes;

use std::fmt::Write as _;

use crate::eval::function::{self, FUNCTIONS};
use crate::reference;
use crate::schema::{self, Kind};
use crate::units;

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

fn type_page(name: &str) -> Option<String> {
    if let Some(kind) = Kind::from_name(name) {
        let pages: Vec<String> =
            schema::types_of(kind).iter().map(|t| reference::type_page(t)).collect();
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

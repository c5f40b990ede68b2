//! The schema as Markdown: `docs/reference.md`, and the pages of `rtc explain`.

use std::fmt::Write as _;

use crate::eval::function::FUNCTIONS;
use crate::eval::param_words;
use crate::explain;
use crate::schema::{self, Field, FieldType, Kind, TypeSchema};
use crate::standard;
use crate::units::{self, UNITS};

/// The whole reference. `docs/reference.md` holds exactly this text.
#[must_use]
pub fn reference_markdown() -> String {
    let mut out = String::from(HEAD);
    for kind in Kind::ALL {
        let _ = writeln!(out, "\n## {}\n", kind.name());
        for (i, schema) in schema::types_of(kind).iter().enumerate() {
            if i > 0 {
                out.push('\n');
            }
            if !schema.name.is_empty() {
                let _ = writeln!(out, "### {}\n", schema.path());
            }
            if kind == Kind::Material {
                let name = schema.name;
                let _ = writeln!(out, "![a ball of {name}](balls/{name}.png)\n");
            }
            body(&mut out, schema);
        }
    }
    standard_modules(&mut out);
    out.push_str("\n## Functions\n\n| function | value |\n|---|---|\n");
    for function in FUNCTIONS {
        let _ = writeln!(out, "| `{}` | {} |", function.signature(), function.doc);
    }
    out.push_str("\n## Units\n\n| unit | name | in SI |\n|---|---|---|\n");
    for unit in UNITS {
        let factor = units::show_number(unit.factor);
        let _ =
            writeln!(out, "| `{}` | {} | {factor} {} |", unit.symbol, unit.doc, unit.dim.si_unit());
    }
    out.push_str("\nA unit may have a power (`m2`), divide another (`m/s`), or stand alone as a divisor (`/m`).\n");
    out.push_str("\n## Types of parameters\n\n");
    let words: Vec<String> = param_words().iter().map(|word| format!("`{word}`")).collect();
    let _ = writeln!(out, "{}.", words.join(", "));
    out.push_str("\n## Codes\n\n`rtc explain CODE` prints a page with an example.\n\n");
    for code in explain::codes() {
        let page = explain::code_page(code).unwrap_or_default();
        let title = page.lines().next().unwrap_or_default().trim_start_matches("# ");
        let title = title.trim_start_matches(code).trim_start_matches(": ");
        let _ = writeln!(out, "- `{code}` {title}");
    }
    out
}

const HEAD: &str = "# Reference of the scene language

<!-- Made from the schema in `lang/src/schema`; `UPDATE=1 cargo test -p lang` rewrites it. -->

Every kind, type and field of `rts 1`. A field that is not listed here is an error. `rtc explain NAME`
prints any of these tables, for example `rtc explain material.metal`.

## How a scene is put together

- Declarations and fields may stand in any order. Every name of a file is unique, whatever it names.
- `let name = value` names a value; `param name: type = value in low..high` names one that
  `-D name=value` may replace, in the root file.
- `like other` takes every field of another declaration of the same kind, and changes some. `default`
  goes back to the default, `none` takes an optional field away.
- `material mine like car.material(\"paint\") { ... }` and `camera eye like car.camera(\"Camera\") { ... }`
  take what they do not say from a mesh file, `asset car`; `rtc show --assets` lists what it has.
- `name.field` is the value of a field of another declaration: `distance(hero.from, hero.to)`.
- `instance name[i in 0..6] { ... }` makes `name[0]` to `name[5]`.
- An object is a shape, another object, or a list of objects, with a place of its own. An instance of a
  list makes one thing for each member, called `instance.member`.
- `import \"parts/lantern.rts\" as lantern` makes the `pub` names of a file usable as `lantern.name`;
  `import \"file\" { a, b }` brings some of them, `import \"file\"` all of them, under their own names. An
  imported file puts only its `pub` instances and lights into the world; its `render` does not count.
- `import \"std:materials\" { glass }` brings a material that comes with the language.
- The root file has one `render`. Where it names no camera, film or sky, it takes the only one in the
  file.
- In `if a then b else c` both branches must make sense, and only the numbers of the taken one count.
";

/// The texts of the `std:` modules.
fn standard_modules(out: &mut String) {
    out.push_str("\n## Standard modules\n\nThese come with the language and never change within an edition.\n");
    for (name, text) in standard::modules() {
        let _ = writeln!(out, "\n### {name}\n\n```rts\n{text}```");
    }
}

/// The page of one type.
pub(crate) fn type_page(schema: &TypeSchema) -> String {
    let mut out = format!("# {}\n\n", schema.path());
    body(&mut out, schema);
    out
}

fn body(out: &mut String, schema: &TypeSchema) {
    let _ = writeln!(out, "{}\n\n```rts\n{}\n```\n", schema.doc, schema.example);
    out.push_str("| field | value | default | |\n|---|---|---|---|\n");
    for field in schema.fields {
        let _ = writeln!(
            out,
            "| `{}` | {} | {} | {} |",
            field.name,
            escape(&value_text(field)),
            escape(&schema::default_text(field)),
            escape(&doc_text(field))
        );
    }
    let foreign: Vec<String> = schema
        .fields
        .iter()
        .filter(|field| !field.foreign.is_empty())
        .map(|field| {
            let names: Vec<String> =
                field.foreign.iter().map(|(name, _)| format!("`{name}`")).collect();
            format!("`{}` ({})", field.name, names.join(", "))
        })
        .collect();
    if !foreign.is_empty() {
        let _ = writeln!(out, "\nNames elsewhere: {}.", foreign.join("; "));
    }
}

/// Type and range of a field.
fn value_text(field: &Field) -> String {
    let (ty, range) = (schema::type_text(field.ty), schema::range_text(field.ty));
    if range.is_empty() { ty } else { format!("{ty}, {range}") }
}

fn doc_text(field: &Field) -> String {
    let mut text = field.doc.to_owned();
    if let FieldType::Word(words) | FieldType::Words(words) | FieldType::IntegerOr(_, _, words) =
        field.ty
    {
        let list: Vec<String> =
            words.iter().map(|(word, doc)| format!("`{word}`: {doc}")).collect();
        let _ = write!(text, " {}.", list.join("; "));
    }
    if !field.typical.is_empty() {
        let _ = write!(text, " Typical: {}.", field.typical);
    }
    text
}

fn escape(text: &str) -> String {
    text.replace('|', "\\|")
}

/// The page of one field.
pub(crate) fn field_page(schema: &TypeSchema, field: &Field) -> String {
    let owner = if schema.name.is_empty() { schema.kind.name() } else { schema.name };
    let mut out = format!("# {owner}.{}\n\n{}\n\n", field.name, doc_text(field));
    let _ = writeln!(out, "- value: {}", value_text(field));
    let _ = writeln!(out, "- default: {}", schema::default_text(field));
    for (name, from) in field.foreign {
        let _ = writeln!(out, "- called `{name}` in {from}");
    }
    out
}

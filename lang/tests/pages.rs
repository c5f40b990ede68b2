//! Generated text: the reference is up to date, every page has an example that fails as it says, and
//! every example of the schema is right.

mod common;

use std::path::Path;

use common::{check_text, describe};
use lang::schema::{Kind, all_types};

/// Makes a scene of any declarations.
const TAIL: &str = "sky tail_sky: constant { }
camera tail_camera: perspective { from = (0, 1, 5)m, to = (0, 1, 0)m }
render tail_render: path { camera = tail_camera, sky = tail_sky }
";

#[test]
fn the_reference_is_what_the_schema_says() {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../docs/reference.md");
    let made = lang::reference_markdown();
    if std::env::var_os("UPDATE").is_some() {
        std::fs::write(&path, &made).expect("docs can be written");
    }
    let stored = std::fs::read_to_string(&path).unwrap_or_default();
    assert_eq!(stored, made, "docs/reference.md is stale: UPDATE=1 cargo test -p lang");
}

/// The first block of code of a page that starts with ```` ```rts ````, and the word after that:
/// `whole` is a scene of its own, `files` fails only where there are files, `compiled` is a scene of its own that fails
/// only when it is compiled.
fn example(page: &str) -> Option<(String, &str)> {
    let (_, rest) = page.split_once("```rts")?;
    let (info, rest) = rest.split_once('\n')?;
    let (text, _) = rest.split_once("```")?;
    Some((text.to_owned(), info.trim()))
}

#[test]
fn every_page_has_an_example_that_fails_as_it_says() {
    // Two files, a command line, or characters that cannot be printed.
    let without = ["E0107", "E0112", "E0199", "E0206", "E0210", "E0213"];
    // What only the compiler can find has its examples run where the compiler is tested.
    for code in lang::codes().filter(|code| !code.starts_with("W052")) {
        let page = lang::explain(code).expect("codes() lists pages");
        let Some((text, info)) = example(&page) else {
            assert!(without.contains(&code), "{code} has no example");
            continue;
        };
        if ["files", "compiled"].contains(&info) {
            continue;
        }
        let text = if info == "whole" { text } else { format!("rts 1\n{text}{TAIL}") };
        let analysis = check_text(&text);
        let mut found: Vec<&str> = analysis.diagnostics.iter().map(|d| d.code.0).collect();
        found.dedup();
        assert_eq!(found, [code], "{code}:\n{}", describe(&analysis));
    }
}

#[test]
fn every_example_of_the_schema_is_right() {
    // What the examples refer to; a line is left out where the example declares its name itself.
    let others = [
        ("clay", "material clay: diffuse { color = linear(0.5) }"),
        ("steel", "material steel: conductor { color = linear(0.6) }"),
        ("post", "object post { shape = sphere(radius: 1m), material = clay }"),
        ("hero", "camera hero: perspective { from = (4, 1.5, 10)m, to = (0, 2, 0)m }"),
        ("uhd", "film uhd { }"),
        ("dusk", "sky dusk: gradient { }"),
        ("tail_render", "render tail_render: path { camera = hero, film = uhd, sky = dusk }"),
    ];
    for schema in all_types() {
        let mut text = String::from("rts 1\n");
        let (name, _) = schema
            .example
            .split_once([' ', ':'])
            .map_or(("", ""), |(_, rest)| rest.split_once([' ', ':']).unwrap_or((rest, "")));
        let is_render = schema.kind == Kind::Render;
        for (other, line) in others {
            if other != name && !(is_render && other == "tail_render") {
                text.push_str(line);
                text.push('\n');
            }
        }
        text.push_str(schema.example);
        let analysis = check_text(&text);
        assert!(analysis.scene.is_some(), "{}:\n{}\n{text}", schema.path(), describe(&analysis));
    }
}

#[test]
fn every_name_has_a_page() {
    for name in lang::explained_names() {
        let page = lang::explain(&name).unwrap_or_default();
        assert!(page.starts_with("# ") && page.lines().count() > 2, "{name}: {page}");
    }
    let page = lang::explain("metal.fuzz").expect("a page");
    assert!(page.contains("called `roughness` in pbrt"), "{page}");
    assert!(lang::explain("unused").is_some_and(|page| page.starts_with("# W0201")));
    assert_eq!(lang::explain("nothing.like.it"), None);
}

#[test]
fn every_field_says_what_it_is() {
    for schema in all_types() {
        for field in schema.fields {
            let name = format!("{}.{}", schema.path(), field.name);
            assert!(field.doc.ends_with('.') || field.doc.ends_with(':'), "{name}: {}", field.doc);
            assert_eq!(schema.fields.iter().filter(|f| f.name == field.name).count(), 1, "{name}");
            for (theirs, _) in field.foreign {
                assert!(schema.field(theirs).is_none(), "{name}: `{theirs}` is a field of its own");
            }
        }
    }
}

//! No circles between files: who reads one needs only those below it. `tests::structure` says what an arrow is.

use std::path::Path;

use tests::structure::{CRATES, Circle, new_material, recipe, rust, shapes};

const ROOT: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/..");

/// Circles that may be, with the reason.
const EXCEPTIONS: &[(&[&str], &str)] = &[];

/// What is wrong: circles that are no exception, and exceptions that are no circle any more.
fn faults(circles: &[Circle], exceptions: &[(&[&str], &str)]) -> Vec<String> {
    let new = circles.iter().filter(|circle| exceptions.iter().all(|row| row.0 != circle.files));
    let stale = exceptions.iter().filter(|row| circles.iter().all(|c| row.0 != c.files));
    let stale = stale.map(|(files, reason)| format!("no circle any more: {files:?}, {reason}"));
    new.map(Circle::to_string).chain(stale).collect()
}

#[test]
fn files_make_no_circles() {
    let shapes = shapes(Path::new(ROOT)).expect("the sources can be read");
    assert_eq!(shapes.len(), CRATES.len() + 1, "every crate, and the WGSL");
    let circles: Vec<Circle> = shapes.iter().flat_map(|shape| shape.circles.clone()).collect();
    let faults = faults(&circles, EXCEPTIONS);
    let help = "Move what is shared to the lower file, or to one of its own.";
    assert!(faults.is_empty(), "{}\n{help}", faults.join("\n"));
    let globs: Vec<&String> = shapes.iter().flat_map(|shape| &shape.globs).collect();
    assert!(globs.is_empty(), "name the items, or arrows are not seen: {globs:?}");
}

/// Names and texts.
type Sources = &'static [(&'static str, &'static str)];

/// Files of a small crate, and the circle in it.
const CASES: &[(&str, Sources, &[&str])] = &[
    (
        "a file below",
        &[("lib.rs", "mod a; mod b;"), ("a.rs", "use crate::b::B;"), ("b.rs", "pub struct B;")],
        &[],
    ),
    (
        "two files that name each other, one inside of a function",
        &[
            ("lib.rs", "mod a; mod b;"),
            ("a.rs", "use crate::b::B; pub fn g(b: B) {}"),
            ("b.rs", "pub struct B; fn f() { super::a::g(B); }"),
        ],
        &["src/a.rs", "src/b.rs"],
    ),
    (
        "a child that takes from its parent, which calls it",
        &[
            ("lib.rs", "mod a; pub struct P; fn f() { a::g(); }"),
            ("a.rs", "use super::P; pub fn g() {}"),
        ],
        &["src/a.rs", "src/lib.rs"],
    ),
    (
        "a parent that only passes on what its child declares",
        &[("lib.rs", "mod a; pub use a::A; pub struct P;"), ("a.rs", "pub struct A(crate::P);")],
        &[],
    ),
    (
        "past a re-export, to the file that declares",
        &[
            ("lib.rs", "mod a; mod b; pub use b::B as Passed;"),
            ("a.rs", "use crate::Passed; pub struct A;"),
            ("b.rs", "pub struct B(crate::a::A);"),
        ],
        &["src/a.rs", "src/b.rs"],
    ),
    (
        "through the arguments of a macro",
        &[
            ("lib.rs", "mod a; mod b;"),
            ("a.rs", "pub const A: u8 = 0; fn f() -> String { format!(\"{}\", crate::b::B) }"),
            ("b.rs", "use crate::a; pub const B: u8 = a::A;"),
        ],
        &["src/a.rs", "src/b.rs"],
    ),
    (
        "through a macro's own body",
        &[
            ("lib.rs", "mod a; mod b;"),
            ("a.rs", "macro_rules! m { () => { $crate::b::B } } pub(crate) use m;"),
            ("b.rs", "pub const B: u8 = 0; fn f() { crate::a::m!(); }"),
        ],
        &["src/a.rs", "src/b.rs"],
    ),
    (
        "in tests only",
        &[
            ("lib.rs", "mod a; mod b;"),
            ("a.rs", "pub struct A; #[cfg(all(test, unix))] mod tests { use crate::b::B; }"),
            ("b.rs", "use crate::a::A; pub struct B; #[cfg(test)] fn f(a: A) {}"),
        ],
        &[],
    ),
];

#[test]
fn circles_are_found() {
    for (what, files, expected) in CASES {
        let folder = tempfile::tempdir().expect("a temporary folder");
        std::fs::create_dir(folder.path().join("src")).expect("a folder");
        for (name, text) in *files {
            std::fs::write(folder.path().join("src").join(name), text).expect("a source");
        }
        let shape = rust(folder.path(), "toy", "").expect("it is Rust");
        let found: Vec<&str> =
            shape.circles.iter().flat_map(|circle| &circle.files).map(String::as_str).collect();
        assert_eq!(&found, expected, "{what}: {:?}", shape.circles);
    }
}

#[test]
fn a_circle_is_a_fault_and_so_is_a_stale_exception() {
    let circle = Circle { files: vec!["a.rs".to_owned(), "b.rs".to_owned()], arrows: Vec::new() };
    let known: (&[&str], &str) = (&["a.rs", "b.rs"], "one type");
    assert_eq!(faults(std::slice::from_ref(&circle), &[]).len(), 1);
    assert_eq!(faults(&[circle], &[known]), Vec::<String>::new());
    assert_eq!(faults(&[], &[known]).len(), 1);
}

/// Recipes of ARCHITECTURE.md state as many files as they list, and all of them are there.
#[test]
fn recipes_name_files_that_are_there() {
    for kind in ["material", "light", "sky", "shape", "texture kind"] {
        let recipe = recipe(Path::new(ROOT), kind).unwrap_or_else(|| panic!("no recipe: {kind}"));
        assert_eq!(recipe.files.len(), recipe.stated, "a {kind}: {:?}", recipe.files);
        for file in &recipe.files {
            // A file that is to be made stands in a folder that is there.
            let (folder, name) = file.rsplit_once('/').unwrap_or(("", file));
            let there = if name.contains("NAME") { folder } else { file };
            assert!(Path::new(ROOT).join(there).exists(), "a {kind}: {file}");
        }
    }
    let files = new_material(Path::new(ROOT)).expect("the patch is there");
    let recipe = recipe(Path::new(ROOT), "material").expect("there is one");
    let listed =
        |file: &String| recipe.files.iter().any(|known| known.replace("NAME", "velvet") == *file);
    assert!(files.iter().all(listed), "the patch writes {files:?}, the recipe {:?}", recipe.files);
}

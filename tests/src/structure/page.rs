//! Figures of several states of the tree become `docs/structure.md`.

use std::fmt::Write as _;
use std::io;
use std::path::Path;

use super::{Lines, Shape, new_material, recipe, shapes};

/// The tree as it was at one time.
pub struct State {
    /// A commit, or what else its column is called.
    pub title: String,
    shapes: Vec<Shape>,
    /// Files that a new kind touches, in the order of [`KINDS`].
    kinds: Vec<Option<usize>>,
}

/// Kind, and where the number of its files is from.
const KINDS: &[(&str, &str)] = &[
    ("material", "`tests/new_kind/velvet.patch`, which `.ci/new-kind` applies, builds and renders"),
    ("light", "recipe in ARCHITECTURE.md"),
    ("shape", "recipe in ARCHITECTURE.md"),
];

const HEADER: &str = "# Structure\n\n\
    Made by `cargo run -p tests --bin structure -- --before COMMIT … --write`; edit the program, not this page. \
    Without arguments it prints the figures of the working tree, with every circle. How much of an earlier \
    compilation `rtc` reuses is in [benchmarks.md](benchmarks.md), made by `cargo run --release -p tests --bin \
    benchmarks`.\n";

const CIRCLES: &str = "\n## Circles between files\n\n\
    An arrow leads from a file that names an item to the file that declares it, past re-exports; neither `mod x;` nor \
    a re-export is one. Calls of methods are not seen, and unit tests do not count. A circle is a set of files of \
    which each leads to every other. `tests/tests/circles.rs` allows only those that it lists with a reason.\n\n";

const LINES: &str = "\n## Lines of the product\n\n\
    Without tests, examples and benches; in brackets, without blank lines and comments.\n\n";

const KIND: &str = "\n## Files written by hand for a new kind\n\n";

impl State {
    /// Reads the tree in `tree`.
    pub fn read(title: &str, tree: &Path) -> io::Result<Self> {
        let stated = |kind| recipe(tree, kind).map(|recipe| recipe.stated);
        let kinds = KINDS.iter().map(|(kind, _)| match *kind {
            "material" => new_material(tree).map(|files| files.len()),
            other => stated(other),
        });
        Ok(Self { title: title.to_owned(), shapes: shapes(tree)?, kinds: kinds.collect() })
    }

    fn shape(&self, name: &str) -> Option<&Shape> {
        self.shapes.iter().find(|shape| shape.name == name)
    }

    /// Every circle, with its arrows.
    #[must_use]
    pub fn circles(&self) -> String {
        let circles = self.shapes.iter().flat_map(|shape| &shape.circles);
        circles.map(ToString::to_string).collect::<Vec<String>>().join("\n")
    }
}

/// The page; the last state is the one of the working tree.
#[must_use]
pub fn page(states: &[State]) -> String {
    let mut text = format!("{HEADER}{CIRCLES}");
    let rows: Vec<&str> = states
        .last()
        .map(|state| state.shapes.iter().map(|shape| shape.name.as_str()).collect())
        .unwrap_or_default();
    head(&mut text, "crate", states);
    for name in &rows {
        row(&mut text, name, states, |state| state.shape(name).map(circles));
    }
    row(&mut text, "all", states, |state| Some(total_circles(state)));
    text += LINES;
    head(&mut text, "crate", states);
    for name in &rows {
        row(&mut text, name, states, |state| Some(lines(state.shape(name)?.lines)));
    }
    row(&mut text, "all", states, |state| {
        let mut all = Lines::default();
        state.shapes.iter().for_each(|shape| all += shape.lines);
        Some(lines(all))
    });
    text += KIND;
    head(&mut text, "kind, counted from", states);
    for (index, (kind, source)) in KINDS.iter().enumerate() {
        let title = format!("{kind}: {source}");
        row(&mut text, &title, states, |state| state.kinds[index].map(|n| n.to_string()));
    }
    text
}

fn head(text: &mut String, first: &str, states: &[State]) {
    let titles: Vec<&str> = states.iter().map(|state| state.title.as_str()).collect();
    let _ = writeln!(text, "| {first} | {} |", titles.join(" | "));
    let _ = writeln!(text, "|---|{}", "---:|".repeat(states.len()));
}

fn row(text: &mut String, title: &str, states: &[State], cell: impl Fn(&State) -> Option<String>) {
    let cells: Vec<String> =
        states.iter().map(|state| cell(state).unwrap_or_else(|| "–".to_owned())).collect();
    let _ = writeln!(text, "| {title} | {} |", cells.join(" | "));
}

fn circles(shape: &Shape) -> String {
    in_words(shape.circles.len(), in_circles(shape), shape.files)
}

fn total_circles(state: &State) -> String {
    let sum = |of: fn(&Shape) -> usize| state.shapes.iter().map(of).sum();
    in_words(sum(|shape| shape.circles.len()), sum(in_circles), sum(|shape| shape.files))
}

fn in_circles(shape: &Shape) -> usize {
    shape.circles.iter().map(|circle| circle.files.len()).sum()
}

fn in_words(circles: usize, inside: usize, files: usize) -> String {
    match circles {
        0 => format!("none, {files} files"),
        n => format!("{n} of {inside} files, of {files}"),
    }
}

fn lines(lines: Lines) -> String {
    format!("{} ({})", lines.all, lines.code)
}

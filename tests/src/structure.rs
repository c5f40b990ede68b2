//! A source tree becomes figures about how it is made: circles between files, lines, files that a new kind touches.
//!
//! `tests/tests/circles.rs` holds the rule; the program `structure` prints the figures and compares commits.

mod arrows;
pub mod circles;
mod kinds;
mod lines;
mod modules;
pub mod page;

use std::collections::BTreeSet;
use std::fmt;
use std::fs;
use std::io;
use std::path::{Path, PathBuf};

pub use arrows::Arrow;
pub use kinds::{Recipe, new_material, recipe};
pub use lines::Lines;

use modules::Package;

/// The product: crate and folder. Not the tests, the examples and the benches beside them.
pub const CRATES: &[(&str, &str)] = &[
    ("host", "runtime/host"),
    ("lang", "lang"),
    ("files", "shaders/files"),
    ("pack", "shaders/pack"),
    ("native", "shaders/native"),
    ("shaders", "shaders"),
    ("compiler", "compiler"),
    ("commit", "runtime/commit"),
    ("kernel_f32", "runtime/kernel/f32"),
    ("kernel_f64", "runtime/kernel/f64"),
    ("kernel_target", "runtime/kernel/target"),
    ("kernel_avx2", "runtime/kernel/avx2"),
    ("kernel_avx512", "runtime/kernel/avx512"),
    ("runtime", "runtime"),
    ("scenes", "scenes"),
];

/// Folder of the WGSL modules.
const WGSL: &str = "shaders/wgsl";

/// Files that need each other, with every arrow between two of them.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Circle {
    /// Relative to the tree, ascending.
    pub files: Vec<String>,
    /// From, to, and what for.
    pub arrows: Vec<(String, String, Arrow)>,
}

impl fmt::Display for Circle {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        writeln!(f, "circle of {} files, {} arrows:", self.files.len(), self.arrows.len())?;
        for (from, to, Arrow { item, line }) in &self.arrows {
            writeln!(f, "  {from}:{line} names `{item}` of {to}")?;
        }
        Ok(())
    }
}

/// What one crate is made of.
#[derive(Clone, Debug)]
pub struct Shape {
    /// Name of the crate, or `WGSL`.
    pub name: String,
    /// Number of files.
    pub files: usize,
    /// Arrows between them.
    pub arrows: usize,
    /// Sets of files that need each other.
    pub circles: Vec<Circle>,
    /// `file:line` of every `use path::*` of the crate's own modules: the items behind it are not seen.
    pub globs: Vec<String>,
    /// Its lines, without those of unit tests.
    pub lines: Lines,
}

/// Reads the crates of [`CRATES`] that are in `tree`, and the WGSL modules.
pub fn shapes(tree: &Path) -> io::Result<Vec<Shape>> {
    let mut shapes = Vec::new();
    for (name, folder) in CRATES {
        if tree.join(folder).join("src").is_dir() {
            shapes.push(rust(tree, name, folder)?);
        }
    }
    shapes.push(wgsl(tree)?);
    Ok(shapes)
}

/// The crate in `folder` of `tree`, with its programs and its build script.
pub fn rust(tree: &Path, name: &str, folder: &str) -> io::Result<Shape> {
    let mut package = Package::default();
    for root in roots(&tree.join(folder))? {
        package.add_crate(&root)?;
    }
    let (arrows, globs) = arrows::arrows(&package);
    let names: Vec<String> = package.files.iter().map(|path| relative(tree, path)).collect();
    let found: Vec<(usize, usize, Arrow)> =
        arrows.into_iter().map(|((from, to), arrow)| (from, to, arrow)).collect();
    let mut lines = Lines::default();
    for (index, path) in package.files.iter().enumerate() {
        let of_file = |(module, _): &&(usize, syn::File)| package.modules[*module].file == index;
        if let Some((_, source)) = package.sources.iter().find(of_file) {
            lines += lines::rust(&fs::read_to_string(path)?, source);
        }
    }
    Ok(Shape {
        name: name.to_owned(),
        files: names.len(),
        arrows: found.len(),
        circles: named_circles(&names, &found),
        globs: globs.iter().map(|(file, line)| format!("{}:{line}", names[*file])).collect(),
        lines,
    })
}

/// Files in which a target of the package begins; not tests, examples, benches.
fn roots(package: &Path) -> io::Result<Vec<PathBuf>> {
    let source = package.join("src");
    let mut roots = vec![source.join("lib.rs"), source.join("main.rs"), package.join("build.rs")];
    let programs = source.join("bin");
    if programs.is_dir() {
        let entries = fs::read_dir(programs)?.collect::<io::Result<Vec<_>>>()?;
        roots.extend(entries.iter().map(fs::DirEntry::path));
    }
    roots.retain(|root| root.is_file());
    roots.sort();
    Ok(roots)
}

/// The WGSL modules of `tree`, with `#import "…"` as arrows.
fn wgsl(tree: &Path) -> io::Result<Shape> {
    let folder = tree.join(WGSL);
    let mut paths = Vec::new();
    below(&folder, &mut paths)?;
    paths.sort();
    let modules: Vec<String> = paths.iter().map(|path| relative(&folder, path)).collect();
    let mut arrows = Vec::new();
    let mut lines = Lines::default();
    for (from, path) in paths.iter().enumerate() {
        let text = fs::read_to_string(path)?;
        lines += lines::plain(&text);
        for (number, line) in text.lines().enumerate() {
            let import = line.strip_prefix("#import \"").and_then(|rest| rest.strip_suffix('"'));
            let to = import.and_then(|name| modules.iter().position(|module| module == name));
            if let (Some(item), Some(to)) = (import, to) {
                arrows.push((from, to, Arrow { item: item.to_owned(), line: number + 1 }));
            }
        }
    }
    let names: Vec<String> = paths.iter().map(|path| relative(tree, path)).collect();
    Ok(Shape {
        name: "WGSL".to_owned(),
        files: names.len(),
        arrows: arrows.len(),
        circles: named_circles(&names, &arrows),
        globs: Vec::new(),
        lines,
    })
}

fn below(folder: &Path, found: &mut Vec<PathBuf>) -> io::Result<()> {
    for entry in fs::read_dir(folder)? {
        let path = entry?.path();
        if path.is_dir() {
            below(&path, found)?;
        } else if path.extension().is_some_and(|extension| extension == "wgsl") {
            found.push(path);
        }
    }
    Ok(())
}

fn relative(tree: &Path, path: &Path) -> String {
    path.strip_prefix(tree).unwrap_or(path).to_string_lossy().replace('\\', "/")
}

fn named_circles(names: &[String], arrows: &[(usize, usize, Arrow)]) -> Vec<Circle> {
    let pairs: BTreeSet<(usize, usize)> = arrows.iter().map(|(from, to, _)| (*from, *to)).collect();
    let circles = circles::circles(names.len(), &pairs);
    let named = circles.into_iter().map(|circle| {
        let inside =
            arrows.iter().filter(|(from, to, _)| circle.contains(from) && circle.contains(to));
        let mut arrows: Vec<(String, String, Arrow)> = inside
            .map(|(from, to, arrow)| (names[*from].clone(), names[*to].clone(), arrow.clone()))
            .collect();
        arrows.sort_by(|a, b| (&a.0, a.2.line).cmp(&(&b.0, b.2.line)));
        let mut files: Vec<String> = circle.iter().map(|file| names[*file].clone()).collect();
        files.sort();
        Circle { files, arrows }
    });
    named.collect()
}

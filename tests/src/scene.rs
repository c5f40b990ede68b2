//! Scene text → checked pack, in memory, through the whole compiler.

use std::path::Path;

use compiler::bvh::Preset;
use compiler::cache::Cache;
use compiler::import::Limits;
use compiler::pipeline::{self, Compiled, Options};
use lang::scene::Scene;
use lang::source::{LoadError, Loader};
use pack::{Checked, Pack};

/// A loader for texts without imports.
struct NoImports;

impl Loader for NoImports {
    fn load(&mut self, _: &str, _: &str) -> Result<(String, String), LoadError> {
        Err(LoadError::NotFound)
    }
}

/// Compiles a text whose files are relative to `root`; diagnostics of errors become a panic.
///
/// # Panics
/// When the text is not a scene: tests are to fail there.
#[must_use]
pub fn compile_in(root: &Path, text: &str) -> Compiled {
    compile_with(root, text, &Cache::disabled())
}

/// As `compile_in`, with a cache of trees.
///
/// # Panics
/// As `compile_in`.
#[must_use]
pub fn compile_with(root: &Path, text: &str, cache: &Cache) -> Compiled {
    compile_as(root, text, Preset::default(), cache, |_| {})
}

/// As `compile_with`, with trees by this builder.
///
/// # Panics
/// As `compile_in`.
#[must_use]
pub fn compile_built(root: &Path, text: &str, preset: Preset, cache: &Cache) -> Compiled {
    compile_as(root, text, preset, cache, |_| {})
}

/// As `compile_in`; `change` alters the checked scene before it is lowered.
///
/// # Panics
/// As `compile_in`.
#[must_use]
pub fn compile_changed(root: &Path, text: &str, change: impl FnOnce(&mut Scene)) -> Compiled {
    compile_as(root, text, Preset::default(), &Cache::disabled(), change)
}

fn compile_as(
    root: &Path,
    text: &str,
    preset: Preset,
    cache: &Cache,
    change: impl FnOnce(&mut Scene),
) -> Compiled {
    let name = root.join("test.rts").display().to_string();
    let analysis = lang::analyze(&name, text, &mut NoImports, &lang::Options::default());
    let mut diagnostics = analysis.diagnostics;
    let shown = |list: &[lang::diagnostic::Diagnostic]| {
        let lines = list.iter().map(|d| lang::diagnostic::short(&analysis.sources, d));
        lines.collect::<Vec<_>>().join("\n")
    };
    let Some(mut scene) = analysis.scene else { panic!("{}", shown(&diagnostics)) };
    change(&mut scene);
    let options = Options { root, preset, cache, limits: Limits::default(), defines: &[] };
    match pipeline::compile(&scene, &analysis.sources, &options, &mut diagnostics) {
        Ok(compiled) => compiled,
        Err(error) => panic!("{error}\n{}", shown(&diagnostics)),
    }
}

/// Compiles a text that names no files.
#[must_use]
pub fn compile(text: &str) -> Compiled {
    compile_in(Path::new(""), text)
}

/// The bytes of the pack.
///
/// # Panics
/// When the writer finds fault with its own compiler.
#[must_use]
pub fn bytes(compiled: &Compiled) -> Vec<u8> {
    let srgb = compiler::lower::srgb_table();
    let written = compiled.writer(&srgb).and_then(|writer| writer.to_bytes());
    written.expect("the compiler makes packs that pass their own checks")
}

/// Compiles a text that names no files into a checked pack.
///
/// # Panics
/// As `compile` and `bytes`.
#[must_use]
pub fn pack(text: &str) -> Pack<Checked> {
    Pack::from_bytes(bytes(&compile(text))).expect("what was written can be read")
}

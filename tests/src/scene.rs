//! Scene text → checked pack, in memory, through the whole compiler.

use std::path::Path;

use compiler::bvh::{Layout, Preset};
use compiler::cache::Cache;
use compiler::import::Limits;
use compiler::lower::{Instancing, Trees, Visibility};
use compiler::pipeline::{self, Compiled, Options};
use lang::scene::Scene;
use lang::source::{LoadError, Loader};
use pack::{Checked, Pack};
use scenes::catalog::Example;
use scenes::generate::Extent;

/// A loader for texts without imports.
struct NoImports;

impl Loader for NoImports {
    fn load(&mut self, _: &str, _: &str) -> Result<(String, String), LoadError> {
        Err(LoadError::NotFound)
    }
}

/// Finds imports beside the file that imports them.
struct Beside;

impl Loader for Beside {
    fn load(&mut self, importing: &str, path: &str) -> Result<(String, String), LoadError> {
        let file = Path::new(importing).with_file_name(path);
        let text = std::fs::read_to_string(&file).map_err(|_| LoadError::NotFound)?;
        Ok((file.display().to_string(), text))
    }
}

/// Compiles an example, its texts copied and its assets generated (reduced) into a temporary
/// folder, so that tests never write into the checkout.
///
/// # Panics
/// When it is not a scene, or when it warns: examples are to be followed.
#[must_use]
pub fn example(example: &Example, defines: &[(&str, &str)]) -> Compiled {
    example_as(example, defines, Extent::Reduced, Layout::default())
}

/// As `example`, with all that belongs to it and nodes in this layout.
///
/// # Panics
/// As `example`.
#[must_use]
pub fn full_example(example: &Example, defines: &[(&str, &str)], layout: Layout) -> Compiled {
    example_as(example, defines, Extent::Full, layout)
}

fn example_as(
    example: &Example,
    defines: &[(&str, &str)],
    extent: Extent,
    layout: Layout,
) -> Compiled {
    let scenes = Path::new(env!("CARGO_MANIFEST_DIR")).join("../scenes");
    let copy = tempfile::tempdir().expect("a temporary directory can be made");
    let source = example.source(copy.path());
    let root = source.parent().expect("a scene has a folder").to_owned();
    copy_texts(&scenes.join(example.name), &root);
    example.generate(copy.path(), extent).expect("assets can be generated");
    let text = std::fs::read_to_string(&source).expect("an example has a text");
    let defines = defines.iter().map(|(name, value)| ((*name).into(), (*value).into()));
    let options = lang::Options { defines: defines.collect() };
    let name = source.display().to_string();
    let analysis = lang::analyze(&name, &text, &mut Beside, &options);
    let cache = Cache::disabled();
    let trees = Trees { layout, ..Trees::usual(&cache) };
    let compiled = finish(&root, trees, analysis, &options.defines, |_| {});
    let (compiled, diagnostics) = compiled;
    assert!(diagnostics.is_empty(), "{diagnostics}");
    compiled
}

/// Copies the `.rts` files of a folder and of the folders in it.
fn copy_texts(from: &Path, to: &Path) {
    std::fs::create_dir_all(to).expect("writable");
    for entry in std::fs::read_dir(from).expect("an example has a folder") {
        let path = entry.expect("readable").path();
        let name = path.file_name().expect("entries have names");
        if path.is_dir() && name != "generated" {
            copy_texts(&path, &to.join(name));
        } else if path.extension().is_some_and(|e| e == "rts") {
            std::fs::copy(&path, to.join(name)).expect("writable");
        }
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
    compile_as(root, text, Trees::usual(cache), |_| {})
}

/// As `compile_in`, with trees by this builder in this layout.
///
/// # Panics
/// As `compile_in`.
#[must_use]
pub fn compile_built(root: &Path, text: &str, preset: Preset, layout: Layout) -> Compiled {
    let cache = Cache::disabled();
    compile_as(root, text, Trees { preset, layout, ..Trees::usual(&cache) }, |_| {})
}

/// As `compile_in`, with lights weighed by what can see them, or not.
///
/// # Panics
/// As `compile_in`.
#[must_use]
pub fn compile_lit(root: &Path, text: &str, visibility: Visibility) -> Compiled {
    let cache = Cache::disabled();
    compile_as(root, text, Trees { visibility, ..Trees::usual(&cache) }, |_| {})
}

/// As `compile_changed`, with or without meshes that are stored once, and with this layout of nodes.
///
/// # Panics
/// As `compile_in`.
#[must_use]
pub fn compile_shared(
    root: &Path,
    text: &str,
    (instancing, layout): (Instancing, Layout),
    change: impl FnOnce(&mut Scene),
) -> Compiled {
    let cache = Cache::disabled();
    compile_as(root, text, Trees { instancing, layout, ..Trees::usual(&cache) }, change)
}

/// As `compile_in`; `change` alters the checked scene before it is lowered.
///
/// # Panics
/// As `compile_in`.
#[must_use]
pub fn compile_changed(root: &Path, text: &str, change: impl FnOnce(&mut Scene)) -> Compiled {
    compile_as(root, text, Trees::usual(&Cache::disabled()), change)
}

fn compile_as(
    root: &Path,
    text: &str,
    trees: Trees<'_>,
    change: impl FnOnce(&mut Scene),
) -> Compiled {
    let name = root.join("test.rts").display().to_string();
    let analysis = lang::analyze(&name, text, &mut NoImports, &lang::Options::default());
    finish(root, trees, analysis, &[], change).0
}

/// The pack of a checked text, and what was said about it, a line a diagnostic.
fn finish(
    root: &Path,
    trees: Trees<'_>,
    analysis: lang::Analysis,
    defines: &[(String, String)],
    change: impl FnOnce(&mut Scene),
) -> (Compiled, String) {
    let mut diagnostics = analysis.diagnostics;
    let shown = |list: &[lang::diagnostic::Diagnostic]| {
        let lines = list.iter().map(|d| lang::diagnostic::short(&analysis.sources, d));
        lines.collect::<Vec<_>>().join("\n")
    };
    let Some(mut scene) = analysis.scene else { panic!("{}", shown(&diagnostics)) };
    change(&mut scene);
    let options = Options { root, trees, limits: Limits::default(), defines };
    match pipeline::compile(&scene, &analysis.sources, &options, &mut diagnostics) {
        Ok(compiled) => (compiled, shown(&diagnostics)),
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

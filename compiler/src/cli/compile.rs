//! From the path of a scene to everything that its pack holds; what is wrong is reported.

use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::time::Instant;

use files::ShowPath as _;
use lang::Analysis;
use lang::stack::on_large_stack;
use shaders::ShaderError;

use super::files::{DiskLoader, TextError, read_scene};
use super::record::{Edited, Job};
use super::{BUG, IO, SCENE, SceneArgs, USAGE};
use crate::import::Limits;
use crate::input::{InputError, Root};
use crate::lower::Trees;
use crate::pipeline::{self, CompileError, Compiled, Essence, Memory, Options, Phase};
use crate::report::Reporter;
use crate::reuse::Reuse;

/// Reads and checks the text; an unreadable file is reported and becomes an exit code.
pub(super) fn analyze(scene: &SceneArgs, reporter: &Reporter) -> Result<Analysis, u8> {
    analyze_reading(scene, &scene.root(reporter)?, &Reuse::once(), reporter)
}

/// As `analyze`; `reuse` is told which files are read.
fn analyze_reading(
    scene: &SceneArgs,
    root: &Root,
    reuse: &Reuse,
    reporter: &Reporter,
) -> Result<Analysis, u8> {
    reuse.read(&scene.scene);
    let shown = scene.scene.display().to_string();
    let text = read_scene(&scene.scene, root).map_err(|error| {
        reporter.failure(&format!("cannot read {}: {error}", scene.scene.shown()));
        if scene.scene.extension().is_some_and(|e| e == "pack") {
            reporter.status("help: this is a pack already; render it with `rtr`");
        }
        match error {
            TextError::Input(InputError::Outside(_)) => USAGE,
            TextError::Input(_) => IO,
            TextError::NotText(_) | TextError::NotScene => SCENE,
        }
    })?;
    let options = lang::Options { defines: scene.define.clone() };
    let analyze = || lang::analyze(&shown, &text, &mut DiskLoader { reuse, root }, &options);
    on_large_stack(analyze).map_err(|error| {
        reporter
            .failure(&format!("cannot start a thread to read {}: {error}", scene.scene.shown()));
        IO
    })
}

/// A scene that became everything that its pack holds.
pub(super) struct Compilation {
    pub(super) compiled: Compiled,
    pub(super) phases: Vec<Phase>,
    /// Texts of the scene.
    pub(super) texts: Vec<PathBuf>,
    /// There was nothing to say of it.
    pub(super) silent: bool,
    /// What there was to say will be said again when only texts have changed.
    pub(super) whole: bool,
}

/// Compiles a scene; `before`: which job it is, and what is there of its last compilation.
pub(super) fn compile(
    args: &SceneArgs,
    limits: &Limits,
    trees: Trees<'_>,
    before: Option<(&Job<'_>, &Edited)>,
    reuse: &Reuse,
    reporter: &Reporter,
) -> Result<Compilation, u8> {
    let start = Instant::now();
    let Analysis { sources, scene, mut diagnostics, .. } =
        analyze_reading(args, &limits.root, reuse, reporter)?;
    let Some(scene) = scene else {
        reporter.diagnostics(&sources, &diagnostics);
        return Err(SCENE);
    };
    let n_of_text = diagnostics.len();
    let mut phases = vec![Phase { name: "read and check the text", time: start.elapsed() }];
    let options = Options {
        root: args.scene.parent().unwrap_or(Path::new("")),
        trees,
        limits: limits.clone(),
        defines: &args.define,
    };
    let mut again = || -> Result<Option<Compiled>, CompileError> {
        let Some((job, edited)) = before else { return Ok(None) };
        let essence = Essence::new(&scene, &sources);
        let found = job.earlier(trees.cache, edited, |memory: &Memory| memory.fits(&essence));
        let Some((pack, memory)) = found else { return Ok(None) };
        let (what, known) = ((&scene, &essence), (&Arc::new(pack), &memory));
        pipeline::compile_again(what, &sources, &options, known, reuse, &mut diagnostics)
    };
    let taken_over = again();
    // Whatever came of bytes that were written to meanwhile, it is not what the scene says.
    if let Ok(Some(Compiled { source: Some(source), .. })) = &taken_over {
        source.look().map_err(|error| failed(&error.into(), reporter))?;
    }
    let result = match taken_over {
        Ok(Some(compiled)) => {
            before.iter().flat_map(|(_, edited)| edited.data()).for_each(|path| reuse.read(path));
            Ok(compiled)
        }
        Ok(None) => pipeline::compile_reusing(&scene, &sources, &options, reuse, &mut diagnostics),
        Err(error) => Err(error),
    };
    reporter.diagnostics(&sources, &diagnostics);
    let mut compiled = result.map_err(|error| failed(&error, reporter))?;
    phases.append(&mut compiled.phases);
    let silent = diagnostics.is_empty();
    let whole = diagnostics.len() == n_of_text;
    let texts = sources.ids().map(|id| PathBuf::from(sources.name(id))).collect();
    Ok(Compilation { compiled, phases, texts, silent, whole })
}

fn failed(error: &CompileError, reporter: &Reporter) -> u8 {
    match error {
        CompileError::Scene => SCENE,
        CompileError::Memory(_)
        | CompileError::Lower(_)
        | CompileError::Pack(_)
        | CompileError::Shader(ShaderError::TooManyBindings { .. }) => {
            reporter.failure(&error.to_string());
            IO
        }
        CompileError::Shader(_) | CompileError::Layout(_) => {
            reporter.failure(&format!("{error}\nThis is a bug of rtc, not of your scene."));
            BUG
        }
    }
}

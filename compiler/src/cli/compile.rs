//! From the path of a scene to everything that its pack holds; what is wrong is reported.

use std::path::Path;
use std::time::Instant;

use files::ShowPath as _;
use lang::Analysis;
use lang::diagnostic::Diagnostic;
use lang::source::SourceSet;
use lang::stack::on_large_stack;
use shaders::ShaderError;

use super::args::{BUG, IO, SCENE, SceneArgs, USAGE};
use super::files::{DiskLoader, TextError, read_scene};
use super::mapped;
use crate::import::Limits;
use crate::input::{InputError, Root};
use crate::lower::Trees;
use crate::pipeline::{self, CompileError, Compiled, Options, Phase, Session};
use crate::reads::Reads;
use crate::report::Reporter;
use crate::stage::Stages;

/// Reads and checks the text; an unreadable file is reported and becomes an exit code.
pub(super) fn analyze(scene: &SceneArgs, reporter: &Reporter) -> Result<Analysis, u8> {
    analyze_reading(scene, &scene.root(reporter)?, &Reads::default(), reporter)
}

/// As `analyze`; `reads` is told which files are read.
fn analyze_reading(
    scene: &SceneArgs,
    root: &Root,
    reads: &Reads,
    reporter: &Reporter,
) -> Result<Analysis, u8> {
    reads.read(&scene.scene);
    let shown = scene.scene.display().to_string();
    let text = read_scene(&scene.scene, root).map_err(|error| {
        reporter.failure(&format!("cannot read {}: {error}", scene.scene.shown()));
        if scene.scene.extension().is_some_and(|e| e == "pack") {
            reporter.status("help: this is already a pack; render it with `rtr`");
        }
        match error {
            TextError::Input(InputError::Outside(_)) => USAGE,
            TextError::Input(_) => IO,
            TextError::NotText(_) | TextError::NotScene => SCENE,
        }
    })?;
    let options = lang::Options { defines: scene.define.clone() };
    let analyze = || lang::analyze(&shown, &text, &mut DiskLoader { reads, root }, &options);
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
    /// There was nothing to say of it.
    pub(super) silent: bool,
}

/// Is told what is to be said of a scene.
type Tell<'a> = &'a dyn Fn(&SourceSet, &[Diagnostic]);

/// What is said of a scene, and what it became.
pub(super) struct Judged {
    pub(super) sources: SourceSet,
    pub(super) diagnostics: Vec<Diagnostic>,
    /// `Err`: why there is no pack; where that is no fault of the scene it has been reported.
    pub(super) result: Result<(Compiled, Vec<Phase>), u8>,
}

/// Compiles a scene, with what earlier compilations left.
pub(super) fn compile(
    args: &SceneArgs,
    limits: &Limits,
    trees: Trees<'_>,
    of: (&Session, &Stages),
    reporter: &Reporter,
) -> Result<Compilation, u8> {
    let tell = |sources: &SourceSet, diagnostics: &[Diagnostic]| {
        reporter.diagnostics(sources, diagnostics);
    };
    let judged = judge(args, limits, trees, of, (reporter, &tell))?;
    let (compiled, phases) = judged.result?;
    Ok(Compilation { compiled, phases, silent: judged.diagnostics.is_empty() })
}

/// As `compile`; `tell` is told what is to be said of the scene, before what is said of the world.
pub(super) fn judge(
    args: &SceneArgs,
    limits: &Limits,
    trees: Trees<'_>,
    (session, stages): (&Session, &Stages),
    (reporter, tell): (&Reporter, Tell<'_>),
) -> Result<Judged, u8> {
    let start = Instant::now();
    let Analysis { sources, scene, mut diagnostics, .. } =
        analyze_reading(args, &limits.root, &session.reads, reporter)?;
    let Some(scene) = scene else {
        tell(&sources, &diagnostics);
        return Ok(Judged { sources, diagnostics, result: Err(SCENE) });
    };
    let mut phases = vec![Phase { name: "read and check the text", time: start.elapsed() }];
    let options = Options {
        root: args.scene.parent().unwrap_or(Path::new("")),
        trees,
        limits: limits.clone(),
        defines: &args.define,
    };
    let result =
        pipeline::compile_after((&scene, &sources), &options, (session, stages), &mut diagnostics);
    // Whatever came of bytes that were written to meanwhile, it is not what the scene says.
    if let Some(pack) = stages.pack() {
        mapped::unchanged(pack).map_err(|error| failed(&error.into(), reporter))?;
    }
    tell(&sources, &diagnostics);
    let result = result.map_err(|error| failed(&error, reporter)).map(|mut compiled| {
        phases.append(&mut compiled.phases);
        (compiled, phases)
    });
    Ok(Judged { sources, diagnostics, result })
}

pub(super) fn failed(error: &CompileError, reporter: &Reporter) -> u8 {
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

//! `rtc build` and `rtc check`: a scene text becomes a pack, or a list of what is wrong with it.

use std::fmt::Write as _;
use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::time::{Duration, Instant, SystemTime};

use clap::Args;
use lang::Analysis;

use super::files::{DiskLoader, TextError, read_text};
use super::record::{Before, Done, Edited, Job, Record};
use super::watch::watch;
use super::{BUG, IO, OK, ReportArgs, SCENE, SceneArgs, inspect};
use crate::bvh::{Layout, Preset};
use crate::cache::Cache;
use crate::depfile::depfile;
use crate::import::Limits;
use crate::lower::{Counters, Instancing, Trees, srgb_table};
use crate::pipeline::{self, CompileError, Compiled, Memory, Options, Phase};
use crate::report::Reporter;
use crate::reuse::{Reuse, Reused, Share};
use pack::{MapMode, Pack};
use shaders::{FeatureSet, PORTABLE_STORAGE, ShaderError};

#[derive(Debug, Args)]
#[expect(clippy::struct_excessive_bools, reason = "each is a switch on the command line")]
pub(super) struct BuildArgs {
    #[command(flatten)]
    scene: SceneArgs,
    /// Where the pack goes [default: the scene's name with `.pack`, in the working directory].
    #[arg(short, long, value_name = "PACK")]
    output: Option<PathBuf>,
    /// Also write the linked kernel, for reading.
    #[arg(long, value_name = "FILE")]
    emit_wgsl: Option<PathBuf>,
    /// Compile again whenever a file that the scene depends on changes, until Ctrl-C.
    #[arg(long)]
    watch: bool,
    /// Also write every file that the pack depends on, as a rule for make or ninja.
    #[arg(long, value_name = "FILE")]
    depfile: Option<PathBuf>,
    /// Print what each phase cost, what was reused, and what the cache saved.
    #[arg(long)]
    timings: bool,
    /// How trees over the geometry are built: `fast` takes least time; `default` splits long triangles
    /// between leaves; `extreme` tries harder. For comparison only: `object-median`,
    /// `spatial-median`. All show the same surfaces.
    #[arg(long, default_value_t, value_name = "BUILDER")]
    bvh: Preset,
    /// Which meshes are stored once for all their places: `auto`, those for which it pays; `never`, none, for
    /// comparison. Both show the same surfaces.
    #[arg(long, default_value_t, value_name = "WHEN")]
    instances: Instancing,
    /// How inner nodes are stored: `wide` with up to four children, their boxes rounded outwards to 8
    /// bits; `binary`, which is larger, for comparison. Both show the same picture.
    #[arg(long, default_value_t, value_name = "LAYOUT")]
    nodes: Layout,
    /// Print the sections, and every feature of the kernel: which declaration needs it, or why it was left out;
    /// and how large the kernel is against one with all features. `rtc inspect` prints the same of any pack.
    #[arg(long)]
    explain_features: bool,
    /// Build every tree anew and store none.
    #[arg(long)]
    no_cache: bool,
    /// Threads to use [default: all].
    #[arg(long, value_name = "N")]
    threads: Option<usize>,
    #[command(flatten)]
    report: ReportArgs,
}

#[derive(Debug, Args)]
pub(super) struct CheckArgs {
    #[command(flatten)]
    scene: SceneArgs,
    #[command(flatten)]
    report: ReportArgs,
}

pub(super) fn build(args: &BuildArgs) -> u8 {
    let reporter = args.report.reporter();
    match args.threads {
        None => build_or_watch(args, &reporter),
        Some(threads) => match rayon::ThreadPoolBuilder::new().num_threads(threads).build() {
            Ok(pool) => pool.install(|| build_or_watch(args, &reporter)),
            Err(error) => {
                reporter.failure(&format!("cannot start {threads} threads: {error}"));
                IO
            }
        },
    }
}

fn build_or_watch(args: &BuildArgs, reporter: &Reporter) -> u8 {
    if args.watch {
        watch(reporter, |reuse| build_here(args, reporter, reuse) == OK)
    } else {
        build_here(args, reporter, &Reuse::once())
    }
}

fn build_here(args: &BuildArgs, reporter: &Reporter, reuse: &Reuse) -> u8 {
    let start = Instant::now();
    let cache = if args.no_cache { Cache::disabled() } else { Cache::from_env() };
    let output = args.output.clone().unwrap_or_else(|| default_output(&args.scene.scene));
    let trees =
        Trees { preset: args.bvh, layout: args.nodes, instancing: args.instances, cache: &cache };
    let job = Job { scene: &args.scene.scene, output: &output, defines: &args.scene.define, trees };
    let before = job.before(&cache);
    let edited = match before {
        // Who asks for the kernel or the times wants to see a compilation.
        Before::UpToDate(record) if args.emit_wgsl.is_none() && !args.timings => {
            return up_to_date(args, &record, &output, reuse, reporter);
        }
        Before::Edited(edited) => Some(edited),
        Before::UpToDate(_) | Before::Nothing => None,
    };
    let Compilation { compiled, mut phases, texts, silent, whole } =
        match compile(&args.scene, &job, edited.as_ref(), reuse, reporter) {
            Ok(done) => done,
            Err(code) => return code,
        };
    if let Some(path) = &args.emit_wgsl
        && let Err(code) = write_text(path, &compiled.kernel.text, reporter)
    {
        return code;
    }
    let writing = Instant::now();
    let srgb = srgb_table();
    let written = compiled.writer(&srgb).and_then(|writer| writer.write(&output));
    let render_id = match written {
        Ok(render_id) => render_id,
        Err(error) => {
            reporter.failure(&error.to_string());
            return IO;
        }
    };
    if let Some(path) = &args.depfile
        && let Err(code) = write_depfile(path, &output, reuse, reporter)
    {
        return code;
    }
    phases.push(Phase { name: "write the pack", time: writing.elapsed() });
    for warning in &compiled.lowered.trees.warnings {
        reporter.warning(&warning.to_string());
    }
    if args.timings {
        reporter.status(&timings(&phases, &compiled));
    }
    reporter.status(&done(&output, &compiled, start.elapsed()));
    if let Some(line) = reused_text(&compiled.reused) {
        reporter.status(&line);
    }
    if let Some(line) = portability(&compiled.features) {
        reporter.status(&line);
    }
    let silent = silent && compiled.lowered.trees.warnings.is_empty();
    let pack = [render_id, compiled.recipe_id];
    let memory = compiled.memory.as_ref().filter(|_| whole);
    if silent || memory.is_some() {
        let now = edited.map(Edited::now).unwrap_or_default();
        job.keep(&cache, reuse, Done { texts, pack, silent, memory, now });
    }
    explained(args, &output, reporter)
}

/// Prints the features of the pack that was written, or that was there, if they are wanted.
fn explained(args: &BuildArgs, output: &Path, reporter: &Reporter) -> u8 {
    if !args.explain_features {
        return OK;
    }
    match Pack::open(output, MapMode::Map) {
        Ok(pack) => inspect::report(&pack, reporter),
        Err(error) => {
            reporter.failure(&format!("{}: {error}", output.display()));
            IO
        }
    }
}

/// Nothing changed since the pack was made.
fn up_to_date(
    args: &BuildArgs,
    record: &Record,
    output: &Path,
    reuse: &Reuse,
    reporter: &Reporter,
) -> u8 {
    for file in &record.files {
        reuse.read(file);
    }
    if let Some(path) = &args.depfile {
        if let Err(code) = write_depfile(path, output, reuse, reporter) {
            return code;
        }
        // Build tools go by times: a file that was touched would have them ask again and again.
        let file = std::fs::File::options().append(true).open(output);
        let _ = file.and_then(|file| file.set_modified(SystemTime::now()));
    }
    let path = output;
    let (n, output) = (record.files.len(), path.display());
    let plural = if n == 1 { "" } else { "s" };
    reporter.status(&format!("{output} is up to date: nothing changed in {n} file{plural}"));
    explained(args, path, reporter)
}

fn write_text(path: &Path, text: &str, reporter: &Reporter) -> Result<(), u8> {
    pack::write_atomic(path, |file| file.write_all(text.as_bytes())).map_err(|error| {
        reporter.failure(&error.to_string());
        IO
    })
}

fn write_depfile(path: &Path, output: &Path, reuse: &Reuse, reporter: &Reporter) -> Result<(), u8> {
    let reads = reuse.reads();
    let text = depfile(output, reads.keys().map(PathBuf::as_path)).map_err(|error| {
        reporter.failure(&error.to_string());
        IO
    })?;
    write_text(path, &text, reporter)
}

pub(super) fn check(args: &CheckArgs) -> u8 {
    let reporter = args.report.reporter();
    let cache = Cache::from_env();
    let job = Job {
        scene: &args.scene.scene,
        output: Path::new(""),
        defines: &args.scene.define,
        trees: Trees::usual(&cache),
    };
    match compile(&args.scene, &job, None, &Reuse::once(), &reporter) {
        Ok(_) => OK,
        Err(code) => code,
    }
}

/// Reads and checks the text; an unreadable file is reported and becomes an exit code.
pub(super) fn analyze(scene: &SceneArgs, reporter: &Reporter) -> Result<Analysis, u8> {
    analyze_reading(scene, &Reuse::once(), reporter)
}

/// As `analyze`; `reuse` is told which files are read.
fn analyze_reading(scene: &SceneArgs, reuse: &Reuse, reporter: &Reporter) -> Result<Analysis, u8> {
    reuse.read(&scene.scene);
    let shown = scene.scene.display().to_string();
    let text = read_text(&scene.scene).map_err(|error| {
        reporter.failure(&format!("cannot read {shown}: {error}"));
        if scene.scene.extension().is_some_and(|e| e == "pack") {
            reporter.status("help: this is a pack already; render it with `rtr`");
        }
        match error {
            TextError::Io(_) => IO,
            TextError::NotText(_) => SCENE,
        }
    })?;
    let options = lang::Options { defines: scene.define.clone() };
    Ok(lang::analyze(&shown, &text, &mut DiskLoader { reuse: Some(reuse) }, &options))
}

/// A scene that became everything that its pack holds.
struct Compilation {
    compiled: Compiled,
    phases: Vec<Phase>,
    /// Texts of the scene.
    texts: Vec<PathBuf>,
    /// There was nothing to say of it.
    silent: bool,
    /// What there was to say will be said again when only texts have changed.
    whole: bool,
}

/// Compiles the scene of a job; `edited`: what is there of the last time.
fn compile(
    args: &SceneArgs,
    job: &Job<'_>,
    edited: Option<&Edited>,
    reuse: &Reuse,
    reporter: &Reporter,
) -> Result<Compilation, u8> {
    let start = Instant::now();
    let Analysis { sources, scene, mut diagnostics, .. } = analyze_reading(args, reuse, reporter)?;
    let Some(scene) = scene else {
        reporter.diagnostics(&sources, &diagnostics);
        return Err(SCENE);
    };
    let n_of_text = diagnostics.len();
    let mut phases = vec![Phase { name: "read and check the text", time: start.elapsed() }];
    let options = Options {
        root: args.scene.parent().unwrap_or(Path::new("")),
        trees: job.trees,
        limits: Limits::default(),
        defines: &args.define,
    };
    let mut again = || -> Result<Option<Compiled>, CompileError> {
        let Some(edited) = edited else { return Ok(None) };
        let fits = |memory: &Memory| memory.fits(&scene, &sources);
        let Some((pack, memory)) = job.earlier(job.trees.cache, edited, fits) else {
            return Ok(None);
        };
        let known = (&Arc::new(pack), memory);
        pipeline::compile_again(&scene, &sources, &options, known, reuse, &mut diagnostics)
    };
    let taken_over = again();
    let result = match taken_over {
        Ok(Some(compiled)) => {
            edited.iter().flat_map(|edited| edited.data()).for_each(|path| reuse.read(path));
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
        CompileError::Lower(_)
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

fn default_output(scene: &Path) -> PathBuf {
    PathBuf::from(scene.file_stem().unwrap_or(scene.as_os_str())).with_extension("pack")
}

fn done(output: &Path, compiled: &Compiled, time: Duration) -> String {
    let counters = &compiled.lowered.counters;
    let size = std::fs::metadata(output).map_or(0, |meta| meta.len());
    let mut things = Vec::new();
    for (count, what) in [
        (counters.triangles, "triangles"),
        (counters.spheres, "spheres"),
        (counters.lights, "lights"),
        (compiled.lowered.textures.len() as u64, "textures"),
    ] {
        if count > 0 {
            things.push(format!("{} {what}", grouped(count)));
        }
    }
    if counters.instances > 0 {
        things.push(instances_text(counters));
    }
    let trees = &compiled.lowered.trees;
    things.extend((trees.groups > 0).then(|| trees_text(compiled)));
    format!(
        "{}: {:.1} MB, {} in {:.2} s",
        output.display(),
        size as f64 / 1e6,
        if things.is_empty() { "nothing but sky".to_owned() } else { things.join(", ") },
        time.as_secs_f64(),
    )
}

/// What to say of a kernel with more storage buffers than every device has. It is no warning: it comes from the
/// size of the scene, and nothing in the text is to be changed.
fn portability(features: &FeatureSet) -> Option<String> {
    let needed = features.storage_buffers().ok().filter(|needed| *needed > PORTABLE_STORAGE)?;
    Some(format!(
        "note: the kernel needs {needed} storage buffers of 128 MiB at most, and not every GPU has more than \
         {PORTABLE_STORAGE} for it; `rtr` renders on the CPU where there are too few"
    ))
}

/// What is stored once, and how often it is shown.
fn instances_text(counters: &Counters) -> String {
    let (meshes, instances) = (grouped(counters.meshes), grouped(counters.instances));
    format!(
        "{} triangles shown ({instances} instances of {meshes} meshes)",
        grouped(counters.shown)
    )
}

/// Which builder made the trees, what it made of the triangles, and what it had not to do again.
fn trees_text(compiled: &Compiled) -> String {
    let trees = &compiled.lowered.trees;
    let mut text = format!("bvh {}", trees.preset);
    if trees.loaded > 0 {
        let _ = write!(text, " {}/{} cached", trees.loaded, trees.groups);
    }
    let triangles = compiled.lowered.counters.triangles;
    if trees.references as u64 > triangles {
        let _ =
            write!(text, " ({:.2} leaves a triangle)", trees.references as f64 / triangles as f64);
    }
    text
}

fn timings(phases: &[Phase], compiled: &Compiled) -> String {
    let mut text = String::from("phase                               ms  reused\n");
    for Phase { name, time } in phases {
        let line = format!(
            "{name:<30} {:>7.1}  {}",
            time.as_secs_f64() * 1e3,
            phase_reuse(name, &compiled.reused)
        );
        let _ = writeln!(text, "{}", line.trim_end());
    }
    let trees = &compiled.lowered.trees;
    let ms = |time: Duration| time.as_secs_f64() * 1e3;
    let counters = &compiled.lowered.counters;
    if counters.instances > 0 {
        let _ = writeln!(
            text,
            "{}, {} triangles stored",
            instances_text(counters),
            grouped(counters.triangles)
        );
    }
    text + &format!(
        "bvh {}: {} of {} trees cached, {:.1} ms of building saved; {} stored, {:.1} ms spent building",
        trees.preset,
        trees.loaded,
        trees.groups,
        ms(trees.saved),
        trees.stored,
        ms(trees.build_time),
    )
}

/// What a phase took over, for the table.
fn phase_reuse(name: &str, reused: &Reused) -> String {
    let Reused { texts, meshes, images, geometry: _, trees, kernel } = reused;
    let share = |share: &Share, what: &str| format!("{} of {} {what}", share.reused, share.all);
    match name {
        "read and check the text" => format!("0 of {texts} texts"),
        "read files" => format!("{}, {}", share(meshes, "meshes"), share(images, "images")),
        "build or fetch trees" => share(trees, "trees"),
        "link and prove the kernel" => share(kernel, "proofs"),
        _ => String::new(),
    }
}

/// One line about everything that was taken over, if anything was.
fn reused_text(reused: &Reused) -> Option<String> {
    let Reused { texts: _, meshes, images, geometry, trees, kernel } = reused;
    if *geometry {
        let proof = if kernel.reused > 0 { ", the proof of the kernel" } else { "" };
        return Some(format!("reused the geometry and the textures of the last pack{proof}"));
    }
    let shares = [(meshes, "meshes"), (images, "images"), (trees, "trees")];
    let some = shares.into_iter().filter(|(share, _)| share.reused > 0);
    let mut parts: Vec<String> =
        some.map(|(share, what)| format!("{} of {} {what}", share.reused, share.all)).collect();
    parts.extend((kernel.reused > 0).then(|| "the proof of the kernel".to_owned()));
    (!parts.is_empty()).then(|| format!("reused {}", parts.join(", ")))
}

/// 1234567 as 1,234,567.
fn grouped(n: u64) -> String {
    let digits = n.to_string();
    let mut out = String::new();
    for (i, digit) in digits.chars().enumerate() {
        if i > 0 && (digits.len() - i).is_multiple_of(3) {
            out.push(',');
        }
        out.push(digit);
    }
    out
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn thousands_are_grouped() {
        assert_eq!(grouped(0), "0");
        assert_eq!(grouped(999), "999");
        assert_eq!(grouped(1_234_567), "1,234,567");
    }

    #[test]
    fn only_what_was_reused_is_told() {
        assert_eq!(reused_text(&Reused::default()), None);
        let share = |reused, all| Share { reused, all };
        let reused = Reused { trees: share(14, 16), images: share(0, 3), ..Reused::default() };
        assert_eq!(reused_text(&reused).as_deref(), Some("reused 14 of 16 trees"));
        let reused = Reused { meshes: share(1, 2), kernel: share(1, 1), ..reused };
        let expected = "reused 1 of 2 meshes, 14 of 16 trees, the proof of the kernel";
        assert_eq!(reused_text(&reused).as_deref(), Some(expected));
    }

    #[test]
    fn only_a_kernel_for_few_gpus_is_told_of() {
        let mut features = FeatureSet::full();
        assert_eq!(features.storage_buffers().ok(), Some(PORTABLE_STORAGE));
        assert_eq!(portability(&features), None);
        features.windows.tri = 3;
        let line = portability(&features).expect("nine are more than seven");
        assert!(line.contains("needs 9 storage buffers"), "{line}");
    }

    #[test]
    fn the_pack_is_named_after_the_scene() {
        assert_eq!(default_output(Path::new("a/b.rts")), Path::new("b.pack"));
    }
}

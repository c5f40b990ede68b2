//! `rtc build`: a scene text becomes a pack, or a list of what is wrong with it.

use files::ShowPath as _;
use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::time::{Duration, Instant, SystemTime};

use clap::Args;

use super::args::{IO, OK, ReportArgs, SceneArgs};
use super::compile::{Compilation, compile};
use super::last::{Job, Last};
use super::outputs::Outputs;
use super::summary::{done, portability, reused_text, timings};
use super::watch::watch;
use super::{inspect, mapped};
use crate::bvh::{Layout, Preset};
use crate::cache::Cache;
use crate::depfile::depfile;
use crate::lower::{Instancing, Trees, Visibility, srgb_table};
use crate::pipeline::{Compiled, Phase, Session};
use crate::reads::Reads;
use crate::report::Reporter;
use crate::stage::{Results, Stages};

#[derive(Debug, Args)]
#[expect(clippy::struct_excessive_bools, reason = "each is a switch on the command line")]
pub(super) struct BuildArgs {
    #[command(flatten)]
    scene: SceneArgs,
    /// Output pack; `-` is standard output [default: the scene's name with `.pack`, in the working folder].
    #[arg(short, long, value_name = "PACK")]
    output: Option<PathBuf>,
    /// Also write the linked kernel as WGSL.
    #[arg(long, value_name = "FILE")]
    emit_wgsl: Option<PathBuf>,
    /// Recompile whenever a file of the scene changes, until Ctrl-C.
    #[arg(long)]
    watch: bool,
    /// Also write the dependencies of the pack as a rule for make or ninja.
    #[arg(long, value_name = "FILE")]
    depfile: Option<PathBuf>,
    /// Print what each phase cost, what was reused, and what the cache saved.
    #[arg(long)]
    timings: bool,
    /// BVH builder: `fast` builds fastest; `default` uses spatial splits; `extreme` tries harder. For
    /// comparison only: `object-median`, `spatial-median`. Pictures are the same with each.
    #[arg(long, default_value_t, value_name = "BUILDER")]
    bvh: Preset,
    /// Instancing: `auto` stores a mesh once where that pays; `never` stores every copy, for comparison. The
    /// picture is the same.
    #[arg(long, default_value_t, value_name = "WHEN")]
    instances: Instancing,
    /// Learned visibility: `auto` traces rays to find lights that nothing in view receives, and samples them less
    /// often; `never` leaves that out. The picture converges to the same.
    #[arg(long, default_value_t, value_name = "WHEN")]
    visibility: Visibility,
    /// BVH node layout: `wide` has up to four children with 8-bit quantised boxes; `binary` is larger, for
    /// comparison. The picture is the same.
    #[arg(long, default_value_t, value_name = "LAYOUT")]
    nodes: Layout,
    /// Print the sections of the pack and every kernel feature: the declaration that needs it, or why it was
    /// left out. `rtc inspect` prints the same for any pack.
    #[arg(long)]
    explain_features: bool,
    /// Compile everything; neither read nor write caches.
    #[arg(long)]
    no_cache: bool,
    /// Threads to use [default: all].
    #[arg(long, value_name = "N", value_parser = parse_threads)]
    pub(super) threads: Option<usize>,
    #[command(flatten)]
    report: ReportArgs,
}

fn parse_threads(text: &str) -> Result<usize, String> {
    match text.parse() {
        Ok(n @ 1..=4096) => Ok(n),
        _ => Err("a number from 1 to 4096".to_owned()),
    }
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
        watch(reporter, |session| build_here(args, reporter, session) == OK)
    } else {
        build_here(args, reporter, &Session::once())
    }
}

impl BuildArgs {
    fn trees<'a>(&self, cache: &'a Cache) -> Trees<'a> {
        let &Self { bvh: preset, nodes: layout, instances: instancing, visibility, .. } = self;
        Trees { preset, layout, instancing, visibility, cache }
    }
}

fn build_here(args: &BuildArgs, reporter: &Reporter, session: &Session) -> u8 {
    let start = Instant::now();
    let cache = if args.no_cache { Cache::disabled() } else { Cache::from_env() };
    let output = args.output.clone().unwrap_or_else(|| default_output(&args.scene.scene));
    let outputs = match outputs(args, &output, reporter) {
        Ok(outputs) => outputs,
        Err(code) => return code,
    };
    let limits = match args.scene.limits(reporter) {
        Ok(limits) => limits,
        Err(code) => return code,
    };
    let trees = args.trees(&cache);
    let job = Job {
        scene: &args.scene.scene,
        root: &limits.root,
        output: &output,
        defines: &args.scene.define,
        trees,
    };
    let reads = &session.reads;
    let last = job.last();
    let pack = last.as_ref().and_then(|last| last.pack(&output));
    // Who asks for the kernel or the times wants to see a compilation.
    let unchanged = last.as_ref().filter(|last| {
        args.emit_wgsl.is_none() && !args.timings && pack.is_some() && last.is_of(&job, reads)
    });
    if let Some(last) = unchanged.filter(|last| last.silent) {
        let spared = outputs.spare(last.files(), reporter);
        return spared.err().unwrap_or_else(|| up_to_date(args, last, &output, reads, reporter));
    }
    let stages = match &last {
        Some(last) => last.stages(pack.clone(), &cache),
        None => without_cache(session),
    };
    let done = compile(&args.scene, &limits, trees, (session, &stages), reporter);
    let Compilation { compiled, mut phases, silent } = match done {
        Ok(done) => done,
        Err(code) => return code,
    };
    if let Err(code) = outputs.spare(reads.all().keys(), reporter) {
        return code;
    }
    // What there was to warn of has been said again.
    if let Some(last) = unchanged.filter(|last| last.has_recipe(compiled.recipe_id)) {
        return up_to_date(args, last, &output, reads, reporter);
    }
    if let Some(path) = &args.emit_wgsl
        && let Err(code) = write_text(path, &compiled.kernel.text, reporter)
    {
        return code;
    }
    let writing = Instant::now();
    let srgb = srgb_table();
    let written = compiled.writer(&srgb).and_then(|writer| writer.write(&output));
    let Ok(render_id) = written.map_err(|error| reporter.failure(&error.to_string())) else {
        return IO;
    };
    if let Some(path) = &args.depfile
        && let Err(code) = write_depfile(path, &output, reads, reporter)
    {
        return code;
    }
    phases.push(Phase { name: "write the pack", time: writing.elapsed() });
    tell(args, &output, &compiled, (&phases, start.elapsed()), reporter);
    let silent = silent && compiled.lowered.trees.warnings.is_empty();
    job.keep((reads, &stages), [render_id, compiled.recipe_id], silent, last.as_ref());
    if cache.root().is_none() {
        session.kept.put(RESULTS.into(), &Arc::new(stages.results().0));
    }
    explained(args, &output, reporter)
}

/// Name of the small results of the last compilation of a `--watch` without a cache.
const RESULTS: [u8; 32] = [0; 32];

fn without_cache(session: &Session) -> Stages {
    let results = session.kept.get::<Results>(RESULTS.into());
    results.map_or_else(Stages::new, |results| Stages::after(Results::clone(&results), None))
}

/// What is going to be written, proven to be writable.
fn outputs(args: &BuildArgs, pack: &Path, reporter: &Reporter) -> Result<Outputs, u8> {
    let optional =
        [(&args.emit_wgsl, "the kernel of --emit-wgsl"), (&args.depfile, "the rule of --depfile")];
    let optional = optional.iter().filter_map(|(path, what)| Some((path.as_deref()?, *what)));
    let list: Vec<_> = [(pack, "the pack")].into_iter().chain(optional).collect();
    Outputs::new(&args.scene.scene, &list, reporter)
}

/// Says what came of it, and what it took: phase by phase, and in all.
fn tell(
    args: &BuildArgs,
    output: &Path,
    compiled: &Compiled,
    (phases, time): (&[Phase], Duration),
    reporter: &Reporter,
) {
    for warning in &compiled.lowered.trees.warnings {
        reporter.warning(&warning.to_string());
    }
    if args.timings {
        reporter.status(&timings(phases, compiled));
    }
    reporter.status(&done(output, compiled, time));
    let more = [reused_text(&compiled.reused), portability(&compiled.features)];
    more.iter().flatten().for_each(|line| reporter.status(line));
}

/// Prints the features of the pack that was written, or that was there, if they are wanted.
fn explained(args: &BuildArgs, output: &Path, reporter: &Reporter) -> u8 {
    if !args.explain_features {
        return OK;
    }
    match mapped::map(output) {
        Ok(pack) => inspect::report(&pack, reporter),
        Err(error) => {
            reporter.failure(&format!("{}: {error}", output.shown()));
            IO
        }
    }
}

/// Nothing changed since the pack was made.
fn up_to_date(
    args: &BuildArgs,
    last: &Last,
    output: &Path,
    reads: &Reads,
    reporter: &Reporter,
) -> u8 {
    last.files().for_each(|file| reads.read(file));
    if let Some(path) = &args.depfile {
        if let Err(code) = write_depfile(path, output, reads, reporter) {
            return code;
        }
        // Build tools go by times: a file that was touched would have them ask again and again.
        let file = std::fs::File::options().append(true).open(output);
        let _ = file.and_then(|file| file.set_modified(SystemTime::now()));
    }
    let path = output;
    let (n, output) = (last.files().len(), path.shown());
    let plural = if n == 1 { "" } else { "s" };
    reporter.status(&format!("{output} is up to date: nothing changed in {n} file{plural}"));
    explained(args, path, reporter)
}

fn write_text(path: &Path, text: &str, reporter: &Reporter) -> Result<(), u8> {
    files::write(path, |file| file.write_all(text.as_bytes())).map_err(|error| {
        reporter.failure(&error.to_string());
        IO
    })
}

fn write_depfile(path: &Path, output: &Path, reads: &Reads, reporter: &Reporter) -> Result<(), u8> {
    let reads = reads.all();
    let text = depfile(output, reads.keys().map(PathBuf::as_path)).map_err(|error| {
        reporter.failure(&error.to_string());
        IO
    })?;
    write_text(path, &text, reporter)
}

fn default_output(scene: &Path) -> PathBuf {
    PathBuf::from(scene.file_stem().unwrap_or(scene.as_os_str())).with_extension("pack")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_pack_is_named_after_the_scene() {
        assert_eq!(default_output(Path::new("a/b.rts")), Path::new("b.pack"));
    }
}

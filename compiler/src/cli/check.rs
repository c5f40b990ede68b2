//! `rtc check`: a scene text becomes a list of what is wrong with it, for people or as one JSON object.

use clap::Args;
use files::ShowPath as _;
use serde_json::{Value, json};

use super::args::{BUG, IO, OK, ReportArgs, SCENE, SceneArgs};
use super::compile::{Judged, compile, judge};
use crate::cache::Cache;
use crate::lower::Trees;
use crate::pipeline::{Compiled, Session};
use crate::report::Reporter;
use crate::stage::Stages;

#[derive(Debug, Args)]
pub(super) struct CheckArgs {
    #[command(flatten)]
    scene: SceneArgs,
    /// Print one JSON object on standard output: all diagnostics, and what the pack would hold (docs/json.md).
    #[arg(long, conflicts_with = "error_format")]
    json: bool,
    #[command(flatten)]
    report: ReportArgs,
}

pub(super) fn check(args: &CheckArgs) -> u8 {
    let reporter = if args.json { ReportArgs::json() } else { args.report.clone() }.reporter();
    let cache = Cache::from_env();
    let (session, stages) = (Session::once(), Stages::new());
    let (of, trees) = ((&session, &stages), Trees::usual(&cache));
    let limits = match args.scene.limits(&reporter) {
        Ok(limits) => limits,
        Err(code) => return code,
    };
    if !args.json {
        let compiled = compile(&args.scene, &limits, trees, of, &reporter);
        return compiled.err().unwrap_or(OK);
    }
    match judge(&args.scene, &limits, trees, of, (&reporter, &|_, _| ())) {
        // What is no fault of the scene has been said on standard error.
        Ok(Judged { result: Err(code @ (IO | BUG)), .. }) | Err(code) => code,
        Ok(judged) => {
            let code = judged.result.as_ref().map_or(SCENE, |_| OK);
            if reporter.document(&document(args, &judged)) { code } else { IO }
        }
    }
}

fn document(args: &CheckArgs, judged: &Judged) -> Value {
    let Judged { sources, diagnostics, result } = judged;
    let errors = diagnostics.iter().filter(|diagnostic| diagnostic.is_error()).count();
    json!({
        "schema": "rtc.check/1",
        "scene": args.scene.scene.shown().to_string(),
        "ok": result.is_ok(),
        "errors": errors,
        "warnings": diagnostics.len() - errors,
        "diagnostics": Reporter::list(sources, diagnostics),
        "holds": result.as_ref().ok().map(|(compiled, _)| holds(compiled)),
    })
}

/// What the pack would hold.
fn holds(compiled: &Compiled) -> Value {
    let lowered = &compiled.lowered;
    let (render, counters) = (&lowered.render, &lowered.counters);
    json!({
        "image": render.image_size,
        "samples": render.samples,
        "depth": render.depth(),
        "triangles": counters.triangles,
        "triangles_shown": counters.shown,
        "spheres": counters.spheres,
        "instances": counters.instances,
        "meshes": counters.meshes,
        "lights": counters.lights,
        "materials": lowered.materials.len(),
        "textures": lowered.textures.len(),
        "features": features(compiled),
    })
}

fn features(compiled: &Compiled) -> Vec<&str> {
    compiled.manifest.features_kept.iter().map(|feature| feature.name.as_str()).collect()
}

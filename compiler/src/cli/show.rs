//! `rtc show`: a scene as the compiler understands it.

use clap::Args;

use super::args::{ReportArgs, SCENE, SceneArgs, printed};
use super::assets::assets;
use super::bounds::bounds;
use super::compile::analyze;

#[derive(Debug, Args)]
pub(super) struct ShowArgs {
    #[command(flatten)]
    scene: SceneArgs,
    /// Print every value with its unit, defaults included, expressions evaluated.
    #[arg(long)]
    resolved: bool,
    /// Print where everything is: bounds, triangles and parts of every asset and instance.
    #[arg(long, conflicts_with = "resolved")]
    bounds: bool,
    /// Print what is in the mesh files: parts, materials, sizes, and their lights and cameras as text for the scene.
    #[arg(long, conflicts_with_all = ["resolved", "bounds"])]
    assets: bool,
    #[command(flatten)]
    report: ReportArgs,
}

pub(super) fn show(args: &ShowArgs) -> u8 {
    let reporter = args.report.reporter();
    let analysis = match analyze(&args.scene, &reporter) {
        Ok(analysis) => analysis,
        Err(code) => return code,
    };
    reporter.diagnostics(&analysis.sources, &analysis.diagnostics);
    let Some(scene) = &analysis.scene else { return SCENE };
    if args.bounds {
        let text = bounds(&args.scene, (&analysis, scene), &reporter);
        return text.map_or_else(|code| code, |text| printed(&reporter, &text));
    }
    if args.assets {
        let text = assets(&args.scene, (&analysis, scene), &reporter);
        return text.map_or_else(|code| code, |text| printed(&reporter, &text));
    }
    let text = if args.resolved { lang::resolved(scene) } else { summary(scene) };
    printed(&reporter, &text)
}

/// How many of each kind, and what will be rendered.
fn summary(scene: &lang::scene::Scene) -> String {
    let [width, height] = scene.film.size;
    let output = scene.render.output.as_deref().unwrap_or("named after the pack");
    format!(
        "instances  {}\nmaterials  {}\ntextures   {}\nassets     {}\nlights     {}\nsky        {}\ncamera     {}\nfilm       {width} x {height} px\nsamples    {}\ndepth      {}\noutput     {output}\n\n`rtc show --resolved` prints every value, `rtc show --bounds` where everything is, `rtc show --assets` what is in its mesh files.\n",
        scene.instances.len(),
        scene.materials.len(),
        scene.textures.len(),
        scene.assets.len(),
        scene.lights.len() + scene.directional.len(),
        scene.sky.as_ref().map_or("none", |sky| sky.name.text.as_str()),
        scene.camera.name.text,
        scene.render.samples,
        scene.render.max_depth.map_or_else(|| "unlimited".to_owned(), |depth| depth.to_string()),
    )
}

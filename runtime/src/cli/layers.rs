//! `--layers`: arguments → what the picture holds beside radiance, or why it cannot.

use super::console::Console;
use super::exit::Exit;
use crate::job::Job;
use crate::layers::{Layer, LayerNames, Wanted};
use crate::output::Format;
use crate::scene::Scene;
use std::collections::BTreeSet;

#[derive(Clone, Debug, clap::Args)]
#[command(next_help_heading = "Layers (made on the CPU after the picture; docs/guide.md)")]
pub(super) struct LayerArgs {
    /// Layers of the EXR beside the picture, separated by commas [default: those of the scene, if there is an EXR].
    #[arg(long, value_name = "LAYER,...", value_delimiter = ',', value_enum)]
    layers: Vec<Layer>,
    /// How layers are named: ViewLayer.Depth.Z or Z.
    #[arg(long, value_name = "STYLE", default_value = "blender", value_enum)]
    layer_names: LayerNames,
    /// Leave the sky out where the camera sees it, and write alpha, to PNG too.
    #[arg(long, conflicts_with = "adaptive")]
    transparent: bool,
}

impl LayerArgs {
    /// What is asked for. What the scene asks for is left out where it cannot be had.
    pub(super) fn wanted(&self, scene: &Scene, job: &Job, formats: &[Format]) -> Wanted {
        let mut layers: BTreeSet<Layer> = self.layers.iter().copied().collect();
        if layers.is_empty() {
            let manifest = scene.pack().manifest().unwrap_or_default();
            let can_be = |layer: &Layer| match layer {
                Layer::Variance => job.measure.is_some() && formats.contains(&Format::Exr),
                Layer::Alpha => true,
                _ => formats.contains(&Format::Exr),
            };
            let known = manifest.layers.iter().filter_map(|name| Layer::of_name(name));
            layers.extend(known.filter(can_be));
        }
        if self.transparent {
            layers.insert(Layer::Alpha);
        }
        Wanted { layers, transparent: self.transparent, names: self.layer_names }
    }
}

/// Whether the layers that are wanted can be made, and written in one of these formats.
pub(super) fn check(
    console: &Console,
    scene: &Scene,
    job: &Job,
    formats: &[Format],
) -> Result<(), Exit> {
    let wanted = &job.wanted;
    let has = |layer| wanted.layers.contains(&layer);
    if has(Layer::Variance) && job.measure.is_none() {
        console.warn(
            "error: the layer `variance` is there only where the error is measured: add --report, --plot, \
             --until-error or --reference",
        );
        return Err(Exit::Usage);
    }
    let of_exr = wanted.layers.iter().find(|layer| **layer != Layer::Alpha);
    if let Some(layer) = of_exr.filter(|_| !formats.contains(&Format::Exr)) {
        let name = layer.name();
        console.warn(&format!(
            "error: a PNG has no layer `{name}`: write an EXR as well, with -o NAME.exr"
        ));
        return Err(Exit::Usage);
    }
    if has(Layer::Alpha) && !wanted.transparent && scene.pack().sky().is_some() {
        console.note("the sky is part of the picture, so alpha is 1; --transparent leaves it out");
    }
    Ok(())
}

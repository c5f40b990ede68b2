//! Arguments of `rtr` about layers → what the picture holds beside radiance.

use super::denoise_args::DenoiseArgs;
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
    /// What is asked for, and what the denoiser needs. What the scene asks for is left out where it cannot be had.
    pub(super) fn wanted(
        &self,
        scene: &Scene,
        job: &Job,
        formats: &[Format],
        denoise: &DenoiseArgs,
    ) -> Wanted {
        let mut layers: BTreeSet<Layer> = self.layers.iter().copied().collect();
        if layers.is_empty() {
            let manifest = scene.pack().manifest().unwrap_or_default();
            let adaptive = job.measure.as_ref().is_some_and(|measure| measure.adaptive);
            let can_be = |layer: &Layer| match layer {
                Layer::Lights if adaptive => false,
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
        denoise.want(&mut layers);
        Wanted { layers, transparent: self.transparent, names: self.layer_names }
    }
}

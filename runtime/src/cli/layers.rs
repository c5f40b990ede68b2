//! Whether what `--layers` asks for can be had, or why not.

use super::console::Console;
use super::denoise_args::DenoiseArgs;
use super::exit::Exit;
use crate::job::Job;
use crate::layers::Layer;
use crate::output::Format;
use crate::scene::Scene;

/// Whether the layers that are wanted can be made, and written in one of these formats.
pub(super) fn check(
    console: &Console,
    scene: &Scene,
    job: &Job,
    formats: &[Format],
    denoise: &DenoiseArgs,
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
    let adaptive = job.measure.as_ref().is_some_and(|measure| measure.adaptive);
    if has(Layer::Lights) && adaptive {
        console.warn(
            "error: the layer `lights` needs the same samples in every pixel: leave out --adaptive, or `lights`",
        );
        return Err(Exit::Usage);
    }
    let is_of_exr = |layer: &&Layer| **layer != Layer::Alpha && !denoise.needs(**layer);
    let of_exr = wanted.layers.iter().find(is_of_exr);
    if let Some(layer) = of_exr.filter(|_| !formats.contains(&Format::Exr)) {
        let name = layer.name();
        console.warn(&format!(
            "error: a PNG has no layer `{name}`: write an EXR as well, with -o NAME.exr"
        ));
        return Err(Exit::Usage);
    }
    let manifest = || scene.pack().manifest().unwrap_or_default();
    if has(Layer::Lights) && manifest().groups.is_empty() {
        console.note(
            "the scene names no light groups: write group = \"key\" in a light, an instance or a sky",
        );
    }
    if has(Layer::Alpha) && !wanted.transparent && scene.pack().sky().is_some() {
        console.note("the sky is part of the picture, so alpha is 1; --transparent leaves it out");
    }
    Ok(())
}

//! `--denoise`: arguments → a denoiser, before anything is rendered; and a picture → the same without noise.

use super::console::{Console, is_interrupted};
use super::denoise_args::DenoiseArgs;
use super::exit::Exit;
use super::progress::duration_text;
use crate::denoise::{Denoiser, is_guide};
use crate::output::{Format, Picture};
use std::time::Instant;

/// The denoiser, if one is asked for. Says where the noisy picture does not stay.
pub(super) fn open(
    args: &DenoiseArgs,
    console: &Console,
    formats: &[Format],
    threads: Option<usize>,
) -> Result<Option<Denoiser>, Exit> {
    if !args.denoise {
        return Ok(None);
    }
    let denoiser = Denoiser::open(args.oidn.as_deref(), threads);
    let denoiser = denoiser.map_err(|error| console.fail(&error, Exit::World))?;
    if !formats.contains(&Format::Exr) {
        console.note("a PNG holds the denoised picture only: -o NAME.exr keeps the noisy one too");
    }
    Ok(Some(denoiser))
}

/// Denoises the picture; after an error, which is told, it is what it was.
pub(super) fn denoise(
    console: &Console,
    denoiser: &Denoiser,
    picture: &mut Picture,
) -> Result<(), Exit> {
    let began = Instant::now();
    if let Err(error) = denoiser.denoise(picture, &is_interrupted) {
        let exit = if error.is_cancelled() {
            console.note("interrupted: the picture is not denoised");
            Exit::Interrupted
        } else {
            console.fail(&error, Exit::World)
        };
        console.note("the picture is written as it is, noisy");
        return Err(exit);
    }
    let guides = match &picture.layers {
        Some(layers) if is_guide(layers) => "with albedo and normals",
        _ => "without albedo and normals, which would keep edges and textures",
    };
    let (name, time) = (denoiser.name(), duration_text(began.elapsed()));
    console.note(&format!("denoised by {name} in {time}, {guides}"));
    Ok(())
}

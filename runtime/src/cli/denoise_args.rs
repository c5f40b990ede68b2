//! Arguments of `rtr` about denoising → what that needs of the layers.

use crate::layers::Layer;
use std::collections::BTreeSet;
use std::path::PathBuf;

#[derive(Clone, Debug, clap::Args)]
#[command(next_help_heading = "Denoising (docs/denoise.md)")]
pub(super) struct DenoiseArgs {
    /// Denoise the last picture with Open Image Denoise 2, which is loaded at run time. An EXR keeps the noisy picture
    /// as a layer beside it, with the layers albedo and normal.
    #[arg(long)]
    pub(super) denoise: bool,
    /// Library of Open Image Denoise, or its folder [default: `OIDN_DIR`, the library path of the system, the wheel
    /// pyoidn beside python3].
    #[arg(long, value_name = "PATH", requires = "denoise")]
    pub(super) oidn: Option<PathBuf>,
}

impl DenoiseArgs {
    /// Adds the layers that guide a denoiser.
    pub(super) fn want(&self, layers: &mut BTreeSet<Layer>) {
        if self.denoise {
            layers.extend([Layer::Albedo, Layer::Normal]);
        }
    }

    /// Whether `layer` is there for the denoiser, whatever can be written.
    pub(super) fn needs(&self, layer: Layer) -> bool {
        self.denoise && matches!(layer, Layer::Albedo | Layer::Normal)
    }
}

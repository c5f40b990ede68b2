//! The command line of `rtr merge`.

use super::denoise_args::DenoiseArgs;
use super::values::{parse_rect, parse_samples};
use crate::output::Format;
use crate::region::{Rect, SampleRange};
use std::path::PathBuf;

pub(super) const MERGE_EXAMPLES: &str = "\
Examples:
  rtr merge a.exr b.exr -o c.exr -o c.png                 whatever they make together
  rtr merge parts/*.exr --samples 0..256 -o c.exr         says which samples are missing
  rtr merge parts/*.exr --samples 0..256 --crop 0,0,7680,4320 -o c.exr
                                                          and which pixels

The pixels are those of one run. Parts are read some rows at a time, so memory depends on the width
of the picture; only a PNG, and a picture for --denoise, are in memory as a whole.";

#[derive(Debug, clap::Args)]
pub(super) struct MergeArgs {
    /// EXR files of the same pack, size and seed, with other samples or other crops.
    #[arg(required = true, value_name = "PART.exr")]
    pub(super) parts: Vec<PathBuf>,
    /// Output file, .exr or .png; may be given several times; `-` is standard output.
    #[arg(short, long, required = true, value_name = "FILE")]
    pub(super) output: Vec<PathBuf>,
    /// Format of outputs without a known extension; png16 also makes every PNG one of 16 bits [default: png for
    /// standard output, pipes and devices].
    #[arg(long, value_enum, value_name = "FORMAT")]
    pub(super) format: Option<Format>,
    /// What the parts must add up to; missing samples are an error, with the command that renders them [default: all
    /// samples of any part].
    #[arg(long, value_name = "A..B", value_parser = parse_samples)]
    pub(super) samples: Option<SampleRange>,
    /// The pixels that the parts must cover; missing ones are an error, with the command that renders them [default:
    /// the rectangle around all parts].
    #[arg(long, value_name = "X,Y,W,H", value_parser = parse_rect)]
    pub(super) crop: Option<Rect>,
    /// Print errors only.
    #[arg(long)]
    pub(super) quiet: bool,
    #[command(flatten)]
    pub(super) denoise: DenoiseArgs,
}

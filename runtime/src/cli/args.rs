//! Arguments as clap reads them.

use super::denoise_args::DenoiseArgs;
use super::job_args::{JOB_EXAMPLES, JobArgs};
use super::layer_args::LayerArgs;
use super::merge_args::{MERGE_EXAMPLES, MergeArgs};
use super::values::{
    Every, parse_clamp, parse_duration, parse_every, parse_pixel, parse_rect, parse_samples,
    parse_size, parse_threads,
};
use crate::convergence::Goal;
use crate::output::Format;
use crate::region::{Rect, SampleRange};
use clap::{Parser, Subcommand, ValueEnum};
use std::path::PathBuf;
use std::time::Duration;

const EXAMPLES: &str = "\
Examples:
  rtr scene.pack                          render as the scene says, to scene.exr and scene.png
  rtr scene.pack --spp 16 --size 320x180  a quick preview
  rtr scene.pack --time 60s -o a.png      render for one minute
  rtr scene.pack --samples 0..32 -o a.exr one half of the samples here ...
  rtr scene.pack --samples 32..64 -o b.exr   ... the other half there,
  rtr merge a.exr b.exr -o c.exr -o c.png    merged
  rtr job scene.pack --format slurm       ... or on many machines
  rtr scene.pack -o a.png --resume        resume after Ctrl-C, a crash or a power cut
  rtr scene.pack -o a.png --resume=a.png.checkpoint.1   ... from a checkpoint of an earlier run
  rtr scene.pack -o a.png --write-every 2s    look at the picture while it is rendered
  rtr scene.pack -o - --write-every 1s | ffplay -f image2pipe -i -   ... as a stream of PNGs
  rtr scene.pack --tev localhost:14158    ... in tev, the image viewer
  rtr scene.pack --progress json 2> log   one line of JSON a second
  rtr scene.pack --until-error 0.01 --plot error.svg   until the error is 1 %, with a plot
  rtr scene.pack --until-error p95:0.05 --time 5m      until 95 % of the pixels are within 5 %
  rtr scene.pack --report error.csv --reference ref.exr   error against a converged picture
  rtr bench old.pack new.pack --time 30s  compare their errors at equal time
  rtr scene.pack --layers albedo,normal,depth,crypto   layers for denoising and compositing
  rtr scene.pack --transparent -o a.png   no sky behind it: a PNG with alpha
  rtr scene.pack --spp 32 --denoise -o a.exr -o a.png   without noise, by Open Image Denoise
  rtr scene.pack --watch --time 10s       render again whenever the pack changes
  rtr view scene.pack                     look around in a browser while it renders
  rtr check scene.pack                    is single precision enough?
  rtr scene.pack --pick 320,180           what is seen in a pixel, and the lines that made it
  rtr --ablate scene.pack                 gain from kernel specialisation on this device
  rtr --ablate=full scene.pack --device llvmpipe --size 160x90 --spp 4 --report ablation.json
  rtr --list-devices                      list the choices of --device

Exit codes: 0 done; 1 too many samples were not finite; 2 usage; 3 input, output or device;
70 a bug in rtr; 130 interrupted (what was complete is written).";

/// What renders replicates: no part of another picture, and nothing that can be resumed.
const MEASURING: [&str; 4] = ["report", "plot", "until_error", "reference"];
const CHECK_EXAMPLES: &str = "\
Examples:
  rtr check scene.pack                      is single precision enough for this scene?
  rtr check scene.pack --size 160x90 --spp 4   a quick check
  rtr check scene.pack --heat map.png       a heat map of the differences
  rtr check scene.pack --strict             fail at a single pixel, a leak or an overflow
  rtr check scene.pack --pixel 31,7 --sample 5 --trace
                                            print the path of one sample in both precisions

Exit codes: 0 stable, or replayed; 1 not stable; 2 usage; 3 input or output.";

/// Render a pack made by `rtc`, on a GPU or on the CPU.
#[derive(Debug, Parser)]
#[command(name = "rtr", version, after_help = EXAMPLES)]
#[command(args_conflicts_with_subcommands = true, subcommand_negates_reqs = true)]
pub(super) struct Args {
    #[command(subcommand)]
    pub(super) command: Option<Command>,
    #[command(flatten)]
    pub(super) render: RenderArgs,
}

#[derive(Debug, Subcommand)]
pub(super) enum Command {
    /// Merge parts of one picture that were rendered with --samples, --crop or both.
    #[command(after_help = MERGE_EXAMPLES)]
    Merge(MergeArgs),
    /// Compare the errors of two packs at equal time.
    Bench(BenchArgs),
    /// Trace the same samples in single and double precision and report where they diverge.
    #[command(after_help = CHECK_EXAMPLES)]
    Check(CheckArgs),
    /// Show a scene in a browser while it renders: look around, ask what is seen, adjust the exposure.
    #[command(after_help = VIEW_EXAMPLES)]
    View(ViewArgs),
    /// Write a job that renders a picture on many machines: for Open Job Description, Slurm or GNU parallel.
    #[command(after_help = JOB_EXAMPLES)]
    Job(JobArgs),
}

const BENCH_EXAMPLES: &str = "\
Examples:
  rtr bench old.pack new.pack                          five runs of 30 s each
  rtr bench a.pack b.pack --time 10s --runs 8 --device cpu --size 320x180
  rtr bench a.pack b.pack --report bench.json          every run, for other programs

The figure of merit (fom) is 1 / (rel^2 * seconds): twice the fom means half the time to equal error.
Runs alternate, and each pair has its own seed. Significance comes from an exact permutation test on
log fom; it takes four runs of each pack to reach 5 %.";

#[derive(Debug, clap::Args)]
#[command(after_help = BENCH_EXAMPLES)]
pub(super) struct BenchArgs {
    /// The baseline.
    #[arg(value_name = "A.pack")]
    pub(super) first: PathBuf,
    /// The pack to compare with it.
    #[arg(value_name = "B.pack")]
    pub(super) second: PathBuf,
    /// Render time of each run, without loading and compiling.
    #[arg(long, default_value = "30s", value_name = "TIME", value_parser = parse_duration)]
    pub(super) time: Duration,
    /// Runs of each pack.
    #[arg(long, default_value = "5", value_name = "N", value_parser = clap::value_parser!(u32).range(1..=10))]
    pub(super) runs: u32,
    /// Device to render on, as for rendering.
    #[arg(long, default_value = "auto", value_name = "DEVICE")]
    pub(super) device: String,
    /// Image size in pixels [default: those of the scenes].
    #[arg(long, value_name = "WxH", value_parser = parse_size)]
    pub(super) size: Option<[u32; 2]>,
    /// Seed of the first pair of runs.
    #[arg(long, value_name = "N", default_value = "1")]
    pub(super) seed: u32,
    /// Threads of the CPU kernel [default: one for each logical CPU].
    #[arg(long, value_name = "N", value_parser = parse_threads)]
    pub(super) threads: Option<usize>,
    /// Write the result and the report of every run as JSON.
    #[arg(long, value_name = "FILE.json")]
    pub(super) report: Option<PathBuf>,
    /// Print errors only.
    #[arg(long)]
    pub(super) quiet: bool,
}

/// Every use of these renders four replicates in turns, and the picture is their mean: other noise
/// than the usual picture, of the same quality.
#[derive(Clone, Debug, clap::Args)]
#[command(
    next_help_heading = "Error against time (renders four replicates in turns; docs/error.md)"
)]
pub(super) struct ErrorArgs {
    /// Write the error at every checkpoint, as .json (complete) or .csv (one line each).
    #[arg(long, value_name = "FILE")]
    pub(super) report: Vec<PathBuf>,
    /// Plot the error against time, as .svg or .png.
    #[arg(long, value_name = "FILE")]
    pub(super) plot: Vec<PathBuf>,
    /// Stop when the relative error is this small: 0.01, or p95:0.05 for all but 5 % of the pixels.
    /// --spp and --time still apply; whichever is reached first ends the run.
    #[arg(long, value_name = "[p95:]X")]
    pub(super) until_error: Option<Goal>,
    /// Give fewer samples to parts of the picture whose error is already small, as decided once, after 64 spp. Needs
    /// --until-error. The picture is slightly biased; its header says so.
    #[arg(long, requires = "until_error")]
    pub(super) adaptive: bool,
    /// Converged EXR picture of the same pixels to compare with, preferably made with --report, which
    /// stores its variance.
    #[arg(long, value_name = "REF.exr")]
    pub(super) reference: Option<PathBuf>,
}

impl ErrorArgs {
    /// Whether the error is to be measured.
    pub(super) fn any(&self) -> bool {
        self.until_error.is_some()
            || self.reference.is_some()
            || !self.report.is_empty()
            || !self.plot.is_empty()
    }
}

#[derive(Debug, clap::Args)]
#[expect(clippy::struct_excessive_bools, reason = "each is a switch on the command line")]
pub(super) struct CheckArgs {
    /// The pack to check.
    #[arg(value_name = "SCENE.pack")]
    pub(super) pack: PathBuf,
    /// Samples per pixel.
    #[arg(long, default_value = "16", value_name = "N", value_parser = clap::value_parser!(u32).range(1..))]
    pub(super) spp: u32,
    /// Image size in pixels [default: that of the scene].
    #[arg(long, value_name = "WxH", value_parser = parse_size)]
    pub(super) size: Option<[u32; 2]>,
    /// Seed of the image [default: that of the scene].
    #[arg(long, value_name = "N")]
    pub(super) seed: Option<u32>,
    /// Write a heat map of the differences: black none, blue 1e-6, orange 1e-3, white all.
    #[arg(long, value_name = "FILE.png")]
    pub(super) heat: Option<PathBuf>,
    /// Also fail if a single pixel differs by 1e-3, or if a medium stack leaks or overflows.
    #[arg(long)]
    pub(super) strict: bool,
    /// Replay one sample of this pixel instead.
    #[arg(long, value_name = "X,Y", value_parser = parse_pixel)]
    pub(super) pixel: Option<[u32; 2]>,
    /// Index of the sample.
    #[arg(long, default_value = "0", value_name = "N", requires = "pixel")]
    pub(super) sample: u32,
    /// Print every ray of the replayed path.
    #[arg(long, requires = "pixel")]
    pub(super) trace: bool,
    /// Threads [default: one for each logical CPU].
    #[arg(long, value_name = "N", value_parser = parse_threads)]
    pub(super) threads: Option<usize>,
    /// Read the pack instead of memory-mapping it, for network file systems.
    #[arg(long)]
    pub(super) no_mmap: bool,
    /// Print errors only.
    #[arg(long)]
    pub(super) quiet: bool,
}

const VIEW_EXAMPLES: &str = "\
Examples:
  rtr view scene.pack                       opens the page; Ctrl-C ends it
  rtr view scene.rts                        compiles at every change, and shows any errors
  rtr view scene.pack --size 640x360 --spp 256
  rtr view scene.pack --port 8000           through ssh -L 8000:127.0.0.1:8000 HOST
  rtr view scene.pack --listen 10.0.0.7     for other machines too, without encryption

The page is served on the loopback to whoever has its URL, which holds a secret. Nothing is written.";

#[derive(Debug, clap::Args)]
pub(super) struct ViewArgs {
    /// The pack to show, or a scene text, which the rtc beside rtr compiles to a pack in the working folder.
    #[arg(value_name = "SCENE.pack|SCENE.rts")]
    pub(super) scene: PathBuf,
    /// Image size in pixels [default: that of the scene].
    #[arg(long, value_name = "WxH", value_parser = parse_size)]
    pub(super) size: Option<[u32; 2]>,
    /// Samples per pixel [default: those of the scene].
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(1..))]
    pub(super) spp: Option<u32>,
    /// Port of the page; 0 takes any [default: 7878, or any if that is taken].
    #[arg(long, value_name = "N")]
    pub(super) port: Option<u16>,
    /// Address to listen at; others than those of the loopback let other machines in, without encryption.
    #[arg(long, value_name = "ADDRESS", default_value = "127.0.0.1")]
    pub(super) listen: std::net::IpAddr,
    /// Print the URL only.
    #[arg(long)]
    pub(super) no_browser: bool,
    /// Device to render on, as for rendering. A GPU builds its kernel again at every move of the camera.
    #[arg(long, default_value = "cpu", value_name = "DEVICE")]
    pub(super) device: String,
    /// Threads of the CPU kernel [default: one for each logical CPU].
    #[arg(long, value_name = "N", value_parser = parse_threads)]
    pub(super) threads: Option<usize>,
    /// Print the URL and errors only.
    #[arg(long)]
    pub(super) quiet: bool,
}

/// Which kernels `--ablate` compares with the pack's own.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(super) enum AblateArg {
    /// The one with all features, and each absent feature alone.
    Each,
    /// The one with all features.
    Full,
}

#[derive(Clone, Debug, clap::Args)]
#[expect(clippy::struct_excessive_bools, reason = "each is a switch on the command line")]
pub(super) struct RenderArgs {
    /// The pack to render; - reads it from standard input.
    #[arg(value_name = "SCENE.pack", required_unless_present = "list_devices")]
    pub(super) pack: Option<PathBuf>,
    /// Device: auto (best hardware GPU, else CPU), cpu, gpu, or part of an adapter's name.
    #[arg(long, default_value = "auto", value_name = "DEVICE")]
    pub(super) device: String,
    /// Samples per pixel [default: those of the scene].
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(1..))]
    pub(super) spp: Option<u32>,
    /// Image size in pixels; a different aspect ratio keeps the horizontal field of view.
    #[arg(long, value_name = "WxH", value_parser = parse_size)]
    pub(super) size: Option<[u32; 2]>,
    /// Render only part of the image; parts that are crops can be merged, too.
    #[arg(long, value_name = "X,Y,W,H", value_parser = parse_rect)]
    pub(super) crop: Option<Rect>,
    /// Render only these sample indices, to merge them later.
    #[arg(long, value_name = "A..B", value_parser = parse_samples, conflicts_with = "spp")]
    #[arg(conflicts_with_all = MEASURING)]
    pub(super) samples: Option<SampleRange>,
    /// Seed of the image [default: that of the scene].
    #[arg(long, value_name = "N")]
    pub(super) seed: Option<u32>,
    /// Scale the indirect light of every sample down so that no channel exceeds VALUE: fewer fireflies, but a
    /// picture that is too dark. Emission that is seen directly and direct light at the first surface are
    /// left alone. The header of the EXR says so, and how much light was removed.
    #[arg(long, value_name = "VALUE", value_parser = parse_clamp)]
    pub(super) clamp_indirect: Option<f32>,
    /// Stop after this render time, such as 60s, 1m30s or 500ms, within 10 % or a second. The picture is
    /// evenly sampled, unless the time is too short for one sample of every pixel.
    #[arg(long, value_name = "TIME", value_parser = parse_duration)]
    pub(super) time: Option<Duration>,
    /// Output file, .exr or .png; may be given several times; `-` is standard output [default: the pack's
    /// name in the working folder, as .exr and .png].
    #[arg(short, long, value_name = "FILE")]
    pub(super) output: Vec<PathBuf>,
    /// Format of outputs without a known extension; png16 also makes every PNG one of 16 bits [default: png for
    /// standard output, pipes and devices].
    #[arg(long, value_enum, value_name = "FORMAT")]
    pub(super) format: Option<Format>,
    /// Use the file name given by the scene even if that replaces a file.
    #[arg(long, conflicts_with = "output")]
    pub(super) scene_output: bool,
    /// Resume from a checkpoint of the same run, or start afresh if there is none. The picture is
    /// bit-identical to an uninterrupted one. FILE names another checkpoint, such as NAME.checkpoint.1.
    #[arg(long, value_name = "FILE", num_args = 0..=1, require_equals = true)]
    #[arg(conflicts_with_all = MEASURING)]
    #[expect(clippy::option_option, reason = "what clap calls a flag with an optional value")]
    pub(super) resume: Option<Option<PathBuf>>,
    /// Do nothing if the pictures are complete: every EXR holds all samples of this run, from this very pack. For
    /// tasks that may run twice.
    #[arg(long, conflicts_with = "watch", conflicts_with_all = MEASURING)]
    pub(super) skip_complete: bool,
    /// Render again whenever the pack changes, until Ctrl-C. An unfinished picture is dropped, a broken pack reported.
    #[arg(long, conflicts_with = "resume", conflicts_with_all = MEASURING)]
    pub(super) watch: bool,
    /// Time between checkpoints, such as 60s or 5m, or `never`. They are written beside the first output as
    /// NAME.checkpoint, also on Ctrl-C, and removed when the picture is complete. One of another run is
    /// kept as NAME.checkpoint.1.
    #[arg(long, default_value = "60s", value_name = "TIME", value_parser = parse_every)]
    pub(super) checkpoint_every: Every,
    /// Time between two pictures while rendering, such as 2s, or `never` [default: 5s]. The first is coarse, one sample
    /// for a block of pixels, and comes at once; blocks give way to pixels as these get their samples. Each
    /// replaces the one before in a single step. With this flag streams get every picture, one after the other;
    /// without it only the last.
    #[arg(long, value_name = "TIME", value_parser = parse_every)]
    pub(super) write_every: Option<Every>,
    /// Show the picture in tev, the image viewer, while it is rendered: every second, or as --write-every says
    /// [default port: 14158]. Without tev there, one warning is printed and the render goes on.
    #[arg(long, value_name = "HOST[:PORT]")]
    pub(super) tev: Option<String>,
    /// Threads of the CPU kernel [default: one for each logical CPU].
    #[arg(long, value_name = "N", value_parser = parse_threads)]
    pub(super) threads: Option<usize>,
    /// Read the pack instead of memory-mapping it, for network file systems.
    #[arg(long)]
    pub(super) no_mmap: bool,
    /// When to verify the hashes of the pack.
    #[arg(long, default_value = "background", value_name = "WHEN")]
    pub(super) verify: Verify,
    /// Stop at the first sample that is not finite.
    #[arg(long)]
    pub(super) strict: bool,
    /// Print errors only.
    #[arg(long)]
    pub(super) quiet: bool,
    /// Progress on standard error: `text`, or `json`, where every line is an object and one a second says
    /// how far the run is (docs/json.md).
    #[arg(
        long,
        value_enum,
        default_value = "text",
        value_name = "FORMAT",
        conflicts_with = "quiet"
    )]
    pub(super) progress: ProgressArg,
    /// Measure kernel specialisation instead of writing a picture: compare the pack's kernel with the full
    /// one and, with `each` (the default), with every single absent feature added: lines, SPIR-V words,
    /// build time, time per sample, equality of pictures. `auto` includes software adapters. 3 rounds of 16
    /// samples, or of --spp; --report writes JSON.
    #[arg(long, value_name = "WHAT", num_args = 0..=1, require_equals = true, default_missing_value = "each")]
    #[arg(conflicts_with_all = ["samples", "time", "output", "resume", "watch", "plot", "until_error", "reference", "denoise"])]
    pub(super) ablate: Option<AblateArg>,
    /// Print what this pixel shows instead of rendering: instance, object, material and part of an asset with
    /// their lines, position, distance and normal. Honours --size.
    #[arg(long, value_name = "X,Y", value_parser = parse_pixel)]
    #[arg(conflicts_with_all = ["samples", "time", "output", "resume", "watch", "plot", "until_error", "reference", "ablate", "denoise"])]
    pub(super) pick: Option<[u32; 2]>,
    /// Print what --pick finds as JSON.
    #[arg(long, requires = "pick")]
    pub(super) json: bool,
    /// List the choices of --device.
    #[arg(long)]
    pub(super) list_devices: bool,
    /// Target duration of one GPU submission, at most 1s.
    #[arg(long, default_value = "100ms", value_name = "TIME", value_parser = parse_duration)]
    pub(super) submission: Duration,
    /// Estimator, for tests.
    #[arg(long, hide = true, default_value = "mis")]
    pub(super) estimator: Estimator,
    /// Precision of the CPU kernel, for tests.
    #[arg(long, hide = true, default_value = "f32")]
    pub(super) precision: PrecisionArg,
    #[command(flatten)]
    pub(super) error: ErrorArgs,
    #[command(flatten)]
    pub(super) layers: LayerArgs,
    #[command(flatten)]
    pub(super) denoise: DenoiseArgs,
}

/// How far a run is, said to whom.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(super) enum ProgressArg {
    /// People.
    Text,
    /// Programs.
    Json,
}

/// When a pack's bytes are compared with the hashes in it.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(super) enum Verify {
    /// Before rendering.
    First,
    /// While rendering has begun; nothing is written before.
    Background,
    /// Not at all: damage that breaks no rule of the format shows in the picture.
    Off,
}

/// Numbers are those of `Frame::estimator`.
#[derive(Clone, Copy, Debug, ValueEnum)]
pub(super) enum Estimator {
    Mis = 0,
    Light = 1,
    Bsdf = 2,
    Power = 3,
}

#[derive(Clone, Copy, Debug, ValueEnum)]
pub(super) enum PrecisionArg {
    F32,
    F64,
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_arguments_are_consistent() {
        use clap::CommandFactory as _;
        Args::command().debug_assert();
    }
}

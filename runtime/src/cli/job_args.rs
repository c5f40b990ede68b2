//! The command line of `rtr job`.

use super::values::{parse_duration, parse_size, parse_threads};
use crate::layers::Layer;
use clap::ValueEnum;
use std::path::PathBuf;
use std::time::Duration;

pub(super) const JOB_EXAMPLES: &str = "\
Examples:
  rtr job scene.pack --format openjd            scene.openjd.yaml, to be run with
    openjd run scene.openjd.yaml --extensions TASK_CHUNKING --step Render
    openjd run scene.openjd.yaml --extensions TASK_CHUNKING --step Merge
  rtr job scene.pack --format slurm             scene.render.sbatch and scene.merge.sbatch:
    render=$(sbatch --parsable scene.render.sbatch)
    sbatch --dependency=afterok:$render scene.merge.sbatch
  rtr job scene.pack --format sh --chunk 4      scene.job.sh, four batches a task:
    seq 0 15 | parallel --sshloginfile nodes --workdir . sh ./scene.job.sh task
    sh ./scene.job.sh merge
  rtr job scene.pack --format slurm --size 7680x4320 --tile 960x540
                                                crops as well as samples, for large frames

Parts merge to the bits of one run. Tasks may be killed at any time and run twice (docs/farm.md).";

/// What a job is written for.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(super) enum JobFormat {
    /// Open Job Description, 2023-09, with `TASK_CHUNKING`.
    Openjd,
    /// An array job for Slurm, and the merge that waits for it.
    Slurm,
    /// A shell script, for GNU parallel over ssh or one machine.
    Sh,
}

#[derive(Debug, clap::Args)]
pub(super) struct JobArgs {
    /// The pack to render. Tasks open it by this name, so all machines must see it there.
    #[arg(value_name = "SCENE.pack")]
    pub(super) pack: PathBuf,
    /// What the job is written for.
    #[arg(long, value_enum, value_name = "FORMAT")]
    pub(super) format: JobFormat,
    /// Folder for the files of the job [default: the working folder].
    #[arg(short, long, value_name = "FOLDER")]
    pub(super) output: Option<PathBuf>,
    /// Samples per pixel [default: those of the scene].
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(1..))]
    pub(super) spp: Option<u32>,
    /// Image size in pixels [default: that of the scene].
    #[arg(long, value_name = "WxH", value_parser = parse_size)]
    pub(super) size: Option<[u32; 2]>,
    /// Seed of the image [default: that of the scene].
    #[arg(long, value_name = "N")]
    pub(super) seed: Option<u32>,
    /// Device of the tasks, as for rendering.
    #[arg(long, default_value = "auto", value_name = "DEVICE")]
    pub(super) device: String,
    /// Layers of the picture, as for rendering.
    #[arg(long, value_name = "LAYER,...", value_delimiter = ',', value_enum)]
    pub(super) layers: Vec<Layer>,
    /// Batches of 16 samples that a task renders [default: what takes --task-time here].
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(1..))]
    pub(super) chunk: Option<u32>,
    /// Cut the frame into crops of this size, too: for frames of which a single batch takes too long [default: tasks
    /// render all pixels].
    #[arg(long, value_name = "WxH", value_parser = parse_size)]
    pub(super) tile: Option<[u32; 2]>,
    /// How long a task should take.
    #[arg(long, default_value = "10m", value_name = "TIME", value_parser = parse_duration)]
    pub(super) task_time: Duration,
    /// Render for so long here to learn how long a batch takes.
    #[arg(long, default_value = "20s", value_name = "TIME", value_parser = parse_duration, conflicts_with = "chunk")]
    pub(super) measure: Duration,
    /// Threads of the measurement [default: one for each logical CPU].
    #[arg(long, value_name = "N", value_parser = parse_threads)]
    pub(super) threads: Option<usize>,
    /// Print errors only.
    #[arg(long)]
    pub(super) quiet: bool,
}

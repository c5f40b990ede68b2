//! Many machines: a pack and how it is to be rendered → the files of a job for an engine that distributes work.
//!
//! A task renders a range of samples into a part, and merging the parts gives the bits of one run, so nothing here
//! knows where or in which order tasks run. There is no scheduler: each format is a text for one that exists.

mod openjd;
mod plan;
mod shell;
mod slurm;

pub use plan::{JobFile, Plan, chunk_for};

/// The engine that a job is written for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Engine {
    /// Open Job Description, 2023-09, with the extension `TASK_CHUNKING`.
    OpenJd,
    /// Slurm.
    Slurm,
    /// POSIX shell, for GNU parallel.
    Shell,
}

/// The files of a job, and the commands that submit it.
#[must_use]
pub fn files(plan: &Plan, engine: Engine) -> (Vec<JobFile>, Vec<String>) {
    match engine {
        Engine::OpenJd => openjd::files(plan),
        Engine::Slurm => slurm::files(plan),
        Engine::Shell => shell::files(plan),
    }
}

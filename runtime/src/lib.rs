//! Pack → pixels: on the GPU through wgpu, or on the CPU through the same kernel as Rust.
//!
//! A checked pack and a [`Job`] become a film of `f64` sums, the film becomes EXR and PNG. Samples
//! are a pure function of pixel, index, dimension and seed, and are summed in one fixed order, so
//! tiles, threads and interruptions cannot change the picture. The pack is the whole contract:
//! nothing here knows the scene language, the compiler, or how the kernel was linked.
//!
//! ```no_run
//! use runtime::{Control, DeviceChoice, Job, Scene, render};
//!
//! # fn main() -> Result<(), Box<dyn std::error::Error>> {
//! let scene = Scene::new(pack::Pack::read("scene.pack")?);
//! let job = Job::of_scene(&scene);
//! let outcome = render(&scene, &job, &DeviceChoice::Cpu, &Control::default())?;
//! runtime::output::write("scene.exr".as_ref(), &outcome.picture, false)?;
//! # Ok(())
//! # }
//! ```

#[cfg(feature = "gpu")]
pub mod ablation;
mod allocation;
pub mod check;
mod checkpoint;
pub mod cli;
mod coarse;
mod control;
pub mod convergence;
mod cpu;
pub mod denoise;
pub mod farm;
mod film;
mod gather;
#[cfg(feature = "gpu")]
pub mod gpu;
mod job;
pub mod kernel;
pub mod layers;
mod left_out;
mod lights;
mod mark;
mod memory;
mod outcome;
pub mod output;
pub mod pick;
mod plane;
mod preview;
pub mod profile;
mod region;
mod render;
mod replicate;
pub mod report;
mod run;
mod saver;
mod scene;
mod schedule;
mod setup;
mod signals;
mod tev;
#[cfg(feature = "gpu")]
mod trust;
pub mod view;
#[cfg(target_arch = "x86_64")]
mod wide;
mod zeros;

pub use checkpoint::{Checkpoint, CheckpointError};
pub use control::{Control, Latest};
pub use film::{BadSample, Counters, Film};
pub use job::{CpuWay, Job, JobError, MAX_PIXELS, MAX_SIDE, Precision};
pub use left_out::{LeftOut, Reason, Section};
pub use mark::Mark;
pub use memory::{TooLarge, film_bytes};
pub use outcome::{Outcome, TileFailure};
pub use preview::Preview;
pub use region::{Rect, SampleRange};
pub use render::{DeviceChoice, RenderError, render, render_session};
pub use saver::{Keep, Session};
pub use scene::Scene;
pub use schedule::Stop;
pub use signals::{Event, Observer, Progress};
pub use zeros::NoMemory;

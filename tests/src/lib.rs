//! Everything that crosses crates: see `tests/tests`.
//!
//! This library is what those tests share: a scene text becomes a checked pack in memory, a pack
//! becomes a film, a film becomes a mean with its standard error.

pub mod ablation;
pub mod albedo;
#[cfg(unix)]
pub mod attacks;
pub mod ball;
pub mod benchmarks;
pub mod console;
pub mod edits;
pub mod embree;
pub mod exr_file;
pub mod farm;
pub mod features;
pub mod flips;
pub mod furnace;
pub mod fuzz;
pub mod guiding;
pub mod kernel;
pub mod kills;
pub mod layers;
pub mod mapped;
pub mod picture;
pub mod pitfalls;
pub mod scene;
pub mod software;
pub mod stability;
pub mod statistics;
pub mod structure;
pub mod truth;

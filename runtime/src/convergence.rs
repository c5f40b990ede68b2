//! Pictures of independent noise → how large the error is, and how it falls with time.
//!
//! A run that is measured renders `REPLICATES` pictures in turns, each with a seed of its own; the
//! picture that is kept is their mean. How much they differ tells its error without a reference:
//! the two halves of one well-spread sequence would not, because they are made to disagree. See
//! `docs/error.md`. Nothing here renders.

mod canvas;
mod compare;
mod estimate;
mod plot;
mod raster;
mod reference;
mod report;
mod track;

pub use self::compare::{Comparison, Spread, compare};
pub use self::estimate::{Noise, moments, noise};
pub use self::plot::{chart_png, chart_svg};
pub use self::reference::{Reference, Versus};
pub use self::report::{Report, Resolution};
pub use self::track::{Convergence, Goal, Point, Quantity, Times};
pub(crate) use self::track::{Moment, Tracker};

use std::sync::Arc;

/// Pictures of independent noise.
pub const REPLICATES: usize = 4;
/// `REPLICATES` as a count of samples.
pub(crate) const REPLICATES_U32: u32 = 4;

/// What is wanted of a run that is measured.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Measure {
    /// When the picture is good enough; `None`: only samples and time end the run.
    pub goal: Option<Goal>,
    /// What the picture converges to, where that is known.
    pub reference: Option<Arc<Reference>>,
}

/// Luminance of linear Rec. 709, ITU-R BT.709-6, item 3.2.
#[must_use]
pub fn luminance([r, g, b]: [f64; 3]) -> f64 {
    0.2126 * r + 0.7152 * g + 0.0722 * b
}

/// The seed of a replicate: the first has that of the image, so it is part of the usual picture.
/// Both samplers hash the seed, so any other number makes other noise.
#[must_use]
pub fn replicate_seed(seed: u32, replicate: u32) -> u32 {
    // 2^32 over the golden ratio: far from the seeds that people choose.
    seed.wrapping_add(replicate.wrapping_mul(0x9e37_79b9))
}

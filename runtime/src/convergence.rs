//! Pictures of independent noise → how large the error is, and how it falls with time.
//!
//! A run that is measured renders `REPLICATES` pictures in turns, each with a seed of its own; the
//! picture that is kept is their mean. How much they differ tells its error without a reference:
//! the two halves of one well-spread sequence would not, because they are made to disagree. See
//! `docs/error.md`. Nothing here renders.

mod canvas;
mod compare;
mod estimate;
mod goal;
mod plot;
mod raster;
mod reference;
mod track;

pub use self::compare::{Comparison, Spread, compare};
pub use self::estimate::{Noise, noise};
pub use self::goal::{Goal, Measure, Quantity};
pub use self::plot::{chart_png, chart_svg};
pub use self::reference::{Reference, Versus};
pub use self::track::{Convergence, Point, Times};
pub(crate) use self::track::{Decision, Moment, Tracker};
pub use crate::replicate::{REPLICATES, luminance, moments, replicate_seed};

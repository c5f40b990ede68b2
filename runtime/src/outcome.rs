//! What a run gives: the film with all that is known about it, and how the run ended.

use crate::convergence::Convergence;
use crate::film::Film;
use crate::mark::Mark;
use crate::output::Picture;
use crate::region::Rect;
use crate::schedule::Stop;
use std::time::Duration;

/// What a run gives.
#[derive(Clone, Debug, PartialEq)]
pub struct Outcome {
    /// The film and what is known about it.
    pub picture: Picture,
    /// Why the run ended.
    pub stop: Stop,
    /// Tiles that could not be rendered; bugs.
    pub failures: Vec<TileFailure>,
    /// What became of the device, when it could not finish.
    pub device_error: Option<String>,
    /// Time from the first claim to the last deposit, with that of the runs it went on from.
    pub elapsed: Duration,
    /// Whether a checkpoint was written.
    pub saved: bool,
    /// The checkpoint of this run: the one that it wrote last, or the one that it goes on from.
    pub checkpoint: Option<Mark>,
    /// The error curve, of a run that was measured.
    pub convergence: Option<Convergence>,
}

impl Outcome {
    /// The film.
    #[must_use]
    pub fn film(&self) -> &Film {
        &self.picture.film
    }

    /// Whether more than one sample in 10^7 was not finite.
    #[must_use]
    pub fn too_many_bad(&self) -> bool {
        self.film().counters.bad as f64 > 1e-7 * self.film().total_samples() as f64
    }
}

/// A tile that could not be rendered.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct TileFailure {
    /// Its pixels.
    pub tile: Rect,
    /// Its first sample.
    pub sample: u32,
    /// What happened.
    pub message: String,
}

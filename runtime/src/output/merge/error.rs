//! Why files are not parts of one picture, or not all of it.

use crate::output::picture::OutputError;
use crate::region::{Rect, SampleRange};
use crate::zeros::NoMemory;
use std::fmt;
use thiserror::Error;

/// Samples that no part has.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Missing {
    /// Of these pixels; `None`: of all.
    pub crop: Option<Rect>,
    /// These.
    pub samples: SampleRange,
}

impl fmt::Display for Missing {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self.crop {
            Some(crop) => write!(f, "{} of crop {crop}", self.samples),
            None => write!(f, "{}", self.samples),
        }
    }
}

/// Why files are not parts of one picture, or not all of it.
#[derive(Debug, Error)]
pub enum MergeError {
    /// Nothing to merge.
    #[error("no pictures to merge")]
    Nothing,
    /// The pictures differ in something that parts of one picture share.
    #[error(
        "part {part}: {what} is {found}, but part 1 has {expected}; only parts of one picture can be merged"
    )]
    Differs {
        /// Number of the part, from 1.
        part: usize,
        /// What differs.
        what: &'static str,
        /// Its value in this part.
        found: String,
        /// Its value in the first part.
        expected: String,
    },
    /// Crops that have some pixels in common.
    #[error(
        "part {part}: crop {found} overlaps crop {expected} of part {other}; crops must be equal or apart"
    )]
    Crops {
        /// Number of the part, from 1.
        part: usize,
        /// Its crop.
        found: Rect,
        /// The part before it.
        other: usize,
        /// Its crop.
        expected: Rect,
    },
    /// The same samples twice.
    #[error("part {part}: samples {found} overlap {expected} of the parts before it")]
    Overlap {
        /// Number of the part, from 1.
        part: usize,
        /// Ranges of this part.
        found: String,
        /// Ranges of all parts of the same pixels before it.
        expected: String,
    },
    /// A picture whose error was measured.
    #[error(
        "part {part}: it is the mean of the replicates of a measured run, which merges with other crops of that run only"
    )]
    Replicates {
        /// Number of the part, from 1.
        part: usize,
    },
    /// A part whose pixels have different numbers of samples.
    #[error(
        "part {part}: its pixels have between {least} and {most} samples; a part must be evenly sampled"
    )]
    Uneven {
        /// Number of the part, from 1.
        part: usize,
        /// Fewest samples.
        least: u32,
        /// Most samples.
        most: u32,
    },
    /// A part that contradicts itself.
    #[error("part {part}: its pixels have {found} samples, but its header speaks of {said}")]
    Samples {
        /// Number of the part, from 1.
        part: usize,
        /// Samples of every pixel.
        found: u32,
        /// Samples of its ranges.
        said: u32,
    },
    /// Not all that there should be.
    #[error("samples {} are missing", list(.0))]
    Missing(Vec<Missing>),
    /// More samples than there should be.
    #[error("part {part}: it has samples {found}, more than {expected}")]
    MoreSamples {
        /// Number of the part, from 1.
        part: usize,
        /// Its ranges.
        found: String,
        /// What is asked for.
        expected: SampleRange,
    },
    /// More pixels than there should be.
    #[error("part {part}: its crop {found} leaves {expected}")]
    MorePixels {
        /// Number of the part, from 1.
        part: usize,
        /// Its crop.
        found: Rect,
        /// What is asked for.
        expected: Rect,
    },
    /// The pixels that are asked for are not all in the image.
    #[error("crop {crop} leaves the image of {}x{} pixels", size[0], size[1])]
    Outside {
        /// What is asked for.
        crop: Rect,
        /// The image.
        size: [u32; 2],
    },
    /// A part cannot be read.
    #[error(transparent)]
    Part(#[from] OutputError),
    /// The system does not give the memory for a few rows.
    #[error(transparent)]
    NoMemory(#[from] NoMemory),
}

/// The first few.
fn list(missing: &[Missing]) -> String {
    const MOST: usize = 4;
    let first: Vec<String> = missing.iter().take(MOST).map(ToString::to_string).collect();
    let more = missing.len().saturating_sub(MOST);
    if more > 0 { format!("{} and {more} more", first.join(", ")) } else { first.join(", ") }
}

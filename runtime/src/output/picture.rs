//! A film with all that is known about it, and what can go wrong with its files.

use crate::film::Film;
use crate::layers::Layers;
use crate::plane::pixels;
use crate::region::{SampleRange, insert_range};
use files::ShowPath as _;
use std::ops::Range;
use std::path::PathBuf;
use thiserror::Error;

/// A film and where it comes from.
#[derive(Clone, Debug, PartialEq)]
pub struct Picture {
    /// The pixels.
    pub film: Film,
    /// The rest.
    pub meta: Meta,
    /// What it holds beside radiance.
    pub layers: Option<Layers>,
    /// What is shown instead of the film's means.
    pub denoised: Option<Denoised>,
}

impl Picture {
    /// A picture of radiance alone.
    #[must_use]
    pub fn new(film: Film, meta: Meta) -> Self {
        Self { film, meta, layers: None, denoised: None }
    }

    /// The same picture without its pixels: what is known of it before they are.
    pub(crate) fn head(&self) -> Self {
        let Film { image_size, region, .. } = self.film;
        let film = Film {
            ranges: self.film.ranges.clone(),
            counters: self.film.counters,
            ..Film::without_pixels(image_size, region)
        };
        let denoised = self.denoised.as_ref();
        Self {
            film,
            meta: self.meta.clone(),
            layers: self.layers.as_ref().map(Layers::head),
            denoised: denoised.map(|denoised| denoised.of(Vec::new())),
        }
    }

    /// Some rows of it, counted from the first of its region, without the names of mattes.
    pub(crate) fn rows(&self, rows: &Range<u32>) -> Self {
        let at = pixels(self.film.region.w, rows);
        let denoised = self.denoised.as_ref();
        Self {
            film: self.film.rows(rows),
            meta: self.meta.clone(),
            layers: self.layers.as_ref().map(|layers| layers.pixels(&at)),
            denoised: denoised.map(|denoised| denoised.of(denoised.pixels[at].to_vec())),
        }
    }

    /// Takes the names of mattes from the head of the same picture, so that all of it is there.
    pub(crate) fn take_names(&mut self, head: &Self) {
        if let (Some(layers), Some(head)) = (&mut self.layers, &head.layers) {
            layers.take_names(head);
        }
    }

    /// Radiance of every pixel as it is shown, row by row: denoised, or the means.
    #[must_use]
    pub fn shown(&self) -> Vec<[f64; 3]> {
        match &self.denoised {
            Some(denoised) => denoised.pixels.iter().map(|pixel| pixel.map(f64::from)).collect(),
            None => self.film.means(),
        }
    }
}

/// What a denoiser made of a picture.
#[derive(Clone, Debug, PartialEq)]
pub struct Denoised {
    /// Radiance, linear Rec. 709, of every pixel of the film, row by row.
    pub pixels: Vec<[f32; 3]>,
    /// Name and version of the denoiser.
    pub by: String,
}

impl Denoised {
    /// Other pixels by the same denoiser.
    fn of(&self, pixels: Vec<[f32; 3]>) -> Self {
        Self { pixels, by: self.by.clone() }
    }
}

/// What is known about a picture beside its pixels; all of it is stored in the EXR.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Meta {
    /// Hexadecimal name of what was rendered, from the pack; parts of one picture share it.
    pub render_id: String,
    /// Seed of the image.
    pub seed: u32,
    /// Estimator switch of the kernel; 0 except in tests.
    pub estimator: u32,
    /// `Job::clamp_indirect`.
    pub clamp_indirect: Option<f32>,
    /// Whether parts of the picture have fewer samples because of what they looked like.
    pub adaptive: bool,
    /// Precision of the kernel: `f32` or `f64`.
    pub precision: String,
    /// Devices that rendered it, in order.
    pub device: String,
    /// Commits of the programs that rendered it, in order, as far as they know theirs.
    pub commit: String,
    /// Seconds of rendering; of merged parts, their sum.
    pub seconds: f64,
    /// Exposure of the PNG in stops; not applied to the EXR.
    pub exposure: f32,
    /// `ToneMap` number of the PNG; not applied to the EXR.
    pub tone_map: u32,
    /// False when the run ended before all requested samples, or a tile failed.
    pub complete: bool,
    /// Side in pixels of the blocks that share a sample where pixels have none of their own: in the first pictures of
    /// a run, which are there to be looked at.
    pub coarse_block: Option<u32>,
}

/// A picture that cannot be read or written.
#[derive(Debug, Error)]
pub enum OutputError {
    /// The file cannot be opened, created, written or renamed.
    #[error(transparent)]
    Write(files::FileError),
    /// The encoder refused.
    #[error("cannot encode the picture: {message}")]
    Encode {
        /// The encoder's words.
        message: String,
    },
    /// The file cannot be opened, or is none.
    #[error(transparent)]
    Open(files::FileError),
    /// The file cannot be read as an EXR image.
    #[error("cannot read {}: {message}", path.shown())]
    Read {
        /// The file.
        path: PathBuf,
        /// The decoder's words.
        message: String,
    },
    /// An EXR image that `rtr` did not write, or that lacks what is needed here.
    #[error("{} was not written by rtr: {message}", path.shown())]
    Foreign {
        /// The file.
        path: PathBuf,
        /// What is missing.
        message: String,
    },
    /// A file name that says neither `.exr` nor `.png`.
    #[error("{}: the name must end in .exr or .png", path.shown())]
    Format {
        /// The name.
        path: PathBuf,
    },
}

/// `0..32,64..96`.
pub(crate) fn ranges_text(ranges: &[SampleRange]) -> String {
    ranges.iter().map(SampleRange::to_string).collect::<Vec<_>>().join(",")
}

/// The inverse of `ranges_text`; `None` when malformed, overlapping or empty ranges occur.
pub(crate) fn parse_ranges(text: &str) -> Option<Vec<SampleRange>> {
    let mut ranges = Vec::new();
    for part in text.split(',').filter(|part| !part.is_empty()) {
        let (start, end) = part.split_once("..")?;
        let range = SampleRange::new(start.parse().ok()?, end.parse().ok()?)?;
        if !insert_range(&mut ranges, range) {
            return None;
        }
    }
    Some(ranges)
}

/// What indirect light is clamped to, as headers say it.
pub(crate) fn clamp_text(clamp: Option<f32>) -> String {
    clamp.map_or("off".to_owned(), |most| most.to_string())
}

/// The inverse of `clamp_text`.
pub(crate) fn parse_clamp(text: &str) -> Result<Option<f32>, &'static str> {
    match text {
        "off" => Ok(None),
        number => number.parse().map(Some).map_err(|_| "`clamp_indirect` is malformed"),
    }
}

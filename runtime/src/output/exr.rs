//! Film ⇄ EXR: linear `f32` means, exact enough to go on adding, with all that is known about them.
//!
//! Channels `R`, `G`, `B` hold the mean radiance; where that is denoised, `noisy.R` and so on hold it, and the attribute
//! `denoiser` says so. `residual.R` and so on, where present, hold what
//! rounding the `f64` mean to `f32` left over, so that mean + residual is good to about 2^-48.
//! `variance.Y` is the variance of the mean luminance, in pictures that are the mean of replicates.
//! `samples` is there where pixels have different numbers of samples.

mod channels;
mod file;
mod header;
mod names;
mod write;

pub use self::file::ExrFile;
pub(crate) use self::header::parse_bad;
pub(crate) use self::write::{bands, write};

use super::picture::{OutputError, Picture};
use super::survey::Survey;
use std::io::Cursor;
use std::path::Path;

/// The film as it is: linear, no exposure, no tone curve; `residual` as for `encode`.
pub fn encode_exr(picture: &Picture, residual: bool) -> Result<Vec<u8>, OutputError> {
    let mut file = Cursor::new(Vec::new());
    let known = (&picture.head(), &Survey::of(picture));
    write(&mut file, known, residual, |rows| Ok::<_, OutputError>(picture.rows(rows)))?;
    Ok(file.into_inner())
}

/// Reads what `encode_exr` made; of what is denoised, the noisy picture.
pub fn read_exr(path: &Path) -> Result<Picture, OutputError> {
    ExrFile::open(path)?.read()
}

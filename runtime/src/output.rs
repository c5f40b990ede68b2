//! Films → files: EXR for numbers, PNG for eyes, and parts of a picture merged into one.
//!
//! Every file appears complete or not at all: it is written beside its final name and renamed. This
//! module does not render.

mod channel;
mod exr;
mod groups;
mod identity;
mod merge;
mod picture;
mod planes;
mod png;
mod survey;

pub(crate) use self::exr::parse_bad;
pub use self::exr::{ExrFile, encode_exr, read_exr};
pub use self::identity::{Identity, is_whole};
pub use self::merge::{Expected, Merge, MergeError, Missing, Part, merge};
pub use self::picture::{Denoised, Meta, OutputError, Picture};
pub(crate) use self::picture::{parse_ranges, ranges_text};
pub(crate) use self::png::encode_rgb;
pub use self::png::{PngRows, encode_png, encode_png16, tone_map};

use std::path::Path;

/// Kind of a picture file, from its name.
#[derive(Clone, Copy, Debug, PartialEq, Eq, clap::ValueEnum)]
pub enum Format {
    /// Linear float, with everything that is known.
    Exr,
    /// Eight bits, tone-mapped.
    Png,
    /// A PNG of sixteen bits, tone-mapped.
    Png16,
}

impl Format {
    /// The format that the extension of `path` asks for.
    pub fn of(path: &Path) -> Result<Self, OutputError> {
        let extension = path.extension().and_then(|e| e.to_str()).map(str::to_ascii_lowercase);
        match extension.as_deref() {
            Some("exr") => Ok(Self::Exr),
            Some("png") => Ok(Self::Png),
            _ => Err(OutputError::Format { path: path.to_owned() }),
        }
    }
}

/// Writes `picture` in the format of the name; `residual` as for [`encode`].
pub fn write(path: &Path, picture: &Picture, residual: bool) -> Result<(), OutputError> {
    let bytes = encode(Format::of(path)?, picture, residual)?;
    files::write(path, |out| out.write_all(&bytes)).map_err(OutputError::Write)
}

/// The bytes of the file. `residual`: whether an EXR also holds the rounding error of its means, which makes merging
/// exact to about 2^-48.
pub fn encode(format: Format, picture: &Picture, residual: bool) -> Result<Vec<u8>, OutputError> {
    match format {
        Format::Exr => encode_exr(picture, residual),
        Format::Png => encode_png(picture),
        Format::Png16 => encode_png16(picture),
    }
}

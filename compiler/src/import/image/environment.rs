//! An image file becomes radiance from all directions.
//!
//! A sun may be brighter than what a half float holds. Such an image is stored divided by a power of two,
//! which loses nothing above 2^-24 of its brightest texel. Texels that cannot be radiance are errors here:
//! one of them would spoil every path that leaves the scene. It does not know directions.

use super::format::{Format, gave_up, recognise};
use super::texels::{HalfImage, Image};
use super::{decode_image, exr, hdr};
use crate::import::error::{ErrorKind, ImportError};
use crate::import::file::{Limits, read_file};
use crate::import::guard;
use files::ShowPath as _;
use std::path::Path;

/// An image whose texels, times `scale`, are radiance.
#[derive(Clone, Debug, PartialEq)]
pub struct Environment {
    /// The texels.
    pub image: Image,
    /// Factor on them, a power of two, >= 1.
    pub scale: f64,
}

/// The largest half float.
const LARGEST: f32 = 65504.0;

/// Reads one image file.
pub fn load_environment(path: &Path, limits: &Limits) -> Result<Environment, ImportError> {
    let (bytes, _loan) = read_file(path, limits)?;
    decode_environment(&bytes, &path.shown().to_string(), limits)
}

/// Decodes an image in memory; `place` is named in errors.
fn decode_environment(
    bytes: &[u8],
    place: &str,
    limits: &Limits,
) -> Result<Environment, ImportError> {
    let image = match recognise(bytes, place)? {
        Format::Exr | Format::Hdr => decode_radiance(bytes, place, limits, 1.0)?,
        Format::Png | Format::Jpeg | Format::WebP | Format::Ktx2 | Format::Ies => {
            let image = decode_image(bytes, place, limits)?;
            return Ok(Environment { image, scale: 1.0 });
        }
    };
    check_radiance(&image, place)?;
    if image.largest <= LARGEST {
        return Ok(Environment { image: image.finish(), scale: 1.0 });
    }
    let least = libm::ilogbf(image.largest) - libm::ilogbf(LARGEST);
    let fits = libm::scalbnf(image.largest, -least) <= LARGEST;
    let scale = libm::scalbnf(1.0, if fits { -least } else { -least - 1 });
    let image = decode_radiance(bytes, place, limits, scale)?;
    Ok(Environment { image: image.finish(), scale: f64::from(1.0 / scale) })
}

fn decode_radiance(
    bytes: &[u8],
    place: &str,
    limits: &Limits,
    scale: f32,
) -> Result<HalfImage, ImportError> {
    guard::quietly(|| match recognise(bytes, place)? {
        Format::Exr => exr::decode(bytes, place, limits, scale),
        _ => hdr::decode(bytes, place, limits, scale),
    })
    .unwrap_or_else(|| Err(gave_up(place)))
}

/// Every channel is finite and not negative.
fn check_radiance(image: &HalfImage, place: &str) -> Result<(), ImportError> {
    let Some((texel_idx, value)) = image.bad else { return Ok(()) };
    let width = image.size[0] as usize;
    let (x, y) = (texel_idx % width, texel_idx / width);
    let message = format!(
        "texel ({x}, {y}), counted from the top left, has a channel of {value}; radiance is a finite \
         number, 0 or more"
    );
    Err(ImportError::new(ErrorKind::Image, place, message).with_help(
        "clamp the image, or leave out what made the texel in the program that wrote it",
    ))
}

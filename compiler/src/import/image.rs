//! Image files become texels: 8 bits a channel where the file has no more, half floats otherwise.
//!
//! PNG, JPEG and WebP with 8 bits keep their bytes, and so do KTX2 textures of Basis Universal; PNG with 16 bits
//! becomes half floats of `value / 65535` (11 significant bits, which is more than any texture lookup needs). Neither is
//! converted: the numbers stay in the encoding of the file, sRGB or linear, which only the scene knows. HDR
//! and EXR are linear by definition and become half floats; brighter texels are clamped and counted. So are luminaire
//! files (IES), which are images of all directions.
//!
//! The format is recognised by the first bytes, never by the name. Width and height are checked
//! against the limit before any texel is decoded.

mod environment;
mod exr;
mod format;
mod hdr;
mod ies;
mod ktx2;
mod texels;

use self::format::{Format, broken, checked_size, gave_up, kept, raw, recognise};
use self::texels::HalfImage;
use super::budget::zeroed;
use super::error::{ErrorKind, ImportError};
use super::file::{Limits, read_file};
use super::guard;
use ::image::{ImageDecoder, ImageFormat, ImageReader};
pub use environment::{Environment, load_environment};
pub use texels::{Image, Pixels};

use files::ShowPath as _;
use half::f16;
use std::io::Cursor;
use std::path::Path;

/// Reads one image file.
pub fn load_image(path: &Path, limits: &Limits) -> Result<Image, ImportError> {
    let (bytes, _loan) = read_file(path, limits)?;
    decode_image(&bytes, &path.shown().to_string(), limits)
}

/// Decodes an image in memory; `place` is named in errors.
pub fn decode_image(bytes: &[u8], place: &str, limits: &Limits) -> Result<Image, ImportError> {
    guard::quietly(|| match recognise(bytes, place)? {
        Format::Exr => exr::decode(bytes, place, limits, 1.0).map(HalfImage::finish),
        Format::Hdr => hdr::decode(bytes, place, limits, 1.0).map(HalfImage::finish),
        Format::Ies => ies::decode(bytes, place, limits).map(HalfImage::finish),
        Format::Ktx2 => ktx2::decode(bytes, place, limits),
        format => decode_ldr(bytes, format, place, limits),
    })
    .unwrap_or_else(|| Err(gave_up(place)))
}

/// Width and height that an image in memory claims, checked against the limit.
pub(super) fn size(bytes: &[u8], place: &str, limits: &Limits) -> Result<[u32; 2], ImportError> {
    guard::quietly(|| match recognise(bytes, place)? {
        Format::Exr => exr::size(bytes, place, limits),
        Format::Hdr => hdr::size(bytes, place, limits),
        Format::Ies => ies::size(bytes, place, limits),
        Format::Ktx2 => ktx2::size(bytes, place, limits),
        format => {
            let decoder = reader(bytes, format, place)?;
            let (width, height) = decoder.into_dimensions().map_err(|e| broken(place, &e))?;
            checked_size(width, height, place, limits)
        }
    })
    .unwrap_or_else(|| Err(gave_up(place)))
}

fn reader<'a>(
    bytes: &'a [u8],
    format: Format,
    place: &str,
) -> Result<ImageReader<Cursor<&'a [u8]>>, ImportError> {
    let format = match format {
        Format::Png => ImageFormat::Png,
        Format::Jpeg => ImageFormat::Jpeg,
        Format::WebP => ImageFormat::WebP,
        Format::Ktx2 | Format::Hdr | Format::Exr | Format::Ies => {
            return Err(ImportError::new(ErrorKind::Image, place, "not an 8 or 16 bit image"));
        }
    };
    Ok(ImageReader::with_format(Cursor::new(bytes), format))
}

fn decode_ldr(
    bytes: &[u8],
    format: Format,
    place: &str,
    limits: &Limits,
) -> Result<Image, ImportError> {
    let mut reader = reader(bytes, format, place)?;
    let mut allowed = ::image::Limits::no_limits();
    let most = limits.pixels.saturating_mul(8).saturating_add(1 << 20); // 16-bit RGBA
    allowed.max_alloc = Some(most.min(limits.memory.left()));
    reader.limits(allowed);
    let decoder = reader.into_decoder().map_err(|e| broken(place, &e))?;
    let (width, height) = decoder.dimensions();
    let size = checked_size(width, height, place, limits)?;
    let color = decoder.color_type();
    let n_channels = usize::from(color.channel_count());
    match usize::from(color.bytes_per_pixel()) / n_channels {
        1 => {
            let kept = kept(size, 4, place, limits)?;
            let (raw, _loan) = raw::<u8>(decoder, size, format, place, limits)?;
            let texels =
                if n_channels == 4 { raw } else { rgba(&raw, n_channels, u8::MAX, place)? };
            kept.keep();
            let has_alpha = texels.chunks_exact(4).any(|texel| texel[3] < u8::MAX);
            Ok(ldr(size, Pixels::Rgba8(texels), has_alpha))
        }
        2 => {
            let kept = kept(size, 8, place, limits)?;
            let (mut raw, _loan) = raw::<u16>(decoder, size, format, place, limits)?;
            for value in &mut raw {
                *value = f16::from_f32(f32::from(*value) / 65535.0).to_bits();
            }
            let texels =
                if n_channels == 4 { raw } else { rgba(&raw, n_channels, HALF_ONE, place)? };
            kept.keep();
            let has_alpha = texels.chunks_exact(4).any(|texel| texel[3] < HALF_ONE);
            Ok(ldr(size, Pixels::Rgba16F(texels), has_alpha))
        }
        _ => Err(broken(place, &"its channels have neither 8 nor 16 bits")),
    }
}

fn ldr([width, height]: [u32; 2], data: Pixels, has_alpha: bool) -> Image {
    Image { width, height, data, has_alpha, clamped: 0, is_radiance: false }
}

/// Grey, grey with alpha, or colour as colour with alpha.
fn rgba<T: bytemuck::Pod>(
    raw: &[T],
    n_channels: usize,
    one: T,
    place: &str,
) -> Result<Vec<T>, ImportError> {
    let mut texels: Vec<T> = zeroed(raw.len() / n_channels * 4, place)?;
    for (texel, channels) in texels.chunks_exact_mut(4).zip(raw.chunks_exact(n_channels)) {
        texel.copy_from_slice(&match *channels {
            [grey] => [grey, grey, grey, one],
            [grey, alpha] => [grey, grey, grey, alpha],
            [r, g, b] => [r, g, b, one],
            _ => [one; 4], // four channels are not converted
        });
    }
    Ok(texels)
}

/// Bits of the half float 1; bits of positive half floats are ordered like their values.
const HALF_ONE: u16 = 0x3c00;

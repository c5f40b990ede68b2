//! Image files become texels: 8 bits a channel where the file has no more, half floats otherwise.
//!
//! PNG and JPEG with 8 bits keep their bytes; PNG with 16 bits becomes half floats of `value /
//! 65535` (11 significant bits, which is more than any texture lookup needs). Neither is converted:
//! the numbers stay in the encoding of the file, sRGB or linear, which only the scene knows. HDR
//! and EXR are linear by definition and become half floats; brighter texels are clamped and counted.
//!
//! The format is recognised by the first bytes, never by the name. Width and height are checked
//! against the limit before any texel is decoded.

mod environment;
mod exr;
mod guard;
mod hdr;

use super::budget::{Loan, no_memory, zeroed};
use super::error::{ErrorKind, ImportError};
use super::file::{Limits, read_file};
use ::image::{ImageDecoder, ImageFormat, ImageReader};
pub use environment::{Environment, load_environment};

use files::ShowPath as _;
use half::f16;
use std::io::Cursor;
use std::path::Path;

/// A decoded image. Row 0 is the top row (v = 1); rows follow without gaps; alpha is straight.
#[derive(Clone, Debug, PartialEq)]
pub struct Image {
    /// Columns, >= 1.
    pub width: u32,
    /// Rows, >= 1.
    pub height: u32,
    /// `width * height` texels of red, green, blue, alpha.
    pub data: Pixels,
    /// Some texel has an alpha below 1.
    pub has_alpha: bool,
    /// Channels that were clamped because they were not finite or beyond what a half float holds.
    pub clamped: u64,
    /// The file holds radiance: it is HDR or EXR.
    pub is_radiance: bool,
}

/// Texels, four channels each.
#[derive(Clone, Debug, PartialEq)]
pub enum Pixels {
    /// Bytes, in the encoding of the file.
    Rgba8(Vec<u8>),
    /// Bits of half floats; finite. Linear for HDR and EXR, in the encoding of the file for PNG.
    Rgba16F(Vec<u16>),
}

/// Reads one image file.
pub fn load_image(path: &Path, limits: &Limits) -> Result<Image, ImportError> {
    let (bytes, _loan) = read_file(path, limits)?;
    decode_image(&bytes, &path.shown().to_string(), limits)
}

/// Formats that are read, by their first bytes.
#[derive(Clone, Copy, PartialEq)]
enum Format {
    Png,
    Jpeg,
    Hdr,
    Exr,
}

/// Decodes an image in memory; `place` is named in errors.
pub fn decode_image(bytes: &[u8], place: &str, limits: &Limits) -> Result<Image, ImportError> {
    guard::quietly(|| match recognise(bytes, place)? {
        Format::Exr => exr::decode(bytes, place, limits, 1.0).map(HalfImage::finish),
        Format::Hdr => hdr::decode(bytes, place, limits, 1.0).map(HalfImage::finish),
        format => decode_ldr(bytes, format, place, limits),
    })
    .unwrap_or_else(|| Err(gave_up(place)))
}

/// Width and height that an image in memory claims, checked against the limit.
pub(super) fn size(bytes: &[u8], place: &str, limits: &Limits) -> Result<[u32; 2], ImportError> {
    guard::quietly(|| match recognise(bytes, place)? {
        Format::Exr => exr::size(bytes, place, limits),
        Format::Hdr => hdr::size(bytes, place, limits),
        format => {
            let decoder = reader(bytes, format, place)?;
            let (width, height) = decoder.into_dimensions().map_err(|e| broken(place, &e))?;
            checked_size(width, height, place, limits)
        }
    })
    .unwrap_or_else(|| Err(gave_up(place)))
}

fn gave_up(place: &str) -> ImportError {
    ImportError::new(ErrorKind::Image, place, "the image is damaged: its decoder gave up")
        .with_help("open it and save it again with an image editor")
}

fn recognise(bytes: &[u8], place: &str) -> Result<Format, ImportError> {
    const KNOWN: [(&[u8], Format); 4] = [
        (b"\x89PNG\r\n\x1a\n", Format::Png),
        (b"\xff\xd8\xff", Format::Jpeg),
        (b"#?", Format::Hdr),
        (b"\x76\x2f\x31\x01", Format::Exr),
    ];
    const OTHERS: [(&[u8], &str); 9] = [
        (b"RIFF", "WebP"),
        (b"GIF8", "GIF"),
        (b"BM", "BMP"),
        (b"II*\0", "TIFF"),
        (b"MM\0*", "TIFF"),
        (b"DDS ", "DDS"),
        (b"\xabKTX", "KTX"),
        (b"8BPS", "Photoshop"),
        (b"qoif", "QOI"),
    ];
    if let Some((_, format)) = KNOWN.iter().find(|(magic, _)| bytes.starts_with(magic)) {
        return Ok(*format);
    }
    let other = OTHERS.iter().find(|(magic, _)| bytes.starts_with(magic));
    let message = match other {
        Some((_, name)) => format!("this is a {name} image; images are PNG, JPEG, HDR or EXR"),
        None if bytes.is_empty() => "the file is empty".to_owned(),
        // Nothing of it is shown: a scene may name any file of its reader.
        None => "this is not a PNG, JPEG, HDR or EXR image".to_owned(),
    };
    Err(ImportError::new(ErrorKind::Image, place, message).with_help("convert it to PNG or EXR"))
}

/// `width` and `height` if they are not zero and within the limit.
fn checked_size(
    width: u32,
    height: u32,
    place: &str,
    limits: &Limits,
) -> Result<[u32; 2], ImportError> {
    let n_pixels = u64::from(width) * u64::from(height);
    if n_pixels == 0 {
        return Err(ImportError::new(ErrorKind::Image, place, "the image has no pixels"));
    }
    if n_pixels > limits.pixels {
        let max = limits.pixels;
        let message = format!("the image claims {width} x {height} pixels, the limit is {max}");
        return Err(ImportError::new(ErrorKind::Limit, place, message)
            .with_help("scale it down, or cut it into several images"));
    }
    Ok([width, height])
}

fn broken(place: &str, error: &dyn std::fmt::Display) -> ImportError {
    let text = error.to_string();
    let text = text.lines().next().unwrap_or_default();
    ImportError::new(ErrorKind::Image, place, format!("the image is damaged or cut off: {text}"))
}

fn reader<'a>(
    bytes: &'a [u8],
    format: Format,
    place: &str,
) -> Result<ImageReader<Cursor<&'a [u8]>>, ImportError> {
    let format = match format {
        Format::Png => ImageFormat::Png,
        Format::Jpeg => ImageFormat::Jpeg,
        Format::Hdr | Format::Exr => {
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

fn n_pixels([width, height]: [u32; 2]) -> usize {
    width as usize * height as usize
}

/// Memory for texels of `bytes` each: those of the image, and those that the pack gets.
fn kept(size: [u32; 2], bytes: u64, place: &str, limits: &Limits) -> Result<Loan, ImportError> {
    limits.memory.take((n_pixels(size) as u64).saturating_mul(2 * bytes), place)
}

/// The channels as they are in the file, and the memory that decoding takes.
fn raw<T: bytemuck::Pod>(
    decoder: impl ImageDecoder,
    size: [u32; 2],
    format: Format,
    place: &str,
    limits: &Limits,
) -> Result<(Vec<T>, Loan), ImportError> {
    let n_bytes = decoder.total_bytes();
    // A progressive JPEG keeps its coefficients, 16 bits each, up to four a pixel, until its end.
    let more = if format == Format::Jpeg { 8 * n_pixels(size) as u64 } else { 0 };
    let loan = limits.memory.take(n_bytes.saturating_add(more), place)?;
    let n = usize::try_from(n_bytes).unwrap_or(usize::MAX) / size_of::<T>();
    let mut values: Vec<T> = zeroed(n, place)?;
    decoder.read_image(bytemuck::cast_slice_mut(&mut values)).map_err(|e| broken(place, &e))?;
    Ok((values, loan))
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

/// Collects linear float texels as half floats.
struct HalfImage {
    size: [u32; 2],
    texels: Vec<u16>,
    has_alpha: bool,
    clamped: u64,
    /// The largest finite colour channel, and the first that is negative or not finite, with its texel.
    largest: f32,
    bad: Option<(usize, f32)>,
}

impl HalfImage {
    /// All texels transparent black; no texels where there is no memory for them.
    fn new(size: [u32; 2]) -> Self {
        Self {
            size,
            texels: zeroed(4 * n_pixels(size), "").unwrap_or_default(),
            has_alpha: false,
            clamped: 0,
            largest: 0.0,
            bad: None,
        }
    }

    /// Sets one texel; a position outside is ignored.
    fn set(&mut self, texel_idx: usize, rgba: [f32; 4]) {
        for value in &rgba[..3] {
            if *value >= 0.0 && value.is_finite() {
                self.largest = self.largest.max(*value);
            } else if self.bad.is_none_or(|(first, _)| texel_idx < first) {
                self.bad = Some((texel_idx, *value));
            }
        }
        let mut bits = [0; 4];
        for (bits, value) in bits.iter_mut().zip(rgba) {
            let (half, fits) = to_half(value);
            *bits = half;
            self.clamped += u64::from(!fits);
        }
        self.has_alpha |= rgba[3] < 1.0;
        if let Some(texel) = self.texels.get_mut(4 * texel_idx..4 * texel_idx + 4) {
            texel.copy_from_slice(&bits);
        }
    }

    /// Whether it has its texels.
    fn check(self, place: &str) -> Result<Self, ImportError> {
        let n = 4 * n_pixels(self.size);
        if self.texels.len() == n { Ok(self) } else { Err(no_memory(2 * n, place)) }
    }

    fn finish(self) -> Image {
        Image {
            width: self.size[0],
            height: self.size[1],
            data: Pixels::Rgba16F(self.texels),
            has_alpha: self.has_alpha,
            clamped: self.clamped,
            is_radiance: true,
        }
    }
}

/// Bits of the nearest finite half float, and whether the value was within range. NaN becomes 0.
fn to_half(value: f32) -> (u16, bool) {
    const MAX: f32 = 65504.0;
    if value.is_nan() {
        return (0, false);
    }
    (f16::from_f32(value.clamp(-MAX, MAX)).to_bits(), value.abs() <= MAX)
}

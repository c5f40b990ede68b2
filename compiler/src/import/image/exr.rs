//! OpenEXR becomes half floats: the first flat layer with R, G, B (and A), else one with Y.
//!
//! The data window is the image; the display window does not matter to a texture. Alpha is
//! associated (premultiplied) in EXR and straight here, so colour is divided by it where it is
//! between 0 and 1.

use super::format::{broken, checked_size, kept};
use super::texels::HalfImage;
use crate::import::error::{ErrorKind, ImportError};
use crate::import::file::Limits;
use ::exr::image::read::image::ReadLayers as _;
use ::exr::image::read::layers::ReadChannels as _;
use ::exr::image::read::specific_channels::ReadSpecificChannel as _;
use ::exr::math::Vec2;
use ::exr::meta::header::Header;
use ::exr::meta::{BlockDescription, MetaData};
use std::io::Cursor;

/// What the chosen layer has.
#[derive(Clone, Copy)]
enum Layer {
    Rgb,
    Luminance,
}

/// Width and height of the chosen layer, within the limit.
pub(super) fn size(bytes: &[u8], place: &str, limits: &Limits) -> Result<[u32; 2], ImportError> {
    choose(bytes, place, limits).map(|(_, size)| size)
}

/// Decodes the chosen layer, its colours times `scale`.
pub(super) fn decode(
    bytes: &[u8],
    place: &str,
    limits: &Limits,
    scale: f32,
) -> Result<HalfImage, ImportError> {
    let (layer, size) = choose(bytes, place, limits)?;
    let kept = kept(size, 8, place, limits)?;
    let _loan = limits.memory.take(block_bytes(bytes, place)?, place)?;
    let set = move |image: &mut HalfImage, at: Vec2<usize>, [r, g, b, a]: [f32; 4]| {
        let straight = if a > 0.0 && a < 1.0 { a / scale } else { 1.0 / scale };
        let texel_idx = at.1 * image.size[0] as usize + at.0;
        image.set(texel_idx, [r / straight, g / straight, b / straight, a]);
    };
    let read = ::exr::image::read::read().no_deep_data().largest_resolution_level();
    let source = Cursor::new(bytes);
    let image = match layer {
        Layer::Rgb => read
            .rgba_channels(
                create,
                move |image: &mut HalfImage, at, (r, g, b, a): (f32, f32, f32, f32)| {
                    set(image, at, [r, g, b, a]);
                },
            )
            .first_valid_layer()
            .all_attributes()
            .non_parallel()
            .from_buffered(source)
            .map(|image| image.layer_data.channel_data.pixels),
        Layer::Luminance => read
            .specific_channels()
            .required("Y")
            .optional("A", 1.0_f32)
            .collect_pixels(create, move |image: &mut HalfImage, at, (y, a): (f32, f32)| {
                set(image, at, [y, y, y, a]);
            })
            .first_valid_layer()
            .all_attributes()
            .non_parallel()
            .from_buffered(source)
            .map(|image| image.layer_data.channel_data.pixels),
    };
    let image = image.map_err(|e| broken(place, &e))?;
    if image.size != size {
        let message = "the size of the layer differs from its header";
        return Err(ImportError::new(ErrorKind::Image, place, message));
    }
    let image = image.check(place)?;
    kept.keep();
    Ok(image)
}

/// The most that a block takes while it is decoded: as it is in the file, unpacked, and in between.
fn block_bytes(bytes: &[u8], place: &str) -> Result<u64, ImportError> {
    let meta = MetaData::read_from_buffered(Cursor::new(bytes), false);
    let meta = meta.map_err(|e| broken(place, &e))?;
    let of = |header: &Header| {
        let texels = match header.blocks {
            BlockDescription::ScanLines => {
                header.layer_size.0.saturating_mul(header.compression.scan_lines_per_block())
            }
            BlockDescription::Tiles(tiles) => tiles.tile_size.0.saturating_mul(tiles.tile_size.1),
        };
        let channels = header.channels.list.iter();
        let texel: usize = channels.map(|channel| channel.sample_type.bytes_per_sample()).sum();
        (texels as u64).saturating_mul(texel as u64).saturating_mul(3)
    };
    Ok(meta.headers.iter().map(of).max().unwrap_or_default())
}

/// Memory for a layer; `choose` has checked the size of every layer against the limit.
fn create<Channels>(size: Vec2<usize>, _: &Channels) -> HalfImage {
    let side = |n: usize| u32::try_from(n).unwrap_or_default();
    HalfImage::new([side(size.0), side(size.1)])
}

fn choose(bytes: &[u8], place: &str, limits: &Limits) -> Result<(Layer, [u32; 2]), ImportError> {
    let meta = MetaData::read_from_buffered(Cursor::new(bytes), false);
    let meta = meta.map_err(|e| broken(place, &e))?;
    let dims = |header: &Header| {
        let fit = |side: usize| u32::try_from(side).unwrap_or(u32::MAX);
        checked_size(fit(header.layer_size.0), fit(header.layer_size.1), place, limits)
    };
    for header in &meta.headers {
        dims(header)?;
    }
    let has = |header: &Header, wanted: &str| {
        !header.deep && header.channels.list.iter().any(|channel| channel.name.eq(wanted))
    };
    let rgb = meta.headers.iter().find(|h| ["R", "G", "B"].iter().all(|name| has(h, name)));
    if let Some(header) = rgb {
        return Ok((Layer::Rgb, dims(header)?));
    }
    if let Some(header) = meta.headers.iter().find(|h| has(h, "Y")) {
        return Ok((Layer::Luminance, dims(header)?));
    }
    let message = "no flat layer has the channels R, G, B or the channel Y";
    Err(ImportError::new(ErrorKind::Image, place, message)
        .with_help("export a layer named R, G, B without a prefix"))
}

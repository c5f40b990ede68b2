//! A picture → its file, some rows at a time, so that it need not be in memory as a whole.

use super::{channels, header};
use crate::output::picture::{OutputError, Picture};
use crate::output::survey::Survey;
use ::exr::block::writer::ChunksWriter as _;
use ::exr::block::{BlockIndex, UncompressedBlock, enumerate_ordered_header_block_indices};
use ::exr::error::{Error, UnitResult};
use ::exr::meta::MetaData;
use ::exr::prelude::{AnyChannels, FlatSamples};
use std::io::{Seek, Write};
use std::ops::Range;

type Channels = AnyChannels<FlatSamples>;

/// About how many pixels are made channels of at a time.
const PIXELS: u32 = 1 << 18;
/// Rows that are compressed together.
const BLOCK: u32 = 16;

/// Rows of a picture that are read or written together; they begin at multiples of 16.
pub(crate) fn bands(width: u32, height: u32) -> impl Iterator<Item = Range<u32>> {
    let step = (PIXELS / width.max(1) / BLOCK).max(1) * BLOCK;
    (0..height.div_ceil(step)).map(move |i| i * step..((i + 1) * step).min(height))
}

/// Writes the file of a picture of which `head` and `survey` are known; `rows` are asked for once and in order.
/// `residual` as for `encode`.
pub(crate) fn write<E: From<OutputError>>(
    out: impl Write + Seek,
    (head, survey): (&Picture, &Survey),
    residual: bool,
    mut rows: impl FnMut(&Range<u32>) -> Result<Picture, E>,
) -> Result<(), E> {
    let headers = header::headers(head, survey, channels::of(head, survey, residual));
    let mut failed = None;
    let written = ::exr::block::write(out, headers, true, |meta, file| {
        let mut channels = |band: &Range<u32>| match rows(band) {
            Ok(picture) => Ok(channels::of(&picture, survey, residual)),
            Err(error) => {
                failed = Some(error);
                Err(Error::Aborted)
            }
        };
        // Threads of its own: those of the pool may be rendering.
        if let Some(mut packer) = file.parallel_blocks_compressor(&meta) {
            let add = |i, block| packer.add_block_to_compression_queue(i, block);
            return each_block(&meta, &mut channels, add);
        }
        let mut packer = file.sequential_blocks_compressor(&meta);
        each_block(&meta, &mut channels, |i, block| packer.compress_block(i, block))
    });
    match failed {
        Some(error) => Err(error),
        None => Ok(written.map_err(|error| OutputError::Encode { message: error.to_string() })?),
    }
}

/// Gives every block and its number to `add`, in order.
fn each_block(
    meta: &MetaData,
    channels: &mut dyn FnMut(&Range<u32>) -> Result<Channels, Error>,
    mut add: impl FnMut(usize, UncompressedBlock) -> UnitResult,
) -> UnitResult {
    let size = meta.headers[0].layer_size;
    let size = [size.x(), size.y()].map(|n| u32::try_from(n).unwrap_or(u32::MAX));
    let mut blocks = enumerate_ordered_header_block_indices(&meta.headers);
    for band in bands(size[0], size[1]) {
        let channels = channels(&band)?;
        let count = (band.end - band.start).div_ceil(BLOCK) as usize;
        for (i, index) in blocks.by_ref().take(count) {
            add(i, block(meta, (&channels, &band), index))?;
        }
    }
    Ok(())
}

/// The bytes of a block, from the channels of the band that it lies in.
fn block(
    meta: &MetaData,
    (channels, band): (&Channels, &Range<u32>),
    index: BlockIndex,
) -> UncompressedBlock {
    let list = &meta.headers[index.layer].channels;
    UncompressedBlock::from_lines(list, index, |line| {
        let row = line.location.position.y() - band.start as usize;
        let from = row * line.location.sample_count + line.location.position.x();
        let bytes = line.value.chunks_exact_mut(size_of::<f32>());
        match &channels.list[line.location.channel].sample_data {
            FlatSamples::F32(values) => {
                bytes.zip(&values[from..]).for_each(|(to, x)| to.copy_from_slice(&x.to_ne_bytes()));
            }
            FlatSamples::U32(values) => {
                bytes.zip(&values[from..]).for_each(|(to, n)| to.copy_from_slice(&n.to_ne_bytes()));
            }
            FlatSamples::F16(_) => unreachable!("all channels have 32 bits"),
        }
    })
}

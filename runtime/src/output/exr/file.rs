//! A file → its header, and the rows that are asked for. It is open only while something is read of it.

use super::channels::{self, Rows};
use super::header;
use super::names::VARIANCE;
use crate::film::Film;
use crate::output::picture::{OutputError, Picture};
use crate::output::planes;
use ::exr::block::reader::ChunksReader as _;
use ::exr::block::{BlockIndex, UncompressedBlock};
use ::exr::meta::MetaData;
use ::exr::meta::header::Header;
use ::exr::prelude::attribute::{ChannelDescription, SampleType};
use ::exr::prelude::{FlatSamples, Vec2};
use std::fs::File;
use std::io::BufReader;
use std::ops::Range;
use std::path::{Path, PathBuf};
use std::time::SystemTime;

/// Bytes that one byte can stand for: deflate stores at most 1032, the other lossless compressions less.
const MOST_DEFLATED: u64 = 1032;

/// A picture that `rtr` wrote.
#[derive(Debug)]
pub struct ExrFile {
    path: PathBuf,
    header: Header,
    /// Number of the header.
    layer: usize,
    head: Picture,
    /// What tells that it is another file by now.
    stamp: (u64, Option<SystemTime>),
}

impl ExrFile {
    /// Reads the header. Before memory is taken for pixels, it is known whether the file can hold those that it claims,
    /// and holds them without loss: sums are to be gone on with, and decoders of what is lossy are the ones that
    /// damaged files confuse.
    pub fn open(path: &Path) -> Result<Self, OutputError> {
        let file = files::open_regular(path).map_err(OutputError::Open)?;
        let stamp = stamp(&file, path)?;
        let reader = ::exr::block::read(BufReader::new(file), false);
        let meta = reader.map_err(|error| unreadable(path, &error))?.into_meta_data();
        check_claims(path, &meta, stamp.0)?;
        let foreign = |message: String| OutputError::Foreign { path: path.to_owned(), message };
        let flat = |header: &Header| !header.deep && header.channels.list.iter().all(is_full);
        let Some(layer) = meta.headers.iter().position(flat) else {
            return Err(foreign("it has no layer of plain pixels".to_owned()));
        };
        let header = meta.headers[layer].clone();
        let mut head = header::parse(&header).map_err(foreign)?;
        let rows = Rows { planes: blank(&header, 0), header: &header };
        head.layers = planes::head(&rows).map_err(foreign)?;
        // What is missing is missing in every row.
        channels::parse(&head, head.film.clone(), &rows).map_err(foreign)?;
        Ok(Self { path: path.to_owned(), header, layer, head, stamp })
    }

    /// The picture without its pixels.
    #[must_use]
    pub fn head(&self) -> &Picture {
        &self.head
    }

    /// Whether its pixels have a variance.
    #[must_use]
    pub fn has_variance(&self) -> bool {
        self.header.channels.list.iter().any(|channel| channel.name.eq(VARIANCE))
    }

    /// Bytes that all channels of a pixel take.
    #[must_use]
    pub fn bytes_per_pixel(&self) -> usize {
        self.header.channels.bytes_per_pixel
    }

    /// Some rows, counted from the first of the picture's region, without the names of mattes; by one thread.
    pub fn rows(&self, rows: &Range<u32>) -> Result<Picture, OutputError> {
        self.parse(rows, false)
    }

    /// All rows.
    pub fn read(&self) -> Result<Picture, OutputError> {
        let mut picture = self.parse(&(0..self.head.film.region.h), true)?;
        picture.take_names(&self.head);
        Ok(picture)
    }

    fn parse(&self, rows: &Range<u32>, is_alone: bool) -> Result<Picture, OutputError> {
        let foreign = |message: String| OutputError::Foreign { path: self.path.clone(), message };
        let head = &self.head.film;
        let film = Film::try_new(head.image_size, head.region.rows(rows));
        let mut film = film.map_err(|error| foreign(error.to_string()))?;
        film.ranges.clone_from(&head.ranges);
        film.counters = head.counters;
        let planes = self.planes(rows, is_alone)?;
        let rows = Rows { header: &self.header, planes };
        channels::parse(&self.head, film, &rows).map_err(foreign)
    }

    /// Every channel of some rows; `is_alone`: by as many threads as there are.
    fn planes(&self, rows: &Range<u32>, is_alone: bool) -> Result<Vec<FlatSamples>, OutputError> {
        let unreadable = |error: ::exr::error::Error| unreadable(&self.path, &error);
        let file = files::open_regular(&self.path).map_err(OutputError::Open)?;
        if stamp(&file, &self.path)? != self.stamp {
            return Err(self.damaged("it has changed since it was opened"));
        }
        let reader = ::exr::block::read(BufReader::new(file), false).map_err(unreadable)?;
        let rows = rows.start as usize..rows.end as usize;
        let wanted = |block: &BlockIndex| {
            let y = block.pixel_position.y()..block.pixel_position.y() + block.pixel_size.y();
            (block.layer, block.level) == (self.layer, Vec2(0, 0))
                && y.start < rows.end
                && rows.start < y.end
        };
        let chunks = reader.filter_chunks(false, |_, _, block| wanted(&block));
        let chunks = chunks.map_err(unreadable)?;
        let width = self.header.layer_size.x();
        let mut planes = blank(&self.header, width * rows.len());
        let (mut found, mut is_astray) = (0, false);
        let take = |_: &MetaData, block: UncompressedBlock| {
            is_astray |= !wanted(&block.index);
            if !is_astray {
                found += self.copy(&block, &rows, &mut planes);
            }
            Ok(())
        };
        let taken = if is_alone {
            chunks.decompress_parallel(false, take)
        } else {
            chunks.decompress_sequential(false, take)
        };
        taken.map_err(unreadable)?;
        if is_astray {
            return Err(self.damaged("a block lies elsewhere than the file says"));
        }
        if found != width * rows.len() * self.header.channels.list.len() {
            return Err(self.damaged("pixels are missing, or there twice"));
        }
        Ok(planes)
    }

    /// Copies those rows of a block that are wanted; returns how many values they had.
    fn copy(
        &self,
        block: &UncompressedBlock,
        rows: &Range<usize>,
        planes: &mut [FlatSamples],
    ) -> usize {
        let width = self.header.layer_size.x();
        let mut found = 0;
        for line in block.lines(&self.header.channels) {
            let at = line.location;
            if !rows.contains(&at.position.y()) {
                continue;
            }
            found += at.sample_count;
            let first = (at.position.y() - rows.start) * width + at.position.x();
            let words = line.value.as_chunks().0;
            match &mut planes[at.channel] {
                FlatSamples::F32(plane) => {
                    let to = plane[first..first + at.sample_count].iter_mut();
                    to.zip(words).for_each(|(x, bytes)| *x = f32::from_ne_bytes(*bytes));
                }
                FlatSamples::U32(plane) => {
                    let to = plane[first..first + at.sample_count].iter_mut();
                    to.zip(words).for_each(|(n, bytes)| *n = u32::from_ne_bytes(*bytes));
                }
                // Nobody asks for halves.
                FlatSamples::F16(_) => {}
            }
        }
        found
    }

    fn damaged(&self, message: &str) -> OutputError {
        OutputError::Read { path: self.path.clone(), message: message.to_owned() }
    }
}

/// Whether a channel has a value for every pixel.
fn is_full(channel: &ChannelDescription) -> bool {
    channel.sampling == Vec2(1, 1)
}

/// Channels of `n` pixels; none of those of halves, which nobody asks for.
fn blank(header: &Header, n: usize) -> Vec<FlatSamples> {
    let plane = |channel: &ChannelDescription| match channel.sample_type {
        SampleType::F32 => FlatSamples::F32(vec![0.0; n]),
        SampleType::U32 => FlatSamples::U32(vec![0; n]),
        SampleType::F16 => FlatSamples::F16(Vec::new()),
    };
    header.channels.list.iter().map(plane).collect()
}

fn unreadable(path: &Path, error: &::exr::error::Error) -> OutputError {
    OutputError::Read { path: path.to_owned(), message: error.to_string() }
}

fn stamp(file: &File, path: &Path) -> Result<(u64, Option<SystemTime>), OutputError> {
    let read = |error: std::io::Error| OutputError::Read {
        path: path.to_owned(),
        message: error.to_string(),
    };
    let metadata = file.metadata().map_err(read)?;
    Ok((metadata.len(), metadata.modified().ok()))
}

fn check_claims(path: &Path, meta: &MetaData, length: u64) -> Result<(), OutputError> {
    let read = |message: String| OutputError::Read { path: path.to_owned(), message };
    for header in &meta.headers {
        if header.compression.may_loose_data() {
            let message = format!("it is compressed with loss ({})", header.compression);
            return Err(OutputError::Foreign { path: path.to_owned(), message });
        }
        let [width, height] = [header.layer_size.x(), header.layer_size.y()];
        let bytes = [height, header.channels.bytes_per_pixel]
            .iter()
            .fold(width as u64, |product, factor| product.saturating_mul(*factor as u64));
        if bytes / MOST_DEFLATED > length {
            return Err(read(format!(
                "it claims {width}x{height} pixels, more than its {length} bytes can hold"
            )));
        }
    }
    Ok(())
}

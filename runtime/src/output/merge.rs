//! Parts of one picture → the picture: sums added in `f64`, ranges joined, crops put in their place.
//!
//! A part is some samples of some crop. What the parts make together is known from their headers; pixels come a few
//! rows at a time, so that neither the picture nor any of its parts need be in memory as a whole.

mod arrange;
mod error;

pub use self::arrange::Expected;
pub use self::error::{MergeError, Missing};

use self::arrange::{Tile, arrange};
use super::exr::{self, ExrFile};
use super::picture::{Meta, OutputError, Picture};
use super::survey::Survey;
use crate::film::Film;
use crate::region::Rect;
use crate::replicate::REPLICATES_U32;
use crate::zeros::zeros;
use rayon::prelude::*;
use std::io::{Seek, Write};
use std::ops::Range;

/// Where the pixels of a part come from.
pub trait Part: Sync {
    /// What is known of it before its pixels are.
    fn head(&self) -> Picture;
    /// Whether its pixels have a variance: then it is the mean of replicates.
    fn has_variance(&self) -> bool;
    /// Some rows, counted from the first of its region, without the names of mattes.
    fn rows(&self, rows: &Range<u32>) -> Result<Picture, OutputError>;
}

impl Part for Picture {
    fn head(&self) -> Picture {
        self.head()
    }

    fn has_variance(&self) -> bool {
        !self.film.variance.is_empty()
    }

    fn rows(&self, rows: &Range<u32>) -> Result<Picture, OutputError> {
        Ok(self.rows(rows))
    }
}

impl Part for ExrFile {
    fn head(&self) -> Picture {
        self.head().clone()
    }

    fn has_variance(&self) -> bool {
        self.has_variance()
    }

    fn rows(&self, rows: &Range<u32>) -> Result<Picture, OutputError> {
        self.rows(rows)
    }
}

/// Parts that are known to make one picture.
#[derive(Debug)]
pub struct Merge<P> {
    parts: Vec<P>,
    tiles: Vec<Tile>,
    head: Picture,
    has_variance: bool,
}

/// The picture of these parts, as [`Merge`] makes it.
pub fn merge(parts: Vec<Picture>) -> Result<Picture, MergeError> {
    let merge = Merge::new(parts, Expected::default())?;
    merge.read()
}

impl<P: Part> Merge<P> {
    /// Finds out what the parts are together. They must be of the same pack, size and seed, with crops that are equal or
    /// apart and, in each, disjoint sample ranges; all crops together must be a rectangle and have the same samples.
    /// Sums are taken by ascending first sample, so the order of the parts does not matter. What was denoised of them
    /// is no part of the whole. Crops of a measured run merge with each other, but not with other samples: what four
    /// replicates say of their variance is nothing that adds up.
    pub fn new(parts: Vec<P>, expected: Expected) -> Result<Self, MergeError> {
        let heads: Vec<Picture> = parts.iter().map(Part::head).collect();
        let arranged = arrange(&heads, expected)?;
        let has_variance = check_replicates(&parts, &arranged.tiles)?;
        let mut order = arranged.tiles.iter().flat_map(|tile| &tile.parts).map(|i| &heads[*i]);
        let mut head = order.next().ok_or(MergeError::Nothing)?.clone();
        head.denoised = None;
        for part in order {
            add_head(&mut head, part);
        }
        (head.film.region, head.film.ranges) = (arranged.region, arranged.ranges);
        if let Some(layers) = &mut head.layers {
            layers.samples = head.film.ranges.iter().map(|range| range.count()).sum();
        }
        Ok(Self { parts, tiles: arranged.tiles, head, has_variance })
    }

    /// The picture without its pixels.
    #[must_use]
    pub fn head(&self) -> &Picture {
        &self.head
    }

    /// All of the picture.
    pub fn read(&self) -> Result<Picture, MergeError> {
        let mut picture = self.rows(&(0..self.head.film.region.h))?;
        picture.take_names(&self.head);
        Ok(picture)
    }

    /// Some rows of the picture, counted from the first of its region, without the names of mattes.
    pub fn rows(&self, rows: &Range<u32>) -> Result<Picture, MergeError> {
        let region = self.head.film.region.rows(rows);
        let mut whole = self.head.clone();
        if let [tile] = self.tiles.as_slice() {
            let sum = self.sum(tile, rows)?;
            whole.film = of_all(&self.head.film, sum.film);
            whole.layers = sum.layers;
            return Ok(whole);
        }
        whole.film = of_all(&self.head.film, Film::try_new(self.head.film.image_size, region)?);
        if self.has_variance {
            whole.film.variance = zeros(region.pixels())?;
        }
        whole.layers = whole.layers.map(|layers| layers.blank(whole.film.sums.len()));
        for tile in &self.tiles {
            let first = region.y.max(tile.crop.y);
            let end = (region.y + region.h).min(tile.crop.y + tile.crop.h);
            if first >= end {
                continue;
            }
            let sum = self.sum(tile, &(first - tile.crop.y..end - tile.crop.y))?;
            whole.film.place(&sum.film);
            if let (Some(layers), Some(more)) = (&mut whole.layers, &sum.layers) {
                layers.place(region, more, sum.film.region);
            }
        }
        Ok(whole)
    }

    /// Gives all rows to `seen`, some at a time and in order.
    pub fn each(&self, mut seen: impl FnMut(&Picture)) -> Result<(), MergeError> {
        let Rect { w, h, .. } = self.head.film.region;
        exr::bands(w, h).try_for_each(|band| {
            seen(&self.rows(&band)?);
            Ok(())
        })
    }

    /// Writes the picture as an EXR that can be merged again. `seen` is given all rows, some at a time and in order.
    ///
    /// What the header says of all pixels must be known before the first of them is written, so parts with Cryptomatte
    /// or light groups are read twice.
    pub fn write_exr(
        &self,
        out: impl Write + Seek,
        mut seen: impl FnMut(&Picture),
    ) -> Result<(), MergeError> {
        let survey = if Survey::is_needed(&self.head) {
            let mut survey = Survey::default();
            self.each(|rows| survey.add(rows))?;
            survey
        } else {
            let samples: u32 = self.head.film.ranges.iter().map(|range| range.count()).sum();
            let replicates = if self.has_variance { REPLICATES_U32 } else { 1 };
            Survey::even(samples.saturating_mul(replicates), self.has_variance)
        };
        exr::write(out, (&self.head, &survey), true, |band| {
            let rows = self.rows(band)?;
            seen(&rows);
            Ok(rows)
        })
    }

    /// The sum of the parts of a tile in some of its rows.
    fn sum(&self, tile: &Tile, rows: &Range<u32>) -> Result<Picture, MergeError> {
        let mut whole: Option<Picture> = None;
        // So many are in memory at a time.
        for parts in tile.parts.chunks(host::threads().clamp(1, 4)) {
            let read = parts.par_iter().map(|i| (i + 1, self.parts[*i].rows(rows)));
            for (number, part) in read.collect::<Vec<_>>() {
                let part = part?;
                check_pixels(number, &part)?;
                match &mut whole {
                    Some(whole) => add(whole, &part),
                    None => whole = Some(part),
                }
            }
        }
        whole.ok_or(MergeError::Nothing)
    }
}

/// A film with the samples and counters of the whole picture.
fn of_all(head: &Film, film: Film) -> Film {
    Film { ranges: head.ranges.clone(), counters: head.counters, ..film }
}

/// Whether the parts are crops of a measured run. All must be, and none may be added to another.
fn check_replicates<P: Part>(parts: &[P], tiles: &[Tile]) -> Result<bool, MergeError> {
    let Some(first) = parts.iter().position(Part::has_variance) else { return Ok(false) };
    let part = first + 1;
    let alone = tiles.iter().all(|tile| tile.parts.len() == 1);
    let all = parts.iter().all(Part::has_variance);
    if alone && all { Ok(true) } else { Err(MergeError::Replicates { part }) }
}

/// Whether the pixels have as many samples as the header says.
fn check_pixels(part: usize, picture: &Picture) -> Result<(), MergeError> {
    let (least, most) = picture.film.samples();
    if least != most || most == 0 {
        return Err(MergeError::Uneven { part, least, most });
    }
    let said: u32 = picture.film.ranges.iter().map(|range| range.count()).sum();
    let said = said.saturating_mul(picture.film.replicates());
    if most != said {
        return Err(MergeError::Samples { part, found: most, said });
    }
    Ok(())
}

/// Adds a part of the same pixels, whose samples are later.
fn add(whole: &mut Picture, part: &Picture) {
    let sums = whole.film.sums.as_flattened_mut().iter_mut();
    sums.zip(part.film.sums.as_flattened()).for_each(|(sum, more)| *sum += more);
    let counts = whole.film.counts.iter_mut();
    counts.zip(&part.film.counts).for_each(|(count, more)| *count += more);
    if let (Some(layers), Some(more)) = (&mut whole.layers, &part.layers) {
        layers.add(more);
    }
}

/// Adds what is known of a part to what is known of the picture.
fn add_head(whole: &mut Picture, part: &Picture) {
    add_meta(&mut whole.meta, &part.meta);
    whole.film.counters.add(&part.film.counters);
    if let (Some(layers), Some(more)) = (&mut whole.layers, &part.layers) {
        layers.mattes.iter_mut().zip(&more.mattes).for_each(|(matte, more)| matte.add(more));
    }
}

fn add_meta(whole: &mut Meta, part: &Meta) {
    join(&mut whole.device, &part.device);
    join(&mut whole.commit, &part.commit);
    whole.seconds += part.seconds;
    whole.complete &= part.complete;
}

/// Adds a name to a list, unless it is there or empty.
fn join(list: &mut String, name: &str) {
    if name.is_empty() || list.split(" + ").any(|known| known == name) {
        return;
    }
    if !list.is_empty() {
        list.push_str(" + ");
    }
    list.push_str(name);
}

//! Heads of parts → the tiles that they make, and what is missing.

use super::error::{MergeError, Missing};
use crate::layers::Wanted;
use crate::output::identity::Identity;
use crate::output::picture::{Picture, ranges_text};
use crate::region::{Rect, SampleRange, insert_range};

/// What parts are to add up to; what is not said is found from the parts.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Expected {
    /// All samples of a pixel.
    pub samples: Option<SampleRange>,
    /// All pixels.
    pub crop: Option<Rect>,
}

/// Parts of the same pixels.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct Tile {
    pub(super) crop: Rect,
    /// Their samples together.
    ranges: Vec<SampleRange>,
    /// Their numbers from 0, by ascending first sample.
    pub(super) parts: Vec<usize>,
}

/// Tiles that have the same samples and are a rectangle together.
#[derive(Debug)]
pub(super) struct Arranged {
    pub(super) region: Rect,
    pub(super) ranges: Vec<SampleRange>,
    /// From the top left, row by row.
    pub(super) tiles: Vec<Tile>,
}

pub(super) fn arrange(heads: &[Picture], expected: Expected) -> Result<Arranged, MergeError> {
    let first = heads.first().ok_or(MergeError::Nothing)?;
    let size = first.film.image_size;
    if let Some(crop) = expected.crop.filter(|crop| !crop.fits(size)) {
        return Err(MergeError::Outside { crop, size });
    }
    let mut tiles: Vec<Tile> = Vec::new();
    for (i, head) in heads.iter().enumerate() {
        check_shared(i + 1, head, first)?;
        check_inside(i + 1, head, expected)?;
        take(&mut tiles, heads, i)?;
    }
    for tile in &mut tiles {
        tile.parts.sort_by_key(|part| heads[*part].film.ranges.first().copied());
    }
    tiles.sort_by_key(|tile| (tile.crop.y, tile.crop.x));
    let region = expected.crop.unwrap_or_else(|| bounds(&tiles));
    let ranges = expected.samples.map_or_else(|| union(&tiles), |samples| vec![samples]);
    let missing = missing(&tiles, region, &ranges, size);
    if !missing.is_empty() {
        return Err(MergeError::Missing(missing));
    }
    Ok(Arranged { region, ranges, tiles })
}

fn check_shared(part: usize, head: &Picture, first: &Picture) -> Result<(), MergeError> {
    let rows = Identity::of_picture(first).rows().into_iter();
    let rows = rows.zip(Identity::of_picture(head).rows());
    let layers = ("layers", layers_text(first), layers_text(head));
    let mut all = rows.map(|((what, a), (_, b))| (what, a, b)).chain([layers]);
    match all.find(|(what, expected, found)| *what != "crop" && expected != found) {
        Some((what, expected, found)) => Err(MergeError::Differs { part, what, found, expected }),
        None => Ok(()),
    }
}

/// What a picture holds beside radiance, as people read it.
fn layers_text(picture: &Picture) -> String {
    let Some(layers) = &picture.layers else { return "none".to_owned() };
    let Wanted { transparent, names, .. } = &layers.wanted;
    let sky = if *transparent { ", transparent" } else { "" };
    let groups: Vec<&str> = layers.lights.iter().map(|group| group.name.as_str()).collect();
    let groups =
        if groups.is_empty() { String::new() } else { format!(", groups {}", groups.join(" ")) };
    format!("{} ({}{sky}{groups})", layers.wanted.text(), names.name())
}

fn check_inside(part: usize, head: &Picture, expected: Expected) -> Result<(), MergeError> {
    let (ranges, found) = (&head.film.ranges, head.film.region);
    let beyond = |all: &SampleRange| {
        ranges.iter().any(|range| range.start < all.start || range.end > all.end)
    };
    if let Some(expected) = expected.samples.filter(beyond) {
        return Err(MergeError::MoreSamples { part, found: ranges_text(ranges), expected });
    }
    let leaves = |crop: &Rect| {
        let (is, may) = (end(found), end(*crop));
        found.x < crop.x || found.y < crop.y || is.0 > may.0 || is.1 > may.1
    };
    match expected.crop.filter(leaves) {
        Some(expected) => Err(MergeError::MorePixels { part, found, expected }),
        None => Ok(()),
    }
}

/// Adds part `i` to the tile of its crop.
fn take(tiles: &mut Vec<Tile>, heads: &[Picture], i: usize) -> Result<(), MergeError> {
    let film = &heads[i].film;
    let crop = film.region;
    if let Some(tile) = tiles.iter_mut().find(|tile| tile.crop == crop) {
        let before = tile.ranges.clone();
        if !film.ranges.iter().all(|range| insert_range(&mut tile.ranges, *range)) {
            let (found, expected) = (ranges_text(&film.ranges), ranges_text(&before));
            return Err(MergeError::Overlap { part: i + 1, found, expected });
        }
        tile.parts.push(i);
        return Ok(());
    }
    if let Some(tile) = tiles.iter().find(|tile| overlap(tile.crop, crop)) {
        let other = tile.parts.first().map_or(1, |part| part + 1);
        let (found, expected) = (crop, tile.crop);
        return Err(MergeError::Crops { part: i + 1, found, other, expected });
    }
    tiles.push(Tile { crop, ranges: film.ranges.clone(), parts: vec![i] });
    Ok(())
}

/// One past the last column and row.
fn end(rect: Rect) -> (u32, u32) {
    (rect.x.saturating_add(rect.w), rect.y.saturating_add(rect.h))
}

fn overlap(a: Rect, b: Rect) -> bool {
    a.x < end(b).0 && b.x < end(a).0 && a.y < end(b).1 && b.y < end(a).1
}

/// The least rectangle around all tiles.
fn bounds(tiles: &[Tile]) -> Rect {
    let least = |of: fn(Rect) -> u32| tiles.iter().map(|tile| of(tile.crop)).min().unwrap_or(0);
    let most = |of: fn(Rect) -> u32| tiles.iter().map(|tile| of(tile.crop)).max().unwrap_or(0);
    let (x, y) = (least(|crop| crop.x), least(|crop| crop.y));
    Rect { x, y, w: most(|crop| end(crop).0) - x, h: most(|crop| end(crop).1) - y }
}

/// All samples that any tile has.
fn union(tiles: &[Tile]) -> Vec<SampleRange> {
    let mut all: Vec<SampleRange> = tiles.iter().flat_map(|tile| tile.ranges.clone()).collect();
    all.sort();
    let mut joined: Vec<SampleRange> = Vec::new();
    for range in all {
        match joined.last_mut() {
            Some(last) if range.start <= last.end => last.end = last.end.max(range.end),
            _ => joined.push(range),
        }
    }
    joined
}

/// What no part has of these samples of these pixels: tile by tile, then what no tile covers.
fn missing(
    tiles: &[Tile],
    region: Rect,
    ranges: &[SampleRange],
    image_size: [u32; 2],
) -> Vec<Missing> {
    let whole = Rect::whole(image_size);
    let tiled = tiles.iter().flat_map(|tile| {
        ranges.iter().flat_map(|range| gaps(&tile.ranges, *range)).map(|range| (tile.crop, range))
    });
    let holes = holes(tiles, region);
    let holes = holes.iter().flat_map(|hole| ranges.iter().map(|range| (*hole, *range)));
    let all = tiled.chain(holes);
    all.map(|(crop, samples)| Missing { crop: (crop != whole).then_some(crop), samples }).collect()
}

/// Samples of `whole` that none of these ranges has, in order. The ranges are sorted and disjoint.
fn gaps(ranges: &[SampleRange], whole: SampleRange) -> Vec<SampleRange> {
    let mut gaps = Vec::new();
    let mut next = whole.start;
    for range in ranges {
        gaps.extend(SampleRange::new(next, range.start.min(whole.end)));
        next = next.max(range.end);
    }
    gaps.extend(SampleRange::new(next, whole.end));
    gaps
}

/// Rectangles of `region` that no tile covers. The tiles are disjoint and lie inside.
fn holes(tiles: &[Tile], region: Rect) -> Vec<Rect> {
    let covered: u64 = tiles.iter().map(|tile| tile.crop.pixels()).sum();
    if covered == region.pixels() {
        return Vec::new();
    }
    // Between neighbouring edges every row of pixels is the same.
    let mut edges: Vec<u32> =
        tiles.iter().flat_map(|tile| [tile.crop.y, end(tile.crop).1]).collect();
    edges.extend([region.y, end(region).1]);
    edges.sort_unstable();
    edges.dedup();
    let mut holes: Vec<Rect> = Vec::new();
    for pair in edges.windows(2) {
        let (y, h) = (pair[0], pair[1] - pair[0]);
        for (x, w) in holes_of_row(tiles, region, y) {
            // The same columns as above: one rectangle.
            let above = holes.iter_mut().find(|r| (r.x, r.w) == (x, w) && end(**r).1 == y);
            match above {
                Some(above) => above.h += h,
                None => holes.push(Rect { x, y, w, h }),
            }
        }
    }
    holes
}

/// Columns and widths of what no tile covers in a row of pixels.
fn holes_of_row(tiles: &[Tile], region: Rect, y: u32) -> Vec<(u32, u32)> {
    let crops = tiles.iter().map(|tile| tile.crop).filter(|crop| crop.y <= y && y < end(*crop).1);
    let mut columns: Vec<(u32, u32)> = crops.map(|crop| (crop.x, end(crop).0)).collect();
    columns.sort_unstable();
    columns.push((end(region).0, end(region).0));
    let mut next = region.x;
    let mut holes = Vec::new();
    for (from, to) in columns {
        if from > next {
            holes.push((next, from - next));
        }
        next = next.max(to);
    }
    holes
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::film::Film;
    use crate::output::Meta;

    const SIZE: [u32; 2] = [8, 6];

    fn head([x, y, w, h]: [u32; 4], (start, end): (u32, u32)) -> Picture {
        let mut film = Film::without_pixels(SIZE, Rect { x, y, w, h });
        film.ranges = vec![SampleRange { start, end }];
        Picture::new(film, Meta::default())
    }

    fn found(heads: &[Picture], expected: Expected) -> Result<(Rect, String), String> {
        let arranged = arrange(heads, expected).map_err(|error| error.to_string())?;
        Ok((arranged.region, ranges_text(&arranged.ranges)))
    }

    fn error(heads: &[Picture], expected: Expected) -> String {
        found(heads, expected).unwrap_err()
    }

    #[test]
    fn crops_and_samples_come_together_in_any_order() {
        let parts = [
            head([4, 0, 4, 6], (16, 32)),
            head([0, 0, 4, 2], (0, 32)),
            head([4, 0, 4, 6], (0, 16)),
            head([0, 2, 4, 4], (0, 32)),
        ];
        let whole = (Rect::whole(SIZE), "0..32".to_owned());
        assert_eq!(found(&parts, Expected::default()), Ok(whole));
        let arranged = arrange(&parts, Expected::default()).unwrap();
        let orders: Vec<_> = arranged.tiles.iter().map(|tile| tile.parts.clone()).collect();
        assert_eq!(orders, [vec![1], vec![2, 0], vec![3]]);
    }

    #[test]
    fn what_is_missing_is_named() {
        let mut parts = vec![head([0, 0, 4, 6], (0, 32)), head([4, 0, 4, 2], (0, 16))];
        assert_eq!(
            error(&parts, Expected::default()),
            "samples 16..32 of crop 4,0,4,2, 0..32 of crop 4,2,4,4 are missing"
        );
        parts.truncate(1);
        let crop = Some(Rect::whole(SIZE));
        let samples = SampleRange::new(0, 32);
        let half = "samples 0..32 of crop 4,0,4,6 are missing";
        assert_eq!(error(&parts, Expected { samples, crop }), half);
        let left = (Rect { x: 0, y: 0, w: 4, h: 6 }, "0..32".to_owned());
        assert_eq!(found(&parts, Expected { samples, crop: None }), Ok(left));
        let whole = [head([0, 0, 8, 6], (8, 16))];
        let ends = "samples 0..8, 16..32 are missing";
        assert_eq!(error(&whole, Expected { samples, crop }), ends);
    }

    #[test]
    fn what_is_too_much_is_named() {
        let parts = [head([0, 0, 4, 6], (0, 32)), head([2, 0, 6, 6], (0, 32))];
        assert_eq!(
            error(&parts, Expected::default()),
            "part 2: crop 2,0,6,6 overlaps crop 0,0,4,6 of part 1; crops must be equal or apart"
        );
        let twice = [head([0, 0, 8, 6], (0, 32)), head([0, 0, 8, 6], (16, 48))];
        let text = error(&twice, Expected::default());
        assert_eq!(text, "part 2: samples 16..48 overlap 0..32 of the parts before it");
        let samples = SampleRange::new(0, 16);
        let text = error(&parts[..1], Expected { samples, crop: None });
        assert_eq!(text, "part 1: it has samples 0..32, more than 0..16");
        let crop = Some(Rect { x: 0, y: 0, w: 4, h: 4 });
        let text = error(&parts[..1], Expected { samples: None, crop });
        assert_eq!(text, "part 1: its crop 0,0,4,6 leaves 0,0,4,4");
        let crop = Some(Rect { x: 4, y: 0, w: 5, h: 4 });
        let text = error(&parts[..1], Expected { samples: None, crop });
        assert_eq!(text, "crop 4,0,5,4 leaves the image of 8x6 pixels");
    }

    #[test]
    fn a_hole_in_the_middle_is_one_rectangle() {
        let ring = [
            head([0, 0, 8, 2], (0, 16)),
            head([0, 2, 3, 1], (0, 16)),
            head([0, 3, 3, 1], (0, 16)),
            head([5, 2, 3, 2], (0, 16)),
            head([0, 4, 8, 2], (0, 16)),
        ];
        let text = error(&ring, Expected::default());
        assert_eq!(text, "samples 0..16 of crop 3,2,2,2 are missing");
    }
}

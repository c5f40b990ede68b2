//! Planes of a picture, row by row: where rows are in them, and parts of a picture that are put in their place.

use crate::region::Rect;
use std::ops::Range;

/// Where the pixels of some rows are in a plane so many pixels wide.
pub(crate) fn pixels(width: u32, rows: &Range<u32>) -> Range<usize> {
    let width = width as usize;
    rows.start as usize * width..rows.end as usize * width
}

/// Copies the plane of a part of a picture, row by row, into its place in that of the whole. Neither, if the part has
/// none.
pub(crate) fn place<T: Clone>((whole, region): (&mut [T], Rect), (part, of): (&[T], Rect)) {
    let (width, row) = (region.w as usize, of.w as usize);
    let first = (of.y - region.y) as usize * width + (of.x - region.x) as usize;
    for (i, from) in part.chunks_exact(row.max(1)).enumerate() {
        let at = first + i * width;
        whole[at..at + row].clone_from_slice(from);
    }
}

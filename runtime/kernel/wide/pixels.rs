//! The pixels of a tile in the order in which lanes take them.
//!
//! Turns the size of a tile into squares of as many pixels as there are lanes, row by row: neighbours are rendered
//! together, so that their rays stay together. It does not know what is rendered.

use crate::kernel::v;
use crate::target;

/// A square has so many columns.
const COLUMNS: u32 = 4;
const ROWS: u32 = LANES / COLUMNS;
#[expect(clippy::cast_possible_truncation, reason = "eight or sixteen")]
const LANES: u32 = v::LANES as u32;

/// Pixels that no lane has taken.
#[derive(Debug)]
pub(crate) struct Pixels {
    /// Columns and rows of pixels.
    size: [u32; 2],
    /// Squares in a row.
    across: u32,
    /// The next place, and how many there are, those of cut squares outside of the tile included.
    next: u32,
    end: u32,
}

impl Pixels {
    /// All of a tile of `size` columns and rows.
    pub(crate) fn of_tile(size: [u32; 2]) -> Self {
        let across = size[0].div_ceil(COLUMNS);
        let end = across * size[1].div_ceil(ROWS) * COLUMNS * ROWS;
        Self { size, across, next: 0, end }
    }

    /// A pixel for each lane of `mask`, while there are any: the lanes that have one, and their pixels; other lanes keep
    /// that of `old`.
    #[target]
    pub(crate) fn take(&mut self, mask: v::B, old: v::V2<v::U>) -> (v::B, v::V2<v::U>) {
        let (mut x, mut y) = (v::u_to(old.x), v::u_to(old.y));
        let mut taken = [false; v::LANES];
        let mut left = v::bits(mask);
        while left != 0 {
            let lane = left.trailing_zeros() as usize % v::LANES;
            left &= left - 1;
            let Some([column, row]) = self.next() else { break };
            (x[lane], y[lane], taken[lane]) = (column, row, true);
        }
        (v::b_of(taken), v::V2 { x: v::u_of(x), y: v::u_of(y) })
    }

    fn next(&mut self) -> Option<[u32; 2]> {
        while self.next < self.end {
            let (square, within) = (self.next / LANES, self.next % LANES);
            self.next += 1;
            let x = square % self.across * COLUMNS + within % COLUMNS;
            let y = square / self.across * ROWS + within / COLUMNS;
            if x < self.size[0] && y < self.size[1] {
                return Some([x, y]);
            }
        }
        None
    }
}

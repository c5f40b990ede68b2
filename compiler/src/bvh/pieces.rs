//! How pieces of triangles came to be, and their boxes again.
//!
//! Turns primitives and the list of their splits into fragments: piece `n + k` is the upper part that
//! split `k` cut off. Whatever the list says, the pieces of a triangle cover it, because every split
//! makes two parts that cover what was split: a list from an untrusted file can make a tree bad, but
//! not wrong.

use super::check::TreeFault;
use super::clip::{Plane, clip};
use super::fragment::Fragment;
use super::input::Corners;
use pack::abi::NONE;

/// A piece is cut in two: the lower part keeps its number, the upper part gets the next one.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Split {
    /// Which piece is cut.
    pub piece: u32,
    /// 0 x, 1 y, 2 z.
    pub axis: u32,
    /// Where along the axis.
    pub at: f32,
}

impl Split {
    /// A place at which nothing happened.
    pub(super) const UNUSED: Self = Self { piece: NONE, axis: 0, at: 0.0 };

    pub(super) fn new(piece: u32, plane: Plane) -> Self {
        let axis = u32::try_from(plane.axis).expect("0, 1 or 2");
        Self { piece, axis, at: plane.at }
    }
}

/// Takes unused places out; renumbers `order` and the splits themselves.
pub(super) fn compact(splits: &mut Vec<Split>, order: &mut [u32], n: usize) {
    if splits.iter().all(|split| split.piece == NONE) {
        splits.clear();
        return;
    }
    let first = u32::try_from(n).expect("at most 2^27 primitives");
    let mut number = first;
    let numbers: Vec<u32> = splits
        .iter()
        .map(|split| {
            let own = number;
            number += u32::from(split.piece != NONE);
            own
        })
        .collect();
    let renumber = |piece: &mut u32| {
        if *piece >= first {
            *piece = numbers[(*piece - first) as usize];
        }
    };
    order.iter_mut().for_each(renumber);
    splits.retain(|split| split.piece != NONE);
    for split in splits {
        renumber(&mut split.piece);
    }
}

/// The primitive of every piece beyond the first `n`, which are the primitives themselves.
pub(super) fn owners(splits: &[Split], n: usize) -> Vec<u32> {
    let mut owners: Vec<u32> = Vec::with_capacity(splits.len());
    for split in splits {
        let piece = split.piece as usize;
        owners.push(if piece < n { split.piece } else { owners[piece - n] });
    }
    owners
}

/// Cuts `fragments` as `splits` say and appends the new pieces.
pub(super) fn replay(
    fragments: &mut Vec<Fragment>,
    splits: &[Split],
    corners: Corners,
) -> Result<(), TreeFault> {
    for split in splits {
        let piece = split.piece as usize;
        if piece >= fragments.len() || split.axis > 2 || !split.at.is_finite() {
            return Err(TreeFault::Split);
        }
        let whole = fragments[piece];
        let plane = Plane { axis: split.axis as usize, at: split.at };
        let crosses =
            whole.bounds().lo[plane.axis] < plane.at && plane.at < whole.bounds().hi[plane.axis];
        if whole.is_whole() || !crosses {
            return Err(TreeFault::Split);
        }
        let halves = clip(&whole, corners.of(&whole), plane).ok_or(TreeFault::Split)?;
        let number = u32::try_from(fragments.len()).map_err(|_| TreeFault::Split)?;
        fragments[piece] = halves[0];
        fragments.push(halves[1].with_piece(number));
    }
    Ok(())
}

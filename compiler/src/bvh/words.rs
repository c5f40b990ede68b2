//! Arithmetic on child reference words that are known to be valid.

use pack::abi::{CHILD_INNER, CHILD_SPHERES, ChildRef, NONE};

/// The word of a leaf of triangles; `count` in 1 ..= 8.
pub(super) fn leaf_word(first: u32, count: usize) -> u32 {
    let count = u32::try_from(count).expect("a leaf has at most 8 primitives");
    ChildRef::Triangles { first, count }.encode().expect("fewer than 2^27 primitives, 1 to 8 each")
}

/// The same reference with `nodes` or `primitives` added to its index, modulo 2^32; the result must
/// be in range.
pub(super) fn shift_word(word: u32, nodes: u32, primitives: u32) -> u32 {
    match word {
        NONE => NONE,
        _ if word & CHILD_INNER != 0 => word.wrapping_add(nodes),
        _ => word.wrapping_add(primitives),
    }
}

/// The same reference, as a leaf of spheres where it is a leaf.
pub(super) fn as_spheres(word: u32) -> u32 {
    if word & CHILD_INNER == 0 { word | CHILD_SPHERES } else { word }
}

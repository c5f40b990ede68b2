//! Trees of Embree, as `tests/peers/embree.cpp` writes them; little endian.

use glam::Vec3;
use tests::embree::Quality;

use crate::walk::{Child, To, Walked, pair as both};

/// What Embree is asked for, and what that is called on the page.
pub(crate) type Mode = (Quality, &'static str);

/// Walks through trees without spatial splits.
pub(crate) const WALKS_OF_BINNED: [Mode; 1] = [(Quality::Medium, "Embree 3.13, medium")];
/// Walks through trees with them; the second with every precaution against rays that slip through.
pub(crate) const WALKS_OF_SPLIT: [Mode; 2] =
    [(Quality::High, "Embree 3.13, high"), (Quality::Robust, "Embree 3.13, high, robust")];
/// Builds.
pub(crate) const MODES: [Mode; 2] = [
    (Quality::Medium, "Embree 3.13, medium (binned)"),
    (Quality::High, "Embree 3.13, high (spatial splits)"),
];

/// Reads a tree; the program is ours, so its files are taken as they are.
pub(crate) fn read(bytes: &[u8]) -> Walked {
    let word = |at: usize| {
        let four = bytes[at..at + 4].try_into().expect("four bytes");
        u32::from_le_bytes(four)
    };
    let n_nodes = word(0) as usize;
    let n_indices = word(8) as usize;
    let corner = |at: usize| Vec3::from_array([0, 4, 8].map(|k| f32::from_bits(word(at + k))));
    let child = |node: u32, pair: &dyn Fn(u32) -> u32| {
        let at = 16 + 32 * node as usize;
        let (first, count) = (word(at + 12), word(at + 28));
        let to = match count {
            0 => To::Inner(pair(first)),
            _ => To::Leaf { first, count },
        };
        Child { lo: corner(at), hi: corner(at + 16), to }
    };
    // Pairs are numbered as they come in the file.
    let firsts: Vec<u32> = (0..n_nodes)
        .filter(|node| word(16 + 32 * node + 28) == 0)
        .map(|node| word(16 + 32 * node + 12))
        .collect();
    let mut pair_of = vec![0; n_nodes];
    for (pair, first) in (0..).zip(&firsts) {
        pair_of[*first as usize] = pair;
    }
    let pair = |first: u32| pair_of[first as usize];
    let children = |first: u32| both([child(first, &pair), child(first + 1, &pair)]);
    let nodes = firsts.iter().map(|&first| children(first)).collect();
    let order = (0..n_indices).map(|i| word(16 + 32 * n_nodes + 4 * i)).collect();
    Walked { nodes, order }
}

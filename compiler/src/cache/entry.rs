//! One tree as bytes.
//!
//! ```text
//!  0   8  magic            89 52 54 42 0D 0A 1A 0A
//!  8   4  version          of this layout
//! 12   4  root             child reference
//! 16   4  n_nodes
//! 20   4  n_pieces
//! 24   8  build            microseconds that building took
//! 32  32  key              the name: a file moved elsewhere is not taken for another tree
//! 64  32  hash             BLAKE3 of bytes 0 .. 64 and 96 .. end
//! 96   4  n_splits
//!100   4  0
//!104   8 * n_nodes         left and right reference of each node, depth-first order
//!      4 * n_pieces        pieces in leaf order
//!     12 * n_splits        which piece, axis, where (f32)
//! ```
//! All integers little-endian. The length is exactly what the three counts say.

use files::FileError;
use std::io;
use std::path::Path;
use std::time::Duration;

use thiserror::Error;

use crate::bvh::{self, Input, Shape, Split, Tree, TreeFault};

/// Part of the key: files of another layout are never even opened.
pub(super) const LAYOUT: &str = "references-v2";
const MAGIC: [u8; 8] = [0x89, b'R', b'T', b'B', 0x0d, 0x0a, 0x1a, 0x0a];
const VERSION: u32 = 2;
const HEADER: usize = 104;
const HASH: std::ops::Range<usize> = 64..96;

/// Why a file is not used.
#[derive(Clone, Debug, Error, PartialEq, Eq)]
pub enum EntryFault {
    /// There is no such file.
    #[error("absent")]
    Absent,
    /// The file cannot be read.
    #[error("unreadable: {0}")]
    Io(String),
    /// Shorter or longer than its counts say, or than any entry.
    #[error("wrong length")]
    Length,
    /// Not an entry.
    #[error("wrong magic bytes")]
    Magic,
    /// An entry of another version.
    #[error("version {0}")]
    Version(u32),
    /// An entry for other primitives.
    #[error("it belongs to another tree")]
    Key,
    /// The bytes are not those that were written.
    #[error("wrong checksum")]
    Checksum,
    /// The references are no tree of these primitives.
    #[error("{0}")]
    Tree(TreeFault),
}

/// The bytes of an entry.
pub(super) fn encode(tree: &Tree, key: &blake3::Hash, took: Duration) -> Vec<u8> {
    let len = |n: usize| u32::try_from(n).expect("a tree has at most 2^27 primitives");
    let micros = u64::try_from(took.as_micros()).unwrap_or(u64::MAX);
    let sizes = [8 * tree.nodes.len(), 4 * tree.order.len(), 12 * tree.splits.len()];
    let mut out = Vec::with_capacity(HEADER + sizes.iter().sum::<usize>());
    out.extend(MAGIC);
    for word in [VERSION, tree.root, len(tree.nodes.len()), len(tree.order.len())] {
        out.extend(word.to_le_bytes());
    }
    out.extend(micros.to_le_bytes());
    out.extend(key.as_bytes());
    out.extend([0; 32]);
    out.extend(len(tree.splits.len()).to_le_bytes());
    out.extend([0; 4]);
    for node in &tree.nodes {
        out.extend(node.left.to_le_bytes());
        out.extend(node.right.to_le_bytes());
    }
    for index in &tree.order {
        out.extend(index.to_le_bytes());
    }
    for split in &tree.splits {
        for word in [split.piece, split.axis, split.at.to_bits()] {
            out.extend(word.to_le_bytes());
        }
    }
    let hash = checksum(&out);
    out[HASH].copy_from_slice(hash.as_bytes());
    out
}

fn checksum(bytes: &[u8]) -> blake3::Hash {
    let mut hasher = blake3::Hasher::new();
    hasher.update(&bytes[..HASH.start]).update(&bytes[HASH.end..]);
    hasher.finalize()
}

/// Reads a file and proves that it is a tree of this input. Returns what building took, too.
pub(super) fn load(
    path: &Path,
    key: &blake3::Hash,
    input: &Input<'_>,
) -> Result<(Tree, Duration), EntryFault> {
    decode(&read(path, input.fragments.len())?, key, input)
}

/// Reads at most as many bytes as a tree of `n_prims` primitives can have.
fn read(path: &Path, n_prims: usize) -> Result<Vec<u8>, EntryFault> {
    // No builder makes more pieces than twice the primitives.
    let most = (HEADER + (8 + 4) * 2 * n_prims + 12 * n_prims) as u64;
    files::read(path, most).map_err(|error| match error {
        FileError::Io { source, .. } if source.kind() == io::ErrorKind::NotFound => {
            EntryFault::Absent
        }
        FileError::TooLarge { .. } => EntryFault::Length,
        error => EntryFault::Io(error.to_string()),
    })
}

fn decode(
    bytes: &[u8],
    key: &blake3::Hash,
    input: &Input<'_>,
) -> Result<(Tree, Duration), EntryFault> {
    let Some((header, body)) = bytes.split_first_chunk::<HEADER>() else {
        return Err(EntryFault::Length);
    };
    let (head_words, _) = header.as_chunks::<4>();
    let word = |at: usize| u32::from_le_bytes(head_words[at / 4]);
    if header[..8] != MAGIC {
        return Err(EntryFault::Magic);
    }
    if word(8) != VERSION {
        return Err(EntryFault::Version(word(8)));
    }
    let (root, n_nodes) = (word(12), word(16) as usize);
    let (n_pieces, n_splits) = (word(20) as usize, word(96) as usize);
    // All counts are 32-bit numbers: no overflow in 64 bits.
    if body.len() as u64 != 8 * n_nodes as u64 + 4 * n_pieces as u64 + 12 * n_splits as u64 {
        return Err(EntryFault::Length);
    }
    if header[32..64] != *key.as_bytes() || n_pieces != input.fragments.len() + n_splits {
        return Err(EntryFault::Key);
    }
    if checksum(bytes).as_bytes()[..] != header[HASH] {
        return Err(EntryFault::Checksum);
    }
    let (words, _) = body.as_chunks::<4>();
    let (references, rest) = words.split_at(2 * n_nodes);
    let (order, splits) = rest.split_at(n_pieces);
    let number = |w: &[u8; 4]| u32::from_le_bytes(*w);
    let split = |[piece, axis, at]: &[[u8; 4]; 3]| Split {
        piece: number(piece),
        axis: number(axis),
        at: f32::from_le_bytes(*at),
    };
    let shape = Shape {
        root,
        children: references
            .as_chunks()
            .0
            .iter()
            .map(|pair: &[_; 2]| pair.map(|w| number(&w)))
            .collect(),
        order: order.iter().map(number).collect(),
        splits: splits.as_chunks().0.iter().map(split).collect(),
    };
    let micros = u64::from(word(24)) | u64::from(word(28)) << 32;
    let tree = bvh::from_shape(shape, input).map_err(EntryFault::Tree)?;
    Ok((tree, Duration::from_micros(micros)))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::bvh::Preset;

    /// Long triangles, some of which are split.
    fn triangles(n: u32) -> Vec<[[f32; 3]; 3]> {
        let at = |i: u32| [(i % 13) as f32, (i / 13) as f32, (i % 7) as f32 * 0.3];
        let triangle = |i: u32| {
            let [p, q] = [at(i), at(i * 31 % 97 + 3)];
            [p, q, q.map(|x| x + 0.125)]
        };
        (0..n).map(triangle).collect()
    }

    fn build(triangles: &[[[f32; 3]; 3]]) -> Tree {
        let tree = bvh::build(Preset::Default, Input::of_triangles(triangles)).unwrap();
        assert!(tree.splits.len() > 5);
        tree
    }

    fn decoded(bytes: &[u8], n: u32) -> Result<(Tree, Duration), EntryFault> {
        decode(bytes, &key(), &Input::of_triangles(&triangles(n)))
    }

    fn key() -> blake3::Hash {
        blake3::hash(b"a tree")
    }

    fn good() -> Vec<u8> {
        encode(&build(&triangles(100)), &key(), Duration::from_micros(1234))
    }

    /// Applies a change, renews the checksum, and expects a fault of the tree's own checks.
    fn check_forged(change: impl Fn(&mut Vec<u8>), expected: &EntryFault) {
        let mut bytes = good();
        change(&mut bytes);
        let hash = checksum(&bytes);
        bytes[HASH].copy_from_slice(hash.as_bytes());
        assert_eq!(&decoded(&bytes, 100).unwrap_err(), expected);
    }

    fn put(bytes: &mut [u8], at: usize, word: u32) {
        bytes[at..at + 4].copy_from_slice(&word.to_le_bytes());
    }

    fn get(bytes: &[u8], at: usize) -> u32 {
        u32::from_le_bytes(bytes[at..at + 4].try_into().unwrap())
    }

    #[test]
    fn a_tree_survives_bit_for_bit() {
        let (tree, took) = decoded(&good(), 100).unwrap();
        assert_eq!(tree, build(&triangles(100)));
        assert_eq!(took, Duration::from_micros(1234));
    }

    #[test]
    fn every_flipped_bit_is_noticed() {
        let good = good();
        for bit in 0..8 * good.len() {
            let mut bytes = good.clone();
            bytes[bit / 8] ^= 1 << (bit % 8);
            assert!(decoded(&bytes, 100).is_err(), "bit {bit}");
        }
    }

    #[test]
    fn every_other_length_is_noticed() {
        let good = good();
        for len in 0..good.len() {
            let error = decoded(&good[..len], 100).unwrap_err();
            assert_eq!(error, EntryFault::Length);
        }
        let longer = [good.as_slice(), &[0]].concat();
        assert_eq!(decoded(&longer, 100).unwrap_err(), EntryFault::Length);
    }

    #[test]
    fn foreign_files_are_named() {
        check_forged(|b| b[1] = b'P', &EntryFault::Magic);
        check_forged(|b| put(b, 8, 1), &EntryFault::Version(1));
        check_forged(|b| b[40] ^= 1, &EntryFault::Key);
        check_forged(|b| put(b, 16, u32::MAX), &EntryFault::Length);
        let other = decoded(&good(), 99).unwrap_err();
        assert_eq!(other, EntryFault::Key);
        let mut bytes = good();
        *bytes.last_mut().unwrap() ^= 1;
        assert_eq!(decoded(&bytes, 100).unwrap_err(), EntryFault::Checksum);
    }

    #[test]
    fn forged_trees_are_refused() {
        let n_nodes = get(&good(), 16) as usize;
        let order = HEADER + 8 * n_nodes;
        let root = get(&good(), 12);
        let tree = EntryFault::Tree;
        // A cycle, a skipped node, a reference beyond the end.
        check_forged(|b| put(b, HEADER, root), &tree(TreeFault::NodeOrder));
        check_forged(|b| put(b, HEADER, root + 2), &tree(TreeFault::NodeOrder));
        check_forged(|b| put(b, 12, root + 99), &tree(TreeFault::NodeOrder));
        // No root, spheres, a leaf for a root.
        check_forged(|b| put(b, 12, pack::abi::NONE), &tree(TreeFault::Kind));
        check_forged(|b| put(b, 12, pack::abi::CHILD_SPHERES), &tree(TreeFault::Kind));
        check_forged(|b| put(b, 12, 0), &tree(TreeFault::Unreachable));
        // The last leaf: another beginning, one more, one less.
        let last =
            |b: &[u8]| (HEADER..order).step_by(4).rfind(|&at| get(b, at) & root == 0).unwrap();
        let change = |by: u32| {
            move |b: &mut Vec<u8>| {
                let at = last(b);
                let word = get(b, at).wrapping_add(by);
                put(b, at, word);
            }
        };
        check_forged(change(1), &tree(TreeFault::LeafOrder));
        check_forged(change(1 << 27), &tree(TreeFault::Lost));
        // The same primitive twice; one that does not exist.
        check_forged(|b| b.copy_within(order..order + 4, order + 4), &tree(TreeFault::Permutation));
        check_forged(|b| put(b, order, u32::MAX), &tree(TreeFault::Permutation));
        // A split of what is not there yet, along no axis, beside what it splits, nowhere.
        let split = order + 4 * get(&good(), 20) as usize;
        check_forged(|b| put(b, split, 100), &tree(TreeFault::Split));
        check_forged(|b| put(b, split + 4, 3), &tree(TreeFault::Split));
        check_forged(|b| put(b, split + 8, 1e9_f32.to_bits()), &tree(TreeFault::Split));
        check_forged(|b| put(b, split + 8, f32::NAN.to_bits()), &tree(TreeFault::Split));
    }
}

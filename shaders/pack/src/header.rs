//! Header and section entries as bytes, and the three names a pack carries.
//!
//! Turns fixed-size byte blocks into numbers; it judges nothing (see `table`).

use bytemuck::{Pod, Zeroable};

use crate::abi::{self, Field, Record};

/// First eight bytes of a pack, built as those of PNG: the high bit, CR LF, end-of-file and LF find
/// transfers that are not 8-bit clean or that rewrite line ends.
pub const MAGIC: [u8; 8] = *b"\x89RTP\r\n\x1a\n";
/// Refused when different: layout or meaning changed, compile the scene again.
pub const FORMAT_MAJOR: u16 = 2;
/// A newer minor format only adds sections that may be skipped.
pub const FORMAT_MINOR: u16 = 0;

pub(crate) const ENDIAN_TAG: u32 = 0x0102_0304;
/// The same two lengths as the header stores them.
pub(crate) const HEADER_BYTES: u32 = 128;
pub(crate) const ENTRY_BYTES: u32 = 64;
pub(crate) const HEADER_LEN: usize = HEADER_BYTES as usize;
pub(crate) const ENTRY_LEN: usize = ENTRY_BYTES as usize;
/// Sections start at multiples of this, so that they can be mapped, advised and uploaded alone.
pub(crate) const ALIGN: u64 = 4096;
pub(crate) const MAX_SECTIONS: u32 = 256;
/// Bit 0 of an entry's flags: a reader that does not know the section must refuse the pack.
pub(crate) const FLAG_MUST_UNDERSTAND: u32 = 1;

/// The first 128 bytes.
#[expect(clippy::struct_field_names, reason = "`header_len` is what the format calls it")]
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, Eq, Pod, Zeroable)]
pub(crate) struct Header {
    pub(crate) magic: [u8; 8],
    pub(crate) major: u16,
    pub(crate) minor: u16,
    pub(crate) endian: u32,
    pub(crate) header_len: u32,
    pub(crate) entry_len: u32,
    pub(crate) table_off: u64,
    pub(crate) section_count: u32,
    pub(crate) layout_id: u32,
    pub(crate) file_len: u64,
    pub(crate) features: u64,
    pub(crate) zero: [u32; 2],
    pub(crate) render_id: [u8; 32],
    pub(crate) recipe_id: [u8; 32],
}

/// One row of the section table.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, Eq, Pod, Zeroable)]
pub(crate) struct Entry {
    pub(crate) kind: [u8; 8],
    pub(crate) version: u32,
    pub(crate) flags: u32,
    pub(crate) offset: u64,
    pub(crate) length: u64,
    pub(crate) elem_size: u32,
    pub(crate) zero: u32,
    pub(crate) elem_count: u64,
    pub(crate) hash: [u8; 16],
}

const _: () = assert!(size_of::<Header>() == HEADER_LEN && size_of::<Entry>() == ENTRY_LEN);

/// `value` rounded up to a section boundary, or `None` on overflow.
pub(crate) fn align_up(value: u64) -> Option<u64> {
    Some(value.checked_add(ALIGN - 1)? & !(ALIGN - 1))
}

/// Names the layout of all records: the first four bytes, little-endian, of the BLAKE3 hash of
/// their generated listing. Two builds with different records cannot mistake each other's packs.
#[must_use]
pub fn layout_id() -> u32 {
    let hash = blake3::hash(layout_listing().as_bytes());
    let bytes = hash.as_bytes();
    u32::from_le_bytes([bytes[0], bytes[1], bytes[2], bytes[3]])
}

/// One line a record and one a field: every record of the kernel, then `RenderSettings`.
fn layout_listing() -> String {
    let render = abi::Record::of::<abi::RenderSettings>();
    let mut text = String::new();
    for Record { name, fields, size, .. } in abi::records().into_iter().chain([render]) {
        text.extend([name, " ", &size.to_string(), "\n"]);
        for Field { name, ty, offset, .. } in fields {
            text.extend(["  ", &offset.to_string(), " ", name, " ", ty.wgsl(), "\n"]);
        }
    }
    text
}

/// The name of what is rendered: everything that can change a pixel, and nothing else.
pub(crate) fn render_id(features: u64, entries: &[Entry]) -> [u8; 32] {
    let mut hasher = blake3::Hasher::new();
    hasher.update(&FORMAT_MAJOR.to_le_bytes());
    hasher.update(&features.to_le_bytes());
    hasher.update(&layout_id().to_le_bytes());
    for entry in entries.iter().filter(|entry| entry.flags & FLAG_MUST_UNDERSTAND != 0) {
        hasher.update(&entry.kind);
        hasher.update(&entry.version.to_le_bytes());
        hasher.update(&entry.elem_size.to_le_bytes());
        hasher.update(&entry.elem_count.to_le_bytes());
        hasher.update(&entry.hash);
    }
    *hasher.finalize().as_bytes()
}

/// First 128 bits of the BLAKE3 hash of a section, computed on all threads when it is large.
pub(crate) fn section_hash(bytes: &[u8]) -> [u8; 16] {
    section_hash_unless(bytes, &|| false).expect("nobody gives up")
}

/// As [`section_hash`]; `None` soon after `given_up` says so.
pub(crate) fn section_hash_unless(bytes: &[u8], given_up: &dyn Fn() -> bool) -> Option<[u8; 16]> {
    // Below this size the threads cost more than they save.
    const PARALLEL_FROM: usize = 128 << 10;
    // Between two looks; some milliseconds. A power of two, as trees of BLAKE3 are cut best.
    const PIECE: usize = 16 << 20;
    let mut hasher = blake3::Hasher::new();
    for piece in bytes.chunks(PIECE) {
        if given_up() {
            return None;
        }
        if piece.len() < PARALLEL_FROM {
            hasher.update(piece);
        } else {
            hasher.update_rayon(piece);
        }
    }
    let mut short = [0; 16];
    short.copy_from_slice(&hasher.finalize().as_bytes()[..16]);
    Some(short)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_header_has_the_published_offsets() {
        use std::mem::offset_of;
        let header = [
            offset_of!(Header, major),
            offset_of!(Header, endian),
            offset_of!(Header, table_off),
            offset_of!(Header, section_count),
            offset_of!(Header, layout_id),
            offset_of!(Header, file_len),
            offset_of!(Header, features),
            offset_of!(Header, render_id),
            offset_of!(Header, recipe_id),
        ];
        assert_eq!(header, [8, 12, 24, 32, 36, 40, 48, 64, 96]);
        let entry = [
            offset_of!(Entry, version),
            offset_of!(Entry, flags),
            offset_of!(Entry, offset),
            offset_of!(Entry, length),
            offset_of!(Entry, elem_size),
            offset_of!(Entry, elem_count),
            offset_of!(Entry, hash),
        ];
        assert_eq!(entry, [8, 12, 16, 24, 32, 40, 48]);
    }

    #[test]
    fn rounding_up_never_wraps() {
        assert_eq!(align_up(0), Some(0));
        assert_eq!(align_up(1), Some(4096));
        assert_eq!(align_up(4096), Some(4096));
        assert_eq!(align_up(u64::MAX - 4095), Some(u64::MAX - 4095));
        assert_eq!(align_up(u64::MAX - 4094), None);
    }

    #[test]
    fn the_listing_names_every_field_of_every_record() {
        let listing = layout_listing();
        assert!(listing.starts_with("Frame 192\n  0 tile_origin vec2<u32>\n"));
        assert!(listing.contains("\nRenderSettings 112\n  0 image_size vec2<u32>\n"));
    }
}

//! A pack's sections as rows for people.
//!
//! Turns a checked pack into what `rtc inspect` prints as a table. It prints nothing itself.

use crate::reader::{Checked, Pack};

/// One section.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct SectionRow {
    /// Name without padding.
    pub kind: String,
    /// Version of its elements.
    pub version: u32,
    /// Elements.
    pub count: u64,
    /// Bytes of one element.
    pub elem_size: u32,
    /// Bytes of the section.
    pub bytes: u64,
    /// [`crate::Kind::binding`].
    pub binding: Option<u32>,
    /// First 128 bits of the BLAKE3 hash of the bytes, hexadecimal, as stored.
    pub hash: String,
}

/// One row a section, in file order, sections of a later minor format included.
#[must_use]
pub fn describe(pack: &Pack<Checked>) -> Vec<SectionRow> {
    pack.sections()
        .map(|section| SectionRow {
            kind: section.kind.to_string(),
            version: section.version,
            count: section.count,
            elem_size: section.elem_size,
            bytes: section.bytes.len() as u64,
            binding: section.kind.binding(),
            // Read as one big-endian number, the digits come in the order of the bytes.
            hash: format!("{:032x}", u128::from_be_bytes(section.hash)),
        })
        .collect()
}

//! What a section, or its entry in the table, can have wrong.

use super::words::Product;
use crate::kind::Kind;

/// What a section or its entry can have wrong.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
pub enum SectionFault {
    /// A name that must be understood and is not.
    #[error("unknown mandatory section: the pack needs a newer program")]
    Unknown,
    /// A name that this format does not have.
    #[error("unknown section in format {major}.{minor}")]
    NotInFormat {
        /// Format of the file.
        major: u16,
        /// Format of the file.
        minor: u16,
    },
    /// A name that is not printable ASCII.
    #[error("the name is not ASCII")]
    Name,
    /// Out of the canonical order.
    #[error("out of order: it must come before {after}")]
    Order {
        /// The section before it.
        after: Kind,
    },
    /// Twice.
    #[error("the section is duplicated")]
    Twice,
    /// Elements of another version.
    #[error(
        "version {found}, this program reads version {expected}: compile the scene again: rtc X -o X.pack"
    )]
    Version {
        /// In the file.
        found: u32,
        /// Of this program.
        expected: u32,
    },
    /// Flags other than those of the kind.
    #[error("flags are {found:#x}, expected {expected:#x}")]
    Flags {
        /// In the file.
        found: u32,
        /// Of the kind.
        expected: u32,
    },
    /// Reserved bytes in use.
    #[error("the reserved field is {found:#x}, expected 0")]
    Reserved {
        /// In the file.
        found: u32,
    },
    /// Elements of another size.
    #[error("element size is {found} bytes, expected {expected}")]
    ElemSize {
        /// In the file.
        found: u32,
        /// Of the kind.
        expected: u32,
    },
    /// Too few or too many elements.
    #[error("{found} elements, expected {min} to {max}")]
    Count {
        /// In the file.
        found: u64,
        /// Fewest.
        min: u64,
        /// Most.
        max: u64,
    },
    /// The length is not count times size.
    #[error("length is {found} bytes, but {count} elements of {size} bytes make {}", Product(*count, *size))]
    Length {
        /// In the file.
        found: u64,
        /// Elements.
        count: u64,
        /// Bytes of one.
        size: u32,
    },
    /// Not where the section before it ends.
    #[error("offset is {found:#x}, expected {expected:#x}")]
    Offset {
        /// In the file.
        found: u64,
        /// First boundary after the section before.
        expected: u64,
    },
    /// Beyond the end of the file.
    #[error("{length} bytes at {offset:#x} reach beyond the end of the file at {file_len:#x}")]
    Beyond {
        /// First byte.
        offset: u64,
        /// Bytes.
        length: u64,
        /// Of the file.
        file_len: u64,
    },
}

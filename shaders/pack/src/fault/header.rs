//! What the header can have wrong.

/// What the header can have wrong.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
pub enum HeaderFault {
    /// Shorter than a header.
    #[error("the file ends after {len} bytes, a pack has at least 128")]
    Short {
        /// Length of the file.
        len: u64,
    },
    /// `RTP` is there, the bytes around it are not.
    #[error("the first bytes were altered, perhaps by a transfer in text mode")]
    Altered,
    /// Not the expected byte order.
    #[error("byte order tag is {found:#010x}, expected 0x01020304")]
    Endian {
        /// The tag.
        found: u32,
    },
    /// Another format.
    #[error(
        "format {found}, this program reads format {expected}: compile the scene again: rtc X -o X.pack"
    )]
    Major {
        /// Format of the file.
        found: u16,
        /// Format of this program.
        expected: u16,
    },
    /// Unknown feature bits.
    #[error("unknown features {bits:#018x}: the pack needs a newer program")]
    UnknownFeatures {
        /// The unknown ones.
        bits: u64,
    },
    /// Features that are not those of the contents.
    #[error("features are {found:#018x}, but the contents have {expected:#018x}")]
    Features {
        /// In the header.
        found: u64,
        /// Derived.
        expected: u64,
    },
    /// Other records.
    #[error(
        "record layout {found:#010x}, this program has {expected:#010x}: compile the scene again: rtc X -o X.pack"
    )]
    Layout {
        /// Of the file.
        found: u32,
        /// Of this program.
        expected: u32,
    },
    /// A field that has one legal value has another.
    #[error("{field} is {found}, expected {expected}")]
    Fixed {
        /// Which.
        field: &'static str,
        /// In the file.
        found: u64,
        /// The only legal value.
        expected: u64,
    },
    /// Truncated or extended.
    #[error("the header says {said} bytes, the file has {actual}: {}", if said > actual { "truncated" } else { "bytes follow the pack" })]
    FileLen {
        /// In the header.
        said: u64,
        /// Of the file.
        actual: u64,
    },
    /// No sections, or too many.
    #[error("{found} sections, expected 1 to 256")]
    SectionCount {
        /// In the file.
        found: u32,
    },
    /// The table does not fit.
    #[error("the section table needs {needed} bytes, the file has {actual}")]
    Table {
        /// Header and table.
        needed: u64,
        /// Of the file.
        actual: u64,
    },
    /// The sections end elsewhere than the file.
    #[error("the last section ends at byte {end:#x}, the file at byte {actual:#x}")]
    End {
        /// End of the last section.
        end: u64,
        /// Of the file.
        actual: u64,
    },
    /// Not the hash of the table.
    #[error("render_id does not match the section table")]
    RenderId,
}

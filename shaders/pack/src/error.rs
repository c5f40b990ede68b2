//! What can be wrong with a pack: one variant a rule, one line a variant.
//!
//! Turns a broken rule into text that says what is wrong and where. Texts have no trailing full
//! stop and no path of the pack: whoever opened it knows its name.

use files::ShowPath as _;
use std::{fmt, io, path::PathBuf};

use crate::fault::{BvhFault, ElementFault, HeaderFault, SectionFault};
use crate::kind::Kind;

/// Why a pack cannot be opened or written.
#[derive(Debug, thiserror::Error)]
pub enum PackError {
    /// The operating system refused.
    #[error("cannot {action} {}: {source}", path.shown())]
    Io {
        /// What was tried: `open`, `read`, `map`, `create`, `write`, `rename`.
        action: &'static str,
        /// On which file.
        path: PathBuf,
        /// The system's reason.
        source: io::Error,
    },
    /// A file that cannot be written.
    #[error(transparent)]
    File(#[from] files::FileError),
    /// A directory, a pipe or a device.
    #[error("{} is not a regular file", path.shown())]
    NotAFile {
        /// Which.
        path: PathBuf,
    },
    /// Text in the scene language.
    #[error("is this a scene source? compile it first: rtc X -o X.pack")]
    SceneSource,
    /// Some other file.
    #[error("not a render pack: the first bytes are {}", Bytes(start))]
    NotAPack {
        /// The first bytes, at most eight.
        start: Vec<u8>,
    },
    /// The header breaks a rule.
    #[error("header: {0}")]
    Header(#[from] HeaderFault),
    /// An entry of the section table, or a whole section, breaks a rule.
    #[error("section {kind} (entry {index}): {fault}")]
    Section {
        /// Name of the section.
        kind: Kind,
        /// Row in the section table.
        index: u32,
        /// The rule.
        fault: SectionFault,
    },
    /// A byte between sections is not zero.
    #[error("byte {offset:#x}: padding must be zero, found {found:#04x}")]
    Padding {
        /// Where.
        offset: u64,
        /// What is there.
        found: u8,
    },
    /// A section that every such pack needs is not there.
    #[error("section {kind} is missing{because}")]
    Missing {
        /// Which.
        kind: Kind,
        /// Why this pack needs it, starting with a comma; empty when every pack does.
        because: &'static str,
    },
    /// A section is there that nothing in the pack uses.
    #[error("section {kind} must be absent{because}")]
    Unwanted {
        /// Which.
        kind: Kind,
        /// Why, starting with a comma.
        because: &'static str,
    },
    /// Two counts that must agree do not.
    #[error("{left} is {left_count}, but {right} is {right_count}")]
    CountMismatch {
        /// One of them.
        left: &'static str,
        /// Its value.
        left_count: u64,
        /// The other.
        right: &'static str,
        /// Its value.
        right_count: u64,
    },
    /// A field of a record breaks a rule.
    #[error("{at}: {field} {fault}")]
    Element {
        /// Which record.
        at: Place,
        /// Which field.
        field: &'static str,
        /// The rule.
        fault: ElementFault,
    },
    /// The tree breaks a rule.
    #[error("{at}: {fault}")]
    Bvh {
        /// The node, or the RENDER record for the root.
        at: Place,
        /// The rule.
        fault: BvhFault,
    },
    /// The kernel is not text.
    #[error("KERNEL: not UTF-8 at byte {at:#x}")]
    KernelNotUtf8 {
        /// Bytes before the first bad one.
        at: usize,
    },
    /// The manifest cannot be read or written.
    #[error("META: {0}")]
    Manifest(String),
    /// More bytes than there is room for.
    #[error("the pack has {len} bytes, and {most} fit into memory")]
    TooLarge {
        /// Bytes of the pack.
        len: u64,
        /// Most that are read.
        most: u64,
    },
    /// A mapped file is not what it was when it was opened.
    #[error("the file changed while it was in use: {how}")]
    Altered {
        /// In which way.
        how: Alteration,
    },
    /// A section's bytes are not those that were written.
    #[error("section {kind}: the bytes do not match their hash, the file is damaged")]
    Hash {
        /// Which section.
        kind: Kind,
    },
}

/// What became of a mapped file.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
pub enum Alteration {
    /// Cut off or extended.
    #[error("it has {now} bytes, it had {then}")]
    Length {
        /// Bytes now.
        now: u64,
        /// Bytes when it was opened.
        then: u64,
    },
    /// Written to in place.
    #[error("it was written to")]
    Written,
    /// The system cannot give its bytes any more.
    #[error("it can no longer be read")]
    Lost,
}

impl PackError {
    /// Every pack needs this section.
    pub(crate) fn missing(kind: Kind) -> Self {
        Self::Missing { kind, because: "" }
    }
}

/// A record: its section, its index there, and its first byte within the section.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Place {
    /// Section.
    pub kind: Kind,
    /// Element of the section.
    pub index: usize,
    /// First byte of the element, or of the field, from the start of the section.
    pub offset: usize,
}

impl fmt::Display for Place {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(out, "{}[{}] at byte {:#x}", self.kind, self.index, self.offset)
    }
}

/// Bytes as hexadecimal pairs, or "none".
struct Bytes<'a>(&'a [u8]);

impl fmt::Display for Bytes<'_> {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        if self.0.is_empty() {
            return write!(out, "none, the file is empty");
        }
        for (index, byte) in self.0.iter().enumerate() {
            write!(out, "{}{byte:02x}", if index == 0 { "" } else { " " })?;
        }
        Ok(())
    }
}

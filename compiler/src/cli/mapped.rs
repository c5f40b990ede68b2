//! Packs that `rtc` has written, mapped: the one place of the compiler where a file is.
//!
//! Whoever takes something from such a pack asks its witness afterwards: `PackWriter::taken_from` before a pack
//! that was made of it is there, [`unchanged`] before an answer about it ends.

use std::path::Path;

use pack::{Pack, PackError};

/// Maps and checks a pack.
pub(super) fn map(path: &Path) -> Result<Pack, PackError> {
    #[expect(unsafe_code, reason = "the one mapping of the compiler")]
    // SAFETY: `rtc` itself never writes to a pack in place, it puts another in its place. What other programs do to
    // the file can be told only afterwards, and is: nothing is written or kept of what was read before the witness
    // has been asked, and until then it is numbers, which safe code with checked indices reads.
    unsafe {
        Pack::map(path)
    }
}

/// Fails if the file of the pack is no longer what was mapped.
pub(super) fn unchanged(pack: &Pack) -> Result<(), PackError> {
    pack.witness().map_or(Ok(()), |witness| witness.look())
}

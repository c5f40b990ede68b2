//! From the name on the command line to a checked pack: mapped, read, or taken from standard input.

use pack::{Pack, PackError};
use std::path::Path;

/// Stands for standard input.
const STDIN: &str = "-";
/// Packs up to this size are read into memory whatever the system says is free.
const SMALL: u64 = 64 << 20;

/// How a file gets into memory.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum How {
    /// Mapped: pages are loaded when they are first touched.
    Map,
    /// Read: what becomes of the file does not matter afterwards.
    Read,
}

impl How {
    /// What `--no-mmap` says.
    pub(super) fn of(no_mmap: bool) -> Self {
        if no_mmap { Self::Read } else { Self::Map }
    }
}

/// Whether the name stands for standard input.
pub(super) fn is_stdin(path: &Path) -> bool {
    path == Path::new(STDIN)
}

/// Opens and checks a pack. One that is mapped goes to a `Guard` before it is used.
pub(super) fn open(path: &Path, how: How) -> Result<Pack, PackError> {
    let most = host::free().map_or(u64::MAX, |free| free.max(SMALL));
    if is_stdin(path) {
        return Pack::receive(std::io::stdin().lock(), most);
    }
    if how == How::Map {
        return map(path);
    }
    match std::fs::metadata(path) {
        Ok(data) if data.len() > most => Err(PackError::TooLarge { len: data.len(), most }),
        // Reading says what is wrong with it.
        _ => Pack::read(path),
    }
}

fn map(path: &Path) -> Result<Pack, PackError> {
    #[expect(unsafe_code, reason = "the one mapping of the renderer")]
    // SAFETY: `rtc` never writes to a pack in place. What other programs do to the file can be told only afterwards,
    // and is: every command that opens a pack uses it within `Guard::during`, which ends with an error, and nothing
    // written, once the file is not what was mapped. Until then it is numbers, which safe code with checked indices
    // reads, and zeros where there is nothing left to read.
    unsafe {
        Pack::map(path)
    }
}

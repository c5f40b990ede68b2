//! What goes wrong with a file, in one line that names it.

use std::io;
use std::path::{Path, PathBuf};

use crate::show::ShowPath as _;

/// A file that cannot be read or written.
#[derive(Debug, thiserror::Error)]
pub enum FileError {
    /// The system refused.
    #[error("cannot {action} {}: {}", path.shown(), crate::escape(&source.to_string()))]
    Io {
        /// What was tried, as a verb.
        action: &'static str,
        /// The file.
        path: PathBuf,
        /// The system's words.
        source: io::Error,
    },
    /// An output whose folder does not exist.
    #[error("cannot create {}: there is no folder {}", path.shown(), folder.shown())]
    NoFolder {
        /// The output.
        path: PathBuf,
        /// Its folder.
        folder: PathBuf,
    },
    /// A folder stands where a file is to be read or written.
    #[error("{} is a folder", path.shown())]
    Folder {
        /// The folder.
        path: PathBuf,
    },
    /// Neither a file nor a folder: a device, a pipe or a socket, where only a file can be read.
    #[error("{} is not a regular file", path.shown())]
    NotRegular {
        /// Its name.
        path: PathBuf,
    },
    /// The file system is too full for an output.
    #[error("cannot write {}: it needs {} and {} are free there", path.shown(), bytes(*need), bytes(*free))]
    NoRoom {
        /// The output.
        path: PathBuf,
        /// Bytes that it needs.
        need: u64,
        /// Bytes that are free.
        free: u64,
    },
    /// An input that is larger than anything it can be.
    #[error("{} is too large: {len} bytes, and at most {most} are read", path.shown())]
    TooLarge {
        /// The file.
        path: PathBuf,
        /// Its bytes.
        len: u64,
        /// The limit.
        most: u64,
    },
}

impl FileError {
    /// Wraps the system's error for `path`.
    pub(crate) fn io(action: &'static str, path: &Path) -> impl FnOnce(io::Error) -> Self + use<> {
        let path = path.to_owned();
        move |source| Self::Io { action, path, source }
    }
}

/// `1.2 GB`, in powers of ten as file managers show them.
fn bytes(n: u64) -> String {
    match n {
        0..1_000 => format!("{n} bytes"),
        1_000..1_000_000 => format!("{:.1} kB", n as f64 / 1e3),
        1_000_000..1_000_000_000 => format!("{:.1} MB", n as f64 / 1e6),
        _ => format!("{:.1} GB", n as f64 / 1e9),
    }
}

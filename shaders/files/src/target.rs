//! The path of an output → what stands there, and so how it is written.

use std::fs::Metadata;
use std::io;
use std::path::{Path, PathBuf};

use crate::error::FileError;

/// More links in a row are a circle, as for Linux.
const MOST_LINKS: usize = 40;

/// Where the bytes of an output go.
#[derive(Debug)]
pub(crate) enum Target {
    /// Standard output: `-`, `/dev/stdout`.
    Stdout,
    /// A device, a pipe or a socket, which is written to and never replaced.
    Stream(PathBuf),
    /// A file that is replaced as a whole; `existing`: the one that is there.
    File {
        /// Its path with all symbolic links followed.
        path: PathBuf,
        /// What is there now.
        existing: Option<Metadata>,
    },
}

impl Target {
    /// Follows symbolic links, those to files that do not exist yet included.
    pub(crate) fn of(path: &Path) -> Result<Self, FileError> {
        let mut at = path.to_owned();
        for _ in 0..MOST_LINKS {
            if let Some(stream) = descriptor(&at) {
                return Ok(stream);
            }
            match std::fs::symlink_metadata(&at) {
                Ok(data) if data.is_symlink() => {
                    let to = std::fs::read_link(&at).map_err(FileError::io("follow", path))?;
                    at = folder(&at).join(to);
                }
                Ok(data) if data.is_dir() => {
                    return Err(FileError::Folder { path: path.to_owned() });
                }
                Ok(data) if data.is_file() => {
                    return Ok(Self::File { path: at, existing: Some(data) });
                }
                Ok(_) => return Ok(Self::Stream(at)),
                Err(error) if error.kind() == io::ErrorKind::NotFound => {
                    return Ok(Self::File { path: at, existing: None });
                }
                Err(error) => return Err(FileError::io("write", path)(error)),
            }
        }
        Err(FileError::io("follow", path)(io::Error::other("too many symbolic links")))
    }
}

/// Whether an output of this name is a stream: standard output, a device or a pipe.
#[must_use]
pub fn is_stream(path: &Path) -> bool {
    matches!(Target::of(path), Ok(Target::Stdout | Target::Stream(_)))
}

/// The folder that a path is in.
pub(crate) fn folder(path: &Path) -> &Path {
    path.parent().filter(|folder| !folder.as_os_str().is_empty()).unwrap_or(Path::new("."))
}

/// Open files of this process have names of their own, which must not be followed: what they stand for may have no
/// other name.
fn descriptor(path: &Path) -> Option<Target> {
    let stdout = ["-", "/dev/stdout", "/dev/fd/1", "/proc/self/fd/1"];
    if stdout.iter().any(|name| path == Path::new(name)) {
        return Some(Target::Stdout);
    }
    let others = ["/dev/fd", "/proc/self/fd"];
    let is_other = path == Path::new("/dev/stderr")
        || path.parent().is_some_and(|dir| others.iter().any(|name| dir == Path::new(name)));
    is_other.then(|| Target::Stream(path.to_owned()))
}

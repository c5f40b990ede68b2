//! The one way to open what `rtc` reads: texts, meshes, material libraries, buffers and images.
//!
//! Only regular files are opened, and with a root (`rtc --root`) only those that lie in it once every link and
//! every `..` is resolved; an absolute path is as good as any that leads there. What is opened is the resolved
//! path, so a link that is changed meanwhile leads nowhere else. Who may replace folders inside the root while
//! `rtc` runs is not kept out.

use std::fs::File;
use std::io;
use std::path::{Path, PathBuf};
use std::sync::Arc;

use files::{FileError, ShowPath as _};

/// The folder that inputs must lie in; by default they may lie anywhere.
#[derive(Clone, Debug, Default)]
pub struct Root(Option<Arc<PathBuf>>);

/// Why an input cannot be read; the path is named by whoever asked for it.
#[derive(Debug, thiserror::Error)]
pub enum InputError {
    /// It leads out of the root.
    #[error("it lies outside the folder {}, which --root forbids", .0.shown())]
    Outside(PathBuf),
    /// It is a folder, a device, a pipe or a socket.
    #[error("this is not a regular file")]
    NotRegular,
    /// It is larger than anything that it may be.
    #[error("the file has {len} bytes, the limit is {most}")]
    TooLarge {
        /// Its bytes.
        len: u64,
        /// The limit.
        most: u64,
    },
    /// The system refused.
    #[error(transparent)]
    Io(#[from] io::Error),
}

impl From<FileError> for InputError {
    fn from(error: FileError) -> Self {
        match error {
            FileError::Folder { .. } | FileError::NotRegular { .. } => Self::NotRegular,
            FileError::TooLarge { len, most, .. } => Self::TooLarge { len, most },
            FileError::Io { source, .. } => Self::Io(source),
            other => Self::Io(io::Error::other(other)),
        }
    }
}

impl Root {
    /// Inputs may lie anywhere.
    pub const ANYWHERE: Self = Self(None);

    /// Inputs must lie in `folder`.
    ///
    /// # Errors
    /// When there is no such folder.
    pub fn new(folder: &Path) -> io::Result<Self> {
        let real = folder.canonicalize()?;
        if !real.is_dir() {
            return Err(io::ErrorKind::NotADirectory.into());
        }
        Ok(Self(Some(Arc::new(real))))
    }

    /// The folder, if there is one.
    pub(crate) fn folder(&self) -> Option<&Path> {
        self.0.as_deref().map(PathBuf::as_path)
    }

    /// Opens a regular file.
    ///
    /// # Errors
    /// When there is none, or none that may be read.
    pub fn open(&self, path: &Path) -> Result<File, InputError> {
        Ok(match self.resolve(path)? {
            Some(real) => files::open_regular(&real)?,
            None => files::open_regular(path)?,
        })
    }

    /// The bytes of a regular file of at most `most` bytes.
    ///
    /// # Errors
    /// As those of `open`, and when it is larger.
    pub fn read(&self, path: &Path, most: u64) -> Result<Vec<u8>, InputError> {
        Ok(files::read_open(path, &self.open(path)?, most)?)
    }

    /// Whether it is worth trying to open a file: it is there, or outside, which opening it will say. Nobody
    /// learns what there is outside of the root.
    #[must_use]
    pub fn has(&self, path: &Path) -> bool {
        match self.resolve(path) {
            Ok(real) => real.as_deref().unwrap_or(path).is_file(),
            Err(error) => matches!(error, InputError::Outside(_)),
        }
    }

    /// The path without links, in the root; `None` where there is no root.
    fn resolve(&self, path: &Path) -> Result<Option<PathBuf>, InputError> {
        let Some(root) = &self.0 else { return Ok(None) };
        let inside = |real: PathBuf| {
            if real.starts_with(root.as_path()) {
                Ok(real)
            } else {
                Err(InputError::Outside(root.to_path_buf()))
            }
        };
        match path.canonicalize() {
            Ok(real) => inside(real).map(Some),
            Err(error) => {
                // What is not there would have been in the nearest folder that is.
                let mut folders = path.ancestors().skip(1).map(|folder| match folder {
                    empty if empty.as_os_str().is_empty() => Path::new("."),
                    folder => folder,
                });
                if let Some(real) = folders.find_map(|f| f.canonicalize().ok()) {
                    inside(real)?;
                }
                Err(error.into())
            }
        }
    }
}

#[cfg(all(test, unix))]
mod tests {
    use super::*;
    use std::os::unix::fs::symlink;

    #[test]
    fn only_what_lies_in_the_root_is_opened() {
        let folder = tempfile::tempdir().unwrap();
        let at = |name: &str| folder.path().join(name);
        std::fs::create_dir_all(at("in/deep")).unwrap();
        for name in ["in/a", "in/deep/b", "c", "inside"] {
            std::fs::write(at(name), "text").unwrap();
        }
        symlink("../c", at("in/out")).unwrap();
        symlink("..", at("in/up")).unwrap();
        symlink("deep/b", at("in/link")).unwrap();
        symlink("in/a", at("to_in")).unwrap();
        let root = Root::new(&at("in")).unwrap();
        for name in ["in/a", "in/deep/../a", "in/link", "in/../in/deep/b", "to_in", "in/up/in/a"] {
            assert_eq!(root.read(&at(name), 4).unwrap(), b"text", "{name}");
            assert!(root.has(&at(name)), "{name}");
        }
        for name in
            ["c", "in/../c", "in/out", "in/up/c", "inside", "none", "in/../none", "in/up/none"]
        {
            let error = root.read(&at(name), 4).unwrap_err();
            assert!(matches!(error, InputError::Outside(_)), "{name}: {error}");
            assert!(root.has(&at(name)), "{name}: said when it is opened");
            assert_eq!(Root::ANYWHERE.has(&at(name)), !name.contains("none"), "{name}");
        }
        for name in ["in/none", "in/deep/none/x"] {
            let error = root.read(&at(name), 4).unwrap_err();
            assert!(matches!(error, InputError::Io(e) if e.kind() == io::ErrorKind::NotFound));
            assert!(!root.has(&at(name)), "{name}");
        }
        assert!(matches!(root.read(&at("in/deep"), 4), Err(InputError::NotRegular)));
        assert!(matches!(root.read(&at("in/a"), 3), Err(InputError::TooLarge { len: 4, most: 3 })));
        assert!(Root::new(&at("none")).is_err() && Root::new(&at("c")).is_err());
    }
}

//! A file → whether it is still the same one; a file of somebody else → out of the way, under a name that is free.
//!
//! A checkpoint is hours of work. A run replaces and removes its own only, which it knows by their marks;
//! one that another run left, or is writing at the same time, is renamed.

use std::fs::{File, Metadata};
use std::io;
use std::path::{Path, PathBuf};
use std::time::SystemTime;

/// Names that are tried.
const MOST: u32 = 9999;

/// A file as it was at one time.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Mark {
    path: PathBuf,
    stamp: Stamp,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
struct Stamp {
    len: u64,
    modified: Option<SystemTime>,
    /// Device and number, where files have them.
    id: [u64; 2],
}

impl Stamp {
    fn of(data: &Metadata) -> Self {
        #[cfg(unix)]
        let id = {
            use std::os::unix::fs::MetadataExt as _;
            [data.dev(), data.ino()]
        };
        #[cfg(not(unix))]
        let id = [0; 2];
        Self { len: data.len(), modified: data.modified().ok(), id }
    }
}

impl Mark {
    /// Of the file that is in `path` now; `None` when there is none.
    #[must_use]
    pub fn of(path: &Path) -> Option<Self> {
        let data = std::fs::metadata(path).ok()?;
        Some(Self { path: path.to_owned(), stamp: Stamp::of(&data) })
    }

    /// Where it is.
    #[must_use]
    pub fn path(&self) -> &Path {
        &self.path
    }

    /// Whether it is there as it was.
    #[must_use]
    pub fn is_there(&self) -> bool {
        Self::of(&self.path).as_ref() == Some(self)
    }

    /// Removes it if it is there as it was.
    pub fn remove(&self) -> io::Result<()> {
        if self.is_there() { std::fs::remove_file(&self.path) } else { Ok(()) }
    }
}

/// Renames what is in `path`, unless it is `own`, to `path.1` or the first free number; tells the new
/// name. Nothing is replaced by that.
pub(crate) fn make_way(path: &Path, own: Option<&Mark>) -> io::Result<Option<PathBuf>> {
    let data = match std::fs::metadata(path) {
        Ok(data) => data,
        Err(error) if error.kind() == io::ErrorKind::NotFound => return Ok(None),
        Err(error) => return Err(error),
    };
    if own.is_some_and(|own| own.path == path && own.stamp == Stamp::of(&data)) {
        return Ok(None);
    }
    if !data.is_file() {
        return Err(io::Error::other("it is no regular file"));
    }
    for n in 1..=MOST {
        let mut name = path.as_os_str().to_owned();
        name.push(format!(".{n}"));
        // An empty file takes the name, so that nobody else does.
        match File::create_new(&name) {
            Ok(_) => {
                let aside = PathBuf::from(name);
                return std::fs::rename(path, &aside).map(|()| Some(aside));
            }
            Err(error) if error.kind() == io::ErrorKind::AlreadyExists => {}
            Err(error) => return Err(error),
        }
    }
    Err(io::Error::other(format!("there are {MOST} others beside it")))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_not_ours_gets_the_first_free_number_and_nothing_is_replaced() {
        let folder = tempfile::tempdir().unwrap();
        let at = |name: &str| folder.path().join(name);
        let path = at("a.checkpoint");
        assert_eq!(make_way(&path, None).unwrap(), None, "nothing is there");
        std::fs::write(&path, "one").unwrap();
        std::fs::write(at("a.checkpoint.1"), "older").unwrap();
        let own = Mark::of(&path).unwrap();
        assert_eq!(make_way(&path, Some(&own)).unwrap(), None, "it is ours");
        assert_eq!(make_way(&path, None).unwrap(), Some(at("a.checkpoint.2")));
        assert!(!path.exists() && !own.is_there());
        std::fs::write(&path, "another one's").unwrap();
        assert_eq!(make_way(&path, Some(&own)).unwrap(), Some(at("a.checkpoint.3")));
        let read = |name: &str| std::fs::read_to_string(at(name)).unwrap();
        let found = ["a.checkpoint.1", "a.checkpoint.2", "a.checkpoint.3"].map(read);
        assert_eq!(found, ["older", "one", "another one's"]);
        own.remove().unwrap();
        std::fs::create_dir(&path).unwrap();
        assert!(make_way(&path, None).is_err(), "a folder");
    }

    #[test]
    fn only_the_same_file_is_removed() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("a");
        std::fs::write(&path, "one").unwrap();
        let mark = Mark::of(&path).unwrap();
        std::fs::write(&path, "four").unwrap();
        mark.remove().unwrap();
        assert!(path.exists());
        Mark::of(&path).unwrap().remove().unwrap();
        assert!(!path.exists());
        mark.remove().unwrap();
    }
}

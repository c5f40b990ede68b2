//! Which files a compilation reads, and what they hold: for `--watch`, `--depfile`, and to find that nothing changed.
//!
//! Files are told apart by the BLAKE3 of their bytes; size and time only tell whether a file changed while it was
//! looked at. A file that is asked for and not there counts, too.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::sync::{Mutex, MutexGuard, PoisonError};
use std::time::SystemTime;

use rayon::prelude::*;

use crate::input::Root;

/// Size and time of a file; `None` while there is none. Polling these works on every file system.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Stamp(Option<(u64, SystemTime)>);

impl Stamp {
    /// Of the file as it is now.
    #[must_use]
    pub fn of(path: &Path) -> Self {
        let data = std::fs::metadata(path).ok();
        Self(data.and_then(|data| Some((data.len(), data.modified().ok()?))))
    }
}

/// BLAKE3 of a file's bytes; `None` for one that is not there, or may not be read.
pub type Content = Option<[u8; 32]>;

/// Files of one compilation.
#[derive(Debug, Default)]
pub struct Reads {
    state: Mutex<State>,
}

#[derive(Debug, Default)]
struct State {
    reads: BTreeMap<PathBuf, Stamp>,
    /// What is known of files, read or not, with the stamp from before they were looked at.
    contents: BTreeMap<PathBuf, (Stamp, Content)>,
}

impl Reads {
    fn lock(&self) -> MutexGuard<'_, State> {
        self.state.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// A compilation begins.
    pub fn begin(&self) {
        *self.lock() = State::default();
    }

    /// A file is about to be read, whether it is there or not.
    pub fn read(&self, path: &Path) {
        if !self.lock().reads.contains_key(path) {
            let stamp = Stamp::of(path);
            self.lock().reads.entry(path.to_owned()).or_insert(stamp);
        }
    }

    /// A file that was told to be read had these bytes.
    pub fn know(&self, path: &Path, content: [u8; 32]) {
        let mut state = self.lock();
        if let Some(stamp) = state.reads.get(path).copied() {
            state.contents.entry(path.to_owned()).or_insert((stamp, Some(content)));
        }
    }

    /// Every file that was asked for since `begin`, as it was then.
    #[must_use]
    pub fn all(&self) -> BTreeMap<PathBuf, Stamp> {
        self.lock().reads.clone()
    }

    /// What a file holds now; it is looked at once a compilation.
    pub fn content(&self, path: &Path, root: &Root) -> Content {
        if let Some((_, content)) = self.lock().contents.get(path) {
            return *content;
        }
        // The time first: a file that changes meanwhile will be seen to have another.
        let found = (Stamp::of(path), content(path, root));
        self.lock().contents.insert(path.to_owned(), found);
        found.1
    }

    /// Looks at some files, side by side.
    pub fn look_at(&self, paths: &[PathBuf], root: &Root) {
        paths.par_iter().for_each(|path| {
            self.content(path, root);
        });
    }

    /// What each of the files that were read held; `None` if one of them changed since.
    pub fn contents(&self, root: &Root) -> Option<Vec<(PathBuf, Content)>> {
        let reads: Vec<(PathBuf, Stamp)> = self.all().into_iter().collect();
        let unchanged = |(path, stamp): (PathBuf, Stamp)| {
            let known = self.lock().contents.get(&path).copied();
            let content = match known {
                Some((known, content)) if known == stamp => content,
                Some(_) | None => content(&path, root),
            };
            (Stamp::of(&path) == stamp).then_some((path, content))
        };
        reads.into_par_iter().map(unchanged).collect()
    }
}

/// A file that is outside of the root is not known: reading it says why.
fn content(path: &Path, root: &Root) -> Content {
    let file = root.open(path).ok()?;
    let mut hasher = blake3::Hasher::new();
    std::io::copy(&mut std::io::BufReader::with_capacity(1 << 20, file), &mut hasher).ok()?;
    Some(*hasher.finalize().as_bytes())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_file_that_changes_while_it_is_read_is_noticed() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("a");
        std::fs::write(&path, "1").unwrap();
        let (reads, root) = (Reads::default(), Root::ANYWHERE);
        reads.read(&path);
        let hash = *blake3::hash(b"1").as_bytes();
        assert_eq!(reads.contents(&root), Some(vec![(path.clone(), Some(hash))]));
        std::fs::write(&path, "22").unwrap();
        assert_eq!(reads.contents(&root), None);
        reads.begin();
        let absent = folder.path().join("b");
        reads.read(&absent);
        assert_eq!(reads.content(&absent, &root), None);
        assert_eq!(reads.contents(&root), Some(vec![(absent, None)]));
    }
}

//! A file → whether it is another one by now, told by size and time.

use std::path::{Path, PathBuf};
use std::time::SystemTime;

/// A file as it was, to find out whether it is still so.
#[derive(Clone, Debug)]
pub(super) struct Change {
    path: PathBuf,
    stamp: Option<(u64, SystemTime)>,
}

impl Change {
    /// Of the file as it is now.
    pub(super) fn of(path: &Path) -> Self {
        Self { path: path.to_owned(), stamp: stamp(path) }
    }

    /// Whether the file is another one by now.
    pub(super) fn has_come(&self) -> bool {
        stamp(&self.path) != self.stamp
    }
}

fn stamp(path: &Path) -> Option<(u64, SystemTime)> {
    let data = std::fs::metadata(path).ok()?;
    Some((data.len(), data.modified().ok()?))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_change_is_noticed_by_size_time_and_absence() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("a.pack");
        let missing = Change::of(&path);
        assert!(!missing.has_come());
        std::fs::write(&path, "one").unwrap();
        assert!(missing.has_come());
        let one = Change::of(&path);
        assert!(!one.has_come());
        std::fs::write(&path, "four").unwrap();
        assert!(one.has_come());
        let four = Change::of(&path);
        let file = std::fs::File::options().append(true).open(&path).unwrap();
        file.set_modified(SystemTime::UNIX_EPOCH).unwrap();
        assert!(four.has_come());
        std::fs::remove_file(&path).unwrap();
        assert!(four.has_come() && one.has_come() && !missing.has_come());
    }
}

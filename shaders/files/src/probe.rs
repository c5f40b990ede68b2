//! Whether an output can be written, found out before the work and not after it.

use std::path::Path;

use crate::error::FileError;
use crate::replace::prepare;
use crate::target::{Target, folder};

/// Whether [`crate::write`] can be expected to succeed: the folder is there, a file can be created in it, the one
/// that is to be replaced may be written to, and `room` bytes are free. Devices and pipes are not touched.
pub fn probe(path: &Path, room: u64) -> Result<(), FileError> {
    let Target::File { path: at, existing } = Target::of(path)? else { return Ok(()) };
    drop(prepare(path, &at, existing.as_ref())?);
    // Not every file system says how much room it has.
    match fs4::available_space(folder(&at)) {
        Ok(free) if free < room => {
            Err(FileError::NoRoom { path: path.to_owned(), need: room, free })
        }
        _ => Ok(()),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_cannot_be_written_is_known_before() {
        let dir = tempfile::tempdir().unwrap();
        let path = dir.path().join("a.png");
        probe(&path, 1).unwrap();
        assert!(std::fs::read_dir(dir.path()).unwrap().next().is_none(), "nothing is left behind");
        assert!(matches!(probe(&path, u64::MAX), Err(FileError::NoRoom { .. })));
        assert!(matches!(probe(dir.path(), 1), Err(FileError::Folder { .. })));
        let none = dir.path().join("none").join("a.png");
        let error = probe(&none, 1).unwrap_err().to_string();
        let folder = dir.path().join("none");
        let expected =
            format!("cannot create {}: there is no folder {}", none.display(), folder.display());
        assert_eq!(error, expected);
        assert!(probe(Path::new("a\0b.png"), 1).is_err());
        assert!(probe(Path::new("/dev/null"), u64::MAX).is_ok() || cfg!(windows));
    }
}

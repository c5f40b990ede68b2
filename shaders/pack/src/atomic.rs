//! Writes files that are there whole or not at all.
//!
//! Turns what a function writes into a file, under a temporary name first. A process that is killed leaves such
//! a temporary file behind; whoever writes the same file next removes it. A lock that the system takes away
//! from dead processes, and only from those, tells which ones are left over.

use std::fs::{File, TryLockError};
use std::io::{self, BufWriter, Write};
use std::path::Path;

use tempfile::NamedTempFile;

use crate::error::PackError;

/// How temporary names end.
const SUFFIX: &str = ".tmp";
/// Others may take a new file for a leftover before it is locked; so often in a row they do not.
const ATTEMPTS: usize = 16;

/// Writes a file under a temporary name in the same directory, flushes it to the disk and renames
/// it to `path`. On any error `path` is as it was, and the temporary file is gone; so are those that dead
/// processes left when they wrote `path`.
pub fn write_atomic(
    path: &Path,
    content: impl FnOnce(&mut dyn Write) -> io::Result<()>,
) -> Result<(), PackError> {
    let io = |action| move |source| PackError::Io { action, path: path.to_owned(), source };
    let dir = match path.parent() {
        Some(dir) if !dir.as_os_str().is_empty() => dir,
        _ => Path::new("."),
    };
    let prefix = prefix(path);
    remove_leftovers(dir, &prefix);
    let file = create(dir, &prefix).map_err(|error| io("create")(plain(error, dir)))?;
    let mut out = BufWriter::with_capacity(1 << 20, file);
    content(&mut out).map_err(io("write"))?;
    let file = out.into_inner().map_err(|error| io("write")(error.into_error()))?;
    file.as_file().sync_all().map_err(io("write"))?;
    file.persist(path).map_err(|error| io("rename")(error.error))?;
    // The name itself is safe once the directory is; not every file system can promise that.
    if let Ok(dir) = File::open(dir) {
        drop(dir.sync_all());
    }
    Ok(())
}

/// The error without the temporary name, which says nothing to whoever asked for another.
fn plain(error: io::Error, dir: &Path) -> io::Error {
    if error.kind() == io::ErrorKind::NotFound {
        return io::Error::other(format!("there is no folder {}", dir.display()));
    }
    error.raw_os_error().map_or(error, io::Error::from_raw_os_error)
}

/// How temporary names of `path` begin. A hash, because names have a greatest length.
fn prefix(path: &Path) -> String {
    let name = path.file_name().unwrap_or_default();
    let hash = blake3::hash(name.as_encoded_bytes()).to_hex();
    format!(".pack-{}-", &hash[..16])
}

/// A temporary file that is locked, where files can be.
fn create(dir: &Path, prefix: &str) -> io::Result<NamedTempFile> {
    let mut builder = tempfile::Builder::new();
    builder.prefix(prefix).suffix(SUFFIX);
    #[cfg(unix)]
    {
        use std::os::unix::fs::PermissionsExt;
        // As any program creates a file; the umask takes its part.
        builder.permissions(std::fs::Permissions::from_mode(0o666));
    }
    for _ in 0..ATTEMPTS {
        let file = builder.tempfile_in(dir)?;
        match file.as_file().try_lock() {
            // Somebody takes it for a leftover.
            Err(TryLockError::WouldBlock) => {}
            // Somebody took it for one before it was locked; now nobody does.
            Ok(()) if !file.path().exists() => {}
            // Without locks nothing counts as left over.
            Ok(()) | Err(TryLockError::Error(_)) => return Ok(file),
        }
    }
    Err(io::Error::other("temporary files vanish"))
}

/// Removes temporary files that nobody has locked. What cannot be removed stays: that is no reason not to write.
fn remove_leftovers(dir: &Path, prefix: &str) {
    let Ok(entries) = std::fs::read_dir(dir) else { return };
    for entry in entries.flatten() {
        let name = entry.file_name();
        let name = name.to_string_lossy();
        if !(name.starts_with(prefix) && name.ends_with(SUFFIX)) {
            continue;
        }
        if let Ok(file) = File::options().write(true).open(entry.path())
            && file.try_lock().is_ok()
        {
            drop(std::fs::remove_file(entry.path()));
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn names(dir: &Path) -> Vec<String> {
        let entries = std::fs::read_dir(dir).unwrap();
        let mut names: Vec<String> =
            entries.map(|entry| entry.unwrap().file_name().into_string().unwrap()).collect();
        names.sort();
        names
    }

    #[test]
    fn what_a_dead_process_left_goes_with_the_next_write_of_the_same_file() {
        let dir = tempfile::tempdir().unwrap();
        let (path, other) = (dir.path().join("a.pack"), dir.path().join("b.pack"));
        let temporary = |path: &Path, end: &str| dir.path().join(prefix(path) + end);
        let [dead, alive, of_other, foreign] = [
            temporary(&path, "dead.tmp"),
            temporary(&path, "live.tmp"),
            temporary(&other, "dead.tmp"),
            dir.path().join(".pack-mine.tmp"),
        ];
        for file in [&dead, &alive, &of_other, &foreign] {
            std::fs::write(file, "half of it").unwrap();
        }
        let locked = File::open(&alive).unwrap();
        locked.lock().unwrap();
        write_atomic(&path, |out| out.write_all(b"all of it")).unwrap();
        assert_eq!(std::fs::read(&path).unwrap(), b"all of it");
        assert!(!dead.exists());
        for file in [&alive, &of_other, &foreign] {
            assert!(file.exists(), "{}", file.display());
        }
        drop(locked);
        write_atomic(&path, |out| out.write_all(b"again")).unwrap();
        write_atomic(&other, |out| out.write_all(b"the other")).unwrap();
        assert_eq!(names(dir.path()), [".pack-mine.tmp", "a.pack", "b.pack"]);
    }

    #[test]
    fn a_file_that_is_being_written_survives_others_who_write_it() {
        let dir = tempfile::tempdir().unwrap();
        let path = dir.path().join("a.pack");
        write_atomic(&path, |out| {
            out.write_all(b"the last ")?;
            write_atomic(&path, |out| out.write_all(b"the first")).unwrap();
            assert_eq!(std::fs::read(&path).unwrap(), b"the first");
            out.write_all(b"word")
        })
        .unwrap();
        assert_eq!(std::fs::read(&path).unwrap(), b"the last word");
        assert_eq!(names(dir.path()), ["a.pack"]);
    }

    #[test]
    fn an_error_leaves_nothing_behind() {
        let dir = tempfile::tempdir().unwrap();
        let path = dir.path().join("a.pack");
        write_atomic(&path, |out| out.write_all(b"good")).unwrap();
        let failed = write_atomic(&path, |out| {
            out.write_all(b"bad")?;
            Err(io::Error::other("the disk is full"))
        });
        assert!(failed.is_err());
        assert_eq!(std::fs::read(&path).unwrap(), b"good");
        assert_eq!(names(dir.path()), ["a.pack"]);
    }

    #[test]
    fn a_folder_that_is_not_there_is_named_and_no_temporary_name() {
        let dir = tempfile::tempdir().unwrap();
        let path = dir.path().join("none").join("a.pack");
        let error = write_atomic(&path, |_| Ok(())).unwrap_err().to_string();
        let none = dir.path().join("none");
        let expected =
            format!("cannot create {}: there is no folder {}", path.display(), none.display());
        assert_eq!(error, expected);
    }
}

//! Writes files that are there whole or not at all.
//!
//! Turns what a function writes into a file, under a temporary name first. A process that is killed leaves such
//! a temporary file behind; whoever writes the same file next removes it. A lock that the system takes away
//! from dead processes, and only from those, tells which ones are left over.

use std::fs::{File, Metadata, TryLockError};
use std::io::{self, Write};
use std::path::Path;

use tempfile::NamedTempFile;

use crate::error::FileError;
use crate::inject::step;
use crate::sink::Sink;
use crate::steps::{Steps, gather};
use crate::target::folder;

/// How temporary names end.
const SUFFIX: &str = ".tmp";
/// Others may take a new file for a leftover before it is locked; so often in a row they do not.
const ATTEMPTS: usize = 16;

/// Writes a file under a temporary name in the folder of `at`, flushes it to the disk and renames it to `at`. On any
/// error `at` is as it was, and the temporary file is gone; so are those that dead processes left when they wrote
/// `at`. `path`: the name that the user knows; `existing`: what is at `at` now.
pub(crate) fn replace(
    path: &Path,
    at: &Path,
    existing: Option<&Metadata>,
    content: impl FnOnce(&mut dyn Sink) -> io::Result<()>,
) -> Result<(), FileError> {
    let dir = folder(at);
    let file = prepare(path, at, existing)?;
    let mut out = gather(file);
    let written = content(&mut out).and_then(|()| out.flush());
    let Steps(file) = out.into_parts().0;
    written.map_err(FileError::io("write", path))?;
    let synced = step().and_then(|()| file.as_file().sync_all());
    synced.map_err(FileError::io("write", path))?;
    let renamed = step().and_then(|()| file.persist(at).map_err(|error| error.error));
    renamed.map_err(FileError::io("rename to", path))?;
    // The name itself is safe once the directory is; not every file system can promise that.
    if let Ok(dir) = File::open(dir) {
        drop(dir.sync_all());
    }
    Ok(())
}

/// The temporary file that is going to be `at`, with the mode and the owner of what is there.
pub(crate) fn prepare(
    path: &Path,
    at: &Path,
    existing: Option<&Metadata>,
) -> Result<NamedTempFile, FileError> {
    let dir = folder(at);
    if existing.is_some() {
        // Who may not write to a file must not replace it either.
        let opened = step().and_then(|()| File::options().append(true).open(at));
        opened.map_err(FileError::io("write", path))?;
    }
    let prefix = prefix(at);
    remove_leftovers(dir, &prefix);
    let file = step().and_then(|()| create(dir, &prefix)).map_err(|error| {
        if error.kind() == io::ErrorKind::NotFound {
            return FileError::NoFolder { path: path.to_owned(), folder: dir.to_owned() };
        }
        // The error without the temporary name, which says nothing to whoever asked for another.
        let plain = error.raw_os_error().map_or(error, io::Error::from_raw_os_error);
        FileError::io("create", path)(plain)
    })?;
    if let Some(existing) = existing {
        inherit(file.as_file(), existing).map_err(FileError::io("create", path))?;
    }
    Ok(file)
}

/// Gives the new file the owner, as far as the system allows, and the mode of the old one.
fn inherit(file: &File, existing: &Metadata) -> io::Result<()> {
    #[cfg(unix)]
    {
        use std::os::unix::fs::{MetadataExt as _, fchown};
        let now = file.metadata()?;
        if (now.uid(), now.gid()) != (existing.uid(), existing.gid())
            && fchown(file, Some(existing.uid()), Some(existing.gid())).is_err()
        {
            // Only the superuser gives files away; who is a member may still keep the group.
            let _ = fchown(file, None, Some(existing.gid()));
        }
    }
    file.set_permissions(existing.permissions())
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
    use crate::write::write;

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
        write(&path, |out| out.write_all(b"all of it")).unwrap();
        assert_eq!(std::fs::read(&path).unwrap(), b"all of it");
        assert!(!dead.exists());
        for file in [&alive, &of_other, &foreign] {
            assert!(file.exists(), "{}", file.display());
        }
        drop(locked);
        write(&path, |out| out.write_all(b"again")).unwrap();
        write(&other, |out| out.write_all(b"the other")).unwrap();
        assert_eq!(names(dir.path()), [".pack-mine.tmp", "a.pack", "b.pack"]);
    }

    #[test]
    fn a_file_that_is_being_written_survives_others_who_write_it() {
        let dir = tempfile::tempdir().unwrap();
        let path = dir.path().join("a.pack");
        write(&path, |out| {
            out.write_all(b"the last ")?;
            write(&path, |out| out.write_all(b"the first")).unwrap();
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
        write(&path, |out| out.write_all(b"good")).unwrap();
        let failed = write(&path, |out| {
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
        let error = write(&path, |_| Ok(())).unwrap_err().to_string();
        let none = dir.path().join("none");
        let expected =
            format!("cannot create {}: there is no folder {}", path.display(), none.display());
        assert_eq!(error, expected);
    }
}

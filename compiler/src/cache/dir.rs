//! The cache directory: where it is, what is in it.
//!
//! Turns environment variables into a path and a directory into a list of entries. Only files whose
//! names this module could have made are ever listed or deleted.

use std::ffi::OsString;
use std::fs;
use std::io::{self, Write};
use std::path::{Path, PathBuf};
use std::time::{Duration, SystemTime};

/// Where systems keep caches.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum System {
    Unix,
    MacOs,
    Windows,
}

/// Folder of the trees within the cache; also the extension of their files.
const TREES: &str = "bvh";
/// The same for records of finished compilations.
const RECORDS: &str = "done";
const TEMPORARY: &str = ".rtc-";
/// A temporary file this old belongs to no running program.
const STALE: Duration = Duration::from_hours(24);

/// The cache directory for these environment variables. Empty variables count as unset, and a
/// relative `$XDG_CACHE_HOME` is ignored, as its specification says.
pub(super) fn locate(system: System, var: impl Fn(&str) -> Option<OsString>) -> Option<PathBuf> {
    let path = |name: &str| var(name).filter(|v| !v.is_empty()).map(PathBuf::from);
    let home = || match system {
        System::Windows => path("LOCALAPPDATA"),
        System::MacOs => path("HOME").map(|h| h.join("Library").join("Caches")),
        System::Unix => path("HOME").map(|h| h.join(".cache")),
    };
    path("RTC_CACHE_DIR").or_else(|| {
        let xdg = path("XDG_CACHE_HOME").filter(|p| p.is_absolute());
        xdg.or_else(home).map(|p| p.join("rtc"))
    })
}

/// `bvh/ab/cdef….bvh`, relative to the cache directory.
pub(super) fn entry_path(key: &blake3::Hash) -> PathBuf {
    let hex = key.to_hex();
    let (folder, name) = hex.split_at(2);
    Path::new(TREES).join(folder).join(format!("{name}.{TREES}"))
}

/// `done/ab/cdef….done`, relative to the cache directory.
pub(super) fn record_path(key: &blake3::Hash) -> PathBuf {
    let hex = key.to_hex();
    let (folder, name) = hex.split_at(2);
    Path::new(RECORDS).join(folder).join(format!("{name}.{RECORDS}"))
}

/// Writes a file under a temporary name in its own folder, then renames it.
pub(super) fn store(path: &Path, bytes: &[u8]) -> io::Result<()> {
    let folder = path.parent().ok_or(io::ErrorKind::InvalidInput)?;
    fs::create_dir_all(folder)?;
    let mut file = tempfile::Builder::new().prefix(TEMPORARY).tempfile_in(folder)?;
    file.write_all(bytes)?;
    file.persist(path)?;
    Ok(())
}

/// Notes that an entry was used. A cache that may only be read stays usable, so failure is no matter.
pub(super) fn touch(path: &Path) {
    if let Ok(file) = fs::File::options().append(true).open(path) {
        let _ = file.set_modified(SystemTime::now());
    }
}

/// Deletes a file, and its folder when that is empty now. Already gone is as good.
pub(super) fn remove(path: &Path) -> io::Result<()> {
    match fs::remove_file(path) {
        Err(error) if error.kind() != io::ErrorKind::NotFound => return Err(error),
        _ => {}
    }
    if let Some(folder) = path.parent() {
        // Fails when other entries are in it, which is fine.
        let _ = fs::remove_dir(folder);
    }
    Ok(())
}

/// An entry.
#[derive(Debug)]
pub(super) struct File {
    pub(super) path: PathBuf,
    pub(super) bytes: u64,
    /// When it was used last.
    pub(super) used: SystemTime,
    /// Whether it is a tree; a record or a temporary file otherwise.
    pub(super) is_tree: bool,
}

/// All entries, and temporary files that were left behind.
pub(super) fn files(root: &Path) -> io::Result<Vec<File>> {
    let mut found = Vec::new();
    for kind in [TREES, RECORDS] {
        files_of(root, kind, &mut found)?;
    }
    Ok(found)
}

fn files_of(root: &Path, kind: &str, found: &mut Vec<File>) -> io::Result<()> {
    for folder in list(&root.join(kind))? {
        if !is_hex(&folder, 2) {
            continue;
        }
        let folder = root.join(kind).join(folder);
        for name in list(&folder)? {
            let path = folder.join(&name);
            let stem = name.strip_suffix(kind).and_then(|name| name.strip_suffix('.'));
            let entry = stem.is_some_and(|stem| is_hex(stem, 62));
            // Another process may delete files meanwhile.
            let Ok(data) = fs::symlink_metadata(&path) else { continue };
            let used = data.modified().unwrap_or(SystemTime::UNIX_EPOCH);
            let stale = name.starts_with(TEMPORARY) && used.elapsed().is_ok_and(|age| age > STALE);
            if data.is_file() && (entry || stale) {
                let is_tree = entry && kind == TREES;
                found.push(File { path, bytes: data.len(), used, is_tree });
            }
        }
    }
    Ok(())
}

/// The names in a folder that are text, sorted. A folder that is not there is empty; so is a file.
fn list(folder: &Path) -> io::Result<Vec<String>> {
    let entries = match fs::read_dir(folder) {
        Ok(entries) => entries,
        Err(e) if matches!(e.kind(), io::ErrorKind::NotFound | io::ErrorKind::NotADirectory) => {
            return Ok(Vec::new());
        }
        Err(e) => return Err(e),
    };
    let mut names = Vec::new();
    for entry in entries {
        names.extend(entry?.file_name().into_string());
    }
    names.sort_unstable();
    Ok(names)
}

fn is_hex(text: &str, len: usize) -> bool {
    text.len() == len && text.bytes().all(|b| matches!(b, b'0'..=b'9' | b'a'..=b'f'))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn check(system: System, vars: &[(&str, &str)], expected: Option<&str>) {
        let var = |name: &str| {
            vars.iter().find(|(n, _)| *n == name).map(|(_, value)| OsString::from(value))
        };
        assert_eq!(locate(system, var), expected.map(PathBuf::from), "{vars:?}");
    }

    #[test]
    #[cfg(unix)]
    fn the_directory_follows_the_environment() {
        let home = ("HOME", "/home/ann");
        check(System::Unix, &[], None);
        check(System::Unix, &[home], Some("/home/ann/.cache/rtc"));
        check(System::MacOs, &[home], Some("/home/ann/Library/Caches/rtc"));
        check(System::Windows, &[home], None);
        check(System::Windows, &[("LOCALAPPDATA", "/local")], Some("/local/rtc"));
        check(System::Unix, &[home, ("XDG_CACHE_HOME", "/x")], Some("/x/rtc"));
        check(System::Unix, &[home, ("XDG_CACHE_HOME", "x")], Some("/home/ann/.cache/rtc"));
        check(System::Unix, &[home, ("XDG_CACHE_HOME", "")], Some("/home/ann/.cache/rtc"));
        check(System::Unix, &[home, ("RTC_CACHE_DIR", "/r")], Some("/r"));
    }
}

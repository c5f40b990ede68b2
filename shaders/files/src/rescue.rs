//! Results that took long to make → some file, if not the one that was asked for.

use std::io;
use std::path::{Path, PathBuf};

use crate::error::FileError;
use crate::sink::Sink;
use crate::target::folder;
use crate::write::write_seekable;

/// Names that are tried in one folder.
const MOST_NAMES: u32 = 1000;

/// Where a result went.
#[derive(Debug)]
pub enum Saved {
    /// Where it was to go.
    AsAsked,
    /// That failed; it is in this file.
    Elsewhere(PathBuf, FileError),
}

/// As [`write_seekable`]; when that fails, the content is written to a new file of that name in the working folder, else in
/// the system's folder for temporary files. `content` is called once for each try.
pub fn save(
    path: &Path,
    content: impl Fn(&mut dyn Sink) -> io::Result<()>,
) -> Result<Saved, FileError> {
    let Err(error) = write_seekable(path, &content) else { return Ok(Saved::AsAsked) };
    let name = path.file_name().map_or_else(|| "picture".into(), |name| name.to_string_lossy());
    let name: String = name.chars().map(|c| if c.is_control() { '_' } else { c }).collect();
    for dir in [PathBuf::from("."), std::env::temp_dir()] {
        if let Some(free) = free_name(&dir, Path::new(&name), path)
            && write_seekable(&free, &content).is_ok()
        {
            return Ok(Saved::Elsewhere(free, error));
        }
    }
    Err(error)
}

/// A name in `dir` that nothing has: `a.png`, `a.1.png`, …; not `except`, which has failed.
fn free_name(dir: &Path, name: &Path, except: &Path) -> Option<PathBuf> {
    let stem = name.file_stem()?.to_string_lossy();
    let extension = name.extension().map(|e| format!(".{}", e.to_string_lossy()));
    let names = (0..MOST_NAMES).map(|i| match i {
        0 => dir.join(name),
        i => dir.join(format!("{stem}.{i}{}", extension.as_deref().unwrap_or_default())),
    });
    let same =
        |path: &Path| path.file_name() == except.file_name() && folder(path) == folder(except);
    let mut free =
        names.filter(|path| !same(path)).filter(|path| std::fs::symlink_metadata(path).is_err());
    free.next()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_cannot_go_where_it_should_goes_where_it_can() {
        let dir = tempfile::tempdir().unwrap();
        let path = dir.path().join("none").join("rescue-test.png");
        let mut found = Vec::new();
        for _ in 0..2 {
            let saved = save(&path, |out| out.write_all(b"picture")).unwrap();
            let Saved::Elsewhere(at, error) = saved else { panic!("{saved:?}") };
            assert!(matches!(error, FileError::NoFolder { .. }));
            assert_eq!(std::fs::read(&at).unwrap(), b"picture");
            found.push(at);
        }
        assert_ne!(found[0], found[1], "nothing is overwritten");
        for path in found {
            std::fs::remove_file(path).unwrap();
        }
        let path = dir.path().join("a.png");
        assert!(matches!(save(&path, |out| out.write_all(b"x")), Ok(Saved::AsAsked)));
    }
}

//! Reads scene texts for the language, which does not know the disk.

use std::io::ErrorKind::NotFound;
use std::path::{Path, PathBuf};

use lang::source::{LoadError, Loader, MAX_FILE_BYTES, is_scene_text};

use crate::input::{InputError, Root};
use crate::reads::Reads;

/// Finds imports beside the file that imports them.
#[derive(Debug)]
pub(crate) struct DiskLoader<'a> {
    /// Told every file that is asked for.
    pub(crate) reads: &'a Reads,
    /// Where texts may lie.
    pub(crate) root: &'a Root,
}

impl Loader for DiskLoader<'_> {
    fn load(&mut self, importing: &str, path: &str) -> Result<(String, String), LoadError> {
        let dir = Path::new(importing).parent().unwrap_or(Path::new(""));
        let file = tidy(&dir.join(path));
        let name = file.display().to_string();
        self.reads.read(&file);
        match read_text(&file, self.root) {
            Ok(text) => Ok((name, text)),
            Err(TextError::NotText(byte)) => Err(LoadError::NotText(byte)),
            Err(error @ TextError::NotScene) => Err(LoadError::Unreadable(error.to_string())),
            Err(TextError::Input(InputError::Io(error))) if error.kind() == NotFound => {
                Err(other_case(&file).map_or(LoadError::NotFound, LoadError::WrongCase))
            }
            Err(TextError::Input(error)) => Err(LoadError::Unreadable(error.to_string())),
        }
    }
}

/// Why a text could not be read.
#[derive(Debug, thiserror::Error)]
pub(crate) enum TextError {
    /// The file is missing, unreadable, too large, or not where it may be.
    #[error(transparent)]
    Input(#[from] InputError),
    /// Byte at this offset is not UTF-8.
    #[error("this file is not UTF-8 text: wrong byte at offset {0}")]
    NotText(u64),
    /// Nothing says that it is a scene.
    #[error("not a scene text: it does not begin with `rts 1`")]
    NotScene,
}

/// The text of the scene that the command line names. Where neither its name, which ends in `.rts`, nor its
/// first word says that it is a scene, nothing of it is to be shown. (A file that is imported must begin
/// with the word, whatever its name is: see `lang`.)
pub(crate) fn read_scene(path: &Path, root: &Root) -> Result<String, TextError> {
    let text = read_text(path, root)?;
    if path.extension().is_some_and(|extension| extension == "rts") || is_scene_text(&text) {
        return Ok(text);
    }
    Err(TextError::NotScene)
}

/// The whole text of a regular file of at most `MAX_FILE_BYTES`.
pub(crate) fn read_text(path: &Path, root: &Root) -> Result<String, TextError> {
    let bytes = root.read(path, MAX_FILE_BYTES as u64)?;
    String::from_utf8(bytes).map_err(|e| TextError::NotText(e.utf8_error().valid_up_to() as u64))
}

/// `a/./b` and `a/x/../b` become `a/b`, so that one file has one name.
fn tidy(path: &Path) -> PathBuf {
    use std::path::Component;
    let mut out = PathBuf::new();
    for part in path.components() {
        match part {
            Component::CurDir => {}
            Component::ParentDir
                if matches!(out.components().next_back(), Some(Component::Normal(_))) =>
            {
                out.pop();
            }
            part => out.push(part),
        }
    }
    out
}

/// The real name of a file that differs from `path` in case only.
fn other_case(path: &Path) -> Option<String> {
    let wanted = path.file_name()?.to_str()?.to_lowercase();
    let dir = path.parent().filter(|dir| !dir.as_os_str().is_empty()).unwrap_or(Path::new("."));
    let names =
        std::fs::read_dir(dir).ok()?.flatten().filter_map(|e| e.file_name().into_string().ok());
    names.filter(|name| name.to_lowercase() == wanted).min()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn one_file_has_one_name() {
        assert_eq!(tidy(Path::new("a/./b/../c.rts")), Path::new("a/c.rts"));
        assert_eq!(tidy(Path::new("../c.rts")), Path::new("../c.rts"));
    }
}

//! Reads files whole, within limits, and remembers what was read.

use super::budget::{Budget, Loan};
use super::error::{ErrorKind, ImportError};
use super::report::FileRead;
use crate::input::{InputError, Root};
use files::ShowPath as _;
use std::path::Path;

/// Where inputs may lie and what they may cost. Checked before memory is taken.
#[derive(Clone, Debug)]
pub struct Limits {
    /// Bytes of one file.
    pub file_bytes: u64,
    /// Triangles of one mesh file, nodes that share a mesh counted each.
    pub triangles: u64,
    /// Pixels of one image.
    pub pixels: u64,
    /// Pixels of all images of one mesh file together.
    pub total_pixels: u64,
    /// Memory of all files of a compilation together.
    pub memory: Budget,
    /// Where files may lie.
    pub root: Root,
}

impl Default for Limits {
    /// 4 GiB, 2^27 triangles, 2^28 pixels an image and 2^30 a file; any memory, anywhere.
    fn default() -> Self {
        Self {
            file_bytes: 1 << 32,
            triangles: 1 << 27,
            pixels: 1 << 28,
            total_pixels: 1 << 30,
            memory: Budget::UNLIMITED,
            root: Root::ANYWHERE,
        }
    }
}

/// Reads files and keeps the list of them.
pub(super) struct Reader<'a> {
    pub(super) limits: &'a Limits,
    pub(super) files: Vec<FileRead>,
    /// What the bytes of these files took; they live as long as the reader, or less.
    loans: Vec<Loan>,
}

impl<'a> Reader<'a> {
    pub(super) fn new(limits: &'a Limits) -> Self {
        Self { limits, files: Vec::new(), loans: Vec::new() }
    }

    /// The whole file, which must be a regular file within the limit.
    pub(super) fn read(&mut self, path: &Path) -> Result<Vec<u8>, ImportError> {
        let (bytes, loan) = read_file(path, self.limits)?;
        self.loans.push(loan);
        self.remember(path, &bytes);
        Ok(bytes)
    }

    /// Takes memory until everything is read.
    pub(super) fn take(&mut self, bytes: u64, place: &str) -> Result<(), ImportError> {
        self.loans.push(self.limits.memory.take(bytes, place)?);
        Ok(())
    }

    /// The files that were read; what their bytes took is given back.
    pub(super) fn finish(self) -> Vec<FileRead> {
        self.files
    }

    /// Notes that `bytes` of the file `path` went into the import.
    pub(super) fn remember(&mut self, path: &Path, bytes: &[u8]) {
        let hash = *blake3::hash(bytes).as_bytes();
        self.files.push(FileRead { path: path.to_owned(), hash });
    }
}

/// The whole file, which must be a regular file within the limit, and what its bytes took.
pub(super) fn read_file(path: &Path, limits: &Limits) -> Result<(Vec<u8>, Loan), ImportError> {
    let place = || path.shown().to_string();
    let failed = |error| input_error(path, error);
    let file = limits.root.open(path).map_err(failed)?;
    let len = file.metadata().map_err(|e| failed(e.into()))?.len();
    if len > limits.file_bytes {
        return Err(failed(InputError::TooLarge { len, most: limits.file_bytes }));
    }
    let loan = limits.memory.take(len, &place())?;
    let bytes = files::read_open(path, &file, limits.file_bytes).map_err(|e| failed(e.into()))?;
    Ok((bytes, loan))
}

fn input_error(path: &Path, error: InputError) -> ImportError {
    let place = path.shown().to_string();
    let kind = match error {
        InputError::Io(source) if source.kind() == std::io::ErrorKind::OutOfMemory => {
            let message = "there is no memory for its bytes";
            return ImportError::new(ErrorKind::Memory, place, message);
        }
        InputError::Io(source) => return io_error(path, source),
        InputError::Outside(_) => ErrorKind::Outside,
        InputError::NotRegular => ErrorKind::Io,
        InputError::TooLarge { .. } => ErrorKind::Limit,
    };
    ImportError::new(kind, place, error.to_string())
}

fn io_error(path: &Path, source: std::io::Error) -> ImportError {
    let missing = source.kind() == std::io::ErrorKind::NotFound;
    let kind = if missing { ErrorKind::Missing } else { ErrorKind::Io };
    let message =
        if missing { "no such file".to_owned() } else { format!("cannot read: {source}") };
    let help = if missing { spelling_help(path) } else { String::new() };
    let mut error = ImportError::new(kind, path.shown().to_string(), message).with_help(help);
    error.source = Some(source);
    error
}

/// Entries of a folder that are looked at; a help text is not worth more.
const MAX_ENTRIES: usize = 10_000;

/// What to try instead of a path that does not exist: `/` for `\`, or the case that does exist.
fn spelling_help(path: &Path) -> String {
    if path.to_string_lossy().contains('\\') {
        return "write `/` between folders, not `\\`".to_owned();
    }
    let (Some(folder), Some(wanted)) = (path.parent(), path.file_name()) else {
        return String::new();
    };
    let folder = if folder.as_os_str().is_empty() { Path::new(".") } else { folder };
    let wanted = wanted.to_string_lossy().to_lowercase();
    let Ok(entries) = std::fs::read_dir(folder) else {
        return format!("there is no folder `{}`", folder.shown());
    };
    let names = entries.take(MAX_ENTRIES).flatten();
    let names = names.map(|entry| entry.file_name().to_string_lossy().into_owned());
    let similar = names.filter(|name| name.to_lowercase() == wanted).min();
    similar
        .map_or_else(String::new, |name| format!("there is `{name}`: upper and lower case differ"))
}

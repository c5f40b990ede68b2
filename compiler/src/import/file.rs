//! Reads files whole, within limits, and remembers what was read.

use super::error::{ErrorKind, ImportError};
use super::report::FileRead;
use std::fs::File;
use std::io::Read as _;
use std::path::Path;

/// What an input may cost. Checked before memory is taken.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Limits {
    /// Bytes of one file.
    pub file_bytes: u64,
    /// Triangles of one mesh file, nodes that share a mesh counted each.
    pub triangles: u64,
    /// Pixels of one image.
    pub pixels: u64,
    /// Pixels of all images of one mesh file together.
    pub total_pixels: u64,
}

impl Default for Limits {
    /// 4 GiB, 2^27 triangles, 2^28 pixels an image and 2^30 a file.
    fn default() -> Self {
        Self { file_bytes: 1 << 32, triangles: 1 << 27, pixels: 1 << 28, total_pixels: 1 << 30 }
    }
}

/// Reads files and keeps the list of them.
pub(super) struct Reader<'a> {
    pub(super) limits: &'a Limits,
    pub(super) files: Vec<FileRead>,
}

impl<'a> Reader<'a> {
    pub(super) fn new(limits: &'a Limits) -> Self {
        Self { limits, files: Vec::new() }
    }

    /// The whole file, which must be a regular file within the limit.
    pub(super) fn read(&mut self, path: &Path) -> Result<Vec<u8>, ImportError> {
        let bytes = read_file(path, self.limits)?;
        self.remember(path, &bytes);
        Ok(bytes)
    }

    /// Notes that `bytes` of the file `path` went into the import.
    pub(super) fn remember(&mut self, path: &Path, bytes: &[u8]) {
        let hash = *blake3::hash(bytes).as_bytes();
        self.files.push(FileRead { path: path.to_owned(), hash });
    }
}

/// The whole file, which must be a regular file within the limit.
pub(super) fn read_file(path: &Path, limits: &Limits) -> Result<Vec<u8>, ImportError> {
    let place = path.display().to_string();
    let io = |source: std::io::Error| io_error(path, source);
    let kind = std::fs::metadata(path).map_err(io)?; // before `open`, which would wait at a pipe
    if !kind.is_file() {
        return Err(ImportError::new(ErrorKind::Io, place, "this is not a regular file"));
    }
    let file = File::open(path).map_err(io)?;
    let too_long = |length: u64| {
        let max = limits.file_bytes;
        let message = format!("the file has {length} bytes, the limit is {max}");
        ImportError::new(ErrorKind::Limit, path.display().to_string(), message)
    };
    if kind.len() > limits.file_bytes {
        return Err(too_long(kind.len()));
    }
    let capacity = usize::try_from(kind.len()).map_err(|_| too_long(kind.len()))?;
    let mut bytes = Vec::new();
    if bytes.try_reserve_exact(capacity).is_err() {
        let message = format!("no memory for its {capacity} bytes");
        return Err(ImportError::new(ErrorKind::Limit, place, message));
    }
    file.take(limits.file_bytes.saturating_add(1)).read_to_end(&mut bytes).map_err(io)?;
    if bytes.len() as u64 > limits.file_bytes {
        return Err(too_long(bytes.len() as u64)); // it grew while it was read
    }
    Ok(bytes)
}

fn io_error(path: &Path, source: std::io::Error) -> ImportError {
    let missing = source.kind() == std::io::ErrorKind::NotFound;
    let kind = if missing { ErrorKind::Missing } else { ErrorKind::Io };
    let message =
        if missing { "no such file".to_owned() } else { format!("cannot read: {source}") };
    let help = if missing { spelling_help(path) } else { String::new() };
    let mut error = ImportError::new(kind, path.display().to_string(), message).with_help(help);
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
        return format!("there is no folder `{}`", folder.display());
    };
    let names = entries.take(MAX_ENTRIES).flatten();
    let names = names.map(|entry| entry.file_name().to_string_lossy().into_owned());
    let similar = names.filter(|name| name.to_lowercase() == wanted).min();
    similar
        .map_or_else(String::new, |name| format!("there is `{name}`: upper and lower case differ"))
}

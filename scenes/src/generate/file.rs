//! Bytes become a file.

use std::path::Path;

/// Makes the folder, too; a reader sees the old file or the new one.
pub(super) fn write_atomically(path: &Path, bytes: &[u8]) -> std::io::Result<()> {
    let dir = path.parent().unwrap_or(Path::new("."));
    std::fs::create_dir_all(dir)?;
    files::write(path, |out| out.write_all(bytes)).map_err(std::io::Error::other)
}

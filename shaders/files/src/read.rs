//! Inputs → bytes. Only regular files are read, never more of them than a limit.

use std::fs::File;
use std::io::{self, Read as _};
use std::path::Path;

use crate::error::FileError;

/// Opens a regular file. A pipe or a device is refused at once, where `File::open` might wait for ever.
pub fn open_regular(path: &Path) -> Result<File, FileError> {
    // Devices may act when they are opened, so most are refused before. What slips in between is caught below.
    is_regular(path, &std::fs::metadata(path).map_err(FileError::io("read", path))?)?;
    let mut options = File::options();
    options.read(true);
    #[cfg(unix)]
    {
        use std::os::unix::fs::OpenOptionsExt as _;
        let flags = rustix::fs::OFlags::NONBLOCK.bits();
        options.custom_flags(i32::try_from(flags).unwrap_or(0));
    }
    let file = options.open(path).map_err(FileError::io("read", path))?;
    is_regular(path, &file.metadata().map_err(FileError::io("read", path))?)?;
    Ok(file)
}

fn is_regular(path: &Path, data: &std::fs::Metadata) -> Result<(), FileError> {
    let path = || path.to_owned();
    match () {
        () if data.is_dir() => Err(FileError::Folder { path: path() }),
        () if !data.is_file() => Err(FileError::NotRegular { path: path() }),
        () => Ok(()),
    }
}

/// The bytes of a regular file of at most `most` bytes.
pub fn read(path: &Path, most: u64) -> Result<Vec<u8>, FileError> {
    read_open(path, &open_regular(path)?, most)
}

/// As [`read`], of a file that is open already. A file that holds more than it says, as those of `/proc` do, is
/// refused.
pub fn read_open(path: &Path, file: &File, most: u64) -> Result<Vec<u8>, FileError> {
    let io = || FileError::io("read", path);
    let len = file.metadata().map_err(io())?.len();
    if len > most {
        return Err(FileError::TooLarge { path: path.to_owned(), len, most });
    }
    let too_large = |_| io::Error::from(io::ErrorKind::OutOfMemory);
    let capacity = usize::try_from(len).map_err(|_| io()(io::ErrorKind::OutOfMemory.into()))?;
    let mut bytes = Vec::new();
    bytes.try_reserve_exact(capacity.saturating_add(1)).map_err(too_large).map_err(io())?;
    // One byte more than it says shows that it says the wrong thing.
    file.take(len + 1).read_to_end(&mut bytes).map_err(io())?;
    if bytes.len() as u64 > len {
        let grew = io::Error::other("it holds more than its size says");
        return Err(io()(grew));
    }
    Ok(bytes)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn files_are_read_up_to_a_limit() {
        let dir = tempfile::tempdir().unwrap();
        let path = dir.path().join("a");
        std::fs::write(&path, b"12345").unwrap();
        assert_eq!(read(&path, 5).unwrap(), b"12345");
        assert!(matches!(read(&path, 4), Err(FileError::TooLarge { len: 5, most: 4, .. })));
        assert!(matches!(read(dir.path(), 5), Err(FileError::Folder { .. })));
    }

    #[cfg(target_os = "linux")]
    #[test]
    fn pipes_devices_and_files_of_the_system_are_refused_without_waiting() {
        let dir = tempfile::tempdir().unwrap();
        let pipe = dir.path().join("pipe");
        let mode = rustix::fs::Mode::from_raw_mode(0o600);
        rustix::fs::mkfifoat(rustix::fs::CWD, &pipe, mode).unwrap();
        assert!(matches!(read(&pipe, 5), Err(FileError::NotRegular { .. })));
        assert!(matches!(read(Path::new("/dev/zero"), 5), Err(FileError::NotRegular { .. })));
        assert!(read(Path::new("/proc/self/maps"), 1 << 20).is_err());
    }
}

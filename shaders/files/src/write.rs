//! Bytes → an output, of whatever kind it is.

use std::fs::File;
use std::io::{self, Cursor, Write};
use std::path::Path;

use crate::error::FileError;
use crate::inject::step;
use crate::replace::replace;
use crate::sink::Sink;
use crate::steps::gather;
use crate::target::Target;

/// Writes an output.
///
/// A regular file, at the end of all symbolic links, is there whole or not at all, with the mode and as far as the
/// system allows the owner of the one before. Standard output (`-`), devices and pipes are written to; who stops
/// reading a pipe is no error. A folder is refused.
pub fn write(
    path: &Path,
    content: impl FnOnce(&mut dyn Write) -> io::Result<()>,
) -> Result<(), FileError> {
    match Target::of(path)? {
        Target::Stdout => stream(path, &mut io::stdout().lock(), content),
        Target::Stream(at) => {
            let opened = step().and_then(|()| File::options().write(true).open(at));
            stream(path, &mut opened.map_err(FileError::io("open", path))?, content)
        }
        Target::File { path: at, existing } => {
            replace(path, &at, existing.as_ref(), |out| content(out))
        }
    }
}

/// As [`write()`], for content that goes back in what it has written. Standard output, devices and pipes get it when it
/// is whole, so it is in memory until then.
pub fn write_seekable(
    path: &Path,
    content: impl FnOnce(&mut dyn Sink) -> io::Result<()>,
) -> Result<(), FileError> {
    if let Target::File { path: at, existing } = Target::of(path)? {
        return replace(path, &at, existing.as_ref(), content);
    }
    let mut whole = Cursor::new(Vec::new());
    content(&mut whole).map_err(FileError::io("write", path))?;
    write(path, |out| out.write_all(whole.get_ref()))
}

fn stream(
    path: &Path,
    out: &mut dyn Write,
    content: impl FnOnce(&mut dyn Write) -> io::Result<()>,
) -> Result<(), FileError> {
    let mut out = gather(out);
    let written = content(&mut out).and_then(|()| out.flush());
    // What could not be written must not be tried again when the buffer goes.
    drop(out.into_parts());
    quiet(written).map_err(FileError::io("write", path))
}

/// Writes a text to standard output; who stops reading it, as `head` does, is no error.
pub fn write_stdout(text: &str) -> io::Result<()> {
    let mut out = io::stdout().lock();
    quiet(step().and_then(|()| out.write_all(text.as_bytes())).and_then(|()| out.flush()))
}

fn quiet(result: io::Result<()>) -> io::Result<()> {
    match result {
        Err(error) if error.kind() == io::ErrorKind::BrokenPipe => Ok(()),
        result => result,
    }
}

#[cfg(all(test, unix))]
mod tests {
    use super::*;
    use std::os::unix::fs::{MetadataExt as _, PermissionsExt as _, symlink};
    use std::path::PathBuf;
    use std::thread::JoinHandle;

    /// A pipe, and what somebody reads from it.
    fn pipe(dir: &Path) -> (PathBuf, JoinHandle<Vec<u8>>) {
        let pipe = dir.join("pipe");
        let mode = rustix::fs::Mode::from_raw_mode(0o600);
        rustix::fs::mkfifoat(rustix::fs::CWD, &pipe, mode).expect("a pipe");
        let from = pipe.clone();
        (pipe, std::thread::spawn(move || std::fs::read(from).expect("its bytes")))
    }

    #[test]
    fn links_are_followed_and_the_mode_stays() {
        let dir = tempfile::tempdir().unwrap();
        let at = |name: &str| dir.path().join(name);
        std::fs::create_dir(at("deep")).unwrap();
        std::fs::write(at("deep/real"), "old").unwrap();
        std::fs::set_permissions(at("deep/real"), std::fs::Permissions::from_mode(0o640)).unwrap();
        symlink("deep/real", at("link")).unwrap();
        symlink("deep/none", at("dangling")).unwrap();
        for (name, real) in [("link", "deep/real"), ("dangling", "deep/none")] {
            write(&at(name), |out| out.write_all(b"new")).unwrap();
            assert!(std::fs::symlink_metadata(at(name)).unwrap().is_symlink(), "{name}");
            assert_eq!(std::fs::read(at(real)).unwrap(), b"new");
        }
        assert_eq!(std::fs::metadata(at("deep/real")).unwrap().mode() & 0o777, 0o640);
        symlink("circle", at("circle")).unwrap();
        assert!(write(&at("circle"), |_| Ok(())).is_err());
        assert!(matches!(write(&at("deep"), |_| Ok(())), Err(FileError::Folder { .. })));
    }

    #[test]
    fn devices_and_pipes_are_written_to_and_stay_what_they_are() {
        write(Path::new("/dev/null"), |out| out.write_all(b"gone")).unwrap();
        assert!(!std::fs::metadata("/dev/null").unwrap().is_file());
        #[cfg(target_os = "linux")]
        assert!(write(Path::new("/dev/full"), |out| out.write_all(b"no room")).is_err());
        let dir = tempfile::tempdir().unwrap();
        let (pipe, reader) = pipe(dir.path());
        write(&pipe, |out| out.write_all(b"through it")).unwrap();
        assert_eq!(reader.join().unwrap(), b"through it");
    }

    #[test]
    fn content_may_go_back_in_what_it_has_written() {
        let dir = tempfile::tempdir().unwrap();
        let content = |out: &mut dyn Sink| {
            out.write_all(b"?ell")?;
            out.seek(io::SeekFrom::Start(0))?;
            out.write_all(b"w")
        };
        let path = dir.path().join("a");
        write_seekable(&path, content).unwrap();
        assert_eq!(std::fs::read(&path).unwrap(), b"well");
        let (pipe, reader) = pipe(dir.path());
        write_seekable(&pipe, content).unwrap();
        assert_eq!(reader.join().unwrap(), b"well");
    }

    #[test]
    fn a_file_that_may_not_be_written_is_not_replaced() {
        let dir = tempfile::tempdir().unwrap();
        let path = dir.path().join("kept");
        std::fs::write(&path, "kept").unwrap();
        std::fs::set_permissions(&path, std::fs::Permissions::from_mode(0o444)).unwrap();
        // The superuser may write to it all the same.
        if File::options().append(true).open(&path).is_err() {
            assert!(write(&path, |out| out.write_all(b"new")).is_err());
            assert_eq!(std::fs::read(&path).unwrap(), b"kept");
        }
    }
}

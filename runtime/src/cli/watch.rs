//! `rtr --watch`: renders a pack again whenever it is replaced.
//!
//! The file is polled for size and time, as `rtc --watch` does with the files of a scene. A pack that
//! cannot be read is reported and waited out: whoever writes it may not be done.

use super::Exit;
use super::args::RenderArgs;
use super::console::{Console, is_interrupted, reset_interrupts};
use super::outputs::Output;
use super::render;
use crate::control::Observer;
use files::ShowPath as _;
use std::path::{Path, PathBuf};
use std::sync::{Arc, OnceLock};
use std::time::{Duration, SystemTime};

/// Between two looks at the file.
const POLL: Duration = Duration::from_millis(100);

/// A file as it was, to find out whether it is still so.
#[derive(Clone, Debug)]
pub(super) struct Change {
    path: PathBuf,
    stamp: Option<(u64, SystemTime)>,
    /// Names of the pictures, which stay what they were for the first.
    names: Arc<OnceLock<Vec<Output>>>,
}

impl Change {
    /// Of the file as it is now.
    pub(super) fn of(path: &Path) -> Self {
        Self { path: path.to_owned(), stamp: stamp(path), names: Arc::default() }
    }

    /// The names of the pictures; `first` makes them where there are none yet.
    pub(super) fn names<E>(
        &self,
        first: impl FnOnce() -> Result<Vec<Output>, E>,
    ) -> Result<Vec<Output>, E> {
        match self.names.get() {
            Some(names) => Ok(names.clone()),
            None => first().map(|names| self.names.get_or_init(|| names).clone()),
        }
    }

    /// Whether the file is another one by now.
    pub(super) fn has_come(&self) -> bool {
        stamp(&self.path) != self.stamp
    }
}

fn stamp(path: &Path) -> Option<(u64, SystemTime)> {
    let data = std::fs::metadata(path).ok()?;
    Some((data.len(), data.modified().ok()?))
}

/// Renders until Ctrl-C. What is wrong with the arguments ends it at once, what is wrong with the
/// pack does not.
pub(super) fn command(args: &RenderArgs, observer: &'static Observer) -> Exit {
    let console = Console::new(args.quiet);
    let path = args.pack.as_deref().unwrap_or(Path::new(""));
    reset_interrupts();
    let names = Arc::default();
    loop {
        let change = Change { names: Arc::clone(&names), ..Change::of(path) };
        let exit = render::command(args, observer, Some(&change));
        if matches!(exit, Exit::Usage | Exit::Interrupted) {
            return exit;
        }
        if !change.has_come() {
            console.note(&format!("watching {}; Ctrl-C ends", path.shown()));
        }
        while !change.has_come() {
            if is_interrupted() {
                return Exit::Done;
            }
            std::thread::sleep(POLL);
        }
        console.note(&format!("{} has changed", path.shown()));
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_change_is_noticed_by_size_time_and_absence() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("a.pack");
        let missing = Change::of(&path);
        assert!(!missing.has_come());
        std::fs::write(&path, "one").unwrap();
        assert!(missing.has_come());
        let one = Change::of(&path);
        assert!(!one.has_come());
        std::fs::write(&path, "four").unwrap();
        assert!(one.has_come());
        let four = Change::of(&path);
        let file = std::fs::File::options().append(true).open(&path).unwrap();
        file.set_modified(SystemTime::UNIX_EPOCH).unwrap();
        assert!(four.has_come());
        std::fs::remove_file(&path).unwrap();
        assert!(four.has_come() && one.has_come() && !missing.has_come());
    }
}

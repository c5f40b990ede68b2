//! `rtc --watch`: compiles again whenever a file that the scene depends on changes.
//!
//! Files are polled for size and time, four times a second: that needs no service of the system,
//! works on network folders and in containers, sees files that are not there yet, and costs nothing
//! for the few hundred files of a scene. A change waits until nothing changes any more, so that an
//! editor or a generator that writes many files causes one compilation. Errors are shown and watching
//! goes on; the pack is replaced only by a complete one.

use files::ShowPath as _;
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::sync::atomic::{AtomicU32, Ordering};
use std::time::{Duration, Instant};

use super::args::OK;
use crate::pipeline::Session;
use crate::reads::Stamp;
use crate::report::Reporter;

/// Between two looks at the files.
const POLL: Duration = Duration::from_millis(250);
/// Nothing changed for this long: whoever writes is done.
const CALM: Duration = Duration::from_millis(150);
/// Somebody who never stops writing is not waited for any longer.
const PATIENCE: Duration = Duration::from_secs(5);
/// Names of changed files in a line.
const MOST_NAMES: usize = 3;

type Stamps = BTreeMap<PathBuf, Stamp>;

/// Calls `build`, which says whether it went well, after every change until Ctrl-C.
pub(super) fn watch(reporter: &Reporter, build: impl Fn(&Session) -> bool) -> u8 {
    let interrupts = interrupts();
    let session = Session::keeping();
    loop {
        session.begin();
        let well = build(&session);
        let mut stamps = session.reads.all();
        let n = stamps.len();
        if !well {
            add_folders(&mut stamps);
        }
        let plural = if n == 1 { "" } else { "s" };
        reporter.status(&format!("watching {n} file{plural}; press Ctrl-C to stop"));
        match changed(&stamps, &interrupts) {
            Some(names) => reporter.status(&format!("\nchanged: {names}")),
            None => return OK,
        }
    }
}

/// A file that is missing may be one that was never asked for by name, as the MTL of an OBJ: while
/// there are errors, what comes and goes beside the files counts, too.
fn add_folders(stamps: &mut Stamps) {
    let folder = |path: &PathBuf| match path.parent()? {
        empty if empty.as_os_str().is_empty() => Some(PathBuf::from(".")),
        folder => Some(folder.to_owned()),
    };
    let folders: Vec<PathBuf> = stamps.keys().filter_map(folder).collect();
    stamps.extend(folders.into_iter().map(|folder| {
        let stamp = Stamp::of(&folder);
        (folder, stamp)
    }));
}

/// Waits for a change; `None` after Ctrl-C.
fn changed(stamps: &Stamps, interrupts: &AtomicU32) -> Option<String> {
    let is_over = || interrupts.load(Ordering::Relaxed) > 0;
    loop {
        if is_over() {
            return None;
        }
        let names = different(stamps, &now(stamps));
        if names.is_empty() {
            std::thread::sleep(POLL);
            continue;
        }
        let start = Instant::now();
        let mut last = now(stamps);
        while start.elapsed() < PATIENCE && !is_over() {
            std::thread::sleep(CALM);
            let next = now(stamps);
            if next == last {
                break;
            }
            last = next;
        }
        let after = different(stamps, &last);
        return Some(listed(if after.is_empty() { &names } else { &after }));
    }
}

fn now(stamps: &Stamps) -> Stamps {
    stamps.keys().map(|path| (path.clone(), Stamp::of(path))).collect()
}

fn different<'a>(before: &'a Stamps, after: &Stamps) -> Vec<&'a Path> {
    let differs = |(path, stamp): &(&PathBuf, &Stamp)| after.get(*path) != Some(*stamp);
    before.iter().filter(differs).map(|(path, _)| path.as_path()).collect()
}

fn listed(paths: &[&Path]) -> String {
    let names = paths.iter().take(MOST_NAMES).map(|path| path.shown().to_string());
    let names = names.collect::<Vec<_>>().join(", ");
    match paths.len().checked_sub(MOST_NAMES) {
        Some(more @ 1..) => format!("{names} and {more} more"),
        _ => names,
    }
}

/// Number of Ctrl-C, SIGTERM and SIGHUP so far. The first ends watching once the compilation under way is done, the
/// second ends the process.
fn interrupts() -> Arc<AtomicU32> {
    let count = Arc::new(AtomicU32::new(0));
    let counter = Arc::clone(&count);
    // Without it an interrupt ends the process at once, which leaves every file as it was.
    let _ = host::on_interrupt(move || {
        if counter.fetch_add(1, Ordering::Relaxed) > 0 {
            std::process::exit(130);
        }
    });
    count
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn many_changes_are_one_line() {
        let paths = ["a", "b", "c", "d", "e"].map(Path::new);
        assert_eq!(listed(&paths[..3]), "a, b, c");
        assert_eq!(listed(&paths), "a, b, c and 2 more");
    }

    #[test]
    fn a_file_that_changes_appears_or_goes_is_different() {
        let folder = tempfile::tempdir().unwrap();
        let at = |name: &str| folder.path().join(name);
        for name in ["same", "longer", "gone"] {
            std::fs::write(at(name), "1").unwrap();
        }
        let names = ["same", "longer", "gone", "new"];
        let before: Stamps = names.map(|name| (at(name), Stamp::of(&at(name)))).into();
        assert!(different(&before, &now(&before)).is_empty());
        std::fs::write(at("longer"), "22").unwrap();
        std::fs::remove_file(at("gone")).unwrap();
        std::fs::write(at("new"), "1").unwrap();
        let found: Vec<PathBuf> =
            different(&before, &now(&before)).into_iter().map(Path::to_owned).collect();
        assert_eq!(found, [at("gone"), at("longer"), at("new")]);
    }
}

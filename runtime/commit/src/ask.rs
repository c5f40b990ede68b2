//! A folder → the commit that is checked out there, in git's words. It does not fail: without git, and where there is
//! no repository, there is no commit.

use std::path::{Path, PathBuf};
use std::process::Command;

/// What `rtr` is made of, from the root of the workspace.
pub(crate) const SOURCES: &[&str] = &[
    "Cargo.toml",
    "Cargo.lock",
    "runtime/Cargo.toml",
    "runtime/build.rs",
    "runtime/build",
    "runtime/commit",
    "runtime/src",
    "shaders",
];

/// `git describe` of the repository at `root`, with `-dirty` where a source of `rtr` is not as it was committed, and
/// the file that changes with each commit and checkout. `None` if `root` is not the root of a repository: that of a
/// folder around it says nothing about this one.
pub(crate) fn git(root: &Path) -> Option<(String, PathBuf)> {
    let root = root.canonicalize().ok()?;
    let top = say(&root, &["rev-parse", "--show-toplevel"])?;
    if Path::new(&top).canonicalize().ok()? != root {
        return None;
    }
    let mut commit = say(&root, &["describe", "--always", "--abbrev=12"])?;
    let changed = say(&root, &[&["status", "--porcelain", "--"], SOURCES].concat())?;
    if !changed.is_empty() {
        commit += "-dirty";
    }
    // Without a log, the file that says what is checked out changes with checkouts at least.
    let path = |name| say(&root, &["rev-parse", "--git-path", name]).map(|path| root.join(path));
    let log = path("logs/HEAD").filter(|log| log.is_file()).or_else(|| path("HEAD"))?;
    Some((commit, log))
}

/// What git answers; nothing if it fails or is not there.
fn say(root: &Path, arguments: &[&str]) -> Option<String> {
    let output = Command::new("git").arg("-C").arg(root).args(arguments).output().ok()?;
    let text = String::from_utf8(output.stdout).ok()?;
    output.status.success().then(|| text.trim().to_owned())
}

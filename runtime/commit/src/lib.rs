//! The commit that `rtr` was built from. Nothing else is here, so that a new commit costs no more than it must.

#[cfg(test)]
mod ask;

/// In git's words, such as `v0.1.0-12-g0123456789ab` or `0123456789ab-dirty`, or what `RTR_COMMIT` said when it was
/// built. `None` in development builds and outside of a repository.
pub const COMMIT: Option<&str> = option_env!("BUILT_FROM");

#[cfg(test)]
mod tests {
    use super::ask;
    use std::path::Path;
    use std::process::Command;

    /// Runs git as somebody without a configuration; false where there is no git.
    fn git(folder: &Path, arguments: &[&str]) -> bool {
        let who = ["-c", "user.name=a", "-c", "user.email=a@b", "-c", "commit.gpgsign=false"];
        let mut command = Command::new("git");
        command.arg("-C").arg(folder).args(who).args(arguments);
        command.output().is_ok_and(|output| output.status.success())
    }

    fn write(folder: &Path, text: &str) {
        std::fs::create_dir_all(folder.join("runtime/src")).expect("it can be made");
        std::fs::write(folder.join("runtime/src/lib.rs"), text).expect("it can be written");
    }

    #[test]
    fn a_repository_has_a_commit_and_says_when_it_was_changed() {
        let folder = tempfile::tempdir().expect("a folder for tests");
        let folder = folder.path();
        write(folder, "one");
        if !git(folder, &["init", "-q"]) {
            return;
        }
        assert_eq!(ask::git(folder), None, "nothing was committed yet");
        assert!(git(folder, &["add", "."]) && git(folder, &["commit", "-q", "-m", "one"]));
        let (commit, log) = ask::git(folder).expect("there is a commit");
        assert_eq!(commit.len(), 12, "{commit}");
        assert!(commit.bytes().all(|b| b.is_ascii_hexdigit()) && log.is_file(), "{commit} {log:?}");
        // What `rtr` is not made of does not count.
        std::fs::write(folder.join("notes.md"), "two").expect("it can be written");
        assert_eq!(ask::git(folder).map(|found| found.0), Some(commit.clone()));
        write(folder, "two");
        assert_eq!(ask::git(folder).map(|found| found.0), Some(format!("{commit}-dirty")));
        // A folder in a repository is not one.
        assert_eq!(ask::git(&folder.join("runtime")), None);
        assert!(git(folder, &["commit", "-q", "-a", "-m", "two"]));
        let (second, _) = ask::git(folder).expect("there is a commit");
        assert!(second != commit && !second.ends_with("-dirty"), "{second}");
    }

    #[test]
    fn without_a_repository_there_is_no_commit() {
        let folder = tempfile::tempdir().expect("a folder for tests");
        assert_eq!(ask::git(folder.path()), None);
        assert_eq!(ask::git(&folder.path().join("absent")), None);
    }
}

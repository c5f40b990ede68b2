//! Which files a program reads and writes: no output is an input, and no two outputs are one file.

use std::collections::BTreeMap;
use std::ffi::OsString;
use std::path::{Path, PathBuf};

use file_id::FileId;

use crate::show::ShowPath as _;
use crate::target::{Target, folder};

/// Two uses of one file that exclude each other.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("{} is {what} and cannot be {other} as well{}", path.shown(), also(path, known))]
pub struct Clash {
    /// The output.
    path: PathBuf,
    /// The name under which the file is known.
    known: PathBuf,
    /// What the file is already.
    what: String,
    /// What it was to become.
    other: String,
}

/// ` (as b.rts)`, when one file has two names.
fn also(path: &Path, known: &Path) -> String {
    if path == known {
        String::new()
    } else {
        format!(" (it is the same file as {})", known.shown())
    }
}

/// What identifies a file.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord)]
enum Identity {
    Stdout,
    /// A file that exists: its number in its file system, which all of its names share.
    Existing(IdOf),
    /// A file that is to be made: its folder's number and its name.
    New(IdOf, OsString),
    /// A name of which no more is known.
    Name(PathBuf),
}

/// Numbers of a file; `FileId` has no order.
type IdOf = (u64, u128);

/// Inputs and outputs of one run.
#[derive(Clone, Debug, Default)]
pub struct Claims {
    taken: BTreeMap<Identity, (PathBuf, String, bool)>,
}

impl Claims {
    /// No files.
    #[must_use]
    pub fn new() -> Self {
        Self::default()
    }

    /// Notes a file that is read; `what` says so: `the scene`, `an input of the scene`.
    ///
    /// # Errors
    /// When the file is an output already.
    pub fn input(&mut self, path: &Path, what: &str) -> Result<(), Clash> {
        // What is not there is not read, and what is no file loses nothing.
        let Some(identity @ Identity::Existing(_)) = identity(path) else { return Ok(()) };
        match self.taken.get(&identity) {
            Some((output, role, true)) => Err(Clash {
                path: output.clone(),
                known: path.to_owned(),
                what: what.to_owned(),
                other: role.clone(),
            }),
            Some(_) => Ok(()),
            None => {
                self.taken.insert(identity, (path.to_owned(), what.to_owned(), false));
                Ok(())
            }
        }
    }

    /// Notes a file that is written; `what`: `the pack`, `the output of --depfile`.
    ///
    /// # Errors
    /// When the file is an input, or another output.
    pub fn output(&mut self, path: &Path, what: &str) -> Result<(), Clash> {
        // Devices take whatever they are given, from several writers, too.
        let Some(identity) = identity(path) else { return Ok(()) };
        if let Some((known, role, _)) = self.taken.get(&identity) {
            return Err(Clash {
                path: path.to_owned(),
                known: known.clone(),
                what: role.clone(),
                other: what.to_owned(),
            });
        }
        self.taken.insert(identity, (path.to_owned(), what.to_owned(), true));
        Ok(())
    }
}

/// `None` for devices, pipes and folders.
fn identity(path: &Path) -> Option<Identity> {
    match Target::of(path) {
        Ok(Target::Stdout) => Some(Identity::Stdout),
        Ok(Target::File { path, existing: Some(_) }) => {
            Some(number(&path).map_or(Identity::Name(path), Identity::Existing))
        }
        Ok(Target::File { path, existing: None }) => {
            let name = path.file_name()?.to_owned();
            Some(match number(folder(&path)) {
                Some(folder) => Identity::New(folder, name),
                None => Identity::Name(path),
            })
        }
        Ok(Target::Stream(_)) | Err(_) => None,
    }
}

fn number(path: &Path) -> Option<IdOf> {
    Some(match file_id::get_file_id(path).ok()? {
        FileId::Inode { device_id, inode_number } => (device_id, u128::from(inode_number)),
        FileId::LowRes { volume_serial_number, file_index } => {
            (u64::from(volume_serial_number), u128::from(file_index))
        }
        FileId::HighRes { volume_serial_number, file_id } => (volume_serial_number, file_id),
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_output_is_no_input_and_no_other_output_under_any_name() {
        let dir = tempfile::tempdir().unwrap();
        let at = |name: &str| dir.path().join(name);
        std::fs::write(at("a.rts"), "").unwrap();
        std::fs::hard_link(at("a.rts"), at("hard.rts")).unwrap();
        let mut names = vec![at("a.rts"), at("hard.rts"), at(".").join("a.rts")];
        #[cfg(unix)]
        {
            std::os::unix::fs::symlink("a.rts", at("soft.rts")).unwrap();
            std::os::unix::fs::symlink(dir.path(), at("folder")).unwrap();
            names.extend([at("soft.rts"), at("folder/a.rts")]);
        }
        for name in names {
            let mut claims = Claims::new();
            claims.input(&at("a.rts"), "the scene").unwrap();
            let clash = claims.output(&name, "the pack").unwrap_err().to_string();
            assert!(clash.contains("is the scene and cannot be the pack as well"), "{clash}");
            // The other way round: inputs are often known last.
            let mut claims = Claims::new();
            claims.output(&name, "the pack").unwrap();
            assert!(claims.input(&at("a.rts"), "the scene").is_err());
        }
        let mut claims = Claims::new();
        claims.output(&at("new"), "the pack").unwrap();
        assert!(claims.output(&at("./new"), "the depfile").is_err());
        claims.output(&at("new2"), "the depfile").unwrap();
        claims.output(Path::new("-"), "the pack").unwrap();
        assert!(claims.output(Path::new("/dev/stdout"), "the kernel").is_err());
        if cfg!(unix) {
            claims.output(Path::new("/dev/null"), "the report").unwrap();
            claims.output(Path::new("/dev/null"), "the plot").unwrap();
        }
    }
}

//! The seeds on disk, `tests/corpus/TARGET/NAME`.
//!
//! A name that begins with `good-` must be accepted, one with `bad-` refused; others, such as inputs
//! that once made a reader fail, may be either.

use std::fs;
use std::io;
use std::path::{Path, PathBuf};

use super::Target;

/// An input to start from.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Seed {
    /// File name.
    pub name: String,
    /// The input.
    pub bytes: Vec<u8>,
}

impl Seed {
    /// What its name says about its fate, if anything.
    #[must_use]
    pub fn is_good(&self) -> Option<bool> {
        match self.name.split_once('-') {
            Some(("good", _)) => Some(true),
            Some(("bad", _)) => Some(false),
            _ => None,
        }
    }
}

/// The folder of a target's seeds.
#[must_use]
pub fn folder(target: &Target) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("corpus").join(target.name)
}

/// The seeds of a target, sorted by name.
///
/// # Errors
/// When they cannot be read.
pub fn seeds(target: &Target) -> io::Result<Vec<Seed>> {
    let mut seeds = Vec::new();
    for entry in fs::read_dir(folder(target))? {
        let path = entry?.path();
        let name = path.file_name().unwrap_or_default().to_string_lossy().into_owned();
        seeds.push(Seed { name, bytes: fs::read(&path)? });
    }
    seeds.sort_by(|a, b| a.name.cmp(&b.name));
    Ok(seeds)
}

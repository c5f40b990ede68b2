//! A parsed file with its name for messages.

use crate::import::error::{ErrorKind, ImportError, excerpt};
use ::gltf::json::Root;

/// A parsed file with its name for messages.
pub(super) struct Document<'a> {
    pub(super) root: &'a Root,
    pub(super) file: &'a str,
}

impl Document<'_> {
    /// An error about something inside the file: `file: accessor 3: message`.
    pub(super) fn error(
        &self,
        kind: ErrorKind,
        what: &str,
        message: impl Into<String>,
    ) -> ImportError {
        ImportError::new(kind, format!("{}: {what}", self.file), message)
    }
}

/// What there is, by name; at most ten.
pub(super) fn list<'n>(what: &str, names: impl Iterator<Item = &'n str>) -> String {
    const MOST: usize = 10;
    let quoted: Vec<String> = names.map(|name| format!("`{}`", excerpt(name.as_bytes()))).collect();
    match quoted.len() {
        0 => format!("{what} without names"),
        n if n > MOST => format!("{what} {} and {} more", quoted[..MOST].join(", "), n - MOST),
        _ => format!("{what} {}", quoted.join(", ")),
    }
}

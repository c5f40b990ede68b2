//! A parsed file with its name for messages.

use crate::import::error::{ErrorKind, ImportError};
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

//! Text becomes a syntax tree and the list of everything in it that could not be read.

use crate::diagnostic::Diagnostic;
use crate::source::{FileId, SourceSet};
use crate::syntax::File;

/// Reads one file. Never fails: what cannot be read is poisoned in the tree and reported.
#[must_use]
pub fn parse(_sources: &SourceSet, _file: FileId) -> (File, Vec<Diagnostic>) {
    (File::default(), Vec::new())
}

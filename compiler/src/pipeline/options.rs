//! What a compilation is given besides the scene.

use std::path::Path;

use crate::import::Limits;
use crate::lower::Trees;

/// What a compilation is given besides the scene.
#[derive(Debug)]
pub struct Options<'a> {
    /// Directory of the root `.rts` file; names in the pack are relative to it.
    pub root: &'a Path,
    /// How trees are made.
    pub trees: Trees<'a>,
    /// How large inputs may be.
    pub limits: Limits,
    /// Overrides of parameters, for the manifest.
    pub defines: &'a [(String, String)],
}

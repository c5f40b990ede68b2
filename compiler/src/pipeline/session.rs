//! What compilations of one process share.

use crate::kept::Kept;
use crate::reads::Reads;

/// One compilation, or those of a `rtc --watch`, one after the other.
#[derive(Debug, Default)]
pub struct Session {
    /// Files that the compilation reads.
    pub reads: Reads,
    /// What is in memory from the last one.
    pub kept: Kept,
}

impl Session {
    /// For one compilation.
    #[must_use]
    pub fn once() -> Self {
        Self::default()
    }

    /// For compilations one after the other.
    #[must_use]
    pub fn keeping() -> Self {
        Self { kept: Kept::keeping(), ..Self::default() }
    }

    /// A compilation begins.
    pub fn begin(&self) {
        self.reads.begin();
        self.kept.begin();
    }
}

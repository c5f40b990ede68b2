//! Packs that are mapped as `rtr` maps them, for what is measured: the one place here where a file is.

use std::path::Path;

use pack::{Pack, PackError};

/// Maps and checks a pack that this process has written where nobody else looks.
///
/// # Errors
/// When it cannot be read or breaks a rule.
pub fn map(path: impl AsRef<Path>) -> Result<Pack, PackError> {
    #[expect(unsafe_code, reason = "the one mapping of the tests")]
    // SAFETY: callers write packs into temporary folders of their own, once, and read them afterwards.
    unsafe {
        Pack::map(path)
    }
}

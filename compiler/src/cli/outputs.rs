//! What a compilation writes: proven to be writable before it begins, and to be none of its inputs before it is
//! written.

use std::path::{Path, PathBuf};

use files::Claims;

use super::args::{IO, USAGE};
use crate::report::Reporter;

/// The files that a compilation is going to write.
pub(super) struct Outputs {
    claims: Claims,
}

impl Outputs {
    /// `list`: each output with what it is. What is wrong is reported and becomes an exit code.
    pub(super) fn new(
        scene: &Path,
        list: &[(&Path, &str)],
        reporter: &Reporter,
    ) -> Result<Self, u8> {
        let mut claims = Claims::new();
        let mut claimed = claims.input(scene, "the scene");
        for (path, what) in list {
            claimed = claimed.and_then(|()| claims.output(path, what));
        }
        claimed.map_err(|clash| {
            reporter.failure(&clash.to_string());
            USAGE
        })?;
        for (path, _) in list {
            files::probe(path, 0).map_err(|error| {
                reporter.failure(&error.to_string());
                IO
            })?;
        }
        Ok(Self { claims })
    }

    /// Whether an output is a file that was read; that, too, is reported.
    pub(super) fn spare<'a>(
        &self,
        inputs: impl IntoIterator<Item = &'a PathBuf>,
        reporter: &Reporter,
    ) -> Result<(), u8> {
        let mut claims = self.claims.clone();
        let mut inputs = inputs.into_iter();
        inputs.try_for_each(|path| claims.input(path, "an input of the scene")).map_err(|clash| {
            reporter.failure(&clash.to_string());
            USAGE
        })
    }
}

//! The one error of importing: where, what, and what to do about it.

use files::ShowPath as _;
use std::path::Path;

/// Which rule an input broke; decides the code under which a diagnostic is shown.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ErrorKind {
    /// The file is not there, or not with this spelling.
    Missing,
    /// The file is there but cannot be read.
    Io,
    /// The bytes are not of the format they should be, or break its rules.
    Format,
    /// A number is not finite or does not fit.
    Number,
    /// An index points outside its array.
    Index,
    /// An accessor, buffer or buffer view of a glTF file lies outside its data.
    Accessor,
    /// A glTF file requires an extension that is not supported.
    Extension,
    /// The file has nothing of a name that the scene asks for.
    Choice,
    /// The file has no triangles.
    Empty,
    /// The file is larger than a limit allows.
    Limit,
    /// An image cannot be decoded.
    Image,
    /// The file lies outside of the folder that inputs must lie in.
    Outside,
    /// There is no memory for it, or the budget allows no more; no fault of the scene.
    Memory,
}

/// A file that cannot be used, with the place of the first reason.
#[derive(Debug, thiserror::Error)]
#[error("{place}: {message}")]
pub struct ImportError {
    /// Which rule is broken.
    pub kind: ErrorKind,
    /// `file`, `file:line` or `file: accessor 3`, the file as the caller named it.
    pub place: String,
    /// What was found and what was expected, in one line.
    pub message: String,
    /// What the user can do; empty when there is nothing to say.
    pub help: String,
    /// The failure underneath, if the operating system reported one.
    #[source]
    pub source: Option<std::io::Error>,
}

impl ImportError {
    /// An error without a deeper cause.
    pub(super) fn new(
        kind: ErrorKind,
        place: impl Into<String>,
        message: impl Into<String>,
    ) -> Self {
        let (place, message) = (clipped(place.into()), message.into());
        Self { kind, place, message, help: String::new(), source: None }
    }

    /// The file is not what it was when it was known what it holds.
    #[must_use]
    pub fn changed(path: &Path) -> Self {
        let place = path.shown().to_string();
        Self::new(ErrorKind::Io, place, "the file changed while it was read")
    }

    /// The same error with advice.
    pub(super) fn with_help(mut self, help: impl Into<String>) -> Self {
        self.help = help.into();
        self
    }
}

/// A place without its middle when it is long: files name others, and a name may be a page of data.
fn clipped(place: String) -> String {
    const MAX_CHARS: usize = 200;
    const MAX_END: usize = 80; // line or accessor, and the end of the name
    let n_chars = place.chars().count();
    if n_chars <= MAX_CHARS {
        return place;
    }
    let start = place.chars().take(MAX_CHARS - MAX_END);
    let end = place.chars().skip(n_chars - MAX_END);
    start.chain(['…']).chain(end).collect()
}

/// `text` shortened and stripped of control characters, to be quoted in a message.
pub(super) fn excerpt(text: &[u8]) -> String {
    const MAX_CHARS: usize = 40; // keeps a message on one line of a terminal
    let text = String::from_utf8_lossy(&text[..text.len().min(4 * MAX_CHARS)]);
    let mut short: String =
        text.chars().take(MAX_CHARS).map(|c| if c.is_control() { '\u{fffd}' } else { c }).collect();
    if text.chars().nth(MAX_CHARS).is_some() {
        short.push('…');
    }
    short
}

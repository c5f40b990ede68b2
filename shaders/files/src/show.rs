//! Names and texts from outside → text that is safe to print.
//!
//! A terminal obeys control characters, and a reader believes what bidirectional overrides make of a line. Both
//! are shown as `\u{1b}`; everything else stays as it is.

use std::borrow::Cow;
use std::fmt;
use std::path::Path;

/// The text with every control character, line breaks included, written as an escape.
#[must_use]
pub fn escape(text: &str) -> Cow<'_, str> {
    escape_if(text, is_unsafe)
}

/// As [`escape`], but line breaks and tabs stay: for texts that are several lines on purpose.
#[must_use]
pub fn escape_lines(text: &str) -> Cow<'_, str> {
    escape_if(text, |c| is_unsafe(c) && !matches!(c, '\n' | '\t'))
}

/// C0, DEL and C1 controls, and what reorders or hides text (Boucher and Anderson 2021, "Trojan Source").
fn is_unsafe(c: char) -> bool {
    let reorders = matches!(
        c,
        '\u{61c}' | '\u{200e}' | '\u{200f}' | '\u{202a}'..='\u{202e}' | '\u{2066}'..='\u{2069}'
    );
    c.is_control() || reorders || matches!(c, '\u{2028}' | '\u{2029}')
}

fn escape_if(text: &str, escapes: impl Fn(char) -> bool) -> Cow<'_, str> {
    if !text.chars().any(&escapes) {
        return Cow::Borrowed(text);
    }
    let mut out = String::with_capacity(text.len() + 8);
    for c in text.chars() {
        match c {
            '\n' if escapes(c) => out.push_str("\\n"),
            '\t' if escapes(c) => out.push_str("\\t"),
            '\r' if escapes(c) => out.push_str("\\r"),
            c if escapes(c) => out.extend(c.escape_unicode()),
            c => out.push(c),
        }
    }
    Cow::Owned(out)
}

/// Paths as they may be printed.
pub trait ShowPath {
    /// The path with control characters escaped; bytes that are no text become U+FFFD.
    fn shown(&self) -> Shown<'_>;
}

impl<P: AsRef<Path> + ?Sized> ShowPath for P {
    fn shown(&self) -> Shown<'_> {
        Shown(self.as_ref())
    }
}

/// A path that prints itself safely; see [`ShowPath`].
#[derive(Clone, Copy, Debug)]
pub struct Shown<'a>(&'a Path);

impl fmt::Display for Shown<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&escape(&self.0.to_string_lossy()))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn nothing_that_is_shown_steers_a_terminal_or_reorders_a_line() {
        assert_eq!(escape("plain ünïcode 😀 text"), "plain ünïcode 😀 text");
        assert_eq!(escape("\u{1b}[2J\u{7}a\nb\tc\r"), "\\u{1b}[2J\\u{7}a\\nb\\tc\\r");
        assert_eq!(escape("\u{9b}31m\u{7f}\u{202e}gnp"), "\\u{9b}31m\\u{7f}\\u{202e}gnp");
        assert_eq!(escape_lines("a\n\tb\u{1b}"), "a\n\tb\\u{1b}");
        assert_eq!("x\u{1b}/y".shown().to_string(), "x\\u{1b}/y");
    }
}

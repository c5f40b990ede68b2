//! Text becomes logical lines, words and finite numbers; knows no keyword of OBJ, MTL or STL.

use super::error::{ErrorKind, excerpt};
use std::borrow::Cow;

/// Longest logical line, bytes; no honest line is longer.
pub(super) const MAX_LINE: usize = 1 << 20;

/// The logical lines of a text: a `\` at the end of a line continues it on the next.
pub(super) struct Lines<'a> {
    rest: &'a [u8],
    /// Number of the first physical line of the logical line at hand, from 1; 0 before the first.
    number: u64,
    /// Physical lines of it beyond that one.
    n_continued: u64,
    joined: Vec<u8>,
}

impl<'a> Lines<'a> {
    pub(super) fn new(text: &'a [u8]) -> Self {
        let rest = text.strip_prefix(b"\xef\xbb\xbf").unwrap_or(text);
        Self { rest, number: 0, n_continued: 0, joined: Vec::new() }
    }

    /// The next line with its number, without the white space around it, or `None` at the end. What continues a line beyond
    /// `MAX_LINE` is not joined to it.
    pub(super) fn next(&mut self) -> Option<(u64, &[u8])> {
        if self.rest.is_empty() {
            return None;
        }
        self.number += 1 + std::mem::take(&mut self.n_continued);
        let mut line = self.physical();
        if !line.ends_with(b"\\") {
            return Some((self.number, line));
        }
        self.joined.clear();
        while let Some(start) = line.strip_suffix(b"\\") {
            self.joined.extend_from_slice(start);
            self.joined.push(b' ');
            line = b"";
            if self.joined.len() > MAX_LINE || self.rest.is_empty() {
                break;
            }
            self.n_continued += 1;
            line = self.physical();
        }
        self.joined.extend_from_slice(line);
        Some((self.number, self.joined.trim_ascii()))
    }

    /// Takes the next line off the text, without the white space around it.
    fn physical(&mut self) -> &'a [u8] {
        let end = self.rest.iter().position(|byte| *byte == b'\n');
        let (line, rest) = match end {
            Some(end) => (&self.rest[..end], &self.rest[end + 1..]),
            None => (self.rest, &[][..]),
        };
        self.rest = rest;
        line.trim_ascii()
    }
}

pub(super) fn words(line: &[u8]) -> impl Iterator<Item = &[u8]> {
    line.split(u8::is_ascii_whitespace).filter(|word| !word.is_empty())
}

pub(super) fn split_word(line: &[u8]) -> (&[u8], &[u8]) {
    let end = line.iter().position(u8::is_ascii_whitespace).unwrap_or(line.len());
    (&line[..end], line[end..].trim_ascii())
}

pub(super) fn uncommented(line: &[u8]) -> &[u8] {
    let end = line.iter().position(|byte| *byte == b'#').unwrap_or(line.len());
    line[..end].trim_ascii()
}

/// Parses every word as a finite number into `out`; returns how many words there are, also where they are more than
/// `out` holds.
pub(super) fn numbers_of(line: &[u8], out: &mut [f32]) -> Result<usize, (ErrorKind, String)> {
    let mut n = 0;
    for word in words(line) {
        let number = std::str::from_utf8(word).ok().and_then(|s| s.parse::<f32>().ok());
        let Some(number) = number else {
            return Err((ErrorKind::Format, format!("`{}` is not a number", excerpt(word))));
        };
        if !number.is_finite() {
            let message = format!("`{}` is not a finite number", excerpt(word));
            return Err((ErrorKind::Number, message));
        }
        let Some(slot) = out.get_mut(n) else {
            return Ok(words(line).count());
        };
        *slot = number;
        n += 1;
    }
    Ok(n)
}

/// Bytes of a name as text, and whether they are not UTF-8: then they are read as Latin-1, which old exporters
/// wrote in western countries, and in which all bytes are characters.
pub(super) fn text(bytes: &[u8]) -> (Cow<'_, str>, bool) {
    match std::str::from_utf8(bytes) {
        Ok(text) => (Cow::Borrowed(text), false),
        Err(_) => (bytes.iter().copied().map(char::from).collect(), true),
    }
}

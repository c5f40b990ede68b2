//! Text of a stranger's file becomes text that a terminal may see: no control characters, not too
//! long.

use std::borrow::Cow;
use std::fmt::Write as _;

/// Characters of a text that are shown before and after what is left out.
const HEAD: usize = 1500;
const TAIL: usize = 500;

/// Would this character steer a terminal, or change how the text around it reads? Control characters
/// (C0, DEL, C1), line and paragraph separators, bidirectional controls, and what has no width.
pub(super) fn is_unsafe(c: char) -> bool {
    c.is_control()
        || matches!(c,
            '\u{061c}' | '\u{180e}' | '\u{200b}'..='\u{200f}' | '\u{2028}'..='\u{202e}'
            | '\u{2060}'..='\u{206f}' | '\u{feff}' | '\u{fff9}'..='\u{fffb}'
            | '\u{e0000}'..='\u{e007f}')
}

/// One line: unsafe characters as in a Rust string, `\u{1b}`.
pub(super) fn escape(text: &str) -> Cow<'_, str> {
    escape_if(text, is_unsafe)
}

/// As `escape`; line breaks and tabs stay.
pub(super) fn escape_lines(text: &str) -> Cow<'_, str> {
    escape_if(text, |c| is_unsafe(c) && !matches!(c, '\n' | '\t'))
}

/// Most texts are.
fn is_plain(text: &str) -> bool {
    text.bytes().all(|byte| (b' '..=b'~').contains(&byte))
}

fn escape_if(text: &str, bad: impl Fn(char) -> bool) -> Cow<'_, str> {
    if is_plain(text) || !text.contains(&bad) {
        return Cow::Borrowed(text);
    }
    let mut out = String::with_capacity(text.len() + 16);
    for c in text.chars() {
        if bad(c) { out.extend(c.escape_default()) } else { out.push(c) }
    }
    Cow::Owned(out)
}

/// One line of a message: without its middle if it is long, and escaped.
pub(super) fn line(text: &str) -> Cow<'_, str> {
    match shortened(text) {
        Cow::Borrowed(text) => escape(text),
        Cow::Owned(text) => Cow::Owned(escape(&text).into_owned()),
    }
}

/// A text without its middle, if it is long.
pub(super) fn shortened(text: &str) -> Cow<'_, str> {
    let start = text.char_indices().nth(HEAD).map(|(at, _)| at);
    let end = text.char_indices().rev().nth(TAIL - 1).map(|(at, _)| at);
    match (start, end) {
        (Some(start), Some(end)) if start < end => {
            let (head, tail) = (text.get(..start).unwrap_or(""), text.get(end..).unwrap_or(""));
            Cow::Owned(format!("{head}…{tail}"))
        }
        _ => Cow::Borrowed(text),
    }
}

/// Is this text shown whole?
pub(super) fn is_short(text: &str) -> bool {
    text.len() <= HEAD + TAIL
}

/// A JSON text whose strings mean the same, with unsafe characters escaped as JSON has it.
pub(super) fn escape_json(json: &str) -> Cow<'_, str> {
    if is_plain(json) || !json.contains(is_unsafe) {
        return Cow::Borrowed(json);
    }
    let mut out = String::with_capacity(json.len() + 16);
    let mut units = [0; 2];
    for c in json.chars() {
        if is_unsafe(c) {
            for unit in c.encode_utf16(&mut units) {
                let _ = write!(out, "\\u{unit:04x}");
            }
        } else {
            out.push(c);
        }
    }
    Cow::Owned(out)
}

#[cfg(test)]
mod tests {
    use super::{escape, escape_json, escape_lines, line};

    #[test]
    fn what_steers_a_terminal_is_escaped() {
        assert_eq!(escape("a\u{1b}[31m\u{9b}\u{7f}\u{202e}é"), r"a\u{1b}[31m\u{9b}\u{7f}\u{202e}é");
        assert_eq!(escape("a\r\nb"), r"a\r\nb");
        assert_eq!(escape_lines("a\t\r\nb"), "a\t\\r\nb");
    }

    #[test]
    fn json_means_the_same_with_its_escapes() {
        let text = "\u{7f}\u{9b}\u{202e}\u{e0041}\u{1b}é";
        let json = serde_json::to_string(text).unwrap();
        let escaped = escape_json(&json);
        assert_eq!(escaped, r#""\u007f\u009b\u202e\udb40\udc41\u001bé""#);
        assert_eq!(serde_json::from_str::<String>(&escaped).unwrap(), text);
    }

    #[test]
    fn a_long_line_loses_its_middle() {
        let long = "é".repeat(2001);
        assert_eq!(line(&long).chars().count(), 2001);
        assert!(line(&long).contains("é…é"));
        assert_eq!(line(&long[..4000]), &long[..4000]);
    }
}

//! Module text becomes its imports and its module-scope declarations, each a byte range with its name
//! and the identifiers in it.
//!
//! This is a scanner, not a parser: it knows comments, words, brackets and semicolons. That suffices
//! because the text is ours and naga checks all of it afterwards.

use crate::error::{Location, ShaderError};
use std::ops::Range;

/// An `#import` line.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct Import<'t> {
    pub(crate) name: &'t str,
    pub(crate) start: usize,
}

/// A function, struct, constant, alias or variable at module scope.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct Declaration<'t> {
    pub(crate) name: &'t str,
    /// The text, with the comment lines directly above it.
    pub(crate) range: Range<usize>,
    /// Where the text proper begins.
    pub(crate) start: usize,
    /// Every identifier in it, its own name included; sorted, without repeats.
    pub(crate) words: Vec<&'t str>,
}

/// A module taken apart.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub(crate) struct Parts<'t> {
    /// The whole module.
    pub(crate) text: &'t str,
    pub(crate) imports: Vec<Import<'t>>,
    pub(crate) declarations: Vec<Declaration<'t>>,
}

/// Takes the text of module `file` apart.
pub(crate) fn split<'t>(file: &str, text: &'t str) -> Result<Parts<'t>, ShaderError> {
    let imports = imports(file, text)?;
    let tokens = tokens(text);
    let mut declarations = Vec::new();
    let mut rest = tokens.as_slice();
    while let Some(first) = rest.first() {
        let bad = |message| ShaderError::BadDeclaration {
            at: location(file, text, first.start),
            message,
        };
        let n_tokens =
            declaration_length(rest).ok_or_else(|| bad("this declaration has no end"))?;
        let (own, after) = rest.split_at(n_tokens);
        rest = after;
        let name = declared_name(own)
            .ok_or_else(|| bad("expected a function, struct, constant, alias or variable"))?;
        let mut words: Vec<&str> = own.iter().filter(|t| t.is_name()).map(|t| t.text).collect();
        words.sort_unstable();
        words.dedup();
        declarations.push(Declaration {
            name,
            range: comment_start(text, first.start)..own[n_tokens - 1].end(),
            start: first.start,
            words,
        });
    }
    Ok(Parts { text, imports, declarations })
}

/// The place of byte `at` of module `file`.
pub(crate) fn location(file: &str, text: &str, at: usize) -> Location {
    let at = text.floor_char_boundary(at);
    let before = &text.as_bytes()[..at];
    let line = text[..at].matches('\n').count() + 1;
    let column = at - before.iter().rposition(|byte| *byte == b'\n').map_or(0, |i| i + 1) + 1;
    let narrow = |n: usize| u32::try_from(n).unwrap_or(u32::MAX);
    Location { file: file.to_owned(), line: narrow(line), column: narrow(column) }
}

fn imports<'t>(file: &str, text: &'t str) -> Result<Vec<Import<'t>>, ShaderError> {
    let mut found = Vec::new();
    let mut start = 0;
    for line in text.split_inclusive('\n') {
        if line.starts_with('#') {
            let name = line.trim_end().strip_prefix("#import \"").and_then(|s| s.strip_suffix('"'));
            let name =
                name.ok_or_else(|| ShaderError::BadImport { at: location(file, text, start) })?;
            found.push(Import { name, start });
        }
        start += line.len();
    }
    Ok(found)
}

/// A word or a single character, outside of comments and import lines.
#[derive(Clone, Copy, Debug)]
struct Token<'t> {
    start: usize,
    text: &'t str,
}

impl Token<'_> {
    fn end(self) -> usize {
        self.start + self.text.len()
    }

    fn is_name(self) -> bool {
        self.text.starts_with(|c: char| c == '_' || c.is_ascii_alphabetic())
    }
}

fn tokens(text: &str) -> Vec<Token<'_>> {
    let mut found = Vec::new();
    let mut start = 0;
    while let Some(first) = text[start..].chars().next() {
        let rest = &text[start..];
        let line_start = start == 0 || text.as_bytes()[start - 1] == b'\n';
        let length = if rest.starts_with("//") || (line_start && first == '#') {
            rest.find('\n').unwrap_or(rest.len())
        } else if rest.starts_with("/*") {
            block_comment_length(rest)
        } else {
            let word = rest.find(|c: char| !is_word_char(c)).unwrap_or(rest.len());
            let length = word.max(first.len_utf8());
            if !first.is_whitespace() {
                found.push(Token { start, text: &rest[..length] });
            }
            length
        };
        start += length;
    }
    found
}

fn is_word_char(c: char) -> bool {
    c == '_' || c.is_ascii_alphanumeric()
}

/// Length of the block comment at the start of `text`; block comments nest.
fn block_comment_length(text: &str) -> usize {
    let bytes = text.as_bytes();
    let mut depth = 0_u32;
    let mut i = 0;
    while i < bytes.len() {
        if bytes[i..].starts_with(b"/*") {
            depth += 1;
            i += 2;
        } else if bytes[i..].starts_with(b"*/") {
            depth -= 1;
            i += 2;
            if depth == 0 {
                return i;
            }
        } else {
            i += 1;
        }
    }
    bytes.len()
}

/// How many of `tokens` the first declaration takes: up to a semicolon outside of brackets, or the brace
/// that closes the body of a function or struct.
fn declaration_length(tokens: &[Token<'_>]) -> Option<usize> {
    let mut depth = 0_u32;
    for (i, token) in tokens.iter().enumerate() {
        match token.text {
            "(" | "[" | "{" => depth += 1,
            ")" | "]" => depth = depth.checked_sub(1)?,
            "}" => {
                depth = depth.checked_sub(1)?;
                if depth == 0 {
                    return Some(i + 1);
                }
            }
            ";" if depth == 0 => return Some(i + 1),
            _ => {}
        }
    }
    None
}

/// The name that a declaration gives: the word after its keyword, attributes and `var<…>` skipped.
fn declared_name<'t>(tokens: &[Token<'t>]) -> Option<&'t str> {
    let keyword = tokens.iter().position(|t| {
        matches!(t.text, "fn" | "struct" | "const" | "alias" | "var" | "override" | "const_assert")
    })?;
    let mut depth = 0_u32;
    for token in &tokens[keyword + 1..] {
        match token.text {
            "<" => depth += 1,
            ">" => depth = depth.saturating_sub(1),
            _ if depth == 0 => return token.is_name().then_some(token.text),
            _ => {}
        }
    }
    None
}

/// Start of the comment lines directly above byte `start`, or `start`.
fn comment_start(text: &str, start: usize) -> usize {
    let mut begin = start;
    loop {
        let above = &text[..begin];
        let Some(line) = above.strip_suffix('\n') else { return begin };
        let line_start = line.rfind('\n').map_or(0, |i| i + 1);
        if !line[line_start..].starts_with("//") {
            return begin;
        }
        begin = line_start;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn names(text: &str) -> Vec<(String, String)> {
        let parts = split("test.wgsl", text).expect("the text is well formed");
        let row = |d: Declaration<'_>| (d.name.to_owned(), text[d.range].to_owned());
        parts.declarations.into_iter().map(row).collect()
    }

    #[test]
    fn declarations_keep_the_comment_above_and_drop_the_module_header() {
        let text = "// Header.\n\n// About f.\nfn f() -> u32 { return array<u32, 2>(1u, 2u)[0]; }\nconst A: u32 = 3u;\n";
        let found = names(text);
        assert_eq!(found[0].0, "f");
        assert!(found[0].1.starts_with("// About f.\nfn f") && found[0].1.ends_with('}'));
        assert_eq!(found[1], ("A".to_owned(), "const A: u32 = 3u;".to_owned()));
    }

    #[test]
    fn comments_hide_brackets_and_attributes_are_not_names() {
        let text = "/* { /* } */ ( */\n@group(0) @binding(1) var<storage, read> words: array<vec4<u32>>;\n@compute fn go() { // }\n}\n";
        let found: Vec<String> = names(text).into_iter().map(|row| row.0).collect();
        assert_eq!(found, ["words", "go"]);
    }

    #[test]
    fn broken_text_is_an_error_with_its_place() {
        let error = split("x.wgsl", "const A = 1u;\n  fn f( {").expect_err("no end");
        assert_eq!(error.to_string(), "x.wgsl:2:3: this declaration has no end");
        let error = split("x.wgsl", "#include \"a\"\n").expect_err("not an import");
        assert_eq!(error.to_string(), "x.wgsl:1:1: expected `#import \"name.wgsl\"`");
    }
}

//! A file's tokens become one chunk per declaration, so that a fault stays where it is.
//!
//! A declaration starts in column 1 with its keyword and a name after it (`material cedar`), and
//! that shape alone splits: a field such as `medium = mist` does not, even unindented. Between
//! declarations an indented one is taken too. The same pass bounds the nesting of every chunk, so
//! that the recursive phases after it cannot run out of stack.

use crate::lex::{Kind, Token};
use crate::suggest::suggest;
use crate::syntax::{DeclKind, MAX_HEIGHT};

/// Most brackets inside each other.
pub(crate) const MAX_BRACKETS: usize = 64;

/// Most letters of a name. Names are repeated in messages, so a bound on them bounds those.
pub(crate) const MAX_NAME: usize = 255;

/// Most tokens of a declaration: the grammar needs some kilobytes of memory for each.
pub(crate) const MAX_TOKENS: usize = 100_000;

/// What the first word of a chunk says it is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Header {
    /// A declaration, known or misspelt.
    Item,
    /// No header: text between declarations.
    Junk,
}

/// One declaration, or text where one should be.
#[derive(Clone, Debug)]
pub(crate) struct Chunk {
    /// Whether it starts like a declaration.
    pub(crate) header: Header,
    /// Its tokens: from the first word up to the last before the next chunk, as indices. Comments
    /// and line breaks at the end are cut off.
    pub(crate) tokens: std::ops::Range<usize>,
    /// The doc comment directly above, as token indices.
    pub(crate) docs: Vec<usize>,
    /// Upper bound of the height of any expression in it.
    pub(crate) height: usize,
    /// First token that is nested too deeply.
    pub(crate) too_deep: Option<usize>,
    /// First name that is too long.
    pub(crate) too_long: Option<usize>,
    /// First token of too many.
    pub(crate) too_many: Option<usize>,
    /// It has a `{`.
    has_brace: bool,
}

/// Words that start a declaration without a block.
const LINE_WORDS: [&str; 6] = ["import", "param", "let", "asset", "texture", "assert"];

/// Every word that may start a declaration of this edition. `scatter` is read, so that the answer can
/// say that it does not exist yet, but never proposed.
pub(crate) fn start_words() -> impl Iterator<Item = &'static str> {
    let kinds = DeclKind::ALL.into_iter().filter(|kind| *kind != DeclKind::Scatter);
    LINE_WORDS.into_iter().chain(kinds.map(DeclKind::word)).chain(["pub"])
}

/// Splits a file. The chunks cover all tokens except comments and line breaks between them.
pub(crate) fn split(text: &str, tokens: &[Token]) -> Vec<Chunk> {
    let mut splitter =
        Splitter { text, tokens, chunks: Vec::new(), docs: vec![], open: vec![], beyond: 0 };
    let mut line_start = true;
    for (i, token) in tokens.iter().enumerate() {
        match token.kind {
            Kind::Newline => {
                if line_start {
                    splitter.docs.clear();
                }
                line_start = true;
                splitter.nest(i);
                continue;
            }
            Kind::Comment => {
                if line_start && is_doc(token.text(text)) {
                    splitter.docs.push(i);
                } else {
                    splitter.docs.clear();
                }
            }
            _ => splitter.visible(i, line_start),
        }
        line_start = false;
    }
    splitter.chunks
}

/// `/// text`, but not a line of slashes.
fn is_doc(comment: &str) -> bool {
    comment.starts_with("///") && !comment.starts_with("////")
}

/// An open bracket with the number of operators since the last comma in it.
struct Level {
    bracket: u8,
    operators: usize,
}

struct Splitter<'a> {
    text: &'a str,
    tokens: &'a [Token],
    chunks: Vec<Chunk>,
    /// Doc lines that await a declaration.
    docs: Vec<usize>,
    /// The current chunk's open brackets; the first level is outside of all.
    open: Vec<Level>,
    /// Brackets opened beyond all limits, only counted.
    beyond: usize,
}

impl Splitter<'_> {
    /// A token that is neither comment nor line break.
    fn visible(&mut self, i: usize, line_start: bool) {
        let docs = std::mem::take(&mut self.docs);
        if line_start && let Some(header) = self.start(i) {
            self.open = vec![Level { bracket: b' ', operators: 0 }];
            self.beyond = 0;
            let tokens = i..i + 1;
            self.chunks.push(Chunk {
                header,
                tokens,
                docs,
                height: 0,
                too_deep: None,
                too_long: None,
                too_many: None,
                has_brace: false,
            });
        }
        self.nest(i);
        if let Some(chunk) = self.chunks.last_mut() {
            chunk.tokens.end = i + 1;
            let token = self.tokens[i];
            chunk.has_brace |= token.text(self.text) == "{";
            if token.kind == Kind::Word && token.end() - token.start() > MAX_NAME {
                chunk.too_long.get_or_insert(i);
            }
            if chunk.header == Header::Item && chunk.tokens.len() > MAX_TOKENS {
                chunk.too_many.get_or_insert(i);
            }
        }
    }

    /// Does a chunk start at this first token of a line?
    fn start(&self, i: usize) -> Option<Header> {
        let Some(current) = self.chunks.last() else {
            return Some(if self.is_header(i, true) { Header::Item } else { Header::Junk });
        };
        if self.open.len() > 1 {
            return (self.in_column_1(i) && self.is_header(i, false)).then_some(Header::Item);
        }
        let token = self.tokens[i];
        if token.text(self.text) == "{" && !current.has_brace {
            return None;
        }
        if self.is_header(i, true) {
            return Some(Header::Item);
        }
        (current.header == Header::Item).then_some(Header::Junk)
    }

    fn in_column_1(&self, i: usize) -> bool {
        let start = self.tokens[i].start();
        let before = self.text.get(..start).unwrap_or("");
        before.is_empty() || before.ends_with(['\n', '\r', '\u{feff}'])
    }

    /// Has the line that starts here the shape of a declaration's head? `outside`: no bracket is
    /// open, so that little is needed to believe it.
    fn is_header(&self, i: usize, outside: bool) -> bool {
        let mut line = self.tokens[i..].iter().take_while(|t| t.kind != Kind::Newline);
        let mut next = || line.next().map_or((Kind::Newline, ""), |t| (t.kind, t.text(self.text)));
        let (Kind::Word, mut word) = next() else { return false };
        let mut after = next();
        if word == "pub" && after.0 == Kind::Word {
            word = after.1;
            after = next();
        }
        let then = next();
        let brace = matches!(then.1, ":" | "like" | "{" | "[")
            || then.1 != "=" && line.any(|t| t.text(self.text) == "{");
        let named = after.0 == Kind::Word && after.1 != "like";
        match word {
            "rts" => matches!(after.0, Kind::Number | Kind::Newline),
            "import" => outside || matches!(after.0, Kind::Text | Kind::OpenText | Kind::Word),
            "param" | "let" | "asset" | "texture" | "assert" => named || outside,
            _ if DeclKind::from_word(word).is_some() => {
                named && (outside || brace)
                    || matches!(after.1, "{" | ":") && (outside || brace || after.1 == "{")
            }
            _ => {
                named
                    && (brace || then.1 == "=")
                    && (outside || brace || !suggest(word, start_words()).is_empty())
            }
        }
    }

    /// Keeps account of brackets and operators at a token.
    fn nest(&mut self, i: usize) {
        let Some(chunk) = self.chunks.last_mut() else { return };
        let token = self.tokens[i];
        let text = token.text(self.text);
        match token.kind {
            Kind::Open if self.open.len() > MAX_BRACKETS + 1 => self.beyond += 1,
            Kind::Open => {
                let bracket = text.bytes().next().unwrap_or(b'(');
                self.open.push(Level { bracket, operators: 0 });
            }
            Kind::Close if self.beyond > 0 => self.beyond -= 1,
            Kind::Close => close(&mut self.open, text),
            _ => {
                if let Some(top) = self.open.last_mut() {
                    count(top, token.kind, text);
                }
            }
        }
        let operators: usize = self.open.iter().map(|level| level.operators).sum();
        let height = operators + self.open.len();
        chunk.height = chunk.height.max(height);
        if self.open.len() > MAX_BRACKETS + 1 || height > MAX_HEIGHT as usize {
            chunk.too_deep.get_or_insert(i);
        }
    }
}

/// Counts what makes an expression higher; starts again at what ends it.
fn count(level: &mut Level, kind: Kind, text: &str) {
    match kind {
        Kind::Comma | Kind::Colon => level.operators = 0,
        Kind::Newline if matches!(level.bracket, b' ' | b'{') => level.operators = 0,
        Kind::Arithmetic | Kind::Compare | Kind::DotDot | Kind::Dot => level.operators += 1,
        Kind::Word if text == "if" => level.operators += 1,
        _ => {}
    }
}

/// A `}` closes everything inside its block; another bracket only closes its like.
fn close(open: &mut Vec<Level>, bracket: &str) {
    let opener = match bracket {
        ")" => b'(',
        "]" => b'[',
        _ => b'{',
    };
    let found = open.iter().rposition(|level| level.bracket == opener);
    match found {
        Some(at) if opener == b'{' || at + 1 == open.len() => open.truncate(at),
        _ => {}
    }
}

#[cfg(test)]
mod tests {
    use super::{Header, split};
    use crate::lex::lex;

    /// The first line of each chunk, `?` before junk.
    fn heads(text: &str) -> Vec<String> {
        let tokens = lex(text);
        let head = |chunk: &super::Chunk| {
            let start = tokens[chunk.tokens.start].start();
            let mark = if chunk.header == Header::Junk { "?" } else { "" };
            format!("{mark}{}", text[start..].lines().next().unwrap_or(""))
        };
        split(text, &tokens).iter().map(head).collect()
    }

    #[test]
    fn fields_do_not_split_even_unindented() {
        assert_eq!(heads("material a: b {\nmedium = mist\nfilm = x\n}"), ["material a: b {"]);
    }

    #[test]
    fn an_unclosed_block_ends_at_the_next_header() {
        let text = "material a: b {\n  x = 1\n/// doc\nmaterail c: d {\n}\n";
        assert_eq!(heads(text), ["material a: b {", "materail c: d {"]);
    }

    #[test]
    fn text_between_declarations_is_junk() {
        let text = "let a = 1\n}\nfoo bar\n let b = 2\n";
        assert_eq!(heads(text), ["let a = 1", "?}", "let b = 2"]);
    }

    #[test]
    fn a_list_may_close_in_column_1() {
        assert_eq!(heads("let a = [\n1,\n2\n]\nlet b = 1"), ["let a = [", "let b = 1"]);
    }

    #[test]
    fn depth_is_bounded() {
        let deep = |n: usize| format!("let a = {}1{}", "(".repeat(n), ")".repeat(n));
        let too_deep = |text: &str| split(text, &lex(text))[0].too_deep.is_some();
        assert!(!too_deep(&deep(64)));
        assert!(too_deep(&deep(65)));
        assert!(too_deep(&format!("let a = {}1", "-".repeat(300))));
        assert!(too_deep(&format!("let a = 1{}", " + 1".repeat(300))));
        assert!(!too_deep(&format!("let a = [{}]", "1 + 1, ".repeat(300))));
    }
}

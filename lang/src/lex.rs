//! Text becomes tokens that keep everything but blanks: comments and line breaks are tokens too.
//!
//! The grammar alone decides what is right. These tokens serve what a grammar cannot do well: they
//! split a file into declarations, bound its nesting, word its errors and are what the formatter
//! prints again. They cover the text without overlap, in order; between them are blanks only.

use crate::source::byte_offset;

/// Kinds of tokens.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Kind {
    /// A line break.
    Newline,
    /// `// …` up to the line break.
    Comment,
    /// Identifier or keyword.
    Word,
    /// Number with the unit glued to it.
    Number,
    /// Unit glued to the `)` of a tuple.
    Unit,
    /// `#` and the letters and digits after it.
    Hex,
    /// String with both quotes.
    Text,
    /// String whose second quote is missing, up to the line break.
    OpenText,
    /// `(`, `[` or `{`.
    Open,
    /// `)`, `]` or `}`.
    Close,
    /// `,`
    Comma,
    /// `:`
    Colon,
    /// `=`
    Equals,
    /// `.`
    Dot,
    /// `..`
    DotDot,
    /// `+`, `-`, `*` or `/`.
    Arithmetic,
    /// `<`, `<=`, `>`, `>=`, `==` or `!=`.
    Compare,
    /// Any other character.
    Other,
}

/// A piece of the text.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Token {
    /// What it is.
    pub(crate) kind: Kind,
    /// Offsets that fit, because texts are bounded: a text may be one token a byte.
    start: u32,
    end: u32,
}

impl Token {
    fn new(kind: Kind, start: usize, end: usize) -> Token {
        Token { kind, start: byte_offset(start), end: byte_offset(end) }
    }

    /// First byte.
    pub(crate) fn start(self) -> usize {
        self.start as usize
    }

    /// One past the last byte.
    pub(crate) fn end(self) -> usize {
        self.end as usize
    }

    /// The characters of the token.
    pub(crate) fn text(self, text: &str) -> &str {
        text.get(self.start()..self.end()).unwrap_or("")
    }
}

/// Words that cannot be names.
pub(crate) const RESERVED: [&str; 10] =
    ["if", "then", "else", "true", "false", "default", "none", "in", "like", "as"];

/// Can a value end with this token?
pub(crate) fn ends_value(token: Token, text: &str) -> bool {
    match token.kind {
        Kind::Number | Kind::Unit | Kind::Hex | Kind::Text | Kind::OpenText | Kind::Close => true,
        Kind::Word => {
            let word = token.text(text);
            is_callee(token, text) || matches!(word, "true" | "false" | "default" | "none")
        }
        _ => false,
    }
}

/// Is this a name, which a bracket after it would call or index? (`assert` stands before a value.)
pub(crate) fn is_callee(token: Token, text: &str) -> bool {
    let word = token.text(text);
    token.kind == Kind::Word && !RESERVED.contains(&word) && word != "assert"
}

/// Splits a text into tokens. A byte order mark at the start is skipped like a blank.
pub(crate) fn lex(text: &str) -> Vec<Token> {
    let mut lexer = Lexer { text, at: 0, tokens: Vec::new(), open: Vec::new() };
    if text.starts_with('\u{feff}') {
        lexer.at = '\u{feff}'.len_utf8();
    }
    while let Some(c) = lexer.peek(0) {
        if c == b' ' || c == b'\t' {
            lexer.at += 1;
        } else {
            lexer.token(c);
        }
    }
    lexer.tokens
}

/// An open `(`, while its `)` has not come.
struct Group {
    /// It is no call, so a comma makes it a tuple.
    bare: bool,
    /// A comma has come.
    comma: bool,
}

struct Lexer<'a> {
    text: &'a str,
    at: usize,
    tokens: Vec<Token>,
    open: Vec<Group>,
}

impl Lexer<'_> {
    fn peek(&self, ahead: usize) -> Option<u8> {
        self.text.as_bytes().get(self.at + ahead).copied()
    }

    fn is(&self, ahead: usize, class: impl Fn(u8) -> bool) -> bool {
        self.peek(ahead).is_some_and(class)
    }

    fn token(&mut self, c: u8) {
        let start = self.at;
        let kind = match c {
            b'\n' => self.take(1, Kind::Newline),
            b'\r' => {
                let n = if self.peek(1) == Some(b'\n') { 2 } else { 1 };
                self.take(n, Kind::Newline)
            }
            b'/' if self.peek(1) == Some(b'/') => self.take_line(Kind::Comment),
            b'"' => self.string(),
            b'#' => self.hex(),
            b'0'..=b'9' => self.number(),
            b'.' if self.peek(1) == Some(b'.') => self.take(2, Kind::DotDot),
            b'.' if self.is(1, |c| c.is_ascii_digit()) && !self.after_value() => self.number(),
            b'(' | b'[' | b'{' => self.open(),
            b')' | b']' | b'}' => return self.close(),
            b'a'..=b'z' | b'A'..=b'Z' | b'_' => {
                self.take_while(|c| c.is_ascii_alphanumeric() || c == b'_');
                Kind::Word
            }
            _ => self.symbol(c),
        };
        self.tokens.push(Token::new(kind, start, self.at));
    }

    fn symbol(&mut self, c: u8) -> Kind {
        match (c, self.peek(1)) {
            (b'<' | b'>' | b'=' | b'!', Some(b'=')) => self.take(2, Kind::Compare),
            (b'<' | b'>', _) => self.take(1, Kind::Compare),
            (b',', _) => {
                if let Some(group) = self.open.last_mut() {
                    group.comma = true;
                }
                self.take(1, Kind::Comma)
            }
            (b':', _) => self.take(1, Kind::Colon),
            (b'=', _) => self.take(1, Kind::Equals),
            (b'.', _) => self.take(1, Kind::Dot),
            (b'+' | b'-' | b'*' | b'/', _) => self.take(1, Kind::Arithmetic),
            _ => {
                let c = self.text.get(self.at..).and_then(|rest| rest.chars().next());
                self.take(c.map_or(1, char::len_utf8), Kind::Other)
            }
        }
    }

    fn take(&mut self, n: usize, kind: Kind) -> Kind {
        self.at += n;
        kind
    }

    fn take_while(&mut self, class: impl Fn(u8) -> bool) {
        while self.is(0, &class) {
            self.at += 1;
        }
    }

    fn take_line(&mut self, kind: Kind) -> Kind {
        self.take_while(|c| c != b'\n' && c != b'\r');
        kind
    }

    fn string(&mut self) -> Kind {
        self.at += 1;
        self.take_while(|c| c != b'\n' && c != b'\r' && c != b'"');
        if self.peek(0) == Some(b'"') { self.take(1, Kind::Text) } else { Kind::OpenText }
    }

    fn hex(&mut self) -> Kind {
        self.at += 1;
        self.take_while(|c| c.is_ascii_alphanumeric());
        Kind::Hex
    }

    /// Does the token just before, without a blank between, end a value?
    fn after_value(&self) -> bool {
        self.tokens.last().is_some_and(|&t| t.end() == self.at && ends_value(t, self.text))
    }

    fn number(&mut self) -> Kind {
        let digit = |c: u8| c.is_ascii_digit();
        let digits = |c: u8| c.is_ascii_digit() || c == b'_';
        self.take_while(digits);
        if self.peek(0) == Some(b'.') && self.is(1, digit) {
            self.at += 1;
            self.take_while(digits);
        }
        if self.is(0, |c| c == b'e' || c == b'E') {
            let sign = usize::from(self.is(1, |c| c == b'+' || c == b'-'));
            if self.is(1 + sign, digit) {
                self.at += 1 + sign;
                self.take_while(digits);
            }
        }
        self.unit();
        Kind::Number
    }

    /// Takes a unit if there is one: `%`, `mm`, `/m`, `kcd/m2`.
    fn unit(&mut self) -> bool {
        let start = self.at;
        if self.peek(0) == Some(b'%') {
            self.at += 1;
            return true;
        }
        self.unit_atom();
        while self.peek(0) == Some(b'/') && self.is(1, |c| c.is_ascii_alphabetic()) {
            self.at += 1;
            self.unit_atom();
        }
        self.at > start
    }

    fn unit_atom(&mut self) {
        let start = self.at;
        self.take_while(|c| c.is_ascii_alphabetic());
        if self.at > start && self.is(0, |c| c.is_ascii_digit()) {
            self.at += 1;
        }
    }

    fn open(&mut self) -> Kind {
        let called = self.tokens.last().is_some_and(|&t| is_callee(t, self.text));
        let bare = self.peek(0) == Some(b'(') && !called;
        self.open.push(Group { bare, comma: false });
        self.take(1, Kind::Open)
    }

    fn close(&mut self) {
        let start = self.at;
        let round = self.peek(0) == Some(b')');
        self.at += 1;
        self.tokens.push(Token::new(Kind::Close, start, self.at));
        let tuple = self.open.pop().is_some_and(|group| group.bare && group.comma);
        let start = self.at;
        if round && tuple && self.unit() {
            self.tokens.push(Token::new(Kind::Unit, start, self.at));
        }
    }
}

#[cfg(test)]
mod tests {
    use super::{Kind, lex};

    fn kinds(text: &str) -> Vec<(Kind, &str)> {
        lex(text).into_iter().map(|t| (t.kind, t.text(text))).collect()
    }

    #[test]
    fn numbers_take_their_units() {
        assert_eq!(
            kinds("0m..6m"),
            [(Kind::Number, "0m"), (Kind::DotDot, ".."), (Kind::Number, "6m")]
        );
        assert_eq!(
            kinds("4.5kcd/m2 .5 1e-3s 2e 7%"),
            [
                (Kind::Number, "4.5kcd/m2"),
                (Kind::Number, ".5"),
                (Kind::Number, "1e-3s"),
                (Kind::Number, "2e"),
                (Kind::Number, "7%"),
            ]
        );
    }

    #[test]
    fn only_a_tuple_has_a_unit_behind_it() {
        assert!(kinds("(1, 2)m/s").contains(&(Kind::Unit, "m/s")));
        assert!(!kinds("(a)/c").iter().any(|t| t.0 == Kind::Unit));
        assert!(!kinds("f(a, b)/c").iter().any(|t| t.0 == Kind::Unit));
        assert!(kinds("then (1, f(2))m").contains(&(Kind::Unit, "m")));
    }

    #[test]
    fn a_string_ends_with_its_line() {
        assert_eq!(
            kinds("\"a\n\"b\""),
            [(Kind::OpenText, "\"a"), (Kind::Newline, "\n"), (Kind::Text, "\"b\"")]
        );
    }
}

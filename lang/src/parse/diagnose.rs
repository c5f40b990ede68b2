//! Words for what could not be read.
//!
//! The grammar, asked again without its catch-all rules, says how far a text is right; the tokens
//! around that place say what to call the fault.

use pest::Parser;
use pest::error::{ErrorVariant, InputLocation};

use super::declare::unknown_word;
use super::{Grammar, Reader, Rule};
use crate::diagnostic::{Code, Diagnostic, Fix};
use crate::lex::{Kind, RESERVED, Token, ends_value};
use crate::source::{Span, byte_offset};
use crate::split::{Chunk, start_words};
use crate::suggest::suggest;
use crate::syntax::DeclKind;

/// How far a text is right.
struct Failure {
    /// First byte that cannot be read.
    at: usize,
    /// What the grammar would have taken there.
    expected: Vec<Rule>,
}

/// What a head or line consists of, up to where its values begin.
enum Part {
    /// A name; what to call it.
    Name(&'static str),
    /// A sign or keyword.
    Sign(&'static str),
    /// A string; what to call it.
    Text(&'static str),
}

impl Reader<'_> {
    /// Tokens that lie within a span, without comments and line breaks.
    pub(super) fn tokens_in(&self, span: Span) -> Vec<Token> {
        let (start, end) = (span.start as usize, span.end as usize);
        let first = self.tokens.partition_point(|t| t.start < start);
        let inside = self.tokens[first..].iter().take_while(|t| t.end <= end);
        inside.filter(|t| !matches!(t.kind, Kind::Comment | Kind::Newline)).copied().collect()
    }

    fn quoted(&self, token: Token) -> String {
        let text = token.text(self.text);
        let cut: String = text.chars().take(24).collect();
        let dots = if cut.len() < text.len() { "…" } else { "" };
        format!("`{cut}{dots}`")
    }

    /// Text where no declaration stands.
    pub(super) fn junk_between(&self, chunk: &Chunk) -> Diagnostic {
        let tokens = &self.tokens[chunk.tokens.clone()];
        let first = tokens[0];
        let span = self.token_span(first);
        if first.kind == Kind::Close {
            return self.nothing_to_close(first);
        }
        let found = self.quoted(first);
        let error =
            Diagnostic::error(Code("E0101"), format!("expected a declaration, found {found}"))
                .at(span, "no declaration starts like this");
        if tokens.iter().take_while(|t| t.kind != Kind::Newline).any(|t| t.kind == Kind::Equals) {
            return error
                .with_help("put fields inside a block `{ … }`, or name a value with `let`");
        }
        let near = suggest(first.text(self.text), start_words());
        match near.first() {
            Some(word) => error.with_help(format!("did you mean `{word}`?")),
            None => error,
        }
    }

    /// Text after the end of a block.
    pub(super) fn junk_after(&self, span: Span) -> Diagnostic {
        let Some(first) = self.tokens_in(span).first().copied() else {
            return Diagnostic::error(Code("E0101"), "unexpected text").at(span, "");
        };
        if first.kind == Kind::Close {
            return self.nothing_to_close(first);
        }
        let message = format!("unexpected {} after the end of the block", self.quoted(first));
        Diagnostic::error(Code("E0101"), message)
            .at(self.token_span(first), "a new declaration starts on a new line")
    }

    fn nothing_to_close(&self, token: Token) -> Diagnostic {
        let message = format!("there is nothing open that this {} could close", self.quoted(token));
        let span = self.token_span(token);
        Diagnostic::error(Code("E0105"), message).at(span, "unmatched").with_fix(Fix::guess(
            "remove it",
            span,
            "",
        ))
    }

    /// A block that ends with its chunk.
    pub(super) fn unclosed(&self, brace: Span, next: Option<Token>) -> Diagnostic {
        let end = next.map_or(self.text.len(), |token| token.start);
        let last = self.tokens.partition_point(|t| t.start < end);
        let mut inside = self.tokens[..last].iter().rev();
        let last = inside.find(|t| !matches!(t.kind, Kind::Comment | Kind::Newline));
        let last = last.map_or(brace, |&token| self.token_span(token));
        // A comment behind the last field stays behind it.
        let rest = self.text.get(last.end as usize..).unwrap_or("");
        let line_end = last.end as usize + rest.find(['\n', '\r']).unwrap_or(rest.len());
        let line = 1 + self.text.bytes().take(line_end).filter(|&b| b == b'\n').count();
        let mut error =
            Diagnostic::error(Code("E0102"), "this block is never closed").at(brace, "opened here");
        if let Some(token) = next {
            error =
                error.because(self.token_span(token), "a new declaration starts here, in column 1");
        }
        let fix = format!("add `}}` after line {line}");
        error
            .with_fix(Fix::guess(fix, self.bytes(line_end..line_end), "\n}"))
            .with_note("the rest of the file was still checked")
    }

    pub(super) fn has_open_bracket(&self, span: Span) -> bool {
        matches!(unmatched(&self.tokens_in(span), self.text), Some(t) if t.kind == Kind::Open)
    }

    /// A piece of a block that is no field.
    pub(super) fn explain_field(&self, span: Span) -> Diagnostic {
        let tokens = self.tokens_in(span);
        if let Some(error) = self.broken_token(&tokens) {
            return error;
        }
        let Some(&first) = tokens.first() else {
            return Diagnostic::error(Code("E0101"), "expected a field").at(span, "");
        };
        if first.kind != Kind::Word {
            let message = format!("expected the name of a field, found {}", self.quoted(first));
            return Diagnostic::error(Code("E0101"), message).at(self.token_span(first), "");
        }
        if let Some(error) = self.reserved(first, "the name of a field") {
            return error;
        }
        let n = tokens.iter().take_while(|t| matches!(t.kind, Kind::Word | Kind::Dot));
        // `ring.width 3mm`: a word after a word does not belong to the path.
        let n = n
            .zip(tokens.iter().skip(1))
            .take_while(|(a, b)| (a.kind, b.kind) != (Kind::Word, Kind::Word));
        let n = (n.count() + 1).min(tokens.len());
        let path_end = tokens.iter().take(n).rev().find(|t| t.kind == Kind::Word).unwrap_or(&first);
        let path = self.token_span(first).to(self.token_span(*path_end));
        let name = self.text.get(path.start as usize..path.end as usize).unwrap_or("");
        let after = tokens.iter().find(|t| byte_offset(t.start) >= path.end).copied();
        match after {
            Some(t) if t.kind == Kind::Equals || t.kind == Kind::Dot => {
                self.explain(Rule::strict_field, span, "the field")
            }
            _ => self.no_equals(name, path, after),
        }
    }

    /// A field whose path is not followed by `=`.
    fn no_equals(&self, name: &str, path: Span, after: Option<Token>) -> Diagnostic {
        let error = Diagnostic::error(Code("E0101"), format!("expected `=` after `{name}`"));
        let Some(token) = after else {
            return error
                .at(path.after(), "nothing follows")
                .with_help(format!("write `{name} = default` to keep the default"));
        };
        let span = self.token_span(token);
        match (token.kind, token.text(self.text)) {
            (Kind::Colon, _) => error.at(span, "fields are set with `=`").with_fix(Fix::sure(
                "write `=`",
                span,
                " =",
            )),
            (Kind::Compare, "==") => {
                error.at(span, "`==` compares").with_fix(Fix::sure("write `=`", span, "="))
            }
            (Kind::Open, "{") => error
                .at(span, "blocks do not lie inside each other")
                .with_help(format!("write the fields out: `{name}.field = value`")),
            (Kind::Word | Kind::Number | Kind::Text | Kind::Hex | Kind::Open, _) => error
                .at(span, format!("found {}", self.quoted(token)))
                .with_fix(Fix::sure("insert `=`", path.after(), " =")),
            _ => error.at(span, format!("found {}", self.quoted(token))),
        }
    }

    /// A declaration without a block, or without its `{`.
    pub(super) fn explain_line(&self, chunk: &Chunk, span: Span) -> Diagnostic {
        let tokens: Vec<Token> = self.tokens_in(span);
        if let Some(error) = self.broken_token(&tokens) {
            return error;
        }
        let public = tokens.first().is_some_and(|t| t.text(self.text) == "pub");
        let tokens = &tokens[usize::from(public)..];
        let Some(&first) = tokens.first() else {
            let span = self.token_span(self.tokens[chunk.tokens.start]);
            let message = "expected a declaration after `pub`";
            return Diagnostic::error(Code("E0101"), message).at(span.after(), "");
        };
        let word = first.text(self.text);
        let parts: &[Part] = match word {
            "import" => &[Part::Text("the file to import, in quotes")],
            "param" => {
                &[Part::Name("a name"), Part::Sign(":"), Part::Name("a type"), Part::Sign("=")]
            }
            "let" | "asset" | "texture" => &[Part::Name("a name"), Part::Sign("=")],
            "assert" => &[],
            _ if DeclKind::from_word(word).is_some() => &[Part::Name("a name")],
            _ => {
                let near = suggest(word, start_words());
                return unknown_word(word, self.token_span(first), &near);
            }
        };
        if public && matches!(word, "import" | "param" | "assert") {
            let message = format!("`pub` cannot stand before `{word}`");
            let span = self.token_span(self.tokens[chunk.tokens.start]);
            return Diagnostic::error(Code("E0101"), message).at(span, "remove it");
        }
        if let Some(error) = self.missing_part(tokens, parts) {
            return error;
        }
        if DeclKind::from_word(word).is_some() {
            let rule = Rule::strict_head;
            return match fails(self.text, span, rule) {
                Some(_) => self.explain(rule, span, "the head"),
                None => Diagnostic::error(Code("E0101"), format!("this {word} has no block"))
                    .at(span.after(), "expected `{`"),
            };
        }
        self.explain(Rule::strict_line, span, "the line")
    }

    /// The head of a declaration with a block; `span` goes from behind the kind to the `{`.
    pub(super) fn explain_head(&self, kind: Span, span: Span) -> Diagnostic {
        let span = kind.to(span);
        let tokens = self.tokens_in(span);
        if let Some(error) = self.broken_token(&tokens) {
            return error;
        }
        if let Some(error) = self.missing_part(&tokens, &[Part::Name("a name")]) {
            return error;
        }
        let (name, third) = (tokens.get(1), tokens.get(2));
        let word = |t: Option<&Token>| t.map_or("", |t| t.text(self.text)).to_owned();
        if let (Some(&name), Some(&third)) = (name, third)
            && third.kind == Kind::Word
            && word(Some(&third)) != "like"
        {
            let at = self.token_span(third);
            let message = format!("expected `:` or `like` after `{}`", name.text(self.text));
            return Diagnostic::error(Code("E0101"), message)
                .at(at, format!("found {}", self.quoted(third)))
                .with_fix(Fix::guess("name the type", self.token_span(name).after(), ":"));
        }
        self.explain(Rule::strict_head, span, "the head")
    }

    /// The first part of a head that is not there.
    fn missing_part(&self, tokens: &[Token], parts: &[Part]) -> Option<Diagnostic> {
        for (i, part) in parts.iter().enumerate() {
            let found = tokens.get(i + 1).copied();
            let text = found.map_or("", |t| t.text(self.text));
            let (fits, what) = match part {
                Part::Name(what) => {
                    if let Some(error) = found.and_then(|t| self.reserved(t, what)) {
                        return Some(error);
                    }
                    (found.is_some_and(|t| t.kind == Kind::Word), (*what).to_owned())
                }
                Part::Sign(sign) => (text == *sign, format!("`{sign}`")),
                Part::Text(what) => {
                    (found.is_some_and(|t| t.kind == Kind::Text), (*what).to_owned())
                }
            };
            if !fits {
                return Some(self.expected(&what, tokens.get(i).copied(), found));
            }
        }
        None
    }

    /// A keyword where a name should be.
    fn reserved(&self, token: Token, what: &str) -> Option<Diagnostic> {
        let text = token.text(self.text);
        if token.kind != Kind::Word || !RESERVED.contains(&text) {
            return None;
        }
        let message = format!("`{text}` is a word of the language and cannot be {what}");
        Some(Diagnostic::error(Code("E0101"), message).at(self.token_span(token), "reserved"))
    }

    fn expected(&self, what: &str, after: Option<Token>, found: Option<Token>) -> Diagnostic {
        let message = match after {
            Some(token) => format!("expected {what} after {}", self.quoted(token)),
            None => format!("expected {what}"),
        };
        let error = Diagnostic::error(Code("E0101"), message);
        match (found, after) {
            (Some(token), _) => {
                error.at(self.token_span(token), format!("found {}", self.quoted(token)))
            }
            (None, Some(token)) => error.at(self.token_span(token).after(), "nothing follows"),
            (None, None) => error,
        }
    }

    /// Faults that tokens alone show: unfinished strings, strange characters, lonely brackets.
    fn broken_token(&self, tokens: &[Token]) -> Option<Diagnostic> {
        if let Some(&token) = tokens.iter().find(|t| t.kind == Kind::OpenText) {
            let span = self.token_span(token);
            let error = Diagnostic::error(Code("E0106"), "this string is never closed")
                .at(span, "a string ends on the line where it starts")
                .with_fix(Fix::guess("close it", span.after(), "\""));
            return Some(error);
        }
        if let Some(&token) = tokens.iter().find(|t| t.kind == Kind::Other) {
            return Some(self.strange(token));
        }
        let is_hex = |t: &&Token| {
            let digits = t.text(self.text).bytes().skip(1);
            t.kind != Kind::Hex
                || t.end - t.start == 7 && digits.clone().all(|c| c.is_ascii_hexdigit())
        };
        if let Some(&token) = tokens.iter().find(|t| !is_hex(t)) {
            let error = Diagnostic::error(Code("E0101"), "a colour has six hex digits")
                .at(self.token_span(token), "as in `#c79a6b`");
            return Some(error);
        }
        let token = unmatched(tokens, self.text)?;
        if token.kind == Kind::Close {
            return Some(self.nothing_to_close(token));
        }
        let message = format!("this {} is never closed", self.quoted(token));
        Some(Diagnostic::error(Code("E0105"), message).at(self.token_span(token), "opened here"))
    }

    fn strange(&self, token: Token) -> Diagnostic {
        let span = self.token_span(token);
        let text = token.text(self.text);
        let error = Diagnostic::error(
            Code("E0101"),
            format!("unexpected character {}", self.quoted(token)),
        );
        match text {
            ";" => error.at(span, "fields end with the line, or with `,`").with_fix(Fix::guess(
                "remove it",
                span,
                "",
            )),
            "'" | "\u{2018}" | "\u{2019}" | "\u{201c}" | "\u{201d}" => {
                error.at(span, "strings stand in straight double quotes: \"…\"")
            }
            "\u{2212}" | "\u{2013}" => error
                .at(span, "this is not the minus sign of the keyboard")
                .with_fix(Fix::sure("write `-`", span, "-")),
            "\u{a0}" => error.at(span, "a no-break space").with_fix(Fix::sure(
                "write a plain space",
                span,
                " ",
            )),
            _ if text.is_ascii() => error.at(span, "it has no meaning in a scene"),
            _ => error.at(span, "names use the letters a-z, digits and `_`"),
        }
    }

    /// Asks the grammar where a text goes wrong and words it. `end` names what should end there.
    fn explain(&self, rule: Rule, span: Span, end: &str) -> Diagnostic {
        let failure = fails(self.text, span, rule);
        let at = failure.as_ref().map_or(span.end as usize, |f| f.at);
        let expected = failure.map(|f| f.expected).unwrap_or_default();
        let tokens = self.tokens_in(span);
        let k = tokens.iter().position(|t| t.end > at).unwrap_or(tokens.len());
        let found = tokens.get(k).copied();
        let before = k.checked_sub(1).and_then(|k| tokens.get(k)).copied();
        for (keyword, rule) in [("`then`", Rule::kw_then), ("`else`", Rule::kw_else)] {
            if expected.contains(&rule) {
                let message = format!("expected {keyword} in this `if`");
                let error = Diagnostic::error(Code("E0101"), message)
                    .with_help("write `if condition then value else value`");
                let place = found.or(before).map_or(span, |t| self.token_span(t));
                let place = if found.is_some() { place } else { place.after() };
                return error.at(place, format!("expected {keyword} here"));
            }
        }
        let inside_token = found.is_some_and(|t| t.start < at);
        match before {
            Some(token) if !inside_token && ends_value(token, self.text) => {
                self.after_value(token, found, &tokens[..k], end)
            }
            _ => {
                let what = match before {
                    Some(t)
                        if matches!(t.text(self.text), "." | "as" | ":" | "like")
                            && expected.iter().any(|r| matches!(r, Rule::ident | Rule::path)) =>
                    {
                        "a name"
                    }
                    _ => "a value",
                };
                if let Some(error) = found.and_then(|t| self.misplaced_word(t, what)) {
                    return error;
                }
                self.expected(what, before, found)
            }
        }
    }

    /// A word of the language where a value should be.
    fn misplaced_word(&self, token: Token, what: &str) -> Option<Diagnostic> {
        if ends_value(token, self.text) || token.text(self.text) == "if" {
            return None;
        }
        self.reserved(token, what)
    }

    /// Something follows a value that cannot.
    fn after_value(
        &self,
        before: Token,
        found: Option<Token>,
        tokens: &[Token],
        end: &str,
    ) -> Diagnostic {
        let bracket = unmatched(tokens, self.text).filter(|t| t.kind == Kind::Open);
        let Some(found) = found else {
            let what = if end == "the line" { "more" } else { "an operator" };
            return self.expected(what, Some(before), None);
        };
        let (span, gap) = (self.token_span(found), self.token_span(before).after());
        let quoted = self.quoted(found);
        let what = format!("unexpected {quoted} after {}", self.quoted(before));
        let error = Diagnostic::error(Code("E0101"), what);
        let text = found.text(self.text);
        let number = before.kind == Kind::Number
            && before.text(self.text).ends_with(|c: char| c.is_ascii_digit());
        let tuple = before.text(self.text) == ")";
        if found.kind == Kind::Word && !RESERVED.contains(&text) && (number || tuple)
            || text == "%" && number
        {
            let space = gap.to(span.before());
            let glued = space.start == space.end;
            let error = error.at(span, if glued { "no unit" } else { "a unit?" });
            if glued {
                return error.with_note("a unit stands after a number, or after a tuple of them");
            }
            return error.with_fix(Fix::guess(
                "a unit stands directly after its number",
                space,
                "",
            ));
        }
        let starts_value =
            matches!(found.kind, Kind::Word | Kind::Number | Kind::Text | Kind::Hex | Kind::Open)
                && !(found.kind == Kind::Word && RESERVED.contains(&text));
        match bracket {
            Some(_) if starts_value => error
                .at(span, "expected `,` before this")
                .with_fix(Fix::guess("insert `,`", gap, ",")),
            _ if found.kind == Kind::Compare => error.at(span, "comparisons cannot be chained"),
            _ if found.kind == Kind::DotDot => error.at(span, "a range has two ends"),
            _ if end == "the line" && starts_value => {
                error.at(span, "expected the end of the declaration")
            }
            _ => error.at(span, format!("expected the end of {end}")),
        }
    }
}

/// The first byte where `rule` cannot read a span, and what it wanted there; `None` if it can.
fn fails(text: &str, span: Span, rule: Rule) -> Option<Failure> {
    let (start, end) = (span.start as usize, span.end as usize);
    let error = Grammar::parse(rule, text.get(start..end).unwrap_or("")).err()?;
    let (InputLocation::Pos(at) | InputLocation::Span((at, _))) = error.location;
    let expected = match error.variant {
        ErrorVariant::ParsingError { positives, .. } => positives,
        ErrorVariant::CustomError { .. } => Vec::new(),
    };
    Some(Failure { at: start + at, expected })
}

/// The innermost bracket without a partner, or the first that closes nothing.
fn unmatched(tokens: &[Token], text: &str) -> Option<Token> {
    let mut open: Vec<Token> = Vec::new();
    for &token in tokens {
        match token.kind {
            Kind::Open => open.push(token),
            Kind::Close => {
                let fits = open.last().is_some_and(|t| {
                    matches!((t.text(text), token.text(text)), ("(", ")") | ("[", "]") | ("{", "}"))
                });
                if fits {
                    open.pop();
                } else {
                    return open.last().copied().or(Some(token));
                }
            }
            _ => {}
        }
    }
    open.last().copied()
}

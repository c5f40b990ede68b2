//! Which part of a field, a head or a line could not be read, and what to say of it.

use super::declare::unknown_word;
use super::explain::{fails, unmatched};
use super::{Reader, Rule};
use crate::diagnostic::{Code, Diagnostic, Fix};
use crate::lex::{Kind, RESERVED, Token, ends_value};
use crate::source::{Span, byte_offset};
use crate::split::{Chunk, start_words};
use crate::suggest::suggest;
use crate::syntax::DeclKind;

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
        let first = self.tokens.partition_point(|t| t.start() < start);
        let inside = self.tokens[first..].iter().take_while(|t| t.end() <= end);
        inside.filter(|t| !matches!(t.kind, Kind::Comment | Kind::Newline)).copied().collect()
    }

    pub(super) fn quoted(&self, token: Token) -> String {
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

    pub(super) fn nothing_to_close(&self, token: Token) -> Diagnostic {
        let message = format!("unmatched {}", self.quoted(token));
        let span = self.token_span(token);
        Diagnostic::error(Code("E0105"), message).at(span, "unmatched").with_fix(Fix::guess(
            "remove it",
            span,
            "",
        ))
    }

    /// A block that ends with its chunk.
    pub(super) fn unclosed(&mut self, brace: Span, next: Option<Token>) -> Diagnostic {
        let end = next.map_or(self.text.len(), Token::start);
        let last = self.tokens.partition_point(|t| t.start() < end);
        let mut inside = self.tokens[..last].iter().rev();
        let last = inside.find(|t| !matches!(t.kind, Kind::Comment | Kind::Newline));
        let last = last.map_or(brace, |&token| self.token_span(token));
        // A comment behind the last field stays behind it.
        let rest = self.text.get(last.end as usize..).unwrap_or("");
        let line_end = last.end as usize + rest.find(['\n', '\r']).unwrap_or(rest.len());
        let line = self.line_of(line_end);
        let mut error = Diagnostic::error(Code("E0102"), "unclosed block").at(brace, "opened here");
        if let Some(token) = next {
            error =
                error.because(self.token_span(token), "a new declaration starts here, in column 1");
        }
        let fix = format!("add `}}` after line {line}");
        error
            .with_fix(Fix::guess(fix, self.bytes(line_end..line_end), "\n}"))
            .with_note("the rest of the file was still checked")
    }

    /// The line of a byte. Faults come in the order of the text: lines are counted on from the last one.
    fn line_of(&mut self, byte: usize) -> usize {
        let (from, line) = if self.counted.0 <= byte { self.counted } else { (0, 1) };
        let passed = self.text.get(from..byte).unwrap_or("");
        let line = line + passed.matches('\n').count();
        self.counted = (byte, line);
        line
    }

    pub(super) fn has_open_bracket(&self, span: Span) -> bool {
        matches!(unmatched(&self.tokens_in(span), self.text), Some(t) if t.kind == Kind::Open)
    }

    /// A piece of a block that is no field.
    pub(super) fn explain_field(&self, span: Span) -> Diagnostic {
        let mut tokens = self.tokens_in(span);
        // A string without an end reaches farther than the field, which ended at a comma in it.
        let end = span.end as usize;
        let last = self.tokens.partition_point(|t| t.start() < end).checked_sub(1);
        let last = last.and_then(|i| self.tokens.get(i));
        tokens.extend(last.filter(|t| t.kind == Kind::OpenText && t.end() > end));
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
        if let Some(error) = self.declaration_inside(&tokens) {
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
        let after = tokens.iter().find(|t| byte_offset(t.start()) >= path.end).copied();
        match after {
            Some(t) if t.kind == Kind::Equals || t.kind == Kind::Dot => {
                self.explain(Rule::strict_field, span, "the field")
            }
            _ => self.no_equals(name, path, after),
        }
    }

    /// `let x = …` in a block.
    fn declaration_inside(&self, tokens: &[Token]) -> Option<Diagnostic> {
        let [first, name, sign, ..] = tokens else { return None };
        let word = first.text(self.text);
        let shaped = name.kind == Kind::Word
            && matches!(sign.text(self.text), "=" | ":" | "{" | "[" | "like");
        if !shaped || !start_words().any(|start| start == word) {
            return None;
        }
        let message = format!("`{word}` cannot stand inside a block");
        let error = Diagnostic::error(Code("E0101"), message)
            .at(self.token_span(*first), "a declaration")
            .with_help(format!("write `{word} {}` before the block", name.text(self.text)));
        Some(error)
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
            "import" => &[Part::Text("a file name in quotes")],
            "param" => {
                &[Part::Name("a name"), Part::Sign(":"), Part::Name("a type"), Part::Sign("=")]
            }
            "let" | "asset" | "texture" => &[Part::Name("a name"), Part::Sign("=")],
            "assert" => return self.explain_assert(tokens, span),
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

    /// `assert`, which has no head.
    fn explain_assert(&self, tokens: &[Token], span: Span) -> Diagnostic {
        match tokens.last() {
            Some(&last)
                if tokens.iter().all(|t| t.kind != Kind::Comma) && ends_value(last, self.text) =>
            {
                self.expected("`,` and a message in quotes", Some(last), None)
            }
            _ => self.explain(Rule::strict_line, span, "the line"),
        }
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
        if let Some(colon) = third.filter(|t| t.text(self.text) == ":")
            && let Some(bracket) = tokens.iter().find(|t| t.text(self.text) == "(")
        {
            return Diagnostic::error(Code("E0101"), "a type has no `(`")
                .at(self.token_span(*bracket), "not wanted")
                .with_fix(Fix::guess(
                    "to take something from a file, write `like`",
                    self.token_span(*colon),
                    " like",
                ));
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
    pub(super) fn reserved(&self, token: Token, what: &str) -> Option<Diagnostic> {
        let text = token.text(self.text);
        if token.kind != Kind::Word || !RESERVED.contains(&text) {
            return None;
        }
        let message = format!("`{text}` is a word of the language and cannot be {what}");
        Some(Diagnostic::error(Code("E0101"), message).at(self.token_span(token), "reserved"))
    }
}

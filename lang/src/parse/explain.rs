//! Words for the place where the grammar stopped.
//!
//! The grammar, asked again without its catch-all rules, says how far a text is right; the tokens
//! around that place say what to call the fault.

use pest::Parser;
use pest::error::{ErrorVariant, InputLocation};

use super::{Grammar, Reader, Rule};
use crate::diagnostic::{Code, Diagnostic, Fix};
use crate::lex::{Kind, RESERVED, Token, ends_value};
use crate::source::Span;

/// How far a text is right.
pub(super) struct Failure {
    /// First byte that cannot be read.
    at: usize,
    /// What the grammar would have taken there.
    expected: Vec<Rule>,
}

/// Keywords that tell by themselves what is missing.
const KEYWORDS: [(Rule, &str); 3] = [
    (Rule::kw_then, "`then` and a value"),
    (Rule::kw_else, "`else` and a value"),
    (Rule::kw_in, "`in` and a range"),
];

/// The tokens of a faulty text and how many of them are right.
struct Stop {
    tokens: Vec<Token>,
    n_right: usize,
    expected: Vec<Rule>,
    /// The fault lies in the middle of a token.
    inside_token: bool,
    /// It is in the head of a declaration.
    head: bool,
}

impl Stop {
    fn before(&self) -> Option<Token> {
        self.n_right.checked_sub(1).and_then(|i| self.tokens.get(i)).copied()
    }

    fn found(&self) -> Option<Token> {
        self.tokens.get(self.n_right).copied()
    }

    fn right(&self) -> &[Token] {
        self.tokens.get(..self.n_right).unwrap_or(&[])
    }

    fn wants(&self, rules: &[Rule]) -> bool {
        self.expected.iter().any(|rule| rules.contains(rule))
    }
}

impl Reader<'_> {
    pub(super) fn expected(
        &self,
        what: &str,
        after: Option<Token>,
        found: Option<Token>,
    ) -> Diagnostic {
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
    pub(super) fn broken_token(&self, tokens: &[Token]) -> Option<Diagnostic> {
        if let Some(&token) = tokens.iter().find(|t| t.kind == Kind::OpenText) {
            let span = self.token_span(token);
            let import = tokens.first().is_some_and(|t| t.text(self.text) == "import");
            let end = token.start() + string_end(token.text(self.text), import);
            let error = Diagnostic::error(Code("E0106"), "unterminated string")
                .at(span, "a string ends on the line where it starts")
                .with_fix(Fix::guess("close it", self.bytes(end..end), "\""));
            return Some(error);
        }
        if let Some(i) = tokens.iter().position(|t| t.kind == Kind::Other) {
            let before = i.checked_sub(1).and_then(|i| tokens.get(i)).copied();
            let unit = before.and_then(|before| self.loose_unit(before, tokens[i]));
            return Some(unit.unwrap_or_else(|| self.strange(tokens[i])));
        }
        let is_good = |t: &&Token| {
            let mut digits = t.text(self.text).bytes().skip(1);
            t.kind != Kind::Hex || t.end() - t.start() == 7 && digits.all(|c| c.is_ascii_hexdigit())
        };
        if let Some(&token) = tokens.iter().find(|t| !is_good(t)) {
            let error = Diagnostic::error(Code("E0101"), "a colour has six hex digits")
                .at(self.token_span(token), "as in `#c79a6b`");
            return Some(error);
        }
        let token = unmatched(tokens, self.text)?;
        if token.kind == Kind::Close {
            return Some(self.nothing_to_close(token));
        }
        let message = format!("unclosed {}", self.quoted(token));
        Some(Diagnostic::error(Code("E0105"), message).at(self.token_span(token), "opened here"))
    }

    fn strange(&self, token: Token) -> Diagnostic {
        let span = self.token_span(token);
        let text = token.text(self.text);
        let message = format!("unexpected character {}", self.quoted(token));
        let error = Diagnostic::error(Code("E0101"), message);
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
    pub(super) fn explain(&self, rule: Rule, span: Span, end: &str) -> Diagnostic {
        let failure = fails(self.text, span, rule);
        let at = failure.as_ref().map_or(span.end as usize, |f| f.at);
        let expected = failure.map(|f| f.expected).unwrap_or_default();
        let tokens = self.tokens_in(span);
        let n_right = tokens.iter().position(|t| t.end() > at).unwrap_or(tokens.len());
        let inside_token = tokens.get(n_right).is_some_and(|t| t.start() < at);
        let head = rule == Rule::strict_head;
        let stop = Stop { tokens, n_right, expected, inside_token, head };
        let (before, found) = (stop.before(), stop.found());
        // After `param … = value` the `in` is optional, so it is not what is missing.
        let must = |keyword: Rule| keyword != Rule::kw_in || rule == Rule::strict_head;
        if let Some((_, words)) = KEYWORDS.iter().find(|&&(k, _)| stop.wants(&[k]) && must(k)) {
            return self.expected(words, before, found);
        }
        // The first word of a line or head is its keyword.
        let values = usize::from(rule != Rule::strict_field);
        match before.filter(|_| !stop.inside_token && stop.n_right > values) {
            Some(token) if ends_value(token, self.text) => self.after_value(token, &stop, end),
            _ => self.no_value(&stop),
        }
    }

    /// Something that is no value stands where one should be.
    fn no_value(&self, stop: &Stop) -> Diagnostic {
        let (before, found) = (stop.before(), stop.found());
        let sign_or_dot = before.and_then(|before| self.sign_or_dot(before, stop));
        if let Some(error) = sign_or_dot {
            return error;
        }
        let import = stop.tokens.first().is_some_and(|t| t.text(self.text) == "import");
        let name = before
            .is_some_and(|t| matches!(t.text(self.text), "." | "as" | ":" | "like" | "["))
            && stop.wants(&[Rule::ident, Rule::path]);
        // Of a head, what stands in brackets names something in a file.
        let text = before.is_some_and(|t| t.text(self.text) == "(") && stop.head;
        let what = match (import || name, text) {
            (true, _) => "a name",
            (false, true) => "a text in quotes",
            (false, false) => "a value",
        };
        match found.and_then(|found| self.misplaced_word(found, what)) {
            Some(error) => error,
            None => self.expected(what, before, found),
        }
    }

    /// A word of the language where a value should be.
    fn misplaced_word(&self, token: Token, what: &str) -> Option<Diagnostic> {
        if ends_value(token, self.text) || token.text(self.text) == "if" {
            return None;
        }
        self.reserved(token, what)
    }

    /// `+5`, `1.`
    fn sign_or_dot(&self, before: Token, stop: &Stop) -> Option<Diagnostic> {
        let text = |t: Token| t.text(self.text);
        if let Some(found) = stop.found().filter(|&t| text(t) == "+") {
            let span = self.token_span(found);
            let error = Diagnostic::error(Code("E0101"), "values have no plus sign")
                .at(span, "only the axes `+x`, `+y` and `+z` do")
                .with_fix(Fix::guess("remove it", span, ""));
            return Some(error);
        }
        let number = stop.right().iter().rev().nth(1).filter(|t| t.kind == Kind::Number);
        let &number = number.filter(|_| text(before) == ".")?;
        let span = self.token_span(number).to(self.token_span(before));
        let message = format!("expected a digit after `{}.`", text(number));
        Some(Diagnostic::error(Code("E0101"), message).at(span, "write `.0` or no dot"))
    }

    /// A unit with a blank before it, or behind something that has none.
    fn loose_unit(&self, before: Token, found: Token) -> Option<Diagnostic> {
        let (text, value) = (found.text(self.text), before.text(self.text));
        let number = before.kind == Kind::Number;
        let bare = number && value.ends_with(|c: char| c.is_ascii_digit() || c == '_');
        let word = found.kind == Kind::Word && !RESERVED.contains(&text);
        if !(word && (number || value == ")") || text == "%" && number) {
            return None;
        }
        let span = self.token_span(found);
        let message = format!("unexpected {} after {}", self.quoted(found), self.quoted(before));
        let error = Diagnostic::error(Code("E0101"), message);
        if before.end() == found.start() {
            let note = "a unit stands after a number, or after a tuple of them";
            return Some(error.at(span, "not a unit").with_note(note));
        }
        let gap = self.bytes(before.end()..found.start());
        let fix = Fix::guess("a unit stands directly after its number", gap, "");
        (bare || value == ")").then(|| error.at(span, "a unit?").with_fix(fix))
    }

    /// Something follows a value that cannot.
    fn after_value(&self, before: Token, stop: &Stop, end: &str) -> Diagnostic {
        let Some(found) = stop.found() else {
            return self.expected("an operator", Some(before), None);
        };
        let next = stop.tokens.get(stop.n_right + 1);
        let named = next.is_some_and(|t| matches!(t.kind, Kind::Colon | Kind::Equals));
        if !named && let Some(error) = self.loose_unit(before, found) {
            return error;
        }
        let (span, gap) = (self.token_span(found), self.token_span(before).after());
        let message = format!("unexpected {} after {}", self.quoted(found), self.quoted(before));
        let error = Diagnostic::error(Code("E0101"), message);
        let reserved = RESERVED.contains(&found.text(self.text));
        let starts_value =
            matches!(found.kind, Kind::Word | Kind::Number | Kind::Text | Kind::Hex | Kind::Open)
                && !reserved;
        let bracket = unmatched(stop.right(), self.text).filter(|t| t.kind == Kind::Open);
        match bracket {
            Some(_) if starts_value => error
                .at(span, "expected `,` before this")
                .with_fix(Fix::guess("insert `,`", gap, ",")),
            None if named && end == "the field" => error
                .at(span, "fields on one line have `,` between them")
                .with_fix(Fix::sure("insert `,`", gap, ",")),
            _ if found.kind == Kind::Compare => error.at(span, "comparisons cannot be chained"),
            _ if found.kind == Kind::DotDot => error.at(span, "a range has two ends"),
            _ => error.at(span, format!("expected the end of {end}")),
        }
    }
}

/// Where a string without an end was probably meant to end: before what may stand behind a string.
fn string_end(text: &str, import: bool) -> usize {
    let text = text.find("//").filter(|_| !text.contains("://")).map_or(text, |at| &text[..at]);
    let end = if import {
        let names = text.find('{').into_iter().chain(text.rfind(" as "));
        names.min()
    } else {
        text.find([',', ')', ']', '}'])
    };
    let before = end.and_then(|end| text.get(..end)).unwrap_or(text).trim_end();
    if before.len() > 1 { before.len() } else { text.trim_end().len() }
}

/// The first byte where `rule` cannot read a span, and what it wanted there; `None` if it can.
pub(super) fn fails(text: &str, span: Span, rule: Rule) -> Option<Failure> {
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
pub(super) fn unmatched(tokens: &[Token], text: &str) -> Option<Token> {
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

//! Text becomes a syntax tree and the list of everything in it that could not be read.
//!
//! The file is split into declarations first (`split`), each is read by the grammar alone, and what
//! the grammar's catch-all rules caught is read again strictly to say what is wrong there
//! (`diagnose`, `explain`). So a fault costs one field or one line, and every other declaration is still there.

mod build;
mod declare;
mod diagnose;
mod explain;

use std::borrow::Cow;

use crate::diagnostic::{Code, Diagnostic, Fix, MAX_FAULTS, sort};
use crate::lex::{Token, lex};
use crate::source::{FileId, MAX_FILE_BYTES, SourceSet, Span, byte_offset};
use crate::split::{Chunk, Header, split};
use crate::stack::on_large_stack;
use crate::syntax::{Edition, File, Item};

/// The generated parser.
mod generated {
    #[derive(pest_derive::Parser)]
    #[grammar = "grammar.pest"]
    pub(super) struct Grammar;
}
use generated::{Grammar, Rule};

/// Expressions that may be higher than this are read on a thread with a known stack.
const MAX_HEIGHT_HERE: usize = 24;

/// Reads one file. Never fails: what cannot be read is poisoned in the tree and reported, in the
/// order of the text.
#[must_use]
pub fn parse(sources: &SourceSet, file: FileId) -> (File, Vec<Diagnostic>) {
    let text = sources.text(file);
    let start = Span { file, start: 0, end: 0 };
    if text.len() > MAX_FILE_BYTES {
        let mib = MAX_FILE_BYTES >> 20;
        let diagnostic = Diagnostic::error(Code("E0107"), format!("this file exceeds {mib} MiB"))
            .at(start, "")
            .with_help("keep meshes and images in files of their own");
        return (File { has_errors: true, ..File::default() }, vec![diagnostic]);
    }
    let (text, control) = without_control(text, file);
    let tokens = lex(&text);
    let chunks = split(&text, &tokens);
    let height = chunks.iter().filter(|c| c.too_deep.is_none()).map(|c| c.height).max();
    let read = || {
        let diagnostics = Vec::from_iter(control);
        Reader { file, text: &text, tokens: &tokens, base: 0, diagnostics, counted: (0, 1) }
            .file(&chunks)
    };
    if height.unwrap_or(0) <= MAX_HEIGHT_HERE {
        return read();
    }
    match on_large_stack(read) {
        Ok(result) => result,
        Err(error) => {
            let message = format!("no thread could be started to read this file: {error}");
            let diagnostic = Diagnostic::error(Code("E0109"), message).at(start, "");
            (File { has_errors: true, ..File::default() }, vec![diagnostic])
        }
    }
}

/// Blanks out control characters, so that each file has one complaint about them and no more.
fn without_control(text: &str, file: FileId) -> (Cow<'_, str>, Option<Diagnostic>) {
    let is_control = |c: char| c.is_ascii_control() && !matches!(c, '\t' | '\n' | '\r');
    let Some(at) = text.find(is_control) else { return (Cow::Borrowed(text), None) };
    let span = Span { file, start: byte_offset(at), end: byte_offset(at + 1) };
    let byte = text.as_bytes()[at];
    let diagnostic = Diagnostic::error(Code("E0107"), "a control character in the text")
        .at(span, format!("byte 0x{byte:02x}"))
        .with_help("remove it; is this a text file?");
    (Cow::Owned(text.replace(is_control, " ")), Some(diagnostic))
}

/// Reads the chunks of one file.
struct Reader<'a> {
    file: FileId,
    text: &'a str,
    tokens: &'a [Token],
    /// Where the text that the grammar is reading starts in `text`.
    base: usize,
    diagnostics: Vec<Diagnostic>,
    /// A place in the text and its line, from which later ones are counted.
    counted: (usize, usize),
}

impl Reader<'_> {
    /// Says what is wrong, unless too much is.
    fn fault(&mut self, diagnostic: Diagnostic) {
        if !self.is_full() {
            self.diagnostics.push(diagnostic);
        }
    }

    /// Is so much wrong that no more is kept?
    fn is_full(&self) -> bool {
        self.diagnostics.len() >= MAX_FAULTS
    }

    fn file(mut self, chunks: &[Chunk]) -> (File, Vec<Diagnostic>) {
        let mut file = File::default();
        let mut has_header = false;
        for (i, chunk) in chunks.iter().enumerate() {
            let first = self.tokens[chunk.tokens.start];
            if self.is_full() {
                let message = format!("more than {MAX_FAULTS} faults; the rest was not read");
                let diagnostic = Diagnostic::error(Code("E0112"), message);
                self.diagnostics.push(diagnostic.at(self.token_span(first), "up to here"));
                break;
            }
            if first.text(self.text) == "rts" {
                if i > 0 {
                    self.misplaced_edition(first, has_header);
                }
                if !has_header {
                    file.edition = self.edition(chunk);
                }
                has_header = true;
                continue;
            }
            let next = chunks.get(i + 1).map(|next| self.tokens[next.tokens.start]);
            file.items.extend(self.item(chunk, next));
        }
        if !has_header {
            self.missing_edition(chunks);
        }
        sort(&mut self.diagnostics);
        file.has_errors = !self.diagnostics.is_empty();
        (file, self.diagnostics)
    }

    /// `rts 1`.
    fn edition(&mut self, chunk: &Chunk) -> Option<Edition> {
        let tokens = &self.tokens[chunk.tokens.clone()];
        let span = self.token_span(tokens[0]).to(self.token_span(tokens[tokens.len() - 1]));
        let words: Vec<&str> = tokens.iter().map(|t| t.text(self.text)).collect();
        if words[1..] == ["1"] {
            return Some(Edition { number: 1, span });
        }
        let known = "this program knows edition 1: `rts 1`";
        let diagnostic = match words.get(1) {
            None => Diagnostic::error(Code("E0103"), "expected an edition after `rts`"),
            Some(number) if words.len() == 2 => {
                Diagnostic::error(Code("E0103"), format!("unknown edition `{number}`"))
            }
            Some(_) => Diagnostic::error(Code("E0103"), "expected nothing after the edition"),
        };
        self.fault(diagnostic.at(span, known));
        None
    }

    fn misplaced_edition(&mut self, token: Token, again: bool) {
        let message =
            if again { "the edition is given twice" } else { "the edition must come first" };
        let diagnostic = Diagnostic::error(Code("E0110"), message);
        self.fault(diagnostic.at(self.token_span(token), "not here"));
    }

    fn missing_edition(&mut self, chunks: &[Chunk]) {
        let first = chunks.first().map(|chunk| self.token_span(self.tokens[chunk.tokens.start]));
        let top = self.text.len() - self.text.trim_start_matches('\u{feff}').len();
        let top = self.bytes(top..top);
        let diagnostic = Diagnostic::error(Code("E0103"), "missing edition")
            .at(first.unwrap_or(top), "expected `rts 1` before anything else")
            .with_note("the edition fixes what every default means, for ever")
            .with_fix(Fix::sure("start with the edition", top, "rts 1\n"));
        self.fault(diagnostic);
    }

    /// One declaration; `next` is the first token of the chunk after it.
    fn item(&mut self, chunk: &Chunk, next: Option<Token>) -> Option<Item> {
        if let Some(token) = chunk.too_deep {
            return Some(self.too_deep(chunk, self.tokens[token]));
        }
        if let Some(token) = chunk.too_long.filter(|_| chunk.header == Header::Item) {
            return Some(self.too_long(chunk, self.tokens[token]));
        }
        if let Some(token) = chunk.too_many {
            return Some(self.too_many(chunk, self.tokens[token]));
        }
        self.declaration(chunk, next)
    }

    fn token_span(&self, token: Token) -> Span {
        self.bytes(token.start()..token.end())
    }
}

//! Text becomes the same text in its one layout.
//!
//! Every token is printed again as it was written, comments included; only blanks, line breaks,
//! separators, `.5` (to `0.5`), the case of hex colours and the order of neighbouring imports change.
//! Lines end as most of them did, with CR LF or with LF.
//! Whatever the author broke over lines stays broken, one entry a line; the rest stays on its line
//! as long as that has at most [`MAX_WIDTH`] columns. Formatting twice changes nothing, and the
//! result is only given out if it reads as the same tree.

mod print;
mod tree;

pub use print::MAX_WIDTH;

use crate::diagnostic::{Code, Diagnostic};
use crate::lex::{Kind, lex};
use crate::parse::parse;
use crate::source::{FileId, SourceSet, Span};
use crate::split::split;
use crate::syntax::File;

/// Formats one text; its diagnostics name the file `FileId(0)`.
pub fn format(text: &str) -> Result<String, Vec<Diagnostic>> {
    let mut sources = SourceSet::new();
    let file = sources.add("", text);
    format_file(&sources, file)
}

/// Formats one file. A text with errors is not touched: its diagnostics are returned.
pub fn format_file(sources: &SourceSet, file: FileId) -> Result<String, Vec<Diagnostic>> {
    let (before, diagnostics) = parse(sources, file);
    if diagnostics.iter().any(Diagnostic::is_error) {
        return Err(diagnostics);
    }
    let text = sources.text(file);
    let tokens = lex(text);
    let chunks: Vec<_> = split(text, &tokens).into_iter().map(|chunk| chunk.tokens).collect();
    let formatted = with_line_ends_of(text, print::print(text, &tokens, &chunks));
    let mut again = SourceSet::new();
    let copy = again.add("", formatted.as_str());
    let (after, _) = parse(&again, copy);
    if same(before, after) && comments(text) == comments(&formatted) {
        return Ok(formatted);
    }
    let message = "this file cannot be formatted without changing what it says; it was left alone";
    let bug = Diagnostic::error(Code("E0199"), message)
        .at(Span { file, start: 0, end: 0 }, "")
        .with_note("this is a fault of the formatter: please report it with the file");
    Err(vec![bug])
}

/// The lines of `formatted`, which end with LF, with the more frequent line end of `text`.
fn with_line_ends_of(text: &str, formatted: String) -> String {
    let (n_both, n_feeds) = (text.matches("\r\n").count(), text.matches('\n').count());
    if n_both > n_feeds - n_both { formatted.replace('\n', "\r\n") } else { formatted }
}

/// Do two trees say the same? The order of imports says nothing.
fn same(before: File, after: File) -> bool {
    let sorted = |file: File| {
        let mut file = file.without_places();
        file.items.sort_by_cached_key(|item| match &item.kind {
            crate::syntax::ItemKind::Import(import) => format!("0{import:?}"),
            _ => "1".to_owned(),
        });
        file
    };
    sorted(before) == sorted(after)
}

/// All comments, in the order of the alphabet, because they move with imports.
fn comments(text: &str) -> Vec<&str> {
    let tokens = lex(text).into_iter().filter(|t| t.kind == Kind::Comment);
    let mut comments: Vec<&str> = tokens.map(|t| t.text(text).trim_end()).collect();
    comments.sort_unstable();
    comments
}

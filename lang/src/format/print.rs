//! Groups become lines.

use std::ops::Range;

use super::tree::{Group, Node, Piece, Pieces, Style, declaration};
use crate::lex::{Kind, Token, ends_value, is_callee};

/// Longest line that is left unbroken, in characters.
pub const MAX_WIDTH: usize = 100;

/// Columns per level.
const INDENT: usize = 2;

/// Prints a whole file; `chunks` are the token ranges of its declarations.
pub(super) fn print(text: &str, tokens: &[Token], chunks: &[Range<usize>]) -> String {
    let mut pieces = Pieces::default();
    let mut chunks = chunks.iter();
    let mut next = chunks.next();
    let mut i = 0;
    while let Some(token) = tokens.get(i) {
        if let Some(chunk) = next.filter(|chunk| chunk.start == i) {
            pieces.entry().extend(declaration(text, tokens, chunk.clone()));
            pieces.end();
            i = chunk.end;
            next = chunks.next();
            continue;
        }
        match token.kind {
            Kind::Newline => pieces.newline(),
            Kind::Comment => pieces.comment(*token),
            _ => {}
        }
        i += 1;
    }
    let mut pieces = pieces.finish();
    sort_imports(text, &mut pieces);
    let mut printer = Printer { text, out: String::new(), line_start: 0, before: None };
    for piece in &pieces {
        printer.piece(piece, 0, "");
    }
    printer.out
}

/// Sorts neighbouring imports: those of the program itself first, then by file name.
fn sort_imports(text: &str, pieces: &mut [Piece]) {
    let key = |piece: &Piece| {
        let Piece::Entry { nodes, .. } = piece else { return None };
        let [Node::Leaf(import), Node::Leaf(path), ..] = nodes.as_slice() else { return None };
        let path = path.text(text).to_owned();
        (import.text(text) == "import").then(|| (!path.starts_with("\"std:"), path))
    };
    for run in pieces.chunk_by_mut(|a, b| key(a).is_some() && key(b).is_some()) {
        run.sort_by_cached_key(key);
    }
}

struct Printer<'a> {
    text: &'a str,
    out: String,
    /// Byte of `out` where the current line starts.
    line_start: usize,
    /// The last token of the line, and whether it is a sign rather than an operator.
    before: Option<(Token, bool)>,
}

impl Printer<'_> {
    fn piece(&mut self, piece: &Piece, indent: usize, separator: &str) {
        match piece {
            Piece::Blank => {}
            Piece::Comment(comment) => {
                self.start_line(indent);
                self.out.push_str(comment.text(self.text).trim_end());
            }
            Piece::Entry { nodes, trailing } => {
                self.start_line(indent);
                self.nodes(nodes, indent, separator.len());
                self.out.push_str(separator);
                self.trailing(*trailing);
            }
        }
        self.out.push('\n');
        self.line_start = self.out.len();
        self.before = None;
    }

    fn start_line(&mut self, indent: usize) {
        self.out.extend(std::iter::repeat_n(' ', indent));
        self.before = None;
    }

    fn trailing(&mut self, comment: Option<Token>) {
        if let Some(comment) = comment {
            self.out.push(' ');
            self.out.push_str(comment.text(self.text).trim_end());
        }
    }

    fn column(&self) -> usize {
        self.out.get(self.line_start..).map_or(0, |line| line.chars().count())
    }

    /// Prints nodes on this line, breaking what the author broke, or else what does not fit.
    /// `tail`: columns that something behind them needs.
    fn nodes(&mut self, nodes: &[Node], indent: usize, tail: usize) {
        let forced = nodes.iter().any(|node| matches!(node, Node::Group(g) if g.broken));
        let mark = (self.out.len(), self.before);
        let mut widest = None;
        if !forced {
            for (i, node) in nodes.iter().enumerate() {
                let start = self.out.len();
                self.flat_node(node);
                if let Node::Group(group) = node
                    && group.entries().next().is_some()
                {
                    let width = self.out.len() - start;
                    let rank = (group.style == Style::Block, width);
                    widest = widest.max(Some((rank, i)));
                }
            }
            if self.column() + tail <= MAX_WIDTH || widest.is_none() {
                return;
            }
            self.out.truncate(mark.0);
            self.before = mark.1;
        }
        for (i, node) in nodes.iter().enumerate() {
            match node {
                Node::Group(g) if g.broken || widest.is_some_and(|(_, w)| w == i) => {
                    self.broken(g, indent);
                }
                _ => self.flat_node(node),
            }
        }
    }

    fn flat_node(&mut self, node: &Node) {
        match node {
            Node::Leaf(token) => self.token(*token),
            Node::Group(group) => self.flat(group),
        }
    }

    fn flat(&mut self, group: &Group) {
        self.token(group.open);
        let brace = group.open.text(self.text) == "{";
        let mut entries = group.entries().peekable();
        let pad = if brace && entries.peek().is_some() { " " } else { "" };
        self.out.push_str(pad);
        while let Some(entry) = entries.next() {
            // What follows a bracket or comma starts afresh: no blank, and a sign is a sign.
            self.before = None;
            for node in entry {
                self.flat_node(node);
            }
            if entries.peek().is_some() {
                self.out.push_str(", ");
            }
        }
        self.out.push_str(pad);
        self.close(group);
    }

    fn broken(&mut self, group: &Group, indent: usize) {
        self.token(group.open);
        self.trailing(group.lead);
        self.out.push('\n');
        self.line_start = self.out.len();
        let separator = if group.style == Style::Entries { "," } else { "" };
        for piece in &group.pieces {
            self.piece(piece, indent + INDENT, separator);
        }
        self.start_line(indent);
        self.close(group);
    }

    fn close(&mut self, group: &Group) {
        self.out.push_str(group.close.text(self.text));
        self.before = Some((group.close, false));
    }

    fn token(&mut self, token: Token) {
        if let Some(before) = self.before
            && self.blank_between(before, token)
        {
            self.out.push(' ');
        }
        let sign = token.kind == Kind::Arithmetic
            && self.before.is_none_or(|(before, _)| !ends_value(before, self.text));
        self.before = Some((token, sign));
        let text = token.text(self.text);
        match token.kind {
            Kind::Hex => self.out.push_str(&text.to_ascii_lowercase()),
            Kind::Number if text.starts_with('.') => {
                self.out.push('0');
                self.out.push_str(text);
            }
            _ => self.out.push_str(text),
        }
    }

    fn blank_between(&self, (before, sign): (Token, bool), token: Token) -> bool {
        if sign {
            // `- x` is the name x, `-x` an axis.
            let axis = matches!(token.text(self.text), "x" | "y" | "z");
            return axis && before.end() != token.start();
        }
        let name = is_callee(before, self.text);
        match (before.kind, token.kind) {
            (Kind::Open | Kind::Dot | Kind::DotDot, _)
            | (
                _,
                Kind::Comma | Kind::Close | Kind::Dot | Kind::DotDot | Kind::Unit | Kind::Colon,
            ) => false,
            (_, Kind::Open) if name => token.text(self.text) == "{",
            _ => true,
        }
    }
}

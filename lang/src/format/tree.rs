//! The tokens of one declaration become nested groups whose entries know their comments.

use std::ops::Range;

use crate::lex::{Kind, Token, is_callee};

/// A token, or a bracket with all that is inside.
pub(super) enum Node {
    Leaf(Token),
    Group(Group),
}

/// How a group is laid out.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(super) enum Style {
    /// Entries with commas between: lists, tuples, arguments, imported names.
    Entries,
    /// Fields of a declaration.
    Block,
    /// One expression, with comments around it; without comments it would be no group.
    Paren,
}

/// A bracket with all that is inside.
pub(super) struct Group {
    pub(super) style: Style,
    pub(super) open: Token,
    pub(super) close: Token,
    /// Comment behind the opening bracket.
    pub(super) lead: Option<Token>,
    pub(super) pieces: Vec<Piece>,
    /// The author broke it over lines.
    pub(super) broken: bool,
}

impl Group {
    pub(super) fn entries(&self) -> impl Iterator<Item = &[Node]> {
        self.pieces.iter().filter_map(|piece| match piece {
            Piece::Entry { nodes, .. } => Some(nodes.as_slice()),
            _ => None,
        })
    }
}

/// What stands on a line of its own.
pub(super) enum Piece {
    /// An empty line.
    Blank,
    /// A comment.
    Comment(Token),
    /// A declaration, a field, an entry of a list; with the comment behind it.
    Entry { nodes: Vec<Node>, trailing: Option<Token> },
}

/// Collects pieces and decides to which of them a comment or an empty line belongs.
#[derive(Default)]
pub(super) struct Pieces {
    done: Vec<Piece>,
    entry: Vec<Node>,
    /// Line breaks since the last thing.
    n_newlines: usize,
}

impl Pieces {
    /// The current entry, to be continued.
    pub(super) fn entry(&mut self) -> &mut Vec<Node> {
        if self.entry.is_empty() {
            self.blank();
        }
        self.n_newlines = 0;
        &mut self.entry
    }

    /// A comma ends the current entry.
    pub(super) fn comma(&mut self) {
        self.end();
        self.n_newlines = 0;
    }

    /// The current entry ends.
    pub(super) fn end(&mut self) {
        if !self.entry.is_empty() {
            let nodes = std::mem::take(&mut self.entry);
            self.done.push(Piece::Entry { nodes, trailing: None });
        }
    }

    pub(super) fn newline(&mut self) {
        self.n_newlines += 1;
    }

    pub(super) fn comment(&mut self, comment: Token) {
        self.end();
        if self.n_newlines == 0
            && let Some(Piece::Entry { trailing: trailing @ None, .. }) = self.done.last_mut()
        {
            *trailing = Some(comment);
            return;
        }
        self.blank();
        self.n_newlines = 0;
        self.done.push(Piece::Comment(comment));
    }

    /// Keeps one of any number of empty lines, none at the start.
    fn blank(&mut self) {
        if self.n_newlines > 1 && !self.done.is_empty() {
            self.done.push(Piece::Blank);
        }
    }

    pub(super) fn finish(mut self) -> Vec<Piece> {
        self.end();
        self.done
    }
}

/// Builds the nodes of one declaration.
pub(super) fn declaration(text: &str, tokens: &[Token], range: Range<usize>) -> Vec<Node> {
    let end = range.end;
    let is_import = tokens[range.start].text(text) == "import";
    let mut builder = Builder { text, tokens, at: range.start, end, is_import, stray: Vec::new() };
    let mut nodes = Vec::new();
    while builder.at < builder.end {
        builder.node(&mut nodes);
    }
    nodes
}

/// What a bracket holds.
struct Ahead {
    /// Index of its closing partner.
    close: usize,
    /// A comma stands directly inside.
    comma: bool,
    /// A comment stands directly inside.
    comment: bool,
    /// A line ends inside.
    broken: bool,
}

struct Builder<'a> {
    text: &'a str,
    tokens: &'a [Token],
    at: usize,
    end: usize,
    is_import: bool,
    /// Comments between the head of a declaration and its `{`.
    stray: Vec<Token>,
}

impl Builder<'_> {
    /// Adds the next node, or the tokens of a bracket that never breaks.
    fn node(&mut self, nodes: &mut Vec<Node>) {
        let token = self.tokens[self.at];
        match token.kind {
            Kind::Newline => self.at += 1,
            Kind::Comment => {
                self.stray.push(token);
                self.at += 1;
            }
            Kind::Open => self.open(nodes, token),
            _ => {
                nodes.push(Node::Leaf(token));
                self.at += 1;
            }
        }
    }

    /// Looks at the bracket at `self.at` as a whole.
    fn look_ahead(&self) -> Ahead {
        let mut depth = 0_usize;
        let mut ahead = Ahead { close: self.end - 1, comma: false, comment: false, broken: false };
        for (i, token) in self.tokens.iter().enumerate().take(self.end).skip(self.at) {
            match token.kind {
                Kind::Open => depth += 1,
                Kind::Close => depth = depth.saturating_sub(1),
                Kind::Comma => ahead.comma |= depth == 1,
                Kind::Newline => ahead.broken = true,
                Kind::Comment => {
                    ahead.broken = true;
                    ahead.comment |= depth == 1;
                }
                _ => {}
            }
            if depth == 0 {
                ahead.close = i;
                break;
            }
        }
        ahead
    }

    fn open(&mut self, nodes: &mut Vec<Node>, open: Token) {
        let Ahead { close: close_at, comma, comment, broken } = self.look_ahead();
        let close = self.tokens[close_at];
        let after_name = matches!(nodes.last(), Some(Node::Leaf(t)) if is_callee(*t, self.text));
        let style = match open.text(self.text) {
            "{" if !self.is_import => Style::Block,
            "(" if !after_name && !comma => Style::Paren,
            "[" if after_name => Style::Paren,
            _ => Style::Entries,
        };
        if style == Style::Paren && !comment {
            nodes.push(Node::Leaf(open));
            self.at += 1;
            while self.at < close_at {
                self.node(nodes);
            }
            nodes.push(Node::Leaf(close));
            self.at = close_at + 1;
            return;
        }
        let broken = broken || style == Style::Block && !self.stray.is_empty();
        let (lead, pieces) = self.pieces(style, close_at);
        nodes.push(Node::Group(Group { style, open, close, lead, pieces, broken }));
    }

    /// The inside of the bracket at `self.at`.
    fn pieces(&mut self, style: Style, close_at: usize) -> (Option<Token>, Vec<Piece>) {
        let mut pieces = Pieces::default();
        let mut lead = None;
        self.at += 1;
        if self.tokens[self.at].kind == Kind::Comment {
            lead = Some(self.tokens[self.at]);
            self.at += 1;
        }
        if style == Style::Block {
            for comment in std::mem::take(&mut self.stray) {
                pieces.newline();
                pieces.comment(comment);
            }
        }
        while self.at < close_at {
            let token = self.tokens[self.at];
            match token.kind {
                Kind::Newline => {
                    if style == Style::Block {
                        pieces.end();
                    }
                    pieces.newline();
                    self.at += 1;
                }
                Kind::Comment => {
                    pieces.comment(token);
                    self.at += 1;
                }
                Kind::Comma => {
                    pieces.comma();
                    self.at += 1;
                }
                _ => self.node(pieces.entry()),
            }
        }
        self.at = close_at + 1;
        (lead, pieces.finish())
    }
}

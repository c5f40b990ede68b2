//! One chunk becomes one declaration, poisoned where it could not be read.

use pest::Parser;
use pest::iterators::{Pair, Pairs};

use super::build::next;
use super::{Grammar, Reader, Rule};
use crate::diagnostic::{Code, Diagnostic, Fix};
use crate::lex::{Kind, RESERVED, Token};
use crate::source::Span;
use crate::split::{Chunk, Header, MAX_BRACKETS, MAX_NAME, MAX_TOKENS, start_words};
use crate::suggest::suggest;
use crate::syntax::{
    Assert, Base, Binding, Decl, DeclKind, Expr, ExprKind, Field, Ident, Item, ItemKind,
    MAX_HEIGHT, Path,
};

impl Reader<'_> {
    /// What a chunk declares. Text that is no declaration at all leaves nothing behind.
    pub(super) fn declaration(&mut self, chunk: &Chunk, next_token: Option<Token>) -> Option<Item> {
        let span = self.chunk_span(chunk);
        if chunk.header == Header::Junk {
            let diagnostic = self.junk_between(chunk);
            self.fault(diagnostic);
            return None;
        }
        let text = self.text.get(span.start as usize..span.end as usize).unwrap_or("");
        self.base = span.start as usize;
        let Ok(mut pairs) = Grammar::parse(Rule::chunk, text) else {
            return Some(self.bad_line(chunk, span));
        };
        let mut parts = next(&mut pairs).into_inner();
        let item = next(&mut parts);
        if item.as_rule() == Rule::bad_item {
            return Some(self.bad_line(chunk, span));
        }
        if item.as_rule() != Rule::decl {
            return Some(self.line(chunk, item));
        }
        let decl = self.decl(chunk, item, next_token);
        if let Some(junk) = parts.next().filter(|junk| junk.as_rule() == Rule::junk) {
            let diagnostic = self.junk_after(self.span(&junk));
            self.fault(diagnostic);
        }
        Some(decl)
    }

    fn chunk_span(&self, chunk: &Chunk) -> Span {
        let first = self.token_span(self.tokens[chunk.tokens.start]);
        first.to(self.token_span(self.tokens[chunk.tokens.end - 1]))
    }

    fn docs(&self, chunk: &Chunk) -> Vec<String> {
        let line = |&token: &usize| {
            let text = self.tokens[token].text(self.text).trim_start_matches('/');
            text.strip_prefix(' ').unwrap_or(text).trim_end().to_owned()
        };
        chunk.docs.iter().map(line).collect()
    }

    /// A declaration without a block that was read whole.
    fn line(&mut self, chunk: &Chunk, pair: Pair<'_, Rule>) -> Item {
        let docs = self.docs(chunk);
        match pair.as_rule() {
            Rule::import => {
                let (import, span) = self.import(pair);
                Item { span, docs: Vec::new(), public: false, kind: ItemKind::Import(import) }
            }
            Rule::param => {
                let (param, span) = self.param(pair);
                Item { span, docs, public: false, kind: ItemKind::Param(param) }
            }
            Rule::assertion => {
                let mut parts = pair.into_inner();
                let keyword = self.span(&next(&mut parts));
                let condition = self.expr(next(&mut parts));
                let message = self.string(&next(&mut parts));
                let span = keyword.to(message.span);
                let kind = ItemKind::Assert(Assert { condition, message });
                Item { span, docs: Vec::new(), public: false, kind }
            }
            _ => {
                let mut parts = pair.into_inner();
                let (public, keyword) = public(&mut parts);
                let start = self.chunk_span(chunk);
                let binding = self.binding(parts);
                let span = start.before().to(binding.value.span);
                let kind = binding_kind(keyword.as_str(), binding);
                Item { span, docs, public, kind }
            }
        }
    }

    /// A declaration without a block, or without its `{`, that could not be read.
    fn bad_line(&mut self, chunk: &Chunk, span: Span) -> Item {
        let diagnostic = self.explain_line(chunk, span);
        self.fault(diagnostic);
        self.poisoned(chunk)
    }

    /// What is left of a declaration that could not be read: the names it seems to declare.
    fn poisoned(&self, chunk: &Chunk) -> Item {
        let span = self.chunk_span(chunk);
        let words: Vec<(&str, Token)> = self.tokens[chunk.tokens.clone()]
            .iter()
            .map(|&t| (t.text(self.text), t))
            .filter(|&(text, t)| t.kind != Kind::Word || text != "pub")
            .collect();
        let public = words.len() < chunk.tokens.len();
        let ident = |&(text, token): &(&str, Token)| {
            let named = token.kind == Kind::Word && !RESERVED.contains(&text);
            named.then(|| Ident { text: text.to_owned(), span: self.token_span(token) })
        };
        let keyword = words.first().map_or("", |word| word.0);
        let names: Vec<Ident> = match keyword {
            "import" => words.iter().skip(1).filter_map(ident).collect(),
            _ => words.get(1).and_then(ident).into_iter().collect(),
        };
        let kind = match (keyword, names.as_slice()) {
            ("let" | "asset" | "texture", [name]) => {
                let value = Expr { kind: ExprKind::Error, span: name.span.after() };
                binding_kind(keyword, Binding { name: name.clone(), value })
            }
            _ => ItemKind::Poisoned(names),
        };
        Item { span, docs: self.docs(chunk), public, kind }
    }

    pub(super) fn too_deep(&mut self, chunk: &Chunk, token: Token) -> Item {
        let message = "this is nested too deeply, so the declaration was skipped";
        let limits = format!(
            "at most {MAX_BRACKETS} brackets inside each other, and {MAX_HEIGHT} brackets and \
             operators in one expression"
        );
        let diagnostic = Diagnostic::error(Code("E0109"), message)
            .at(self.token_span(token), "the limit is reached here")
            .with_note(limits)
            .with_help("give parts of it a name with `let`");
        self.fault(diagnostic);
        self.poisoned(chunk)
    }

    /// A declaration with a name that is too long. It declares nothing, so that no message repeats it.
    pub(super) fn too_long(&mut self, chunk: &Chunk, token: Token) -> Item {
        let n = token.end() - token.start();
        let message = format!("a name has at most {MAX_NAME} letters, this one has {n}");
        let diagnostic = Diagnostic::error(Code("E0111"), message)
            .at(self.token_span(token), "too long")
            .with_note("the declaration was skipped");
        self.fault(diagnostic);
        let (span, docs) = (self.chunk_span(chunk), self.docs(chunk));
        Item { span, docs, public: false, kind: ItemKind::Poisoned(Vec::new()) }
    }

    /// A declaration that is too long to be read at once.
    pub(super) fn too_many(&mut self, chunk: &Chunk, token: Token) -> Item {
        let message = "this declaration is too long, so it was skipped";
        let first = self.token_span(self.tokens[chunk.tokens.start]);
        let diagnostic = Diagnostic::error(Code("E0111"), message)
            .at(first, "starts here")
            .because(self.token_span(token), "the limit is reached here")
            .with_note(format!("a declaration has at most {MAX_TOKENS} names, numbers and signs"))
            .with_help("give parts of it a name with `let`, or declare several");
        self.fault(diagnostic);
        let name = self.tokens.get(chunk.tokens.start + 1).filter(|t| t.kind == Kind::Word);
        let name =
            name.map(|t| Ident { text: t.text(self.text).to_owned(), span: self.token_span(*t) });
        let kind = ItemKind::Poisoned(name.into_iter().collect());
        Item { span: self.chunk_span(chunk), docs: self.docs(chunk), public: false, kind }
    }

    fn decl(&mut self, chunk: &Chunk, pair: Pair<'_, Rule>, next_token: Option<Token>) -> Item {
        let mut parts = pair.into_inner();
        let (public, kind) = public(&mut parts);
        let head = next(&mut parts);
        let block = next(&mut parts);
        let (fields, block, partial) = self.block(block, next_token);
        let kind_span = self.span(&kind);
        let span = self.chunk_span(chunk).before().to(block);
        let docs = self.docs(chunk);
        let named = self.head(head, kind_span);
        let kind = self.kind(kind.as_str(), kind_span);
        let Some((name, index, base)) = named else {
            return Item { span, docs, public, kind: ItemKind::Poisoned(Vec::new()) };
        };
        let decl = Decl { kind, kind_span, name, index, base, fields, block, partial };
        Item { span, docs, public, kind: ItemKind::Decl(decl) }
    }

    /// The kind that a word names or resembles.
    fn kind(&mut self, word: &str, span: Span) -> Option<DeclKind> {
        if let Some(kind) = DeclKind::from_word(word) {
            return Some(kind);
        }
        let near = suggest(word, DeclKind::ALL.map(DeclKind::word));
        self.fault(unknown_word(word, span, &near));
        match near.as_slice() {
            [only] => DeclKind::from_word(only),
            _ => None,
        }
    }

    /// Name, index and base; `None` where not even a name can be made out.
    fn head(
        &mut self,
        pair: Pair<'_, Rule>,
        kind_span: Span,
    ) -> Option<(Ident, Option<crate::syntax::Index>, Option<Base>)> {
        let span = self.span(&pair);
        if pair.as_rule() == Rule::head {
            let mut parts = pair.into_inner();
            let name = self.ident(&next(&mut parts));
            let (mut index, mut base) = (None, None);
            for part in parts {
                if part.as_rule() == Rule::index {
                    index = Some(self.index(part));
                } else {
                    base = Some(self.base(part));
                }
            }
            return Some((name, index, base));
        }
        let diagnostic = self.explain_head(kind_span, span);
        self.fault(diagnostic);
        let first = self.tokens_in(span).first().copied()?;
        let text = first.text(self.text);
        if first.kind != Kind::Word || RESERVED.contains(&text) {
            return None;
        }
        let name = Ident { text: text.to_owned(), span: self.token_span(first) };
        Some((name, None, Some(Base::Error(span))))
    }

    /// Fields, span, and whether something is missing.
    fn block(&mut self, pair: Pair<'_, Rule>, next: Option<Token>) -> (Vec<Field>, Span, bool) {
        let start = self.span(&pair).start as usize;
        let brace = self.bytes(start..start + 1);
        let mut span = brace;
        let (mut fields, mut partial, mut dangling) = (Vec::new(), false, false);
        for part in pair.into_inner() {
            match part.as_rule() {
                Rule::field => {
                    let field = self.field(part);
                    span = span.to(field.span);
                    fields.push(field);
                    dangling = false;
                }
                Rule::block_end => span = brace.to(self.span(&part)),
                Rule::unclosed => {
                    let diagnostic = self.unclosed(brace, next);
                    self.fault(diagnostic);
                    partial = true;
                }
                _ => {
                    let bad = self.span(&part);
                    span = span.to(bad);
                    partial = true;
                    // Lines after a bracket that was never closed are part of the same fault.
                    let known = dangling && self.assigned(bad).is_none();
                    if !(known || self.is_full()) {
                        let diagnostic = self.explain_field(bad);
                        self.fault(diagnostic);
                        dangling = self.has_open_bracket(bad);
                    }
                    fields.extend(self.assigned(bad));
                }
            }
        }
        (fields, span, partial)
    }

    /// The field that a bad piece was meant to set.
    fn assigned(&self, bad: Span) -> Option<Field> {
        let tokens = self.tokens_in(bad);
        let equals = tokens.iter().position(|t| t.kind == Kind::Equals)?;
        let words = tokens.get(..equals)?;
        let mut segments = Vec::new();
        for (i, &token) in words.iter().enumerate() {
            match token.kind {
                Kind::Word if i % 2 == 0 => {
                    let text = token.text(self.text).to_owned();
                    segments.push(Ident { text, span: self.token_span(token) });
                }
                Kind::Dot if i % 2 == 1 => {}
                _ => return None,
            }
        }
        let span = segments.first()?.span.to(segments.last()?.span);
        let value = Expr { kind: ExprKind::Error, span: bad };
        Some(Field { path: Path { segments, span }, value, span: bad })
    }
}

/// Takes an optional `pub` and the word after it.
fn public<'t>(parts: &mut Pairs<'t, Rule>) -> (bool, Pair<'t, Rule>) {
    let first = next(parts);
    if first.as_rule() == Rule::kw_pub { (true, next(parts)) } else { (false, first) }
}

fn binding_kind(keyword: &str, binding: Binding) -> ItemKind {
    match keyword {
        "asset" => ItemKind::Asset(binding),
        "texture" => ItemKind::Texture(binding),
        _ => ItemKind::Let(binding),
    }
}

/// The complaint about a word that starts no declaration.
pub(super) fn unknown_word(word: &str, span: Span, near: &[&str]) -> Diagnostic {
    let message = format!("unknown declaration `{word}`");
    let diagnostic = Diagnostic::error(Code("E0104"), message);
    match near {
        [] => {
            let words: Vec<&str> = start_words().filter(|&word| word != "pub").collect();
            diagnostic
                .at(span, "unknown word")
                .with_help(format!("a declaration starts with one of: {}", words.join(", ")))
        }
        [only] => diagnostic.at(span, format!("did you mean `{only}`?")).with_fix(Fix::sure(
            format!("write `{only}`"),
            span,
            *only,
        )),
        several => {
            let quoted: Vec<String> = several.iter().map(|word| format!("`{word}`")).collect();
            diagnostic.at(span, format!("did you mean {}?", quoted.join(" or ")))
        }
    }
}

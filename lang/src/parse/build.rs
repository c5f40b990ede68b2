//! Pairs of the grammar become nodes of the tree.
//!
//! Spans are joined from those of the parts, because a rule of pest may include blanks at its end.

use pest::iterators::{Pair, Pairs};

use super::{Reader, Rule};
use crate::diagnostic::{Code, Diagnostic};
use crate::scene::Axis;
use crate::source::{Span, byte_offset};
use crate::syntax::{
    Arg, Base, BinaryOp, Binding, CompareOp, Edit, Entry, Expr, ExprKind, Field, Ident, Import,
    ImportNames, Index, Number, OfFile, Param, Path, Text, Unit,
};

/// The next part of a rule that always has one.
pub(super) fn next<'t>(pairs: &mut Pairs<'t, Rule>) -> Pair<'t, Rule> {
    pairs.next().expect("the grammar's rule has another part here")
}

impl Reader<'_> {
    pub(super) fn span(&self, pair: &Pair<'_, Rule>) -> Span {
        let span = pair.as_span();
        self.bytes(self.base + span.start()..self.base + span.end())
    }

    pub(super) fn bytes(&self, range: std::ops::Range<usize>) -> Span {
        Span { file: self.file, start: byte_offset(range.start), end: byte_offset(range.end) }
    }

    pub(super) fn ident(&self, pair: &Pair<'_, Rule>) -> Ident {
        Ident { text: pair.as_str().to_owned(), span: self.span(pair) }
    }

    pub(super) fn path(&self, pair: Pair<'_, Rule>) -> Path {
        let span = self.span(&pair);
        Path { segments: pair.into_inner().map(|p| self.ident(&p)).collect(), span }
    }

    pub(super) fn string(&self, pair: &Pair<'_, Rule>) -> Text {
        Text { text: pair.as_str().trim_matches('"').to_owned(), span: self.span(pair) }
    }

    fn unit(&self, pair: &Pair<'_, Rule>) -> Unit {
        Unit { text: pair.as_str().to_owned(), span: self.span(pair) }
    }

    pub(super) fn import(&self, pair: Pair<'_, Rule>) -> (Import, Span) {
        let mut parts = pair.into_inner();
        let keyword = self.span(&next(&mut parts));
        let path = self.string(&next(&mut parts));
        let mut end = path.span;
        let names = match parts.next() {
            None => ImportNames::All,
            Some(names) if names.as_rule() == Rule::names => {
                end = self.span(&names);
                ImportNames::Only(names.into_inner().map(|p| self.ident(&p)).collect())
            }
            Some(_) => {
                let name = self.ident(&next(&mut parts));
                end = name.span;
                ImportNames::As(name)
            }
        };
        (Import { path, names }, keyword.to(end))
    }

    pub(super) fn param(&mut self, pair: Pair<'_, Rule>) -> (Param, Span) {
        let mut parts = pair.into_inner();
        let keyword = self.span(&next(&mut parts));
        let name = self.ident(&next(&mut parts));
        let ty = self.ident(&next(&mut parts));
        let value = self.expr(next(&mut parts));
        let range = parts.nth(1).map(|p| self.expr(p));
        let end = range.as_ref().map_or(value.span, |r| r.span);
        (Param { name, ty, value, range }, keyword.to(end))
    }

    /// `let`, `asset`, `texture` after an optional `pub`: the keyword decides later.
    pub(super) fn binding(&mut self, mut parts: Pairs<'_, Rule>) -> Binding {
        let name = self.ident(&next(&mut parts));
        Binding { name, value: self.expr(next(&mut parts)) }
    }

    pub(super) fn index(&mut self, pair: Pair<'_, Rule>) -> Index {
        let span = self.span(&pair);
        let mut parts = pair.into_inner();
        let var = self.ident(&next(&mut parts));
        let range = self.expr(parts.nth(1).expect("the grammar has a range after `in`"));
        let end = self.span(&next(&mut parts));
        Index { var, range, span: span.to(end) }
    }

    pub(super) fn base(&self, pair: Pair<'_, Rule>) -> Base {
        let like = pair.as_rule() == Rule::like_base;
        let mut parts = pair.into_inner();
        let path = parts.find(|part| part.as_rule() == Rule::path);
        let path = self.path(path.expect("the grammar has a path in a base"));
        match parts.next() {
            Some(of_file) => Base::OfFile(self.of_file(path, of_file)),
            None if like => Base::Like(path),
            None => Base::Type(path),
        }
    }

    fn of_file(&self, path: Path, pair: Pair<'_, Rule>) -> OfFile {
        let mut parts = pair.into_inner();
        let name = self.string(&next(&mut parts));
        let span = path.span.to(self.span(&next(&mut parts)));
        OfFile { path, name, span }
    }

    pub(super) fn field(&mut self, pair: Pair<'_, Rule>) -> Field {
        let mut parts = pair.into_inner();
        let path = self.path(next(&mut parts));
        let value = self.expr(next(&mut parts));
        let span = path.span.to(value.span);
        Field { path, value, span }
    }

    pub(super) fn expr(&mut self, pair: Pair<'_, Rule>) -> Expr {
        match pair.as_rule() {
            Rule::expr => self.expr(next(&mut pair.into_inner())),
            Rule::cond => self.cond(pair),
            Rule::range => self.range(pair),
            Rule::cmp => self.compare(pair),
            Rule::sum | Rule::prod => self.chain(pair),
            Rule::unary => self.unary(pair),
            Rule::postfix => self.postfix(pair),
            Rule::group => self.group(pair),
            Rule::list => self.list(pair),
            Rule::call => self.call(pair),
            _ => self.leaf(pair),
        }
    }

    fn cond(&mut self, pair: Pair<'_, Rule>) -> Expr {
        let start = self.span(&pair);
        let mut parts = pair.into_inner();
        let mut part = || Box::new(self.expr(parts.nth(1).expect("a keyword, then an expression")));
        let (condition, then, otherwise) = (part(), part(), part());
        let span = start.to(otherwise.span);
        let span = Span { end: otherwise.span.end, ..span };
        Expr { kind: ExprKind::If { condition, then, otherwise }, span }
    }

    fn range(&mut self, pair: Pair<'_, Rule>) -> Expr {
        let mut parts = pair.into_inner();
        let start = self.expr(next(&mut parts));
        let Some(end) = parts.next() else { return start };
        let end = self.expr(end);
        let span = start.span.to(end.span);
        Expr { kind: ExprKind::Range { start: Box::new(start), end: Box::new(end) }, span }
    }

    fn compare(&mut self, pair: Pair<'_, Rule>) -> Expr {
        let mut parts = pair.into_inner();
        let left = self.expr(next(&mut parts));
        let Some(operator) = parts.next() else { return left };
        let right = self.expr(next(&mut parts));
        let op = match operator.as_str() {
            "<" => CompareOp::Less,
            "<=" => CompareOp::LessEqual,
            ">" => CompareOp::Greater,
            ">=" => CompareOp::GreaterEqual,
            "==" => CompareOp::Equal,
            _ => CompareOp::NotEqual,
        };
        let (span, op_span) = (left.span.to(right.span), self.span(&operator));
        let (left, right) = (Box::new(left), Box::new(right));
        Expr { kind: ExprKind::Compare { op, op_span, left, right }, span }
    }

    /// `a + b - c`, `a * b / c`: to the left.
    fn chain(&mut self, pair: Pair<'_, Rule>) -> Expr {
        let mut parts = pair.into_inner();
        let mut left = self.expr(next(&mut parts));
        while let Some(operator) = parts.next() {
            let right = self.expr(next(&mut parts));
            let op = match operator.as_str() {
                "+" => BinaryOp::Add,
                "-" => BinaryOp::Sub,
                "*" => BinaryOp::Mul,
                _ => BinaryOp::Div,
            };
            let (span, op_span) = (left.span.to(right.span), self.span(&operator));
            let (l, right) = (Box::new(left), Box::new(right));
            left = Expr { kind: ExprKind::Binary { op, op_span, left: l, right }, span };
        }
        left
    }

    fn unary(&mut self, pair: Pair<'_, Rule>) -> Expr {
        let mut parts = pair.into_inner();
        let first = next(&mut parts);
        if first.as_rule() != Rule::neg {
            return self.expr(first);
        }
        let value = self.expr(next(&mut parts));
        let span = self.span(&first).to(value.span);
        Expr { kind: ExprKind::Negate(Box::new(value)), span }
    }

    fn postfix(&mut self, pair: Pair<'_, Rule>) -> Expr {
        let mut parts = pair.into_inner();
        let mut base = self.expr(next(&mut parts));
        while let Some(part) = parts.next() {
            if part.as_rule() == Rule::edits {
                let span = base.span.to(self.span(&part));
                let edits = part.into_inner().map(|edit| self.edit(edit)).collect();
                let base = Box::new(base);
                return Expr { kind: ExprKind::Edited { base, edits }, span };
            }
            let name = self.ident(&next(&mut parts));
            let span = base.span.to(name.span);
            let kind = match base.kind {
                // Blanks around the dot make no difference.
                ExprKind::Path(mut path) => {
                    path.segments.push(name);
                    path.span = span;
                    ExprKind::Path(path)
                }
                _ => ExprKind::Member { base: Box::new(base), name },
            };
            base = Expr { kind, span };
        }
        base
    }

    fn edit(&mut self, pair: Pair<'_, Rule>) -> Edit {
        let mut parts = pair.into_inner();
        let kind = self.ident(&next(&mut parts));
        let pattern = self.string(&next(&mut parts));
        Edit { kind, pattern, value: self.expr(next(&mut parts)) }
    }

    fn group(&mut self, pair: Pair<'_, Rule>) -> Expr {
        let span = self.span(&pair);
        let mut parts = pair.into_inner();
        let first = self.expr(next(&mut next(&mut parts).into_inner()));
        let rest = next(&mut parts);
        if rest.as_rule() == Rule::paren_rest {
            return Expr { kind: first.kind, span };
        }
        let mut items = vec![first];
        items.extend(rest.into_inner().map(|p| self.expr(p)));
        let unit = parts.next().map(|p| self.unit(&p));
        Expr { kind: ExprKind::Tuple { items, unit }, span }
    }

    fn list(&mut self, pair: Pair<'_, Rule>) -> Expr {
        let span = self.span(&pair);
        let mut entries = Vec::new();
        for entry in pair.into_inner() {
            let mut parts = entry.into_inner();
            let first = self.expr(next(&mut parts));
            entries.push(match parts.next() {
                None => Entry { key: None, value: first },
                Some(value) => Entry { key: Some(Box::new(first)), value: self.expr(value) },
            });
        }
        Expr { kind: ExprKind::List(entries), span }
    }

    fn call(&mut self, pair: Pair<'_, Rule>) -> Expr {
        let span = self.span(&pair);
        let mut parts = pair.into_inner();
        let path = self.path(next(&mut parts));
        let mut args = Vec::new();
        for arg in parts {
            let mut parts = arg.into_inner();
            let first = next(&mut parts);
            args.push(match parts.next() {
                None => Arg { name: None, value: self.expr(first) },
                Some(value) => Arg { name: Some(self.ident(&first)), value: self.expr(value) },
            });
        }
        Expr { kind: ExprKind::Call { path, args }, span }
    }

    fn leaf(&mut self, pair: Pair<'_, Rule>) -> Expr {
        let span = self.span(&pair);
        let text = pair.as_str();
        let kind = match pair.as_rule() {
            Rule::quantity => self.quantity(pair),
            Rule::color_hex => ExprKind::Hex([1, 3, 5].map(|i| {
                let digits = text.get(i..i + 2).unwrap_or("");
                u8::from_str_radix(digits, 16).expect("the grammar allows hex digits only")
            })),
            Rule::string => ExprKind::Text(self.string(&pair).text),
            Rule::axis => ExprKind::Axis(axis(text)),
            Rule::path => ExprKind::Path(self.path(pair)),
            _ => match text {
                "true" => ExprKind::Bool(true),
                "false" => ExprKind::Bool(false),
                "default" => ExprKind::Default,
                _ => ExprKind::None,
            },
        };
        Expr { kind, span }
    }

    fn quantity(&mut self, pair: Pair<'_, Rule>) -> ExprKind {
        let mut parts = pair.into_inner();
        let number = next(&mut parts);
        let text = number.as_str().to_owned();
        let unit = parts.next().map(|p| self.unit(&p));
        let value: f64 = text.replace('_', "").parse().unwrap_or(f64::INFINITY);
        if value.is_finite() {
            return ExprKind::Number(Number { value, text, unit });
        }
        let diagnostic = Diagnostic::error(Code("E0108"), "this number is too large")
            .at(self.span(&number), "beyond 1.8e308");
        self.fault(diagnostic);
        ExprKind::Error
    }
}

fn axis(text: &str) -> Axis {
    match text {
        "+x" => Axis::PlusX,
        "-x" => Axis::MinusX,
        "+y" => Axis::PlusY,
        "-y" => Axis::MinusY,
        "+z" => Axis::PlusZ,
        _ => Axis::MinusZ,
    }
}

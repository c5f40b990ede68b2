//! Trees without their places, so that two texts can be compared for what they say.

use super::{
    Arg, Base, Decl, Edit, Entry, Expr, ExprKind, Field, File, Ident, ImportNames, Item, ItemKind,
    Path, Text, Unit,
};
use crate::source::Span;

const NOWHERE: Span = Span { file: crate::source::FileId(0), start: 0, end: 0 };

impl File {
    /// The tree with every span set to the start of file 0, and `.5` spelt `0.5`.
    #[must_use]
    pub fn without_places(mut self) -> File {
        if let Some(edition) = &mut self.edition {
            edition.span = NOWHERE;
        }
        self.items.iter_mut().for_each(item);
        self
    }
}

fn item(item: &mut Item) {
    item.span = NOWHERE;
    match &mut item.kind {
        ItemKind::Import(import) => {
            text(&mut import.path);
            match &mut import.names {
                ImportNames::All => {}
                ImportNames::As(name) => ident(name),
                ImportNames::Only(names) => names.iter_mut().for_each(ident),
            }
        }
        ItemKind::Param(param) => {
            ident(&mut param.name);
            ident(&mut param.ty);
            expr(&mut param.value);
            param.range.iter_mut().for_each(expr);
        }
        ItemKind::Let(binding) | ItemKind::Asset(binding) | ItemKind::Texture(binding) => {
            ident(&mut binding.name);
            expr(&mut binding.value);
        }
        ItemKind::Decl(declaration) => decl(declaration),
        ItemKind::Assert(assert) => {
            expr(&mut assert.condition);
            text(&mut assert.message);
        }
        ItemKind::Poisoned(names) => names.iter_mut().for_each(ident),
    }
}

fn decl(decl: &mut Decl) {
    decl.kind_span = NOWHERE;
    decl.block = NOWHERE;
    ident(&mut decl.name);
    if let Some(index) = &mut decl.index {
        index.span = NOWHERE;
        ident(&mut index.var);
        expr(&mut index.range);
    }
    match &mut decl.base {
        Some(Base::Type(base) | Base::Like(base)) => path(base),
        Some(Base::OfFile(base)) => {
            base.span = NOWHERE;
            path(&mut base.path);
            text(&mut base.name);
        }
        Some(Base::Error(span)) => *span = NOWHERE,
        None => {}
    }
    for Field { path: name, value, span } in &mut decl.fields {
        *span = NOWHERE;
        path(name);
        expr(value);
    }
}

fn ident(ident: &mut Ident) {
    ident.span = NOWHERE;
}

fn path(path: &mut Path) {
    path.span = NOWHERE;
    path.segments.iter_mut().for_each(ident);
}

fn text(text: &mut Text) {
    text.span = NOWHERE;
}

fn unit(unit: &mut Option<Unit>) {
    if let Some(unit) = unit {
        unit.span = NOWHERE;
    }
}

fn expr(node: &mut Expr) {
    node.span = NOWHERE;
    match &mut node.kind {
        ExprKind::Number(number) => {
            unit(&mut number.unit);
            if number.text.starts_with('.') {
                number.text.insert(0, '0');
            }
        }
        ExprKind::Tuple { items, unit: of_all } => {
            items.iter_mut().for_each(expr);
            unit(of_all);
        }
        ExprKind::List(entries) => {
            for Entry { key, value } in entries {
                if let Some(key) = key {
                    expr(key);
                }
                expr(value);
            }
        }
        ExprKind::Call { path: callee, args } => {
            path(callee);
            for Arg { name, value } in args {
                name.iter_mut().for_each(ident);
                expr(value);
            }
        }
        ExprKind::Path(name) => path(name),
        ExprKind::Member { base, name } => {
            expr(base);
            ident(name);
        }
        ExprKind::Edited { base, edits } => {
            expr(base);
            for Edit { kind, pattern, value } in edits {
                ident(kind);
                text(pattern);
                expr(value);
            }
        }
        ExprKind::Negate(value) => expr(value),
        ExprKind::Binary { op_span, left, right, .. }
        | ExprKind::Compare { op_span, left, right, .. } => {
            *op_span = NOWHERE;
            expr(left);
            expr(right);
        }
        ExprKind::If { condition, then, otherwise } => {
            expr(condition);
            expr(then);
            expr(otherwise);
        }
        ExprKind::Range { start, end } => {
            expr(start);
            expr(end);
        }
        ExprKind::Axis(_)
        | ExprKind::Hex(_)
        | ExprKind::Text(_)
        | ExprKind::Bool(_)
        | ExprKind::Default
        | ExprKind::None
        | ExprKind::Error => {}
    }
}

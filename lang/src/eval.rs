//! Expressions become values: numbers in SI with dimensions, colours, names of declarations.
//!
//! The language is total: `let` values are computed in the order of their references, cycles are
//! errors, and no value that is not finite leaves this module. A fault becomes a diagnostic and
//! `Value::Poison`. What a field wants is decided in `check`.

use std::collections::{BTreeMap, BTreeSet};
use std::rc::Rc;

use crate::check::file::TextureInfo;
use crate::check::given::OwnFields;
use crate::diagnostic::{Code, Diagnostic, MAX_FAULTS, Severity};
use crate::resolve::{ItemId, Model, Program};
use crate::source::{SourceSet, Span};
use crate::syntax::{Expr, ExprKind};

mod advice;
mod binding;
mod call;
pub(crate) mod color;
mod edit;
pub(crate) mod function;
mod literal;
mod operator;
mod path;
pub(crate) mod textured;
pub(crate) mod value;

pub(crate) use advice::with_unit_fix;
pub(crate) use binding::param_words;
use value::Value;

/// Steps that all expressions of a scene may take together, some seconds' worth.
const MAX_WORK: usize = 100_000_000;

/// Nested evaluations: one expression (at most `syntax::MAX_HEIGHT`) and the fields it refers to.
const MAX_NESTING: u32 = 400;

/// Computes values and collects what is wrong with them.
pub(crate) struct Evaluator<'p> {
    pub(crate) sources: &'p SourceSet,
    pub(crate) program: &'p Program,
    pub(crate) models: &'p BTreeMap<ItemId, Model>,
    pub(crate) diagnostics: Vec<Diagnostic>,
    /// Number of diagnostics beyond which no more are kept.
    max_kept: usize,
    n_dropped: usize,
    has_errors: bool,
    /// Items that something refers to.
    pub(crate) used: BTreeSet<ItemId>,
    /// Every texture whose declaration is sound.
    pub(crate) textures: BTreeMap<ItemId, TextureInfo>,
    /// Values from outside, by the name of a parameter of the root file.
    pub(crate) defines: BTreeMap<String, Define>,
    /// Values of `let` and `param`; `None` while being computed.
    bindings: BTreeMap<ItemId, Option<Value>>,
    /// Values of fields; `None` while being computed.
    pub(crate) fields: BTreeMap<(ItemId, &'static str), Option<Value>>,
    /// In a branch that is not taken: names and dimensions are checked, numbers are not.
    speculative: u32,
    /// What each declaration sets itself.
    pub(crate) own_fields: BTreeMap<ItemId, Rc<OwnFields<'p>>>,
    nesting: u32,
    /// Steps taken so far.
    work: usize,
}

/// A value given with `-D name=value`.
#[derive(Debug)]
pub(crate) struct Define {
    /// The expression; its spans point into a file of its own.
    pub(crate) value: Expr,
    /// The name in that file.
    pub(crate) name: Span,
}

/// Where an expression stands.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Scope<'s> {
    /// Module whose names it sees.
    pub(crate) module: u32,
    /// The variable of an indexed declaration.
    pub(crate) local: Option<(&'s str, f64)>,
}

impl<'p> Evaluator<'p> {
    pub(crate) fn new(
        sources: &'p SourceSet,
        program: &'p Program,
        models: &'p BTreeMap<ItemId, Model>,
        diagnostics: Vec<Diagnostic>,
    ) -> Self {
        Self {
            sources,
            program,
            models,
            max_kept: diagnostics.len() + MAX_FAULTS,
            n_dropped: 0,
            has_errors: diagnostics.iter().any(Diagnostic::is_error),
            diagnostics,
            own_fields: BTreeMap::new(),
            used: BTreeSet::new(),
            textures: BTreeMap::new(),
            defines: BTreeMap::new(),
            bindings: BTreeMap::new(),
            fields: BTreeMap::new(),
            speculative: 0,
            nesting: 0,
            work: 0,
        }
    }

    /// Reports a fault of names, types or dimensions.
    pub(crate) fn fault(&mut self, error: Diagnostic) -> Value {
        self.tell(error);
        Value::Poison
    }

    /// Keeps a diagnostic, unless there are too many.
    pub(crate) fn tell(&mut self, diagnostic: Diagnostic) {
        let is_error = diagnostic.is_error();
        if self.diagnostics.len() < self.max_kept {
            self.diagnostics.push(diagnostic);
        } else {
            self.n_dropped += 1;
        }
        self.has_errors |= is_error;
    }

    /// All that is wrong, with a word about what was not kept.
    pub(crate) fn into_diagnostics(mut self) -> Vec<Diagnostic> {
        if let Some(root) = self.program.modules.first().filter(|_| self.n_dropped > 0) {
            let text = format!("more than {MAX_FAULTS} faults; {} are not told", self.n_dropped);
            let mut last = Diagnostic::error(Code("E0112"), text)
                .at(Span { file: root.file, start: 0, end: 0 }, "in this scene");
            if !self.has_errors {
                last.severity = Severity::Warning;
            }
            self.diagnostics.push(last);
        }
        self.diagnostics
    }

    /// Reports a fault of a number, unless its branch is not taken.
    pub(crate) fn number_fault(&mut self, error: Diagnostic) -> Value {
        if self.speculative == 0 {
            self.tell(error);
        }
        Value::Poison
    }

    /// Was anything wrong?
    pub(crate) fn has_errors(&self) -> bool {
        self.has_errors
    }

    /// In a branch that is not taken.
    pub(crate) fn is_speculative(&self) -> bool {
        self.speculative > 0
    }

    /// Runs something as if no branch were open.
    pub(crate) fn surely<T>(&mut self, run: impl FnOnce(&mut Self) -> T) -> T {
        let speculative = std::mem::take(&mut self.speculative);
        let result = run(self);
        self.speculative = speculative;
        result
    }

    /// Runs something as in a branch that is not taken.
    pub(crate) fn unsurely<T>(&mut self, run: impl FnOnce(&mut Self) -> T) -> T {
        self.speculative += 1;
        let result = run(self);
        self.speculative -= 1;
        result
    }

    /// Counts steps; reports once that there are too many.
    pub(crate) fn spend(&mut self, steps: usize, span: Span) -> bool {
        let before = self.work;
        self.work = before.saturating_add(steps);
        if before <= MAX_WORK && self.work > MAX_WORK {
            let text = "this scene takes too much work to compute";
            self.fault(
                Diagnostic::error(Code("E0801"), text).at(span, "the limit is reached here"),
            );
        }
        self.work <= MAX_WORK
    }

    /// Evaluates an expression.
    pub(crate) fn eval(&mut self, expr: &Expr, scope: Scope<'_>) -> Value {
        if !self.spend(1, expr.span) {
            return Value::Poison;
        }
        let value = self.nested(expr.span, |ev| ev.eval_kind(expr, scope));
        self.sound(value, expr.span)
    }

    /// Runs one level of what calls itself: an expression, or a field that another refers to.
    pub(crate) fn nested(&mut self, at: Span, run: impl FnOnce(&mut Self) -> Value) -> Value {
        if self.nesting >= MAX_NESTING {
            let text = "values refer to each other too deeply";
            let error = Diagnostic::error(Code("E0212"), text).at(at, "here");
            let limit = format!("at most {MAX_NESTING} expressions and fields inside each other");
            return self.fault(error.with_note(limit));
        }
        self.nesting += 1;
        let value = run(self);
        self.nesting -= 1;
        value
    }

    fn eval_kind(&mut self, expr: &Expr, scope: Scope<'_>) -> Value {
        match &expr.kind {
            ExprKind::Number(number) => self.number(number),
            ExprKind::Tuple { items, unit } => self.tuple(items, unit.as_ref(), expr.span, scope),
            ExprKind::List(entries) => self.list(entries, scope),
            ExprKind::Call { path, args } => self.call(path, args, expr.span, scope),
            ExprKind::Path(path) => self.path(path, scope, None),
            ExprKind::Member { base, name } => {
                let value = self.eval(base, scope);
                self.member(&value, name)
            }
            ExprKind::Edited { base, edits } => self.edited(base, edits, scope),
            ExprKind::Negate(inner) => self.negate(inner, scope),
            ExprKind::Binary { op, op_span, left, right } => {
                self.binary((*op, *op_span), left, right, scope)
            }
            ExprKind::Compare { op, op_span, left, right } => {
                self.compare((*op, *op_span), left, right, scope)
            }
            ExprKind::If { condition, then, otherwise } => {
                let taken = self.condition(condition, scope);
                self.branches(taken, [then, otherwise], |ev, branch| ev.eval(branch, scope))
            }
            ExprKind::Range { start, end } => self.range(start, end, scope),
            ExprKind::Axis(axis) => Value::Axis(*axis),
            ExprKind::Hex(bytes) => Value::Hex(*bytes),
            ExprKind::Text(text) => Value::Text(text.as_str().into()),
            ExprKind::Bool(value) => Value::Bool(*value),
            ExprKind::Default => Value::Default,
            ExprKind::None => Value::None,
            ExprKind::Error => Value::Poison,
        }
    }

    /// Refuses numbers that are not finite or too large to be drawn.
    fn sound(&mut self, value: Value, span: Span) -> Value {
        if value.is_sound() {
            return value;
        }
        let text = "the value is infinite or not a number";
        let error = Diagnostic::error(Code("E0402"), text)
            .at(span, "here")
            .with_note(format!("numbers go up to {:e} in SI units", crate::schema::MAX_MAGNITUDE));
        self.number_fault(error)
    }

    /// Whether a condition holds; `None` if it cannot be told.
    pub(crate) fn condition(&mut self, expr: &Expr, scope: Scope<'_>) -> Option<bool> {
        match self.eval(expr, scope) {
            Value::Bool(value) => Some(value),
            Value::Poison => None,
            other => {
                let text = format!("a condition is `true` or `false`, not {}", other.described());
                self.fault(Diagnostic::error(Code("E0305"), text).at(expr.span, other.described()));
                None
            }
        }
    }

    /// Evaluates both branches of an `if` and returns the one that is taken.
    pub(crate) fn branches(
        &mut self,
        taken: Option<bool>,
        [then, otherwise]: [&Expr; 2],
        mut eval: impl FnMut(&mut Self, &Expr) -> Value,
    ) -> Value {
        let mut run = |ev: &mut Self, branch: &Expr, is_taken: bool| {
            if is_taken { eval(ev, branch) } else { ev.unsurely(|ev| eval(ev, branch)) }
        };
        let first = run(self, then, taken == Some(true));
        let second = run(self, otherwise, taken == Some(false));
        if let (Some(a), Some(b)) = (first.dim(), second.dim())
            && a != b
        {
            let text = format!("one branch is {a}, the other {b}");
            let error = Diagnostic::error(Code("E0302"), text)
                .at(otherwise.span, b.to_string())
                .because(then.span, a.to_string());
            return self.fault(error);
        }
        match taken {
            Some(true) => first,
            Some(false) => second,
            None => Value::Poison,
        }
    }

    fn range(&mut self, start: &Expr, end: &Expr, scope: Scope<'_>) -> Value {
        let (a, b) = (self.eval(start, scope), self.eval(end, scope));
        match (&a, &b) {
            (Value::Poison, _) | (_, Value::Poison) => Value::Poison,
            (Value::Number(low, dim), Value::Number(high, other)) if dim == other => {
                Value::Range(*low, *high, *dim)
            }
            (Value::Number(_, dim), Value::Number(_, other)) => {
                let text = format!("an interval cannot go from {dim} to {other}");
                let error = Diagnostic::error(Code("E0302"), text)
                    .at(end.span, other.to_string())
                    .because(start.span, dim.to_string());
                self.fault(error)
            }
            _ => {
                let (wrong, expr) =
                    if matches!(a, Value::Number(..)) { (&b, end) } else { (&a, start) };
                let text = format!("an interval goes between numbers, not {}", wrong.described());
                self.fault(Diagnostic::error(Code("E0305"), text).at(expr.span, wrong.described()))
            }
        }
    }
}

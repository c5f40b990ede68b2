//! Expressions become values: numbers in SI with dimensions, colours, names of declarations.
//!
//! The language is total: `let` values are computed in the order of their references, cycles are
//! errors, and no value that is not finite leaves this module. A fault becomes a diagnostic and
//! `Value::Poison`. What a field wants is decided in `check`.

use std::collections::{BTreeMap, BTreeSet};

use crate::check::texture::TextureInfo;
use crate::diagnostic::{Code, Diagnostic, Fix};
use crate::resolve::like::Model;
use crate::resolve::{ItemId, Program};
use crate::source::{SourceSet, Span};
use crate::suggest::suggest;
use crate::syntax::{self, Expr, ExprKind, ItemKind};
use crate::units::{self, Dim};

mod binding;
mod call;
pub(crate) mod color;
pub(crate) mod function;
mod operator;
mod path;
pub(crate) mod value;

pub(crate) use binding::param_words;
use value::Value;

/// Nested evaluations: one expression (at most `syntax::MAX_HEIGHT`) and the fields it refers to.
const MAX_NESTING: u32 = 400;

/// Computes values and collects what is wrong with them.
pub(crate) struct Evaluator<'p> {
    pub(crate) sources: &'p SourceSet,
    pub(crate) program: &'p Program,
    pub(crate) models: &'p BTreeMap<ItemId, Model>,
    pub(crate) diagnostics: Vec<Diagnostic>,
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
    nesting: u32,
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
    ) -> Self {
        Self {
            sources,
            program,
            models,
            diagnostics: Vec::new(),
            used: BTreeSet::new(),
            textures: BTreeMap::new(),
            defines: BTreeMap::new(),
            bindings: BTreeMap::new(),
            fields: BTreeMap::new(),
            speculative: 0,
            nesting: 0,
        }
    }

    /// Reports a fault of names, types or dimensions.
    pub(crate) fn fault(&mut self, error: Diagnostic) -> Value {
        self.diagnostics.push(error);
        Value::Poison
    }

    /// Reports a fault of a number, unless its branch is not taken.
    pub(crate) fn number_fault(&mut self, error: Diagnostic) -> Value {
        if self.speculative == 0 {
            self.diagnostics.push(error);
        }
        Value::Poison
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

    /// Evaluates an expression.
    pub(crate) fn eval(&mut self, expr: &Expr, scope: Scope<'_>) -> Value {
        if self.nesting >= MAX_NESTING {
            let text = "values refer to each other too deeply";
            return self.fault(Diagnostic::error(Code("E0212"), text).at(expr.span, "here"));
        }
        self.nesting += 1;
        let value = self.eval_kind(expr, scope);
        self.nesting -= 1;
        self.sound(value, expr.span)
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
                self.member(value, name)
            }
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
            ExprKind::Text(text) => Value::Text(text.clone()),
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
        let text = "this number is too large or not a number at all";
        let error = Diagnostic::error(Code("E0402"), text)
            .at(span, "here")
            .with_note(format!("numbers go up to {:e} in SI units", crate::schema::MAX_MAGNITUDE));
        self.number_fault(error)
    }

    fn number(&mut self, number: &syntax::Number) -> Value {
        match &number.unit {
            None => Value::plain(number.value),
            Some(unit) => match self.unit(unit) {
                Some((dim, factor)) => Value::Number(number.value * factor, dim),
                None => Value::Poison,
            },
        }
    }

    /// Reads a unit, or reports it.
    fn unit(&mut self, unit: &syntax::Unit) -> Option<(Dim, f64)> {
        let atom = match units::parse(&unit.text) {
            Ok(known) => return Some(known),
            Err(atom) => atom,
        };
        let error = Diagnostic::error(Code("E0303"), format!("there is no unit `{atom}`"));
        let names = &self.program.modules;
        let is_name = |name: &str| names.iter().any(|module| module.names.contains_key(name));
        let close = suggest(atom, units::UNITS.iter().map(|unit| unit.symbol));
        let error = if let Some(ours) = units::other_spelling(atom) {
            let text = unit.text.replace(atom, ours);
            let fix = Fix::sure(format!("write `{ours}`"), unit.span, text);
            error.at(unit.span, format!("did you mean `{ours}`?")).with_fix(fix)
        } else if let Some(metric) = units::not_metric(atom) {
            error.at(unit.span, "not a unit here").with_help(format!("1 {atom} is {metric}"))
        } else if unit.text.contains('/') && is_name(atom) {
            let text = format!(" {}", unit.text.replace('/', " / "));
            let text = if unit.text.starts_with('/') { text } else { text.trim_start().to_owned() };
            error.at(unit.span, format!("`{atom}` is a name, not a unit")).with_fix(Fix::sure(
                "put spaces around `/`",
                unit.span,
                text,
            ))
        } else if let [only] = close.as_slice() {
            error.at(unit.span, format!("did you mean `{only}`?")).with_fix(Fix::sure(
                format!("write `{only}`"),
                unit.span,
                unit.text.replace(atom, only),
            ))
        } else {
            let all: Vec<&str> = units::UNITS.iter().map(|unit| unit.symbol).collect();
            error.at(unit.span, "not known").with_note(format!("the units are {}", all.join(" ")))
        };
        self.fault(error);
        None
    }

    fn tuple(
        &mut self,
        items: &[Expr],
        unit: Option<&syntax::Unit>,
        span: Span,
        scope: Scope<'_>,
    ) -> Value {
        let values: Vec<Value> = items.iter().map(|item| self.eval(item, scope)).collect();
        let unit = match unit.map(|unit| self.unit(unit)) {
            Some(None) => return Value::Poison,
            Some(Some(known)) => Some(known),
            None => None,
        };
        if items.len() > 4 {
            let text = format!("a tuple has at most 4 entries, found {}", items.len());
            return self.fault(Diagnostic::error(Code("E0305"), text).at(span, "too long"));
        }
        let mut numbers = Vec::new();
        let mut common = None;
        for (value, item) in values.iter().zip(items) {
            match value {
                Value::Poison => return Value::Poison,
                Value::Number(number, dim) => numbers.push((*number, *dim)),
                other => {
                    let text = format!("a tuple holds numbers, not {}", other.described());
                    let error = Diagnostic::error(Code("E0305"), text);
                    let error =
                        operator::axis_advice(error.at(item.span, other.described()), other);
                    return self.fault(error);
                }
            }
            common = common.or(numbers.last().map(|(_, dim)| *dim).filter(|dim| !dim.is_none()));
        }
        match unit {
            Some((dim, factor)) => self.with_outer_unit(&numbers, items, (dim, factor)),
            None => self.with_inner_units(&numbers, items, common.unwrap_or(Dim::NONE)),
        }
    }

    /// `(0, 1, 2)m`: the entries must be plain.
    fn with_outer_unit(
        &mut self,
        numbers: &[(f64, Dim)],
        items: &[Expr],
        (dim, factor): (Dim, f64),
    ) -> Value {
        for ((_, own), item) in numbers.iter().zip(items) {
            if !own.is_none() {
                let text = "this tuple has a unit, and so has its entry";
                let error = Diagnostic::error(Code("E0302"), text)
                    .at(item.span, own.to_string())
                    .with_help("leave out one of the two units");
                return self.fault(error);
            }
        }
        Value::Vector(numbers.iter().map(|(value, _)| value * factor).collect(), dim)
    }

    /// `(0m, 1m, 2m)`: the entries must agree.
    fn with_inner_units(&mut self, numbers: &[(f64, Dim)], items: &[Expr], dim: Dim) -> Value {
        let unit = items.iter().find_map(literal_unit).unwrap_or_default();
        let mut agree = true;
        for ((_, own), item) in numbers.iter().zip(items) {
            if *own == dim {
                continue;
            }
            agree = false;
            if own.is_none() {
                let text = format!("this entry needs {dim} like the others, found {own}");
                let error = Diagnostic::error(Code("E0301"), text).at(item.span, "no unit");
                self.fault(with_unit_fix(error, item, dim, unit));
            } else {
                let text = format!("a tuple cannot mix {dim} and {own}");
                self.fault(Diagnostic::error(Code("E0302"), text).at(item.span, own.to_string()));
            }
        }
        if !agree {
            return Value::Poison;
        }
        Value::Vector(numbers.iter().map(|(value, _)| *value).collect(), dim)
    }

    fn list(&mut self, entries: &[syntax::Entry], scope: Scope<'_>) -> Value {
        let mut values = Vec::with_capacity(entries.len());
        for entry in entries {
            if let Some(key) = &entry.key {
                let text = "the entries of this list have no keys";
                self.fault(Diagnostic::error(Code("E0305"), text).at(key.span, "not wanted"));
            }
            values.push((self.eval(&entry.value, scope), entry.value.span));
        }
        Value::List(values)
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
            ev.speculative += u32::from(!is_taken);
            let value = eval(ev, branch);
            ev.speculative -= u32::from(!is_taken);
            value
        };
        let first = run(self, then, taken == Some(true));
        let second = run(self, otherwise, taken == Some(false));
        if let (Some(a), Some(b)) = (first.dim(), second.dim()) {
            if a != b {
                let text = format!("one branch is {a}, the other {b}");
                let error = Diagnostic::error(Code("E0302"), text)
                    .at(otherwise.span, b.to_string())
                    .because(then.span, a.to_string());
                return self.fault(error);
            }
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

    /// Labels saying of what dimension the names in an expression are.
    pub(crate) fn explain_names(
        &self,
        mut error: Diagnostic,
        expr: &Expr,
        scope: Scope<'_>,
    ) -> Diagnostic {
        let mut names = Vec::new();
        walk_paths(expr, &mut |path| names.push(path));
        for path in names.into_iter().take(3) {
            let Ok(crate::resolve::Found::Item(id, _)) =
                self.program.find(scope.module, path, None)
            else {
                continue;
            };
            let is_value =
                matches!(self.program.item(id).kind, ItemKind::Param(_) | ItemKind::Let(_));
            let dim = match self.bindings.get(&id) {
                Some(Some(value)) if is_value => value.dim(),
                _ => None,
            };
            let span = self.program.name_span(id);
            if let Some(dim) = dim.filter(|_| error.labels.iter().all(|label| label.span != span)) {
                error = error.because(span, format!("`{}` is {dim}", self.program.name(id)));
            }
        }
        error
    }
}

impl Evaluator<'_> {
    /// Labels saying what the names in an expression are worth.
    pub(crate) fn explain_values(
        &self,
        mut error: Diagnostic,
        expr: &Expr,
        scope: Scope<'_>,
    ) -> Diagnostic {
        let mut names = Vec::new();
        walk_paths(expr, &mut |path| names.push(path));
        for path in names.into_iter().take(4) {
            if let Ok(crate::resolve::Found::Item(id, _)) =
                self.program.find(scope.module, path, None)
                && let Some(value) = self.known_binding(id)
            {
                let text = format!("`{}` is {}", self.program.name(id), value.shown());
                error = error.because(self.program.name_span(id), text);
            }
        }
        error
    }
}

/// Calls `visit` for every path of an expression, calls included.
pub(crate) fn walk_paths<'e>(expr: &'e Expr, visit: &mut dyn FnMut(&'e syntax::Path)) {
    match &expr.kind {
        ExprKind::Path(path) => visit(path),
        ExprKind::Call { path, args } => {
            if path.segments.len() > 1 {
                visit(path);
            }
            args.iter().for_each(|arg| walk_paths(&arg.value, visit));
        }
        ExprKind::Tuple { items, .. } => items.iter().for_each(|item| walk_paths(item, visit)),
        ExprKind::List(entries) => entries.iter().for_each(|e| walk_paths(&e.value, visit)),
        ExprKind::Member { base, .. } => walk_paths(base, visit),
        ExprKind::Negate(inner) => walk_paths(inner, visit),
        ExprKind::Binary { left, right, .. } | ExprKind::Compare { left, right, .. } => {
            walk_paths(left, visit);
            walk_paths(right, visit);
        }
        ExprKind::If { condition, then, otherwise } => {
            [condition, then, otherwise].into_iter().for_each(|e| walk_paths(e, visit));
        }
        ExprKind::Range { start, end } => {
            walk_paths(start, visit);
            walk_paths(end, visit);
        }
        _ => {}
    }
}

/// The unit written on a literal.
fn literal_unit(expr: &Expr) -> Option<&str> {
    match &expr.kind {
        ExprKind::Number(syntax::Number { unit: Some(unit), .. })
        | ExprKind::Tuple { unit: Some(unit), .. } => Some(&unit.text),
        ExprKind::Negate(inner) => literal_unit(inner),
        _ => None,
    }
}

/// Is a number or a tuple written without a unit, so that one can be put behind it?
fn takes_unit(expr: &Expr) -> bool {
    match &expr.kind {
        ExprKind::Number(number) => number.unit.is_none(),
        ExprKind::Tuple { unit, .. } => unit.is_none(),
        ExprKind::Negate(inner) => takes_unit(inner) && inner.span.end == expr.span.end,
        _ => false,
    }
}

/// Proposes a unit of `dim` behind a literal, or a factor behind anything else.
pub(crate) fn with_unit_fix(error: Diagnostic, expr: &Expr, dim: Dim, unit: &str) -> Diagnostic {
    let unit = match unit {
        "" => units::si_symbol(dim).unwrap_or_default(),
        known => known,
    };
    if unit.is_empty() {
        return error;
    }
    let message = "say which unit you mean";
    if takes_unit(expr) {
        error.with_fix(Fix::sure(message, expr.span.after(), unit))
    } else if matches!(expr.kind, ExprKind::Path(_) | ExprKind::Call { .. }) {
        error.with_fix(Fix::guess(message, expr.span.after(), format!(" * 1{unit}")))
    } else {
        error.with_help(format!("multiply it by `1{unit}`"))
    }
}

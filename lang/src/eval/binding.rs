//! `let`, `param` and `-D`: values with a name, computed once each, in the order of their references.

use std::collections::BTreeMap;

use super::advice::{literal_unit, walk_paths, with_unit_fix};
use super::value::Value;
use super::{Evaluator, Scope};
use crate::diagnostic::{Code, Diagnostic};
use crate::resolve::{ItemId, did_you_mean, quoted_list};
use crate::source::Span;
use crate::syntax::{Expr, Ident, ItemKind, Param};
use crate::units::{Dim, PARAM_DIMENSIONS};

/// What a parameter may be.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum ParamType {
    Number(Dim),
    Count,
    Bool,
    Color,
    Text,
}

/// Words for `param name: ...` beside the dimensions.
const PARAM_WORDS: &[(&str, ParamType)] = &[
    ("count", ParamType::Count),
    ("bool", ParamType::Bool),
    ("color", ParamType::Color),
    ("text", ParamType::Text),
];

/// Every word that may stand after `param name:`.
pub(crate) fn param_words() -> Vec<String> {
    let dims = PARAM_DIMENSIONS.iter().map(|(name, _)| *name);
    let words = PARAM_WORDS.iter().map(|(name, _)| *name);
    let mut all: Vec<String> = dims.chain(words).map(str::to_owned).collect();
    all.sort_unstable();
    all.dedup();
    all
}

impl Evaluator<'_> {
    /// Computes every `let` and `param`. Values are computed after those they refer to, without
    /// recursion, so a chain of them may be as long as it likes.
    pub(crate) fn evaluate_bindings(&mut self) {
        self.check_defines();
        // Where on the stack an item is that is open, or `None` once it is done.
        let mut state: BTreeMap<ItemId, Option<usize>> = BTreeMap::new();
        let ids: Vec<ItemId> = self.program.ids().filter(|id| self.is_binding(*id)).collect();
        for root in ids {
            let mut stack = vec![(root, None)];
            while let Some((id, references)) = stack.pop() {
                let mut references: Vec<ItemId> = match references {
                    Some(rest) => rest,
                    None if state.contains_key(&id) => continue,
                    None => {
                        state.insert(id, Some(stack.len()));
                        self.references(id)
                    }
                };
                match references.pop() {
                    None => {
                        state.insert(id, None);
                        self.binding(id, None);
                    }
                    Some(next) => {
                        let open = state.get(&next).copied().flatten();
                        stack.push((id, Some(references)));
                        if let Some(start) = open {
                            self.binding_cycle(next, &stack[start..]);
                        } else {
                            stack.push((next, None));
                        }
                    }
                }
            }
        }
    }

    fn is_binding(&self, id: ItemId) -> bool {
        matches!(self.program.item(id).kind, ItemKind::Let(_) | ItemKind::Param(_))
    }

    /// The bindings that a binding refers to directly.
    fn references(&self, id: ItemId) -> Vec<ItemId> {
        let mut found = Vec::new();
        let mut visit = |path: &_| {
            if let Some(other) = self.program.lookup(id.module, path)
                && self.is_binding(other)
            {
                found.push(other);
            }
        };
        match &self.program.item(id).kind {
            ItemKind::Let(binding) => walk_paths(&binding.value, &mut visit),
            ItemKind::Param(param) => {
                match self.define(id) {
                    Some(define) => walk_paths(&define.value, &mut visit),
                    None => walk_paths(&param.value, &mut visit),
                }
                param.range.iter().for_each(|range| walk_paths(range, &mut visit));
            }
            _ => {}
        }
        found
    }

    /// Reports a cycle and poisons its members, so that each is reported once.
    fn binding_cycle(&mut self, id: ItemId, cycle: &[(ItemId, Option<Vec<ItemId>>)]) {
        let name = self.program.name(id);
        let mut error = Diagnostic::error(Code("E0212"), format!("`{name}` depends on itself"))
            .at(self.program.name_span(id), "its value needs itself");
        for (member, _) in cycle.iter().filter(|(member, _)| *member != id).take(6) {
            error = error.because(self.program.name_span(*member), "through this");
        }
        self.fault(error);
        for (member, _) in cycle {
            if self.bindings.insert(*member, Some(Value::Poison)).is_some() {
                break; // the rest belongs to a cycle that was reported before
            }
        }
    }

    /// The value of a `let` or a `param`; `at` is where it is referred to.
    pub(super) fn binding(&mut self, id: ItemId, at: Option<Span>) -> Value {
        match self.bindings.get(&id) {
            Some(Some(value)) => return value.clone(),
            Some(None) => {
                let (name, span) = (self.program.name(id), self.program.name_span(id));
                return self.self_reference(name, span, at);
            }
            None => {}
        }
        self.bindings.insert(id, None);
        let speculative = std::mem::take(&mut self.speculative);
        let program = self.program;
        let value = match &program.item(id).kind {
            ItemKind::Let(binding) => {
                let value = self.eval(&binding.value, Scope { module: id.module, local: None });
                self.let_value(value, &binding.value)
            }
            ItemKind::Param(param) => self.param(id, param),
            _ => Value::Poison,
        };
        self.speculative = speculative;
        self.bindings.insert(id, Some(value.clone()));
        value
    }

    /// A `let` holds values, not absences.
    fn let_value(&mut self, value: Value, expr: &Expr) -> Value {
        match value {
            Value::Default | Value::None => {
                let text = format!("a `let` cannot hold {}", value.described());
                self.fault(Diagnostic::error(Code("E0305"), text).at(expr.span, "no value"))
            }
            other => other,
        }
    }

    fn define(&self, id: ItemId) -> Option<&super::Define> {
        (id.module == 0).then(|| self.defines.get(self.program.name(id))).flatten()
    }

    fn param(&mut self, id: ItemId, param: &Param) -> Value {
        let scope = Scope { module: id.module, local: None };
        let Some(ty) = self.param_type(&param.ty) else {
            self.eval(&param.value, scope);
            return Value::Poison;
        };
        let written = self.eval(&param.value, scope);
        let written = self.param_fits(param, ty, written, &param.value);
        let outside = self.define(id).map(|define| define.value.clone());
        let (value, expr) = match &outside {
            Some(expr) => {
                let value = self.eval(expr, scope);
                (self.param_fits(param, ty, value, expr), expr)
            }
            None => (written, &param.value),
        };
        self.in_param_range(param, value, expr, scope)
    }

    fn param_type(&mut self, word: &Ident) -> Option<ParamType> {
        let special = PARAM_WORDS.iter().find(|(name, _)| *name == word.text).map(|(_, ty)| *ty);
        let known = special.or_else(|| Dim::from_param_name(&word.text).map(ParamType::Number));
        if known.is_none() {
            let text = format!("`{}` is not a type of parameter", word.text);
            let words = param_words();
            let error = Diagnostic::error(Code("E0208"), text);
            let error = did_you_mean(error, word, words.iter().map(String::as_str));
            self.fault(error.with_note(format!("the types are {}", quoted_list(&words))));
        }
        known
    }

    fn param_fits(&mut self, param: &Param, ty: ParamType, value: Value, expr: &Expr) -> Value {
        let name = &param.name.text;
        let wanted = match (ty, &value) {
            (_, Value::Poison)
            | (ParamType::Bool, Value::Bool(_))
            | (ParamType::Color, Value::Color(_))
            | (ParamType::Text, Value::Text(_)) => return value,
            (ParamType::Number(dim), Value::Number(_, own)) if dim == *own => return value,
            (ParamType::Number(dim), Value::Number(_, own)) => {
                let (code, label) = if own.is_none() {
                    ("E0301", "no unit".to_owned())
                } else {
                    ("E0302", own.to_string())
                };
                let text = format!("`{name}` needs {dim}, found {own}");
                let error = Diagnostic::error(Code(code), text).at(expr.span, label);
                let error = error.because(param.ty.span, format!("declared as {dim}"));
                let unit = literal_unit(&param.value).unwrap_or_default().to_owned();
                let error =
                    if own.is_none() { with_unit_fix(error, expr, dim, &unit) } else { error };
                return self.fault(error);
            }
            (ParamType::Count, Value::Number(n, Dim::NONE)) => {
                if *n >= 0.0 && n.fract() == 0.0 {
                    return value;
                }
                let text = format!("`{name}` is a count, found {n}");
                let error = Diagnostic::error(Code("E0401"), text)
                    .at(expr.span, "not a whole number from 0 up");
                return self.number_fault(error);
            }
            (ParamType::Color, Value::Hex(_) | Value::Number(..) | Value::Vector(..)) => {
                return self.without_space(&format!("`{name}`"), &value, expr.span);
            }
            (ParamType::Number(dim), _) => dim.to_string(),
            (ParamType::Count, _) => "a count".to_owned(),
            (ParamType::Bool, _) => "`true` or `false`".to_owned(),
            (ParamType::Color, _) => "a colour".to_owned(),
            (ParamType::Text, _) => "a text".to_owned(),
        };
        let text = format!("`{name}` needs {wanted}, found {}", value.described());
        let error = Diagnostic::error(Code("E0305"), text)
            .at(expr.span, value.described())
            .because(param.ty.span, format!("declared as {wanted}"));
        self.fault(error)
    }

    fn in_param_range(
        &mut self,
        param: &Param,
        value: Value,
        expr: &Expr,
        scope: Scope<'_>,
    ) -> Value {
        let Some(range) = &param.range else { return value };
        let bounds = self.eval(range, scope);
        match (&value, &bounds) {
            (Value::Poison, _) | (_, Value::Poison) => value,
            (Value::Number(v, dim), Value::Range(low, high, other)) if dim == other => {
                if (*low..=*high).contains(v) {
                    return value;
                }
                let text = format!(
                    "`{}` is {}, outside {}",
                    param.name.text,
                    value.shown(),
                    bounds.shown()
                );
                let error = Diagnostic::error(Code("E0401"), text)
                    .at(expr.span, value.shown())
                    .because(range.span, "the allowed values");
                self.number_fault(error)
            }
            _ => {
                let text = format!(
                    "the range of `{}` is {}, its value {}",
                    param.name.text,
                    bounds.described(),
                    value.described()
                );
                let code = if bounds.dim().is_some() { "E0302" } else { "E0305" };
                self.fault(Diagnostic::error(Code(code), text).at(range.span, bounds.described()))
            }
        }
    }

    /// Every `-D` must name a parameter of the root file.
    fn check_defines(&mut self) {
        let program = self.program;
        let Some(root) = program.modules.first() else { return };
        let params: Vec<&str> = root
            .tree
            .items
            .iter()
            .filter_map(|item| match &item.kind {
                ItemKind::Param(param) => Some(param.name.text.as_str()),
                _ => None,
            })
            .collect();
        let wrong: Vec<Ident> = self
            .defines
            .iter()
            .filter(|(name, _)| !params.contains(&name.as_str()))
            .map(|(name, define)| Ident { text: name.clone(), span: define.name })
            .collect();
        for name in wrong {
            let text = format!("the scene has no parameter `{}`", name.text);
            let error = Diagnostic::error(Code("E0213"), text);
            let error = did_you_mean(error, &name, params.iter().copied());
            let all: Vec<String> = params.iter().map(|p| (*p).to_owned()).collect();
            let note = if all.is_empty() {
                "it has no parameters at all".to_owned()
            } else {
                format!("its parameters are {}", quoted_list(&all))
            };
            self.fault(error.with_note(note));
        }
    }

    /// The value of a parameter, once computed.
    pub(crate) fn known_binding(&self, id: ItemId) -> Option<&Value> {
        self.bindings.get(&id).and_then(Option::as_ref)
    }
}

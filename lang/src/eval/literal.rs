//! Numbers, tuples and lists: values that are written out, with their units.

use super::advice::{literal_unit, with_unit_fix};
use super::value::Value;
use super::{Evaluator, Scope, operator};
use crate::diagnostic::{Code, Diagnostic, Fix};
use crate::source::Span;
use crate::suggest::suggest;
use crate::syntax::{self, Expr};
use crate::units::{self, Dim};

impl Evaluator<'_> {
    pub(super) fn number(&mut self, number: &syntax::Number) -> Value {
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
        let error = Diagnostic::error(Code("E0303"), format!("unknown unit `{atom}`"));
        let names = &self.program.modules;
        let is_name = |name: &str| names.iter().any(|module| module.names.contains_key(name));
        let close = suggest(atom, units::UNITS.iter().map(|unit| unit.symbol));
        let error = if unit.text.contains('/') && is_name(atom) {
            let text = format!(" {}", unit.text.replace('/', " / "));
            let text = if unit.text.starts_with('/') { text } else { text.trim_start().to_owned() };
            error.at(unit.span, format!("`{atom}` is a name, not a unit")).with_fix(Fix::sure(
                "put spaces around `/`",
                unit.span,
                text,
            ))
        } else if let Some(ours) = units::other_spelling(atom) {
            let text = unit.text.replace(atom, ours);
            let fix = Fix::sure(format!("write `{ours}`"), unit.span, text);
            error.at(unit.span, format!("did you mean `{ours}`?")).with_fix(fix)
        } else if let Some(metric) = units::not_metric(atom) {
            error.at(unit.span, "not a unit here").with_help(format!("1 {atom} is {metric}"))
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

    pub(super) fn tuple(
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

    pub(super) fn list(&mut self, entries: &[syntax::Entry], scope: Scope<'_>) -> Value {
        let mut values = Vec::with_capacity(entries.len());
        for entry in entries {
            if let Some(key) = &entry.key {
                let text = "the entries of this list have no keys";
                self.fault(Diagnostic::error(Code("E0305"), text).at(key.span, "not wanted"));
            }
            let mut value = self.eval(&entry.value, scope);
            if let Value::List(_) = value {
                let error = Diagnostic::error(Code("E0305"), "a list cannot hold another list");
                value = self.fault(error.at(entry.value.span, "a list"));
            }
            values.push((value, entry.value.span));
        }
        Value::List(values.into())
    }
}

//! A number against its field: dimension and range.

use super::slot::Slot;
use crate::diagnostic::{Code, Diagnostic, Fix};
use crate::eval::value::Value;
use crate::eval::{Evaluator, Scope, with_unit_fix};
use crate::schema::Bounds;
use crate::syntax::ExprKind;
use crate::units::{self, Dim};

impl Evaluator<'_> {
    pub(in crate::check) fn fit_number(
        &mut self,
        slot: Slot<'_>,
        value: Value,
        bounds: Bounds,
    ) -> Value {
        match value {
            Value::Number(number, dim) if dim == bounds.dim => {
                self.in_bounds(slot, number, bounds).map_or(Value::Poison, |()| value)
            }
            other => self.wrong_dimension(
                slot,
                &other,
                (bounds.dim, bounds.unit),
                &bounds.dim.to_string(),
            ),
        }
    }

    /// A number of any of these dimensions.
    pub(super) fn fit_quantity(
        &mut self,
        slot: Slot<'_>,
        value: Value,
        choices: &[(Dim, &'static str)],
    ) -> Value {
        if let Value::Number(number, dim) = value
            && let Some((dim, unit)) = choices.iter().find(|(choice, _)| *choice == dim)
        {
            let bounds = Bounds::new(*dim, unit, 0.0, f64::INFINITY);
            return self.in_bounds(slot, number, bounds).map_or(Value::Poison, |()| value);
        }
        let needs: Vec<String> = choices.iter().map(|(dim, _)| dim.to_string()).collect();
        let first = choices.first().copied().unwrap_or((Dim::NONE, ""));
        self.wrong_dimension(slot, &value, first, &needs.join(" or "))
    }

    pub(super) fn in_bounds(&mut self, slot: Slot<'_>, number: f64, bounds: Bounds) -> Option<()> {
        if bounds.contains(number) {
            return Some(());
        }
        let (name, range) = (slot.name(), bounds.described());
        let text = format!("{name} must be {range}, found {}", bounds.show(number));
        let mut error = Diagnostic::error(Code("E0401"), text).at(slot.span(), range);
        if !slot.field.typical.is_empty() {
            error = error.with_note(format!("typical: {}", slot.field.typical));
        }
        let looks_like_percent = bounds.is_share() && (2.0..=100.0).contains(&number);
        if looks_like_percent && matches!(&slot.expr.kind, ExprKind::Number(n) if n.unit.is_none())
        {
            error = error.with_fix(Fix::guess("write percent", slot.span().after(), "%"));
        }
        self.number_fault(error);
        None
    }

    /// A number or tuple of the wrong dimension, or no number at all.
    pub(super) fn wrong_dimension(
        &mut self,
        slot: Slot<'_>,
        value: &Value,
        (dim, unit): (Dim, &str),
        needs: &str,
    ) -> Value {
        let text = format!("{} needs {needs}, found {}", slot.name(), value.described());
        let error = |code| Diagnostic::error(Code(code), text);
        let numbers = matches!(value, Value::Number(..) | Value::Vector(..) | Value::Range(..));
        match value.dim() {
            Some(Dim::NONE) if numbers && !dim.is_none() => {
                let error = error("E0301").at(slot.span(), "no unit").with_note(slot.note(needs));
                self.fault(with_unit_fix(error, slot.expr, dim, unit))
            }
            Some(own) if numbers && own != dim => {
                let error =
                    error("E0302").at(slot.span(), value.described()).with_note(slot.note(needs));
                let scope = Scope { module: slot.module, local: None };
                let error = self.explain_names(error, slot.expr, scope);
                self.fault(error)
            }
            _ => self.fault(error("E0305").at(slot.span(), value.described())),
        }
    }

    pub(super) fn fit_integer(
        &mut self,
        slot: Slot<'_>,
        value: &Value,
        [min, max]: [u32; 2],
    ) -> Value {
        let Value::Number(number, Dim::NONE) = *value else {
            return self.wrong_dimension(slot, value, (Dim::NONE, ""), "a whole number");
        };
        if number.fract() == 0.0 && (f64::from(min)..=f64::from(max)).contains(&number) {
            #[expect(clippy::cast_possible_truncation, reason = "whole and inside u32")]
            return Value::Integer(number as u32);
        }
        let range = format!("a whole number between {min} and {max}");
        let text = format!("{} must be {range}, found {}", slot.name(), units::show_number(number));
        self.number_fault(Diagnostic::error(Code("E0401"), text).at(slot.span(), range))
    }
}

/// No limit but those of the language; the lower end is zero.
pub(in crate::check) fn any(dim: Dim, unit: &'static str) -> Bounds {
    Bounds { dim, unit, min: 0.0, above_min: false, max: f64::INFINITY }
}

//! Several numbers against their field: vectors, colours of light, sizes, pixels, intervals, scales.

use super::slot::Slot;
use crate::diagnostic::{Code, Diagnostic};
use crate::eval::Evaluator;
use crate::eval::value::Value;
use crate::schema::{Bounds, MAX_FILM_SIDE};
use crate::units::{self, Dim};

impl Evaluator<'_> {
    pub(super) fn fit_vector(
        &mut self,
        slot: Slot<'_>,
        value: Value,
        (dim, unit): (Dim, &str),
        n: usize,
    ) -> Value {
        match &value {
            Value::Vector(values, own) if *own == dim && values.len() == n => value,
            Value::Vector(values, own) if *own == dim => {
                let found = values.len();
                let text = format!("{} needs {n} entries, found {found}", slot.name());
                self.fault(
                    Diagnostic::error(Code("E0306"), text)
                        .at(slot.span(), format!("{found} entries")),
                )
            }
            _ => {
                let needs = dim.several(n);
                if matches!(value, Value::Number(_, own) if own == dim) {
                    let text = format!("{} needs {needs}, found one", slot.name());
                    let error =
                        Diagnostic::error(Code("E0306"), text).at(slot.span(), "one number");
                    return self.fault(error);
                }
                self.wrong_dimension(slot, &value, (dim, unit), &needs)
            }
        }
    }

    /// One number for all channels becomes three.
    pub(super) fn fit_spectrum(&mut self, slot: Slot<'_>, value: Value, bounds: Bounds) -> Value {
        let value = match value {
            Value::Number(number, dim) if dim == bounds.dim => Value::Vector(vec![number; 3], dim),
            other => self.fit_vector(slot, other, (bounds.dim, bounds.unit), 3),
        };
        if let Value::Vector(values, _) = &value {
            let wrong = values.iter().find(|value| !bounds.contains(**value)).copied();
            if wrong.is_some_and(|wrong| self.in_bounds(slot, wrong, bounds).is_none()) {
                return Value::Poison;
            }
        }
        value
    }

    pub(super) fn fit_size(&mut self, slot: Slot<'_>, value: Value, n: usize) -> Value {
        let value = self.fit_vector(slot, value, (Dim::LENGTH, "m"), n);
        if let Value::Vector(values, _) = &value
            && let Some(wrong) = values.iter().find(|v| **v <= 0.0)
        {
            let text = format!(
                "each {} must be above 0m, found {}",
                slot.name(),
                units::show(*wrong, Dim::LENGTH)
            );
            return self
                .number_fault(Diagnostic::error(Code("E0401"), text).at(slot.span(), "above 0m"));
        }
        value
    }

    pub(super) fn fit_pixels(&mut self, slot: Slot<'_>, value: Value) -> Value {
        let value = self.fit_vector(slot, value, (Dim::PIXEL, "px"), 2);
        let fits = |v: f64| v.fract() == 0.0 && (1.0..=f64::from(MAX_FILM_SIDE)).contains(&v);
        if let Value::Vector(values, _) = &value
            && let Some(wrong) = values.iter().find(|v| !fits(**v))
        {
            let range = format!("whole and between 1px and {MAX_FILM_SIDE}px");
            let text = format!("each {} must be {range}, found {wrong}px", slot.name());
            return self
                .number_fault(Diagnostic::error(Code("E0401"), text).at(slot.span(), range));
        }
        value
    }

    pub(super) fn fit_interval(&mut self, slot: Slot<'_>, value: Value, bounds: Bounds) -> Value {
        match value {
            Value::Range(low, high, dim) if dim == bounds.dim => {
                if low > high {
                    let text = format!("{} ends before it begins", slot.name());
                    let error =
                        Diagnostic::error(Code("E0401"), text).at(slot.span(), "a..b, a first");
                    return self.number_fault(error);
                }
                let inside =
                    [low, high].into_iter().all(|end| self.in_bounds(slot, end, bounds).is_some());
                if inside { value } else { Value::Poison }
            }
            Value::Number(_, dim) if dim == bounds.dim => {
                let text = format!("{} needs an interval `a..b`, found one value", slot.name());
                self.fault(
                    Diagnostic::error(Code("E0306"), text).at(slot.span(), "from where to where?"),
                )
            }
            other => {
                let needs = format!("an interval between {}", bounds.dim.several(2));
                self.wrong_dimension(slot, &other, (bounds.dim, bounds.unit), &needs)
            }
        }
    }

    pub(super) fn fit_scale(&mut self, slot: Slot<'_>, value: Value) -> Value {
        let values = match value {
            Value::Number(factor, Dim::NONE) => vec![factor; 3],
            Value::Vector(values, Dim::NONE) if values.len() == 3 => values,
            other => {
                return self.fit_vector(slot, other, (Dim::NONE, ""), 3);
            }
        };
        if values.contains(&0.0) {
            let text = format!("{} must not be zero", slot.name());
            return self
                .number_fault(Diagnostic::error(Code("E0401"), text).at(slot.span(), "not zero"));
        }
        Value::Vector(values, Dim::NONE)
    }
}

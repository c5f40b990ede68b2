//! Lists of tuples: the points and the faces of a mesh.

use super::field::Slot;
use crate::diagnostic::{Code, Diagnostic, Fix};
use crate::eval::Evaluator;
use crate::eval::value::Value;
use crate::source::Span;
use crate::units::Dim;

impl Evaluator<'_> {
    /// A list of points, metres.
    pub(super) fn fit_points(&mut self, slot: Slot<'_>, value: Value) -> Value {
        let Value::List(points) = &value else {
            return self.wrong_kind(slot, &value, "a list of points such as `[(0, 0, 0)m]`");
        };
        for (point, span) in points.iter() {
            match point {
                Value::Vector(values, Dim::LENGTH) if values.len() == 3 => {}
                Value::Vector(_, Dim::NONE) => {
                    let text = "a point needs lengths, found plain numbers";
                    let fix = Fix::guess("give them a unit", span.after(), "m");
                    let error = Diagnostic::error(Code("E0301"), text).at(*span, "no unit");
                    return self.fault(error.with_fix(fix));
                }
                other => return self.no_tuple("a point", "three lengths", other, *span),
            }
        }
        value
    }

    /// A list of faces, each of three indices.
    pub(super) fn fit_faces(&mut self, slot: Slot<'_>, value: &Value) -> Value {
        let Value::List(faces) = value else {
            return self.wrong_kind(slot, value, "a list of faces such as `[(0, 1, 2)]`");
        };
        let mut triangles = Vec::with_capacity(2 * faces.len());
        for (face, span) in faces.iter() {
            let corners = match face {
                Value::Vector(values, Dim::NONE) if matches!(values.len(), 3 | 4) => values,
                other => {
                    return self.no_tuple("a face", "three or four plain numbers", other, *span);
                }
            };
            let index = |x: &f64| x.fract() == 0.0 && (0.0..=f64::from(u32::MAX)).contains(x);
            if let Some(wrong) = corners.iter().find(|x| !index(x)) {
                let text = format!("an index of a point is a whole number from 0, found {wrong}");
                let error = Diagnostic::error(Code("E0401"), text).at(*span, "no index");
                return self.number_fault(error);
            }
            for [b, c] in corners[1..].array_windows() {
                triangles.push((Value::Vector(vec![corners[0], *b, *c], Dim::NONE), *span));
            }
        }
        Value::List(triangles.into())
    }

    fn no_tuple(&mut self, what: &str, needs: &str, found: &Value, span: Span) -> Value {
        if *found == Value::Poison {
            return Value::Poison;
        }
        let text = format!("{what} needs {needs}, found {}", found.described());
        self.fault(Diagnostic::error(Code("E0305"), text).at(span, found.described()))
    }
}

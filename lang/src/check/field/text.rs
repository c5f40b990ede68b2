//! A text in quotes against its field: a path, the name of a group, or any.

use super::slot::Slot;
use crate::check::group;
use crate::diagnostic::{Code, Diagnostic, Fix};
use crate::eval::Evaluator;
use crate::eval::value::Value;
use crate::schema::FieldType;
use crate::syntax::ExprKind;

impl Evaluator<'_> {
    pub(super) fn fit_text(&mut self, slot: Slot<'_>, value: Value) -> Value {
        let Value::Text(text) = &value else {
            return self.wrong_kind(slot, &value, "a text in quotes");
        };
        let is_path = matches!(slot.field.ty, FieldType::Path);
        if text.is_empty() {
            let message = format!("{} is empty", slot.name());
            return self.fault(Diagnostic::error(Code("E0501"), message).at(slot.span(), "empty"));
        }
        if matches!(slot.field.ty, FieldType::Group) {
            let literal = matches!(slot.expr.kind, ExprKind::Text(_));
            if let Some(error) = group::fault(text, slot.span(), literal) {
                return self.fault(error);
            }
        }
        if is_path && text.contains('\\') {
            let message = "a path has a `\\` in it, which only works on Windows";
            let error = Diagnostic::error(Code("E0501"), message).at(slot.span(), "use `/`");
            let literal = matches!(slot.expr.kind, ExprKind::Text(_));
            return self.fault(if literal {
                let fixed = format!("\"{}\"", text.replace('\\', "/"));
                error.with_fix(Fix::sure("use `/`", slot.span(), fixed))
            } else {
                error
            });
        }
        value
    }
}

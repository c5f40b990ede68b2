//! Where a value is going, and what is said of one that is of another kind.

use crate::diagnostic::{Code, Diagnostic};
use crate::eval::Evaluator;
use crate::eval::value::Value;
use crate::schema::{Field, TypeSchema};
use crate::source::Span;
use crate::syntax::Expr;

/// Where a value is going.
#[derive(Clone, Copy)]
pub(in crate::check) struct Slot<'e> {
    pub(in crate::check) schema: &'static TypeSchema,
    pub(in crate::check) field: &'static Field,
    pub(in crate::check) expr: &'e Expr,
    pub(in crate::check) module: u32,
}

impl Slot<'_> {
    pub(in crate::check) fn span(&self) -> Span {
        self.expr.span
    }

    /// `` `ring.width` ``.
    pub(in crate::check) fn name(&self) -> String {
        format!("`{}`", self.field.name)
    }

    /// What the field is and what people write, for a note.
    pub(super) fn note(&self, is: &str) -> String {
        let owner = match self.schema.name {
            "" => self.schema.kind.name(),
            name => name,
        };
        let typical = match self.field.typical {
            "" => String::new(),
            text => format!("; {text}"),
        };
        format!("`{owner}.{}` is {is}{typical}", self.field.name)
    }
}

impl Evaluator<'_> {
    pub(in crate::check) fn wrong_kind(
        &mut self,
        slot: Slot<'_>,
        value: &Value,
        wanted: &str,
    ) -> Value {
        self.wrong_kind_at(slot, slot.span(), value, wanted)
    }

    /// The same of a part of the value, at `span`.
    pub(in crate::check) fn wrong_kind_at(
        &mut self,
        slot: Slot<'_>,
        span: Span,
        value: &Value,
        wanted: &str,
    ) -> Value {
        let text = format!("{} needs {wanted}, found {}", slot.name(), value.described());
        let item = match value {
            Value::Item(_, id) | Value::TextureColor(id) | Value::TextureChannel(id, _) => {
                Some(*id)
            }
            _ => None,
        };
        let code = if item.is_some() { "E0203" } else { "E0305" };
        let error = Diagnostic::error(Code(code), text).at(span, value.described());
        let error = match item {
            Some(id) => error.because(self.program.name_span(id), "declared here"),
            None => error,
        };
        self.fault(error)
    }
}

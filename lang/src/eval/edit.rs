//! `car { material "paint*" = red, part "wheel*" = none }`: a mesh file with other materials, and without some parts.

use std::rc::Rc;

use super::value::{ShapeValue, Value};
use super::{Evaluator, Scope};
use crate::diagnostic::{Code, Diagnostic};
use crate::resolve::{ItemId, did_you_mean};
use crate::schema::Kind;
use crate::shape::{EditOf, MeshEdit};
use crate::syntax::{Edit, Expr};

impl Evaluator<'_> {
    /// The mesh file `base` with changes. The first that is wrong speaks for all.
    pub(super) fn edited(&mut self, base: &Expr, edits: &[Edit], scope: Scope<'_>) -> Value {
        let found = self.eval(base, scope);
        let edits: Option<Vec<_>> = edits.iter().map(|edit| self.edit(edit, scope)).collect();
        let (asset, part) = match &found {
            Value::Poison => return Value::Poison,
            Value::Item(Kind::Asset, id) => (*id, None),
            Value::Shape(shape) => match &**shape {
                ShapeValue::Mesh(id, part, earlier) if earlier.is_empty() => (*id, part.clone()),
                _ => return self.not_a_file(&found, base),
            },
            _ => return self.not_a_file(&found, base),
        };
        edits.map_or(Value::Poison, |edits| {
            Value::Shape(Rc::new(ShapeValue::Mesh(asset, part, edits)))
        })
    }

    fn not_a_file(&mut self, found: &Value, base: &Expr) -> Value {
        let text = "only the materials and parts of a mesh file can be replaced";
        let error =
            Diagnostic::error(Code("E0305"), text).at(base.span, found.described()).with_help(
                "write `asset { material \"its name\" = mine }` after the name of an `asset`",
            );
        self.fault(error)
    }

    fn edit(&mut self, edit: &Edit, scope: Scope<'_>) -> Option<MeshEdit<ItemId>> {
        let Some(of) = EditOf::of(&edit.kind.text) else {
            let text = format!("a mesh file has no `{}` to replace", edit.kind.text);
            let words = EditOf::WORDS.iter().map(|(word, _)| *word);
            let error = did_you_mean(Diagnostic::error(Code("E0201"), text), &edit.kind, words);
            self.fault(error.with_note("it has `material \"name\"` and `part \"name\"`"));
            return None;
        };
        let material = match self.edit_value(edit, scope) {
            Value::Poison => return None,
            Value::None => None,
            Value::Item(Kind::Material, id) => Some(id),
            other => {
                let text = format!("this needs a material or `none`, found {}", other.described());
                let error =
                    Diagnostic::error(Code("E0305"), text).at(edit.value.span, "not a material");
                self.fault(error.with_note("`none` leaves out what has this name"));
                return None;
            }
        };
        let (pattern, pattern_span) = (edit.pattern.text.clone(), edit.pattern.span);
        Some(MeshEdit { of, pattern, pattern_span, material, material_span: edit.value.span })
    }

    fn edit_value(&mut self, edit: &Edit, scope: Scope<'_>) -> Value {
        match &edit.value.kind {
            crate::syntax::ExprKind::Path(path) => self.path(path, scope, Some(Kind::Material)),
            _ => self.eval(&edit.value, scope),
        }
    }
}

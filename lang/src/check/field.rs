//! One value against what its field wants: type, dimension, range, texture space.

mod number;
mod slot;
mod text;
mod vector;
mod word;

pub(super) use number::any;
pub(super) use slot::Slot;

use super::{keys, lint};
use crate::diagnostic::{Code, Diagnostic, Fix};
use crate::eval::value::Value;
use crate::eval::{Evaluator, Scope};
use crate::resolve::quoted_list;
use crate::schema::{Bounds, Default, Field, FieldType, Kind, TypeSchema, Word};
use crate::syntax::{Entry, Expr, ExprKind, Path};
use crate::texture::TextureExpression;
use crate::units::Dim;

impl Evaluator<'_> {
    /// Evaluates an expression as the value of a field. The result is what the schema says, or
    /// `Default`, `None` or `Poison`.
    pub(crate) fn field_value(
        &mut self,
        schema: &'static TypeSchema,
        field: &'static Field,
        expr: &Expr,
        scope: Scope<'_>,
    ) -> Value {
        let slot = Slot { schema, field, expr, module: scope.module };
        if let (FieldType::Words(words), ExprKind::List(entries)) = (field.ty, &expr.kind) {
            return self.words(slot, words, entries, scope);
        }
        if let (FieldType::Names(kind), ExprKind::List(entries)) = (field.ty, &expr.kind) {
            return self.names(slot, kind, (entries, scope));
        }
        if let (FieldType::Keyed(dim, unit), ExprKind::List(entries)) = (field.ty, &expr.kind) {
            let triple = |ev: &mut Evaluator<'_>, expr: &Expr| match ev.eval(expr, scope) {
                Value::Poison => Value::Poison,
                value => ev.fit_vector(Slot { expr, ..slot }, value, (dim, unit), 3),
            };
            return keys::keys(self, (&slot.name(), slot.span()), dim, (entries, scope), triple);
        }
        match &expr.kind {
            ExprKind::If { condition, then, otherwise } => {
                let taken = self.condition(condition, scope);
                self.branches(taken, [then, otherwise], |ev, branch| {
                    ev.field_value(schema, field, branch, scope)
                })
            }
            ExprKind::Default => Value::Default,
            ExprKind::None if matches!(field.default, Default::Absent(_)) => Value::None,
            ExprKind::None => {
                let text = format!("{} cannot be `none`", slot.name());
                self.fault(Diagnostic::error(Code("E0305"), text).at(expr.span, "needs a value"))
            }
            ExprKind::Path(path) if self.wants_word(slot, path) => {
                self.word(slot, &path.segments[0])
            }
            ExprKind::Path(path)
                if matches!(field.ty, FieldType::Group)
                    && path.segments.len() == 1
                    && self.program.lookup(scope.module, path).is_none() =>
            {
                let name = &path.segments[0];
                let text = format!("{} needs a text in quotes", slot.name());
                let error = Diagnostic::error(Code("E0305"), text).at(expr.span, "not in quotes");
                let quoted = format!("\"{}\"", name.text);
                self.fault(error.with_fix(Fix::guess("add quotes", expr.span, quoted)))
            }
            ExprKind::Path(path) => {
                let kind = match field.ty {
                    FieldType::Name(kind) | FieldType::Names(kind) => Some(kind),
                    _ => None,
                };
                let value = self.path(path, scope, kind);
                self.fit(slot, value)
            }
            _ => {
                let value = self.eval(expr, scope);
                let value = self.fit(slot, value);
                if value != Value::Poison && !self.is_speculative() {
                    lint::literal(self, field, expr);
                }
                value
            }
        }
    }

    /// Whether a name is a word to its field, known or not, and no name of something else.
    fn wants_word(&self, slot: Slot<'_>, path: &Path) -> bool {
        let [name] = path.segments.as_slice() else { return false };
        match slot.field.ty {
            FieldType::Word(_) | FieldType::Words(_) | FieldType::LengthUnit | FieldType::Axis => {
                true
            }
            FieldType::IntegerOr(_, _, words) => {
                words.iter().any(|(word, _)| *word == name.text)
                    || self.program.lookup(slot.module, path).is_none()
            }
            _ => false,
        }
    }

    /// A list of words; every one that is none is reported.
    fn words(
        &mut self,
        slot: Slot<'_>,
        words: &'static [Word],
        entries: &[Entry],
        scope: Scope<'_>,
    ) -> Value {
        let mut values = Vec::new();
        for entry in entries {
            let value = match &entry.value.kind {
                ExprKind::Path(path) if entry.key.is_none() && path.segments.len() == 1 => {
                    self.one_of(slot, words, &path.segments[0])
                }
                _ => {
                    let value = self.eval(&entry.value, scope);
                    self.fit(slot, value)
                }
            };
            values.push((value, entry.value.span));
        }
        if values.iter().any(|(value, _)| !matches!(value, Value::Word(_))) {
            return Value::Poison;
        }
        Value::List(values.into())
    }

    /// Turns a value into what the field wants, or reports why not.
    fn fit(&mut self, slot: Slot<'_>, value: Value) -> Value {
        if let Value::Poison | Value::Default = value {
            return value;
        }
        match slot.field.ty {
            FieldType::Number(bounds) => self.fit_number(slot, value, bounds),
            FieldType::Quantity(choices) => self.fit_quantity(slot, value, choices),
            FieldType::Integer(min, max) | FieldType::IntegerOr(min, max, _) => {
                self.fit_integer(slot, &value, [min, max])
            }
            FieldType::Vector(dim, unit) | FieldType::Keyed(dim, unit) => {
                self.fit_vector(slot, value, (dim, unit), 3)
            }
            FieldType::Spectrum(bounds) => self.fit_spectrum(slot, value, bounds),
            FieldType::Size(n) => self.fit_size(slot, value, n),
            FieldType::Points => self.fit_points(slot, value),
            FieldType::Faces => self.fit_faces(slot, &value),
            FieldType::Pixels => self.fit_pixels(slot, value),
            FieldType::Color(max) => self.fit_color(slot, value, max),
            FieldType::ColorSlot(max) => match value {
                Value::TextureColor(id) | Value::Item(Kind::Texture, id) => {
                    self.fit_texture(slot, id, Value::TextureColor(id), true)
                }
                Value::Textured(of) => {
                    let bounds = Bounds { max, min: 0.0, ..any(Dim::NONE, "") };
                    self.fit_textured(slot, &of, bounds, true)
                }
                other => self.fit_color(slot, other, max),
            },
            FieldType::ScalarSlot(bounds) => self.fit_scalar(slot, value, bounds),
            FieldType::NormalSlot => match value {
                Value::TextureColor(id) | Value::Item(Kind::Texture, id) => {
                    self.fit_texture(slot, id, Value::TextureColor(id), false)
                }
                other => self.wrong_kind(slot, &other, "a normal map: `.rgb` of a texture"),
            },
            FieldType::Name(kind) => match value {
                Value::Item(own, _) if own == kind => value,
                other => self.wrong_kind(slot, &other, kind.with_article()),
            },
            FieldType::Names(kind) => match value {
                Value::Item(own, _) if own == kind => Value::List([(value, slot.span())].into()),
                Value::List(values) => self.fit_names(slot, kind, values),
                other => self.wrong_kind(slot, &other, &format!("a list of {}s", kind.name())),
            },
            FieldType::Shape => self.fit_shape(slot, value),
            FieldType::Interval(bounds) => self.fit_interval(slot, value, bounds),
            FieldType::Text | FieldType::Path | FieldType::Group => self.fit_text(slot, value),
            FieldType::Scale => self.fit_scale(slot, value),
            FieldType::Axis if matches!(value, Value::Axis(_)) => value,
            FieldType::Axis => self.wrong_kind(slot, &value, "an axis such as `+y`"),
            FieldType::Word(words) | FieldType::Words(words) => {
                let all: Vec<String> = words.iter().map(|(word, _)| (*word).to_owned()).collect();
                let wanted = format!("one of {}", quoted_list(&all));
                self.wrong_kind(slot, &value, &wanted)
            }
            FieldType::LengthUnit => {
                self.fit_number(slot, value, Bounds { above_min: true, ..any(Dim::LENGTH, "m") })
            }
        }
    }

    /// A number, or one of a texture.
    fn fit_scalar(&mut self, slot: Slot<'_>, value: Value, bounds: Bounds) -> Value {
        match value {
            Value::TextureChannel(id, 3) => Value::TextureChannel(id, 3),
            Value::TextureChannel(id, channel) => {
                self.fit_texture(slot, id, Value::TextureChannel(id, channel), false)
            }
            Value::TextureColor(id) | Value::Item(Kind::Texture, id) => {
                self.which_channel(slot, Some(id))
            }
            Value::Textured(of) if *of == TextureExpression::VertexColor => {
                self.which_channel(slot, None)
            }
            Value::Textured(of) => self.fit_textured(slot, &of, bounds, false),
            other => self.fit_number(slot, other, bounds),
        }
    }
}

//! Names in expressions: values, declarations, their fields and members.

use std::rc::Rc;

use super::value::{ShapeValue, Value};
use super::{Evaluator, Scope};
use crate::diagnostic::{Code, Diagnostic, Fix};
use crate::resolve::{Found, ItemId, did_you_mean, item_kind, quoted_list};
use crate::schema::Kind;
use crate::source::Span;
use crate::syntax::{Ident, ItemKind, Path};
use crate::texture::{CHANNELS, TextureExpression, VERTEX_COLOR};

impl Evaluator<'_> {
    /// The value of a path. `kind` is what the place wants, for the message about unknown names.
    pub(crate) fn path(&mut self, path: &Path, scope: Scope<'_>, kind: Option<Kind>) -> Value {
        let first = &path.segments[0];
        if let Some((name, value)) = scope.local
            && name == first.text
        {
            return self.members(Value::plain(value), &path.segments[1..]);
        }
        match self.program.find(scope.module, path, kind) {
            Ok(Found::Poison) => Value::Poison,
            Ok(Found::Item(id, used)) => self.item_path(id, &path.segments[used..]),
            // A declaration of this name goes first.
            Err(_) if first.text == VERTEX_COLOR => {
                let value = Value::Textured(Rc::new(TextureExpression::VertexColor));
                self.members(value, &path.segments[1..])
            }
            Err(error) => self.fault(*error),
        }
    }

    fn item_path(&mut self, id: ItemId, rest: &[Ident]) -> Value {
        self.used.insert(id);
        let item = self.program.item(id);
        if matches!(item.kind, ItemKind::Param(_) | ItemKind::Let(_)) {
            let value = self.binding(id, rest.first().map(|name| name.span));
            return self.members(value, rest);
        }
        let Some(kind) = item_kind(item) else { return Value::Poison };
        match (kind, rest) {
            (_, []) => Value::Item(kind, id),
            (Kind::Asset, parts) => {
                let names: Vec<&str> = parts.iter().map(|part| part.text.as_str()).collect();
                Value::Shape(Rc::new(ShapeValue::Mesh(id, Some(names.join(".")), Vec::new())))
            }
            (Kind::Texture, [channel, rest @ ..]) => {
                let value = self.channel(id, channel);
                self.members(value, rest)
            }
            (_, fields) => self.field_path(id, fields),
        }
    }

    fn channel(&mut self, id: ItemId, name: &Ident) -> Value {
        match name.text.as_str() {
            "rgb" => Value::TextureColor(id),
            "r" => Value::TextureChannel(id, 0),
            "g" => Value::TextureChannel(id, 1),
            "b" => Value::TextureChannel(id, 2),
            "a" => Value::TextureChannel(id, 3),
            other => {
                let error =
                    Diagnostic::error(Code("E0309"), format!("a texture has no `.{other}`"))
                        .at(name.span, "not known")
                        .with_note("a texture has `.rgb`, `.r`, `.g`, `.b` and `.a`");
                self.fault(error)
            }
        }
    }

    /// `hero.from`, `hero.sensor.width`, `hero.from.x`: the longest field name counts.
    fn field_path(&mut self, id: ItemId, rest: &[Ident]) -> Value {
        let Some(model) = self.models.get(&id) else { return Value::Poison };
        let schema = model.schema;
        let indexed = model
            .chain
            .iter()
            .any(|id| self.program.decl(*id).is_some_and(|decl| decl.index.is_some()));
        if indexed {
            let name = self.program.name(id);
            let text = format!("`{name}` stands for many instances, its fields have no one value");
            return self
                .fault(Diagnostic::error(Code("E0203"), text).at(rest[0].span, "which one?"));
        }
        for n in (1..=rest.len()).rev() {
            let words: Vec<&str> = rest[..n].iter().map(|name| name.text.as_str()).collect();
            if let Some(field) = schema.field(&words.join(".")) {
                let span = rest[0].span.to(rest[n - 1].span);
                let value = self.referred_field(id, field, span);
                return self.members(value, &rest[n..]);
            }
        }
        let text = format!("{} has no field `{}`", schema.described(), rest[0].text);
        let names = schema.fields.iter().map(|field| field.name);
        self.fault(did_you_mean(Diagnostic::error(Code("E0201"), text), &rest[0], names))
    }

    fn members(&mut self, value: Value, names: &[Ident]) -> Value {
        names.iter().fold(value, |value, name| self.member(&value, name))
    }

    /// `.x` of a vector, `.r` of a colour.
    pub(super) fn member(&mut self, value: &Value, name: &Ident) -> Value {
        let index = |letters: &str| {
            (name.text.len() == 1).then(|| letters.find(name.text.as_str())).flatten()
        };
        let (members, found): (&[&str], Option<Value>) = match value {
            Value::Poison => return Value::Poison,
            Value::Vector(values, dim) => {
                let found =
                    index("xyzw").and_then(|i| values.get(i)).map(|v| Value::Number(*v, *dim));
                (&["x", "y", "z", "w"][..values.len().min(4)], found)
            }
            Value::Color(rgb) => {
                let found = index("rgb").and_then(|i| rgb.get(i)).map(|v| Value::plain(*v));
                (&["r", "g", "b"], found)
            }
            Value::Textured(of) if **of == TextureExpression::VertexColor => {
                let channel = (0_u8..).zip(CHANNELS).find(|(_, channel)| *channel == name.text);
                let number = channel.map(|(i, _)| TextureExpression::VertexChannel(i));
                let found = if name.text == "rgb" { Some(of.as_ref().clone()) } else { number };
                let found = found.map(|found| Value::Textured(Rc::new(found)));
                (&["rgb", "r", "g", "b", "a"], found)
            }
            Value::Item(Kind::Texture, id) => return self.channel(*id, name),
            _ => (&[], None),
        };
        if let Some(found) = found {
            return found;
        }
        let text = format!("{} has no `.{}`", value.described(), name.text);
        let mut error = Diagnostic::error(Code("E0309"), text).at(name.span, "not known");
        if !members.is_empty() {
            let list: Vec<String> = members.iter().map(|member| format!(".{member}")).collect();
            error = error.with_note(format!("it has {}", quoted_list(&list)));
        }
        self.fault(error)
    }

    /// Reports that a value refers to itself.
    pub(crate) fn self_reference(&mut self, name: &str, declared: Span, at: Option<Span>) -> Value {
        let text = format!("`{name}` depends on itself");
        let error = Diagnostic::error(Code("E0212"), text);
        let error = match at.filter(|at| *at != declared) {
            Some(at) => error.at(at, "needed here").because(declared, "to compute this"),
            None => error.at(declared, "its value needs itself"),
        };
        self.fault(error)
    }

    /// Asks for `srgb(...)` or `linear(...)` around a value that stands where a colour is due.
    pub(crate) fn without_space(&mut self, what: &str, value: &Value, span: Span) -> Value {
        let found = value.described();
        let error =
            Diagnostic::error(Code("E0304"), format!("{what} needs a colour, found {found}"))
                .at(span, "which colour space?");
        let text = self.sources.slice(span);
        let tuple = text.starts_with('(') && text.ends_with(')');
        let error = match value {
            Value::Hex(_) => {
                error.with_fix(Fix::sure("add the colour space", span, format!("srgb({text})")))
            }
            Value::Number(..) => {
                error.with_fix(Fix::guess("add the colour space", span, format!("linear({text})")))
            }
            Value::Vector(..) if tuple => error
                .with_fix(Fix::guess("for physical values", span, format!("linear{text}")))
                .with_fix(Fix::guess(
                    "for values picked from a screen",
                    span,
                    format!("srgb{text}"),
                )),
            _ => error
                .with_help("write `srgb(#c79a6b)`, `linear(0.2, 0.3, 0.4)` or `blackbody(4300K)`"),
        };
        self.fault(error)
    }
}

//! Calls: functions of the table, shapes, and named parts of assets.

use std::rc::Rc;

use super::function::{self, FUNCTIONS, Function, Want};
use super::value::{ShapeValue, Value};
use super::{Evaluator, Scope, with_unit_fix};
use crate::diagnostic::{Code, Diagnostic, Fix};
use crate::resolve::{Found, did_you_mean, item_kind};
use crate::scene::Shape;
use crate::schema::{self, Kind};
use crate::shape::Flaw;
use crate::source::Span;
use crate::syntax::{Arg, Expr, ExprKind, Ident, Path};
use crate::units::Dim;

impl Evaluator<'_> {
    pub(super) fn call(
        &mut self,
        path: &Path,
        args: &[Arg],
        span: Span,
        scope: Scope<'_>,
    ) -> Value {
        if path.segments.len() > 1 {
            return self.named_part(path, args, scope);
        }
        let name = &path.segments[0];
        if let Some(function) = function::find(&name.text) {
            return self.function(function, name, args, (span, scope));
        }
        if let Some(schema) = schema::find_type(Kind::Shape, &name.text) {
            let fields = self.call_fields(schema, name, args, scope);
            let shape = Shape::read(schema, &fields.lengths()).filter(|_| fields.ok);
            if let Some(Flaw { text, label, face }) = shape.as_ref().and_then(Shape::flaw) {
                let place = face.and_then(|face| fields.place_in("faces", face)).unwrap_or(span);
                return self.fault(Diagnostic::error(Code("E0401"), text).at(place, label));
            }
            return shape
                .map_or(Value::Poison, |shape| Value::Shape(Rc::new(ShapeValue::Plain(shape))));
        }
        for arg in args {
            self.eval(&arg.value, scope);
        }
        for kind in [Kind::Asset, Kind::Texture] {
            if schema::find_type(kind, &name.text).is_some() {
                let word = kind.name();
                let text = format!("`{}(...)` stands only right after `{word} name =`", name.text);
                let help = format!("declare `{word} name = {}(...)` and use the name", name.text);
                let error = Diagnostic::error(Code("E0305"), text).at(span, "not here");
                return self.fault(error.with_help(help));
            }
        }
        self.unknown_function(name)
    }

    fn unknown_function(&mut self, name: &Ident) -> Value {
        let error = Diagnostic::error(Code("E0202"), format!("no function named `{}`", name.text));
        let foreign = schema::types_of(Kind::Shape).iter().find_map(|shape| {
            shape.foreign.iter().find(|f| f.0 == name.text).map(|f| (shape.name, f.1))
        });
        if let Some((ours, from)) = foreign {
            let fix = Fix::sure(format!("in `.rts` it is `{ours}`"), name.span, ours);
            let note = format!("`{}` is the name in {from}", name.text);
            return self.fault(error.at(name.span, "not known").with_note(note).with_fix(fix));
        }
        let declared = |kind: &Kind| kind.name() == name.text;
        if let Some(kind) = [Kind::Asset, Kind::Texture].into_iter().find(declared) {
            let (word, types) = (kind.name(), schema::types_of(kind));
            let example = types.first().map_or(word, |first| first.name);
            let help = format!("it begins a declaration: `{word} name = {example}(...)`");
            return self.fault(error.at(name.span, "not a function").with_help(help));
        }
        let functions = FUNCTIONS.iter().map(|function| function.name);
        let shapes = schema::types_of(Kind::Shape).iter().map(|shape| shape.name);
        self.fault(did_you_mean(error, name, functions.chain(shapes)))
    }

    /// `shrine.part("odd name")`.
    fn named_part(&mut self, path: &Path, args: &[Arg], scope: Scope<'_>) -> Value {
        let id = match self.program.find(scope.module, path, Some(Kind::Asset)) {
            Ok(Found::Item(id, _)) => id,
            Ok(Found::Poison) => return Value::Poison,
            Err(error) => return self.fault(*error),
        };
        self.used.insert(id);
        let is_asset = item_kind(self.program.item(id)) == Some(Kind::Asset);
        let last = path.segments.last().map_or("", |name| name.text.as_str());
        let part = match args {
            [Arg { name: None, value: Expr { kind: ExprKind::Text(text), .. } }] => Some(text),
            _ => None,
        };
        match part {
            Some(text) if is_asset && last == "part" => {
                Value::Shape(Rc::new(ShapeValue::Mesh(id, Some(text.clone()), Vec::new())))
            }
            _ => {
                let error = Diagnostic::error(
                    Code("E0202"),
                    format!("no function named `{}`", path.text()),
                )
                .at(path.span, "not known")
                .with_help("a part of an asset is `name.part(\"its name\")`");
                self.fault(error)
            }
        }
    }

    fn function(
        &mut self,
        function: &'static Function,
        name: &Ident,
        args: &[Arg],
        (span, scope): (Span, Scope<'_>),
    ) -> Value {
        let Some(order) = self.match_arguments(function, name, args, scope) else {
            return Value::Poison;
        };
        let mut values: Vec<Value> = Vec::with_capacity(order.len());
        let mut poisoned = false;
        for (i, expr) in order.iter().enumerate() {
            let value = self.eval(expr, scope);
            let param = &function.params[i.min(function.params.len() - 1)];
            let value = self.argument(function, *param, (value, expr), values.first());
            poisoned |= value == Value::Poison;
            values.push(value);
        }
        if poisoned {
            return Value::Poison;
        }
        match (function.run)(&values) {
            Ok(value) => value,
            Err(why) => {
                let error = Diagnostic::error(Code("E0402"), format!("`{}`: {why}", function.name));
                self.number_fault(error.at(span, "here"))
            }
        }
    }

    /// Puts arguments in the order of the parameters; `None` if that fails.
    fn match_arguments<'e>(
        &mut self,
        function: &Function,
        name: &Ident,
        args: &'e [Arg],
        scope: Scope<'_>,
    ) -> Option<Vec<&'e Expr>> {
        let n = function.params.len();
        let mut slots: Vec<Option<&'e Expr>> = vec![None; n.max(args.len())];
        let mut next = 0;
        let mut fine = true;
        for arg in args {
            let slot = match &arg.name {
                None => {
                    next += 1;
                    Some(next - 1)
                }
                Some(label) => {
                    let found = function.params.iter().position(|(param, _)| *param == label.text);
                    if found.is_none() {
                        let text = format!("`{}` has no argument `{}`", function.name, label.text);
                        let names = function.params.iter().map(|(param, _)| *param);
                        let error = Diagnostic::error(Code("E0201"), text);
                        self.fault(did_you_mean(error, label, names));
                    }
                    found
                }
            };
            match slot.and_then(|slot| slots.get_mut(slot)) {
                Some(free @ None) => *free = Some(&arg.value),
                Some(Some(_)) => {
                    fine = false;
                    let text = format!("this argument of `{}` is given twice", function.name);
                    self.fault(Diagnostic::error(Code("E0204"), text).at(arg.value.span, "again"));
                }
                None => fine = false,
            }
        }
        let given = slots.iter().filter(|slot| slot.is_some()).count();
        let enough =
            given == n || (function.more && given > n) || (function.one_or_all && given == 1);
        if fine && !(enough && slots[..given].iter().all(Option::is_some)) {
            fine = false;
            let wanted = match (n, function.one_or_all, function.more) {
                (1, ..) => "1 argument".to_owned(),
                (_, true, _) => format!("1 or {n} arguments"),
                (_, _, true) => format!("{n} or more arguments"),
                _ => format!("{n} arguments"),
            };
            let text = format!("`{}` takes {wanted}, found {}", function.name, args.len());
            let error = Diagnostic::error(Code("E0306"), text)
                .at(name.span, "")
                .with_note(format!("it is `{}`", function.signature()));
            self.fault(error);
        }
        if !fine {
            for arg in args {
                self.eval(&arg.value, scope);
            }
            return None;
        }
        slots.truncate(given);
        slots.into_iter().collect()
    }

    /// Checks one argument.
    fn argument(
        &mut self,
        function: &Function,
        (param, want): (&'static str, Want),
        (value, expr): (Value, &Expr),
        first: Option<&Value>,
    ) -> Value {
        let like = first.and_then(Value::dim).unwrap_or(Dim::NONE);
        let first_poisoned = first == Some(&Value::Poison);
        let what = format!("`{param}` of `{}`", function.name);
        let wanted = match want {
            Want::Number(dim) => dim,
            Want::LikeFirst | Want::VectorLikeFirst => like,
            Want::ColorParts | Want::Share => Dim::NONE,
            Want::AnyNumber | Want::Measure | Want::Vector | Want::Blend => {
                value.dim().unwrap_or(Dim::NONE)
            }
        };
        let vector = matches!(want, Want::Vector | Want::VectorLikeFirst);
        match &value {
            Value::Poison => return value,
            Value::Number(_, dim)
                if !vector && (*dim == wanted || (first_poisoned && want == Want::LikeFirst)) =>
            {
                return value;
            }
            Value::Vector(values, dim)
                if (vector || want == Want::ColorParts)
                    && values.len() == 3
                    && (*dim == wanted || first_poisoned) =>
            {
                return value;
            }
            Value::Hex(_) if want == Want::ColorParts => return value,
            Value::Vector(..) | Value::Color(_) | Value::TextureColor(_) if want == Want::Blend => {
                return value;
            }
            Value::TextureChannel(..) | Value::Textured(_)
                if matches!(want, Want::Blend | Want::Share | Want::Measure) =>
            {
                return value;
            }
            _ => {}
        }
        self.wrong_argument(&what, (vector, wanted), &value, expr)
    }

    fn wrong_argument(
        &mut self,
        what: &str,
        (vector, wanted): (bool, Dim),
        value: &Value,
        expr: &Expr,
    ) -> Value {
        let needs = if vector { wanted.several(3) } else { wanted.to_string() };
        let text = format!("{what} needs {needs}, found {}", value.described());
        let error = |code| Diagnostic::error(Code(code), text);
        match value.dim() {
            Some(Dim::NONE) if !wanted.is_none() => {
                let unit = if wanted == Dim::ANGLE { "deg" } else { "" };
                let error = error("E0301").at(expr.span, "no unit");
                self.fault(with_unit_fix(error, expr, wanted, unit))
            }
            Some(own) if own != wanted => {
                self.fault(error("E0302").at(expr.span, value.described()))
            }
            _ => {
                let error = error("E0305").at(expr.span, value.described());
                self.fault(super::operator::axis_advice(error, value))
            }
        }
    }
}

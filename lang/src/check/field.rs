//! One value against what its field wants: type, dimension, range, texture space.

use super::{group, keys, lint};
use crate::diagnostic::{Code, Diagnostic, Fix};
use crate::eval::value::Value;
use crate::eval::{Evaluator, Scope, with_unit_fix};
use crate::resolve::{did_you_mean, quoted_list};
use crate::schema::{
    Bounds, Default, Field, FieldType, Kind, MAX_FILM_SIDE, TypeSchema, Word, type_text,
};
use crate::source::Span;
use crate::syntax::{Entry, Expr, ExprKind, Ident, Path};
use crate::texture::TextureExpression;
use crate::units::{self, Dim};

/// Where a value is going.
#[derive(Clone, Copy)]
pub(super) struct Slot<'e> {
    pub(super) schema: &'static TypeSchema,
    pub(super) field: &'static Field,
    pub(super) expr: &'e Expr,
    pub(super) module: u32,
}

impl Slot<'_> {
    pub(super) fn span(&self) -> Span {
        self.expr.span
    }

    /// `` `ring.width` ``.
    pub(super) fn name(&self) -> String {
        format!("`{}`", self.field.name)
    }

    /// What the field is and what people write, for a note.
    fn note(&self, is: &str) -> String {
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

    fn word(&mut self, slot: Slot<'_>, name: &Ident) -> Value {
        match slot.field.ty {
            FieldType::Word(words)
            | FieldType::Words(words)
            | FieldType::IntegerOr(_, _, words) => self.one_of(slot, words, name),
            FieldType::Axis => {
                let known = ["x", "y", "z"].contains(&name.text.as_str());
                let error =
                    Diagnostic::error(Code("E0308"), format!("{} needs a sign", slot.name()));
                let error = error.at(name.span, "which way?");
                self.fault(if known {
                    let text = format!("+{}", name.text);
                    error.with_fix(Fix::guess(format!("write `{text}`"), name.span, text))
                } else {
                    error.with_note("an axis is `+x`, `-x`, `+y`, `-y`, `+z` or `-z`")
                })
            }
            _ => match units::find(&name.text).filter(|unit| unit.dim == Dim::LENGTH) {
                Some(unit) => Value::Number(unit.factor, Dim::LENGTH),
                None => self.unknown_length_unit(slot, name),
            },
        }
    }

    fn unknown_length_unit(&mut self, slot: Slot<'_>, name: &Ident) -> Value {
        let text = format!("{} needs a unit of length, found `{}`", slot.name(), name.text);
        let error = Diagnostic::error(Code("E0303"), text);
        if let Some(metric) = units::not_metric(&name.text) {
            let fix = Fix::sure(format!("write `{metric}`"), name.span, metric);
            return self.fault(error.at(name.span, "not metric").with_fix(fix));
        }
        let lengths: Vec<&str> =
            units::UNITS.iter().filter(|u| u.dim == Dim::LENGTH).map(|u| u.symbol).collect();
        let error = match units::other_spelling(&name.text).filter(|ours| lengths.contains(ours)) {
            Some(ours) => error
                .at(name.span, format!("did you mean `{ours}`?"))
                .with_fix(Fix::sure(format!("write `{ours}`"), name.span, ours)),
            None => error.at(name.span, "not known"),
        };
        self.fault(error.with_note(format!("the units of length are {}", lengths.join(" "))))
    }

    fn one_of(&mut self, slot: Slot<'_>, words: &'static [Word], name: &Ident) -> Value {
        if let Some((word, _)) = words.iter().find(|(word, _)| *word == name.text) {
            return Value::Word(word);
        }
        let text = format!("{} cannot be `{}`", slot.name(), name.text);
        let all: Vec<String> = words.iter().map(|(word, _)| (*word).to_owned()).collect();
        let error = Diagnostic::error(Code("E0308"), text);
        let error = did_you_mean(error, name, words.iter().map(|(word, _)| *word));
        let is = match slot.field.ty {
            FieldType::IntegerOr(..) => format!("a {}", type_text(slot.field.ty)),
            _ => format!("one of {}", quoted_list(&all)),
        };
        self.fault(error.with_note(format!("it is {is}")))
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

    fn fit_number(&mut self, slot: Slot<'_>, value: Value, bounds: Bounds) -> Value {
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
    fn fit_quantity(
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

    fn in_bounds(&mut self, slot: Slot<'_>, number: f64, bounds: Bounds) -> Option<()> {
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
    fn wrong_dimension(
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

    fn fit_integer(&mut self, slot: Slot<'_>, value: &Value, [min, max]: [u32; 2]) -> Value {
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

    fn fit_vector(
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
    fn fit_spectrum(&mut self, slot: Slot<'_>, value: Value, bounds: Bounds) -> Value {
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

    fn fit_size(&mut self, slot: Slot<'_>, value: Value, n: usize) -> Value {
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

    fn fit_pixels(&mut self, slot: Slot<'_>, value: Value) -> Value {
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

    pub(super) fn wrong_kind(&mut self, slot: Slot<'_>, value: &Value, wanted: &str) -> Value {
        self.wrong_kind_at(slot, slot.span(), value, wanted)
    }

    /// The same of a part of the value, at `span`.
    pub(super) fn wrong_kind_at(
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

    fn fit_interval(&mut self, slot: Slot<'_>, value: Value, bounds: Bounds) -> Value {
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

    fn fit_text(&mut self, slot: Slot<'_>, value: Value) -> Value {
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

    fn fit_scale(&mut self, slot: Slot<'_>, value: Value) -> Value {
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

/// No limit but those of the language; the lower end is zero.
pub(super) fn any(dim: Dim, unit: &'static str) -> Bounds {
    Bounds { dim, unit, min: 0.0, above_min: false, max: f64::INFINITY }
}

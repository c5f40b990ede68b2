//! Values that name something: colours from textures, channels, shapes and groups.

use std::collections::BTreeMap;
use std::rc::Rc;

use super::field::{Slot, any};
use crate::diagnostic::{Code, Diagnostic, Edit, Fix};
use crate::eval::Evaluator;
use crate::eval::textured::Expression;
use crate::eval::value::{ShapeValue, Value};
use crate::resolve::ItemId;
use crate::scene::ColorSpace;
use crate::schema::{Bounds, FieldType, Kind};
use crate::source::Span;
use crate::syntax::ExprKind;
use crate::units::{self, Dim};

impl Evaluator<'_> {
    pub(super) fn fit_color(&mut self, slot: Slot<'_>, value: Value, max: f64) -> Value {
        match &value {
            Value::Color(rgb) => {
                let bounds = Bounds { max, min: 0.0, ..any(Dim::NONE, "") };
                match rgb.iter().find(|c| !bounds.contains(**c)) {
                    None => value,
                    Some(wrong) => {
                        let range = bounds.described();
                        let wrong = units::show_number(*wrong);
                        let text = format!(
                            "each channel of {} must be {range}, found {wrong}",
                            slot.name()
                        );
                        let error = Diagnostic::error(Code("E0401"), text).at(slot.span(), range);
                        self.number_fault(if bounds.is_share() {
                            error.with_note("a surface cannot reflect more light than it gets")
                        } else {
                            error
                        })
                    }
                }
            }
            Value::Hex(_) | Value::Number(_, Dim::NONE) | Value::Vector(_, Dim::NONE) => {
                self.without_space(&slot.name(), &value, slot.span())
            }
            Value::TextureColor(_)
            | Value::TextureChannel(..)
            | Value::Textured(_)
            | Value::Item(Kind::Texture, _) => {
                let wanted = match slot.field.ty {
                    FieldType::ColorSlot(_) => "a colour: of a texture that is `.rgb`",
                    _ => "one colour, which no texture is",
                };
                self.wrong_kind(slot, &value, wanted)
            }
            _ => self.wrong_kind(slot, &value, "a colour"),
        }
    }

    /// A texture must be read as what its image holds.
    pub(super) fn fit_texture(
        &mut self,
        slot: Slot<'_>,
        id: ItemId,
        value: Value,
        wants_color: bool,
    ) -> Value {
        let Some(info) = self.textures.get(&id) else { return Value::Poison };
        let (wants, write) = match (wants_color, info.space) {
            (true, ColorSpace::Data) => ("a colour", "srgb"),
            (false, ColorSpace::Srgb) => ("linear data", "data"),
            _ => return value,
        };
        let tagged = match info.space {
            ColorSpace::Srgb => "sRGB",
            ColorSpace::Linear => "linear colour",
            ColorSpace::Data => "data",
        };
        let used = match slot.field.ty {
            FieldType::NormalSlot => "a normal map",
            _ => wants,
        };
        let text = format!("{} wants {wants}, but this image is tagged {tagged}", slot.name());
        let mut error = Diagnostic::error(Code("E0601"), text)
            .at(slot.span(), format!("used as {used} here"))
            .because(info.space_span, "tagged here")
            .with_fix(Fix::guess(format!("write `space: {write}`"), info.space_value, write));
        if let Some(import) = self.program.import_span(slot.module, id.module) {
            error = error.because(import, "imported from here");
        }
        self.fault(error)
    }

    /// An expression of textures: its kind, what its images hold, and the numbers that it can reach.
    pub(super) fn fit_textured(
        &mut self,
        slot: Slot<'_>,
        of: &Rc<Expression>,
        bounds: Bounds,
        wants_color: bool,
    ) -> Value {
        let value = Value::Textured(Rc::clone(of));
        if of.is_color() != wants_color {
            let wanted = if wants_color { "a colour" } else { "a number" };
            return self.wrong_kind(slot, &value, wanted);
        }
        for (id, channel) in of.images() {
            // Alpha is linear in every image.
            if channel != Some(3)
                && self.fit_texture(slot, *id, Value::Default, channel.is_none()) == Value::Poison
            {
                return Value::Poison;
            }
        }
        let range = of.range();
        let Some(wrong) = range.into_iter().find(|x| !bounds.contains(*x)) else { return value };
        let wanted = bounds.described();
        let wrong = units::show_number(wrong);
        let text = format!("{} must be {wanted}, but this can be {wrong}", slot.name());
        let error = Diagnostic::error(Code("E0401"), text).at(slot.span(), wanted);
        let help =
            if wants_color { "use other factors" } else { "write `clamp(..., 0, 1)` around it" };
        self.number_fault(error.with_help(help))
    }

    /// Asks for a channel of a colour; `id`: the image, if it is one.
    pub(super) fn which_channel(&mut self, slot: Slot<'_>, id: Option<ItemId>) -> Value {
        let text = format!("{} needs one channel of the texture", slot.name());
        let mut error = Diagnostic::error(Code("E0203"), text).at(slot.span(), "which channel?");
        let mut fix = match &slot.expr.kind {
            ExprKind::Path(path) if path.segments.last().is_some_and(|s| s.text == "rgb") => {
                let last = path.segments.last().map_or(slot.span(), |s| s.span);
                Fix::guess("take red", last, "r")
            }
            _ => Fix::guess("take red", slot.span().after(), ".r"),
        };
        let info = id.and_then(|id| self.textures.get(&id));
        if let Some(info) = info.filter(|info| info.space == ColorSpace::Srgb) {
            let mut edits = fix.edits;
            edits.push(Edit { span: info.space_value, replacement: "data".to_owned() });
            let message = "take red, of an image that is read as data".to_owned();
            fix = Fix { message, edits, ..fix };
            error = error.because(info.space_span, "sRGB is for colours");
        }
        let error = error.with_fix(fix);
        self.fault(error.with_note("a texture has `.r`, `.g`, `.b` and `.a`"))
    }

    pub(super) fn fit_shape(&mut self, slot: Slot<'_>, value: Value) -> Value {
        let wanted = "a shape, an asset, an object or a list of objects";
        match value {
            Value::Shape(_) => value,
            Value::Item(Kind::Asset, id) => {
                Value::Shape(Rc::new(ShapeValue::Mesh(id, None, Vec::new())))
            }
            Value::Item(Kind::Object, id) => {
                Value::Shape(Rc::new(ShapeValue::Object(id, slot.span())))
            }
            Value::List(entries) => self.fit_group(slot, &entries),
            other => self.wrong_kind(slot, &other, wanted),
        }
    }

    /// A list of objects. The first entry that is wrong speaks for all.
    fn fit_group(&mut self, slot: Slot<'_>, entries: &[(Value, Span)]) -> Value {
        if !self.spend(10 * entries.len(), slot.span()) {
            return Value::Poison;
        }
        let mut seen: BTreeMap<ItemId, Span> = BTreeMap::new();
        let mut objects: Vec<(ItemId, Span)> = Vec::with_capacity(entries.len());
        for (value, span) in entries {
            let id = match value {
                Value::Poison => return Value::Poison,
                Value::Item(Kind::Object, id) => *id,
                other => {
                    let text = format!("a group holds objects, not {}", other.described());
                    let error = Diagnostic::error(Code("E0203"), text)
                        .at(*span, other.described())
                        .with_help("declare an `object` with this shape and list its name");
                    return self.fault(error);
                }
            };
            if let Some(first) = seen.insert(id, *span) {
                let error = Diagnostic::error(Code("E0204"), "this object is listed twice")
                    .at(*span, "again")
                    .because(first, "first listed here")
                    .with_note("both would stand in the same place");
                return self.fault(error);
            }
            objects.push((id, *span));
        }
        if objects.is_empty() {
            let text = format!("{} is an empty list", slot.name());
            let error = Diagnostic::error(Code("E0305"), text).at(slot.span(), "no objects");
            return self.fault(error);
        }
        Value::Shape(Rc::new(ShapeValue::Objects(objects)))
    }
}

//! Fields in words: types, ranges and defaults as pages and messages write them.

use super::bounds::Bounds;
use super::field::{Default, Field, FieldType, Word};
use super::limits::{MAX_FILM_SIDE, MAX_GROUP};
use crate::units::{self, Dim};

/// Dimension and suggested unit of a field that holds numbers; `None` for others.
#[must_use]
pub fn unit_of(ty: FieldType) -> Option<(Dim, &'static str)> {
    match ty {
        FieldType::Number(b)
        | FieldType::ScalarSlot(b)
        | FieldType::Spectrum(b)
        | FieldType::Interval(b) => Some((b.dim, b.unit)),
        FieldType::Quantity(choices) => choices.first().copied(),
        FieldType::Integer(..) | FieldType::IntegerOr(..) | FieldType::Scale | FieldType::Faces => {
            Some((Dim::NONE, ""))
        }
        FieldType::Vector(dim, unit) | FieldType::Keyed(dim, unit) => Some((dim, unit)),
        FieldType::Size(_) | FieldType::Points => Some((Dim::LENGTH, "m")),
        FieldType::Pixels => Some((Dim::PIXEL, "px")),
        FieldType::Color(_)
        | FieldType::ColorSlot(_)
        | FieldType::NormalSlot
        | FieldType::Word(_)
        | FieldType::Words(_)
        | FieldType::Name(_)
        | FieldType::Names(_)
        | FieldType::Shape
        | FieldType::Text
        | FieldType::Path
        | FieldType::Group
        | FieldType::Axis
        | FieldType::LengthUnit => None,
    }
}

/// Short, for tables: `length`, `colour or texture`, `none | reinhard | aces`.
#[must_use]
pub fn type_text(ty: FieldType) -> String {
    let noun = |dim: Dim| {
        let text = dim.to_string();
        text.trim_start_matches("a plain ")
            .trim_start_matches("an ")
            .trim_start_matches("a ")
            .to_owned()
    };
    match ty {
        FieldType::Number(b) => noun(b.dim),
        FieldType::Quantity(choices) => {
            choices.iter().map(|(dim, _)| noun(*dim)).collect::<Vec<_>>().join(" or ")
        }
        FieldType::Integer(..) => "whole number".to_owned(),
        FieldType::IntegerOr(_, _, words) => format!("whole number or {}", either(words)),
        FieldType::Vector(Dim::NONE, _) => "three numbers".to_owned(),
        FieldType::Spectrum(b) => format!("{}, or three", noun(b.dim)),
        FieldType::Vector(dim, _) => dim.several(3),
        FieldType::Keyed(dim, _) => format!("{}, or keys of them", dim.several(3)),
        FieldType::Size(n) => format!("{n} lengths"),
        FieldType::Points => "list of points".to_owned(),
        FieldType::Faces => "list of faces".to_owned(),
        FieldType::Pixels => "width and height in pixels".to_owned(),
        FieldType::Color(_) => "colour".to_owned(),
        FieldType::ColorSlot(_) => "colour or texture".to_owned(),
        FieldType::ScalarSlot(_) => "number or texture channel".to_owned(),
        FieldType::NormalSlot => "texture".to_owned(),
        FieldType::Word(words) => either(words),
        FieldType::Words(_) => "list of words".to_owned(),
        FieldType::Name(kind) => format!("name of {}", kind.with_article()),
        FieldType::Names(kind) => format!("list of names of {}s", kind.name()),
        FieldType::Shape => "shape, object, or list of objects".to_owned(),
        FieldType::Interval(b) => format!("interval of {}", noun(b.dim)),
        FieldType::Text => "text".to_owned(),
        FieldType::Path => "path".to_owned(),
        FieldType::Group => "name in quotes".to_owned(),
        FieldType::Scale => "number or three numbers".to_owned(),
        FieldType::Axis => "axis".to_owned(),
        FieldType::LengthUnit => "unit of length".to_owned(),
    }
}

/// `` `box` or `tent` ``.
fn either(words: &[Word]) -> String {
    words.iter().map(|(word, _)| format!("`{word}`")).collect::<Vec<_>>().join(" or ")
}

/// The allowed range in words, or empty.
#[must_use]
pub fn range_text(ty: FieldType) -> String {
    match ty {
        FieldType::Number(b) | FieldType::ScalarSlot(b) | FieldType::Interval(b) => {
            let text = b.described();
            if text == "any value" { String::new() } else { text }
        }
        FieldType::Spectrum(b) => format!("each {}", b.described()),
        FieldType::Quantity(_) => "at least 0".to_owned(),
        FieldType::Integer(min, max) | FieldType::IntegerOr(min, max, _) => {
            format!("between {min} and {max}")
        }
        FieldType::Size(_) => "each above 0m".to_owned(),
        FieldType::Pixels => format!("each between 1px and {MAX_FILM_SIDE}px"),
        FieldType::Color(max) | FieldType::ColorSlot(max) if max.is_finite() => {
            format!("each channel between 0 and {max}")
        }
        FieldType::Color(_) | FieldType::ColorSlot(_) => "each channel at least 0".to_owned(),
        FieldType::Scale => "not zero".to_owned(),
        FieldType::Group => format!("letters, digits, `_` and `-`, at most {MAX_GROUP}"),
        FieldType::Vector(..)
        | FieldType::Keyed(..)
        | FieldType::Points
        | FieldType::Faces
        | FieldType::NormalSlot
        | FieldType::Word(_)
        | FieldType::Words(_)
        | FieldType::Name(_)
        | FieldType::Names(_)
        | FieldType::Shape
        | FieldType::Text
        | FieldType::Path
        | FieldType::Axis
        | FieldType::LengthUnit => String::new(),
    }
}

/// The default as it would be written in `.rts`, or a sentence, or `required`.
#[must_use]
pub fn default_text(field: &Field) -> String {
    let (dim, unit) = unit_of(field.ty).unwrap_or((Dim::NONE, ""));
    let bounds = Bounds::new(dim, unit, f64::NEG_INFINITY, f64::INFINITY);
    match field.default {
        Default::Required => "required".to_owned(),
        Default::Number(value) => format!("`{}`", bounds.show(value)),
        Default::Vector([x, y, z]) => {
            let factor = units::parse(unit).map_or(1.0, |(_, factor)| factor);
            let number = |value: f64| units::show_number(value / factor);
            format!("`({}, {}, {}){unit}`", number(x), number(y), number(z))
        }
        Default::Pixels([w, h]) => format!("`({w}, {h})px`"),
        Default::Color(rgb) => format!("`{}`", color_text(rgb)),
        Default::Word(word) => format!("`{word}`"),
        Default::Interval(a, b) => format!("`{}..{}`", bounds.show(a), bounds.show(b)),
        Default::Absent(text) => text.to_owned(),
    }
}

/// A linear colour as `.rts` text.
#[must_use]
#[expect(clippy::float_cmp, reason = "only exact greys may be written as one number")]
pub fn color_text([r, g, b]: [f64; 3]) -> String {
    let number = units::show_number;
    if r == g && g == b {
        format!("linear({})", number(r))
    } else {
        format!("linear({}, {}, {})", number(r), number(g), number(b))
    }
}

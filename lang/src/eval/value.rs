//! What an expression comes to: numbers with dimensions, colours, names of declarations.

use std::rc::Rc;

use crate::resolve::ItemId;
use crate::scene::{Axis, Rgb, Shape};
use crate::schema::Kind;
use crate::shape::MeshEdit;
use crate::source::Span;
use crate::texture::TextureExpression;
use crate::units::{self, Dim};

/// The value of an expression. `Poison` stands for a fault that has been reported; it fits
/// everywhere, so that one fault gives one message. Copies are cheap.
#[derive(Clone, Debug, PartialEq)]
pub(crate) enum Value {
    /// Already reported.
    Poison,
    /// A number in SI.
    Number(f64, Dim),
    /// Two to four numbers of one dimension in SI.
    Vector(Vec<f64>, Dim),
    /// Yes or no.
    Bool(bool),
    /// A text in quotes.
    Text(Rc<str>),
    /// Linear Rec. 709.
    Color(Rgb),
    /// `#c79a6b` without a space.
    Hex([u8; 3]),
    /// A signed axis.
    Axis(Axis),
    /// `a..b` in SI.
    Range(f64, f64, Dim),
    /// A word of a field's own list.
    Word(&'static str),
    /// A whole number of a field that wants one.
    Integer(u32),
    /// The name of a declaration.
    Item(Kind, ItemId),
    /// `.rgb` of a texture.
    TextureColor(ItemId),
    /// One channel of a texture, 0 red … 3 alpha.
    TextureChannel(ItemId, u8),
    /// What is computed from textures.
    Textured(Rc<TextureExpression<ItemId>>),
    /// Geometry.
    Shape(Rc<ShapeValue>),
    /// `[0ms: (0, 0, 0)m, 20ms: (1, 0, 0)m]`: times and numbers in SI, in order of time.
    Keys(Rc<[Key]>, Dim),
    /// `[a, b]`, with the place of each entry.
    List(Rc<[(Value, Span)]>),
    /// `default`.
    Default,
    /// `none`.
    None,
}

/// A time and three numbers, in SI.
pub(crate) type Key = (f64, [f64; 3]);

/// Geometry of an object or an instance.
#[derive(Clone, Debug, PartialEq)]
pub(crate) enum ShapeValue {
    /// A shape that needs no file.
    Plain(Shape),
    /// A mesh file or one part of it, with what is changed.
    Mesh(ItemId, Option<String>, Vec<MeshEdit<ItemId>>),
    /// Another object, with the place where it is named.
    Object(ItemId, Span),
    /// A group, each member with the place where it is named.
    Objects(Vec<(ItemId, Span)>),
}

impl Value {
    /// A plain number.
    pub(crate) fn plain(value: f64) -> Self {
        Self::Number(value, Dim::NONE)
    }

    /// With its article, as it stands in a message.
    pub(crate) fn described(&self) -> String {
        match self {
            Self::Poison => "an unknown value".to_owned(),
            Self::Number(_, dim) => dim.to_string(),
            Self::Vector(items, dim) => dim.several(items.len()),
            Self::Bool(_) => "`true` or `false`".to_owned(),
            Self::Text(_) => "a text".to_owned(),
            Self::Color(_) => "a colour".to_owned(),
            Self::Hex(_) => "a colour without a space".to_owned(),
            Self::Axis(_) => "an axis".to_owned(),
            Self::Range(_, _, dim) => format!("an interval between {}", dim.several(2)),
            Self::Word(word) => format!("the word `{word}`"),
            Self::Integer(_) => "a whole number".to_owned(),
            Self::Item(kind, _) => kind.with_article().to_owned(),
            Self::TextureColor(_) => "the colour of a texture".to_owned(),
            Self::TextureChannel(..) => "a channel of a texture".to_owned(),
            Self::Textured(of) if of.is_color() => "a colour of textures".to_owned(),
            Self::Textured(_) => "a number of textures".to_owned(),
            Self::Shape(_) => "a shape".to_owned(),
            Self::Keys(..) => "keys".to_owned(),
            Self::List(_) => "a list".to_owned(),
            Self::Default => "`default`".to_owned(),
            Self::None => "`none`".to_owned(),
        }
    }

    /// Whether it varies over a surface.
    pub(crate) fn is_textured(&self) -> bool {
        matches!(self, Self::TextureColor(_) | Self::TextureChannel(..) | Self::Textured(_))
    }

    /// The dimension of a number or a vector.
    pub(crate) fn dim(&self) -> Option<Dim> {
        match self {
            Self::Number(_, dim)
            | Self::Vector(_, dim)
            | Self::Range(_, _, dim)
            | Self::Keys(_, dim) => Some(*dim),
            _ => None,
        }
    }

    /// Every number in it is finite and below the size limit.
    pub(crate) fn is_sound(&self) -> bool {
        let sound = |v: &f64| v.abs() <= crate::schema::MAX_MAGNITUDE;
        match self {
            Self::Number(value, _) => sound(value),
            Self::Vector(values, _) => values.iter().all(sound),
            Self::Color(rgb) => rgb.iter().all(sound),
            Self::Range(a, b, _) => sound(a) && sound(b),
            Self::Keys(keys, _) => keys.iter().all(|(time, v)| sound(time) && v.iter().all(sound)),
            Self::Textured(of) => of.range().iter().all(sound),
            _ => true,
        }
    }

    /// The number as a user would write it, for messages.
    pub(crate) fn shown(&self) -> String {
        match self {
            Self::Number(value, dim) => units::show(*value, *dim),
            Self::Vector(values, dim) => {
                let items: Vec<String> = values.iter().map(|v| units::show(*v, *dim)).collect();
                format!("({})", items.join(", "))
            }
            Self::Bool(value) => value.to_string(),
            Self::Text(text) => format!("\"{text}\""),
            Self::Color(rgb) => crate::schema::color_text(*rgb),
            Self::Range(a, b, dim) => {
                format!("{}..{}", units::show(*a, *dim), units::show(*b, *dim))
            }
            other => other.described(),
        }
    }
}

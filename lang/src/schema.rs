//! What the one table of the language is made of: kinds, types, and fields with unit, range, default and doc.
//!
//! Checking, `rtc explain`, the resolved listing and `docs/reference.md` all read that table, so a
//! field that is not in it does not exist anywhere; `table` has it whole. It does not know the syntax tree or values.

use crate::units::{self, Dim};

/// The types of a kind: one list becomes the table of their schemas and the enum to match on, so that a type
/// that nothing is made of does not compile.
macro_rules! types {
    ($name:ident { $($variant:ident = $schema:ident),* $(,)? }) => {
        pub(crate) const TYPES: &[&$crate::schema::TypeSchema] = &[$(&$schema),*];

        /// The types of this kind.
        #[derive(Clone, Copy, Debug, PartialEq, Eq)]
        pub(crate) enum $name { $($variant),* }

        impl $name {
            /// The type that `schema` describes.
            pub(crate) fn of(schema: &$crate::schema::TypeSchema) -> Self {
                $(if schema.name == $schema.name { return Self::$variant; })*
                unreachable!("`{}` is no type of this kind", schema.name)
            }
        }
    };
}

/// Words of a field: one list becomes the table that is checked and shown, and an enum.
macro_rules! words {
    ($(#[$meta:meta])* pub enum $name:ident {
        $($(#[$row:meta])* $variant:ident = $word:literal $doc:literal,)*
    }) => {
        $(#[$meta])*
        #[derive(Clone, Copy, Debug, PartialEq, Eq)]
        pub enum $name { $($(#[$row])* $variant,)* }

        impl $name {
            /// Every word and what it means.
            pub(crate) const WORDS: &[$crate::schema::Word] = &[$(($word, $doc)),*];

            /// The one that is written so.
            pub(crate) fn of(word: &str) -> Option<Self> {
                $(if word == $word { return Some(Self::$variant); })*
                None
            }

            /// As it is written.
            #[must_use]
            pub fn word(self) -> &'static str {
                match self { $(Self::$variant => $word,)* }
            }
        }
    };
}
pub(crate) use {types, words};

pub(crate) mod asset;
pub(crate) mod camera;
pub(crate) mod film;
pub(crate) mod instance;
pub(crate) mod light;
mod render;
mod table;
pub(crate) mod texture;

pub use table::{all_types, find_type, types_of};

/// What a declaration is, or what a call makes.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Kind {
    /// A mesh file.
    Asset,
    /// An image file.
    Texture,
    /// How a surface scatters and emits.
    Material,
    /// What fills the inside of things, and the space around them.
    Medium,
    /// Geometry; only ever a value, never a declaration.
    Shape,
    /// A reusable thing.
    Object,
    /// A thing in the world.
    Instance,
    /// A light source without a mesh.
    Light,
    /// What a ray sees that leaves the scene.
    Sky,
    /// The eye.
    Camera,
    /// The picture.
    Film,
    /// How the picture is made.
    Render,
}

impl Kind {
    /// Every kind, in the order of the reference.
    pub const ALL: [Self; 12] = [
        Self::Asset,
        Self::Texture,
        Self::Material,
        Self::Medium,
        Self::Shape,
        Self::Object,
        Self::Instance,
        Self::Light,
        Self::Sky,
        Self::Camera,
        Self::Film,
        Self::Render,
    ];

    /// The keyword of its declarations.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Asset => "asset",
            Self::Texture => "texture",
            Self::Material => "material",
            Self::Medium => "medium",
            Self::Shape => "shape",
            Self::Object => "object",
            Self::Instance => "instance",
            Self::Light => "light",
            Self::Sky => "sky",
            Self::Camera => "camera",
            Self::Film => "film",
            Self::Render => "render",
        }
    }

    /// The kind with this keyword.
    #[must_use]
    pub fn from_name(name: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|kind| kind.name() == name)
    }

    /// With its article, as it stands in a message.
    #[must_use]
    pub fn with_article(self) -> &'static str {
        match self {
            Self::Asset => "an asset",
            Self::Texture => "a texture",
            Self::Material => "a material",
            Self::Medium => "a medium",
            Self::Shape => "a shape",
            Self::Object => "an object",
            Self::Instance => "an instance",
            Self::Light => "a light",
            Self::Sky => "a sky",
            Self::Camera => "a camera",
            Self::Film => "a film",
            Self::Render => "a render",
        }
    }
}

/// One type of a kind, such as `diffuse` of `material`.
#[derive(Debug)]
pub struct TypeSchema {
    /// The kind it belongs to.
    pub kind: Kind,
    /// Its name after the colon or as a call; empty for kinds without types.
    pub name: &'static str,
    /// One or two sentences.
    pub doc: &'static str,
    /// A declaration that compiles, for the reference.
    pub example: &'static str,
    /// Its fields, in the order in which they are best written.
    pub fields: &'static [Field],
    /// Names that other renderers give this type, with the renderers.
    pub foreign: &'static [(&'static str, &'static str)],
}

impl TypeSchema {
    /// The field of this name.
    #[must_use]
    pub fn field(&self, name: &str) -> Option<&'static Field> {
        self.fields.iter().find(|field| field.name == name)
    }

    /// `material.diffuse`, `film`.
    #[must_use]
    pub fn path(&self) -> String {
        if self.name.is_empty() {
            self.kind.name().to_owned()
        } else {
            format!("{}.{}", self.kind.name(), self.name)
        }
    }

    /// As it stands in a message: ``material type `diffuse` ``, `film`.
    #[must_use]
    pub fn described(&self) -> String {
        match (self.name, self.kind) {
            ("", kind) => format!("`{}`", kind.name()),
            (name, Kind::Asset | Kind::Texture | Kind::Shape) => format!("`{name}(...)`"),
            (name, kind) => format!("{} type `{name}`", kind.name()),
        }
    }
}

/// One field of a type, or one argument of a call.
#[derive(Clone, Copy, Debug)]
pub struct Field {
    /// Its name, dots included.
    pub name: &'static str,
    /// What may be assigned.
    pub ty: FieldType,
    /// What holds when it is not written.
    pub default: Default,
    /// One sentence.
    pub doc: &'static str,
    /// What people usually write; may be empty.
    pub typical: &'static str,
    /// Names that other renderers give this field, with the renderers.
    pub foreign: &'static [(&'static str, &'static str)],
}

impl Field {
    pub(crate) const fn new(
        name: &'static str,
        ty: FieldType,
        default: Default,
        doc: &'static str,
    ) -> Self {
        Self { name, ty, default, doc, typical: "", foreign: &[] }
    }

    pub(crate) const fn typical(mut self, typical: &'static str) -> Self {
        self.typical = typical;
        self
    }

    pub(crate) const fn foreign(
        mut self,
        foreign: &'static [(&'static str, &'static str)],
    ) -> Self {
        self.foreign = foreign;
        self
    }

    /// Must be written.
    #[must_use]
    pub fn is_required(&self) -> bool {
        matches!(self.default, Default::Required)
    }
}

/// What may be assigned to a field.
#[derive(Clone, Copy, Debug)]
pub enum FieldType {
    /// A number with a dimension.
    Number(Bounds),
    /// A number of at least 0 with one of these dimensions, each with the unit to suggest.
    Quantity(&'static [(Dim, &'static str)]),
    /// A whole number without a unit, both ends included.
    Integer(u32, u32),
    /// The same, or one of these words.
    IntegerOr(u32, u32, &'static [Word]),
    /// Three numbers of one dimension; the text is the unit to suggest.
    Vector(Dim, &'static str),
    /// The same, or keys: `[0ms: (0, 0, 0)m, 20ms: (1, 0, 0)m]`.
    Keyed(Dim, &'static str),
    /// A number with a dimension for each of red, green and blue, or one for all.
    Spectrum(Bounds),
    /// Two or three lengths above zero.
    Size(usize),
    /// A list of points, three lengths each.
    Points,
    /// A list of faces, three or four whole numbers each; faces of four become two of three.
    Faces,
    /// Width and height in whole pixels.
    Pixels,
    /// A colour, each channel at most this.
    Color(f64),
    /// A colour, each channel at most this, or a texture.
    ColorSlot(f64),
    /// A number, or one channel of a texture.
    ScalarSlot(Bounds),
    /// A texture that holds tangent-space normals.
    NormalSlot,
    /// One of these words.
    Word(&'static [Word]),
    /// A list of these words, or one of them.
    Words(&'static [Word]),
    /// The name of a declaration.
    Name(Kind),
    /// A list of names of declarations, or one name.
    Names(Kind),
    /// A shape, an object or a list of objects.
    Shape,
    /// `a..b`, with a not after b.
    Interval(Bounds),
    /// A text in quotes.
    Text,
    /// A path in quotes, relative to the file that says it.
    Path,
    /// The name of a light group, in quotes.
    Group,
    /// One number for all axes, or one for each; not zero.
    Scale,
    /// `+x`, `-x`, `+y`, `-y`, `+z` or `-z`.
    Axis,
    /// The symbol of a unit of length.
    LengthUnit,
}

/// A word and what it means.
pub type Word = (&'static str, &'static str);

/// A range of numbers with a dimension; values in SI.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Bounds {
    /// Dimension of the value.
    pub dim: Dim,
    /// The unit to suggest when one is missing; empty for plain numbers.
    pub unit: &'static str,
    /// Smallest value.
    pub min: f64,
    /// `min` itself is outside.
    pub above_min: bool,
    /// Largest value; infinite where only the size limit of the language holds.
    pub max: f64,
}

impl Bounds {
    pub(crate) const fn new(dim: Dim, unit: &'static str, min: f64, max: f64) -> Self {
        Self { dim, unit, min, above_min: false, max }
    }

    pub(crate) const fn number(min: f64, max: f64) -> Self {
        Self::new(Dim::NONE, "", min, max)
    }

    pub(crate) const fn above(dim: Dim, unit: &'static str, min: f64) -> Self {
        Self { dim, unit, min, above_min: true, max: f64::INFINITY }
    }

    /// Lies inside.
    #[must_use]
    pub fn contains(&self, value: f64) -> bool {
        let low = if self.above_min { value > self.min } else { value >= self.min };
        low && value <= self.max
    }

    /// Runs from 0 to 1, so that its values may be percent.
    #[must_use]
    #[expect(clippy::float_cmp, reason = "the table says exactly 1")]
    pub fn is_share(&self) -> bool {
        self.max == 1.0
    }

    /// In words for a message: `between 0 and 1`, `at least 1`, `above 0m`.
    #[must_use]
    pub fn described(&self) -> String {
        let show = |value: f64| self.show(value);
        let low = if self.above_min { "above" } else { "at least" };
        match (self.min == f64::NEG_INFINITY, self.max == f64::INFINITY) {
            (true, true) => "any value".to_owned(),
            (true, false) => format!("at most {}", show(self.max)),
            (false, true) => format!("{low} {}", show(self.min)),
            (false, false) if self.above_min => {
                format!("above {} and at most {}", show(self.min), show(self.max))
            }
            (false, false) => format!("between {} and {}", show(self.min), show(self.max)),
        }
    }

    /// Prints a value in the unit of this field where that is exact.
    #[must_use]
    pub fn show(&self, value: f64) -> String {
        let unit = units::find(self.unit);
        unit.and_then(|unit| units::show_in(value, unit))
            .unwrap_or_else(|| units::show(value, self.dim))
    }
}

/// What holds when a field is not written; numbers in SI.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Default {
    /// The field must be written.
    Required,
    /// A number.
    Number(f64),
    /// A triple.
    Vector([f64; 3]),
    /// Width and height.
    Pixels([u32; 2]),
    /// Linear Rec. 709.
    Color([f64; 3]),
    /// A word, an axis or a unit.
    Word(&'static str),
    /// `a..b`.
    Interval(f64, f64),
    /// Nothing; the text says what follows from that.
    Absent(&'static str),
}

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

/// Longest name of a light group: it is part of the names of channels.
pub const MAX_GROUP: usize = 40;

/// Largest width or height of a film, in pixels.
pub const MAX_FILM_SIDE: u32 = 65_536;

/// No number of a scene may be larger, in SI: it must still fit a 32-bit float after squaring.
pub const MAX_MAGNITUDE: f64 = 1e15;

/// No limit above the general one.
pub(crate) const ANY: f64 = f64::INFINITY;
pub(crate) const WHITE: [f64; 3] = [1.0; 3];

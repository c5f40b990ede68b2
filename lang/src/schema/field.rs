//! A field of a type: what may be assigned, and what holds when nothing is.

use super::bounds::Bounds;
use super::kind::Kind;
use crate::units::Dim;

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

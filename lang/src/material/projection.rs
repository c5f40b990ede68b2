//! Where the textures of a material lie on a thing: at its texture coordinates, or projected along axes.

use crate::check::Fields;
use crate::schema::{Default, Field, FieldType, Word};

/// How a material finds its texture coordinates. Projected ones are metres of the object's frame.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum TextureProjection {
    /// Those of the shape.
    #[default]
    Uv,
    /// On three planes, blended by how far the surface faces each.
    Box,
    /// Along an axis of the object: 0 x, 1 y, 2 z.
    Axis(usize),
    /// Through the object: along z, where z is the third coordinate of patterns that have one.
    Solid,
}

/// Each with its word.
const ALL: [(TextureProjection, &str); 6] = [
    (TextureProjection::Uv, "uv"),
    (TextureProjection::Box, "box"),
    (TextureProjection::Axis(0), "x"),
    (TextureProjection::Axis(1), "y"),
    (TextureProjection::Axis(2), "z"),
    (TextureProjection::Solid, "solid"),
];

const WORDS: &[Word] = &[
    ("uv", "the texture coordinates of the shape"),
    ("box", "from six sides, blended where they meet (triplanar)"),
    ("x", "straight through, along the x axis of the object"),
    ("y", "along its y axis"),
    ("z", "along its z axis"),
    ("solid", "carved from it: `noise` and `checker` in three dimensions, all else as `z`"),
];

pub(super) const PROJECTION: Field = Field::new(
    "projection",
    FieldType::Word(WORDS),
    Default::Word("uv"),
    "Where textures lie. Projected textures need no texture coordinates: they lie in object space, a unit to the \
     metre whatever the object's `scale`; place and size them with `scale`, `offset` and `rotate` of the texture.",
)
.foreign(&[
    ("mapping", "LuxCore"),
    ("triplanar", "common use"),
    ("Projection", "Blender"),
    ("projection_mode", "common use"),
]);

impl TextureProjection {
    /// That of checked fields.
    pub(crate) fn of(fields: &Fields) -> Self {
        let word = fields.word(PROJECTION.name);
        let found = ALL.into_iter().find(|(_, name)| word.is_some_and(|word| word == *name));
        found.map_or(Self::Uv, |(projection, _)| projection)
    }

    /// The field as it would be written; `None` where it is left out.
    pub(crate) fn shown(self) -> Option<(&'static str, String)> {
        let word = ALL.into_iter().find(|(projection, _)| *projection == self)?.1;
        (self != Self::Uv).then(|| (PROJECTION.name, word.to_owned()))
    }
}

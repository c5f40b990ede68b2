//! Image files: `texture NAME = image(...)`.

use super::{Default, Field, FieldType, Kind, TypeSchema, Word};

pub(super) const TYPES: &[&TypeSchema] = &[&IMAGE];

const SPACES: &[Word] = &[
    ("srgb", "colours with the sRGB curve: photographs and painted textures"),
    ("linear", "colours without a curve: HDR images"),
    ("data", "numbers that are not colours: roughness, masks"),
];

const WRAPS: &[Word] = &[
    ("repeat", "the image repeats"),
    ("clamp", "the edge goes on"),
    ("mirror", "the image repeats mirrored"),
];

const IMAGE: TypeSchema = TypeSchema {
    kind: Kind::Texture,
    name: "image",
    doc: "An image file (PNG, JPEG, HDR, EXR). Materials read it as `.rgb`, or one channel of it \
          as `.r`, `.g`, `.b` or `.a`. Alpha is always linear.",
    example: "texture bark = image(\"bark.png\", space: srgb, wrap: mirror)",
    fields: &[
        Field::new(
            "path",
            FieldType::Path,
            Default::Required,
            "The file, relative to the `.rts` file that says it. Comes first and needs no name.",
        )
        .foreign(&[("filename", "pbrt, Mitsuba"), ("file", "LuxCore"), ("uri", "glTF")]),
        Field::new(
            "space",
            FieldType::Word(SPACES),
            Default::Required,
            "How the numbers in the file are to be read.",
        )
        .foreign(&[
            ("encoding", "pbrt"),
            ("raw", "Mitsuba"),
            ("gamma", "LuxCore"),
            ("colorspace", "LuxCore"),
            ("color_space", "Blender"),
        ]),
        Field::new(
            "wrap",
            FieldType::Word(WRAPS),
            Default::Word("repeat"),
            "What lies outside 0..1, along both axes.",
        )
        .foreign(&[("wrap_mode", "Mitsuba"), ("extension", "Blender")]),
        Field::new(
            "wrap_u",
            FieldType::Word(WRAPS),
            Default::Absent("what `wrap` says"),
            "What lies outside 0..1 along u.",
        )
        .foreign(&[("wrapS", "glTF")]),
        Field::new(
            "wrap_v",
            FieldType::Word(WRAPS),
            Default::Absent("what `wrap` says"),
            "What lies outside 0..1 along v.",
        )
        .foreign(&[("wrapT", "glTF")]),
    ],
    foreign: &[("imagemap", "pbrt, LuxCore"), ("bitmap", "Mitsuba"), ("map_Kd", "OBJ/MTL")],
};

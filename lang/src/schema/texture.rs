//! Image files: `texture NAME = image(...)`.

use super::{Default, Field, FieldType, Kind, TypeSchema};
use crate::scene::{ColorSpace, Wrap};

types!(TextureType { Image = IMAGE });

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
            FieldType::Word(ColorSpace::WORDS),
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
            FieldType::Word(Wrap::WORDS),
            Default::Word("repeat"),
            "What lies outside 0..1, along both axes.",
        )
        .foreign(&[("wrap_mode", "Mitsuba"), ("extension", "Blender")]),
        Field::new(
            "wrap_u",
            FieldType::Word(Wrap::WORDS),
            Default::Absent("what `wrap` says"),
            "What lies outside 0..1 along u.",
        )
        .foreign(&[("wrapS", "glTF")]),
        Field::new(
            "wrap_v",
            FieldType::Word(Wrap::WORDS),
            Default::Absent("what `wrap` says"),
            "What lies outside 0..1 along v.",
        )
        .foreign(&[("wrapT", "glTF")]),
    ],
    foreign: &[("imagemap", "pbrt, LuxCore"), ("bitmap", "Mitsuba"), ("map_Kd", "OBJ/MTL")],
};

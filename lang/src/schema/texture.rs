//! Image files: `texture NAME = image(...)`.

use super::{Bounds, Default, Field, FieldType, Kind, TypeSchema};
use crate::scene::{ColorSpace, Wrap};
use crate::units::Dim;

types!(TextureType { Image = IMAGE });

/// Factors on texture coordinates.
const SCALE: Bounds = Bounds::number(-1e6, 1e6);

/// Moves of texture coordinates.
const OFFSET: Bounds = Bounds::number(-1e6, 1e6);

const IMAGE: TypeSchema = TypeSchema {
    kind: Kind::Texture,
    name: "image",
    doc: "An image file (PNG, JPEG, WebP, KTX2, HDR, EXR), or a luminaire file (IES), for the `profile` of a light. \
         Materials read it as `.rgb`, or one channel of it as `.r`, `.g`, `.b` or `.a`. Alpha is always linear. \
         Vertex colours need no declaration: they are the texture `vertex_color`, white on whatever has none.",
    example: "texture bark = image(\"bark.png\", space: srgb, wrap: mirror)",
    fields: &[
        Field::new(
            "path",
            FieldType::Path,
            Default::Required,
            "The file, relative to the `.rts` file that names it. Comes first and needs no name.",
        )
        .foreign(&[("filename", "pbrt, Mitsuba"), ("file", "LuxCore"), ("uri", "glTF")]),
        Field::new(
            "space",
            FieldType::Word(ColorSpace::WORDS),
            Default::Required,
            "How to read the numbers in the file.",
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
        Field::new(
            "scale",
            FieldType::Number(SCALE),
            Default::Number(1.0),
            "How often the image repeats in a unit of the texture coordinates, along both axes; negative values \
             mirror it. Coordinates are scaled, then turned, then moved.",
        )
        .typical("4")
        .foreign(&[("repeat", "three.js"), ("tiling", "Unity")]),
        Field::new(
            "scale_u",
            FieldType::Number(SCALE),
            Default::Absent("what `scale` says"),
            "How often it repeats along u.",
        )
        .foreign(&[("uscale", "pbrt")]),
        Field::new(
            "scale_v",
            FieldType::Number(SCALE),
            Default::Absent("what `scale` says"),
            "How often it repeats along v.",
        )
        .foreign(&[("vscale", "pbrt")]),
        Field::new(
            "rotate",
            FieldType::Number(Bounds::new(Dim::ANGLE, "deg", f64::NEG_INFINITY, f64::INFINITY)),
            Default::Number(0.0),
            "Turns the scaled coordinates counter-clockwise about (0, 0), and so the image clockwise.",
        )
        .typical("90deg")
        .foreign(&[("rotation", "glTF, three.js")]),
        Field::new(
            "offset_u",
            FieldType::Number(OFFSET),
            Default::Number(0.0),
            "Added to u at the end: 0.25 moves the image by a quarter of its width towards smaller u.",
        )
        .foreign(&[("udelta", "pbrt")]),
        Field::new(
            "offset_v",
            FieldType::Number(OFFSET),
            Default::Number(0.0),
            "Added to v at the end.",
        )
        .foreign(&[("vdelta", "pbrt")]),
    ],
    foreign: &[("imagemap", "pbrt, LuxCore"), ("bitmap", "Mitsuba"), ("map_Kd", "OBJ/MTL")],
};

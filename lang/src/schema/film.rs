//! Films: `film NAME { ... }`.

use super::{Bounds, Default, Field, FieldType, Kind, TypeSchema};
use crate::scene::{Filter, ToneMap};
use crate::units::Dim;

pub(super) const TYPES: &[&TypeSchema] = &[&FILM];

/// Stops that an exposure may have.
pub(crate) const EXPOSURE: Bounds = Bounds::new(Dim::EV, "EV", -64.0, 64.0);

const FILM: TypeSchema = TypeSchema {
    kind: Kind::Film,
    name: "",
    doc: "The picture: its size, and how the PNG is developed. The EXR is always linear and untouched.",
    example: "film uhd { size = (3840, 2160)px, exposure = 1.5EV, tone_map = aces }",
    fields: &[
        Field::new("size", FieldType::Pixels, Default::Pixels([960, 540]), "Width and height.")
            .foreign(&[
                ("xresolution", "pbrt"),
                ("yresolution", "pbrt"),
                ("width", "Mitsuba and LuxCore"),
                ("height", "Mitsuba and LuxCore"),
                ("resolution", "Blender"),
            ]),
        Field::new(
            "filter",
            FieldType::Word(Filter::WORDS),
            Default::Word("box"),
            "How the samples of a pixel are spread around it. Each counts for one pixel only, with the weight 1, so \
             that parts of a picture still merge exactly.",
        )
        .foreign(&[
            ("pixelfilter", "pbrt"),
            ("rfilter", "Mitsuba"),
            ("reconstruction_filter", "common use"),
            ("filter_type", "Blender"),
        ]),
        Field::new(
            "filter.width",
            FieldType::Number(Bounds {
                dim: Dim::PIXEL,
                unit: "px",
                min: 0.0,
                above_min: true,
                max: 32.0,
            }),
            Default::Absent("1px to 3px, by `filter`"),
            "Side of the square outside of which the filter is 0: less is sharper, more is smoother.",
        )
        .typical("1px to 4px")
        .foreign(&[
            ("xradius", "pbrt; it is half of this"),
            ("yradius", "pbrt; it is half of this"),
            ("filter_width", "Blender"),
        ]),
        Field::new(
            "exposure",
            FieldType::Number(EXPOSURE),
            Default::Number(0.0),
            "Stops: each doubles the brightness of the PNG.",
        )
        .foreign(&[("imagingratio", "pbrt"), ("gain", "common use")]),
        Field::new(
            "f_number",
            FieldType::Number(Bounds::number(0.1, 1e6)),
            Default::Absent("`exposure` decides"),
            "Exposure in the terms of cameras, in place of `exposure`: with `shutter` and `iso` the PNG shows as \
             middle grey, 0.18, the luminance that a light meter calls right for them: 12.5 f_number^2 / (shutter \
             iso) nit (ISO 2720, with K = 12.5, the constant of most makers). It does not change the depth of \
             field, which is the camera's.",
        )
        .typical("1.4 to 22")
        .foreign(&[("fstop", "common use"), ("aperture", "common use"), ("f_stop", "LuxCore")]),
        Field::new(
            "shutter",
            FieldType::Number(Bounds::above(Dim::TIME, "ms", 0.0)),
            Default::Absent("`exposure` decides"),
            "Exposure time, with `f_number`. It blurs nothing; the `shutter` of the camera does.",
        )
        .typical("sun 4ms, a room 30ms, night 1s")
        .foreign(&[("exposure_time", "common use"), ("shutter_time", "common use"), ("exposuretime", "pbrt")]),
        Field::new(
            "iso",
            FieldType::Number(Bounds::number(1.0, 1e7)),
            Default::Number(100.0),
            "Sensitivity of the film, ISO 5800 or ISO 12232, with `f_number`.",
        )
        .typical("100 to 6400")
        .foreign(&[("sensitivity", "LuxCore")]),
        Field::new(
            "tone_map",
            FieldType::Word(ToneMap::WORDS),
            Default::Word("linear"),
            "How brightness becomes the eight bits of the PNG.",
        )
        .foreign(&[
            ("tonemap", "LuxCore"),
            ("view_transform", "Blender"),
            ("tonemapping", "common use"),
        ]),
    ],
    foreign: &[],
};

//! Media: `medium NAME: TYPE { ... }`.

use super::{ANY, Bounds, Default, Field, FieldType, Kind, TypeSchema};
use crate::units::Dim;

types!(MediumType { Homogeneous = HOMOGENEOUS, Fog = FOG });

pub(crate) const COEFFICIENT: Bounds = Bounds::new(Dim::PER_LENGTH, "/m", 0.0, ANY);

/// Names that other renderers give absorption.
pub(crate) const SIGMA_A_NAMES: &[(&str, &str)] = &[
    ("absorption", "LuxCore"),
    ("absorption_coefficient", "common use"),
    ("sigmaA", "Mitsuba 0.6"),
];

const SKY_DISTANCE: Field = Field::new(
    "sky_distance",
    FieldType::Number(Bounds::above(Dim::LENGTH, "m", 0.0)),
    Default::Number(1000.0),
    "As atmosphere: how much of it lies between the scene and the sky.",
)
.typical("haze that hides the horizon but not the sky 500m");

const HOMOGENEOUS: TypeSchema = TypeSchema {
    kind: Kind::Medium,
    name: "homogeneous",
    doc: "Absorbs and scatters light, the same everywhere: coloured glass, water, milk, smoke. As \
          `interior` of a material it fills things, as `atmosphere` of the render all that is outside of \
          them. Either `sigma_a` and `sigma_s` say what it does, or `mean_free_path` and `albedo`.",
    example: "medium amber: homogeneous { sigma_a = (0.5, 2, 9)/m }",
    fields: &[
        Field::new(
            "sigma_a",
            FieldType::Spectrum(COEFFICIENT),
            Default::Absent("absorbs nothing, unless `mean_free_path` says otherwise"),
            "Absorption: over a length d the share exp(-sigma_a d) of the light is left.",
        )
        .typical("clear water (0.35, 0.06, 0.025)/m")
        .foreign(SIGMA_A_NAMES),
        Field::new(
            "sigma_s",
            FieldType::Spectrum(COEFFICIENT),
            Default::Absent("scatters nothing, unless `mean_free_path` says otherwise"),
            "Scattering: how often light changes its direction on one metre.",
        )
        .typical("whole milk (2550, 3210, 3770)/m")
        .foreign(&[
            ("scattering", "LuxCore"),
            ("scattering_coefficient", "common use"),
            ("sigmaS", "Mitsuba 0.6"),
        ]),
        Field::new(
            "mean_free_path",
            FieldType::Spectrum(Bounds::above(Dim::LENGTH, "m", 0.0)),
            Default::Absent("`sigma_a` and `sigma_s` decide"),
            "How far light gets on average before it is absorbed or scattered.",
        )
        .typical("murky water (0.9, 2.1, 2.6)m")
        .foreign(&[("mfp", "pbrt")]),
        Field::new(
            "albedo",
            FieldType::Color(1.0),
            Default::Absent("`sigma_a` and `sigma_s` decide"),
            "Share of that light which is scattered and not absorbed.",
        )
        .foreign(&[("single_scattering_albedo", "common use")]),
        Field::new(
            "g",
            FieldType::Number(Bounds::number(-1.0, 1.0)),
            Default::Number(0.0),
            "Mean cosine of scattering: 1 straight on, 0 evenly, -1 straight back (Henyey-Greenstein).",
        )
        .typical("fog 0.85, skin 0.8, smoke 0.4")
        .foreign(&[("anisotropy", "Blender"), ("asymmetry", "LuxCore"), ("phase_g", "common use")]),
        SKY_DISTANCE,
    ],
    foreign: &[
        ("volume", "Blender and LuxCore"),
        ("scattering", "common use"),
        ("heterogeneous", "pbrt and Mitsuba"),
        ("clear", "LuxCore"),
    ],
};

const FOG: TypeSchema = TypeSchema {
    kind: Kind::Medium,
    name: "fog",
    doc: "Haze without noise: every segment of every path loses the share 1 - exp(-density d) of its \
          light, whatever the path is inside of, and gets as much of `color` instead. Light does not \
          scatter in it: no beams, no glow around lamps; for those take `homogeneous`. Only as \
          `atmosphere` of the render.",
    example: "medium mist: fog { visibility = 180m, color = linear(0.6, 0.65, 0.7) }",
    fields: &[
        Field::new(
            "visibility",
            FieldType::Number(Bounds::above(Dim::LENGTH, "m", 0.0)),
            Default::Absent("`density` decides"),
            "Where 2% of the contrast is left: density = 3.912 / visibility (Koschmieder 1924).",
        )
        .typical("clear air 40km, haze 5km, fog 500m, dense fog 50m"),
        Field::new(
            "density",
            FieldType::Number(COEFFICIENT),
            Default::Absent("`visibility` decides"),
            "Extinction.",
        )
        .typical("0.0001/m to 0.001/m")
        .foreign(&[("sigma_t", "Mitsuba"), ("extinction", "common use")]),
        Field::new(
            "color",
            FieldType::Color(ANY),
            Default::Required,
            "Radiance of the fog where it is thick, in the measure of the sky's.",
        )
        .typical("that of the sky at the horizon"),
        SKY_DISTANCE,
    ],
    foreign: &[("mist", "Blender"), ("haze", "common use"), ("atmosphere", "common use")],
};

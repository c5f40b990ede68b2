//! Lights: `light NAME: sphere { ... }`.

use super::{ANY, Bounds, Default, Field, FieldType, Kind, TypeSchema, WHITE};
use crate::units::Dim;

pub(super) const TYPES: &[&TypeSchema] = &[&SPHERE];

const SPHERE: TypeSchema = TypeSchema {
    kind: Kind::Light,
    name: "sphere",
    doc: "A glowing ball, seen by the camera too. How bright it is says `strength` (its radiance) or \
          `power` (all it gives off), not both. In an imported file only `pub` lights are in the world.",
    example: "light sun: sphere { center = (30, 40, 10)m, radius = 2m, color = blackbody(4300K), \
              strength = 80 }",
    fields: &[
        Field::new(
            "center",
            FieldType::Vector(Dim::LENGTH, "m"),
            Default::Required,
            "Where its middle is.",
        )
        .foreign(&[("from", "pbrt"), ("position", "Mitsuba and LuxCore"), ("at", "instances")]),
        Field::new(
            "radius",
            FieldType::Number(Bounds::above(Dim::LENGTH, "m", 0.0)),
            Default::Required,
            "Distance from the middle to the surface; larger means softer shadows.",
        )
        .typical("a bulb 3cm; the sun's is 0.00465 of its distance")
        .foreign(&[("shadow_soft_size", "Blender"), ("size", "common use")]),
        Field::new("color", FieldType::Color(ANY), Default::Color(WHITE), "Colour of the light.")
            .typical("candle `blackbody(1900K)`, bulb 2800K, noon 5500K")
            .foreign(&[
                ("L", "pbrt"),
                ("I", "pbrt"),
                ("radiance", "Mitsuba"),
                ("emission", "LuxCore"),
            ]),
        Field::new(
            "strength",
            FieldType::Number(Bounds::number(0.0, ANY)),
            Default::Number(1.0),
            "Factor on `color`: the radiance of its surface in W/(m2 sr), up to the scale of the scene.",
        )
        .foreign(&[
            ("scale", "pbrt"),
            ("gain", "LuxCore"),
            ("intensity", "Mitsuba and glTF"),
            ("energy", "Blender"),
        ]),
        Field::new(
            "power",
            FieldType::Number(Bounds::number(0.0, ANY)),
            Default::Absent("`strength` decides"),
            "All the light it gives off, in watts; the radiance is `color` times \
             power / (4 pi^2 radius^2).",
        )
        .foreign(&[("flux", "common use"), ("watts", "common use")]),
    ],
    foreign: &[("point", "pbrt, Mitsuba and Blender"), ("spherical", "LuxCore")],
};

//! Lights: `light NAME: sphere { ... }`.

use super::{ANY, Bounds, Default, Field, FieldType, Kind, TypeSchema, WHITE};
use crate::units::Dim;

types!(LightType { Sphere = SPHERE });

/// 80 degrees: at 90 the origin of the world would touch the light.
const MAX_ANGULAR_RADIUS: f64 = 80.0 * std::f64::consts::PI / 180.0;

const SPHERE: TypeSchema = TypeSchema {
    kind: Kind::Light,
    name: "sphere",
    doc: "A glowing ball, seen by the camera too. How bright it is says `strength` (its radiance) or \
          `power` (all it gives off), not both; where it is say `center` and `radius`, or for a sun \
          `direction`, `distance` and `angular_radius`. In an imported file only `pub` lights are in the world.",
    example: "light sun: sphere { center = (30, 40, 10)m, radius = 2m, color = blackbody(4300K), \
              strength = 80 }",
    fields: &[
        Field::new(
            "center",
            FieldType::Vector(Dim::LENGTH, "m"),
            Default::Absent("`direction` and `distance` decide"),
            "Where its middle is.",
        )
        .foreign(&[("from", "pbrt"), ("position", "Mitsuba and LuxCore"), ("at", "instances")]),
        Field::new(
            "radius",
            FieldType::Number(Bounds::above(Dim::LENGTH, "m", 0.0)),
            Default::Absent("`angular_radius` decides"),
            "Distance from the middle to the surface; larger means softer shadows.",
        )
        .typical("a bulb 3cm; the sun's is 0.00465 of its distance")
        .foreign(&[("shadow_soft_size", "Blender"), ("size", "common use")]),
        Field::new(
            "direction",
            FieldType::Vector(Dim::NONE, ""),
            Default::Absent("`center` decides"),
            "From the origin of the world towards the light; its length does not matter.",
        )
        .foreign(&[("sundir", "LuxCore"), ("sun_direction", "Mitsuba and Blender")]),
        Field::new(
            "distance",
            FieldType::Number(Bounds::above(Dim::LENGTH, "m", 0.0)),
            Default::Absent("`center` decides"),
            "From the origin of the world to the light's middle, along `direction`.",
        ),
        Field::new(
            "angular_radius",
            FieldType::Number(Bounds {
                dim: Dim::ANGLE,
                unit: "deg",
                min: 0.0,
                above_min: true,
                max: MAX_ANGULAR_RADIUS,
            }),
            Default::Absent("`radius` decides"),
            "Half the angle that the light fills as seen from the origin of the world.",
        )
        .typical("sun and moon 0.265deg")
        .foreign(&[("angle", "Blender"), ("theta", "LuxCore")]),
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
        Field::new(
            "tint.color",
            FieldType::Color(ANY),
            Default::Absent("no tint"),
            "Factor on the light that travels within `tint.angle` of the tint's direction: a low sun seen \
             through thick air. It holds for everything that looks at the light, the camera too.",
        )
        .typical("`linear(1, 0.65, 0.22)` for a sunset"),
        Field::new(
            "tint.angle",
            FieldType::Number(Bounds {
                dim: Dim::ANGLE,
                unit: "deg",
                min: 0.0,
                above_min: true,
                max: std::f64::consts::PI,
            }),
            Default::Number(18.0 * std::f64::consts::PI / 180.0),
            "Rays towards the light are tinted if they differ less than this from `tint.direction`.",
        ),
        Field::new(
            "tint.direction",
            FieldType::Vector(Dim::NONE, ""),
            Default::Absent("from the origin of the world to the light"),
            "Where the tinted light comes from.",
        ),
        super::instance::VELOCITY,
    ],
    foreign: &[("point", "pbrt, Mitsuba and Blender"), ("spherical", "LuxCore")],
};

//! Lights: `light NAME: sphere { ... }`.

mod fields;

use fields::{
    AT, COLOR, DIRECTION, EXCEPT, ILLUMINANCES, INTENSITY, LEAST_CONE, LENGTH, MAX_ANGULAR_RADIUS,
    MESH_SIDES, ONLY, PANEL_SIDES, POINT_INTENSITY, POINT_POWER, POWER, PROFILE_DIRECTION,
    PROFILE_TO, RADIUS, SPIN, STRENGTH, TEMPERATURE, TO,
};
pub(crate) use fields::{DIAMETER, SUN_DIAMETER};

use super::instance::{self, GROUP, VELOCITY};
use super::{ANY, Bounds, Default, Field, FieldType, Kind, TypeSchema};
use crate::material::VISIBLE;
use crate::units::Dim;

types!(LightType {
    Sphere = SPHERE,
    Point = POINT,
    Spot = SPOT,
    Directional = DIRECTIONAL,
    Rectangle = RECTANGLE,
    Disk = DISK,
    Mesh = MESH
});

const SPHERE: TypeSchema = TypeSchema {
    kind: Kind::Light,
    name: "sphere",
    doc: "A glowing ball, which the camera sees too. Give its brightness as one of `strength` (its radiance), \
         `intensity` or `power` (all it gives off), and its place as `center` and `radius` or, for a sun, as \
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
            LENGTH,
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
            LENGTH,
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
        COLOR,
        TEMPERATURE,
        STRENGTH,
        INTENSITY,
        POWER,
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
        VELOCITY,
        VISIBLE,
        GROUP,
        ONLY,
        EXCEPT,
    ],
    foreign: &[("spherical", "LuxCore")],
};

const POINT: TypeSchema = TypeSchema {
    kind: Kind::Light,
    name: "point",
    doc: "A bulb: a small sphere, because nothing that shines is a point. The camera sees it, and the smaller its \
         `radius`, the sharper its shadows. With a `profile` it is a luminaire.",
    example: "light bulb: point { at = (0, 2.1, 0)m, temperature = 2800K, power = 800lm }",
    fields: &[
        AT,
        RADIUS,
        COLOR,
        TEMPERATURE,
        POINT_INTENSITY,
        POINT_POWER,
        Field::new(
            "profile",
            FieldType::Name(Kind::Texture),
            Default::Absent("the same in all directions"),
            "How much light it gives off in each direction, in place of `intensity` and `power`: a `texture` of a \
             luminaire file (IES), tagged `linear`. In any other image, whose top row is the middle of the beam, 1 \
             means 1000 candelas.",
        )
        .foreign(&[("ies", "Blender and LuxCore"), ("iesfile", "LuxCore"), ("goniometric", "pbrt")]),
        Field::new(
            "profile.scale",
            FieldType::Number(Bounds::number(0.0, ANY)),
            Default::Number(1.0),
            "Factor on the light of `profile`.",
        )
        .typical("0.5 for a lamp dimmed by half"),
        PROFILE_TO,
        PROFILE_DIRECTION,
        SPIN,
        VELOCITY,
        VISIBLE,
        GROUP,
        ONLY,
        EXCEPT,
    ],
    foreign: &[("omni", "common use"), ("bulb", "common use")],
};

const SPOT: TypeSchema = TypeSchema {
    kind: Kind::Light,
    name: "spot",
    doc: "A lamp that shines into a cone: a small sphere that looks dark from outside the cone. It shines down \
         unless `to` or `direction` says otherwise.",
    example: "light stage: spot { at = (0, 4, 3)m, to = (0, 1, 0)m, cone = 25deg, edge = 5deg, power = 800lm }",
    fields: &[
        AT,
        TO,
        DIRECTION,
        Field::new(
            "cone",
            FieldType::Number(Bounds {
                dim: Dim::ANGLE,
                unit: "deg",
                min: LEAST_CONE,
                above_min: false,
                max: std::f64::consts::FRAC_PI_2,
            }),
            Default::Number(std::f64::consts::FRAC_PI_4),
            "Angle between its axis and its edge: half of what the cone spans.",
        )
        .foreign(&[
            ("coneangle", "pbrt"),
            ("cutoff_angle", "Mitsuba"),
            ("spot_size", "Blender, which counts the whole span"),
            ("outerConeAngle", "glTF"),
        ]),
        Field::new(
            "edge",
            FieldType::Number(Bounds {
                dim: Dim::ANGLE,
                unit: "deg",
                min: 0.0,
                above_min: true,
                max: std::f64::consts::FRAC_PI_2,
            }),
            Default::Number(5.0 * std::f64::consts::PI / 180.0),
            "Angle over which the light falls off, inside `cone`; at most as large as it.",
        )
        .foreign(&[
            ("conedeltaangle", "pbrt"),
            ("spot_blend", "Blender"),
            ("falloff", "common use"),
        ]),
        RADIUS,
        COLOR,
        TEMPERATURE,
        Field {
            doc: "Its light in the middle of the beam: candelas, or watts per steradian for a white light.",
            ..POINT_INTENSITY
        },
        Field {
            doc: "All the light in the beam: watts for a white light, or lumens.",
            ..POINT_POWER
        },
        VELOCITY,
        VISIBLE,
        GROUP,
        ONLY,
        EXCEPT,
    ],
    foreign: &[("spotlight", "common use")],
};

const DIRECTIONAL: TypeSchema = TypeSchema {
    kind: Kind::Light,
    name: "directional",
    doc: "The sun: a disc of even brightness infinitely far away, which shines from the same direction everywhere. \
         `direction` points towards it. The camera sees the disc too. Give its brightness as `illuminance`, what \
         arrives at a surface that faces it, whatever its diameter, or as `strength`, its radiance.",
    example: "light sun: directional { direction = (0.3, 0.8, 0.4), illuminance = 100klx, temperature = 5800K }",
    fields: &[
        Field::new(
            "direction",
            FieldType::Vector(Dim::NONE, ""),
            Default::Required,
            "Towards the light, against the way its light travels; its length does not matter.",
        )
        .foreign(&[
            ("sundir", "LuxCore"),
            ("dir", "LuxCore"),
            ("sun_direction", "Mitsuba and Blender"),
            ("from", "pbrt"),
            ("towards", "common use"),
        ]),
        Field::new(
            "angular_diameter",
            DIAMETER,
            SUN_DIAMETER,
            "The angle that it fills; larger means softer shadows.",
        )
        .typical("sun and moon 0.53deg")
        .foreign(&[
            ("angle", "Blender"),
            ("theta", "LuxCore"),
            ("angular_radius", "the type `sphere`, half of it"),
            ("sun_size", "Blender"),
        ]),
        COLOR,
        TEMPERATURE,
        Field::new(
            "illuminance",
            ILLUMINANCES,
            Default::Absent("`strength` decides"),
            "What arrives at a surface that faces the light: lux, or watts per square metre for a white light.",
        )
        .typical("the sun at noon 100klx, through thin cloud 20klx, the full moon 0.25lx")
        .foreign(&[
            ("irradiance", "Mitsuba"),
            ("energy", "Blender"),
            ("intensity", "glTF, in lux"),
            ("power", "pbrt"),
            ("lux", "common use"),
        ]),
        Field {
            default: Default::Absent("`illuminance` decides"),
            doc: "Factor on `color`: the radiance of its disc, or with a unit of luminance its luminance.",
            typical: "the sun at noon 1.6e9nit",
            foreign: &[("scale", "pbrt"), ("gain", "LuxCore"), ("luminance", "common use")],
            ..STRENGTH
        },
        VISIBLE,
        GROUP,
        ONLY,
        EXCEPT,
    ],
    foreign: &[
        ("distant", "pbrt and USD"),
        ("sun", "Blender"),
        ("sunlight", "common use"),
        ("parallel", "common use"),
        ("infinite", "common use"),
    ],
};

const RECTANGLE: TypeSchema = TypeSchema {
    kind: Kind::Light,
    name: "rectangle",
    doc: "A panel or a window: a flat rectangle that shines evenly, seen by the camera too. It faces down unless \
         `to` or `direction` says otherwise. It is an instance with an `emissive` material.",
    example: "light key: rectangle { at = (2, 3, 2)m, to = (0, 1, 0)m, size = (1, 0.5)m, power = 2klm }",
    fields: &[
        AT,
        Field::new(
            "size",
            FieldType::Size(2),
            Default::Required,
            "Width, along the horizontal, and height.",
        ),
        TO,
        DIRECTION,
        SPIN,
        PANEL_SIDES,
        COLOR,
        TEMPERATURE,
        STRENGTH,
        POWER,
        VELOCITY,
        VISIBLE,
        GROUP,
        ONLY,
        EXCEPT,
    ],
    foreign: &[
        ("area", "Mitsuba and Blender"),
        ("rect", "common use"),
        ("quad", "common use"),
        ("portal", "common use"),
    ],
};

const DISK: TypeSchema = TypeSchema {
    kind: Kind::Light,
    name: "disk",
    doc: "A round panel: a flat disk that shines evenly, seen by the camera too. It faces down unless `to` or \
         `direction` says otherwise. It is a square with an `emissive` material, cut out to a circle.",
    example: "light dish: disk { at = (0, 3, 2)m, to = (0, 1, 0)m, radius = 40cm, power = 1.5klm }",
    fields: &[
        AT,
        Field::new("radius", LENGTH, Default::Required, "Distance from the middle to the rim."),
        TO,
        DIRECTION,
        PANEL_SIDES,
        COLOR,
        TEMPERATURE,
        STRENGTH,
        POWER,
        VELOCITY,
        VISIBLE,
        GROUP,
        ONLY,
        EXCEPT,
    ],
    foreign: &[("disc", "common use"), ("round", "common use"), ("circle", "common use")],
};

const MESH: TypeSchema = TypeSchema {
    kind: Kind::Light,
    name: "mesh",
    doc: "A thing of any shape that shines evenly: a neon sign, a lamp of a mesh file, a mesh written in the scene. \
         It is an instance with an `emissive` material, and is placed as instances are.",
    example: "light sign: mesh { shape = box(size: (2, 0.1, 0.1)m), at = (0, 2, 0)m, strength = 500nit }",
    fields: &[
        Field::new("shape", FieldType::Shape, Default::Required, instance::SHAPE)
            .foreign(&[("geometry", "common use"), ("mesh", "glTF and Blender")]),
        instance::AT,
        instance::ROTATE,
        instance::SCALE,
        instance::AXIS_X,
        instance::AXIS_Y,
        instance::AXIS_Z,
        Field { ty: FieldType::Word(MESH_SIDES), default: Default::Word("both"), ..PANEL_SIDES },
        COLOR,
        TEMPERATURE,
        Field {
            foreign: &[("gain", "LuxCore"), ("luminance", "common use"), ("energy", "Blender")],
            ..STRENGTH
        },
        Field {
            doc: "All the light it gives off, spread over its area: watts for a white light, or lumens, 683 to the \
                 watt of luminous power. A closed shape shines outwards only.",
            typical: "a neon sign of a metre 700lm",
            ..POWER
        },
        VELOCITY,
        VISIBLE,
        GROUP,
        ONLY,
        EXCEPT,
    ],
    foreign: &[("trianglemesh", "pbrt"), ("geometry", "common use"), ("emitter", "common use")],
};

//! Lights: `light NAME: sphere { ... }`.

use super::instance::{self, GROUP, VELOCITY};
use super::{ANY, Bounds, Default, Field, FieldType, Kind, TypeSchema, WHITE, Word};
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

/// 80 degrees: at 90 the origin of the world would touch the light.
const MAX_ANGULAR_RADIUS: f64 = 80.0 * std::f64::consts::PI / 180.0;

/// Half a degree: cosines in single precision tell narrower cones apart badly.
const LEAST_CONE: f64 = 0.5 * std::f64::consts::PI / 180.0;

/// The narrowest light at infinity: the kernel compares chords of directions, which single precision knows to 1e-7;
/// below a hundredth of a degree that is more than a thousandth of the chord.
const LEAST_DIAMETER: f64 = 0.01 * std::f64::consts::PI / 180.0;

/// The angle that a light at infinity fills.
pub(crate) const DIAMETER: FieldType = FieldType::Number(Bounds {
    dim: Dim::ANGLE,
    unit: "deg",
    min: LEAST_DIAMETER,
    above_min: false,
    max: std::f64::consts::FRAC_PI_2,
});

/// That of the sun: 0.53 degrees.
pub(crate) const SUN_DIAMETER: Default = Default::Number(0.53 * std::f64::consts::PI / 180.0);

/// Which sides of a flat light shine.
const SIDES: &[Word] =
    &[("front", "the one that faces `direction`"), ("both", "both, each with half of `power`")];

/// The same of a mesh.
const MESH_SIDES: &[Word] =
    &[("front", "only the side that its normals point to"), ("both", "front and back")];

const LENGTH: FieldType = FieldType::Number(Bounds::above(Dim::LENGTH, "m", 0.0));

/// How strong the light is that a whole emitter gives off.
const POWERS: FieldType =
    FieldType::Quantity(&[(Dim::POWER, "W"), (Dim::LUMINOUS_FLUX, "lm"), (Dim::NONE, "")]);

/// The same in one direction.
const INTENSITIES: FieldType =
    FieldType::Quantity(&[(Dim::LUMINOUS_INTENSITY, "cd"), (Dim::INTENSITY, "W/sr")]);

/// What arrives of it at a plane that faces it.
const ILLUMINANCES: FieldType =
    FieldType::Quantity(&[(Dim::ILLUMINANCE, "lx"), (Dim::IRRADIANCE, "W/m2")]);

/// The same of each part of its surface.
const RADIANCES: FieldType =
    FieldType::Quantity(&[(Dim::NONE, ""), (Dim::RADIANCE, "W/m2/sr"), (Dim::LUMINANCE, "nit")]);

const COLOR: Field =
    Field::new("color", FieldType::Color(ANY), Default::Color(WHITE), "Colour of the light.")
        .typical("candle `blackbody(1900K)`, bulb 2800K, noon 5500K")
        .foreign(&[("L", "pbrt"), ("I", "pbrt"), ("radiance", "Mitsuba"), ("emission", "LuxCore")]);

const TEMPERATURE: Field = Field::new(
    "temperature",
    FieldType::Number(Bounds::new(Dim::TEMPERATURE, "K", 500.0, 100_000.0)),
    Default::Absent("`color` decides"),
    "Short for `color = blackbody(...)`.",
)
.typical("candle 1900K, bulb 2800K, noon 5500K, overcast sky 6500K");

const STRENGTH: Field = Field::new(
    "strength",
    RADIANCES,
    Default::Number(1.0),
    "Factor on `color`: the radiance of its surface in W/(m2 sr), up to the scale of the scene. With a unit of \
     luminance, its luminance.",
)
.typical("a white screen 200nit, a fluorescent tube 10000nit")
.foreign(&[
    ("scale", "pbrt"),
    ("gain", "LuxCore"),
    ("luminance", "common use"),
    ("energy", "Blender"),
]);

const POWER: Field = Field::new(
    "power",
    POWERS,
    Default::Absent("`strength` decides"),
    "All the light it gives off: watts for a white light, or lumens, 683 to the watt of luminous power.",
)
.typical("a 60W bulb of old gives 800lm, a candle 12lm")
.foreign(&[("flux", "common use"), ("watts", "common use"), ("lumens", "common use")]);

const INTENSITY: Field = Field::new(
    "intensity",
    INTENSITIES,
    Default::Absent("`strength` decides"),
    "How much light it gives off in each direction: candelas, or watts per steradian for \
     a white light.",
)
.typical("a candle 1cd, a car's high beam 40kcd")
.foreign(&[("candela", "common use")]);

/// A point has no surface to ask for its radiance.
const POINT_INTENSITY: Field = Field { default: Default::Absent("`power` decides"), ..INTENSITY };
const POINT_POWER: Field = Field { default: Default::Absent("`intensity` decides"), ..POWER };

/// Of lamps that are small.
const RADIUS: Field = Field::new(
    "radius",
    LENGTH,
    Default::Number(0.01),
    "Distance from the middle to the surface; larger means softer shadows.",
)
.foreign(&[("shadow_soft_size", "Blender"), ("size", "common use")]);

const AT: Field = Field::new(
    "at",
    FieldType::Vector(Dim::LENGTH, "m"),
    Default::Required,
    "Where its middle is.",
)
.foreign(&[
    ("from", "pbrt"),
    ("position", "Mitsuba and LuxCore"),
    ("center", "the type `sphere`"),
    ("location", "Blender"),
]);

/// Light linking.
const ONLY: Field = Field::new(
    "only",
    FieldType::Names(Kind::Instance),
    Default::Absent("all"),
    "Light linking: it lights these instances and nothing else. Everything still casts a shadow, and the camera still sees \
     the light; a mirror that is not listed does not show it.",
)
.typical("`[vase, plinth]`")
.foreign(&[("light_linking", "Blender"), ("include", "common use"), ("links", "common use")]);

/// Light linking, the other way round.
const EXCEPT: Field = Field::new(
    "except",
    FieldType::Names(Kind::Instance),
    Default::Absent("none"),
    "Light linking: it lights everything but these instances. See `only`.",
)
.foreign(&[("exclude", "common use")]);

const SPHERE: TypeSchema = TypeSchema {
    kind: Kind::Light,
    name: "sphere",
    doc: "A glowing ball, seen by the camera too. How bright it is says `strength` (its radiance), `intensity` or \
          `power` (all it gives off), one of them; where it is say `center` and `radius`, or for a sun \
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
    doc: "A bulb: a small sphere, because nothing that shines is a point. It is seen by the camera, and its shadows \
          are as sharp as `radius` is small. With a `profile` it is a luminaire.",
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
             luminaire file (IES), tagged `linear`. Of another image, whose top row is the middle of the beam, 1 is \
             1000 candelas.",
        )
        .foreign(&[("ies", "Blender and LuxCore"), ("iesfile", "LuxCore"), ("goniometric", "pbrt")]),
        Field::new(
            "profile.scale",
            FieldType::Number(Bounds::number(0.0, ANY)),
            Default::Number(1.0),
            "Factor on the light of `profile`.",
        )
        .typical("0.5 for a lamp that is dimmed to a half"),
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

const TO: Field = Field::new(
    "to",
    FieldType::Vector(Dim::LENGTH, "m"),
    Default::Absent("`direction` decides"),
    "A point that it faces.",
)
.foreign(&[("target", "common use"), ("look_at", "common use")]);

const DIRECTION: Field = Field::new(
    "direction",
    FieldType::Vector(Dim::NONE, ""),
    Default::Vector([0.0, -1.0, 0.0]),
    "Which way it faces; its length does not matter.",
)
.foreign(&[("normal", "common use")]);

/// Of lamps with a profile.
const PROFILE_TO: Field = Field { doc: "A point to which the beam of `profile` goes.", ..TO };
const PROFILE_DIRECTION: Field =
    Field { doc: "Which way the beam of `profile` goes; its length does not matter.", ..DIRECTION };

const SPIN: Field = Field::new(
    "spin",
    FieldType::Number(Bounds::new(Dim::ANGLE, "deg", f64::NEG_INFINITY, ANY)),
    Default::Number(0.0),
    "Turned about `direction`, counter-clockwise seen by who looks at it.",
);

const SPOT: TypeSchema = TypeSchema {
    kind: Kind::Light,
    name: "spot",
    doc: "A lamp that shines into a cone: a small sphere that is dark from outside of it. It shines down unless `to` \
          or `direction` says otherwise.",
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
            "Angle between its middle and where it ends: half of what the cone spans.",
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
            "Angle over which the light falls off, inside of `cone`; at most as large.",
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
          `direction` points towards it. The camera sees the disc too. How bright it is says `illuminance`, what \
          arrives at a surface that faces it whatever its diameter, or `strength`, its radiance.",
    example: "light sun: directional { direction = (0.3, 0.8, 0.4), illuminance = 100klx, temperature = 5800K }",
    fields: &[
        Field::new(
            "direction",
            FieldType::Vector(Dim::NONE, ""),
            Default::Required,
            "From anywhere towards the light, against the way that its light travels; its length does not matter.",
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

/// Of flat lights.
const PANEL_SIDES: Field = Field::new(
    "sides",
    FieldType::Word(SIDES),
    Default::Word("front"),
    "Which sides give off light.",
)
.foreign(&[("twosided", "pbrt"), ("two_sided", "common use")]);

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
            "Width, which is level, and height.",
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
    doc: "A thing of any shape that shines evenly: a neon sign, a lamp of a mesh file, a mesh written in the scene. It is \
          an instance with an `emissive` material, and is placed as instances are.",
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
            doc: "All the light it gives off, spread over its area: watts for a white light, or lumens, 683 to the watt of \
                  luminous power. A closed shape shines outwards only.",
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

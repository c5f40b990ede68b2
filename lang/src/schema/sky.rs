//! Skies: `sky NAME: TYPE { ... }`.

use super::{ANY, Bounds, Default, Field, FieldType, Kind, TypeSchema, WHITE};
use crate::units::Dim;

types!(SkyType { Constant = CONSTANT, Gradient = GRADIENT, Image = IMAGE });

const STRENGTH: Field = Field::new(
    "strength",
    FieldType::Number(Bounds::number(0.0, ANY)),
    Default::Number(1.0),
    "Factor on all colours, in W/(m2 sr) up to the scale of the scene.",
)
.foreign(&[("scale", "pbrt and Mitsuba"), ("gain", "LuxCore"), ("Strength", "Blender")]);

const CONSTANT: TypeSchema = TypeSchema {
    kind: Kind::Sky,
    name: "constant",
    doc: "The same radiance from every direction.",
    example: "sky overcast: constant { color = linear(0.8, 0.85, 1.0), strength = 0.5 }",
    fields: &[
        Field::new("color", FieldType::Color(ANY), Default::Color(WHITE), "Colour of the sky.")
            .foreign(&[("L", "pbrt"), ("radiance", "Mitsuba"), ("Color", "Blender")]),
        STRENGTH,
    ],
    foreign: &[
        ("infinite", "pbrt and LuxCore"),
        ("uniform", "common use"),
        ("background", "Blender"),
    ],
};

const fn band(name: &'static str, rgb: [f64; 3], doc: &'static str) -> Field {
    Field::new(name, FieldType::Color(ANY), Default::Color(rgb), doc)
}

const fn exponent(name: &'static str, value: f64, doc: &'static str) -> Field {
    let bounds = Bounds::number(1.0, 1e6);
    Field::new(name, FieldType::Number(bounds), Default::Number(value), doc)
}

// The default bands are a sunset: a dark blue zenith over purple and orange, brown below. They are radiances:
// a quarter of (0.015, 0.025, 0.12), (0.55, 0.12, 0.28), (0.98, 0.42, 0.12) and (0.12, 0.04, 0.03).
const GRADIENT: TypeSchema = TypeSchema {
    kind: Kind::Sky,
    name: "gradient",
    doc: "Bands of colour over the height of the direction (the sine of its elevation), joined without \
          kinks, and around `sun.direction` a wide glow and a narrow disc. The defaults are a sunset. \
          With a glow or a disc the sky takes part in sampling lights.",
    example: "sky dusk: gradient { sun.direction = (0.69, 0.2, -0.69), strength = 2 }",
    fields: &[
        band("zenith", [0.003_75, 0.006_25, 0.03], "Straight up, at height 1."),
        band(
            "middle",
            [0.137_5, 0.03, 0.07],
            "`blend.high` of the way from `blend.low` to the zenith.",
        ),
        band("horizon", [0.245, 0.105, 0.03], "At height `blend.low`."),
        band("ground", [0.03, 0.01, 0.007_5], "From `blend.ground` below `blend.low` downwards."),
        Field::new(
            "base",
            FieldType::Number(Bounds::number(0.0, ANY)),
            Default::Number(1.0),
            "Factor on the four bands; glow and disc keep theirs.",
        ),
        Field::new(
            "blend.high",
            FieldType::Number(Bounds::new(Dim::NONE, "", 0.01, 0.99)),
            Default::Number(0.38),
            "Where the middle band lies, as a share of the height between `blend.low` and the zenith: \
             with the default `blend.low`, 0.38 is height 0.287.",
        ),
        Field::new(
            "blend.low",
            FieldType::Number(Bounds::new(Dim::NONE, "", -0.99, 0.5)),
            Default::Number(-0.15),
            "Height of the horizon band; a little below 0, so that its colour is full where hills end.",
        ),
        Field::new(
            "blend.ground",
            FieldType::Number(Bounds::new(Dim::NONE, "", 0.01, 2.0)),
            Default::Number(0.4),
            "How much lower than `blend.low` the ground colour is reached.",
        ),
        STRENGTH,
        Field::new(
            "sun.direction",
            FieldType::Vector(Dim::NONE, ""),
            Default::Absent("no glow and no disc"),
            "Points towards the sun; its length does not matter.",
        )
        .foreign(&[
            ("sundir", "LuxCore"),
            ("sun_direction", "Mitsuba and Blender"),
            ("dir", "LuxCore"),
        ]),
        band("glow.color", [0.7, 0.21, 0.035], "Radiance added towards the sun."),
        exponent("glow.power", 6.0, "The glow falls with this power of the cosine."),
        band("disc.color", [15.0, 12.75, 6.0], "Radiance added at the sun itself."),
        exponent("disc.power", 400.0, "The disc falls with this power of the cosine."),
    ],
    foreign: &[("sunsky", "Mitsuba"), ("sky2", "LuxCore"), ("sky_texture", "Blender")],
};

const IMAGE: TypeSchema = TypeSchema {
    kind: Kind::Sky,
    name: "image",
    doc: "Radiance from an image of all directions (lat-long, twice as wide as high, HDR or EXR). The \
          middle of the image lies towards -z, its right half towards +x, its top row is straight up. \
          Bright parts are sampled as lights.",
    example: "sky garden: image { file = \"garden.hdr\", rotate = 90deg, strength = 0.8 }",
    fields: &[
        Field::new(
            "file",
            FieldType::Path,
            Default::Required,
            "The image, relative to the `.rts` file that says it.",
        )
        .foreign(&[
            ("filename", "pbrt and Mitsuba"),
            ("path", "textures"),
            ("Image", "Blender"),
        ]),
        Field::new(
            "rotate",
            FieldType::Number(Bounds::new(Dim::ANGLE, "deg", -ANY, ANY)),
            Default::Number(0.0),
            "Turns the sky about the vertical axis, as `rotate` of an instance does about y: +90deg \
             brings what was towards -z to -x.",
        )
        .foreign(&[("to_world", "Mitsuba"), ("transformation", "LuxCore"), ("azimuth", "common use")]),
        STRENGTH,
    ],
    foreign: &[
        ("envmap", "Mitsuba"),
        ("environment", "Blender"),
        ("hdri", "common use"),
        ("imagemap", "common use"),
    ],
};

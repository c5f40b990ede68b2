//! Skies: `sky NAME: TYPE { ... }`. Each is declared here: schema, value, how it is read from checked fields, and how
//! it is written.

use crate::check::Fields;
use crate::check::light::{check_direction, scaled, unit};
use crate::diagnostic::{Code, Diagnostic};
use crate::eval::Evaluator;
use crate::eval::color::blackbody;
use crate::material::VISIBLE;
use crate::resolved::{Declared, number, vector};
use crate::scene::{Name, Rgb};
use crate::schema::instance::GROUP;
use crate::schema::light::{DIAMETER, SUN_DIAMETER};
use crate::schema::{
    ANY, Bounds, Default, Field, FieldType, Kind, TypeSchema, WHITE, color_text, types,
};
use crate::source::Span;
use crate::units::{self, Dim};

/// What a ray sees that leaves the scene.
#[derive(Clone, Debug, PartialEq)]
pub struct Sky {
    /// Declared name.
    pub name: Name,
    /// Where its radiance comes from.
    pub model: SkyModel,
    /// Whether the camera sees it, and the sun in it.
    pub visible: bool,
    /// Its light group, if it names one.
    pub group: Option<String>,
}

/// Sky models; all colours are radiance.
#[derive(Clone, Debug, PartialEq)]
pub enum SkyModel {
    /// One radiance for every direction.
    Constant(Rgb),
    /// Bands over the sine of the elevation: `zenith` at 1, `horizon` at `blend_low`, `middle` at
    /// `blend_high` of the way between them, `ground` from `blend_ground` below `blend_low` downwards;
    /// plus glow and disc around `sun_direction`.
    Gradient {
        /// Straight up.
        zenith: Rgb,
        /// Between horizon and zenith.
        middle: Rgb,
        /// At sine `blend_low`.
        horizon: Rgb,
        /// Lowest.
        ground: Rgb,
        /// Share of the height from `blend_low` to the zenith, in (0, 1).
        blend_high: f64,
        /// Sine of the elevation, in (-1, 1).
        blend_low: f64,
        /// How much below `blend_low` the ground is reached, > 0; beyond -1 it is not quite.
        blend_ground: f64,
        /// Unit vector towards the sun.
        sun_direction: [f64; 3],
        /// Added radiance, times `cos^glow_power`.
        glow: Rgb,
        /// Exponent, >= 1.
        glow_power: f64,
        /// Added radiance, times `cos^disc_power`.
        disc: Rgb,
        /// Exponent, >= 1.
        disc_power: f64,
    },
    /// A lat-long image: its middle towards -z, its right half towards +x, its top row straight up.
    Image {
        /// Path relative to the directory of the `.rts` file that declares it, as written.
        path: String,
        /// The path literal.
        path_span: Span,
        /// Turn about +y, radians, right-handed.
        rotate: f64,
        /// Factor on the radiance in the image.
        strength: f64,
    },
    /// A clear day.
    SunSky(SunSky),
}

/// Air, sun and ground of a clear day.
#[derive(Clone, Debug, PartialEq)]
pub struct SunSky {
    /// Unit vector towards the sun, world frame.
    pub sun_direction: [f64; 3],
    /// Half the angle that the sun fills, radians, > 0.
    pub half_angle: f64,
    /// Colour of sunlight above the air, of luminance 1.
    pub sun: Rgb,
    /// Vertical optical depth of air and haze over that of air alone, >= 1.
    pub turbidity: f64,
    /// Share of light that the ground returns, 0 ..= 1.
    pub ground: Rgb,
    /// Factor on all of its light.
    pub strength: f64,
}

/// Temperature of the sun as a black body, kelvin (IAU 2015, resolution B3: 5772 K).
const SUN_TEMPERATURE: f64 = 5772.0;

impl Sky {
    /// Name of its type, and its fields as they would be written.
    pub(crate) fn shown(&self) -> Declared {
        let one = ("strength", "1".to_owned());
        let (kind, mut fields) = match &self.model {
            SkyModel::Constant(rgb) => ("constant", vec![("color", color_text(*rgb)), one]),
            SkyModel::Gradient {
                zenith,
                middle,
                horizon,
                ground,
                blend_high,
                blend_low,
                blend_ground,
                sun_direction,
                glow,
                glow_power,
                disc,
                disc_power,
            } => {
                let rgb = |rgb: &Rgb| color_text(*rgb);
                let fields = vec![
                    ("zenith", rgb(zenith)),
                    ("middle", rgb(middle)),
                    ("horizon", rgb(horizon)),
                    ("ground", rgb(ground)),
                    ("base", "1".to_owned()),
                    ("blend.high", number(*blend_high)),
                    ("blend.low", number(*blend_low)),
                    ("blend.ground", number(*blend_ground)),
                    one,
                    ("sun.direction", vector(*sun_direction, "")),
                    ("glow.color", rgb(glow)),
                    ("glow.power", number(*glow_power)),
                    ("disc.color", rgb(disc)),
                    ("disc.power", number(*disc_power)),
                ];
                ("gradient", fields)
            }
            SkyModel::Image { path, rotate, strength, .. } => {
                let fields = vec![
                    ("file", format!("\"{path}\"")),
                    ("rotate", units::show(*rotate, Dim::ANGLE)),
                    ("strength", number(*strength)),
                ];
                ("image", fields)
            }
            SkyModel::SunSky(sky) => {
                let fields = vec![
                    ("sun.direction", vector(sky.sun_direction, "")),
                    ("sun.angular_diameter", units::show(2.0 * sky.half_angle, Dim::ANGLE)),
                    ("turbidity", number(sky.turbidity)),
                    ("ground.albedo", color_text(sky.ground)),
                    ("strength", number(sky.strength)),
                ];
                ("sun_sky", fields)
            }
        };
        if !self.visible {
            fields.push(("visible", "off".to_owned()));
        }
        fields.extend(self.group.iter().map(|group| ("group", format!("\"{group}\""))));
        (kind, fields)
    }
}

/// Checks how the fields of a sky go together.
pub(crate) fn check(ev: &mut Evaluator<'_>, fields: &Fields) {
    match SkyType::of(fields.schema) {
        SkyType::Gradient => {}
        SkyType::SunSky => return check_direction(ev, fields, "sun.direction"),
        SkyType::Constant | SkyType::Image => return,
    }
    if !fields.has("sun.direction") {
        for name in ["glow.color", "glow.power", "disc.color", "disc.power"] {
            if let Some(span) = fields.span(name).filter(|_| fields.has(name)) {
                let text = format!("`{name}` does nothing without `sun.direction`");
                let error = Diagnostic::error(Code("E0207"), text)
                    .at(span, "around which direction?")
                    .with_help("write `sun.direction = (0.69, 0.2, -0.69)`, or leave this out");
                ev.fault(error);
                return;
            }
        }
    }
    check_direction(ev, fields, "sun.direction");
}

/// Builds a sky. `None` only for fields with faults.
pub(crate) fn read(name: Name, fields: &Fields) -> Option<Sky> {
    let strength = fields.number("strength")?;
    let color = |field: &str| Some(scaled(fields.color(field)?, strength));
    let model = match SkyType::of(fields.schema) {
        SkyType::Constant => SkyModel::Constant(color("color")?),
        SkyType::Image => SkyModel::Image {
            path: fields.text("file")?,
            path_span: fields.value_span("file")?,
            rotate: fields.number("rotate")?,
            strength,
        },
        SkyType::Gradient => gradient(fields, strength)?,
        SkyType::SunSky => SkyModel::SunSky(SunSky {
            sun_direction: unit(fields.vector("sun.direction")?)?,
            half_angle: 0.5 * fields.number("sun.angular_diameter")?,
            sun: blackbody(SUN_TEMPERATURE),
            turbidity: fields.number("turbidity")?,
            ground: fields.color("ground.albedo")?,
            strength,
        }),
    };
    let visible = fields.word("visible")? == "on";
    Some(Sky { name, model, visible, group: fields.text("group") })
}

fn gradient(fields: &Fields, strength: f64) -> Option<SkyModel> {
    let base = fields.number("base")? * strength;
    let color = |field: &str| Some(scaled(fields.color(field)?, strength));
    let band = |field: &str| Some(scaled(fields.color(field)?, base));
    let direction = fields.vector::<3>("sun.direction");
    let around_sun = |field: &str| match direction {
        Some(_) => color(field),
        None => Some([0.0; 3]),
    };
    Some(SkyModel::Gradient {
        zenith: band("zenith")?,
        middle: band("middle")?,
        horizon: band("horizon")?,
        ground: band("ground")?,
        blend_high: fields.number("blend.high")?,
        blend_low: fields.number("blend.low")?,
        blend_ground: fields.number("blend.ground")?,
        sun_direction: unit(direction.unwrap_or([0.0, 1.0, 0.0]))?,
        glow: around_sun("glow.color")?,
        glow_power: fields.number("glow.power")?,
        disc: around_sun("disc.color")?,
        disc_power: fields.number("disc.power")?,
    })
}

/// Is it black everywhere?
pub(crate) fn is_black(sky: &Sky) -> bool {
    let black = |rgb: &Rgb| rgb.iter().all(|c| *c == 0.0);
    match &sky.model {
        SkyModel::Constant(rgb) => black(rgb),
        SkyModel::Gradient { zenith, middle, horizon, ground, glow, disc, .. } => {
            [zenith, middle, horizon, ground, glow, disc].into_iter().all(black)
        }
        SkyModel::Image { strength, .. } | SkyModel::SunSky(SunSky { strength, .. }) => {
            *strength <= 0.0
        }
    }
}

types!(SkyType { Constant = CONSTANT, Gradient = GRADIENT, Image = IMAGE, SunSky = SUN_SKY });

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
        VISIBLE,
        GROUP,
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
    doc: "Bands of colour over the height of the direction (the sine of its elevation), joined without kinks, and \
         around `sun.direction` a wide glow and a narrow disc. The defaults are a sunset. With a glow or a disc the \
         sky takes part in sampling lights.",
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
        VISIBLE,
        GROUP,
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
    foreign: &[],
};

const IMAGE: TypeSchema = TypeSchema {
    kind: Kind::Sky,
    name: "image",
    doc: "Radiance from an image of all directions (lat-long, twice as wide as high, HDR or EXR). The middle of the \
         image lies towards -z, its right half towards +x, its top row is straight up. Bright parts are sampled as \
         lights.",
    example: "sky garden: image { file = \"garden.hdr\", rotate = 90deg, strength = 0.8 }",
    fields: &[
        Field::new(
            "file",
            FieldType::Path,
            Default::Required,
            "The image, relative to the `.rts` file that names it.",
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
        VISIBLE,
        GROUP,
    ],
    foreign: &[
        ("envmap", "Mitsuba"),
        ("environment", "Blender"),
        ("hdri", "common use"),
        ("imagemap", "common use"),
    ],
};

const SUN_SKY: TypeSchema = TypeSchema {
    kind: Kind::Sky,
    name: "sun_sky",
    doc: "A clear day: blue sky, haze, the sun with the light that the air leaves it, and level ground below the \
         horizon, after Hillaire 2020. The sun is a `directional` light. All is as bright as outdoors: a high sun \
         gives 110 klx, and pictures want an `exposure` of about -5EV.",
    example: "sky day: sun_sky { sun.direction = (0.3, 0.8, 0.4), turbidity = 2 }",
    fields: &[
        Field::new(
            "sun.direction",
            FieldType::Vector(Dim::NONE, ""),
            Default::Required,
            "Points towards the sun; its length does not matter. A sun below the horizon leaves twilight.",
        )
        .foreign(&[
            ("sundir", "LuxCore"),
            ("sun_direction", "Mitsuba and Blender"),
            ("direction", "lights"),
            ("sun_elevation", "Blender"),
        ]),
        Field::new(
            "sun.angular_diameter",
            DIAMETER,
            SUN_DIAMETER,
            "The angle that the sun fills; larger means softer shadows, and as much light.",
        )
        .foreign(&[("sun_size", "Blender"), ("angular_diameter", "lights")]),
        Field::new(
            "turbidity",
            FieldType::Number(Bounds::number(1.0, 10.0)),
            Default::Number(1.1),
            "How hazy it is: the vertical optical depth of air and haze over that of air alone, in green.",
        )
        .typical("mountain air 1.1, a clear day 2, haze 4"),
        Field::new(
            "ground.albedo",
            FieldType::Color(1.0),
            Default::Color([0.3; 3]),
            "Share of light that the ground returns, which the sky scatters again.",
        )
        .typical("sea 0.05, grass and earth 0.2, sand 0.4, snow 0.8")
        .foreign(&[("ground_albedo", "Mitsuba and Blender"), ("albedo", "Mitsuba"), ("groundalbedo", "LuxCore")]),
        Field { doc: "Factor on all of its light.", ..STRENGTH },
        VISIBLE,
        GROUP,
    ],
    foreign: &[
        ("sunsky", "Mitsuba"),
        ("sky2", "LuxCore"),
        ("sky_texture", "Blender"),
        ("nishita", "Blender"),
        ("hosek", "common use"),
        ("preetham", "common use"),
        ("atmosphere", "common use"),
    ],
};

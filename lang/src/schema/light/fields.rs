//! Fields that several types of lights share, with their ranges.

use crate::schema::{ANY, Bounds, Default, Field, FieldType, Kind, WHITE, Word};
use crate::units::Dim;

/// 80 degrees: at 90 the origin of the world would touch the light.
pub(super) const MAX_ANGULAR_RADIUS: f64 = 80.0 * std::f64::consts::PI / 180.0;

/// Half a degree: cosines in single precision tell narrower cones apart badly.
pub(super) const LEAST_CONE: f64 = 0.5 * std::f64::consts::PI / 180.0;

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
pub(super) const MESH_SIDES: &[Word] =
    &[("front", "only the side that its normals point to"), ("both", "front and back")];

pub(super) const LENGTH: FieldType = FieldType::Number(Bounds::above(Dim::LENGTH, "m", 0.0));

/// How strong the light is that a whole emitter gives off.
const POWERS: FieldType =
    FieldType::Quantity(&[(Dim::POWER, "W"), (Dim::LUMINOUS_FLUX, "lm"), (Dim::NONE, "")]);

/// The same in one direction.
const INTENSITIES: FieldType =
    FieldType::Quantity(&[(Dim::LUMINOUS_INTENSITY, "cd"), (Dim::INTENSITY, "W/sr")]);

/// What arrives of it at a plane that faces it.
pub(super) const ILLUMINANCES: FieldType =
    FieldType::Quantity(&[(Dim::ILLUMINANCE, "lx"), (Dim::IRRADIANCE, "W/m2")]);

/// The same of each part of its surface.
const RADIANCES: FieldType =
    FieldType::Quantity(&[(Dim::NONE, ""), (Dim::RADIANCE, "W/m2/sr"), (Dim::LUMINANCE, "nit")]);

pub(super) const COLOR: Field =
    Field::new("color", FieldType::Color(ANY), Default::Color(WHITE), "Colour of the light.")
        .typical("candle `blackbody(1900K)`, bulb 2800K, noon 5500K")
        .foreign(&[("L", "pbrt"), ("I", "pbrt"), ("radiance", "Mitsuba"), ("emission", "LuxCore")]);

pub(super) const TEMPERATURE: Field = Field::new(
    "temperature",
    FieldType::Number(Bounds::new(Dim::TEMPERATURE, "K", 500.0, 100_000.0)),
    Default::Absent("`color` decides"),
    "Short for `color = blackbody(...)`.",
)
.typical("candle 1900K, bulb 2800K, noon 5500K, overcast sky 6500K");

pub(super) const STRENGTH: Field = Field::new(
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

pub(super) const POWER: Field = Field::new(
    "power",
    POWERS,
    Default::Absent("`strength` decides"),
    "All the light it gives off: watts for a white light, or lumens, 683 to the watt of luminous power.",
)
.typical("an old 60W bulb gives 800lm, a candle 12lm")
.foreign(&[("flux", "common use"), ("watts", "common use"), ("lumens", "common use")]);

pub(super) const INTENSITY: Field = Field::new(
    "intensity",
    INTENSITIES,
    Default::Absent("`strength` decides"),
    "How much light it gives off in each direction: candelas, or watts per steradian for a white light.",
)
.typical("a candle 1cd, a car's high beam 40kcd")
.foreign(&[("candela", "common use")]);

/// A point has no surface to ask for its radiance.
pub(super) const POINT_INTENSITY: Field =
    Field { default: Default::Absent("`power` decides"), ..INTENSITY };
pub(super) const POINT_POWER: Field =
    Field { default: Default::Absent("`intensity` decides"), ..POWER };

/// Of lamps that are small.
pub(super) const RADIUS: Field = Field::new(
    "radius",
    LENGTH,
    Default::Number(0.01),
    "Distance from the middle to the surface; larger means softer shadows.",
)
.foreign(&[("shadow_soft_size", "Blender"), ("size", "common use")]);

pub(super) const AT: Field = Field::new(
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
pub(super) const ONLY: Field = Field::new(
    "only",
    FieldType::Names(Kind::Instance),
    Default::Absent("all"),
    "Light linking: it lights these instances and nothing else. Everything still casts a shadow, and the camera \
     still sees the light; a mirror that is not listed does not show it.",
)
.typical("`[vase, plinth]`")
.foreign(&[("light_linking", "Blender"), ("include", "common use"), ("links", "common use")]);

/// Light linking, the other way round.
pub(super) const EXCEPT: Field = Field::new(
    "except",
    FieldType::Names(Kind::Instance),
    Default::Absent("none"),
    "Light linking: it lights everything but these instances. See `only`.",
)
.foreign(&[("exclude", "common use")]);

pub(super) const TO: Field = Field::new(
    "to",
    FieldType::Vector(Dim::LENGTH, "m"),
    Default::Absent("`direction` decides"),
    "A point that it faces.",
)
.foreign(&[("target", "common use"), ("look_at", "common use")]);

pub(super) const DIRECTION: Field = Field::new(
    "direction",
    FieldType::Vector(Dim::NONE, ""),
    Default::Vector([0.0, -1.0, 0.0]),
    "Which way it faces; its length does not matter.",
)
.foreign(&[("normal", "common use")]);

/// Of lamps with a profile.
pub(super) const PROFILE_TO: Field =
    Field { doc: "A point to which the beam of `profile` goes.", ..TO };
pub(super) const PROFILE_DIRECTION: Field =
    Field { doc: "Which way the beam of `profile` goes; its length does not matter.", ..DIRECTION };

pub(super) const SPIN: Field = Field::new(
    "spin",
    FieldType::Number(Bounds::new(Dim::ANGLE, "deg", f64::NEG_INFINITY, ANY)),
    Default::Number(0.0),
    "Turns it about `direction`, counter-clockwise for someone who looks at it.",
);

/// Of flat lights.
pub(super) const PANEL_SIDES: Field = Field::new(
    "sides",
    FieldType::Word(SIDES),
    Default::Word("front"),
    "Which sides give off light.",
)
.foreign(&[("twosided", "pbrt"), ("two_sided", "common use")]);

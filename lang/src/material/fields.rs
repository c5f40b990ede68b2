//! Fields that several materials have, and those of the simple ones.

use crate::medium::{COEFFICIENT, SIGMA_A_NAMES};
use crate::schema::{ANY, Bounds, Default, Field, FieldType, Kind, Word};
use crate::units::Dim;

/// Names that other renderers give the colour of a surface.
pub(super) const COLOR_NAMES: &[(&str, &str)] = &[
    ("Kd", "pbrt-v3, OBJ/MTL and LuxCore"),
    ("kd", "LuxCore"),
    ("Kr", "pbrt-v3 and LuxCore"),
    ("Ks", "OBJ/MTL"),
    ("albedo", "common use"),
    ("reflectance", "pbrt-v4 and Mitsuba"),
    ("specular_reflectance", "Mitsuba"),
    ("baseColor", "glTF"),
    ("baseColorFactor", "glTF"),
    ("baseColorTexture", "glTF"),
    ("base_color", "Mitsuba and Blender"),
    ("diffuse", "common use"),
    ("map_Kd", "OBJ/MTL"),
];

/// Names that other renderers give the refractive index.
pub(super) const IOR_NAMES: &[(&str, &str)] = &[
    ("eta", "pbrt"),
    ("int_ior", "Mitsuba"),
    ("interiorior", "LuxCore"),
    ("Ni", "OBJ/MTL"),
    ("IOR", "Blender"),
    ("index", "pbrt-v3"),
    ("refractive_index", "common use"),
];

pub(super) const STRENGTH_NAMES: &[(&str, &str)] = &[
    ("scale", "pbrt"),
    ("gain", "LuxCore"),
    ("intensity", "common use"),
    ("emissiveStrength", "glTF"),
    ("Strength", "Blender"),
];

/// Names that other renderers give perceptual roughness.
pub(super) const ROUGHNESS_NAMES: &[(&str, &str)] = &[
    ("roughnessFactor", "glTF"),
    ("Roughness", "Blender"),
    ("alpha_roughness", "common use"),
    ("Pr", "OBJ/MTL"),
];

pub(super) const IOR: Field = Field::new(
    "ior",
    FieldType::Number(Bounds::number(1.0, 10.0)),
    Default::Number(1.5),
    "Refractive index against the air outside.",
)
.typical("water 1.333, window glass 1.52, diamond 2.42")
.foreign(IOR_NAMES);

/// A tangent-space normal map.
pub(super) const NORMAL: Field = Field::new(
    "normal",
    FieldType::NormalSlot,
    Default::Absent("the surface's own normal"),
    "Normal map: red is the tilt along u, green along v (up in the image, as in glTF), blue out of the surface.",
)
.foreign(&[
    ("normalTexture", "glTF"),
    ("normalmap", "pbrt-v4 and Mitsuba"),
    ("normaltex", "LuxCore"),
    ("norm", "OBJ/MTL"),
    ("Normal", "Blender"),
    ("normal_map", "common use"),
]);

pub(super) const NORMAL_STRENGTH: Field = Field::new(
    "normal.strength",
    FieldType::Number(Bounds::number(0.0, 10.0)),
    Default::Number(1.0),
    "Factor on the tilt of `normal`; 0 leaves the surface as it is.",
)
.typical("1 as the map was made, 0.5 for half as steep")
.foreign(&[("normalScale", "glTF"), ("normal_strength", "common use")]);

const fn ingredient(name: &'static str, doc: &'static str) -> Field {
    Field::new(name, FieldType::Name(Kind::Material), Default::Required, doc)
}

pub(super) const MIX_A: Field = ingredient("a", "The material where `amount` is 0.")
    .foreign(&[("first", "common use"), ("material1", "LuxCore")]);
pub(super) const MIX_B: Field = ingredient("b", "The material where `amount` is 1.")
    .foreign(&[("second", "common use"), ("material2", "LuxCore")]);
pub(super) const MIX_AMOUNT: Field = Field::new(
    "amount",
    FieldType::ScalarSlot(UNIT),
    Default::Number(0.5),
    "Share of `b`: a number, or one of a texture, such as `mask.r`, `noise(...)` or `checker(...)`.",
)
.foreign(&[("weight", "Mitsuba"), ("Fac", "Blender"), ("factor", "common use"), ("share", "common use")]);

pub(super) const INTERIOR: Field = Field::new(
    "interior",
    FieldType::Name(Kind::Medium),
    Default::Absent("clear"),
    "What fills it: a `homogeneous` medium. The shape must be closed.",
)
.foreign(&[
    ("inside", "pbrt"),
    ("volume_interior", "LuxCore"),
    ("MediumInterface", "pbrt"),
    ("Volume", "Blender"),
]);

pub(super) const PRIORITY: Field = Field::new(
    "priority",
    FieldType::Integer(0, 1_000_000),
    Default::Number(0.0),
    "Where things overlap, only the one with the greatest priority is there; of equals, the one that light entered \
     last. With media or priorities in the scene, light refracts against whatever surrounds a thing; otherwise \
     against air.",
)
.typical("water 1 in a glass 2, the two overlapping a little")
.foreign(&[("nested_priority", "common use")]);

pub(super) const fn reflectance(default: Default) -> Field {
    Field::new("color", FieldType::ColorSlot(1.0), default, "Share of the light that is reflected.")
        .typical("charcoal 0.04, clay 0.4, fresh snow 0.9")
        .foreign(COLOR_NAMES)
}

pub(super) const ALPHA: Field = Field::new(
    "alpha",
    FieldType::ScalarSlot(UNIT),
    Default::Number(1.0),
    "Coverage: the share of the surface that is there; the rest of the light goes straight on. With `alpha.clip` it \
     is only compared with that.",
)
.foreign(&[("opacity", "Mitsuba"), ("d", "OBJ/MTL"), ("map_d", "OBJ/MTL"), ("Alpha", "Blender")]);

pub(super) const ALPHA_CLIP: Field = Field::new(
    "alpha.clip",
    FieldType::Number(Bounds::new(Dim::NONE, "", 0.0, 1.0)),
    Default::Absent("`alpha` is a share"),
    "Where `alpha` is below this, the surface is not there; elsewhere it is there in full.",
)
.typical("50% for leaves and petals")
.foreign(&[("alphaCutoff", "glTF"), ("alphaMode", "glTF")]);

pub(super) const WAVES: &[Word] = &[("on", "rippled"), ("off", "flat")];

pub(super) const SIDES: &[Word] =
    &[("front", "only the side that the normal points to"), ("both", "front and back")];

pub(super) const UNIT: Bounds = Bounds::number(0.0, 1.0);

pub(super) const METAL_FUZZ: Field = Field::new(
    "fuzz",
    FieldType::Number(Bounds::number(0.0, 1.0)),
    Default::Number(0.0),
    "Radius of the ball; 0 is a perfect mirror.",
)
.typical("polished 0 to 0.05, brushed 0.2 to 0.4")
.foreign(&[
    ("roughness", "pbrt, glTF and Blender"),
    ("alpha", "Mitsuba"),
    ("uroughness", "pbrt-v3 and LuxCore"),
    ("Ns", "OBJ/MTL"),
]);

pub(super) const EMISSIVE_COLOR: Field =
    Field::new("color", FieldType::ColorSlot(ANY), Default::Required, "Colour of the light.")
        .foreign(&[
            ("L", "pbrt"),
            ("radiance", "Mitsuba"),
            ("emission", "LuxCore"),
            ("Ke", "OBJ/MTL"),
            ("emissiveFactor", "glTF"),
            ("Color", "Blender"),
        ]);

pub(super) const EMISSIVE_STRENGTH: Field = Field::new(
    "strength",
    FieldType::Number(Bounds::number(0.0, ANY)),
    Default::Number(1.0),
    "Factor on `color`, in W/(m2 sr) up to the scale of the scene.",
)
.foreign(STRENGTH_NAMES);

pub(super) const EMISSIVE_POWER: Field = Field::new(
    "power",
    FieldType::Number(Bounds::new(Dim::POWER, "W", 0.0, ANY)),
    Default::Absent("`strength` decides"),
    "What everything made of this material gives off together, in watts where `color` is white; `strength` then \
     follows from its area. Closed shapes shine outwards only.",
)
.typical("a 60W bulb gives off about 5W of light; `mesh` lights take lumens, too")
.foreign(&[("flux", "common use"), ("watts", "common use")]);

pub(super) const EMISSIVE_SIDES: Field = Field::new(
    "sides",
    FieldType::Word(SIDES),
    Default::Word("both"),
    "Which sides of the surface give off light.",
)
.foreign(&[("twosided", "pbrt"), ("two_sided", "common use"), ("doubleSided", "glTF")]);

/// Of whatever gives off light.
pub(crate) const VISIBLE: Field = Field::new(
    "visible",
    FieldType::Word(&[("on", "it does"), ("off", "it sees past it")]),
    Default::Word("on"),
    "Whether the camera sees it. Its light, its shadow and its reflections remain.",
)
.foreign(&[
    ("visible_camera", "Blender"),
    ("camera_visibility", "common use"),
    ("primary_visibility", "common use"),
]);

pub(super) const WATER_IOR: Field = Field::new(
    "ior",
    FieldType::Number(Bounds::number(1.0, 10.0)),
    Default::Number(1.333),
    "Refractive index against air.",
)
.foreign(IOR_NAMES);

pub(super) const WATER_SIGMA_A: Field = Field::new(
    "sigma_a",
    FieldType::Spectrum(COEFFICIENT),
    Default::Vector([0.35, 0.06, 0.025]),
    "Absorption: over a length d the share exp(-sigma_a d) of the light is left.",
)
.typical("clear lake (0.35, 0.06, 0.025)/m, distilled 0.01/m")
.foreign(SIGMA_A_NAMES);

pub(super) const WATER_INTERIOR: Field = Field::new(
    "interior",
    FieldType::Name(Kind::Medium),
    Default::Absent("`sigma_a` decides"),
    "A `homogeneous` medium instead, for murky water. The shape must be closed.",
);

pub(super) const WATER_WAVES: Field = Field::new(
    "waves",
    FieldType::Word(WAVES),
    Default::Word("on"),
    "Whether the surface is rippled.",
);

pub(super) const WATER_WAVES_SCALE: Field = Field::new(
    "waves.scale",
    FieldType::Number(Bounds::number(0.0, 1e6)),
    Default::Number(0.4),
    "How close the waves are; at 1 the longest are 1.4m, at 0.4 they are 3.6m.",
)
.typical("pond 0.4, pool 2, puddle 10");

pub(super) const WATER_WAVES_HEIGHT: Field = Field::new(
    "waves.height",
    FieldType::Number(Bounds::number(0.0, 20.0)),
    Default::Number(1.0),
    "Factor on their slopes; at 1 the steepest is 0.04.",
)
.typical("calm 0.2, breeze 1, wind 4");

pub(super) const WATER_DEPTH_COLOR: Field = Field::new(
            "depth.color",
            FieldType::Color(ANY),
            Default::Color([0.02, 0.06, 0.10]),
            "Radiance of the deep as seen from above the surface, where light leaves the scene under water.",
        )
        .typical("on the scale of the sky's radiance")
        .foreign(&[("deep_color", "common use")]);

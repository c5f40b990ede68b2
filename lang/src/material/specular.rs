//! Fields of `conductor`, `dielectric`, `clearcoat`.

use super::fields::{COLOR_NAMES, IOR_NAMES, ROUGHNESS_NAMES, UNIT};
use crate::schema::{Bounds, Default, Field, FieldType, WHITE, Word};

pub(super) const SWITCH: &[Word] = &[("on", "it takes part"), ("off", "it is left out")];

pub(super) const CONDUCTOR_ROUGHNESS_NAMES: &[(&str, &str)] = &[
    ("fuzz", "material type `metal`"),
    ("roughnessFactor", "glTF"),
    ("Roughness", "Blender"),
    ("alpha_roughness", "common use"),
    ("uroughness", "pbrt-v3 and LuxCore"),
    ("Pr", "OBJ/MTL"),
];

pub(super) const CONDUCTOR_COLOR: Field = Field::new(
    "color",
    FieldType::ColorSlot(1.0),
    Default::Required,
    "Share of the light that is reflected at normal incidence; at grazing incidence all of it is.",
)
.typical("silver 0.97, 0.96, 0.92; copper 0.95, 0.64, 0.54; iron 0.56, 0.57, 0.58")
.foreign(COLOR_NAMES);

pub(super) const CONDUCTOR_ROUGHNESS: Field = Field::new(
            "roughness",
            FieldType::ScalarSlot(UNIT),
            Default::Number(0.2),
            "Perceptual roughness; the width of the highlight grows with its square. Below 0.0317 it is a mirror.",
        )
        .typical("polished 0.1, satin 0.3, cast 0.6")
        .foreign(CONDUCTOR_ROUGHNESS_NAMES);

pub(super) const CONDUCTOR_ANISOTROPY: Field = Field::new(
    "anisotropy",
    FieldType::Number(UNIT),
    Default::Number(0.0),
    "How much wider the highlight is along u than along v: ten times at 1.",
)
.typical("brushed steel 0.6 to 0.9")
.foreign(&[
    ("anisotropic", "Blender, Mitsuba and Disney"),
    ("Anisotropic", "Blender"),
    ("anisotropyStrength", "glTF"),
]);

pub(super) const COMPENSATION: Field = Field::new(
    "compensation",
    FieldType::Word(SWITCH),
    Default::Word("on"),
    "Whether light that the rough surface reflects several times counts; without it rough surfaces are too dark.",
);

pub(super) const DIELECTRIC_ROUGHNESS: Field = Field::new(
    "roughness",
    FieldType::ScalarSlot(UNIT),
    Default::Number(0.0),
    "Perceptual roughness of both sides of the surface; 0 is polished.",
)
.typical("polished 0, frosted 0.3 to 0.6")
.foreign(ROUGHNESS_NAMES);

pub(super) const CLEARCOAT_FUZZ: Field = Field::new(
    "fuzz",
    FieldType::Number(Bounds::number(0.0, 1.0)),
    Default::Number(0.2),
    "Radius of the ball that blurs what the coat reflects; 0 is a perfect gloss.",
)
.typical("wet 0, lacquer 0.05, wax 0.2")
.foreign(&[
    ("roughness", "pbrt, glTF and Blender"),
    ("clearcoatRoughnessFactor", "glTF"),
    ("coat_roughness", "Blender"),
    ("alpha", "Mitsuba"),
]);

pub(super) const CLEARCOAT_COAT_IOR: Field = Field::new(
    "coat.ior",
    FieldType::Number(Bounds::number(1.0, 10.0)),
    Default::Number(1.5),
    "Refractive index of the coat.",
)
.typical("lacquer 1.5, 6% at normal incidence 1.65")
.foreign(IOR_NAMES);

pub(super) const CLEARCOAT_COAT_TINT: Field = Field::new(
    "coat.tint",
    FieldType::Color(1.0),
    Default::Color(WHITE),
    "Factor on what the coat reflects.",
)
.foreign(&[("coat_tint", "Blender"), ("ks", "LuxCore"), ("specular", "common use")]);

//! Metals and clear media by physics: `conductor`, `dielectric`, `clearcoat`.

use super::{
    COLOR_NAMES, INTERIOR, IOR, IOR_NAMES, NORMAL, NORMAL_STRENGTH, PRIORITY, ROUGHNESS_NAMES,
    UNIT, reflectance,
};
use crate::schema::{Bounds, Default, Field, FieldType, Kind, TypeSchema, WHITE, Word};

const SWITCH: &[Word] = &[("on", "it takes part"), ("off", "it is left out")];

pub(super) const CONDUCTOR: TypeSchema = TypeSchema {
    kind: Kind::Material,
    name: "conductor",
    doc: "Metal with a rough surface (GGX). Its highlights stretch towards grazing light, and light \
          that is reflected several times is not lost.",
    example: "material gold: conductor { color = linear(1, 0.71, 0.29), roughness = 0.3 }",
    fields: &[
        Field::new(
            "color",
            FieldType::ColorSlot(1.0),
            Default::Required,
            "Share of the light that is reflected at normal incidence; all is at grazing.",
        )
        .typical("silver 0.97, 0.96, 0.92; copper 0.95, 0.64, 0.54; iron 0.56, 0.57, 0.58")
        .foreign(COLOR_NAMES),
        Field::new(
            "roughness",
            FieldType::ScalarSlot(UNIT),
            Default::Number(0.2),
            "Perceptual roughness; the width of the highlight grows with its square. Below 0.0317 a mirror.",
        )
        .typical("polished 0.1, satin 0.3, cast 0.6")
        .foreign(CONDUCTOR_ROUGHNESS_NAMES),
        Field::new(
            "anisotropy",
            FieldType::Number(UNIT),
            Default::Number(0.0),
            "How much wider the highlight is along u than along v: at 1 ten times.",
        )
        .typical("brushed steel 0.6 to 0.9")
        .foreign(&[
            ("anisotropic", "Blender, Mitsuba and Disney"),
            ("Anisotropic", "Blender"),
            ("anisotropyStrength", "glTF"),
        ]),
        Field::new(
            "compensation",
            FieldType::Word(SWITCH),
            Default::Word("on"),
            "Light that several reflections at the rough surface give back; without it rough metal is dark.",
        ),
        NORMAL,
        NORMAL_STRENGTH,
    ],
    foreign: &[
        ("roughconductor", "Mitsuba"),
        ("metal2", "LuxCore"),
        ("glossy_metal", "common use"),
    ],
};

const CONDUCTOR_ROUGHNESS_NAMES: &[(&str, &str)] = &[
    ("fuzz", "material type `metal`"),
    ("roughnessFactor", "glTF"),
    ("Roughness", "Blender"),
    ("alpha_roughness", "common use"),
    ("uroughness", "pbrt-v3 and LuxCore"),
    ("Pr", "OBJ/MTL"),
];

pub(super) const DIELECTRIC: TypeSchema = TypeSchema {
    kind: Kind::Material,
    name: "dielectric",
    doc: "Glass, smooth or ground: reflects and refracts. What is inside of it absorbs and scatters, if it \
          has an `interior`.",
    example: "material glass: dielectric { ior = 1.52 }",
    fields: &[
        IOR,
        Field::new(
            "roughness",
            FieldType::ScalarSlot(UNIT),
            Default::Number(0.0),
            "Perceptual roughness of both sides of the surface; 0 is polished. Light that meets the \
             rough surface twice at one point is lost.",
        )
        .typical("polished 0, frosted 0.3 to 0.6")
        .foreign(ROUGHNESS_NAMES),
        INTERIOR,
        PRIORITY,
        NORMAL,
        NORMAL_STRENGTH,
    ],
    foreign: &[
        ("glass", "pbrt-v3, LuxCore and Blender"),
        ("refraction", "Blender"),
        ("roughdielectric", "Mitsuba"),
        ("roughglass", "LuxCore"),
    ],
};

pub(super) const CLEARCOAT: TypeSchema = TypeSchema {
    kind: Kind::Material,
    name: "clearcoat",
    doc: "Matt colour under a clear coat: lacquer, varnish, glazed clay. Nothing is lost between \
          coat and base. A coat of index 1.65 reflects 6% at normal incidence, as strongly coated \
          toys in older pictures do.",
    example: "material lacquer: clearcoat { color = srgb(#8c1d18), fuzz = 0.05 }",
    fields: &[
        reflectance(Default::Required),
        Field::new(
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
        ]),
        Field::new(
            "coat.ior",
            FieldType::Number(Bounds::number(1.0, 10.0)),
            Default::Number(1.5),
            "Refractive index of the coat.",
        )
        .typical("lacquer 1.5, 6% at normal incidence 1.65")
        .foreign(IOR_NAMES),
        Field::new(
            "coat.tint",
            FieldType::Color(1.0),
            Default::Color(WHITE),
            "Factor on what the coat reflects.",
        )
        .foreign(&[
            ("coat_tint", "Blender"),
            ("ks", "LuxCore"),
            ("specular", "common use"),
        ]),
        NORMAL,
        NORMAL_STRENGTH,
    ],
    foreign: &[
        ("coateddiffuse", "pbrt-v4"),
        ("roughplastic", "Mitsuba"),
        ("glossy2", "LuxCore"),
        ("varnish", "common use"),
        ("coat", "Blender"),
    ],
};

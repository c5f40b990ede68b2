//! Materials: `material NAME: TYPE { ... }`.

use super::pattern::{FABRIC, STONE, WOOD};
use super::{ANY, Bounds, Default, Field, FieldType, Kind, TypeSchema, WHITE, Word};
use crate::units::Dim;

pub(super) const TYPES: &[&TypeSchema] =
    &[&DIFFUSE, &METAL, &DIELECTRIC, &EMISSIVE, &PRINCIPLED, &STONE, &WOOD, &FABRIC];

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
const IOR_NAMES: &[(&str, &str)] = &[
    ("eta", "pbrt"),
    ("int_ior", "Mitsuba"),
    ("interiorior", "LuxCore"),
    ("Ni", "OBJ/MTL"),
    ("IOR", "Blender"),
    ("index", "pbrt-v3"),
    ("refractive_index", "common use"),
];

const STRENGTH_NAMES: &[(&str, &str)] = &[
    ("scale", "pbrt"),
    ("gain", "LuxCore"),
    ("intensity", "common use"),
    ("power", "LuxCore"),
    ("emissiveStrength", "glTF"),
    ("Strength", "Blender"),
];

const IOR: Field = Field::new(
    "ior",
    FieldType::Number(Bounds::number(1.0, 10.0)),
    Default::Number(1.5),
    "Refractive index against the air outside.",
)
.typical("water 1.333, window glass 1.52, diamond 2.42")
.foreign(IOR_NAMES);

/// A tangent-space normal map.
const NORMAL: Field = Field::new(
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

const NORMAL_STRENGTH: Field = Field::new(
    "normal.strength",
    FieldType::Number(Bounds::number(0.0, 10.0)),
    Default::Number(1.0),
    "Factor on the tilt of `normal`; 0 leaves the surface as it is.",
)
.typical("1 as the map was made, 0.5 for half as steep")
.foreign(&[("normalScale", "glTF"), ("normal_strength", "common use")]);

const fn reflectance(default: Default) -> Field {
    Field::new("color", FieldType::ColorSlot(1.0), default, "Share of the light that is reflected.")
        .typical("charcoal 0.04, clay 0.4, fresh snow 0.9")
        .foreign(COLOR_NAMES)
}

const DIFFUSE: TypeSchema = TypeSchema {
    kind: Kind::Material,
    name: "diffuse",
    doc: "Scatters light evenly in all directions (Lambert): chalk, clay, matt paint.",
    example: "material clay: diffuse { color = srgb(#b5651d) }",
    fields: &[reflectance(Default::Required), NORMAL, NORMAL_STRENGTH],
    foreign: &[
        ("lambertian", "common use"),
        ("lambert", "common use"),
        ("matte", "pbrt-v3 and LuxCore"),
    ],
};

const METAL: TypeSchema = TypeSchema {
    kind: Kind::Material,
    name: "metal",
    doc: "A coloured mirror, blurred by moving the mirrored direction within a ball.",
    example: "material brass: metal { color = linear(0.89, 0.68, 0.33), fuzz = 0.1 }",
    fields: &[
        reflectance(Default::Required),
        Field::new(
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
        ]),
        NORMAL,
        NORMAL_STRENGTH,
    ],
    foreign: &[
        ("conductor", "pbrt-v4 and Mitsuba"),
        ("mirror", "pbrt-v3 and LuxCore"),
        ("roughconductor", "Mitsuba"),
        ("glossy", "Blender"),
    ],
};

const DIELECTRIC: TypeSchema = TypeSchema {
    kind: Kind::Material,
    name: "dielectric",
    doc: "Smooth glass or water: reflects and refracts, and absorbs nothing.",
    example: "material glass: dielectric { ior = 1.52 }",
    fields: &[IOR, NORMAL, NORMAL_STRENGTH],
    foreign: &[("glass", "pbrt-v3, LuxCore and Blender"), ("refraction", "Blender")],
};

const EMISSIVE: TypeSchema = TypeSchema {
    kind: Kind::Material,
    name: "emissive",
    doc: "Gives off light and scatters none. On any shape or mesh part; its radiance is \
          `color` times `strength`.",
    example: "material lamp: emissive { color = blackbody(3000K), strength = 12 }",
    fields: &[
        Field::new("color", FieldType::ColorSlot(ANY), Default::Required, "Colour of the light.")
            .foreign(&[
                ("L", "pbrt"),
                ("radiance", "Mitsuba"),
                ("emission", "LuxCore"),
                ("Ke", "OBJ/MTL"),
                ("emissiveFactor", "glTF"),
                ("Color", "Blender"),
            ]),
        Field::new(
            "strength",
            FieldType::Number(Bounds::number(0.0, ANY)),
            Default::Number(1.0),
            "Factor on `color`, in W/(m2 sr) up to the scale of the scene.",
        )
        .foreign(STRENGTH_NAMES),
        Field::new(
            "sides",
            FieldType::Word(SIDES),
            Default::Word("both"),
            "Which sides of the surface give off light.",
        )
        .foreign(&[
            ("twosided", "pbrt"),
            ("two_sided", "common use"),
            ("doubleSided", "glTF"),
        ]),
    ],
    foreign: &[
        ("area", "Mitsuba"),
        ("diffuse_light", "common use"),
        ("emission", "Blender"),
        ("light", "common use"),
    ],
};

const SIDES: &[Word] =
    &[("front", "only the side that the normal points to"), ("both", "front and back")];

const UNIT: Bounds = Bounds::number(0.0, 1.0);

const PRINCIPLED: TypeSchema = TypeSchema {
    kind: Kind::Material,
    name: "principled",
    doc: "The metallic-roughness model of glTF: one material for plastic, wood, stone and metal.",
    example: "material tile: principled { color = srgb(#3f6f8f), roughness = 0.3 }",
    fields: &[
        reflectance(Default::Color([0.8; 3])),
        Field::new(
            "metallic",
            FieldType::ScalarSlot(UNIT),
            Default::Number(0.0),
            "0 is a dielectric such as plastic, 1 a metal.",
        )
        .typical("0 or 1; between them only where a texture blends")
        .foreign(&[
            ("metallicFactor", "glTF"),
            ("metalness", "common use"),
            ("Metallic", "Blender"),
            ("Pm", "OBJ/MTL"),
        ]),
        Field::new(
            "roughness",
            FieldType::ScalarSlot(UNIT),
            Default::Number(0.5),
            "Perceptual roughness; the width of the highlight grows with its square.",
        )
        .typical("lacquer 0.1, wood 0.4, stone 0.8")
        .foreign(&[
            ("roughnessFactor", "glTF"),
            ("Roughness", "Blender"),
            ("alpha_roughness", "common use"),
            ("Pr", "OBJ/MTL"),
        ]),
        IOR,
        Field::new(
            "emission.color",
            FieldType::ColorSlot(ANY),
            Default::Color(WHITE),
            "Colour of the light it gives off.",
        )
        .foreign(&[
            ("emissiveFactor", "glTF"),
            ("emissiveTexture", "glTF"),
            ("Ke", "OBJ/MTL"),
            ("emission", "Blender"),
        ]),
        Field::new(
            "emission.strength",
            FieldType::Number(Bounds::number(0.0, ANY)),
            Default::Number(0.0),
            "Factor on `emission.color`; 0 gives off nothing.",
        )
        .foreign(&[("emissiveStrength", "glTF"), ("emission_strength", "Blender")]),
        Field::new(
            "alpha",
            FieldType::ScalarSlot(UNIT),
            Default::Number(1.0),
            "Coverage, compared with `alpha.clip`.",
        )
        .foreign(&[
            ("opacity", "Mitsuba"),
            ("d", "OBJ/MTL"),
            ("map_d", "OBJ/MTL"),
            ("Alpha", "Blender"),
        ]),
        Field::new(
            "alpha.clip",
            FieldType::Number(Bounds::new(Dim::NONE, "", 0.0, 1.0)),
            Default::Absent("alpha is ignored"),
            "Where `alpha` is below this, the surface is not there.",
        )
        .typical("50% for leaves and petals")
        .foreign(&[("alphaCutoff", "glTF"), ("alphaMode", "glTF")]),
        NORMAL,
        NORMAL_STRENGTH,
    ],
    foreign: &[
        ("disney", "pbrt-v3 and LuxCore"),
        ("pbrMetallicRoughness", "glTF"),
        ("standard", "common use"),
        ("plastic", "pbrt-v3 and Mitsuba"),
    ],
};

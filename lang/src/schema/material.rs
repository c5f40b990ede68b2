//! Materials: `material NAME: TYPE { ... }`.

use super::medium::{COEFFICIENT, SIGMA_A_NAMES};
use super::pattern::{FABRIC, STONE, WOOD};
use super::{ANY, Bounds, Default, Field, FieldType, Kind, TypeSchema, WHITE, Word};
use crate::units::Dim;

mod sheet;
mod specular;

use specular::{CLEARCOAT, CONDUCTOR, DIELECTRIC};

pub(super) const TYPES: &[&TypeSchema] = &[
    &DIFFUSE,
    &METAL,
    &CONDUCTOR,
    &DIELECTRIC,
    &CLEARCOAT,
    &EMISSIVE,
    &PRINCIPLED,
    &STONE,
    &WOOD,
    &FABRIC,
    &sheet::LEAF,
    &sheet::PETAL,
    &WATER,
];

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

/// Names that other renderers give perceptual roughness.
const ROUGHNESS_NAMES: &[(&str, &str)] = &[
    ("roughnessFactor", "glTF"),
    ("Roughness", "Blender"),
    ("alpha_roughness", "common use"),
    ("Pr", "OBJ/MTL"),
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

const INTERIOR: Field = Field::new(
    "interior",
    FieldType::Name(Kind::Medium),
    Default::Absent("clear"),
    "What fills the thing: a `homogeneous` medium. The shape must be closed.",
)
.foreign(&[
    ("inside", "pbrt"),
    ("volume_interior", "LuxCore"),
    ("MediumInterface", "pbrt"),
    ("Volume", "Blender"),
]);

const PRIORITY: Field = Field::new(
    "priority",
    FieldType::Integer(0, 1_000_000),
    Default::Number(0.0),
    "Where things overlap, the greatest priority is there and the others are not; of equal ones the \
     one that light entered last. With media or priorities in the scene, light refracts against what \
     is really around a thing; otherwise against air.",
)
.typical("water 1 in a glass 2, the two overlapping a little")
.foreign(&[("nested_priority", "common use")]);

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
    foreign: &[("mirror", "pbrt-v3 and LuxCore"), ("glossy", "Blender")],
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

const ALPHA: Field = Field::new(
    "alpha",
    FieldType::ScalarSlot(UNIT),
    Default::Number(1.0),
    "Coverage, compared with `alpha.clip`.",
)
.foreign(&[("opacity", "Mitsuba"), ("d", "OBJ/MTL"), ("map_d", "OBJ/MTL"), ("Alpha", "Blender")]);

const ALPHA_CLIP: Field = Field::new(
    "alpha.clip",
    FieldType::Number(Bounds::new(Dim::NONE, "", 0.0, 1.0)),
    Default::Absent("alpha is ignored"),
    "Where `alpha` is below this, the surface is not there.",
)
.typical("50% for leaves and petals")
.foreign(&[("alphaCutoff", "glTF"), ("alphaMode", "glTF")]);
const WATER: TypeSchema = TypeSchema {
    kind: Kind::Material,
    name: "water",
    doc: "Water with ripples: reflects and refracts, and absorbs inside, red first. Faces that look up have \
          three trains of sine waves. A closed shape is a body of water; an open one, such as a `rectangle`, \
          is a sea without a bottom of its own, in which light that leaves the scene below the surface \
          has the colour of the deep.",
    example: "material pond: water { waves.height = 0.5 }",
    fields: &[
        Field::new(
            "ior",
            FieldType::Number(Bounds::number(1.0, 10.0)),
            Default::Number(1.333),
            "Refractive index against air.",
        )
        .foreign(IOR_NAMES),
        Field::new(
            "sigma_a",
            FieldType::Spectrum(COEFFICIENT),
            Default::Vector([0.35, 0.06, 0.025]),
            "Absorption: over a length d the share exp(-sigma_a d) of the light is left.",
        )
        .typical("clear lake (0.35, 0.06, 0.025)/m, distilled 0.01/m")
        .foreign(SIGMA_A_NAMES),
        Field::new(
            "interior",
            FieldType::Name(Kind::Medium),
            Default::Absent("`sigma_a` decides"),
            "A `homogeneous` medium instead, for murky water. The shape must be closed.",
        ),
        PRIORITY,
        Field::new(
            "waves",
            FieldType::Word(WAVES),
            Default::Word("on"),
            "Whether the surface is rippled.",
        ),
        Field::new(
            "waves.scale",
            FieldType::Number(Bounds::number(0.0, 1e6)),
            Default::Number(0.4),
            "How close the waves are; at 1 the longest are 1.4m, at 0.4 they are 3.6m.",
        )
        .typical("pond 0.4, pool 2, puddle 10"),
        Field::new(
            "waves.height",
            FieldType::Number(Bounds::number(0.0, 20.0)),
            Default::Number(1.0),
            "Factor on their slopes; at 1 the steepest is 0.04.",
        )
        .typical("calm 0.2, breeze 1, wind 4"),
        Field::new(
            "depth.color",
            FieldType::Color(ANY),
            Default::Color([0.02, 0.06, 0.10]),
            "Radiance of the deep as seen from above the surface, where light leaves the scene under water.",
        )
        .typical("in the measure of the sky's radiance")
        .foreign(&[("deep_color", "common use")]),
    ],
    foreign: &[("ocean", "common use"), ("sea", "common use")],
};

const WAVES: &[Word] = &[("on", "rippled"), ("off", "flat")];

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
        .foreign(ROUGHNESS_NAMES),
        IOR,
        Field::new(
            "specular",
            FieldType::ScalarSlot(UNIT),
            Default::Number(1.0),
            "Factor on what the dielectric part reflects; 0 is a surface without highlights.",
        )
        .typical("1; less where a hollow hides the sky")
        .foreign(&[
            ("specularFactor", "glTF"),
            ("specularTexture", "glTF"),
            ("Specular", "Blender"),
        ]),
        Field::new(
            "specular.color",
            FieldType::ColorSlot(ANY),
            Default::Color(WHITE),
            "Colour of what the dielectric part reflects at normal incidence.",
        )
        .typical("white; coloured for silk and feathers")
        .foreign(&[
            ("specularColorFactor", "glTF"),
            ("specularColorTexture", "glTF"),
            ("spec_tint", "Mitsuba"),
        ]),
        Field::new(
            "coat.weight",
            FieldType::ScalarSlot(UNIT),
            Default::Number(0.0),
            "Share of the surface under a clear coat of index 1.5.",
        )
        .typical("1 for lacquer and car paint")
        .foreign(&[
            ("clearcoatFactor", "glTF"),
            ("clearcoatTexture", "glTF"),
            ("clearcoat", "Mitsuba and Blender"),
            ("Pc", "OBJ/MTL"),
        ]),
        Field::new(
            "coat.roughness",
            FieldType::ScalarSlot(UNIT),
            Default::Number(0.0),
            "Perceptual roughness of the coat.",
        )
        .typical("fresh lacquer 0.03, worn 0.3")
        .foreign(&[
            ("clearcoatRoughnessFactor", "glTF"),
            ("clearcoatRoughnessTexture", "glTF"),
            ("clearcoat_gloss", "Mitsuba"),
            ("Pcr", "OBJ/MTL"),
        ]),
        Field::new(
            "transmission",
            FieldType::ScalarSlot(UNIT),
            Default::Number(0.0),
            "Share of the light entering that goes on through the surface, a thin sheet that bends nothing; `color` \
             tints it. Solid glass is `dielectric`.",
        )
        .typical("1 for a window pane, 0.3 for paper")
        .foreign(&[
            ("transmissionFactor", "glTF"),
            ("transmissionTexture", "glTF"),
            ("spec_trans", "Mitsuba"),
            ("Transmission", "Blender"),
        ]),
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
        ALPHA,
        ALPHA_CLIP,
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

//! Materials whose colour, roughness and bumps come from a field over the object: stone, wood, fabric.

use super::material::COLOR_NAMES;
use super::{ANY, Bounds, Default, Field, FieldType, Kind, TypeSchema, Word};
use crate::units::Dim;

const SHARE: Bounds = Bounds::number(0.0, 1.0);

const fn color(doc: &'static str) -> Field {
    Field::new("color", FieldType::Color(1.0), Default::Required, doc).foreign(COLOR_NAMES)
}

const SCALE: Field = Field::new(
    "scale",
    FieldType::Number(Bounds { above_min: true, ..Bounds::number(0.0, 1e4) }),
    Default::Number(1.0),
    "Pattern coordinates are metres of the object times this: 2 makes every feature half as large. \
     The object's own `scale` does not change the pattern.",
)
.typical("1 for boulders and beams, 5 to 20 for what lies on a table")
.foreign(&[("frequency", "common use"), ("Scale", "Blender"), ("uvscale", "LuxCore")]);

const fn step(metres: f64) -> Field {
    Field::new(
        "bump.eps",
        FieldType::Number(Bounds::above(Dim::LENGTH, "mm", 0.0)),
        Default::Number(metres),
        "Step of the differences of the field that tilt the normal, in the object; finer bumps are \
         smoothed away.",
    )
    .typical("8mm to 10mm at `scale` 1, less at larger scales")
    .foreign(&[("epsilon", "common use"), ("delta", "common use")])
}

const fn height(metres: f64) -> Field {
    Field::new(
        "bump.strength",
        FieldType::Number(Bounds::new(Dim::LENGTH, "mm", 0.0, ANY)),
        Default::Number(metres),
        "Height of the bumps between the lowest and the highest value of the field; 0m leaves the \
         surface smooth. The slope is this times `scale` times a few per metre.",
    )
    .typical("20mm to 40mm at `scale` 1, less at larger scales")
    .foreign(&[
        ("bump", "common use"),
        ("displacement", "pbrt-v4"),
        ("bumpmap", "pbrt-v3"),
        ("Distance", "Blender"),
    ])
}

const fn gloss(share: f64) -> Field {
    Field::new(
        "gloss",
        FieldType::Number(SHARE),
        Default::Number(share),
        "Share of the light that a rough highlight reflects, uncoloured.",
    )
    .foreign(&[
        ("specular", "common use"),
        ("Ks", "OBJ/MTL"),
        ("Specular", "Blender"),
        ("specularFactor", "glTF"),
    ])
}

pub(super) const STONE: TypeSchema = TypeSchema {
    kind: Kind::Material,
    name: "stone",
    doc: "Stone with bumps, veins and a roughness between 0.4 and 0.75, from blocks a third of a metre wide \
          down to grains of two centimetres. No two things have the same pattern.",
    example: "material basalt: stone { color = srgb(#8a8782), scale = 4, bump.strength = 10mm, bump.eps = 2.5mm }",
    fields: &[
        color("Colour of the stone between its veins."),
        Field::new(
            "color.vein",
            FieldType::Color(1.0),
            Default::Absent("a darker tone of `color`"),
            "Colour of the veins and of the dark grains.",
        ),
        SCALE,
        step(0.010),
        height(0.04),
        gloss(0.06),
    ],
    foreign: &[
        ("rock", "common use"),
        ("marble", "pbrt-v3 and LuxCore"),
        ("granite", "common use"),
    ],
};

const GRAIN: &[Word] = &[
    ("x", "along the object's x"),
    ("y", "along the object's y, as in a post"),
    ("z", "along the object's z"),
];

pub(super) const WOOD: TypeSchema = TypeSchema {
    kind: Kind::Material,
    name: "wood",
    doc: "Wood with growth rings, bumps and gloss along a grain, and a roughness between 0.45 and 0.85. No two \
          things have the same pattern.",
    example: "material cedar: wood { color = srgb(#b5794a), grain = x, scale = 3 }",
    fields: &[
        color("Colour of the early wood, the paler part of each ring."),
        Field::new(
            "color.late",
            FieldType::Color(1.0),
            Default::Absent("a darker tone of `color`"),
            "Colour of the late wood, the darker part of each ring, and of the pores.",
        ),
        Field::new(
            "grain",
            FieldType::Word(GRAIN),
            Default::Required,
            "Axis of the object along which the wood grew: along the length of a beam, a post or a plank.",
        )
        .foreign(&[("axis", "common use"), ("direction", "common use")]),
        SCALE,
        step(0.008),
        height(0.03),
        gloss(0.04),
        Field::new(
            "anisotropy",
            FieldType::Number(SHARE),
            Default::Number(0.6),
            "How far the highlight is stretched along the grain; 0 is round.",
        )
        .foreign(&[("Anisotropic", "Blender"), ("anisotropyStrength", "glTF")]),
    ],
    foreign: &[("timber", "common use"), ("plank", "common use")],
};

pub(super) const FABRIC: TypeSchema = TypeSchema {
    kind: Kind::Material,
    name: "fabric",
    doc: "A rough thin sheet with folds and weave as bumps; some of the light goes through. On surfaces without \
          thickness, or around something else.",
    example: "material linen: fabric { color = srgb(#d8cdb8), translucency = 0.25 }",
    fields: &[
        Field::new(
            "color",
            FieldType::ColorSlot(1.0),
            Default::Required,
            "Share of the light that is not absorbed.",
        )
        .typical("linen 0.6, black wool 0.03")
        .foreign(COLOR_NAMES),
        SCALE,
        step(0.010),
        height(0.02),
        Field::new(
            "roughness",
            FieldType::Number(SHARE),
            Default::Number(0.85),
            "Perceptual roughness of the gloss.",
        )
        .typical("silk 0.4, cotton 0.85")
        .foreign(&[("Roughness", "Blender"), ("roughnessFactor", "glTF")]),
        gloss(0.04),
        Field::new(
            "translucency",
            FieldType::Number(SHARE),
            Default::Number(0.2),
            "Share of the coloured light that leaves on the other side; the rest leaves on this one.",
        )
        .typical("gauze 0.5, shirt 0.2, felt 0")
        .foreign(&[
            ("transmission", "common use"),
            ("transmittance", "pbrt-v4"),
            ("Kt", "pbrt-v3 and LuxCore"),
            ("diffuseTransmissionFactor", "glTF"),
        ]),
    ],
    foreign: &[("cloth", "LuxCore"), ("textile", "common use"), ("velvet", "Blender")],
};

/// Why a wood has no `fuzz`, though its packed record has: for those who know the record.
pub(crate) fn refusal(schema: &TypeSchema, field: &str) -> Option<(&'static str, &'static str)> {
    (schema.name == "wood" && field == "fuzz").then_some((
        "the grain is what the record's `fuzz` holds: 1/6 for y, 1/2 for x, 5/6 for z",
        "write `grain = x`, `grain = y` or `grain = z`",
    ))
}

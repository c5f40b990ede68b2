//! Fields of materials whose colour, roughness and bumps come from a field over the object: stone, wood, fabric.

use super::fields::COLOR_NAMES;
use crate::schema::{ANY, Bounds, Default, Field, FieldType, Word};
use crate::units::Dim;

pub(super) const SHARE: Bounds = Bounds::number(0.0, 1.0);

pub(super) const fn color(doc: &'static str) -> Field {
    Field::new("color", FieldType::Color(1.0), Default::Required, doc).foreign(COLOR_NAMES)
}

pub(super) const SCALE: Field = Field::new(
    "scale",
    FieldType::Number(Bounds { above_min: true, ..Bounds::number(0.0, 1e4) }),
    Default::Number(1.0),
    "Pattern coordinates are metres of the object times this: 2 makes every feature half as large. \
     The object's own `scale` does not change the pattern.",
)
.typical("1 for boulders and beams, 5 to 20 for what lies on a table")
.foreign(&[("frequency", "common use"), ("Scale", "Blender"), ("uvscale", "LuxCore")]);

pub(super) const fn step(metres: f64) -> Field {
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

pub(super) const fn height(metres: f64) -> Field {
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

pub(super) const fn gloss(share: f64) -> Field {
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

pub(super) const GRAIN: &[Word] = &[
    ("x", "along the object's x"),
    ("y", "along the object's y, as in a post"),
    ("z", "along the object's z"),
];

pub(super) const STONE_COLOR_VEIN: Field = Field::new(
    "color.vein",
    FieldType::Color(1.0),
    Default::Absent("a darker tone of `color`"),
    "Colour of the veins and of the dark grains.",
);

pub(super) const WOOD_COLOR_LATE: Field = Field::new(
    "color.late",
    FieldType::Color(1.0),
    Default::Absent("a darker tone of `color`"),
    "Colour of the late wood, the darker part of each ring, and of the pores.",
);

pub(super) const WOOD_GRAIN: Field = Field::new(
    "grain",
    FieldType::Word(GRAIN),
    Default::Required,
    "Axis of the object along which the wood grew: along the length of a beam, a post or a plank.",
)
.foreign(&[("axis", "common use"), ("direction", "common use")]);

pub(super) const WOOD_ANISOTROPY: Field = Field::new(
    "anisotropy",
    FieldType::Number(SHARE),
    Default::Number(0.6),
    "How far the highlight is stretched along the grain; 0 is round.",
)
.foreign(&[("Anisotropic", "Blender"), ("anisotropyStrength", "glTF")]);

pub(super) const FABRIC_COLOR: Field = Field::new(
    "color",
    FieldType::ColorSlot(1.0),
    Default::Required,
    "Share of the light that is not absorbed.",
)
.typical("linen 0.6, black wool 0.03")
.foreign(COLOR_NAMES);

pub(super) const FABRIC_ROUGHNESS: Field = Field::new(
    "roughness",
    FieldType::Number(SHARE),
    Default::Number(0.85),
    "Perceptual roughness of the gloss.",
)
.typical("silk 0.4, cotton 0.85")
.foreign(&[("Roughness", "Blender"), ("roughnessFactor", "glTF")]);

pub(super) const FABRIC_TRANSLUCENCY: Field = Field::new(
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
]);

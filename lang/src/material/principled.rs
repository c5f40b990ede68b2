//! Fields of `principled` alone.

use super::fields::{ROUGHNESS_NAMES, UNIT};
use super::specular::CONDUCTOR_ANISOTROPY;
use crate::schema::{ANY, Bounds, Default, Field, FieldType, WHITE};
use crate::units::Dim;

pub(super) const METALLIC: Field = Field::new(
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
]);

pub(super) const ROUGHNESS: Field = Field::new(
    "roughness",
    FieldType::ScalarSlot(UNIT),
    Default::Number(0.5),
    "Perceptual roughness; the width of the highlight grows with its square.",
)
.typical("lacquer 0.1, wood 0.4, stone 0.8")
.foreign(ROUGHNESS_NAMES);

pub(super) const SPECULAR: Field = Field::new(
    "specular",
    FieldType::ScalarSlot(UNIT),
    Default::Number(1.0),
    "Factor on what the dielectric part reflects; 0 is a surface without highlights.",
)
.typical("1; less where a hollow hides the sky")
.foreign(&[("specularFactor", "glTF"), ("specularTexture", "glTF"), ("Specular", "Blender")]);

pub(super) const SPECULAR_COLOR: Field = Field::new(
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
]);

pub(super) const ANISOTROPY: Field = Field {
    doc: "How much wider the highlight is along the direction of brushing than across it: ten times at 1.",
    ..CONDUCTOR_ANISOTROPY
};

pub(super) const ANISOTROPY_ROTATION: Field = Field::new(
    "anisotropy.rotation",
    FieldType::Number(Bounds {
        dim: Dim::ANGLE,
        unit: "deg",
        min: -std::f64::consts::TAU,
        above_min: false,
        max: std::f64::consts::TAU,
    }),
    Default::Number(0.0),
    "From the direction in which u grows to that of brushing, towards v.",
)
.typical("0deg, or 90deg to brush along v")
.foreign(&[("anisotropyRotation", "glTF"), ("Anisotropic Rotation", "Blender")]);

pub(super) const COAT_WEIGHT: Field = Field::new(
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
]);

pub(super) const COAT_ROUGHNESS: Field = Field::new(
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
]);

pub(super) const SHEEN: Field = Field::new(
    "sheen",
    FieldType::ColorSlot(1.0),
    Default::Color([0.0; 3]),
    "Colour of upright fibres over the surface, which reflect most where light grazes them. It goes with neither a \
     coat nor anisotropy.",
)
.typical("white for dust and peach fuzz; the colour of the thread for velvet")
.foreign(&[
    ("sheenColorFactor", "glTF"),
    ("sheenColorTexture", "glTF"),
    ("Sheen Tint", "Blender"),
    ("Ps", "OBJ/MTL"),
]);

pub(super) const SHEEN_ROUGHNESS: Field = Field::new(
    "sheen.roughness",
    FieldType::ScalarSlot(UNIT),
    Default::Number(0.3),
    "Perceptual roughness of the sheen: how far from the rim it reaches. Anything below 0.15 counts as 0.15.",
)
.typical("velvet 0.3, felt 0.8")
.foreign(&[
    ("sheenRoughnessFactor", "glTF"),
    ("sheenRoughnessTexture", "glTF"),
    ("Sheen Roughness", "Blender"),
]);

pub(super) const TRANSMISSION: Field = Field::new(
            "transmission",
            FieldType::ScalarSlot(UNIT),
            Default::Number(0.0),
            "Share of the entering light that goes through the surface, a thin sheet that bends nothing; `color` \
             tints it. For solid glass use `dielectric`.",
        )
        .typical("1 for a window pane, 0.3 for paper")
        .foreign(&[
            ("transmissionFactor", "glTF"),
            ("transmissionTexture", "glTF"),
            ("spec_trans", "Mitsuba"),
            ("Transmission", "Blender"),
        ]);

pub(super) const EMISSION_COLOR: Field = Field::new(
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
]);

pub(super) const EMISSION_STRENGTH: Field = Field::new(
    "emission.strength",
    FieldType::Number(Bounds::number(0.0, ANY)),
    Default::Number(0.0),
    "Factor on `emission.color`; 0 gives off nothing.",
)
.foreign(&[("emissiveStrength", "glTF"), ("emission_strength", "Blender")]);

//! Fields of thin sheets: leaves and petals.

use super::fields::{COLOR_NAMES, IOR_NAMES, UNIT};
use crate::schema::{ANY, Bounds, Default, Field, FieldType};
use crate::units::Dim;

pub(super) const PER_MM: Bounds = Bounds::new(Dim::PER_LENGTH, "/mm", 0.0, ANY);

/// Mean cosines: 1 would let light straight through, which is no scattering.
pub(super) const COSINE: Bounds = Bounds::number(-0.99, 0.99);

pub(super) const fn mean_cosine(default: f64, doc: &'static str) -> Field {
    Field::new("g", FieldType::Number(COSINE), Default::Number(default), doc)
        .typical("0 even, 0.6 to 0.9 forward")
        .foreign(&[("anisotropy", "Blender"), ("asymmetry", "LuxCore")])
}

pub(super) const COLOR: Field = Field::new(
    "color",
    FieldType::ColorSlot(1.0),
    Default::Required,
    "Colour of the light that comes back, and factor on what goes through.",
)
.foreign(COLOR_NAMES);

pub(super) const LEAF_TRANSLUCENCY: Field = Field::new(
    "translucency",
    FieldType::Number(UNIT),
    Default::Number(0.3),
    "Share of the light that goes through instead of coming back.",
)
.typical("paper 0.4, leaves 0.3 to 0.5")
.foreign(&[("transmission", "glTF"), ("diffuse_transmission", "common use")]);

pub(super) const LEAF_SIGMA_A: Field = Field::new(
    "sigma_a",
    FieldType::Spectrum(PER_MM),
    Default::Vector([200.0, 2500.0, 4500.0]),
    "Absorption inside the sheet; more of one channel takes that colour out.",
)
.foreign(&[("absorption", "common use")]);

pub(super) const LEAF_THICKNESS: Field = Field::new(
    "thickness",
    FieldType::Number(Bounds::new(Dim::LENGTH, "mm", 0.0, ANY)),
    Default::Number(0.0002),
    "Thickness of the sheet.",
)
.typical("leaves 0.2mm, paper 0.1mm");

pub(super) const LEAF_FORWARD: Field = Field::new(
    "forward",
    FieldType::Number(UNIT),
    Default::Number(0.5),
    "Share of the light going through that keeps its direction, blurred by `g`.",
);

pub(super) const LEAF_GAP: Field = Field::new(
    "gap",
    FieldType::Number(UNIT),
    Default::Number(0.0),
    "Share of the leaves of a mesh, or of the instances, that are not there. Which ones \
             depends on their names alone.",
);

pub(super) const PETAL_FUZZ_WEIGHT: Field = Field::new(
    "fuzz.weight",
    FieldType::Number(UNIT),
    Default::Number(0.15),
    "Share of the light that the fuzz on the surface reflects.",
)
.foreign(&[("sheen", "common use"), ("Sheen Weight", "Blender")]);

pub(super) const PETAL_FUZZ_RADIUS: Field = Field::new(
    "fuzz.radius",
    FieldType::Number(Bounds::number(0.01, 1.0)),
    Default::Number(0.65),
    "Blur of what the fuzz reflects: radius of the ball around the mirror direction.",
);

pub(super) const PETAL_IOR: Field = Field::new(
    "ior",
    FieldType::Number(Bounds::number(1.0, 10.0)),
    Default::Number(1.4),
    "Refractive index of the petal against the air.",
)
.foreign(IOR_NAMES);

pub(super) const PETAL_WAX: Field = Field::new(
    "wax",
    FieldType::Number(Bounds::number(0.01, 1.0)),
    Default::Number(0.2),
    "Blur of what the waxy skin reflects: radius of the ball around the mirror direction.",
)
.foreign(&[("roughness", "common use")]);

pub(super) const PETAL_SIGMA_A: Field = Field::new(
    "sigma_a",
    FieldType::Spectrum(PER_MM),
    Default::Vector([0.1, 0.8, 0.3]),
    "Absorption inside the petal.",
)
.foreign(&[("absorption", "common use")]);

pub(super) const PETAL_SIGMA_S: Field = Field::new(
    "sigma_s",
    FieldType::Number(PER_MM),
    Default::Number(600.0),
    "Scattering inside the petal. Times the thickness it is the number of times that light \
             is scattered on its way through.",
)
.typical("a petal that glows 5/mm, a veil 0.6/mm")
.foreign(&[("scattering", "common use")]);

pub(super) const PETAL_THICKNESS: Field = Field::new(
    "thickness",
    FieldType::Interval(Bounds::new(Dim::LENGTH, "mm", 0.0, ANY)),
    Default::Interval(0.000_03, 0.000_35),
    "Thickness at the rim and in the middle of the petal.",
);

pub(super) const PETAL_PILLOW: Field = Field::new(
    "pillow",
    FieldType::Number(Bounds::number(0.0, 2.0)),
    Default::Number(0.2),
    "How far the normals of a mesh lean outward at the rim, as if it were a pillow.",
);

pub(super) const PETAL_TILT: Field = Field::new(
    "tilt",
    FieldType::Number(Bounds::number(0.0, 2.0)),
    Default::Number(0.25),
    "How differently the petals of a mesh lean, each by its own amount.",
);

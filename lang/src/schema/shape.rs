//! Shapes that need no file: calls that stand where a shape is due.

use super::{Bounds, Default, Field, FieldType, Kind, TypeSchema};
use crate::units::Dim;

types!(ShapeType { Sphere = SPHERE, Rectangle = RECTANGLE, Box = BOX });

const SPHERE: TypeSchema = TypeSchema {
    kind: Kind::Shape,
    name: "sphere",
    doc: "A sphere around the origin.",
    example: "instance ball { shape = sphere(radius: 14cm), material = clay }",
    fields: &[Field::new(
        "radius",
        FieldType::Number(Bounds::above(Dim::LENGTH, "m", 0.0)),
        Default::Required,
        "Distance from the middle to the surface.",
    )
    .foreign(&[("r", "common use"), ("size", "Blender")])],
    foreign: &[("ball", "common use"), ("uv_sphere", "Blender")],
};

const RECTANGLE: TypeSchema = TypeSchema {
    kind: Kind::Shape,
    name: "rectangle",
    doc: "A flat rectangle around the origin in the xz plane; its front faces +y.",
    example: "instance floor { shape = rectangle(size: (4, 4)m), material = clay }",
    fields: &[Field::new(
        "size",
        FieldType::Size(2),
        Default::Required,
        "Full extent along x and along z.",
    )],
    foreign: &[("plane", "Blender"), ("quad", "common use"), ("rect", "common use")],
};

const BOX: TypeSchema = TypeSchema {
    kind: Kind::Shape,
    name: "box",
    doc: "A closed box around the origin.",
    example: "instance block { shape = box(size: (30, 60, 30)cm), material = clay }",
    fields: &[Field::new(
        "size",
        FieldType::Size(3),
        Default::Required,
        "Full extent along x, y and z.",
    )],
    foreign: &[("cube", "Mitsuba, Blender"), ("cuboid", "common use")],
};

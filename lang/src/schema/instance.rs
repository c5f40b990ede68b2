//! Things in the world and things to reuse: `object` and `instance`.

use super::{Default, Field, FieldType, Kind, TypeSchema};
use crate::units::Dim;

pub(super) const OBJECT_TYPES: &[&TypeSchema] = &[&OBJECT];
pub(super) const INSTANCE_TYPES: &[&TypeSchema] = &[&INSTANCE];

pub(super) const AT: Field = Field::new(
    "at",
    FieldType::Keyed(Dim::LENGTH, "m"),
    Default::Vector([0.0; 3]),
    "Where its origin is, or keys: `[0ms: (0, 0, 0)m, 20ms: (1, 0, 0)m]`. Between keys it moves in a straight line \
     at constant speed; before the first and after the last it stands still. Times are relative to the frame, as \
     those of the camera's `shutter`.",
)
.foreign(&[
    ("translate", "pbrt and Mitsuba"),
    ("translation", "glTF"),
    ("location", "Blender"),
    ("position", "common use"),
    ("pos", "common use"),
    ("motion", "common use"),
]);

pub(super) const ROTATE: Field = Field::new(
    "rotate",
    FieldType::Keyed(Dim::ANGLE, "deg"),
    Default::Vector([0.0; 3]),
    "Turned about x, then about y, then about z; each counter-clockwise seen from the tip of the axis. Or keys, as \
     for `at`: between them each angle changes evenly, so that 720deg are two whole turns. What gives off light \
     cannot turn.",
)
.foreign(&[("rotation", "glTF and Blender"), ("rotation_euler", "Blender"), ("orient", "common use")]);

pub(super) const SCALE: Field = Field::new(
    "scale",
    FieldType::Scale,
    Default::Number(1.0),
    "Size factor for all axes or for each, before it is turned and moved; a negative factor mirrors.",
)
.foreign(&[("size", "common use")]);

/// In place of `rotate` and `scale`.
const AXIS_ABSENT: Default = Default::Absent("`rotate` and `scale` decide");
pub(super) const AXIS_X: Field = Field::new(
    "axes.x",
    FieldType::Vector(Dim::NONE, ""),
    AXIS_ABSENT,
    "Where its x axis points, in place of `rotate` and `scale`; a longer one stretches it. Write all three or \
     none: they are the columns of a matrix, and `at` is the fourth.",
)
.foreign(&[("matrix", "glTF and Mitsuba"), ("Transform", "pbrt"), ("to_world", "Mitsuba")]);
pub(super) const AXIS_Y: Field =
    Field::new("axes.y", FieldType::Vector(Dim::NONE, ""), AXIS_ABSENT, "Where its y axis points.");
pub(super) const AXIS_Z: Field =
    Field::new("axes.z", FieldType::Vector(Dim::NONE, ""), AXIS_ABSENT, "Where its z axis points.");

/// Of instances and lights.
pub(super) const VELOCITY: Field = Field::new(
    "velocity",
    FieldType::Vector(Dim::VELOCITY, "m/s"),
    Default::Vector([0.0; 3]),
    "How fast it moves, straight on; its place is where it is at time 0 of the camera's `shutter`. In a \
     group it is turned and scaled with the group, and the group's own is added.",
)
.typical("a walker 1.5m/s, a thrown ball 20m/s, a shutter 0ms..20ms")
.foreign(&[("speed", "common use"), ("vel", "common use")]);

pub(super) const SHAPE: &str = "What it looks like: a shape, a mesh file or part, an object, or a list of objects. \
     A mesh file may be followed by changes to it: `car { material \"paint*\" = red, part \"wheel*\" = none }`. The \
     texts are names of its materials and parts, in which `*` stands for any letters and `?` for one; `none` leaves \
     a part out, and the last line that matches a part decides.";

/// Of whatever gives off light.
pub(crate) const GROUP: Field = Field::new(
    "group",
    FieldType::Group,
    Default::Absent("`rest`; for a sky `sky`"),
    "Light group: `rtr --layers lights` writes the light of each group as a layer.",
)
.typical("`\"key\"`, `\"fill\"`, `\"lamps\"`")
.foreign(&[("lightgroup", "Blender"), ("light_group", "common use")]);

const fn material(doc: &'static str) -> Field {
    Field::new(
        "material",
        FieldType::Name(Kind::Material),
        Default::Absent("the materials of the mesh file; other shapes need one"),
        doc,
    )
    .foreign(&[("bsdf", "Mitsuba"), ("NamedMaterial", "pbrt"), ("mat", "common use")])
}

const OBJECT: TypeSchema = TypeSchema {
    kind: Kind::Object,
    name: "",
    doc: "A thing to reuse: a shape with a material and a place of its own. `shape` may be another object, or a \
         list of objects to group them; groups may hold groups to depth 8. An object is not in the world until an \
         instance names it.",
    example: "object post { shape = box(size: (20, 300, 20)cm), material = clay }",
    fields: &[
        Field::new("shape", FieldType::Shape, Default::Required, SHAPE).foreign(&[
            ("geometry", "common use"),
            ("mesh", "glTF and Blender"),
            ("children", "glTF"),
        ]),
        material("What it is made of. Inside a group, an object's own material comes first."),
        AT,
        ROTATE,
        SCALE,
        AXIS_X,
        AXIS_Y,
        AXIS_Z,
        VELOCITY,
        GROUP,
    ],
    foreign: &[],
};

const INSTANCE: TypeSchema = TypeSchema {
    kind: Kind::Instance,
    name: "",
    doc: "A thing in the world. `instance a: post { ... }` takes shape and material from an object; a material of \
         its own then replaces those of the object. `instance a[i in 0..6] { ... }` makes `a[0]` to `a[5]`. In an \
         imported file only `pub` instances are in the world.",
    example: "instance left: post { at = (-1.8, 0, 0)m, rotate = (0, 45, 0)deg }",
    fields: &[
        Field::new(
            "shape",
            FieldType::Shape,
            Default::Absent("the shape of the object after the colon"),
            SHAPE,
        )
        .foreign(&[
            ("geometry", "common use"),
            ("mesh", "glTF and Blender"),
            ("object", "common use"),
        ]),
        material("What it is made of."),
        AT,
        ROTATE,
        SCALE,
        AXIS_X,
        AXIS_Y,
        AXIS_Z,
        VELOCITY,
        GROUP,
    ],
    foreign: &[],
};

//! Mesh files: `asset NAME = obj(...)` and `asset NAME = gltf(...)`.

use super::{Default, Field, FieldType, Kind, TypeSchema};

types!(AssetType { Obj = OBJ, Gltf = GLTF });

const PATH: Field = Field::new(
    "path",
    FieldType::Path,
    Default::Required,
    "The file, relative to the `.rts` file that says it. Comes first and needs no name.",
)
.foreign(&[("filename", "pbrt, Mitsuba"), ("file", "LuxCore"), ("uri", "glTF")]);

const OBJ: TypeSchema = TypeSchema {
    kind: Kind::Asset,
    name: "obj",
    doc: "A Wavefront OBJ file. Its groups, objects and materials become parts: `rock.lid`. \
          The format does not say how long its unit is or where up is, so the scene must.",
    example: "asset rock = obj(\"rock.obj\", unit: cm, up: +z)",
    fields: &[
        PATH,
        Field::new(
            "unit",
            FieldType::LengthUnit,
            Default::Required,
            "How long one unit of the file is.",
        )
        .typical("downloaded scans are often in `mm` or `cm`, Blender writes `m`"),
        Field::new(
            "up",
            FieldType::Axis,
            Default::Word("+y"),
            "The axis of the file that points up.",
        )
        .typical("`+y` for most files, `+z` for CAD"),
    ],
    foreign: &[("wavefront", "common use"), ("mesh", "LuxCore")],
};

const GLTF: TypeSchema = TypeSchema {
    kind: Kind::Asset,
    name: "gltf",
    doc: "A glTF 2.0 file, text (`.gltf`) or binary (`.glb`): metres and +y up, as its \
          specification says. Nodes and meshes become parts: `shrine.post`.",
    example: "asset shrine = gltf(\"shrine.glb\")",
    fields: &[PATH],
    foreign: &[("glb", "glTF"), ("gltf2", "common use")],
};

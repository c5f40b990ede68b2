//! Mesh files: `asset NAME = obj(...)`, `ply(...)`, `stl(...)` or `gltf(...)`.

use super::{Bounds, Default, Field, FieldType, Kind, TypeSchema};
use crate::units::Dim;

types!(AssetType { Obj = OBJ, Ply = PLY, Stl = STL, Gltf = GLTF });

const PATH: Field = Field::new(
    "path",
    FieldType::Path,
    Default::Required,
    "The file, relative to the `.rts` file that names it. Comes first and needs no name.",
)
.foreign(&[("filename", "pbrt, Mitsuba"), ("file", "LuxCore"), ("uri", "glTF")]);

const UNIT: Field = Field::new(
    "unit",
    FieldType::LengthUnit,
    Default::Required,
    "How long one unit of the file is.",
);

const fn up(usual: &'static str) -> Field {
    let doc = "The axis of the file that points up.";
    Field::new("up", FieldType::Axis, Default::Word(usual), doc)
}

const OBJ: TypeSchema = TypeSchema {
    kind: Kind::Asset,
    name: "obj",
    doc: "A Wavefront OBJ file. Its groups, objects and materials become parts: `rock.lid`. The format records \
         neither its unit nor which way is up, so the scene must say.",
    example: "asset rock = obj(\"rock.obj\", unit: cm, up: +z)",
    fields: &[
        PATH,
        UNIT.typical("downloaded scans are often in `mm` or `cm`, Blender writes `m`"),
        up("+y").typical("`+y` for most files, `+z` for CAD"),
    ],
    foreign: &[("wavefront", "common use"), ("mesh", "LuxCore")],
};

const PLY: TypeSchema = TypeSchema {
    kind: Kind::Asset,
    name: "ply",
    doc: "A PLY file (Stanford), text or binary: polygons with normals (`nx ny nz`) and texture coordinates (`u v`, \
         `s t`, `texture_u texture_v`, or `texcoord` of faces) where it has them. Vertex colours become its \
         material, and are `vertex_color` to materials of the scene. The format records neither its unit nor which \
         way is up, so the scene must say.",
    example: "asset bunny = ply(\"bunny.ply\", unit: m)",
    fields: &[
        PATH,
        UNIT.typical("scans are often in `mm` or `m`"),
        up("+y").typical("`+y` for most scans, `+z` for Blender's"),
    ],
    foreign: &[("plymesh", "pbrt")],
};

const STL: TypeSchema = TypeSchema {
    kind: Kind::Asset,
    name: "stl",
    doc: "An STL file, text or binary: only triangles, without materials or texture coordinates. The solids of a \
         text file become parts: `gearbox.lid`. Its normals are computed, as for every mesh without them: edges of \
         up to 60 degrees become smooth.",
    example: "asset gear = stl(\"gear.stl\", unit: mm)",
    fields: &[
        PATH,
        UNIT.typical("`mm` for printing and CAD"),
        up("+z").typical("`+z` for printing and CAD"),
    ],
    foreign: &[("stereolithography", "common use")],
};

const GLTF: TypeSchema = TypeSchema {
    kind: Kind::Asset,
    name: "gltf",
    doc: "A glTF 2.0 file, text (`.gltf`) or binary (`.glb`): metres and +y up, as its specification says. Nodes \
         and meshes become parts: `shrine.post`. Skins, morph targets and animations are shown at one moment.",
    example: "asset fox = gltf(\"fox.glb\", animation: \"Run\", time: 350ms)",
    fields: &[
        PATH,
        Field::new(
            "time",
            FieldType::Number(Bounds::new(Dim::TIME, "s", 0.0, f64::INFINITY)),
            Default::Absent("everything as it is stored"),
            "The moment of its animations that is shown: nodes, skins and morph targets.",
        )
        .foreign(&[("frame", "Blender")]),
        Field::new(
            "animation",
            FieldType::Text,
            Default::Absent("all of them, which must not move the same nodes"),
            "Which of its animations is played; `time` is 0s unless given.",
        )
        .foreign(&[("action", "Blender"), ("clip", "common use")]),
        Field::new(
            "variant",
            FieldType::Text,
            Default::Absent("the materials that the file shows without one"),
            "Which variant of its materials is shown.",
        ),
    ],
    foreign: &[("glb", "glTF"), ("gltf2", "common use")],
};

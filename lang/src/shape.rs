//! Shapes that need no file: each is declared here, with its schema, its value, and what is asked of it.
//!
//! They are calls that stand where a shape is due. How a shape becomes spheres and triangles is the compiler's.

use std::collections::BTreeMap;

use crate::schema::{Bounds, Default, Field, FieldType, Kind, TypeSchema, types, words};
use crate::source::Span;
use crate::units::{self, Dim};

types!(ShapeType { Sphere = SPHERE, Rectangle = RECTANGLE, Quad = QUAD, Box = BOX, Mesh = MESH });

/// Arguments of a call by name: lengths in metres, indices as they are; lists of tuples one after the other.
pub(crate) type Lengths = BTreeMap<&'static str, Vec<f64>>;

/// Geometry of an instance, object frame, metres.
#[derive(Clone, Debug, PartialEq)]
pub enum Shape {
    /// Sphere around the origin.
    Sphere {
        /// Radius, > 0.
        radius: f64,
    },
    /// Rectangle in the xz plane around the origin, normal +y.
    Rectangle {
        /// Sizes along x and z.
        size: [f64; 2],
    },
    /// Parallelogram by three corners in order, counter-clockwise seen from its front.
    Quad {
        /// The fourth is the first and the third less the second.
        corners: [[f64; 3]; 3],
    },
    /// Box around the origin.
    Box {
        /// Sizes along x, y, z.
        size: [f64; 3],
    },
    /// A mesh that is written in the scene; without normals and texture coordinates.
    Faces {
        /// Positions.
        points: Vec<[f64; 3]>,
        /// Indices into `points`, counter-clockwise seen from the front. All of them exist.
        triangles: Vec<[u32; 3]>,
    },
    /// A mesh file, or parts of it (OBJ group or object; solid of STL; glTF node or mesh).
    Mesh {
        /// Index into `Scene::assets`.
        asset: usize,
        /// Which of its parts.
        parts: Parts,
    },
}

/// Which parts of a mesh file.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Parts {
    /// All.
    All,
    /// Those of a name, as written after the dot.
    Named(String),
    /// Those with these indices, ascending: what is left when others look different. No text says this.
    Listed(Vec<usize>),
}

impl Parts {
    /// The name that is written.
    #[must_use]
    pub fn name(&self) -> Option<&str> {
        match self {
            Self::Named(name) => Some(name),
            Self::All | Self::Listed(_) => None,
        }
    }
}

/// A change of what a mesh file shows.
#[derive(Clone, Debug, PartialEq)]
pub struct MeshEdit<M> {
    /// What `pattern` names.
    pub of: EditOf,
    /// Names in the file that it holds for: `*` stands for any letters, `?` for one.
    pub pattern: String,
    /// Where the pattern stands.
    pub pattern_span: Span,
    /// What these parts are made of; `None`: they are left out.
    pub material: Option<M>,
    /// Where the material is named.
    pub material_span: Span,
}

words! {
    /// What the pattern of a change names.
    pub enum EditOf {
        /// Materials of the file.
        Material = "material" "what is made of a material of the file",
        /// Its parts.
        Part = "part" "parts of the file",
    }
}

impl Shape {
    /// The shape of a call of `schema`. `None` only where an argument is missing.
    pub(crate) fn read(schema: &TypeSchema, lengths: &Lengths) -> Option<Self> {
        let of = |name: &str| lengths.get(name).map(Vec::as_slice);
        Some(match ShapeType::of(schema) {
            ShapeType::Sphere => {
                let [radius] = of("radius")?.try_into().ok()?;
                Self::Sphere { radius }
            }
            ShapeType::Rectangle => Self::Rectangle { size: of("size")?.try_into().ok()? },
            ShapeType::Quad => {
                let corner = |name| of(name)?.try_into().ok();
                Self::Quad { corners: [corner("a")?, corner("b")?, corner("c")?] }
            }
            ShapeType::Box => Self::Box { size: of("size")?.try_into().ok()? },
            ShapeType::Mesh => Self::Faces {
                points: of("points")?.as_chunks().0.to_vec(),
                triangles: of("faces")?.as_chunks().0.iter().map(indices).collect(),
            },
        })
    }

    /// The call as it would be written; `None` for a mesh.
    pub(crate) fn shown(&self) -> Option<String> {
        let number = units::show_number;
        match self {
            Self::Sphere { radius } => {
                Some(format!("sphere(radius: {})", units::show(*radius, Dim::LENGTH)))
            }
            Self::Rectangle { size: [x, z] } => {
                Some(format!("rectangle(size: ({}, {})m)", number(*x), number(*z)))
            }
            Self::Quad { corners } => {
                let corner =
                    |[x, y, z]: [f64; 3]| format!("({}, {}, {})m", number(x), number(y), number(z));
                let [a, b, c] = corners.map(corner);
                Some(format!("quad(a: {a}, b: {b}, c: {c})"))
            }
            Self::Box { size: [x, y, z] } => {
                Some(format!("box(size: ({}, {}, {})m)", number(*x), number(*y), number(*z)))
            }
            Self::Faces { points, triangles } => {
                let three = |[x, y, z]: &[f64; 3]| {
                    format!("({}, {}, {})", number(*x), number(*y), number(*z))
                };
                let points: Vec<String> = points.iter().map(|p| three(p) + "m").collect();
                let faces = triangles.iter().map(|corners| three(&corners.map(f64::from)));
                let faces: Vec<String> = faces.collect();
                Some(format!(
                    "mesh(points: [{}], faces: [{}])",
                    points.join(", "),
                    faces.join(", ")
                ))
            }
            Self::Mesh { .. } => None,
        }
    }

    /// Its lengths, metres; those of a mesh are in its file.
    pub fn lengths_mut(&mut self) -> &mut [f64] {
        match self {
            Self::Sphere { radius } => std::slice::from_mut(radius),
            Self::Rectangle { size } => size,
            Self::Quad { corners } => corners.as_flattened_mut(),
            Self::Box { size } => size,
            Self::Faces { points, .. } => points.as_flattened_mut(),
            Self::Mesh { .. } => &mut [],
        }
    }

    /// Full extent along x, y and z; that of a mesh is in its file.
    #[must_use]
    pub fn size(&self) -> Option<[f64; 3]> {
        self.bounds().map(|[low, high]| [0, 1, 2].map(|k| high[k] - low[k]))
    }

    /// Opposite corners of the box around it; those of a mesh are in its file.
    #[must_use]
    pub fn bounds(&self) -> Option<[[f64; 3]; 2]> {
        let around =
            |size: [f64; 3]| Some([size.map(|side| -0.5 * side), size.map(|side| 0.5 * side)]);
        match *self {
            Self::Faces { ref points, .. } => {
                let most = |k: usize, of: fn(f64, f64) -> f64| {
                    points.iter().map(|p| p[k]).reduce(of).unwrap_or_default()
                };
                Some([[0, 1, 2].map(|k| most(k, f64::min)), [0, 1, 2].map(|k| most(k, f64::max))])
            }
            Self::Sphere { radius } => around([2.0 * radius; 3]),
            Self::Rectangle { size: [x, z] } => around([x, 0.0, z]),
            Self::Quad { corners: [a, b, c] } => {
                let d = fourth([a, b, c]);
                let most =
                    |of: fn(f64, f64) -> f64| [0, 1, 2].map(|k| of(of(a[k], b[k]), of(c[k], d[k])));
                Some([most(f64::min), most(f64::max)])
            }
            Self::Box { size } => around(size),
            Self::Mesh { .. } => None,
        }
    }

    /// What is wrong with it, if anything.
    pub(crate) fn flaw(&self) -> Option<Flaw> {
        match self {
            Self::Quad { corners } if is_line(corners) => {
                let text = "the corners of this quad lie on a line: it has no area".to_owned();
                Some(Flaw { text, label: "no area", face: None })
            }
            Self::Faces { points, triangles } => {
                let n = points.len();
                let lost = |index: &&u32| **index as usize >= n;
                let wrong = |corners: &[u32; 3]| corners.iter().find(lost).copied();
                let (face, index) =
                    triangles.iter().enumerate().find_map(|(i, face)| Some((i, wrong(face)?)))?;
                let text = format!("this face has index {index}, but there are {n} points");
                let label = "indices start at 0";
                Some(Flaw { text, label, face: Some(face) })
            }
            Self::Quad { .. }
            | Self::Sphere { .. }
            | Self::Rectangle { .. }
            | Self::Box { .. }
            | Self::Mesh { .. } => None,
        }
    }

    /// The volume that a closed mesh in the scene encloses, cubic metres; below 0 where their fronts look
    /// inwards. `None` for all else.
    #[must_use]
    pub fn signed_volume(&self) -> Option<f64> {
        let Self::Faces { points, triangles } = self else { return None };
        if self.open().is_some() {
            return None;
        }
        let volume = |corners: &[u32; 3]| {
            let [a, b, c] = corners.map(|i| points[i as usize]);
            a[0] * (b[1] * c[2] - b[2] * c[1])
                + a[1] * (b[2] * c[0] - b[0] * c[2])
                + a[2] * (b[0] * c[1] - b[1] * c[0])
        };
        Some(triangles.iter().map(volume).sum::<f64>() / 6.0)
    }

    /// No point is farther from the origin, along any axis; 0 for a mesh.
    #[must_use]
    pub fn reach(&self) -> f64 {
        match *self {
            Self::Sphere { radius } => radius,
            Self::Rectangle { size: [x, z] } => x.max(z),
            Self::Quad { .. } | Self::Faces { .. } => {
                let ends = self.bounds().unwrap_or_default();
                ends.as_flattened().iter().fold(0.0, |most, x| x.abs().max(most))
            }
            Self::Box { size: [x, y, z] } => x.max(y).max(z),
            Self::Mesh { .. } => 0.0,
        }
    }

    /// What it is if it has no inside; whether a mesh has one, its file says.
    #[must_use]
    pub fn open(&self) -> Option<&'static str> {
        match self {
            Self::Rectangle { .. } => Some("a rectangle"),
            Self::Quad { .. } => Some("a quad"),
            Self::Faces { triangles, .. } if !is_closed(triangles) => {
                Some("a mesh with open edges")
            }
            Self::Faces { .. } | Self::Sphere { .. } | Self::Box { .. } | Self::Mesh { .. } => None,
        }
    }
}

/// The corners of a face.
#[expect(clippy::cast_possible_truncation, reason = "they were checked to be whole and inside u32")]
fn indices(corners: &[f64; 3]) -> [u32; 3] {
    corners.map(|index| index as u32)
}

/// What is wrong with a shape.
pub(crate) struct Flaw {
    /// The message.
    pub(crate) text: String,
    /// What stands under the place.
    pub(crate) label: &'static str,
    /// The triangle that it is about, or else the whole shape.
    pub(crate) face: Option<usize>,
}

/// Whether a quad has no area to speak of, because its corners lie on a line.
fn is_line([a, b, c]: &[[f64; 3]; 3]) -> bool {
    let edge = |p: &[f64; 3]| [0, 1, 2].map(|k| p[k] - b[k]);
    let (u, v) = (edge(a), edge(c));
    let length = |v: [f64; 3]| v.iter().map(|x| x * x).sum::<f64>().sqrt();
    let cross = [u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]];
    // The sine of the angle between its sides.
    let sine = length(cross) / (length(u) * length(v));
    sine.is_nan() || sine < 1e-6
}

/// Whether each edge has one triangle on either side.
fn is_closed(triangles: &[[u32; 3]]) -> bool {
    let mut sides: BTreeMap<[u32; 2], i64> = BTreeMap::new();
    for [a, b, c] in triangles {
        for [from, to] in [[a, b], [b, c], [c, a]] {
            let way = if from < to { 1 } else { -1 };
            *sides.entry([*from.min(to), *from.max(to)]).or_default() += way;
        }
    }
    sides.values().all(|sum| *sum == 0)
}

/// The corner of a parallelogram that three others leave.
#[must_use]
pub fn fourth([a, b, c]: [[f64; 3]; 3]) -> [f64; 3] {
    [0, 1, 2].map(|k| a[k] + c[k] - b[k])
}

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
    foreign: &[("plane", "Blender"), ("rect", "common use")],
};

const QUAD: TypeSchema = TypeSchema {
    kind: Kind::Shape,
    name: "quad",
    doc: "A parallelogram, given by three of its corners in order; the fourth is `a + c - b`. They run \
         counter-clockwise seen from its front. Texture coordinates are (0, 0), (1, 0), (1, 1) at `a`, `b`, `c`.",
    example: "instance wall { shape = quad(a: (0, 0, 0)m, b: (2, 0, 0)m, c: (2, 1, 0)m), material = clay }",
    fields: &[
        Field::new("a", CORNER, Default::Required, "The first corner, `Q` in other books.")
            .foreign(&[("Q", "Ray Tracing in One Weekend"), ("q", "Ray Tracing in One Weekend")]),
        Field::new("b", CORNER, Default::Required, "The second corner, `Q + u`."),
        Field::new("c", CORNER, Default::Required, "The third corner, `Q + u + v`."),
    ],
    foreign: &[("parallelogram", "common use")],
};

const CORNER: FieldType = FieldType::Vector(Dim::LENGTH, "m");

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

const MESH: TypeSchema = TypeSchema {
    kind: Kind::Shape,
    name: "mesh",
    doc: "A small mesh written in the scene; larger ones come from files. Its normals are those of its faces, and \
         it has no texture coordinates. It has an inside if every edge belongs to two faces.",
    example: "instance roof {
  shape = mesh(
    points: [(-1, 0, 1)m, (1, 0, 1)m, (1, 0, -1)m, (-1, 0, -1)m, (0, 1, 0)m],
    faces: [(0, 1, 4), (1, 2, 4), (2, 3, 4), (3, 0, 4), (3, 2, 1, 0)]
  )
  material = clay
}",
    fields: &[
        Field::new("points", FieldType::Points, Default::Required, "Corners of its faces.")
            .foreign(&[("vertices", "common use"), ("P", "pbrt"), ("positions", "Mitsuba")]),
        Field::new(
            "faces",
            FieldType::Faces,
            Default::Required,
            "Indices of the three or four points of each face, from 0, counter-clockwise seen from its front. Four \
             are split along the diagonal from the first to the third.",
        )
        .foreign(&[("indices", "pbrt"), ("triangles", "common use"), ("face_indices", "POV-Ray")]),
    ],
    foreign: &[("trianglemesh", "pbrt"), ("mesh2", "POV-Ray"), ("polyhedron", "OpenSCAD")],
};

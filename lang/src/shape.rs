//! Shapes that need no file: each is declared here, with its schema, its value, and what is asked of it.
//!
//! They are calls that stand where a shape is due. How a shape becomes spheres and triangles is the compiler's.

use std::collections::BTreeMap;

use crate::schema::{Bounds, Default, Field, FieldType, Kind, TypeSchema, types, words};
use crate::source::Span;
use crate::units::{self, Dim};

types!(ShapeType { Sphere = SPHERE, Rectangle = RECTANGLE, Box = BOX });

/// Arguments of a call by name, metres.
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
    /// Box around the origin.
    Box {
        /// Sizes along x, y, z.
        size: [f64; 3],
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
            ShapeType::Box => Self::Box { size: of("size")?.try_into().ok()? },
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
            Self::Box { size: [x, y, z] } => {
                Some(format!("box(size: ({}, {}, {})m)", number(*x), number(*y), number(*z)))
            }
            Self::Mesh { .. } => None,
        }
    }

    /// Its lengths, metres; those of a mesh are in its file.
    pub fn lengths_mut(&mut self) -> &mut [f64] {
        match self {
            Self::Sphere { radius } => std::slice::from_mut(radius),
            Self::Rectangle { size } => size,
            Self::Box { size } => size,
            Self::Mesh { .. } => &mut [],
        }
    }

    /// Full extent along x, y and z; that of a mesh is in its file.
    #[must_use]
    pub fn size(&self) -> Option<[f64; 3]> {
        match self {
            Self::Sphere { radius } => Some([2.0 * radius; 3]),
            Self::Rectangle { size: [x, z] } => Some([*x, 0.0, *z]),
            Self::Box { size } => Some(*size),
            Self::Mesh { .. } => None,
        }
    }

    /// No point is farther from the origin, along any axis; 0 for a mesh.
    #[must_use]
    pub fn reach(&self) -> f64 {
        match *self {
            Self::Sphere { radius } => radius,
            Self::Rectangle { size: [x, z] } => x.max(z),
            Self::Box { size: [x, y, z] } => x.max(y).max(z),
            Self::Mesh { .. } => 0.0,
        }
    }

    /// What it is if it has no inside; whether a mesh has one, its file says.
    #[must_use]
    pub fn open(&self) -> Option<&'static str> {
        match self {
            Self::Rectangle { .. } => Some("a rectangle"),
            Self::Sphere { .. } | Self::Box { .. } | Self::Mesh { .. } => None,
        }
    }
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

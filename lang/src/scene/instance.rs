//! Things in the world.

use super::Name;
use crate::source::Span;

/// A thing in the world.
#[derive(Clone, Debug, PartialEq)]
pub struct Instance {
    /// Name, with its index for indexed instances.
    pub name: Name,
    /// What it is.
    pub shape: Shape,
    /// Where the shape expression stands in the text.
    pub shape_span: Span,
    /// Index into `Scene::materials`; `None` takes the asset's own materials.
    pub material: Option<usize>,
    /// Where the material is named, if it is.
    pub material_span: Option<Span>,
    /// Rows of the 3x4 matrix `world_from_object`, metres: scale first, then rotate (about x, then
    /// y, then z), then translate; the objects an instance is nested in come after.
    pub world_from_object: [[f64; 4]; 3],
    /// World frame, metres per second; `world_from_object` is that of the moment 0.
    pub velocity: [f64; 3],
}

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
    /// A mesh file, or one named part of it (OBJ group or object; glTF node or mesh).
    Mesh {
        /// Index into `Scene::assets`.
        asset: usize,
        /// Name of the part as written after the dot; `None` is the whole file.
        part: Option<String>,
    },
}

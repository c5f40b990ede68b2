//! Things in the world.

use super::common::Name;
use super::links::LightLinks;
use super::motion::Motion;
use crate::shape::{MeshEdit, Shape};
use crate::source::Span;

/// A thing in the world.
#[derive(Clone, Debug, PartialEq)]
pub struct Instance {
    /// Name, with its index for indexed instances.
    pub name: Name,
    /// The object whose shape it is; `None`: its shape is its own.
    pub object: Option<Name>,
    /// What it is.
    pub shape: Shape,
    /// Where the shape expression stands in the text.
    pub shape_span: Span,
    /// Index into `Scene::materials`; `None` takes the asset's own materials. Of parts
    /// that `edits` names, theirs go first.
    pub material: Option<usize>,
    /// Where the material is named, if it is.
    pub material_span: Option<Span>,
    /// What is changed of the mesh file that it shows; the last that holds for a part decides.
    pub edits: Vec<MeshEdit<usize>>,
    /// Rows of the 3x4 matrix `world_from_object`, metres: scale first, then rotate (about x, then
    /// y, then z), then translate; the objects an instance is nested in come after.
    pub world_from_object: [[f64; 4]; 3],
    /// World frame, metres per second; `world_from_object` is that of the moment 0.
    pub velocity: [f64; 3],
    /// How it moves from key to key, beside `velocity`; its pose at the moment 0 is `world_from_object`.
    pub motion: Option<Motion>,
    /// Its light group, if it or an object around it names one.
    pub group: Option<String>,
    /// Of a light: what it lights. `None`: everything.
    pub links: Option<LightLinks>,
}

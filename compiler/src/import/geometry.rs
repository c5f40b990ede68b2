//! Geometry of a file of polygons before it becomes parts: flat arrays, as the file has them.

/// Most corners of one polygon; bounds the work of cutting it into triangles.
pub(super) const MAX_CORNERS: usize = 4096;
/// Bytes that a position, UV or normal takes: here, in a list that doubles as it grows, and in the table by which a
/// part numbers it.
pub(super) const VALUE_BYTES: u64 = 28;
/// Bytes that a colour takes: here, in a list that doubles as it grows.
pub(super) const COLOR_BYTES: u64 = 32;
/// Bytes that a corner of a face takes at most: its three indices and its share of the face here, copies of the
/// three values in a part, and its share of the triangles there; lists may have doubled.
pub(super) const CORNER_BYTES: u64 = 160;

/// Geometry as the file has it: in its unit, its axes and its order.
#[derive(Debug, Default)]
pub(super) struct Geometry {
    pub(super) positions: Vec<[f32; 3]>,
    /// Linear colours and alpha of vertices, 0 ..= 1: none, or as many as positions.
    pub(super) colors: Vec<[f32; 4]>,
    pub(super) uvs: Vec<[f32; 2]>,
    pub(super) normals: Vec<[f32; 3]>,
    /// Of all faces one after the other: indices into `positions`, `uvs` and `normals`. UV and normal of a corner
    /// that has none are `NO_CORNER`; then no corner of its run has them.
    pub(super) corners: Vec<[u32; 3]>,
    pub(super) faces: Vec<Face>,
    /// All faces, in order.
    pub(super) runs: Vec<Run>,
}

#[derive(Clone, Copy, Debug)]
pub(super) struct Face {
    /// From 3 to [`MAX_CORNERS`].
    pub(super) n_corners: u32,
    /// Its line, or its number from 0 in files that have no lines; for messages.
    pub(super) at: u32,
}

/// Consecutive faces with one state.
#[derive(Debug)]
pub(super) struct Run {
    pub(super) state: State,
    pub(super) n_faces: usize,
}

/// What holds for a face beside its corners.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct State {
    /// Index into [`Source::names`](super::build::Source::names).
    pub(super) name: u32,
    /// Index into [`Source::material_ids`](super::build::Source::material_ids).
    pub(super) material: Option<u32>,
    /// Corners have UVs.
    pub(super) has_uv: bool,
    /// Corners have normals.
    pub(super) has_normal: bool,
    /// Smoothing group: `None` where the file does not say, 0 for off.
    pub(super) smoothing: Option<u32>,
}

/// Names in force at a face.
#[derive(Clone, Debug, Default, PartialEq, Eq, PartialOrd, Ord)]
pub(super) struct PartName {
    /// Of the object: of OBJ the last `o`.
    pub(super) object: String,
    /// Of groups in it, separated by white space: of OBJ the last `g`.
    pub(super) groups: String,
}

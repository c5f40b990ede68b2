//! Primitives of meshes: which are used, and their arrays.

use super::super::error::{ErrorKind, ImportError};
use super::super::file::Reader;
use super::super::report::ImportReport;
use super::accessor::Buffers;
use super::document::Document;
use super::matrix::Matrix;
use super::node::Placed;
use super::variant;
use ::gltf::json::accessor::Type;
use ::gltf::json::mesh::{Mode, Primitive, Semantic};
use ::gltf::json::validation::Checked;
use ::gltf::json::{Accessor, Index, Material};
use std::collections::BTreeMap;

/// What the used primitives need.
pub(super) struct Table {
    /// Materials in use, in ascending order.
    pub(super) used: Vec<Index<Material>>,
    /// Some primitives name no material.
    pub(super) unnamed: bool,
    /// The variant of materials.
    pub(super) variant: Option<u32>,
    /// How often each mesh is placed.
    pub(super) uses: Vec<u32>,
}

/// One primitive, in the frame of its mesh.
pub(super) struct Decoded {
    pub(super) positions: Vec<[f32; 3]>,
    pub(super) normals: Option<Vec<[f32; 3]>>,
    pub(super) uvs: Option<Vec<[f32; 2]>>,
    /// Linear, 0 ..= 1.
    pub(super) colors: Option<Vec<[f32; 4]>>,
    pub(super) triangles: Vec<[u32; 3]>,
}

/// How indices make triangles; `None` for points and lines.
fn triangle_mode(primitive: &Primitive) -> Result<Option<Mode>, &'static str> {
    match primitive.mode {
        Checked::Valid(mode @ (Mode::Triangles | Mode::TriangleStrip | Mode::TriangleFan)) => {
            Ok(Some(mode))
        }
        Checked::Valid(_) => Ok(None),
        Checked::Invalid => Err("its mode is not one of glTF"),
    }
}

/// Whether tangents are stored that the material would use.
fn has_tangents(
    document: &Document<'_>,
    primitive: &Primitive,
    material: Option<Index<Material>>,
) -> bool {
    let material = material.and_then(|index| document.root.get(index));
    attribute(primitive, Semantic::Tangents).is_some()
        && material.is_some_and(|material| material.normal_texture.is_some())
}

fn attribute(primitive: &Primitive, semantic: Semantic) -> Option<Index<Accessor>> {
    primitive.attributes.get(&Checked::Valid(semantic)).copied()
}

impl Table {
    /// Counts triangles against the limit, from what accessors claim, before anything is decoded.
    pub(super) fn new(
        document: &Document<'_>,
        variant: Option<u32>,
        placed: &[Placed],
        reader: &mut Reader<'_>,
        report: &mut ImportReport,
    ) -> Result<Self, ImportError> {
        let limits = reader.limits;
        let mut uses = vec![0_u32; document.root.meshes.len()];
        for placed in placed {
            uses[placed.mesh] = uses[placed.mesh].saturating_add(1);
        }
        let (mut used, mut unnamed) = (BTreeMap::new(), false);
        let (mut n_triangles, mut n_bytes) = (0_u64, 0_u64);
        let mut left_out = [0_u64; 2];
        for (mesh_idx, mesh) in document.root.meshes.iter().enumerate() {
            let n_uses = u64::from(uses[mesh_idx]);
            for (primitive_idx, primitive) in mesh.primitives.iter().enumerate() {
                if n_uses == 0 {
                    continue;
                }
                let what = name(mesh_idx, primitive_idx);
                let mode = triangle_mode(primitive)
                    .map_err(|message| document.error(ErrorKind::Format, &what, message))?;
                let Some(mode) = mode else {
                    left_out[0] += 1;
                    continue;
                };
                let material = variant::material(primitive, variant);
                left_out[1] += u64::from(has_tangents(document, primitive, material));
                match material {
                    Some(material) => {
                        used.insert(material.value(), material);
                    }
                    None => unnamed = true,
                }
                n_triangles = n_triangles.saturating_add(
                    n_uses.saturating_mul(claimed(document, primitive, mode, &what)?),
                );
                let bytes = claimed_bytes(document, primitive, mode)?;
                n_bytes = n_bytes.saturating_add(bytes.saturating_mul(n_uses.saturating_add(1)));
            }
        }
        if n_triangles > limits.triangles {
            let max = limits.triangles;
            let message = format!("its scene has {n_triangles} triangles, the limit is {max}");
            return Err(ImportError::new(ErrorKind::Limit, document.file, message));
        }
        reader.take(n_bytes, document.file)?;
        let what = [
            "points and lines are left out",
            "tangents for normal maps come from the UVs, not from the file",
        ];
        for (count, what) in left_out.into_iter().zip(what) {
            report.warn_of(document.file, what, count, ["primitive", "primitives"]);
        }
        Ok(Self { used: used.into_values().collect(), unnamed, variant, uses })
    }
}

/// `mesh 0 primitive 1`.
pub(super) fn name(mesh_idx: usize, primitive_idx: usize) -> String {
    format!("mesh {mesh_idx} primitive {primitive_idx}")
}

/// Triangles that a primitive makes of as many indices or vertices as it claims.
fn claimed(
    document: &Document<'_>,
    primitive: &Primitive,
    mode: Mode,
    what: &str,
) -> Result<u64, ImportError> {
    let positions = position_accessor(document, primitive, what)?;
    let count = Buffers::count(document, primitive.indices.unwrap_or(positions))?;
    Ok(if mode == Mode::Triangles { count / 3 } else { count.saturating_sub(2) })
}

/// Bytes of its arrays, decoded or placed: values of four floats at most, corners as indices and in triangles.
fn claimed_bytes(
    document: &Document<'_>,
    primitive: &Primitive,
    mode: Mode,
) -> Result<u64, ImportError> {
    let mut bytes = 0_u64;
    for index in primitive.attributes.values() {
        bytes = bytes.saturating_add(Buffers::count(document, *index)?.saturating_mul(16));
    }
    // With joints, a matrix for each vertex.
    if let Some(index) = attribute(primitive, Semantic::Joints(0)) {
        let each = size_of::<Matrix>() as u64;
        bytes = bytes.saturating_add(Buffers::count(document, index)?.saturating_mul(each));
    }
    // With morph targets, the moves of one, and positions and normals that are moved.
    let targets = primitive.targets.iter().flatten();
    for index in targets.flat_map(|target| [target.positions, target.normals]).flatten() {
        bytes = bytes.saturating_add(Buffers::count(document, index)?.saturating_mul(36));
    }
    let positions = attribute(primitive, Semantic::Positions);
    if let Some(corners) = primitive.indices.or(positions) {
        let triangle = if mode == Mode::Triangles { 4 } else { 12 };
        let each = 4 + triangle;
        bytes = bytes.saturating_add(Buffers::count(document, corners)?.saturating_mul(each));
    }
    Ok(bytes)
}

fn position_accessor(
    document: &Document<'_>,
    primitive: &Primitive,
    what: &str,
) -> Result<Index<Accessor>, ImportError> {
    attribute(primitive, Semantic::Positions)
        .ok_or_else(|| document.error(ErrorKind::Format, what, "it has no POSITION"))
}

/// Reads the arrays of a primitive; `None` for points and lines. `uv_set` is the `n` of `TEXCOORD_n`.
pub(super) fn decode(
    buffers: &Buffers<'_>,
    primitive: &Primitive,
    uv_set: u32,
    what: &str,
) -> Result<Option<Decoded>, ImportError> {
    let document = buffers.document;
    let Ok(Some(mode)) = triangle_mode(primitive) else {
        return Ok(None);
    };
    let position_idx = position_accessor(document, primitive, what)?;
    let positions = buffers.floats::<3>(position_idx)?;
    let n = positions.len();
    let same_length = |length: usize, index: Index<Accessor>| {
        if length == n {
            return Ok(());
        }
        let accessor = format!("accessor {}", index.value());
        let message = format!("it has {length} elements, but there are {n} positions");
        Err(document.error(ErrorKind::Accessor, &accessor, message))
    };
    let mut normals = None;
    if let Some(index) = attribute(primitive, Semantic::Normals) {
        let values = buffers.floats::<3>(index)?;
        same_length(values.len(), index)?;
        normals = Some(values);
    }
    let mut uvs = None;
    if let Some(index) = attribute(primitive, Semantic::TexCoords(uv_set)) {
        let values = buffers.floats::<2>(index)?;
        same_length(values.len(), index)?;
        uvs = Some(values);
    }
    let mut colors = None;
    if let Some(index) = attribute(primitive, Semantic::Colors(0)) {
        let values = colors_of(buffers, index)?;
        same_length(values.len(), index)?;
        colors = Some(values);
    }
    let order: Vec<u32> = match primitive.indices {
        Some(index) => {
            let order = buffers.indices::<1>(index, n, "vertices")?;
            order.into_iter().flatten().collect()
        }
        None => (0..u32::try_from(n).unwrap_or(u32::MAX)).collect(),
    };
    let left = order.len() % 3;
    if mode == Mode::Triangles && left != 0 {
        let message = format!("{} indices do not make whole triangles", order.len());
        return Err(document.error(ErrorKind::Format, what, message));
    }
    let triangles = assemble(mode, &order);
    Ok(Some(Decoded { positions, normals, uvs, colors, triangles }))
}

/// Colours and alpha, which is 1 where there is none.
fn colors_of(buffers: &Buffers<'_>, index: Index<Accessor>) -> Result<Vec<[f32; 4]>, ImportError> {
    let kind = buffers.document.root.get(index).map(|accessor| accessor.type_);
    let clamped = |rgba: [f32; 4]| rgba.map(|x| x.clamp(0.0, 1.0));
    if kind == Some(Checked::Valid(Type::Vec4)) {
        let values = buffers.floats::<4>(index)?;
        return Ok(values.into_iter().map(clamped).collect());
    }
    let values = buffers.floats::<3>(index)?;
    Ok(values.into_iter().map(|[r, g, b]| clamped([r, g, b, 1.0])).collect())
}

/// Triangles of a list, strip or fan, all wound the same way.
fn assemble(mode: Mode, order: &[u32]) -> Vec<[u32; 3]> {
    match mode {
        Mode::TriangleStrip => order
            .windows(3)
            .enumerate()
            .map(|(i, w)| if i % 2 == 0 { [w[0], w[1], w[2]] } else { [w[1], w[0], w[2]] })
            // Strips are sewn together with triangles that repeat a vertex; they are no surface.
            .filter(|[a, b, c]| a != b && b != c && c != a)
            .collect(),
        Mode::TriangleFan => match order.split_first() {
            Some((first, rest)) => rest.windows(2).map(|w| [w[0], w[1], *first]).collect(),
            None => Vec::new(),
        },
        _ => order.chunks_exact(3).map(|w| [w[0], w[1], w[2]]).collect(),
    }
}

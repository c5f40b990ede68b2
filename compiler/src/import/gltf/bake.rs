//! Placed meshes become parts in the frame of the file.

use super::super::check::{Quality, cross, dot, edge, grow, is_zero, quality, single, unit};
use super::super::error::{ErrorKind, ImportError};
use super::super::mesh::{Attribute, Part};
use super::super::report::ImportReport;
use super::accessor::Buffers;
use super::maps::UvTransform;
use super::material::Converted;
use super::matrix::Matrix;
use super::node::Placed;
use super::primitive::{self, Decoded, Table};
use super::skin::{self, Influences};
use super::variant;
use ::gltf::json::mesh::Primitive;
use ::gltf::json::{Index, Material};
use std::borrow::Cow;
use std::collections::BTreeMap;

/// Makes one part of each primitive of each placed mesh.
pub(super) fn parts(
    (placed, skins): (&[Placed], &BTreeMap<usize, Vec<Matrix>>),
    table: &Table,
    materials: &[Converted],
    buffers: &Buffers<'_>,
    report: &mut ImportReport,
) -> Result<Vec<Part>, ImportError> {
    let document = buffers.document;
    let mut left = table.uses.clone();
    // Decoded arrays are kept only as long as another node places the same mesh.
    let mut kept: BTreeMap<(usize, usize), Option<Decoded>> = BTreeMap::new();
    let mut parts = Vec::new();
    for placed in placed {
        let mesh = &document.root.meshes[placed.mesh];
        left[placed.mesh] -= 1;
        for (primitive_idx, primitive) in mesh.primitives.iter().enumerate() {
            let what = primitive::name(placed.mesh, primitive_idx);
            let (material_idx, material) =
                find(materials, variant::material(primitive, table.variant));
            let uv_set = material.map_or(0, |material| material.uv_set);
            let key = (placed.mesh, primitive_idx);
            let decoded = match kept.remove(&key) {
                Some(decoded) => decoded,
                None => primitive::decode(buffers, primitive, uv_set, &what)?,
            };
            if let Some(decoded) = &decoded {
                let joints = placed.skin.and_then(|skin| skins.get(&skin)).map(Vec::as_slice);
                let stand = Stand::of(buffers, (primitive, decoded), (placed, joints), &what)?;
                let bake = Bake { decoded, stand, placed, material, report, place: &what, buffers };
                let part = bake.part()?;
                if !part.triangles.is_empty() {
                    let aliases = aliases(placed, mesh.name.as_deref());
                    let name = placed.path.join("/");
                    parts.push(Part { name, aliases, material: material_idx, ..part });
                }
            }
            if left[placed.mesh] > 0 {
                kept.insert(key, decoded);
            }
        }
    }
    Ok(parts)
}

fn find(
    materials: &[Converted],
    material: Option<Index<Material>>,
) -> (Option<u32>, Option<&Converted>) {
    let index = material.map(|index| index.value());
    let found = materials.iter().position(|material| material.index == index);
    (found.and_then(|i| u32::try_from(i).ok()), found.map(|i| &materials[i]))
}

fn aliases(placed: &Placed, mesh: Option<&str>) -> Vec<String> {
    let named = placed.path.iter().zip(placed.unnamed.iter()).filter(|(_, unnamed)| !**unnamed);
    let mut aliases: Vec<String> = named.map(|(name, _)| name.clone()).collect();
    aliases.extend(mesh.filter(|name| !name.is_empty()).map(str::to_owned));
    aliases.sort();
    aliases.dedup();
    aliases
}

/// How a primitive stands at one place.
struct Stand<'a> {
    /// In the frame of the mesh, as morph targets leave them.
    positions: Cow<'a, [[f32; 3]]>,
    normals: Option<Cow<'a, [[f32; 3]]>>,
    frames: Frames<'a>,
}

impl<'a> Stand<'a> {
    fn of(
        buffers: &Buffers<'_>,
        (primitive, decoded): (&Primitive, &'a Decoded),
        (placed, joints): (&'a Placed, Option<&[Matrix]>),
        what: &str,
    ) -> Result<Self, ImportError> {
        let mut positions = Cow::Borrowed(decoded.positions.as_slice());
        let mut normals = decoded.normals.as_deref().map(Cow::Borrowed);
        if primitive.targets.is_some() && placed.weights.iter().any(|weight| *weight != 0.0) {
            let to_normals = normals.as_mut().map(Cow::to_mut);
            skin::morph(buffers, primitive, &placed.weights, (positions.to_mut(), to_normals))?;
        }
        let frames = match joints {
            None => Frames::One(&placed.file_from_mesh),
            Some(joints) => {
                let size = (decoded.positions.len(), joints.len());
                let influences = Influences::of(buffers, primitive, size, what)?;
                Frames::Each(influences.matrices(joints))
            }
        };
        Ok(Self { positions, normals, frames })
    }
}

/// From the frame of the mesh to the frame of the file.
enum Frames<'a> {
    /// The same everywhere.
    One(&'a Matrix),
    /// For each vertex.
    Each(Vec<Matrix>),
}

impl Frames<'_> {
    fn of(&self, vertex: usize) -> &Matrix {
        match self {
            Self::One(matrix) => matrix,
            Self::Each(all) => &all[vertex],
        }
    }

    /// Whether the matrix of a vertex turns outside inside.
    fn mirrors(&self, vertex: usize) -> bool {
        determinant(self.of(vertex)) < 0.0
    }
}

/// One primitive at one place.
struct Bake<'a> {
    decoded: &'a Decoded,
    stand: Stand<'a>,
    placed: &'a Placed,
    material: Option<&'a Converted>,
    report: &'a mut ImportReport,
    /// `mesh 0 primitive 1`.
    place: &'a str,
    buffers: &'a Buffers<'a>,
}

impl Bake<'_> {
    /// The part, still without names.
    fn part(self) -> Result<Part, ImportError> {
        let document = self.buffers.document;
        let Stand { positions, normals: stored, frames } = &self.stand;
        let place = |(i, p): (usize, &[f32; 3])| single(transform(frames.of(i), *p));
        let positions: Vec<[f32; 3]> = positions.iter().enumerate().map(place).collect();
        if let Some(i) = positions.iter().position(|p| !p.iter().all(|x| x.is_finite())) {
            let node = self.placed.path.join("/");
            let message = format!("vertex {i} is infinite where node `{node}` places it");
            return Err(document.error(ErrorKind::Number, self.place, message));
        }
        let mut triangles = Vec::with_capacity(self.decoded.triangles.len());
        for (tri_idx, [a, b, c]) in self.decoded.triangles.iter().enumerate() {
            let mirrored = frames.mirrors(*a as usize);
            let triangle = if mirrored { [*a, *c, *b] } else { [*a, *b, *c] };
            let place = || format!("{}: {} triangle {tri_idx}", document.file, self.place);
            match quality(triangle.map(|vertex| positions[vertex as usize])) {
                Quality::ZeroArea => {
                    self.report.zero_area.add(place);
                    continue;
                }
                Quality::Needle => self.report.needles.add(place),
                Quality::Fine => {}
            }
            triangles.push(triangle);
        }
        let mut normals = Attribute::Absent;
        if let Some(stored) = stored {
            let turn = |(i, n): (usize, &[f32; 3])| {
                let sign = if frames.mirrors(i) { -1.0 } else { 1.0 };
                let cofactor = cofactor(frames.of(i));
                let turned = cofactor.map(|row| sign * dot(row, n.map(f64::from)));
                unit(turned).map_or([0.0; 3], single)
            };
            let mut turned: Vec<[f32; 3]> = stored.iter().enumerate().map(turn).collect();
            let place = || format!("{}: {}", document.file, self.place);
            let n_zero = replace_zero_normals(&mut turned, &triangles, &positions);
            for _ in 0..n_zero {
                self.report.zero_normals.add(place);
            }
            normals = Attribute::PerVertex(turned);
        }
        let uv = self.material.and_then(|material| material.uv_transform);
        let uvs = self.decoded.uvs.as_ref().map_or(Attribute::Absent, |uvs| {
            Attribute::PerVertex(uvs.iter().map(|uv_pair| flip(*uv_pair, uv.as_ref())).collect())
        });
        if let Attribute::PerVertex(uvs) = &uvs
            && !uvs.iter().flatten().all(|x| x.is_finite())
        {
            let message = "the texture transform of its material makes UVs infinite";
            return Err(document.error(ErrorKind::Number, self.place, message));
        }
        if !triangles.is_empty() {
            grow(&mut self.report.bounds, &positions);
        }
        let colors = self.decoded.colors.clone().unwrap_or_default();
        Ok(Part { positions, normals, uvs, triangles, colors, ..Part::default() })
    }
}

/// Gives vertices whose normal has no length the normal of a triangle there; returns how many.
fn replace_zero_normals(
    normals: &mut [[f32; 3]],
    triangles: &[[u32; 3]],
    positions: &[[f32; 3]],
) -> u64 {
    let mut n_replaced = 0;
    for triangle in triangles {
        for vertex in triangle.map(|vertex| vertex as usize) {
            if !is_zero(normals[vertex]) {
                continue;
            }
            let [a, b, c] = triangle.map(|vertex| positions[vertex as usize]);
            let flat = unit(cross(edge(a, b), edge(a, c))).unwrap_or([0.0, 1.0, 0.0]);
            normals[vertex] = single(flat);
            n_replaced += 1;
        }
    }
    n_replaced
}

/// The material's transform, then v upwards.
fn flip(uv: [f32; 2], transform: Option<&UvTransform>) -> [f32; 2] {
    let [u, v] = uv.map(f64::from);
    let [u, v] = transform.map_or([u, v], |transform| transform.apply([u, v]));
    single([u, 1.0 - v])
}

fn transform(matrix: &Matrix, p: [f32; 3]) -> [f64; 3] {
    let p = p.map(f64::from);
    matrix.map(|row| row[0] * p[0] + row[1] * p[1] + row[2] * p[2] + row[3])
}

fn columns(matrix: &Matrix) -> [[f64; 3]; 3] {
    [0, 1, 2].map(|column| [matrix[0][column], matrix[1][column], matrix[2][column]])
}

fn determinant(matrix: &Matrix) -> f64 {
    let [a, b, c] = columns(matrix);
    dot(a, cross(b, c))
}

/// Rows of the cofactor matrix: the inverse transpose times the determinant, defined also without
/// an inverse. It carries normals.
fn cofactor(matrix: &Matrix) -> [[f64; 3]; 3] {
    let [a, b, c] = columns(matrix);
    let columns = [cross(b, c), cross(c, a), cross(a, b)];
    [0, 1, 2].map(|row| [columns[0][row], columns[1][row], columns[2][row]])
}

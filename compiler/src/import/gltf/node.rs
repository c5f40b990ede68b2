//! The scene graph becomes a list of meshes with their matrices and names, and its lights and cameras.

use super::super::error::{ErrorKind, ImportError};
use super::super::studio::Studio;
use super::document::Document;
use super::matrix::{IDENTITY, Matrix, product};
use super::studio;
use ::gltf::json::{Index, Node};

/// Deepest nesting; real files stay below 50.
const MAX_DEPTH: usize = 256;
/// Longest name that is kept, in characters.
const MAX_NAME: usize = 256;

/// A mesh where the scene has it.
pub(super) struct Placed {
    /// Index of the mesh.
    pub(super) mesh: usize,
    /// From the frame of the mesh to the frame of the file.
    pub(super) file_from_mesh: Matrix,
    /// Names of the nodes from the root, `node 3` for those without.
    pub(super) path: Vec<String>,
    /// How many of `path` are made up.
    pub(super) unnamed: Vec<bool>,
}

/// A node to be visited.
struct Visit {
    node: Index<Node>,
    parent: Option<usize>,
    depth: usize,
    file_from_parent: Matrix,
}

/// How the walk came to a node.
#[derive(Clone, Copy)]
enum Reached {
    Not,
    AsRoot,
    From(usize),
}

/// All meshes, lights and cameras of the default scene, depth first, in the order of the file. Without a default scene
/// the first one is taken, and without scenes every node that is nobody's child.
pub(super) fn walk(document: &Document<'_>) -> Result<(Vec<Placed>, Studio), ImportError> {
    let root = document.root;
    let mut stack: Vec<Visit> = Vec::new();
    let start = |node| Visit { node, parent: None, depth: 0, file_from_parent: IDENTITY };
    stack.extend(roots(document)?.into_iter().rev().map(start));
    let mut parents: Vec<Reached> = vec![Reached::Not; root.nodes.len()];
    let (mut placed, mut studio) = (Vec::new(), Studio::default());
    while let Some(visit) = stack.pop() {
        let index = visit.node.value();
        let what = format!("node {index}");
        let fail = |kind, message: &str| Err(document.error(kind, &what, message));
        let Some(node) = root.get(visit.node) else {
            return fail(ErrorKind::Index, "there is no such node");
        };
        if !matches!(parents[index], Reached::Not) {
            return fail(ErrorKind::Format, "it is reached twice: the nodes do not form a tree");
        }
        if visit.depth >= MAX_DEPTH {
            return fail(ErrorKind::Limit, "it is nested more than 256 levels deep");
        }
        parents[index] = visit.parent.map_or(Reached::AsRoot, Reached::From);
        let Some(local) = local_matrix(node) else {
            return fail(ErrorKind::Number, "its transform is not a finite affine one");
        };
        let matrix = product(&visit.file_from_parent, &local);
        if !matrix.iter().flatten().all(|x| x.is_finite()) {
            return fail(ErrorKind::Number, "its transform, with those above it, overflows");
        }
        if let Some(mesh) = node.mesh {
            if root.get(mesh).is_none() {
                return fail(ErrorKind::Index, "its mesh does not exist");
            }
            let (path, unnamed) = path_of(document, &parents, index);
            placed.push(Placed { mesh: mesh.value(), file_from_mesh: matrix, path, unnamed });
        }
        studio::collect(document, node, &matrix, &mut studio)?;
        let children = node.children.iter().flatten().rev().map(|child| Visit {
            node: *child,
            parent: Some(index),
            depth: visit.depth + 1,
            file_from_parent: matrix,
        });
        stack.extend(children);
    }
    Ok((placed, studio))
}

fn roots(document: &Document<'_>) -> Result<Vec<Index<Node>>, ImportError> {
    let root = document.root;
    if let Some(scene) = root.scene {
        let what = format!("scene {}", scene.value());
        let scene = root.get(scene);
        return scene.map(|scene| scene.nodes.clone()).ok_or_else(|| {
            document.error(ErrorKind::Index, &what, "the default scene does not exist")
        });
    }
    if let Some(scene) = root.scenes.first() {
        return Ok(scene.nodes.clone());
    }
    let mut is_child = vec![false; root.nodes.len()];
    for child in root.nodes.iter().flat_map(|node| node.children.iter().flatten()) {
        if let Some(child) = is_child.get_mut(child.value()) {
            *child = true;
        }
    }
    let roots = (0..).zip(is_child).filter(|(_, is_child)| !is_child);
    Ok(roots.map(|(index, _)| Index::new(index)).collect())
}

/// Names from the root to node `index`, and which of them are made up.
fn path_of(document: &Document<'_>, parents: &[Reached], index: usize) -> (Vec<String>, Vec<bool>) {
    let mut path = Vec::new();
    let mut at = Some(index);
    while let Some(index) = at {
        let name = document.root.nodes[index].name.as_deref().filter(|name| !name.is_empty());
        path.push((
            name.map_or_else(
                || format!("node {index}"),
                |name| name.chars().take(MAX_NAME).collect(),
            ),
            name.is_none(),
        ));
        at = match parents[index] {
            Reached::From(parent) => Some(parent),
            Reached::AsRoot | Reached::Not => None,
        };
    }
    path.into_iter().rev().unzip()
}

/// The node's own transform; `None` when it is projective, without a rotation, or not finite.
fn local_matrix(node: &Node) -> Option<Matrix> {
    let matrix = if let Some(m) = &node.matrix {
        let m = m.map(f64::from); // column-major
        if [m[3], m[7], m[11]].iter().any(|x| x.abs() > 0.0) || (m[15] - 1.0).abs() > 1e-6 {
            return None;
        }
        [0, 1, 2].map(|row| [m[row], m[row + 4], m[row + 8], m[row + 12]])
    } else {
        let [tx, ty, tz] = node.translation.unwrap_or([0.0; 3]).map(f64::from);
        let [sx, sy, sz] = node.scale.unwrap_or([1.0; 3]).map(f64::from);
        let rotation = node.rotation.map_or([0.0, 0.0, 0.0, 1.0], |rotation| rotation.0);
        let r = rotation_matrix(rotation.map(f64::from))?;
        let row = |r: [f64; 3], t: f64| [r[0] * sx, r[1] * sy, r[2] * sz, t];
        [row(r[0], tx), row(r[1], ty), row(r[2], tz)]
    };
    matrix.iter().flatten().all(|x| x.is_finite()).then_some(matrix)
}

/// Of a quaternion (x, y, z, w) of any length but 0.
fn rotation_matrix(q: [f64; 4]) -> Option<[[f64; 3]; 3]> {
    let length = q.iter().map(|x| x * x).sum::<f64>().sqrt();
    if !(length > 0.0 && length.is_finite()) {
        return None;
    }
    let [x, y, z, w] = q.map(|c| c / length);
    Some([
        [1.0 - 2.0 * (y * y + z * z), 2.0 * (x * y - z * w), 2.0 * (x * z + y * w)],
        [2.0 * (x * y + z * w), 1.0 - 2.0 * (x * x + z * z), 2.0 * (y * z - x * w)],
        [2.0 * (x * z - y * w), 2.0 * (y * z + x * w), 1.0 - 2.0 * (x * x + y * y)],
    ])
}

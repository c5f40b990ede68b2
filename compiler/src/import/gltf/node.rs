//! The scene graph becomes a list of meshes with their matrices and names, and its lights and cameras.

use super::super::error::{ErrorKind, ImportError};
use super::super::file::Reader;
use super::super::studio::Studio;
use super::accessor::Buffers;
use super::document::Document;
use super::instancing;
use super::matrix::{IDENTITY, Matrix, product};
use super::pose::Pose;
use super::{skin, studio};
use ::gltf::json::{Index, Node};
use std::collections::BTreeMap;
use std::sync::Arc;

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
    pub(super) path: Arc<[String]>,
    /// Which of `path` are made up.
    pub(super) unnamed: Arc<[bool]>,
    /// Key of `Walk::skins`, where joints say the place instead.
    pub(super) skin: Option<usize>,
    /// Weights of the morph targets of the mesh; those that are missing are 0.
    pub(super) weights: Arc<[f32]>,
}

/// What the scene of a file has.
pub(super) struct Walk {
    /// Meshes, depth first, in the order of the file.
    pub(super) placed: Vec<Placed>,
    pub(super) studio: Studio,
    /// Matrices of the joints of each skin in use.
    pub(super) skins: BTreeMap<usize, Vec<Matrix>>,
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
pub(super) fn walk(
    buffers: &Buffers<'_>,
    pose: &Pose,
    reader: &mut Reader<'_>,
) -> Result<Walk, ImportError> {
    let document = buffers.document;
    let root = document.root;
    let mut stack: Vec<Visit> = Vec::new();
    let start = |node| Visit { node, parent: None, depth: 0, file_from_parent: IDENTITY };
    stack.extend(roots(document)?.into_iter().rev().map(start));
    let mut parents: Vec<Reached> = vec![Reached::Not; root.nodes.len()];
    let mut matrices: Vec<Option<Matrix>> = vec![None; root.nodes.len()];
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
        let Some(local) = pose.local_matrix(index, node) else {
            return fail(ErrorKind::Number, "its transform is not a finite affine one");
        };
        let matrix = product(&visit.file_from_parent, &local);
        if !matrix.iter().flatten().all(|x| x.is_finite()) {
            return fail(ErrorKind::Number, "its transform, with those above it, overflows");
        }
        matrices[index] = Some(matrix);
        if let Some(mesh) = node.mesh {
            let Some(shape) = root.get(mesh) else {
                return fail(ErrorKind::Index, "its mesh does not exist");
            };
            let stored = node.weights.as_deref().or(shape.weights.as_deref());
            let weights: Arc<[f32]> = pose.weights(index).or(stored).unwrap_or(&[]).into();
            let skin = node.skin.map(|skin| skin.value());
            let (path, unnamed) = path_of(document, &parents, index);
            let (path, unnamed): (Arc<[String]>, Arc<[bool]>) = (path.into(), unnamed.into());
            let instances = instancing::matrices(buffers, node, &what, reader)?;
            for node_from_mesh in instances.unwrap_or_else(|| vec![IDENTITY]) {
                let file_from_mesh = product(&matrix, &node_from_mesh);
                let (path, unnamed) = (Arc::clone(&path), Arc::clone(&unnamed));
                let (mesh, weights) = (mesh.value(), Arc::clone(&weights));
                placed.push(Placed { mesh, file_from_mesh, path, unnamed, skin, weights });
            }
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
    let mut skins = BTreeMap::new();
    for skin in root.nodes.iter().filter_map(|node| node.skin) {
        let used = placed.iter().any(|placed| placed.skin == Some(skin.value()));
        if used && !skins.contains_key(&skin.value()) {
            skins.insert(skin.value(), skin::joints(buffers, skin, &matrices, reader)?);
        }
    }
    Ok(Walk { placed, studio, skins })
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

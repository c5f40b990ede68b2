//! Skins and morph targets → where vertices are in one pose.
//!
//! As glTF 2.0, section 3.7.3, says: of a mesh with a skin only the joints count, not the node that has it.

use super::super::error::{ErrorKind, ImportError};
use super::super::file::Reader;
use super::accessor::Buffers;
use super::matrix::{IDENTITY, Matrix, product};
use ::gltf::json::mesh::{Primitive, Semantic};
use ::gltf::json::skin::Skin;
use ::gltf::json::validation::Checked;
use ::gltf::json::{Accessor, Index};

/// From the frame of the mesh to the frame of the file, for each joint of a skin; `nodes`: of each node of the scene.
pub(super) fn joints(
    buffers: &Buffers<'_>,
    skin: Index<Skin>,
    nodes: &[Option<Matrix>],
    reader: &mut Reader<'_>,
) -> Result<Vec<Matrix>, ImportError> {
    let document = buffers.document;
    let what = format!("skin {}", skin.value());
    let fail = |kind, message: &str| document.error(kind, &what, message);
    let skin = document.root.get(skin);
    let skin = skin.ok_or_else(|| fail(ErrorKind::Index, "there is no such skin"))?;
    reader.take((skin.joints.len() * 2 * size_of::<Matrix>()) as u64, document.file)?;
    let inverse = match skin.inverse_bind_matrices {
        None => vec![IDENTITY; skin.joints.len()],
        Some(index) => {
            let columns = buffers.floats::<16>(index)?;
            let matrix = |m: &[f32; 16]| {
                let m = m.map(f64::from);
                [0, 1, 2].map(|row| [m[row], m[row + 4], m[row + 8], m[row + 12]])
            };
            columns.iter().map(matrix).collect()
        }
    };
    if inverse.len() < skin.joints.len() {
        return Err(fail(ErrorKind::Accessor, "it has fewer inverse bind matrices than joints"));
    }
    let joint = |(node, inverse): (&Index<_>, &Matrix)| {
        let file_from_joint = nodes.get(node.value()).copied().flatten();
        let file_from_joint = file_from_joint
            .ok_or_else(|| fail(ErrorKind::Index, "one of its joints is not in the scene"))?;
        Ok(product(&file_from_joint, inverse))
    };
    skin.joints.iter().zip(&inverse).map(joint).collect()
}

/// Which joints move each vertex, and how much.
pub(super) struct Influences {
    /// Of each `JOINTS_n` and `WEIGHTS_n`.
    sets: Vec<Set>,
}

/// Joints and weights, an entry for each vertex.
type Set = (Vec<[u32; 4]>, Vec<[f32; 4]>);

impl Influences {
    /// Those of a primitive with `n` vertices.
    pub(super) fn of(
        buffers: &Buffers<'_>,
        primitive: &Primitive,
        (n, n_joints): (usize, usize),
        what: &str,
    ) -> Result<Self, ImportError> {
        let document = buffers.document;
        let find = |semantic| primitive.attributes.get(&Checked::Valid(semantic)).copied();
        let pair = |set| Some((find(Semantic::Joints(set))?, find(Semantic::Weights(set))?));
        let mut sets = Vec::new();
        for (joints, weights) in (0..).map_while(pair) {
            let joints = buffers.indices::<4>(joints, n_joints, "joints")?;
            let weights = buffers.floats::<4>(weights)?;
            if joints.len() != n || weights.len() != n {
                let message = format!("its joints or weights are not as many as its {n} positions");
                return Err(document.error(ErrorKind::Accessor, what, message));
            }
            sets.push((joints, weights));
        }
        if sets.is_empty() {
            let message = "its node has a skin, but it has no JOINTS_0 and WEIGHTS_0";
            return Err(document.error(ErrorKind::Format, what, message));
        }
        Ok(Self { sets })
    }

    /// The matrix of each vertex: the mean of its joints'. One without weights stays where the first joint has it.
    pub(super) fn matrices(&self, joints: &[Matrix]) -> Vec<Matrix> {
        let n = self.sets.first().map_or(0, |(first, _)| first.len());
        (0..n).map(|vertex| self.matrix(vertex, joints)).collect()
    }

    fn matrix(&self, vertex: usize, joints: &[Matrix]) -> Matrix {
        let (mut sum, mut total) = ([[0.0; 4]; 3], 0.0);
        for (indices, weights) in &self.sets {
            for (joint, weight) in indices[vertex].iter().zip(weights[vertex]) {
                let weight = f64::from(weight.max(0.0));
                total += weight;
                for (sum, joint) in
                    sum.iter_mut().flatten().zip(joints[*joint as usize].iter().flatten())
                {
                    *sum += weight * joint;
                }
            }
        }
        if total > 0.0 {
            sum.map(|row| row.map(|x| x / total))
        } else {
            self.sets.first().map_or(IDENTITY, |(first, _)| joints[first[vertex][0] as usize])
        }
    }
}

/// Moves positions and normals by the morph targets of a primitive, each as much as its weight says.
pub(super) fn morph(
    buffers: &Buffers<'_>,
    primitive: &Primitive,
    weights: &[f32],
    (positions, normals): (&mut [[f32; 3]], Option<&mut Vec<[f32; 3]>>),
) -> Result<(), ImportError> {
    let targets = primitive.targets.iter().flatten();
    let mut normals = normals;
    for (target, weight) in targets.zip(weights).filter(|(_, weight)| **weight != 0.0) {
        if let Some(index) = target.positions {
            add(buffers, index, *weight, positions)?;
        }
        if let (Some(index), Some(normals)) = (target.normals, normals.as_deref_mut()) {
            add(buffers, index, *weight, normals)?;
        }
    }
    Ok(())
}

fn add(
    buffers: &Buffers<'_>,
    index: Index<Accessor>,
    weight: f32,
    to: &mut [[f32; 3]],
) -> Result<(), ImportError> {
    let moves = buffers.floats::<3>(index)?;
    if moves.len() != to.len() {
        let (found, n) = (moves.len(), to.len());
        let what = format!("accessor {}", index.value());
        let message = format!("it has {found} elements, but there are {n} positions");
        return Err(buffers.document.error(ErrorKind::Accessor, &what, message));
    }
    for (to, by) in to.iter_mut().flatten().zip(moves.iter().flatten()) {
        *to += weight * by;
    }
    Ok(())
}

//! Placed triangles and spheres get their tree, in the layout of the pack.

use pack::abi;

use super::geometry::Placement;
use super::lowered::Counters;
use super::share::Instancing;
use super::stored::Placed;
use super::visibility::Visibility;
use crate::bvh::{self, BuildReport, BvhError, Joined, Layout, Motion, Preset, Primitives, Shared};
use crate::cache::Cache;
use crate::normalize::Normalization;

/// How trees over the geometry are made.
#[derive(Clone, Copy, Debug)]
pub struct Trees<'a> {
    /// Which builder.
    pub preset: Preset,
    /// How their nodes are stored.
    pub layout: Layout,
    /// Which meshes are stored once.
    pub instancing: Instancing,
    /// Whether lights are weighed by what can see them.
    pub visibility: Visibility,
    /// Trees of earlier runs.
    pub cache: &'a Cache,
}

impl<'a> Trees<'a> {
    /// As everybody gets them.
    #[must_use]
    pub fn usual(cache: &'a Cache) -> Self {
        let (preset, layout) = (Preset::default(), Layout::default());
        let (instancing, visibility) = (Instancing::default(), Visibility::default());
        Self { preset, layout, instancing, visibility, cache }
    }

    /// All that changes what is made, for keys.
    #[must_use]
    pub fn recipe(&self) -> String {
        format!("{} {} {}", self.preset.recipe(), self.layout.recipe(), self.instancing)
    }
}

/// The nodes in the layout of the pack: wide ones are returned, and `joined` is left with their roots, the
/// stack that they need, and no nodes. Instance `i` shows mesh `mesh_of[i]`.
fn widened(
    joined: &mut Joined,
    layout: Layout,
    mesh_of: &[usize],
) -> Result<Vec<abi::WideNode>, BvhError> {
    if layout == Layout::Binary || joined.nodes.is_empty() {
        return Ok(Vec::new());
    }
    let mut wide = Vec::new();
    let roots: Vec<u32> =
        std::iter::once(joined.root).chain(joined.mesh_roots.iter().copied()).collect();
    let roots = bvh::widen_all(&joined.nodes, &roots, &mut wide)?;
    let need = bvh::stack_need(&wide, &roots[1..], mesh_of, roots[0]);
    // Four children may wait where two did not: trees that are as deep as binary ones may be stay binary.
    if need > abi::MAX_STACK {
        return Ok(Vec::new());
    }
    joined.root = roots[0];
    joined.mesh_roots = roots[1..].to_vec();
    joined.stack_need = need;
    joined.nodes = Vec::new();
    Ok(wide)
}

/// Triangles of the world and of meshes that are stored once, one list.
pub(super) struct Corners {
    /// Those of the world first, then mesh after mesh.
    pub(super) all: Vec<[[f32; 3]; 3]>,
    n_world: usize,
    meshes: Vec<Vec<[[f32; 3]; 3]>>,
}

/// Adds what is stored once to the triangles of the world, and counts both.
pub(super) fn add_meshes(placement: &mut Placement, counters: &mut Counters) -> Corners {
    count_triangles(placement, counters);
    let mut corners = std::mem::take(&mut placement.corners);
    let n_world = corners.len();
    let mut meshes = Vec::with_capacity(placement.meshes.len());
    for mesh in &mut placement.meshes {
        placement.shades.append(&mut std::mem::take(&mut mesh.shades));
        placement.colors.append(&mut std::mem::take(&mut mesh.colors));
        corners.extend_from_slice(&mesh.corners);
        meshes.push(std::mem::take(&mut mesh.corners));
    }
    Corners { all: corners, n_world, meshes }
}

fn count_triangles(placement: &Placement, counters: &mut Counters) {
    let count = |mesh: usize| placement.meshes[mesh].corners.len() as u64;
    let flat = placement.shades.len() as u64;
    counters.meshes = placement.meshes.len() as u64;
    counters.instances = placement.placed.len() as u64;
    counters.triangles = flat + (0..placement.meshes.len()).map(count).sum::<u64>();
    counters.shown = flat + placement.placed.iter().map(|placed| count(placed.mesh)).sum::<u64>();
    counters.dropped_triangles += placement.meshes.iter().map(|mesh| mesh.dropped).sum::<u64>();
}

/// The trees over all triangles and spheres, and their wide nodes if they are stored in such; `motions`: how each
/// thing moves.
pub(super) fn build_tree(
    placement: &Placement,
    corners: &Corners,
    (motions, frame): (&[Motion], &Normalization),
    trees: &Trees<'_>,
) -> Result<(Joined, Vec<abi::WideNode>, BuildReport), BvhError> {
    let sizes = placement.mesh_sizes();
    let (mesh_motions, sphere_motions) = motions_of(placement, motions);
    let primitives = Primitives {
        triangles: &corners.all[..corners.n_world],
        mesh_sizes: &sizes,
        mesh_motions: &mesh_motions,
        spheres: &placement.spheres,
        sphere_motions: &sphere_motions,
    };
    let boxed = |placed: &Placed| {
        let motion = motions.get(placed.object as usize).cloned().unwrap_or_default();
        (placed.mesh, placed.box_of(frame, &motion))
    };
    let instances: Vec<_> = placement.placed.iter().map(boxed).collect();
    let shared = Shared { meshes: &corners.meshes, instances: &instances };
    let (mut joined, report) =
        bvh::build_instanced(&primitives, &shared, trees.preset, trees.cache)?;
    let mesh_of: Vec<usize> = placement.placed.iter().map(|placed| placed.mesh).collect();
    let wide_nodes = widened(&mut joined, trees.layout, &mesh_of)?;
    Ok((joined, wide_nodes, report))
}

/// How each mesh and each sphere moves, from what things do; empty where that is.
fn motions_of(placement: &Placement, of_thing: &[Motion]) -> (Vec<Motion>, Vec<Motion>) {
    if of_thing.is_empty() {
        return (Vec::new(), Vec::new());
    }
    let sphere = |object: &u32| of_thing[*object as usize].clone();
    let spheres = placement.sphere_objects.iter().map(sphere).collect();
    (placement.mesh_motions(of_thing), spheres)
}

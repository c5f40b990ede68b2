//! Which meshes share a tree.
//!
//! A large mesh has its own tree, so that it is found in the cache whatever else the scene holds. Small ones share
//! trees: one over their triangles is better than one over their trees, and takes no longer to build. Those that
//! are near each other share one, so that moving one of them leaves the trees of the others in the cache.

use std::ops::Range;

use super::fragment::Bounds;
use glam::Vec4;

/// Meshes of fewer triangles share a group.
pub const SMALL_MESH: usize = 20_000;
/// Small meshes of more triangles than this are divided, where that leaves groups of [`SMALL_MESH`] or more.
const MANY: usize = 4 * SMALL_MESH;
/// Most halvings of space.
const MAX_LEVELS: u32 = 24;

/// The groups, as ranges of triangles of the scene. Those of small meshes come last.
#[must_use]
pub fn plan(triangles: &[[[f32; 3]; 3]], mesh_sizes: &[usize]) -> Vec<Vec<Range<u32>>> {
    let mut groups = Vec::new();
    let mut small = Vec::new();
    let mut first = 0;
    for &size in mesh_sizes {
        let end = first + size;
        let bound = |x: usize| u32::try_from(x).expect("checked by the caller");
        let range = bound(first)..bound(end);
        match size {
            0 => {}
            _ if size < SMALL_MESH => small.push(Small::new(triangles, range)),
            _ => groups.push(std::iter::once(range).collect()),
        }
        first = end;
    }
    let cell = Bounds { lo: Vec4::splat(-1.0), hi: Vec4::splat(1.0) };
    let all = divide(small, cell, 0);
    groups.extend(all.into_iter().filter(|group| !group.is_empty()).map(|mut group| {
        group.sort_unstable_by_key(|mesh| mesh.range.start);
        group.into_iter().map(|mesh| mesh.range).collect()
    }));
    groups
}

/// A small mesh.
struct Small {
    range: Range<u32>,
    bounds: Bounds,
}

impl Small {
    fn new(triangles: &[[[f32; 3]; 3]], range: Range<u32>) -> Self {
        let corners = triangles[range.start as usize..range.end as usize].as_flattened();
        let point = |p: &[f32; 3]| Vec4::new(p[0], p[1], p[2], 0.0);
        let bounds = corners.iter().map(point).fold(Bounds::EMPTY, Bounds::with_point);
        Self { range, bounds }
    }

    fn len(&self) -> usize {
        self.range.len()
    }
}

fn n_triangles(group: &[Small]) -> usize {
    group.iter().map(Small::len).sum()
}

/// Divides meshes in a cell of space between the halves of the cell, and again, as long as they are many. Meshes
/// that are too large for a half, and those of halves with few, stay together. Where the planes are does not depend
/// on the meshes: one that moves leaves all groups but one or two as they are.
fn divide(group: Vec<Small>, cell: Bounds, level: u32) -> Vec<Vec<Small>> {
    if n_triangles(&group) <= MANY || level == MAX_LEVELS {
        return vec![group];
    }
    let axis = level as usize % 3;
    let middle = 0.5 * (cell.lo[axis] + cell.hi[axis]);
    let half = middle - cell.lo[axis];
    let mut sides = [Vec::new(), Vec::new()];
    let mut rest = Vec::new();
    for mesh in group {
        let (lo, hi) = (mesh.bounds.lo[axis], mesh.bounds.hi[axis]);
        if hi - lo > half {
            rest.push(mesh);
        } else {
            sides[usize::from(0.5 * (lo + hi) >= middle)].push(mesh);
        }
    }
    let mut groups = Vec::new();
    let [mut lower, mut upper] = [cell, cell];
    (lower.hi[axis], upper.lo[axis]) = (middle, middle);
    for (side, cell) in sides.into_iter().zip([lower, upper]) {
        if n_triangles(&side) < SMALL_MESH {
            rest.extend(side);
        } else {
            groups.extend(divide(side, cell, level + 1));
        }
    }
    groups.push(rest);
    groups
}

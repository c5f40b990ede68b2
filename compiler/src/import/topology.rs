//! How triangles hang together: open edges, wrong winding, repeats, volume.
//!
//! Corners at exactly the same position are one vertex, whatever parts and materials they belong to.

use super::check::{cross, dot, position_bits};
use super::mesh::Part;
use rayon::prelude::*;
use serde::{Deserialize, Serialize};

/// Facts about the surface that some parts form together.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Topology {
    /// Edges that belong to one triangle only; 0: the surface is closed.
    pub boundary_edges: u64,
    /// Connected runs of boundary edges: how many holes or rims there are.
    pub boundary_loops: u64,
    /// Middle of one boundary edge, metres.
    pub boundary_near: Option<[f32; 3]>,
    /// Edges that belong to more than two triangles.
    pub non_manifold_edges: u64,
    /// Edges whose two triangles run along them the same way: one of the two is inside out.
    pub flipped_edges: u64,
    /// Triangles that repeat the corners of an earlier one, in whatever order.
    pub duplicates: u64,
    /// Index among the given parts, and triangle index there, of one such repeat.
    pub first_duplicate: Option<(usize, usize)>,
    /// Enclosed volume, cubic metres; negative when inside out. Means something when closed.
    pub signed_volume: f64,
}

/// One side of one triangle: vertices in ascending order, and whether it ran the other way.
type Side = (u32, u32, bool);

/// Examines the surface that `parts` form together. Takes time `n log n` and, for a while, about
/// 100 bytes a triangle.
#[must_use]
pub fn topology(parts: &[&Part]) -> Topology {
    let (positions, triangles) = weld(parts);
    let mut found =
        Topology { signed_volume: volume(&positions, &triangles), ..Topology::default() };
    count_duplicates(parts, &triangles, &mut found);
    let mut sides: Vec<Side> = triangles.par_iter().flat_map_iter(|tri| sides(*tri)).collect();
    sides.par_sort_unstable();
    let mut boundary = Vec::new();
    for run in sides.chunk_by(|a, b| (a.0, a.1) == (b.0, b.1)) {
        match run {
            [one] => boundary.push((one.0, one.1)),
            [a, b] => found.flipped_edges += u64::from(a.2 == b.2),
            _ => found.non_manifold_edges += 1,
        }
    }
    found.boundary_edges = boundary.len() as u64;
    found.boundary_loops = count_runs(&boundary);
    found.boundary_near = boundary.first().map(|(a, b)| {
        let (a, b) = (positions[*a as usize], positions[*b as usize]);
        [0, 1, 2].map(|axis| f32::midpoint(a[axis], b[axis]))
    });
    found
}

fn sides([a, b, c]: [u32; 3]) -> [Side; 3] {
    [(a, b), (b, c), (c, a)].map(|(from, to)| (from.min(to), from.max(to), from > to))
}

/// Different positions in ascending order, and all triangles with indices into them.
fn weld(parts: &[&Part]) -> (Vec<[f32; 3]>, Vec<[u32; 3]>) {
    let mut positions: Vec<[f32; 3]> =
        parts.iter().flat_map(|part| part.positions.iter().map(|p| p.map(|x| x + 0.0))).collect();
    positions.par_sort_unstable_by_key(|p| position_bits(*p));
    positions.dedup_by_key(|p| position_bits(*p));
    let id = |p: [f32; 3]| {
        let found = positions.binary_search_by_key(&position_bits(p), |p| position_bits(*p));
        u32::try_from(found.expect("every position is in the list")).unwrap_or(u32::MAX)
    };
    let triangles = parts
        .iter()
        .flat_map(|part| {
            let ids: Vec<u32> = part.positions.par_iter().map(|p| id(*p)).collect();
            part.triangles.iter().map(move |tri| tri.map(|vertex| ids[vertex as usize]))
        })
        .collect();
    (positions, triangles)
}

fn volume(positions: &[[f32; 3]], triangles: &[[u32; 3]]) -> f64 {
    // Relative to one vertex, so that a small mesh far from the origin keeps its digits.
    let origin = positions.first().copied().unwrap_or_default();
    let local = |vertex: u32| super::check::edge(origin, positions[vertex as usize]);
    let sum: f64 =
        triangles.iter().map(|tri| dot(local(tri[0]), cross(local(tri[1]), local(tri[2])))).sum();
    sum / 6.0
}

fn count_duplicates(parts: &[&Part], triangles: &[[u32; 3]], found: &mut Topology) {
    let key = |(tri_idx, tri): (usize, &[u32; 3])| {
        let mut sorted = *tri;
        sorted.sort_unstable();
        (sorted, tri_idx)
    };
    let mut keys: Vec<([u32; 3], usize)> = triangles.par_iter().enumerate().map(key).collect();
    keys.par_sort_unstable();
    let repeats = || keys.windows(2).filter(|pair| pair[0].0 == pair[1].0).map(|pair| pair[1].1);
    found.duplicates = repeats().count() as u64;
    found.first_duplicate = repeats().min().map(|mut tri_idx| {
        let part_idx = parts.iter().position(|part| {
            let here = tri_idx < part.triangles.len();
            tri_idx -= if here { 0 } else { part.triangles.len() };
            here
        });
        (part_idx.unwrap_or_default(), tri_idx)
    });
}

/// Number of connected components of a graph of edges.
fn count_runs(edges: &[(u32, u32)]) -> u64 {
    let mut vertices: Vec<u32> = edges.iter().flat_map(|(a, b)| [*a, *b]).collect();
    vertices.sort_unstable();
    vertices.dedup();
    let mut parent: Vec<usize> = (0..vertices.len()).collect();
    let mut runs = vertices.len() as u64;
    for (a, b) in edges {
        let find = |parent: &mut Vec<usize>, vertex: u32| {
            let mut at = vertices.binary_search(&vertex).expect("collected above");
            while parent[at] != at {
                parent[at] = parent[parent[at]];
                at = parent[at];
            }
            at
        };
        let (root_a, root_b) = (find(&mut parent, *a), find(&mut parent, *b));
        if root_a != root_b {
            parent[root_a.max(root_b)] = root_a.min(root_b);
            runs -= 1;
        }
    }
    runs
}

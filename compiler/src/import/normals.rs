//! Computes shading normals for triangles that have none: smooth, with creases.
//!
//! Corners at the same position belong together, also across parts, unless `s` puts them into
//! different smoothing groups. The normal of a corner is the mean of the normals of those triangles
//! around it that are within the crease angle of its own triangle, weighted by their angle there
//! (Thürmer and Wüthrich 1998). `s off` makes flat corners.

use super::check::{cross, dot, edge, position_bits, single, unit};
use rayon::prelude::*;

/// Cosine of the crease angle, 60 degrees: a box stays sharp, a cylinder of 8 sides becomes round.
const CREASE: f64 = 0.5;

/// `s off`.
pub(super) const FLAT: u32 = 0;

/// Triangles of one part that need normals.
pub(super) struct Wanting<'a> {
    pub(super) positions: &'a [[f32; 3]],
    pub(super) triangles: &'a [[u32; 3]],
    /// Smoothing group of each triangle of the part; `FLAT` for none.
    pub(super) smoothing: &'a [u32],
    /// Triangles that need normals.
    pub(super) wanted: Vec<u32>,
}

/// Normals of one part.
#[derive(Default)]
pub(super) struct Computed {
    pub(super) values: Vec<[f32; 3]>,
    /// For each wanted triangle; indices into `values`.
    pub(super) corners: Vec<[u32; 3]>,
}

/// A corner of a wanted triangle; sorted, corners that belong together are neighbours.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
struct Corner {
    position: [u32; 3],
    smoothing: u32,
    /// Three times the index of the triangle in the list of all wanted ones, plus 0, 1 or 2.
    id: u32,
}

/// A wanted triangle.
#[derive(Clone, Copy)]
struct Face {
    part: u32,
    /// Index into `Wanting::wanted`.
    wanted_idx: u32,
    points: [[f32; 3]; 3],
    normal: [f64; 3],
}

/// Computes the normals of all wanted triangles; the result has one entry for each part.
/// There must be fewer than 2^30 of them.
pub(super) fn compute(parts: &[Wanting<'_>]) -> Vec<Computed> {
    let faces = faces(parts);
    let mut corners = corners(parts, &faces);
    corners.par_sort_unstable();
    let normals: Vec<[f32; 3]> = corners
        .par_chunk_by(|a, b| a.position == b.position && a.smoothing == b.smoothing)
        .flat_map_iter(|group| group_normals(group, &faces))
        .collect();
    assemble(parts, &faces, &corners, &normals)
}

fn faces(parts: &[Wanting<'_>]) -> Vec<Face> {
    let mut faces = Vec::with_capacity(parts.iter().map(|part| part.wanted.len()).sum());
    for (part_idx, part) in (0..).zip(parts) {
        faces.par_extend((0..u32::try_from(part.wanted.len()).unwrap_or(0)).into_par_iter().map(
            |wanted_idx| {
                let tri = part.triangles[part.wanted[wanted_idx as usize] as usize];
                let points = tri.map(|vertex| part.positions[vertex as usize]);
                let normal = cross(edge(points[0], points[1]), edge(points[0], points[2]));
                let normal = unit(normal).unwrap_or([0.0, 1.0, 0.0]); // zero-area ones are dropped before
                Face { part: part_idx, wanted_idx, points, normal }
            },
        ));
    }
    faces
}

fn corners(parts: &[Wanting<'_>], faces: &[Face]) -> Vec<Corner> {
    let n_corners = u32::try_from(3 * faces.len()).expect("fewer than 2^30 triangles");
    let corner = |id: u32| {
        let face = &faces[(id / 3) as usize];
        let part = &parts[face.part as usize];
        let tri_idx = part.wanted[face.wanted_idx as usize];
        Corner {
            position: position_bits(face.points[(id % 3) as usize]),
            smoothing: part.smoothing[tri_idx as usize],
            id,
        }
    };
    (0..n_corners).into_par_iter().map(corner).collect()
}

/// Most corners at one position that are compared each with each; keeps the time for any mesh linear.
const MAX_AROUND: usize = 1024;

fn group_normals(group: &[Corner], faces: &[Face]) -> Vec<[f32; 3]> {
    let face = |corner: &Corner| &faces[(corner.id / 3) as usize];
    if group[0].smoothing == FLAT || group.len() == 1 {
        return group.iter().map(|corner| single(face(corner).normal)).collect();
    }
    let around: Vec<([f64; 3], f64)> =
        group.iter().map(|c| (face(c).normal, angle(face(c), c.id % 3))).collect();
    let mean = |own: [f64; 3], within: &dyn Fn([f64; 3]) -> bool| {
        let mut sum = [0.0; 3];
        for (normal, angle) in around.iter().filter(|(normal, _)| within(*normal)) {
            for axis in 0..3 {
                sum[axis] += normal[axis] * angle;
            }
        }
        unit(sum).unwrap_or(own)
    };
    if group.len() > MAX_AROUND {
        let all = mean([0.0; 3], &|_| true);
        let pick = |own: [f64; 3]| if dot(own, all) >= CREASE { all } else { own };
        return around.iter().map(|(own, _)| single(pick(*own))).collect();
    }
    let smooth = |own: [f64; 3]| mean(own, &|other| dot(own, other) >= CREASE);
    around.iter().map(|(own, _)| single(smooth(*own))).collect()
}

/// Interior angle at a corner, radians.
fn angle(face: &Face, corner: u32) -> f64 {
    let at = |step: u32| face.points[((corner + step) % 3) as usize];
    let (to_next, to_last) = (edge(at(0), at(1)), edge(at(0), at(2)));
    let area = cross(to_next, to_last);
    libm::atan2(dot(area, area).sqrt(), dot(to_next, to_last))
}

/// How many normals at one position are searched for an equal one.
const MAX_RECENT: usize = 64;

/// Puts the normals where the parts want them; equal ones at one position are stored once.
fn assemble(
    parts: &[Wanting<'_>],
    faces: &[Face],
    corners: &[Corner],
    normals: &[[f32; 3]],
) -> Vec<Computed> {
    let empty = |part: &Wanting<'_>| Computed {
        values: Vec::new(),
        corners: vec![[0; 3]; part.wanted.len()],
    };
    let mut out: Vec<Computed> = parts.iter().map(empty).collect();
    let mut recent: Vec<(u32, [u32; 3], u32)> = Vec::new();
    let mut position = None;
    for (corner, normal) in corners.iter().zip(normals) {
        if position != Some(corner.position) {
            position = Some(corner.position);
            recent.clear();
        }
        let face = &faces[(corner.id / 3) as usize];
        let computed = &mut out[face.part as usize];
        let bits = position_bits(*normal);
        let known = recent.iter().find(|(part, known, _)| *part == face.part && *known == bits);
        let known = known.map(|(_, _, index)| *index);
        let store = || {
            let index = u32::try_from(computed.values.len()).expect("fewer than 2^32 corners");
            computed.values.push(*normal);
            if recent.len() < MAX_RECENT {
                recent.push((face.part, bits, index));
            }
            index
        };
        let index = known.unwrap_or_else(store);
        computed.corners[face.wanted_idx as usize][(corner.id % 3) as usize] = index;
    }
    out
}

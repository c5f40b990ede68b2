//! A profile turned around the y axis becomes an indexed mesh.

use std::f64::consts::TAU;

use super::glb::MeshData;
use super::vector::normalize;

/// Turns `profile` (radius, height pairs from bottom to top, metres) in `segments` steps.
/// Normals are smooth along the profile; u goes around, v along.
pub(super) fn lathe(profile: &[[f64; 2]], segments: usize) -> MeshData {
    let mut mesh = MeshData::default();
    for (row, point) in profile.iter().enumerate() {
        let below = profile[row.saturating_sub(1)];
        let above = profile[(row + 1).min(profile.len() - 1)];
        let slope = [above[1] - below[1], below[0] - above[0]];
        for step in 0..=segments {
            let u = step as f64 / segments as f64;
            let (s, c) = (libm::sin(TAU * u), libm::cos(TAU * u));
            mesh.positions.push([point[0] * c, point[1], point[0] * s].map(|x| x as f32));
            let normal = normalize([slope[0] * c, slope[1], slope[0] * s]);
            mesh.normals.push(normal.map(|x| x as f32));
            let v = row as f64 / (profile.len() - 1) as f64;
            // glTF's v points down.
            mesh.uvs.push([u as f32, (1.0 - v) as f32]);
        }
    }
    let width = segments + 1;
    for row in 0..profile.len() - 1 {
        for step in 0..segments {
            let corner = |r: usize, s: usize| (r * width + s) as u32;
            let (a, b) = (corner(row, step), corner(row, step + 1));
            let (c, d) = (corner(row + 1, step + 1), corner(row + 1, step));
            // At a pole the ring is one point, and one of the two triangles has no area.
            if profile[row + 1][0] > 0.0 {
                mesh.indices.extend([a, d, c]);
            }
            if profile[row][0] > 0.0 {
                mesh.indices.extend([a, c, b]);
            }
        }
    }
    mesh
}

/// A smooth profile through `points`: Catmull-Rom, `steps` pieces between neighbours.
pub(super) fn smooth_profile(points: &[[f64; 2]], steps: usize) -> Vec<[f64; 2]> {
    let at = |i: isize| points[i.clamp(0, points.len() as isize - 1) as usize];
    let mut out = Vec::new();
    for i in 0..points.len() as isize - 1 {
        let (p0, p1, p2, p3) = (at(i - 1), at(i), at(i + 1), at(i + 2));
        for step in 0..steps {
            let t = step as f64 / steps as f64;
            let mix = |k: usize| {
                0.5 * (2.0 * p1[k]
                    + t * (p2[k] - p0[k])
                    + t * t * (2.0 * p0[k] - 5.0 * p1[k] + 4.0 * p2[k] - p3[k])
                    + t * t * t * (3.0 * p1[k] - p0[k] - 3.0 * p2[k] + p3[k]))
            };
            out.push([mix(0).max(0.0), mix(1)]);
        }
    }
    out.push(points[points.len() - 1]);
    out
}

//! Meshes that are stored once, and the places where they are shown.
//!
//! Turns parts of a file into triangles in a frame of their own: that of the file, moved where that loses no bit
//! and scaled by a power of two, so that the triangles of a mesh, and with them the key of its tree, depend on the
//! file alone. Turns a place into the record with which the kernel takes rays to that frame.

use glam::{DMat3, DVec3};
use pack::abi::{self, MOVES, NONE, OBJECT_OF_INSTANCE, TRI_SMOOTH};
use serde::{Deserialize, Serialize};

use super::geometry::transform::{Transform, octahedral};
use crate::bvh::Motion;
use crate::import::Part;
use crate::normalize::Normalization;

/// A mesh that is stored once.
#[derive(Clone, Debug, Default)]
pub(super) struct Stored {
    /// Corners of its triangles, in its own frame, below 1 in magnitude.
    pub(super) corners: Vec<[[f32; 3]; 3]>,
    /// Shading data, one a triangle.
    pub(super) shades: Vec<abi::TriShade>,
    /// Colours of their corners; empty where nothing asks for them.
    pub(super) colors: Vec<abi::VertexColors>,
    /// What the corners are called in the last pack, three times `NONE` where it does not have them.
    pub(super) labels: Vec<[u32; 3]>,
    /// Triangles that have no area; not in the others.
    pub(super) dropped: u64,
    /// Different corners.
    points: Vec<[f32; 3]>,
    /// Largest magnitude of coordinates, axis by axis.
    reach: DVec3,
    /// Where the origin of the frame is in the file, metres.
    center: DVec3,
    /// The frame is the file's times this power of two.
    exponent: i32,
}

/// What is known of a mesh beside its triangles.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub(super) struct StoredRest {
    center: [f64; 3],
    exponent: i32,
    dropped: u64,
}

/// A place of a mesh that is stored once.
#[derive(Clone, Debug)]
pub(super) struct Placed {
    /// Index into `Placement::meshes`.
    pub(super) mesh: usize,
    /// Index into `Placement::things`.
    pub(super) object: u32,
    /// The material of all of it, or `NONE`.
    pub(super) material: u32,
    /// Corners of its box when the shutter opens, world frame, metres.
    pub(super) bounds: [DVec3; 2],
    /// World from the frame of the mesh, metres, when the shutter opens.
    linear: DMat3,
    translation: DVec3,
}

/// The largest row sum of `|m| |m^-1|`: how much a relative error of a vector can grow on its way through the
/// inverse and back. 1 to 3 for rotations with any scale first; infinite for a map without inverse.
pub(super) fn condition(m: DMat3) -> f64 {
    let inverse = m.inverse();
    let sums = (absolute(m) * absolute(inverse)) * DVec3::ONE;
    let sound = m.determinant() != 0.0 && m.is_finite() && inverse.is_finite() && sums.is_finite();
    if sound { sums.max_element() } else { f64::INFINITY }
}

fn absolute(m: DMat3) -> DMat3 {
    DMat3::from_cols(m.x_axis.abs(), m.y_axis.abs(), m.z_axis.abs())
}

impl Stored {
    /// The triangles of some parts, each with its material; with the colours of their corners if `colored`.
    pub(super) fn new(parts: &[(&Part, u32)], colored: bool) -> Self {
        let corners =
            |(part, _): &(&Part, u32)| (0..part.triangles.len()).map(|i| part.corners(i)).collect();
        let all: Vec<Vec<[[f32; 3]; 3]>> = parts.iter().map(corners).collect();
        let (center, exponent) = frame_of(all.iter().flatten().flatten());
        let mut mesh = Self { center, exponent, ..Self::default() };
        for ((part, material), triangles) in parts.iter().zip(&all) {
            for (tri_idx, corners) in triangles.iter().enumerate() {
                let corners = corners.map(|p| mesh.local(p));
                if has_no_area(&corners) {
                    mesh.dropped += 1;
                    continue;
                }
                mesh.corners.push(corners);
                mesh.shades.push(shade(part, tri_idx, *material));
                if colored {
                    mesh.colors.push(abi::VertexColors::of(part.corner_colors(tri_idx)));
                }
            }
        }
        mesh.labels = vec![[NONE; 3]; mesh.corners.len()];
        mesh.measure();
        mesh
    }

    /// What is known of it beside its triangles.
    pub(super) fn rest(&self) -> StoredRest {
        let (center, exponent) = (self.center.to_array(), self.exponent);
        StoredRest { center, exponent, dropped: self.dropped }
    }

    /// A mesh of these triangles, with their labels.
    pub(super) fn of_triangles(
        rest: &StoredRest,
        (corners, labels): (Vec<[[f32; 3]; 3]>, Vec<[u32; 3]>),
        (shades, colors): (Vec<abi::TriShade>, Vec<abi::VertexColors>),
    ) -> Self {
        let StoredRest { center, exponent, dropped } = *rest;
        let center = DVec3::from(center);
        let known = Self { corners, shades, colors, labels, ..Self::default() };
        let mut mesh = Self { dropped, center, exponent, ..known };
        mesh.measure();
        mesh
    }

    /// Notes the different corners and how far they are from the origin.
    fn measure(&mut self) {
        self.points = self.corners.as_flattened().to_vec();
        self.points.sort_unstable_by_key(|p| p.map(f32::to_bits));
        self.points.dedup();
        let grow = |most: DVec3, p: &[f32; 3]| most.max(DVec3::from(p.map(f64::from)).abs());
        self.reach = self.points.iter().fold(DVec3::ZERO, grow);
    }

    /// Corners and material of each triangle.
    pub(super) fn triangles(&self) -> impl Iterator<Item = (&[[f32; 3]; 3], u32)> {
        self.corners.iter().zip(self.shades.iter().map(|shade| shade.material))
    }

    /// A point of the file, metres, in the frame of the mesh: exact, unless it is next to nothing.
    fn local(&self, p: [f32; 3]) -> [f32; 3] {
        let p = DVec3::from(p.map(f64::from)) - self.center;
        p.to_array().map(|x| libm::scalbn(x, self.exponent) as f32 + 0.0)
    }
}

/// Whether the corners lie on one line, with products in `f64`, where they round least.
pub(super) fn has_no_area(corners: &[[f32; 3]; 3]) -> bool {
    let [a, b, c] = corners.map(|p| DVec3::from(p.map(f64::from)));
    (b - a).cross(c - a) == DVec3::ZERO
}

/// What is known of a triangle.
fn shade(part: &Part, tri_idx: usize, material: u32) -> abi::TriShade {
    let normals = part.corner_normals(tri_idx);
    let octahedral = |n: [f32; 3]| octahedral(DVec3::from(n.map(f64::from)));
    let [uv0, uv1, uv2] = part.corner_uvs(tri_idx).unwrap_or_default();
    let smooth = if normals.is_some() { TRI_SMOOTH } else { 0 };
    abi::TriShade {
        normals: normals.map_or([0; 3], |normals| normals.map(octahedral)),
        material,
        uv0,
        uv1,
        uv2,
        light: NONE,
        object: OBJECT_OF_INSTANCE | smooth,
    }
}

/// Where the frame of these points has its origin, and its scale. Axes along which all points are farther from 0
/// than from each other are moved, to one of the points: such differences are exact (Sterbenz 1974,
/// "Floating-Point Computation", theorem 4.3.1).
fn frame_of<'a>(points: impl Iterator<Item = &'a [f32; 3]>) -> (DVec3, i32) {
    let empty = (DVec3::INFINITY, DVec3::NEG_INFINITY);
    let (lo, hi) = points.fold(empty, |(lo, hi), p| {
        let p = DVec3::from(p.map(f64::from));
        (lo.min(p), hi.max(p))
    });
    if !lo.is_finite() || !hi.is_finite() {
        return (DVec3::ZERO, 0);
    }
    let near = |k: usize| match (lo[k], hi[k]) {
        (lo, hi) if lo > 0.0 && hi <= 2.0 * lo => lo,
        (lo, hi) if hi < 0.0 && lo >= 2.0 * hi => hi,
        _ => 0.0,
    };
    let center = DVec3::from([0, 1, 2].map(near));
    let largest = (lo - center).abs().max((hi - center).abs()).max_element();
    (center, if largest > 0.0 { -libm::ilogb(largest) - 1 } else { 0 })
}

impl Placed {
    /// `mesh`, the one with this `index`, where `transform` says.
    pub(super) fn new(
        mesh: &Stored,
        index: usize,
        transform: &Transform,
        object: u32,
        material: u32,
    ) -> Self {
        let linear = transform.linear * libm::scalbn(1.0, -mesh.exponent);
        let translation = transform.translation + transform.linear * mesh.center;
        let at = |p: &[f32; 3]| linear * DVec3::from(p.map(f64::from)) + translation;
        let empty = [DVec3::INFINITY, DVec3::NEG_INFINITY];
        let bounds = mesh.points.iter().map(at).fold(empty, |[lo, hi], p| [lo.min(p), hi.max(p)]);
        Self { mesh: index, object, material, bounds, linear, translation }
    }

    /// The material of a triangle that has `own` in the file.
    pub(super) fn material_of(&self, own: u32) -> u32 {
        if self.material == NONE { own } else { self.material }
    }

    /// Corners of a triangle of the mesh in the world, metres, counter-clockwise seen from its front.
    pub(super) fn triangle(&self, corners: &[[f32; 3]; 3]) -> [DVec3; 3] {
        let [a, b, c] =
            corners.map(|p| self.linear * DVec3::from(p.map(f64::from)) + self.translation);
        if self.linear.determinant() < 0.0 { [a, c, b] } else { [a, b, c] }
    }

    /// The record without its tree; `moves`: its object does.
    pub(super) fn record(
        &self,
        mesh: &Stored,
        frame: &Normalization,
        moves: bool,
    ) -> abi::Instance {
        let columns = self.normalised(frame);
        let rows = columns.inverse().transpose();
        let center = frame.point(self.translation.to_array());
        let column = |m: DMat3, k: usize| m.col(k).as_vec3().to_array();
        let [x, y, z] = [0, 1, 2].map(|k| column(rows, k));
        abi::Instance {
            row_x: x,
            row_y: y,
            row_z: z,
            root: NONE,
            material: self.material,
            object: self.object | if moves { MOVES } else { 0 },
            center,
            // What goes into a point, and what of a ray's origin goes to the mesh's frame and back; both are
            // rounded to 2^-24 of that, less than 16 times.
            reach: (DVec3::from(center.map(f64::from)).abs()
                + absolute(columns) * absolute(columns.inverse()) * absolute(columns) * mesh.reach)
                .max_element() as f32,
            col_x: column(columns, 0),
            col_y: column(columns, 1),
            col_z: column(columns, 2),
            ..abi::Instance::default()
        }
    }

    /// The linear part of the map into the normalised frame, as the record rounds it.
    fn normalised(&self, frame: &Normalization) -> DMat3 {
        let column = |k: usize| {
            DVec3::from(self.linear.col(k).to_array().map(|x| f64::from(frame.length(x))))
        };
        DMat3::from_cols(column(0), column(1), column(2))
    }

    /// Corners of the box of everything that a ray may hit, normalised frame, on the whole way along `motion`.
    ///
    /// The walk into the mesh's frame rounds, so that the ray meets a triangle up to 18 * 2^-24 of
    /// [`condition`] beside its place, for rays from up to 2 away: a scene has a radius below 1.
    pub(super) fn box_of(&self, frame: &Normalization, motion: &Motion) -> [[f32; 3]; 2] {
        let room = condition(self.normalised(frame)) / 524_288.0; // 2^-19
        let [lo, hi] = self.bounds.map(|corner| corner.to_array());
        let at =
            |corner: [f64; 3], k: usize| libm::scalbn(corner[k] - frame.center[k], frame.exponent);
        let motion = match motion {
            Motion::Straight(motion) => motion.map(f64::from),
            Motion::Along(path) => {
                let corner = |corner: [f64; 3]| DVec3::from([0, 1, 2].map(|k| at(corner, k)));
                let [lo, hi] = path.sweep_with_room(corner(lo), corner(hi));
                let (lo, hi) = ((lo - room).as_vec3(), (hi + room).as_vec3());
                return [lo.to_array().map(f32::next_down), hi.to_array().map(f32::next_up)];
            }
        };
        let way = |k: usize| motion[k].abs() / 4_194_304.0; // as of `Fragment::swept`
        let low = |k: usize| at(lo, k) + motion[k].min(0.0) - way(k) - room;
        let high = |k: usize| at(hi, k) + motion[k].max(0.0) + way(k) + room;
        [
            [0, 1, 2].map(|k| (low(k) as f32).next_down()),
            [0, 1, 2].map(|k| (high(k) as f32).next_up()),
        ]
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn frames_move_what_is_far_away_and_nothing_else() {
        let points = [[1000.5, -3.0, 0.25], [1001.25, 5.0, -0.125]];
        let (center, exponent) = frame_of(points.iter());
        assert_eq!((center, exponent), (DVec3::new(1000.5, 0.0, 0.0), -3));
        assert_eq!(frame_of([].iter()), (DVec3::ZERO, 0));
        let (center, _) = frame_of([[-3.0, -3.0, 0.0], [-2.0, -1.0, 0.0]].iter());
        assert_eq!(center, DVec3::new(-2.0, 0.0, 0.0));
    }

    #[test]
    fn conditions_of_rotated_scales_are_small_and_of_flat_maps_infinite() {
        let turn = DMat3::from_euler(glam::EulerRot::XYZ, 0.3, 1.1, -2.0);
        let scale = DMat3::from_diagonal(DVec3::new(1e-3, -5.0, 1e4));
        assert!((1.0..=3.0).contains(&condition(turn * scale)));
        assert!(condition(turn * scale * turn) > 64.0);
        assert!((condition(scale) - 1.0).abs() < 1e-12);
        assert!(condition(DMat3::from_diagonal(DVec3::new(1.0, 0.0, 1.0))).is_infinite());
    }

    #[test]
    fn rows_are_the_inverse_of_columns() {
        let corners = vec![[[0.5, 0.0, 0.25], [-0.5, 0.75, 0.0], [0.0, -0.25, 0.5]]];
        let mesh = Stored { points: corners.as_flattened().to_vec(), corners, ..Stored::default() };
        let linear = DMat3::from_euler(glam::EulerRot::XYZ, 0.3, 1.1, -2.0)
            * DMat3::from_diagonal(DVec3::new(2.0, -0.5, 0.01));
        let transform = Transform::new(linear, DVec3::new(3.0, -1.0, 7.0));
        let placed = Placed::new(&mesh, 0, &transform, 4, NONE);
        let frame = Normalization::of_points([[-9.0; 3], [9.0; 3]]);
        let record = placed.record(&mesh, &frame, true);
        assert!(record.inverse_error() < 1e-6, "{}", record.inverse_error());
        let thin = DMat3::from_euler(glam::EulerRot::XYZ, 0.3, 1.1, -2.0)
            * DMat3::from_diagonal(DVec3::new(2.0, -1e-6, 1e3));
        let thin = Placed::new(&mesh, 0, &Transform::new(thin, DVec3::ZERO), 4, NONE);
        let error = thin.record(&mesh, &frame, false).inverse_error();
        assert!(error < 1e-6, "{error}");
        assert_eq!(record.object, 4 | MOVES);
        let [lo, hi] = placed.box_of(&frame, &Motion::Straight([0.0, 0.5, 0.0]));
        for p in placed.triangle(&mesh.corners[0]) {
            for move_y in [0.0, 0.5] {
                let p = frame.point(p.to_array());
                let p = [p[0], p[1] + move_y, p[2]];
                assert!((0..3).all(|k| lo[k] < p[k] && p[k] < hi[k]), "{p:?} in {lo:?} {hi:?}");
            }
        }
        // Reversed, since the map mirrors.
        let [a, b, _] = placed.triangle(&mesh.corners[0]);
        let expected = linear * DVec3::from(mesh.corners[0][2].map(f64::from));
        assert!((b - a - (expected - (a - transform.translation))).length() < 1e-12);
    }
}

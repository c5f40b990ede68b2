//! Building blocks become one triangle mesh: boxes with chamfered edges, tubes, grids, turned
//! profiles. Metres, +y up, outside counter-clockwise, v of texture coordinates down.

use super::super::glb::MeshData;
pub(super) use super::super::vector::{V3, add, cross, dot, normalize, scale, sub};

/// A place: turned, scaled and moved.
#[derive(Clone, Copy, Debug)]
pub(super) struct Place {
    /// Columns: where x, y and z go.
    pub(super) axes: [V3; 3],
    /// Where the origin goes, metres.
    pub(super) at: V3,
}

impl Place {
    /// Moved only.
    pub(super) fn at(at: V3) -> Self {
        Self { axes: [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]], at }
    }

    /// Turned about y by `angle` radians, counter-clockwise from above, then moved.
    pub(super) fn turned(at: V3, angle: f64) -> Self {
        let (s, c) = (libm::sin(angle), libm::cos(angle));
        Self { axes: [[c, 0.0, -s], [0.0, 1.0, 0.0], [s, 0.0, c]], at }
    }

    /// With y along `up` and x as near to `side` as that allows.
    pub(super) fn upright(at: V3, up: V3, side: V3) -> Self {
        let y = normalize(up);
        let x = normalize(sub(side, scale(y, dot(side, y))));
        Self { axes: [x, y, cross(x, y)], at }
    }

    /// Stretched along its own axes.
    pub(super) fn stretched(self, s: V3) -> Self {
        Self { axes: [0, 1, 2].map(|k| scale(self.axes[k], s[k])), at: self.at }
    }

    /// Where a direction points.
    pub(super) fn turn(&self, v: V3) -> V3 {
        [0, 1, 2].map(|k| self.axes[0][k] * v[0] + self.axes[1][k] * v[1] + self.axes[2][k] * v[2])
    }

    /// Where a point goes.
    pub(super) fn point(&self, p: V3) -> V3 {
        add(self.at, self.turn(p))
    }

    /// Where a normal points.
    fn normal(&self, n: V3) -> V3 {
        let n = [0, 1, 2].map(|k| n[k] / dot(self.axes[k], self.axes[k]));
        normalize(self.turn(n))
    }
}

/// A mesh being built.
#[derive(Clone, Debug, Default)]
pub(super) struct Mesh(pub(super) MeshData);

impl Mesh {
    /// How many triangles.
    pub(super) fn triangles(&self) -> usize {
        self.0.indices.len() / 3
    }

    /// Adds a vertex; returns its index.
    pub(super) fn vertex(&mut self, p: V3, n: V3, uv: [f64; 2]) -> u32 {
        self.0.positions.push(p.map(|x| x as f32));
        self.0.normals.push(n.map(|x| x as f32));
        self.0.uvs.push(uv.map(|x| x as f32));
        self.0.positions.len() as u32 - 1
    }

    /// Adds a copy of `other` at `place`.
    pub(super) fn append(&mut self, other: &Self, place: &Place) {
        let first = self.0.positions.len() as u32;
        let wide = |v: [f32; 3]| v.map(f64::from);
        for ((p, n), uv) in other.0.positions.iter().zip(&other.0.normals).zip(&other.0.uvs) {
            self.0.positions.push(place.point(wide(*p)).map(|x| x as f32));
            self.0.normals.push(place.normal(wide(*n)).map(|x| x as f32));
            self.0.uvs.push(*uv);
        }
        self.0.indices.extend(other.0.indices.iter().map(|i| first + i));
    }

    /// A flat triangle.
    pub(super) fn flat_triangle(&mut self, p: [V3; 3], uv: [[f64; 2]; 3]) {
        let n = normalize(cross(sub(p[1], p[0]), sub(p[2], p[0])));
        let ids = [0, 1, 2].map(|k| self.vertex(p[k], n, uv[k]));
        self.0.indices.extend(ids);
    }

    /// A flat quad, corners counter-clockwise from where uv is (0, 1).
    pub(super) fn quad(&mut self, p: [V3; 4], size: [f64; 2]) {
        let n = normalize(cross(sub(p[1], p[0]), sub(p[3], p[0])));
        let uv = [[0.0, size[1]], size, [size[0], 0.0], [0.0, 0.0]];
        let ids = [0, 1, 2, 3].map(|k| self.vertex(p[k], n, uv[k]));
        self.0.indices.extend([0, 1, 2, 0, 2, 3].map(|k: usize| ids[k]));
    }

    /// A box around `place` with half sizes `half` and edges cut off by `chamfer`: 44 triangles.
    pub(super) fn block(&mut self, place: &Place, half: V3, chamfer: f64) {
        let c = chamfer.min(0.49 * half[0]).min(0.49 * half[1]).min(0.49 * half[2]);
        // The corner of a face: on the face of `axis`, at the signs of the octant.
        let corner = |s: V3, axis: usize| -> V3 {
            place.point([0, 1, 2].map(|k| s[k] * (if k == axis { half[k] } else { half[k] - c })))
        };
        for axis in 0..3 {
            let (a, b) = ((axis + 1) % 3, (axis + 2) % 3);
            for sign in [1.0, -1.0] {
                let at = |i: f64, j: f64| {
                    let mut s = [0.0; 3];
                    (s[axis], s[a], s[b]) = (sign, i * sign, j);
                    corner(s, axis)
                };
                let p = [at(-1.0, -1.0), at(1.0, -1.0), at(1.0, 1.0), at(-1.0, 1.0)];
                self.quad(p, [2.0 * half[a], 2.0 * half[b]]);
            }
            // The four edges along `axis`, between the faces of a and b.
            for (i, j) in [(1.0, 1.0), (-1.0, 1.0), (-1.0, -1.0), (1.0, -1.0)] {
                let at = |end: f64, face: usize| {
                    let mut s = [0.0; 3];
                    (s[axis], s[a], s[b]) = (end, i, j);
                    corner(s, face)
                };
                let (f, g) = if i * j > 0.0 { (a, b) } else { (b, a) };
                let p = [at(-1.0, f), at(-1.0, g), at(1.0, g), at(1.0, f)];
                self.quad(p, [2.0 * c, 2.0 * half[axis]]);
            }
        }
        for octant in 0..8_u32 {
            let s = [0, 1, 2].map(|k| if octant >> k & 1 == 0 { 1.0 } else { -1.0 });
            let p = [corner(s, 0), corner(s, 1), corner(s, 2)];
            let p = if s[0] * s[1] * s[2] > 0.0 { p } else { [p[0], p[2], p[1]] };
            self.flat_triangle(p, [[0.0; 2]; 3]);
        }
    }

    /// A box along the axes from its lower to its upper corner.
    pub(super) fn bar(&mut self, low: V3, high: V3, chamfer: f64) {
        let at = scale(add(low, high), 0.5);
        self.block(&Place::at(at), scale(sub(high, low), 0.5), chamfer);
    }

    /// A straight beam from `a` to `b`, `width` across and `height` upward.
    pub(super) fn beam(&mut self, a: V3, b: V3, [width, height]: [f64; 2], chamfer: f64) {
        let along = sub(b, a);
        let side = normalize(cross([0.0, 1.0, 0.0], along));
        let side = if libm::fabs(side[1]) > 0.9 { [1.0, 0.0, 0.0] } else { side };
        let z = normalize(along);
        let place = Place { axes: [side, cross(z, side), z], at: scale(add(a, b), 0.5) };
        let length = 0.5 * libm::sqrt(dot(along, along));
        self.block(&place, [0.5 * width, 0.5 * height, length], chamfer);
    }

    /// A surface over the unit square with smooth normals, towards the cross product of its sides.
    /// `size`: what texture coordinates reach.
    pub(super) fn grid(&mut self, n: [usize; 2], size: [f64; 2], surface: impl Fn(f64, f64) -> V3) {
        let at = |i: usize, j: usize| (i as f64 / n[0] as f64, j as f64 / n[1] as f64);
        let first = self.0.positions.len() as u32;
        let (du, dv) = (0.5 / n[0] as f64, 0.5 / n[1] as f64);
        for (i, j) in (0..=n[0]).flat_map(|i| (0..=n[1]).map(move |j| (i, j))) {
            let (u, v) = at(i, j);
            let (u0, u1) = ((u - du).max(0.0), (u + du).min(1.0));
            let (v0, v1) = ((v - dv).max(0.0), (v + dv).min(1.0));
            let along = sub(surface(u1, v), surface(u0, v));
            let across = sub(surface(u, v1), surface(u, v0));
            self.vertex(surface(u, v), normalize(cross(along, across)), [u * size[0], v * size[1]]);
        }
        let id = |i: usize, j: usize| first + (i * (n[1] + 1) + j) as u32;
        for (i, j) in (0..n[0]).flat_map(|i| (0..n[1]).map(move |j| (i, j))) {
            let [a, b, c, d] = [id(i, j), id(i + 1, j), id(i + 1, j + 1), id(i, j + 1)];
            self.0.indices.extend([a, b, c, a, c, d]);
        }
    }

    /// A round tube along `path` with a radius at each point; u goes around, v along in metres
    /// times `rate`.
    pub(super) fn tube(&mut self, path: &[V3], radius: &[f64], segments: usize, rate: f64) {
        let first = self.0.positions.len() as u32;
        let mut side = [0.31, 0.17, 0.93];
        let mut length = 0.0;
        for (k, p) in path.iter().enumerate() {
            let (before, after) = (path[k.saturating_sub(1)], path[(k + 1).min(path.len() - 1)]);
            let along = normalize(sub(after, before));
            side = normalize(sub(side, scale(along, dot(side, along))));
            let other = cross(along, side);
            length += if k == 0 { 0.0 } else { libm::sqrt(dot(sub(*p, before), sub(*p, before))) };
            for s in 0..=segments {
                let a = std::f64::consts::TAU * s as f64 / segments as f64;
                let n = add(scale(side, libm::cos(a)), scale(other, libm::sin(a)));
                let uv = [s as f64 / segments as f64, length * rate];
                self.vertex(add(*p, scale(n, radius[k])), n, uv);
            }
        }
        let id = |k: usize, s: usize| first + (k * (segments + 1) + s) as u32;
        for (k, s) in (0..path.len() - 1).flat_map(|k| (0..segments).map(move |s| (k, s))) {
            let [a, b, c, d] = [id(k, s), id(k, s + 1), id(k + 1, s + 1), id(k + 1, s)];
            self.0.indices.extend([a, b, c, a, c, d]);
        }
    }

    /// A profile (radius, height from bottom to top) turned around y in `segments` steps, with
    /// edges kept sharp along the profile; few segments make a prism with flat sides.
    pub(super) fn turned(&mut self, profile: &[[f64; 2]], segments: usize, place: &Place) {
        let smooth = segments > 8;
        let ring = |s: usize| {
            let a = std::f64::consts::TAU * s as f64 / segments as f64;
            [libm::cos(a), libm::sin(a)]
        };
        for pair in profile.windows(2) {
            let ([r0, y0], [r1, y1]) = (pair[0], pair[1]);
            for s in 0..segments {
                let (a, b) = (ring(s), ring(s + 1));
                let p = |r: f64, y: f64, d: [f64; 2]| place.point([r * d[0], y, r * d[1]]);
                let corners = [p(r0, y0, b), p(r0, y0, a), p(r1, y1, a), p(r1, y1, b)];
                let slope = |d: [f64; 2]| {
                    place.turn(normalize([(y1 - y0) * d[0], r0 - r1, (y1 - y0) * d[1]]))
                };
                let middle = [0.5 * (a[0] + b[0]), 0.5 * (a[1] + b[1])];
                let (na, nb) =
                    if smooth { (slope(a), slope(b)) } else { (slope(middle), slope(middle)) };
                let u = [s as f64 / segments as f64, (s + 1) as f64 / segments as f64];
                let uv = [[u[1], 1.0 - y0], [u[0], 1.0 - y0], [u[0], 1.0 - y1], [u[1], 1.0 - y1]];
                let ids = [nb, na, na, nb];
                let ids = [0, 1, 2, 3].map(|k| self.vertex(corners[k], normalize(ids[k]), uv[k]));
                if r0 > 0.0 {
                    self.0.indices.extend([ids[0], ids[1], ids[2]]);
                }
                if r1 > 0.0 {
                    self.0.indices.extend([ids[0], ids[2], ids[3]]);
                }
            }
        }
    }
}

/// A ball of 20 * 4^`level` triangles, radius 1, moved outward by `bump` of the direction.
pub(super) fn ball(level: u32, bump: impl Fn(V3) -> f64) -> Mesh {
    let t = 0.5 * (1.0 + libm::sqrt(5.0));
    let corners: Vec<V3> = [
        [-1.0, t, 0.0],
        [1.0, t, 0.0],
        [-1.0, -t, 0.0],
        [1.0, -t, 0.0],
        [0.0, -1.0, t],
        [0.0, 1.0, t],
        [0.0, -1.0, -t],
        [0.0, 1.0, -t],
        [t, 0.0, -1.0],
        [t, 0.0, 1.0],
        [-t, 0.0, -1.0],
        [-t, 0.0, 1.0],
    ]
    .into_iter()
    .map(normalize)
    .collect();
    let faces = [
        [0, 11, 5],
        [0, 5, 1],
        [0, 1, 7],
        [0, 7, 10],
        [0, 10, 11],
        [1, 5, 9],
        [5, 11, 4],
        [11, 10, 2],
        [10, 7, 6],
        [7, 1, 8],
        [3, 9, 4],
        [3, 4, 2],
        [3, 2, 6],
        [3, 6, 8],
        [3, 8, 9],
        [4, 9, 5],
        [2, 4, 11],
        [6, 2, 10],
        [8, 6, 7],
        [9, 8, 1],
    ];
    let mut triangles: Vec<[V3; 3]> = faces.iter().map(|f| f.map(|k: usize| corners[k])).collect();
    for _ in 0..level {
        let split = |[a, b, c]: [V3; 3]| {
            let [d, e, f] = [[a, b], [b, c], [c, a]].map(|[p, q]| normalize(add(p, q)));
            [[a, d, f], [d, b, e], [f, e, c], [d, e, f]]
        };
        triangles = triangles.into_iter().flat_map(split).collect();
    }
    let mut mesh = Mesh::default();
    let point = |d: V3| scale(d, bump(d));
    let mut known = std::collections::BTreeMap::new();
    for triangle in triangles {
        let ids = triangle.map(|d| {
            *known.entry(d.map(f64::to_bits)).or_insert_with(|| {
                let side = normalize(cross(d, [0.31, 0.87, 0.41]));
                let other = cross(d, side);
                let step = |v: V3| point(normalize(add(d, scale(v, 0.05))));
                let p = point(d);
                let n = normalize(cross(sub(step(side), p), sub(step(other), p)));
                mesh.vertex(p, n, [0.5 + 0.5 * d[0], 0.5 + 0.5 * d[2]])
            })
        });
        mesh.0.indices.extend(ids);
    }
    mesh
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Volume inside of a closed mesh; wrong winding makes it wrong or negative.
    fn volume(mesh: &Mesh) -> f64 {
        let p = |i: u32| mesh.0.positions[i as usize].map(f64::from);
        mesh.0.indices.chunks(3).map(|t| dot(p(t[0]), cross(p(t[1]), p(t[2]))) / 6.0).sum()
    }

    #[test]
    fn a_block_is_closed_and_its_outside_is_outside() {
        let mut mesh = Mesh::default();
        let (half, c) = ([1.0, 2.0, 0.5], 0.1);
        mesh.block(&Place::turned([1.0, 2.0, 3.0], 0.7), half, c);
        assert_eq!(mesh.triangles(), 44);
        // A prism of c^2 / 2 is cut off along each edge, and five sixths of c^3 more at each corner.
        let edges: f64 = half.iter().map(|h| 4.0 * 2.0 * (h - c)).sum();
        let expected = 8.0 - 0.5 * c * c * edges - 8.0 * 5.0 / 6.0 * c * c * c;
        assert!((volume(&mesh) - expected).abs() < 1e-5, "{}, not {expected}", volume(&mesh));
    }

    #[test]
    fn a_ball_is_round() {
        let ball = ball(3, |_| 1.0);
        assert_eq!(ball.triangles(), 1280);
        assert!(
            (volume(&ball) - 4.0 / 3.0 * std::f64::consts::PI).abs() < 0.06,
            "{}",
            volume(&ball)
        );
    }

    #[test]
    fn turned_and_tubes_face_outward() {
        let mut mesh = Mesh::default();
        mesh.turned(&[[0.0, 0.0], [1.0, 0.0], [1.0, 2.0], [0.0, 2.0]], 64, &Place::at([0.0; 3]));
        assert!((volume(&mesh) - 2.0 * std::f64::consts::PI).abs() < 0.05, "{}", volume(&mesh));
        let mut tube = Mesh::default();
        tube.tube(&[[0.0; 3], [0.0, 1.0, 0.0], [0.0, 2.0, 0.0]], &[0.0, 1.0, 0.0], 32, 1.0);
        assert!(volume(&tube) > 1.8);
    }
}

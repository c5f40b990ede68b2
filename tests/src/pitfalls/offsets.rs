//! Where a ray starts that leaves a surface: a fixed distance off (the naive form), or as far as rounding goes.

#![expect(
    clippy::cast_possible_truncation,
    reason = "the naive form and the kernel compute in f32"
)]

use glam::{DVec3, Vec2, Vec3};
use pack::abi::Triangle;
use runtime::kernel::f32 as single;

use super::{Row, Topic, row, share, triangle};
use crate::kernel::{self, Bench, skip};
use crate::statistics::stream::Stream;

/// Distance along the normal at which the naive shadow ray starts, and the nearest hit that counts.
const GUIDE: (f32, f32) = (0.001, 0.001);

/// A triangle of size 1 at a distance from the origin, and a point of it in double precision.
struct Place3 {
    corners: [DVec3; 3],
    normal: DVec3,
}

impl Place3 {
    fn new(distance: f64, size: f64, stream: &mut Stream) -> Self {
        let center = stream.direction() * distance;
        loop {
            let c = [0; 3].map(|_| stream.direction() * size);
            let n = (c[1] - c[0]).cross(c[2] - c[0]);
            if n.length() > 0.3 * size * size {
                // Rounded once: what a scene in these units holds.
                let corners = c.map(|c| (center + c).as_vec3().as_dvec3());
                let [v0, v1, v2] = corners;
                return Self { corners, normal: (v1 - v0).cross(v2 - v0).normalize() };
            }
        }
    }

    fn point(&self, b: Vec2) -> DVec3 {
        let [v0, v1, v2] = self.corners;
        v0 + (v1 - v0) * f64::from(b.x) + (v2 - v0) * f64::from(b.y)
    }
}

/// A direction at cosine down to 1e-3 from `n`.
fn leaving(n: DVec3, stream: &mut Stream) -> DVec3 {
    let cos = 10.0_f64.powf(stream.between(-3.0, 0.0));
    let side = n.cross(stream.direction()).normalize();
    (n * cos + side * (1.0 - cos * cos).sqrt()).normalize()
}

/// Barycentric weights of a point that is not near the rim.
fn weights(stream: &mut Stream) -> Vec2 {
    let (x, y) = (stream.unit24(), stream.unit24());
    let b = if x + y > 1.0 { Vec2::new(1.0 - x, 1.0 - y) } else { Vec2::new(x, y) };
    b * 0.7 + Vec2::splat(0.1)
}

/// A triangle whose vertices are `first` and the next two: two triangles of the same vertices are one to the kernel.
fn record(first: u32, corners: [DVec3; 3]) -> Triangle {
    let [v0, v1, v2] = corners.map(|v| v.as_vec3().to_array());
    Triangle { v0, id0: first, v1, id1: first + 1, v2, id2: first + 2 }
}

/// The kernel's scale for coordinates up to `reach`: the power of two that brings them below 1.
fn normalised(reach: f64) -> f64 {
    (-reach.log2().ceil() - 1.0).exp2()
}

/// What `n` rays that leave triangles of `size`, `distance` units from the origin, hit: their own triangle,
/// which is wrong; and a parallel one `gap` above it, which is right. First the naive form, then the kernel.
#[must_use]
pub fn leave(distance: f64, size: f64, gap: f64, n: usize) -> [[usize; 2]; 2] {
    let mut stream = Stream::new(163, distance as u64);
    let scale = normalised(distance + 2.0 * size + gap);
    let [mut own, mut missed] = [[0; 2]; 2];
    for _ in 0..n {
        let place = Place3::new(distance, size, &mut stream);
        let b = weights(&mut stream);
        let aim = place.point(b);
        let from = aim + leaving(place.normal, &mut stream) * (10.0 * size);
        let dir = leaving(place.normal, &mut stream).as_vec3();
        // Large enough that no ray which leaves at these cosines passes it by.
        let lid = place.corners.map(|c| aim + (c - aim) * 1e5 * gap / size + (c - aim) * 10.0);
        let lid = lid.map(|c| c + place.normal * gap);
        let start = naive_start(&place, from, aim);
        let hit = |corners: [DVec3; 3]| {
            let corners = corners.map(DVec3::as_vec3);
            start.is_some_and(|p| triangle::naive(corners, p, dir, 1e-6) > Some(GUIDE.1))
        };
        own[0] += usize::from(hit(place.corners));
        missed[0] += usize::from(!hit(lid));
        let ours = kernel_hits(&place, lid, b, dir, scale);
        own[1] += usize::from(ours[0]);
        missed[1] += usize::from(!ours[1]);
    }
    [own, missed]
}

/// Where the next ray of the naive form starts: the hit of a ray from `from`, moved off along the normal.
fn naive_start(place: &Place3, from: DVec3, aim: DVec3) -> Option<Vec3> {
    let corners = place.corners.map(DVec3::as_vec3);
    let origin = from.as_vec3();
    let dir = (aim - origin.as_dvec3()).normalize().as_vec3();
    let t = triangle::naive(corners, origin, dir, 1e-6)?;
    Some(origin + dir * t + place.normal.as_vec3() * GUIDE.0)
}

/// Whether the kernel's ray hits its own triangle, whether it hits the lid.
fn kernel_hits(place: &Place3, lid: [DVec3; 3], b: Vec2, dir: Vec3, scale: f64) -> [bool; 2] {
    let bench = Bench::new().triangles(&[
        record(0, place.corners.map(|c| c * scale)),
        record(3, lid.map(|c| c * scale)),
    ]);
    let mut kernel = bench.single();
    let (tri, shade) = (kernel.load_triangle(0), kernel.load_tri_shade(0));
    let s = kernel.triangle_flat_surface(tri, shade, b, -place.normal.as_vec3());
    let origin = kernel.ray_offset_origin(s.p, s.ng * s.ray_offset, dir);
    let ray = |prim| single::Ray { skip: skip(prim), ..kernel::ray(origin, dir) };
    let hit = kernel.trace(ray(0)).prim;
    [hit == 0, hit == 1]
}

fn rows() -> Vec<Row> {
    let n = 40_000;
    let mut rows = Vec::new();
    for distance in [1e4, 3e4, 1e5, 1e6] {
        let [own, _] = leave(distance, distance / 100.0, distance / 100.0, n);
        rows.push(row(
            format!("rays that hit what they leave, {distance} units from the origin"),
            share(own[0], n),
            share(own[1], n),
        ));
    }
    for (distance, gap) in [(1.0, 5e-4), (1.0, 1e-4), (10.0, 1e-4)] {
        let [_, missed] = leave(distance, 0.1, gap, n);
        rows.push(row(
            format!("rays that miss a surface {gap:.0e} above, {distance} units from the origin"),
            share(missed[0], n),
            share(missed[1], n),
        ));
    }
    rows
}

/// Measures the topic.
#[must_use]
pub fn topic() -> Topic {
    Topic {
        title: "Ray offsets are relative",
        places: &["shaders/wgsl/surface/surface.wgsl", "shaders/wgsl/trace/ray_offset.wgsl"],
        rows: rows(),
        fact: "A fixed offset of 1e-3 shadows itself far from the origin and jumps over what lies \
            near a surface. Here the scene has radius 1, hit points come from barycentric weights, \
            and a ray starts 16 · 2⁻²⁴ of the largest coordinate off the surface, on the side it \
            goes to, without testing the primitive it starts on.",
    }
}

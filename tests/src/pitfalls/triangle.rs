//! Rays at the edges of triangles: Möller and Trumbore with a slack (the naive form) and the kernel's
//! watertight test.

#![expect(
    clippy::cast_possible_truncation,
    reason = "the naive form and the kernel compute in f32"
)]

use glam::{DVec3, Vec3};
use runtime::kernel::f32 as single;

use super::{Row, Topic, row, share};
use crate::kernel::Bench;
use crate::statistics::stream::Stream;

/// Distance along the ray by the naive form: determinants below 1e-12 are parallel, barycentric weights may be
/// out by `slack`.
#[must_use]
pub fn naive(corners: [Vec3; 3], origin: Vec3, dir: Vec3, slack: f32) -> Option<f32> {
    let (e1, e2) = (corners[1] - corners[0], corners[2] - corners[0]);
    let h = dir.cross(e2);
    let det = e1.dot(h);
    if det.abs() < 1e-12 {
        return None;
    }
    let s = origin - corners[0];
    let b = s.dot(h) / det;
    let q = s.cross(e1);
    let c = dir.dot(q) / det;
    let inside = b >= -slack && c >= -slack && b + c <= 1.0 + slack;
    let t = e2.dot(q) / det;
    (inside && t > 0.0).then_some(t)
}

/// Six triangles around one vertex, about 1 in size, a little bent.
struct Fan {
    points: Vec<Vec3>,
}

impl Fan {
    fn new(stream: &mut Stream) -> Self {
        let center = stream.direction() * stream.between(0.0, 3.0);
        let n = stream.direction();
        let (x, y) = n.any_orthonormal_pair();
        let mut points = vec![center.as_vec3()];
        for i in 0..6 {
            let angle = (f64::from(i) + stream.between(-0.3, 0.3)) * std::f64::consts::TAU / 6.0;
            let r = stream.between(0.6, 1.4);
            let rim = x * (r * angle.cos()) + y * (r * angle.sin());
            points.push((center + rim + n * stream.between(-0.05, 0.05)).as_vec3());
        }
        Self { points }
    }

    fn faces(&self) -> impl Iterator<Item = single::Triangle> + '_ {
        (0..6).map(|i| {
            let j = 1 + (i + 1) % 6;
            let corner = |k: usize| self.points[k];
            let id = |k: usize| k as u32;
            let (v0, v1, v2) = (corner(0), corner(1 + i), corner(j));
            single::Triangle { v0, id0: id(0), v1, id1: id(1 + i), v2, id2: id(j) }
        })
    }

    /// An eye that does not see the fan edge-on.
    fn eye(&self, distance: f64, stream: &mut Stream) -> Vec3 {
        let p = |i: usize| self.points[i].as_dvec3();
        let n = (p(1) - p(3)).cross(p(5) - p(3)).normalize();
        loop {
            let d = stream.direction();
            if d.dot(n).abs() > 0.4 {
                return (p(0) + d * distance).as_vec3();
            }
        }
    }
}

/// Rays aimed at shared edges of fans, and how many hit none of the triangles, or two and more.
#[derive(Clone, Copy, Debug, Default)]
pub struct Edges {
    /// How many rays.
    pub rays: usize,
    /// Rays that slip through.
    pub cracks: usize,
    /// Rays that hit a surface twice.
    pub doubles: usize,
}

impl Edges {
    fn add(&mut self, hits: usize) {
        self.rays += 1;
        self.cracks += usize::from(hits == 0);
        self.doubles += usize::from(hits > 1);
    }
}

/// The naive form without and with its slack of 1e-6, and the kernel, from `distance` times the size of the
/// triangles.
#[must_use]
pub fn edges(distance: f64, fans: u32) -> [Edges; 3] {
    let bench = Bench::new();
    let mut kernel = bench.single();
    let mut stream = Stream::new(151, distance as u64);
    let mut counts = [Edges::default(); 3];
    for _ in 0..fans {
        let fan = Fan::new(&mut stream);
        let origin = fan.eye(distance, &mut stream);
        for k in 0..300 {
            let (a, b) = (fan.points[0].as_dvec3(), fan.points[1 + k % 6].as_dvec3());
            let aim = a + (b - a) * stream.between(0.05, 0.9);
            let dir = (aim - origin.as_dvec3()).normalize().as_vec3();
            for (count, slack) in counts.iter_mut().zip([0.0, 1e-6]) {
                let hit =
                    |t: &single::Triangle| naive([t.v0, t.v1, t.v2], origin, dir, slack).is_some();
                count.add(fan.faces().filter(hit).count());
            }
            let shear = kernel.triangle_shear(dir);
            let mut hit = |t: single::Triangle| kernel.triangle_intersect(t, origin, shear).x > 0.0;
            counts[2].add(fan.faces().map(&mut hit).filter(|hit| *hit).count());
        }
    }
    counts
}

/// How many of `n` triangles with edges of about `size`, seen from 100 sizes away, are missed by rays
/// at their middle: by the naive form, by the kernel.
#[must_use]
pub fn small(size: f64, n: usize) -> [usize; 2] {
    let bench = Bench::new();
    let mut kernel = bench.single();
    let mut stream = Stream::new(157, 0);
    let mut missed = [0; 2];
    for _ in 0..n {
        let corners = loop {
            let c = [0; 3].map(|_| stream.direction() * size);
            if (c[1] - c[0]).cross(c[2] - c[0]).length() > 0.3 * size * size {
                break c;
            }
        };
        let middle = (corners[0] + corners[1] + corners[2]) / 3.0;
        let normal = (corners[1] - corners[0]).cross(corners[2] - corners[0]).normalize();
        let way = loop {
            let d: DVec3 = stream.direction();
            if d.dot(normal).abs() > 0.1 {
                break d;
            }
        };
        let origin = (middle + way * (100.0 * size)).as_vec3();
        let dir = (middle - origin.as_dvec3()).normalize().as_vec3();
        let [v0, v1, v2] = corners.map(DVec3::as_vec3);
        missed[0] += usize::from(naive([v0, v1, v2], origin, dir, 1e-6).is_none());
        let tri = single::Triangle { v0, id0: 0, v1, id1: 1, v2, id2: 2 };
        let shear = kernel.triangle_shear(dir);
        missed[1] += usize::from(kernel.triangle_intersect(tri, origin, shear).x <= 0.0);
    }
    missed
}

fn rows() -> Vec<Row> {
    let mut rows = Vec::new();
    for distance in [1.0, 1e2, 1e4] {
        let [strict, slack, ours] = edges(distance, 1000);
        let n = ours.rays;
        let show = |e: &Edges| format!("{}, {}", share(e.cracks, n), share(e.doubles, n));
        rows.push(row(
            format!("rays at shared edges from {distance} sizes away: cracks, double hits"),
            format!("{} (without slack {})", show(&slack), show(&strict)),
            format!("{}, of {n} rays", show(&ours)),
        ));
    }
    for size in [1e-5, 1e-6, 1e-7] {
        let n = 100_000;
        let [naive, ours] = small(size, n);
        let item = format!("triangles of size {size:.0e} that are not seen");
        rows.push(row(item, share(naive, n), share(ours, n)));
    }
    rows
}

/// Measures the topic.
#[must_use]
pub fn topic() -> Topic {
    Topic {
        title: "Watertight triangles have no tolerance",
        places: &["shaders/wgsl/shape/triangle.wgsl"],
        rows: rows(),
        fact: "Möller-Trumbore with a slack of 1e-6 and a determinant cutoff of 1e-12 leaks at \
            shared edges, hits both neighbours, and loses small triangles. Edge functions in a \
            sheared frame, in the order of welded vertices, with a rule for ties, do neither. \
            (Woop, Benthin & Wald 2013, *Watertight Ray/Triangle Intersection*.)",
    }
}

//! Holes in a petal: cut by a hash of the point that a ray has computed (the naive form), or by a mask on the
//! surface (ours).

use glam::{DVec3, Vec2, Vec3};
use runtime::kernel::f32 as single;

use super::{Topic, row, share, triangle};
use crate::kernel::Bench;
use crate::statistics::stream::Stream;

/// The hash of a point that shaders of this tradition use: the fraction of a large multiple of a sine.
fn hash(p: Vec3) -> f32 {
    let x = p.dot(Vec3::new(127.1, 311.7, 74.7)).sin() * 43_758.547;
    x - x.floor()
}

/// The naive hole at a hit point.
fn naive_hole(p: Vec3) -> bool {
    hash(p * 30.0 + Vec3::new(0.3, 0.7, 0.1)) > 0.55
}

/// A mask of 64 x 64 texels with holes of a few texels, looked up between them; below one half is a hole.
fn mask_hole(kernel: &mut single::Kernel<'_>, uv: Vec2) -> bool {
    let mut texel = |x: f32, y: f32| kernel.fbm_value(Vec3::new(x * 0.4, y * 0.4, 0.5), 1, 0);
    let at = uv * 64.0 - Vec2::splat(0.5);
    let (cell, f) = (at.floor(), at - at.floor());
    let mut row = |y: f32| texel(cell.x, y) * (1.0 - f.x) + texel(cell.x + 1.0, y) * f.x;
    row(cell.y) * (1.0 - f.y) + row(cell.y + 1.0) * f.y < 0.48
}

/// What two rays to the same points of a petal find.
#[derive(Clone, Copy, Debug, Default)]
pub struct Seen {
    /// How many points.
    pub points: usize,
    /// Holes for the first ray: by hash, by mask.
    pub holes: [usize; 2],
    /// Points that are a hole for one ray and not for the other: by hash, by mask.
    pub differ: [usize; 2],
}

/// Camera rays and shadow rays to `n` points of a triangle of 5 cm, one or two metres from the origin.
#[must_use]
pub fn measure(n: usize) -> Seen {
    let bench = Bench::new();
    let mut kernel = bench.single();
    let mut stream = Stream::new(227, 0);
    let corners = [(0.0, 0.0), (0.05, 0.01), (0.02, 0.05)];
    let corners = corners.map(|(x, y)| DVec3::new(1.3 + x, 0.7 + y, -0.4 + 0.3 * x).as_vec3());
    let [v0, v1, v2] = corners;
    let tri = single::Triangle { v0, id0: 0, v1, id1: 1, v2, id2: 2 };
    let mut seen = Seen::default();
    while seen.points < n {
        let (x, y) = (stream.unit(), stream.unit());
        if x + y > 0.99 || x.min(y) < 0.01 {
            continue;
        }
        let [a, b, c] = corners.map(Vec3::as_dvec3);
        let aim = a + (b - a) * x + (c - a) * y;
        let origins = [0; 2].map(|_| {
            let d = stream.direction();
            (aim + DVec3::new(d.x, d.y, d.z.abs() + 0.2) * 2.0).as_vec3()
        });
        let found = origins.map(|origin| {
            let dir = (aim - origin.as_dvec3()).normalize().as_vec3();
            let t = triangle::naive(corners, origin, dir, 1e-6).expect("aimed well inside");
            let shear = kernel.triangle_shear(dir);
            let hit = kernel.triangle_intersect(tri, origin, shear);
            [naive_hole(origin + dir * t), mask_hole(&mut kernel, Vec2::new(hit.y, hit.z))]
        });
        seen.points += 1;
        let [first, second] = found;
        for (k, (a, b)) in first.into_iter().zip(second).enumerate() {
            seen.holes[k] += usize::from(a);
            seen.differ[k] += usize::from(a != b);
        }
    }
    seen
}

/// Measures the topic.
#[must_use]
pub fn topic() -> Topic {
    let n = 400_000;
    let seen = measure(n);
    Topic {
        title: "Holes belong to the surface, not to the ray",
        places: &["shaders/wgsl/trace/alpha.wgsl"],
        rows: vec![
            row(
                "points that a camera ray passes and a shadow ray does not, holes skipped in the path loop",
                share(seen.holes[0], n),
                share(0, n),
            ),
            row(
                "points on which two rays disagree, holes tested by each",
                share(seen.differ[0], n),
                format!("{} (rounding at the rims)", share(seen.differ[1], n)),
            ),
        ],
        fact: "A hash of the hit point gives two rays to one point different answers, and a path \
            loop that skips hits does not skip them for shadow rays. A hole is a texel of an alpha \
            texture, looked up at barycentric weights during traversal, for all rays alike.",
    }
}

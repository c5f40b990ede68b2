//! Rays through trees against rays through everything.
//!
//! The slab test is that of the kernel, in `f32`; triangles are tested in `f64`, so that a hit is a
//! hit of the real triangle and a tree that misses it is wrong.

use compiler::bvh::{self, Joined, Preset, Primitives};
use compiler::cache::Cache;
use pack::abi::ChildRef;

use crate::shapes::{Rng, Tri, ball, degenerate, grid};

struct Ray {
    o: [f32; 3],
    d: [f32; 3],
}

/// Distance along the ray to the triangle, edges included, or nothing.
fn hit_triangle(ray: &Ray, t: &Tri) -> Option<f64> {
    let [o, d] = [ray.o, ray.d].map(|v| v.map(f64::from));
    let [a, b, c] = t.map(|v| v.map(f64::from));
    let sub = |p: [f64; 3], q: [f64; 3]| [0, 1, 2].map(|k| p[k] - q[k]);
    let dot = |p: [f64; 3], q: [f64; 3]| p[0] * q[0] + p[1] * q[1] + p[2] * q[2];
    let cross = |p: [f64; 3], q: [f64; 3]| {
        [p[1] * q[2] - p[2] * q[1], p[2] * q[0] - p[0] * q[2], p[0] * q[1] - p[1] * q[0]]
    };
    let (e1, e2, s) = (sub(b, a), sub(c, a), sub(o, a));
    let h = cross(d, e2);
    let det = dot(e1, h);
    if det == 0.0 {
        return None;
    }
    let (u, q) = (dot(s, h) / det, cross(s, e1));
    let v = dot(d, q) / det;
    let t = dot(e2, q) / det;
    (u >= 0.0 && v >= 0.0 && u + v <= 1.0 && t > 0.0).then_some(t)
}

/// Nearest distance by trying everything.
fn brute(ray: &Ray, triangles: &[Tri]) -> Option<f64> {
    triangles.iter().filter_map(|t| hit_triangle(ray, t)).reduce(f64::min)
}

/// Nearest distance through the tree: nearer child first, the other one on a stack of exactly the
/// promised length. Also returns the number of triangles that were tested.
fn through_tree(ray: &Ray, tree: &Joined, triangles: &[Tri]) -> (Option<f64>, usize) {
    // As in the kernel: no direction component below 1e-18, its sign kept.
    let inv = ray.d.map(|x| 1.0 / if x.abs() < 1e-18 { 1e-18_f32.copysign(x) } else { x });
    let slab = |lo: [f32; 3], hi: [f32; 3], best: f32| {
        let (mut near, mut far) = (0.0_f32, best);
        for k in 0..3 {
            let (a, b) = ((lo[k] - ray.o[k]) * inv[k], (hi[k] - ray.o[k]) * inv[k]);
            near = near.max(a.min(b));
            far = far.min(a.max(b));
        }
        (near <= far * 1.000_002).then_some(near)
    };
    let (mut best, mut best_f32, mut tested) = (None::<f64>, f32::MAX, 0);
    let mut stack: Vec<(u32, f32)> = Vec::new();
    let mut next = Some(tree.root);
    while let Some(word) = next.take() {
        match ChildRef::decode(word) {
            ChildRef::Inner(index) => {
                let n = &tree.nodes[index as usize];
                let left = slab(n.left_lo, n.left_hi, best_f32).map(|t| (n.left, t));
                let right = slab(n.right_lo, n.right_hi, best_f32).map(|t| (n.right, t));
                next = match (left, right) {
                    (Some(l), Some(r)) => {
                        let (near, far) = if l.1 <= r.1 { (l, r) } else { (r, l) };
                        stack.push(far);
                        assert!(stack.len() <= tree.stack_need as usize);
                        Some(near.0)
                    }
                    (one, other) => one.or(other).map(|(word, _)| word),
                };
            }
            ChildRef::Triangles { first, count } => {
                for &i in &tree.triangle_order[first as usize..][..count as usize] {
                    tested += 1;
                    let t = hit_triangle(ray, &triangles[i as usize]);
                    if let Some(t) = t.filter(|&t| best.is_none_or(|b| t < b)) {
                        best = Some(t);
                        #[expect(clippy::cast_possible_truncation, reason = "a limit, padded")]
                        {
                            best_f32 = (t as f32).next_up();
                        }
                    }
                }
            }
            ChildRef::Spheres { .. } | ChildRef::Instance(_) | ChildRef::Empty => {}
        }
        while next.is_none()
            && let Some((word, near)) = stack.pop()
        {
            next = (near <= best_f32 * 1.000_002).then_some(word);
        }
    }
    (best, tested)
}

/// Every ray must find through the tree exactly what it finds without; returns the hits.
fn check(name: &str, triangles: &[Tri], sizes: &[usize], rays: &[Ray]) -> usize {
    let expected: Vec<_> = rays.iter().map(|ray| brute(ray, triangles)).collect();
    for preset in Preset::ALL {
        check_preset(&format!("{preset} {name}"), preset, (triangles, sizes), (rays, &expected));
    }
    expected.iter().flatten().count()
}

fn check_preset(
    name: &str,
    preset: Preset,
    (triangles, sizes): (&[Tri], &[usize]),
    (rays, expected): (&[Ray], &[Option<f64>]),
) {
    let primitives = Primitives {
        triangles,
        mesh_sizes: sizes,
        mesh_motions: &[],
        spheres: &[],
        sphere_motions: &[],
    };
    let (tree, _) = bvh::build_scene(&primitives, preset, &Cache::disabled()).unwrap();
    let mut tested = 0;
    for (ray, expected) in rays.iter().zip(expected) {
        let (found, n) = through_tree(ray, &tree, triangles);
        assert_eq!(found, *expected, "{name}: from {:?} along {:?}", ray.o, ray.d);
        tested += n;
    }
    // The tree must be of use, too.
    assert!(tested < rays.len() * triangles.len().max(16) / 2, "{name}: {tested} tests");
}

fn random_rays(n: usize, size: f32) -> Vec<Ray> {
    let mut rng = Rng::new(3);
    (0..n).map(|_| Ray { o: rng.point(size), d: rng.point(1.0) }).collect()
}

fn normalised(kind: &str, n: u32) -> Vec<Tri> {
    let triangles = degenerate(kind, n);
    let points = triangles.iter().flatten().map(|p| p.map(f64::from));
    let frame = compiler::normalize::Normalization::of_points(points);
    triangles.iter().map(|t| t.map(|p| frame.point(p.map(f64::from)))).collect()
}

#[test]
fn random_rays_find_the_same_triangle_at_the_same_distance() {
    let soup = degenerate("soup", 3000);
    let hits = check("soup", &soup, &[3000], &random_rays(20_000, 1.0));
    assert!(hits > 2000, "{hits} hits");
    for kind in ["nested", "flat", "far", "fan", "slivers", "same", "long"] {
        check(kind, &normalised(kind, 1000), &[1000], &random_rays(3000, 1.0));
    }
}

/// Rays at the edges and corners of long triangles, along them, and along axes through them: where pieces
/// meet, boxes are tight.
#[test]
fn rays_aimed_at_long_triangles_find_the_same() {
    let triangles = normalised("long", 1500);
    let mut rng = Rng::new(17);
    let mut rays = Vec::new();
    for t in &triangles {
        let along = [0, 1, 2].map(|k| t[1][k] - t[0][k]);
        for _ in 0..16 {
            let s = [0.0, 1.0, 0.5, rng.unit()][rng.next() as usize % 4];
            let target = [0, 1, 2].map(|k| t[0][k] + s * along[k]);
            let o = match rng.next() % 3 {
                0 => [0, 1, 2].map(|k| target[k] - 1.5 * along[k]),
                1 => {
                    let (mut o, axis) = (target, rng.next() as usize % 3);
                    o[axis] = -2.0;
                    o
                }
                _ => rng.point(2.0),
            };
            rays.push(Ray { o, d: [0, 1, 2].map(|k| target[k] - o[k]) });
        }
    }
    let hits = check("long", &triangles, &[triangles.len()], &rays);
    assert!(hits > rays.len() / 3, "{hits} of {}", rays.len());
}

#[test]
fn groups_find_the_same_as_one_tree() {
    let soup = degenerate("soup", 3000);
    let mut sizes = vec![1000, 0, 500, 500];
    sizes.extend([10; 50]);
    sizes.push(500);
    check("groups", &soup, &sizes, &random_rays(10_000, 1.0));
}

#[test]
fn rays_along_axes_through_vertices_find_the_same() {
    let mut triangles = ball(24, 0.75);
    triangles.extend(grid(16, 0.0).iter().map(|t| t.map(|p| p.map(|x| x - 0.5))));
    let mut rays = Vec::new();
    for vertex in triangles.iter().flatten() {
        for axis in 0..3 {
            for sign in [-1.0, 1.0] {
                // Both zeros occur as components of directions.
                let mut d = [0.0 * sign; 3];
                d[axis] = sign;
                let mut o = *vertex;
                o[axis] = -2.0 * sign;
                rays.push(Ray { o, d });
            }
        }
    }
    rays.truncate(10_000);
    let hits = check("axes", &triangles, &[triangles.len()], &rays);
    assert!(hits > rays.len() / 2, "{hits} of {}", rays.len());
}

#[test]
fn axis_parallel_rays_on_a_grid_hit_every_vertex_and_edge() {
    let triangles = grid(8, 0.25);
    let mut rays = Vec::new();
    for i in 0..=16_u8 {
        for j in 0..=16_u8 {
            let o = [f32::from(i) / 16.0, f32::from(j) / 16.0, -1.0];
            rays.push(Ray { o, d: [0.0, 0.0, 1.0] });
            rays.push(Ray { o, d: [-0.0, -0.0, 1.0] });
        }
    }
    assert_eq!(check("grid", &triangles, &[triangles.len()], &rays), rays.len());
}

#[test]
fn rays_aimed_at_edges_and_vertices_find_the_same() {
    let triangles = ball(24, 0.75);
    let mut rng = Rng::new(11);
    let mut rays = Vec::new();
    for t in &triangles {
        for _ in 0..8 {
            let (o, s) = (rng.point(2.0), [0.0, 1.0, rng.unit()][rng.next() as usize % 3]);
            let target = [0, 1, 2].map(|k| t[0][k] + s * (t[1][k] - t[0][k]));
            rays.push(Ray { o, d: [0, 1, 2].map(|k| target[k] - o[k]) });
        }
    }
    check("edges", &triangles, &[triangles.len()], &rays);
}

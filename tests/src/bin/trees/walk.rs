//! One walk for all trees, ours and others': what a ray costs, counted.

use glam::Vec3;
use pack::abi::WIDTH;
use tests::embree;

use crate::scene::{Rng, Tri, View, basis};

/// A child: its box and where it leads.
#[derive(Clone, Copy)]
pub(crate) struct Child {
    pub(crate) lo: Vec3,
    pub(crate) hi: Vec3,
    pub(crate) to: To,
}

/// Where a child leads.
#[derive(Clone, Copy)]
pub(crate) enum To {
    Inner(u32),
    Leaf {
        first: u32,
        count: u32,
    },
    /// There is no such child, and none behind it.
    Nowhere,
}

/// The children of a node.
pub(crate) type Children = [Child; WIDTH];

impl Child {
    pub(crate) const NONE: Self = Self { lo: Vec3::ZERO, hi: Vec3::ZERO, to: To::Nowhere };
}

/// Two children.
pub(crate) fn pair([left, right]: [Child; 2]) -> Children {
    [left, right, Child::NONE, Child::NONE]
}

/// Those that are there.
fn there(children: &Children) -> impl Iterator<Item = &Child> {
    children.iter().take_while(|child| !matches!(child.to, To::Nowhere))
}

/// A tree: children, the first of which are the root's, and triangles in leaf order.
pub(crate) struct Walked {
    pub(crate) nodes: Vec<Children>,
    pub(crate) order: Vec<u32>,
}

pub(crate) struct Ray {
    pub(crate) origin: Vec3,
    pub(crate) dir: Vec3,
}

impl Ray {
    /// The same, as Embree is asked.
    pub(crate) fn asked(&self) -> embree::Ray {
        embree::Ray::nearest(self.origin.to_array(), self.dir.to_array())
    }
}

/// What rays cost together.
#[derive(Clone, Copy, Default)]
pub(crate) struct Cost {
    pub(crate) steps: u64,
    pub(crate) tests: u64,
    pub(crate) hits: u64,
}

/// What a tree is like.
#[derive(Clone, Copy, Default)]
pub(crate) struct Shape {
    /// By the surface-area heuristic, a step and a test 1, in units of the root's area.
    pub(crate) cost: f64,
    pub(crate) largest_leaf: u32,
    pub(crate) depth: u32,
}

fn half_area(lo: Vec3, hi: Vec3) -> f64 {
    let [x, y, z] = (hi - lo).to_array().map(f64::from);
    x * y + y * z + z * x
}

impl Walked {
    pub(crate) fn shape(&self) -> Shape {
        let mut shape = Shape::default();
        let ends = there(&self.nodes[0])
            .fold((Vec3::MAX, Vec3::MIN), |(lo, hi), child| (lo.min(child.lo), hi.max(child.hi)));
        let root = half_area(ends.0, ends.1);
        let mut stack = vec![(0_u32, 1)];
        while let Some((node, depth)) = stack.pop() {
            shape.depth = shape.depth.max(depth);
            for child in there(&self.nodes[node as usize]) {
                let tests = match child.to {
                    To::Inner(node) => {
                        stack.push((node, depth + 1));
                        1
                    }
                    To::Leaf { count, .. } => {
                        shape.largest_leaf = shape.largest_leaf.max(count);
                        count
                    }
                    To::Nowhere => 0,
                };
                shape.cost += half_area(child.lo, child.hi) / root * f64::from(tests);
            }
        }
        shape.cost += 1.0;
        shape
    }

    /// Distance to the nearest triangle along `ray`, which one, and what it took.
    fn nearest(&self, ray: &Ray, triangles: &[Tri], cost: &mut Cost) -> Option<(f32, u32)> {
        let tiny = |x: f32| if x.abs() < 1e-18 { 1e-18_f32.copysign(x) } else { x };
        let inverse = Vec3::from_array(ray.dir.to_array().map(|x| 1.0 / tiny(x)));
        let enter = |c: &Child, best: f32| {
            let (a, b) = ((c.lo - ray.origin) * inverse, (c.hi - ray.origin) * inverse);
            let near = a.min(b).max_element().max(0.0);
            let far = a.max(b).min_element().min(best) * 1.000_001;
            if near <= far { near } else { f32::INFINITY }
        };
        let mut best = (f32::MAX, u32::MAX);
        let (mut stack, mut next) = (Vec::new(), Some(To::Inner(0)));
        while let Some(to) = next.take() {
            match to {
                To::Inner(node) => {
                    cost.steps += 1;
                    let from = stack.len();
                    let entered = there(&self.nodes[node as usize])
                        .map(|child| (enter(child, best.0), child.to))
                        .filter(|(at, _)| *at < f32::INFINITY);
                    stack.extend(entered);
                    // Of equal distances the left child is next.
                    stack[from..].reverse();
                    stack[from..].sort_by(|a, b| b.0.total_cmp(&a.0));
                }
                To::Nowhere => {}
                To::Leaf { first, count } => {
                    for &i in &self.order[first as usize..][..count as usize] {
                        cost.tests += 1;
                        let t = distance(ray, &triangles[i as usize]);
                        if t.is_some_and(|t| t < best.0) {
                            best = (t.unwrap_or(best.0), i);
                        }
                    }
                }
            }
            while let Some((at, to)) = stack.pop() {
                if at <= best.0 {
                    next = Some(to);
                    break;
                }
            }
        }
        cost.hits += u64::from(best.1 != u32::MAX);
        (best.1 != u32::MAX).then_some(best)
    }

    /// What all rays cost.
    pub(crate) fn cost(&self, rays: &[Ray], triangles: &[Tri]) -> Cost {
        let mut cost = Cost::default();
        for ray in rays {
            self.nearest(ray, triangles, &mut cost);
        }
        cost
    }

    /// Incoherent rays from inside the scene: cosine-distributed directions at what four cameras see.
    pub(crate) fn rays(&self, triangles: &[Tri], views: &[View; 4]) -> Vec<Ray> {
        let mut rng = Rng::new(99);
        let mut rays = Vec::new();
        for [origin, aim] in *views {
            let (origin, aim) = (Vec3::from_array(origin), Vec3::from_array(aim));
            let forward = (aim - origin).normalize();
            let [u, v] = basis(forward);
            for _ in 0..60_000 {
                let (x, y) = (2.0 * rng.unit() - 1.0, 1.25 * rng.unit() - 0.625);
                let ray = Ray { origin, dir: (forward + u * x + v * y).normalize() };
                let Some((t, i)) = self.nearest(&ray, triangles, &mut Cost::default()) else {
                    continue;
                };
                let [a, b, c] = triangles[i as usize].map(Vec3::from_array);
                let n = (b - a).cross(c - a).normalize_or(Vec3::Y);
                let n = if n.dot(ray.dir) > 0.0 { -n } else { n };
                let [s, q] = basis(n);
                let (r2, phi) = (rng.unit(), rng.unit() * std::f32::consts::TAU);
                let r = r2.sqrt();
                let dir =
                    s * (r * libm::cosf(phi)) + q * (r * libm::sinf(phi)) + n * (1.0 - r2).sqrt();
                rays.push(Ray {
                    origin: ray.origin + ray.dir * t + n * 1e-3,
                    dir: dir.normalize(),
                });
            }
        }
        rays
    }
}

/// Möller and Trumbore 1997.
fn distance(ray: &Ray, triangle: &Tri) -> Option<f32> {
    let [a, b, c] = triangle.map(Vec3::from_array);
    let (e1, e2, s) = (b - a, c - a, ray.origin - a);
    let h = ray.dir.cross(e2);
    let f = 1.0 / e1.dot(h);
    let q = s.cross(e1);
    let (u, v, t) = (f * s.dot(h), f * ray.dir.dot(q), f * e2.dot(q));
    (u >= 0.0 && v >= 0.0 && u + v <= 1.0 && t > 0.0).then_some(t)
}

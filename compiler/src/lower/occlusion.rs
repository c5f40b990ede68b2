//! Rays through the lowered world: what is hit first, and whether two points see each other.
//!
//! For questions whose answers only steer sampling: it knows where surfaces are and which of them are opaque, and
//! nothing of textures, holes, refraction or motion. Normalised world frame, distances in lengths of the direction.

use glam::DVec3;
use pack::abi::{self, ChildRef, NONE};

use super::world::Sections;

/// A surface on a ray.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Hit {
    pub(super) t: f64,
    /// Unit, against the ray.
    pub(super) normal: DVec3,
    /// Light neither goes through it nor through holes in it.
    pub(super) opaque: bool,
}

/// The world, and which materials are opaque.
pub(super) struct Occluders<'a> {
    sections: &'a Sections,
    opaque: &'a [bool],
}

/// A ray in the frame in which it is traced.
#[derive(Clone, Copy)]
struct Ray {
    origin: DVec3,
    dir: DVec3,
    inverse: DVec3,
    t_min: f64,
    /// The instance whose frame this is.
    instance: Option<usize>,
}

impl<'a> Occluders<'a> {
    pub(super) fn new(sections: &'a Sections, opaque: &'a [bool]) -> Self {
        Self { sections, opaque }
    }

    /// The nearest surface along `dir` in `t_min .. t_max`.
    pub(super) fn nearest(
        &self,
        origin: DVec3,
        dir: DVec3,
        [t_min, t_max]: [f64; 2],
    ) -> Option<Hit> {
        let mut best = None;
        let mut end = t_max;
        self.walk(
            origin,
            dir,
            t_min,
            &mut |hit| {
                if hit.t < end {
                    end = hit.t;
                    best = Some(hit);
                }
                Some(end)
            },
            t_max,
        );
        best
    }

    /// Whether nothing opaque is between two points; the last 2^-20 of the way at both ends do not count.
    pub(super) fn sees(&self, from: DVec3, to: DVec3) -> bool {
        let mut free = true;
        let rim = 1.0 / 1_048_576.0;
        let t_max = 1.0 - rim;
        self.walk(
            from,
            to - from,
            rim,
            &mut |hit| {
                free &= !hit.opaque || hit.t >= t_max;
                free.then_some(t_max)
            },
            t_max,
        );
        free
    }

    /// Tells `found` of surfaces in `t_min .. t_max`, near ones roughly first. It answers how far to look on, or `None`
    /// for no further.
    fn walk(
        &self,
        origin: DVec3,
        dir: DVec3,
        t_min: f64,
        found: &mut dyn FnMut(Hit) -> Option<f64>,
        t_max: f64,
    ) {
        let world = Ray { origin, dir, inverse: dir.recip(), t_min, instance: None };
        let mut stack = vec![(self.sections.entry.0, None)];
        let mut end = t_max;
        while let Some((word, instance)) = stack.pop() {
            let ray = instance.map_or(world, |i| self.inside(world, i));
            let mut tell = |hit: Option<Hit>| match hit.filter(|hit| hit.t > t_min && hit.t < end) {
                Some(hit) => found(hit).map(|next| end = next).is_some(),
                None => true,
            };
            let goes_on = match ChildRef::decode(word) {
                ChildRef::Empty => true,
                ChildRef::Inner(node) => {
                    self.children(node as usize, &ray, end, |child| stack.push((child, instance)));
                    true
                }
                ChildRef::Instance(i) => {
                    let i = i as usize;
                    stack.push((self.sections.instances[i].root, Some(i)));
                    true
                }
                ChildRef::Triangles { first, count } => {
                    (first..first + count).all(|i| tell(self.triangle(i as usize, &ray, dir)))
                }
                ChildRef::Spheres { first, count } => {
                    (first..first + count).all(|i| tell(self.sphere(i as usize, &ray)))
                }
            };
            if !goes_on {
                return;
            }
        }
    }

    /// `ray` in the frame of instance `i`.
    fn inside(&self, ray: Ray, i: usize) -> Ray {
        let record = &self.sections.instances[i];
        let rows = [record.row_x, record.row_y, record.row_z].map(vector);
        let turn = |v: DVec3| DVec3::from(rows.map(|row| row.dot(v)));
        let dir = turn(ray.dir);
        let origin = turn(ray.origin - vector(record.center));
        Ray { origin, dir, inverse: dir.recip(), instance: Some(i), ..ray }
    }

    /// The children of a node that `ray` may hit before `end`, the nearest last.
    fn children(&self, node: usize, ray: &Ray, end: f64, mut push: impl FnMut(u32)) {
        let mut near: [(f64, u32); abi::WIDTH] = [(0.0, NONE); abi::WIDTH];
        let mut n = 0;
        let mut add = |word: u32, [lo, hi]: [[f32; 3]; 2]| {
            if let Some(t) = enters(ray, vector(lo), vector(hi), end) {
                near[n] = (t, word);
                n += 1;
            }
        };
        if let Some(wide) = self.sections.wide_nodes.get(node) {
            for (slot, word) in wide.words().into_iter().enumerate().filter(|(_, w)| *w != NONE) {
                add(word, wide.corners(slot));
            }
        } else if let Some(node) = self.sections.nodes.get(node) {
            add(node.left, [node.left_lo, node.left_hi]);
            add(node.right, [node.right_lo, node.right_hi]);
        }
        let near = &mut near[..n];
        near.sort_by(|a, b| b.0.total_cmp(&a.0));
        for (_, word) in near {
            push(*word);
        }
    }

    /// Where `ray` meets triangle `i`; `dir` is its direction in the world.
    fn triangle(&self, i: usize, ray: &Ray, dir: DVec3) -> Option<Hit> {
        let triangle = &self.sections.triangles[i];
        let [a, b, c] = [triangle.v0, triangle.v1, triangle.v2].map(vector);
        let (ab, ac) = (b - a, c - a);
        // Moeller & Trumbore 1997.
        let p = ray.dir.cross(ac);
        let det = ab.dot(p);
        let from = ray.origin - a;
        let q = from.cross(ab);
        let (u, v) = (from.dot(p) / det, ray.dir.dot(q) / det);
        if det == 0.0 || u < 0.0 || v < 0.0 || u + v > 1.0 {
            return None;
        }
        let shade = &self.sections.shades[i];
        let mut normal = ab.cross(ac);
        let mut material = shade.material;
        if let Some(record) = ray.instance.map(|i| &self.sections.instances[i]) {
            normal = vector(record.row_x) * normal.x
                + vector(record.row_y) * normal.y
                + vector(record.row_z) * normal.z;
            material = if record.material == NONE { material } else { record.material };
        }
        let normal = normal.try_normalize()?;
        let normal = if normal.dot(dir) > 0.0 { -normal } else { normal };
        Some(Hit { t: ac.dot(q) / det, normal, opaque: self.opaque[material as usize] })
    }

    /// Where `ray` meets sphere `i` first behind its start.
    fn sphere(&self, i: usize, ray: &Ray) -> Option<Hit> {
        let sphere = &self.sections.spheres[i];
        let (center, radius) = (vector(sphere.center), f64::from(sphere.radius));
        let d2 = ray.dir.length_squared();
        let middle = (center - ray.origin).dot(ray.dir) / d2;
        let off = (ray.origin + ray.dir * middle - center).length_squared();
        let half = ((radius * radius - off) / d2).max(0.0).sqrt();
        let t = if middle - half > ray.t_min { middle - half } else { middle + half };
        let normal = (ray.origin + ray.dir * t - center).try_normalize()?;
        let normal = if normal.dot(ray.dir) > 0.0 { -normal } else { normal };
        let opaque = self.opaque[sphere.material as usize];
        (off <= radius * radius).then_some(Hit { t, normal, opaque })
    }
}

fn vector(v: [f32; 3]) -> DVec3 {
    DVec3::from(v.map(f64::from))
}

/// Where `ray` enters a box, if it does before `end`.
fn enters(ray: &Ray, lo: DVec3, hi: DVec3, end: f64) -> Option<f64> {
    let (a, b) = ((lo - ray.origin) * ray.inverse, (hi - ray.origin) * ray.inverse);
    // `min` and `max` of numbers leave out what is none: 0 times infinity, in the plane of a side.
    let near = a.min(b).to_array().into_iter().fold(ray.t_min, f64::max);
    let far = a.max(b).to_array().into_iter().fold(end, f64::min);
    (near <= far * (1.0 + 1e-12)).then_some(near)
}

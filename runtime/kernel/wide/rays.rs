//! Rays that are walked one by one, and what they hit.
//!
//! Turns lanes into numbers in memory, from which a walk takes those of its ray, and back. What is worked out once for
//! each walk is worked out for all lanes together before.

use crate::kernel::{Hit, Ray, TriangleShear, v};
use crate::target;
use glam::{UVec2, Vec2, Vec3};
use kernel_f32::kernel as scalar;

/// The walk of a ray a lane.
pub(crate) struct Walks {
    origin: [[f32; v::LANES]; 3],
    dir: [[f32; v::LANES]; 3],
    range: [[f32; v::LANES]; 2],
    time: [f32; v::LANES],
    ids: [[u32; v::LANES]; 6],
    key: [[u32; v::LANES]; 4],
    inverse: [[f32; v::LANES]; 3],
    slope: [[f32; v::LANES]; 2],
    inv_depth: [f32; v::LANES],
    axis: [u32; v::LANES],
}

impl Walks {
    /// Of rays, with what `box_inverse` and `triangle_shear` make of their directions.
    #[target]
    pub(crate) fn new(ray: &Ray, inverse: v::V3<v::F>, shear: TriangleShear) -> Self {
        let three = |a: v::V3<v::F>| [v::f_to(a.x), v::f_to(a.y), v::f_to(a.z)];
        let [skip, last] = [ray.skip, ray.last];
        let key = ray.key;
        let ids = [skip.x, skip.y, last.x, last.y, ray.light, ray.instance];
        let [a, b, c, d, e, f] = ids;
        Self {
            origin: three(ray.origin),
            dir: three(ray.dir),
            range: [v::f_to(ray.t_min), v::f_to(ray.t_max)],
            time: v::f_to(ray.time),
            ids: [v::u_to(a), v::u_to(b), v::u_to(c), v::u_to(d), v::u_to(e), v::u_to(f)],
            key: [v::u_to(key.pixel), v::u_to(key.sample), v::u_to(key.bounce), v::u_to(key.seed)],
            inverse: three(inverse),
            slope: [v::f_to(shear.slope.x), v::f_to(shear.slope.y)],
            inv_depth: v::f_to(shear.inv_depth),
            axis: v::u_to(shear.axis),
        }
    }

    /// The walk of lane `k`, as `walk_begin` begins it.
    #[inline]
    pub(crate) fn lane(&self, k: usize) -> scalar::Walk {
        let k = k % v::LANES;
        // Read where they are: a copy of the rows would cost more than the walk's first node.
        let three = |a: &[[f32; v::LANES]; 3]| Vec3::new(a[0][k], a[1][k], a[2][k]);
        let id = |i: usize| self.ids[i][k];
        let ray = scalar::Ray {
            origin: three(&self.origin),
            t_min: self.range[0][k],
            t_max: self.range[1][k],
            dir: three(&self.dir),
            skip: UVec2::new(id(0), id(1)),
            last: UVec2::new(id(2), id(3)),
            light: id(4),
            time: self.time[k],
            instance: id(5),
            key: scalar::SampleKey {
                pixel: self.key[0][k],
                sample: self.key[1][k],
                bounce: self.key[2][k],
                seed: self.key[3][k],
            },
        };
        let leaf = scalar::TriangleShear {
            slope: Vec2::new(self.slope[0][k], self.slope[1][k]),
            inv_depth: self.inv_depth[k],
            axis: self.axis[k],
        };
        scalar::Walk { ray, inverse: three(&self.inverse), leaf }
    }
}

/// A hit a lane.
pub(crate) struct Hits {
    t: [f32; v::LANES],
    prim: [u32; v::LANES],
    b: [[f32; v::LANES]; 2],
    instance: [u32; v::LANES],
}

impl Hits {
    #[target]
    pub(crate) fn of(hit: &Hit) -> Self {
        let (prim, instance) = (v::u_to(hit.prim), v::u_to(hit.instance));
        Self { t: v::f_to(hit.t), prim, b: [v::f_to(hit.b.x), v::f_to(hit.b.y)], instance }
    }

    /// That of lane `k`.
    #[inline]
    pub(crate) fn lane(&self, k: usize) -> scalar::Hit {
        let k = k % v::LANES;
        let b = Vec2::new(self.b[0][k], self.b[1][k]);
        scalar::Hit { t: self.t[k], prim: self.prim[k], b, instance: self.instance[k] }
    }

    /// Replaces that of lane `k`.
    #[inline]
    pub(crate) fn set(&mut self, k: usize, hit: &scalar::Hit) {
        let k = k % v::LANES;
        (self.t[k], self.prim[k], self.instance[k]) = (hit.t, hit.prim, hit.instance);
        (self.b[0][k], self.b[1][k]) = (hit.b.x, hit.b.y);
    }

    /// Those of all lanes.
    #[target]
    pub(crate) fn all(&self) -> Hit {
        let b = v::V2 { x: v::f_of(self.b[0]), y: v::f_of(self.b[1]) };
        let (prim, instance) = (v::u_of(self.prim), v::u_of(self.instance));
        Hit { t: v::f_of(self.t), prim, b, instance }
    }
}

//! Rays that are walked one by one, and what they hit.
//!
//! Turns lanes into numbers in memory, from which a walk takes those of its ray, and back. What is worked out once for
//! each walk is worked out for all lanes together before.

use crate::kernel::{Hit, Ray, TriangleShear, v};
use crate::target;
use glam::{UVec2, Vec2, Vec3};
use kernel_f32::kernel as scalar;

/// Four words of each lane beside each other, as a walk reads them.
type Rows = [[[u32; 4]; v::LANES / 4]; 4];

/// The walk of a ray a lane.
pub(crate) struct Walks {
    /// `Ray::origin` and `Ray::t_min`.
    origin: Rows,
    /// `Ray::dir` and `Ray::t_max`.
    dir: Rows,
    /// `Ray::skip` and `Ray::last`.
    skip: Rows,
    /// `Ray::light`, `Ray::instance`, `Ray::time` and `TriangleShear::axis`.
    light: Rows,
    /// `Ray::key`.
    key: Rows,
    /// `Walk::inverse` and `TriangleShear::inv_depth`.
    inverse: Rows,
    /// `TriangleShear::slope`, and two words that nobody reads.
    slope: Rows,
}

impl Walks {
    /// Of rays, with what `box_inverse` and `triangle_shear` make of their directions.
    #[target]
    pub(crate) fn new(ray: &Ray, inverse: v::V3<v::F>, shear: TriangleShear) -> Self {
        let floats = |[x, y, z, w]: [v::F; 4]| {
            let (x, y, z, w) = (v::u_bits_f(x), v::u_bits_f(y), v::u_bits_f(z), v::u_bits_f(w));
            v::rows(v::V4 { x, y, z, w })
        };
        let words = |[x, y, z, w]: [v::U; 4]| v::rows(v::V4 { x, y, z, w });
        let Ray { origin, dir, skip, last, key, .. } = ray;
        let slope = shear.slope;
        Self {
            origin: floats([origin.x, origin.y, origin.z, ray.t_min]),
            dir: floats([dir.x, dir.y, dir.z, ray.t_max]),
            skip: words([skip.x, skip.y, last.x, last.y]),
            light: words([ray.light, ray.instance, v::u_bits_f(ray.time), shear.axis]),
            key: words([key.pixel, key.sample, key.bounce, key.seed]),
            inverse: floats([inverse.x, inverse.y, inverse.z, shear.inv_depth]),
            slope: floats([slope.x, slope.y, slope.x, slope.y]),
        }
    }

    /// The walk of lane `k`, as `walk_begin` begins it.
    #[inline]
    pub(crate) fn lane(&self, k: usize) -> scalar::Walk {
        let k = k % v::LANES;
        let words = |rows: &Rows| rows[k % 4][k / 4];
        let floats = |rows: &Rows| words(rows).map(f32::from_bits);
        let [x, y, z, t_min] = floats(&self.origin);
        let [dir_x, dir_y, dir_z, t_max] = floats(&self.dir);
        let [skip, skip_instance, last, last_instance] = words(&self.skip);
        let [light, instance, time, axis] = words(&self.light);
        let [pixel, sample, bounce, seed] = words(&self.key);
        let [inv_x, inv_y, inv_z, inv_depth] = floats(&self.inverse);
        let [slope_x, slope_y, ..] = floats(&self.slope);
        let ray = scalar::Ray {
            origin: Vec3::new(x, y, z),
            t_min,
            t_max,
            dir: Vec3::new(dir_x, dir_y, dir_z),
            skip: UVec2::new(skip, skip_instance),
            last: UVec2::new(last, last_instance),
            light,
            time: f32::from_bits(time),
            instance,
            key: scalar::SampleKey { pixel, sample, bounce, seed },
        };
        let leaf = scalar::TriangleShear { slope: Vec2::new(slope_x, slope_y), inv_depth, axis };
        scalar::Walk { ray, inverse: Vec3::new(inv_x, inv_y, inv_z), leaf }
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

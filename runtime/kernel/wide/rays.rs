//! Rays that are to be walked one by one.

use crate::kernel::{self, v};
use crate::target;
use kernel_f32::kernel as scalar;

/// A ray a lane in memory, number by number.
pub(crate) struct Rays {
    origin: [[f32; v::LANES]; 3],
    dir: [[f32; v::LANES]; 3],
    range: [[f32; v::LANES]; 2],
    time: [f32; v::LANES],
    ids: [[u32; v::LANES]; 6],
    key: [[u32; v::LANES]; 4],
}

impl Rays {
    #[target]
    pub(crate) fn of(ray: &kernel::Ray) -> Self {
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
            key: [v::u_to(key.pixel), v::u_to(key.sample), v::u_to(key.bounce), v::u_to(key.seed)],
            ids: [v::u_to(a), v::u_to(b), v::u_to(c), v::u_to(d), v::u_to(e), v::u_to(f)],
        }
    }

    #[inline]
    pub(crate) fn lane(&self, k: usize) -> scalar::Ray {
        let k = k % v::LANES;
        let three = |a: &[[f32; v::LANES]; 3]| glam::Vec3::new(a[0][k], a[1][k], a[2][k]);
        let id = |i: usize| self.ids[i][k];
        scalar::Ray {
            origin: three(&self.origin),
            t_min: self.range[0][k],
            t_max: self.range[1][k],
            dir: three(&self.dir),
            skip: glam::UVec2::new(id(0), id(1)),
            last: glam::UVec2::new(id(2), id(3)),
            light: id(4),
            time: self.time[k],
            instance: id(5),
            key: scalar::SampleKey {
                pixel: self.key[0][k],
                sample: self.key[1][k],
                bounce: self.key[2][k],
                seed: self.key[3][k],
            },
        }
    }
}

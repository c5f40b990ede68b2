//! The transmissive surfaces on the way of a shadow ray.
//!
//! Turns one walk into the answers to several questions: a shadow ray that goes through a surface is traced again, from
//! its own start, for what lies behind (`kernel/shadow_ray.wgsl`). The first walk has met that already, and it is kept
//! here, in the order of `trace/order.wgsl`. It does not know what the surfaces let through.

use crate::kernel::{Hit, Kernel, NONE, PRIM_SPHERE, Ray};
use std::cmp::Ordering;

/// Surfaces of one ray that are kept.
const ROOM: usize = 8;

/// The nearest surfaces that a shadow ray met, none of which hides its light.
#[derive(Clone, Debug, Default)]
pub(super) struct Crossings {
    /// The ray, whatever it had come through.
    ray: Ray,
    hits: [Hit; ROOM],
    n: usize,
    /// How many of them have been told.
    told: usize,
    /// There may be more behind the last one.
    more: bool,
}

impl Crossings {
    /// For the next walk.
    pub(super) fn clear(&mut self) {
        (self.n, self.told, self.more) = (0, 0, false);
    }

    /// Keeps a hit, unless farther than all of a full list. As far as the distance that this gives, which is `t_max`
    /// where nothing was left out, none is missing.
    pub(super) fn add(&mut self, kernel: &mut Kernel<'_>, hit: Hit, t_max: f32) -> f32 {
        let mut at = self.n;
        while let Some(other) = at.checked_sub(1).and_then(|before| self.hits.get_mut(before)) {
            match order(kernel, &hit, other) {
                Ordering::Less => at -= 1,
                Ordering::Equal => {
                    // Another place of the same triangle; the first counts.
                    other.prim = other.prim.min(hit.prim);
                    return t_max;
                }
                Ordering::Greater => break,
            }
        }
        self.more |= self.n == ROOM;
        self.n = ROOM.min(self.n + 1);
        if let Some(behind @ [_, ..]) = self.hits.get_mut(at..self.n) {
            behind.rotate_right(1);
            behind[0] = hit;
        }
        if self.more { self.hits[self.n - 1].t } else { t_max }
    }

    /// The same for a hit behind which others may have been left out.
    pub(super) fn add_last(&mut self, kernel: &mut Kernel<'_>, hit: Hit, t_max: f32) -> f32 {
        self.add(kernel, hit, t_max);
        self.more = true;
        // What lies behind it may have been met, and is met again.
        while self.n > 1 && order(kernel, &hit, &self.hits[self.n - 1]) == Ordering::Less {
            self.n -= 1;
        }
        hit.t.min(t_max)
    }

    /// The first surface that `ray` has met, or else `miss`.
    pub(super) fn first(&mut self, ray: Ray, miss: Hit) -> Hit {
        if self.n == 0 {
            return miss;
        }
        (self.ray, self.told) = (ray, 1);
        self.hits[0]
    }

    /// What `ray` meets next, if it is the same ray behind the last surface that was told, and that is known.
    pub(super) fn next(&mut self, ray: &Ray) -> Option<Hit> {
        let last = self.told.checked_sub(1).and_then(|told| self.hits.get(told))?;
        let known = self.told < self.n || !self.more;
        let whole = Ray { t_min: self.ray.t_min, last: self.ray.last, ..*ray };
        if !known
            || ray.t_min.to_bits() != last.t.to_bits()
            || ray.last.to_array() != [last.prim, last.instance]
            || whole != self.ray
        {
            return None;
        }
        if self.told == self.n {
            return Some(Hit { t: ray.t_max, prim: NONE, instance: NONE, ..Hit::ZERO });
        }
        self.told += 1;
        self.hits.get(self.told - 1).copied()
    }
}

/// Which of two hits of a ray comes first; equal: the same triangle, in two of its places.
fn order(kernel: &mut Kernel<'_>, a: &Hit, b: &Hit) -> Ordering {
    let by_distance = a.t.total_cmp(&b.t);
    if by_distance != Ordering::Equal {
        return by_distance;
    }
    let before = if a.prim & PRIM_SPHERE != 0 {
        if a.prim == b.prim {
            return Ordering::Equal;
        }
        kernel.order_sphere(*b, a.t, a.prim)
    } else {
        if a.instance == b.instance && kernel.order_same(a.prim, b.prim) {
            return Ordering::Equal;
        }
        kernel.order_triangle(*b, a.t, a.prim, a.instance)
    };
    if before { Ordering::Less } else { Ordering::Greater }
}

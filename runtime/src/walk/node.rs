//! A wide node: which of four boxes a ray meets, nearest first.
//!
//! The operations are those of `trace/wide.wgsl`, where it says why no box is ever smaller than it is. The
//! order of equally near children is the same, too: the number of rays that go on behind what they hit
//! depends on it.

use crate::kernel::f32::{NONE, Ray};
use glam::{UVec4, Vec3};
use wide::{f32x4, i32x4};

/// By how much the far end of a box grows; see `box_enter`.
pub(super) const FAR_END: f32 = 1.000_001;
/// 2^-21, eight roundings.
const SLACK: f32 = 4.768_371_6e-7;

/// What is worked out once a ray.
pub(super) struct Walker<'a> {
    nodes: &'a [UVec4],
    origin: f32x4,
    inverse: f32x4,
    /// For each axis 1 if the ray runs against it, so that it meets upper ends first.
    back: [usize; 3],
}

/// Bits of a distance that are kept in a key.
const DISTANCE: u32 = 0x7fff_fffc;

/// A child whose box the ray meets.
#[derive(Clone, Copy)]
pub(super) struct Met {
    /// Bits of the distance at which the ray enters the box, then two of the place in the node.
    key: u32,
    /// Its reference.
    pub(super) child: u32,
}

impl Met {
    /// Bits of a distance before which the ray does not enter the box.
    #[inline]
    pub(super) fn distance(self) -> u32 {
        self.key & DISTANCE
    }
}

/// Numbers of the places of children.
const PLACES: [u32; 4] = [0, 1, 2, 3];

/// The children that a ray meets.
pub(super) struct Meeting {
    met: [Met; 4],
    n: usize,
}

impl<'a> Walker<'a> {
    pub(super) fn new(nodes: &'a [UVec4], ray: &Ray, inverse: Vec3) -> Self {
        let lanes = |v: Vec3| f32x4::new([v.x, v.y, v.z, 0.0]);
        let back = inverse.to_array().map(|x| usize::from(x < 0.0));
        Self { nodes, origin: lanes(ray.origin), inverse: lanes(inverse), back }
    }

    /// The children of node `i` that the ray meets before `t_max`.
    #[inline]
    pub(super) fn meet(&self, i: u32, t_max: f32) -> Meeting {
        let at = 4 * i as usize;
        let node = self.nodes.get(at..).and_then(|rest| rest.first_chunk::<4>());
        // No pack that passed its checks leads elsewhere.
        let Some(node) = node else { return Meeting::NONE };
        let a = lanes(node[1]) * self.inverse;
        let b = (lanes(node[0]) - self.origin) * self.inverse;
        let slack = (b.abs() + a.abs() * 256.0) * SLACK;
        let [a, low, high] = [a, b - slack, b + slack].map(f32x4::to_array);
        let plane = |word: u32, axis: usize, b: f32| bytes(word) * a[axis] + f32x4::splat(b);
        let near = |axis: usize| plane(node[2 + self.back[axis]][axis], axis, low[axis]);
        let far = |axis: usize| plane(node[3 - self.back[axis]][axis], axis, high[axis]);
        let enter = near(0).fast_max(near(1)).fast_max(near(2).fast_max(f32x4::ZERO));
        let leave = far(0).fast_min(far(1)).fast_min(far(2).fast_min(f32x4::splat(t_max)));
        let mut left = enter.simd_le(leave * FAR_END).to_bitmask();
        let (enter, children) = (enter.to_array(), node.map(|word| word.w));
        let mut meeting = Meeting::NONE;
        while left != 0 {
            let slot = left.trailing_zeros() as usize & 3;
            left &= left - 1;
            // A box that is inside out can seem to be met from far away.
            if children[slot] != NONE {
                let key = (enter[slot].to_bits() & DISTANCE) | PLACES[slot];
                meeting.add(Met { key, child: children[slot] });
            }
        }
        meeting
    }
}

impl Meeting {
    const NONE: Self = Self { met: [Met { key: 0, child: NONE }; 4], n: 0 };

    /// Adds one; those that are there are in order, the farthest first.
    #[inline]
    fn add(&mut self, new: Met) {
        let mut at = self.n & 3;
        self.n += 1;
        while at > 0 && self.met[at - 1].key < new.key {
            self.met[at] = self.met[at - 1];
            at -= 1;
        }
        self.met[at] = new;
    }

    /// The nearest, and the others, the farthest first.
    #[inline]
    pub(super) fn split(&self) -> Option<(Met, &[Met])> {
        let (nearest, others) = self.met.get(..self.n)?.split_last()?;
        Some((*nearest, others))
    }
}

/// Three floats; the fourth lane, which holds an integer, becomes 0: as a float it could be slow.
#[inline]
fn lanes(word: UVec4) -> f32x4 {
    let [x, y, z, _] = word.to_array().map(f32::from_bits);
    f32x4::new([x, y, z, 0.0])
}

/// Four bytes as numbers, the lowest first.
#[inline]
fn bytes(word: u32) -> f32x4 {
    f32x4::from_i32x4(i32x4::new(word.to_le_bytes().map(i32::from)))
}

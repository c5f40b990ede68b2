//! A wide node: which of four boxes a ray meets, nearest first.
//!
//! The operations are those of `trace/wide.wgsl`, where it says why no box is ever smaller than it is. The
//! order of equally near children is the same, too: the number of rays that go on behind what they hit
//! depends on it. Children are sorted without branches: which of them a ray meets cannot be foreseen.

use super::stack::{FAR_END, Stack, Waiting};
use crate::kernel::f32::{CHILD_FIRST, CHILD_INDEX, CHILD_INNER, Ray};
use bytemuck::cast;
use glam::{UVec4, Vec3};
use wide::{f32x4, i32x4};

/// 2^-21, eight roundings.
const SLACK: f32 = 4.768_371_6e-7;
/// Bits of a distance that are kept in a key; the others are the place of the child in its node.
const DISTANCE: u32 = 0x7fff_fffc;
/// Rows of a line of the cache.
const LINE: usize = 4;
/// Four words: three floats or three times four bytes, and the reference of a child.
type Row = [u32; 4];

/// What is worked out once a ray, in each frame that it enters.
pub(super) struct Walker<'a> {
    nodes: &'a [Row],
    triangles: &'a [Row],
    origin: f32x4,
    inverse: f32x4,
    /// For each axis 1 if the ray runs against it, so that it meets upper ends first.
    back: [usize; 3],
}

/// Of four children, which ones a ray meets.
struct Met {
    /// The bits of the distance at which the ray enters the box, the lowest two replaced by the number of
    /// the child; -1 if it does not.
    keys: [i32; 4],
    n: usize,
}

impl<'a> Walker<'a> {
    #[inline(always)]
    pub(super) fn new(
        (nodes, triangles): (&'a [UVec4], &'a [UVec4]),
        ray: &Ray,
        inverse: Vec3,
    ) -> Self {
        let lanes = |v: Vec3| f32x4::new([v.x, v.y, v.z, 0.0]);
        let against = |x: f32| usize::from(x < 0.0);
        Self {
            nodes: bytemuck::cast_slice(nodes),
            triangles: bytemuck::cast_slice(triangles),
            origin: lanes(ray.origin),
            inverse: lanes(inverse),
            back: [against(inverse.x), against(inverse.y), against(inverse.z)],
        }
    }

    /// The nearest child of node `i` that the ray meets before `t_max`; the others wait on the stack.
    #[inline(always)]
    pub(super) fn visit(&self, i: u32, t_min: f32, t_max: f32, stack: &mut Stack) -> Option<u32> {
        // No pack that passed its checks leads elsewhere.
        let node = self.nodes.get(4 * i as usize..)?.first_chunk::<4>()?;
        self.ask_for_children(node);
        let met = self.meet(node, t_min, t_max);
        let others = met.n.checked_sub(1)?;
        let waiting = |key: u32| Waiting { child: child(node, key), distance: key & DISTANCE };
        let [a, b, c, d] = met.farthest_first();
        stack.push([waiting(a), waiting(b), waiting(c), waiting(d)], others);
        Some(child(node, met.nearest()))
    }

    /// Most nodes and triangles are far away in memory, and the ray is likely to go on to one of these: what is
    /// worked out meanwhile hides some of the way.
    #[inline(always)]
    fn ask_for_children(&self, node: &[Row; 4]) {
        for row in node {
            let child = row[3];
            let (rows, first) = if child & CHILD_INNER != 0 {
                (self.nodes, 4 * (child & CHILD_INDEX) as usize)
            } else {
                (self.triangles, 3 * (child & CHILD_FIRST) as usize)
            };
            // Two lines of the cache: triangles of a leaf are several, and what follows a node is often its sibling.
            for line in 0..2 {
                if let Some(row) = rows.get(first + line * LINE) {
                    prefetch(row);
                }
            }
        }
    }

    #[inline(always)]
    fn meet(&self, node: &[Row; 4], t_min: f32, t_max: f32) -> Met {
        let a = floats(&node[1]) * self.inverse;
        let b = (floats(&node[0]) - self.origin) * self.inverse;
        let slack = (b.abs() + a.abs() * 256.0) * SLACK;
        let (low, high) = (b - slack, b + slack);
        let plane = |word: u32, axis: usize, b: f32x4| bytes(word) * lane(a, axis) + lane(b, axis);
        let near = |axis: usize| plane(node[2 + self.back[axis]][axis], axis, low);
        let far = |axis: usize| plane(node[3 - self.back[axis]][axis], axis, high);
        let enter = near(0).fast_max(near(1)).fast_max(near(2).fast_max(f32x4::splat(t_min)));
        let leave = far(0).fast_min(far(1)).fast_min(far(2).fast_min(f32x4::splat(t_max)));
        // A box that is inside out can seem to be met from far away.
        let children: i32x4 = cast([node[0][3], node[1][3], node[2][3], node[3][3]]);
        let there = !children.simd_eq(i32x4::splat(-1));
        let meets = cast::<f32x4, i32x4>(enter.simd_le(leave * FAR_END)) & there;
        let distance: i32x4 = cast([DISTANCE; 4]);
        let keys = (cast::<f32x4, i32x4>(enter) & distance) | i32x4::new([0, 1, 2, 3]);
        let n = cast::<i32x4, f32x4>(meets).to_bitmask().count_ones();
        // No key is negative.
        Met { keys: (keys | !meets).to_array(), n: n as usize }
    }
}

impl Met {
    /// All keys, the greatest first; those of children that are not met come last.
    #[inline(always)]
    fn farthest_first(&self) -> [u32; 4] {
        let [a, b, c, d] = self.keys;
        let (high, low) = ([a.max(b), c.max(d)], [a.min(b), c.min(d)]);
        let (first, inner) = (high[0].max(high[1]), high[0].min(high[1]));
        let (outer, last) = (low[0].max(low[1]), low[0].min(low[1]));
        let [second, third] = [inner.max(outer), inner.min(outer)];
        [first.cast_unsigned(), second.cast_unsigned(), third.cast_unsigned(), last.cast_unsigned()]
    }

    /// The least key of a child that is met, if one is.
    #[inline(always)]
    fn nearest(&self) -> u32 {
        let [a, b, c, d] = self.keys;
        let (ab, cd) =
            (a.cast_unsigned().min(b.cast_unsigned()), c.cast_unsigned().min(d.cast_unsigned()));
        ab.min(cd)
    }
}

/// The reference that `key` is of.
#[inline(always)]
fn child(node: &[Row; 4], key: u32) -> u32 {
    node[key as usize & 3][3]
}

/// Three floats; the fourth lane, which holds an integer, becomes 0: as a float it could be slow.
#[inline(always)]
fn floats(row: &Row) -> f32x4 {
    cast::<Row, f32x4>(*row) & cast::<Row, f32x4>([u32::MAX, u32::MAX, u32::MAX, 0])
}

/// One lane in all.
#[inline(always)]
fn lane(v: f32x4, k: usize) -> f32x4 {
    f32x4::splat(v.to_array()[k])
}

/// Four bytes as numbers, the lowest first.
#[inline(always)]
fn bytes(word: u32) -> f32x4 {
    let [a, b, c, d] = word.to_le_bytes();
    f32x4::from_i32x4(i32x4::new([i32::from(a), i32::from(b), i32::from(c), i32::from(d)]))
}

/// Asks for what is about to be read, where the processor can be asked.
#[inline(always)]
fn prefetch(row: &Row) {
    #[cfg(target_arch = "x86_64")]
    safe_arch::prefetch_t0(row);
    #[cfg(not(target_arch = "x86_64"))]
    let _ = row;
}

//! Boxes of children in steps of a grid.
//!
//! Turns two to four boxes into a `WideNode` whose boxes contain them: as real numbers, and as every
//! device computes them. What the kernel does is done here too, and looked at: a box that came out
//! smaller is a fault of ours, not a hole in a picture.

use pack::abi::{EMPTY_BOX, NONE, WIDTH, WideNode};

use super::check::TreeFault;
use super::fragment::Bounds;

/// Steps of a grid.
const STEPS: f64 = 255.0;
/// Low bits of a step's word that are 0, so that 16 significant bits are left.
const SHORT: u32 = 8;

/// The node of these children.
pub(super) fn quantize(children: &[(Bounds, u32)]) -> Result<WideNode, TreeFault> {
    let all = children.iter().fold(Bounds::EMPTY, |all, (bounds, _)| all.union(*bounds));
    let origin = all.lo3();
    let end = all.hi3();
    let scale = [0, 1, 2].map(|k| step(origin[k], end[k]));
    let mut words = [NONE; WIDTH];
    let mut ends = [EMPTY_BOX.map(|end| [end; 3]); WIDTH];
    for (slot, (bounds, word)) in children.iter().enumerate() {
        let (lo, hi) = (bounds.lo3(), bounds.hi3());
        words[slot] = *word;
        ends[slot] = [
            [0, 1, 2].map(|k| below(origin[k], scale[k], lo[k])),
            [0, 1, 2].map(|k| above(origin[k], scale[k], hi[k])),
        ];
    }
    let word = |end: usize, axis: usize| u32::from_le_bytes(ends.map(|ends| ends[end][axis]));
    let [child0, child1, child2, child3] = words;
    let [lo, hi] = [0, 1].map(|end| [0, 1, 2].map(|axis| word(end, axis)));
    let node = WideNode { origin, child0, scale, child1, lo, child2, hi, child3 };
    let sound = children.iter().enumerate().all(|(slot, (bounds, _))| covers(&node, slot, bounds));
    if sound { Ok(node) } else { Err(TreeFault::Grid) }
}

/// Where `steps` steps lead, as a real number up to 2^-53.
fn place(origin: f32, scale: f32, steps: u8) -> f64 {
    f64::from(origin) + f64::from(steps) * f64::from(scale)
}

/// The shortest step of at most 16 significant bits with which the grid reaches from `origin` to `end`.
fn step(origin: f32, end: f32) -> f32 {
    #[expect(clippy::cast_possible_truncation, reason = "rounding is corrected below")]
    let about = ((f64::from(end) - f64::from(origin)) / STEPS) as f32;
    let mut bits = about.max(f32::MIN_POSITIVE).to_bits() >> SHORT;
    while place(origin, f32::from_bits(bits << SHORT), u8::MAX) < f64::from(end) {
        bits += 1;
    }
    f32::from_bits(bits << SHORT)
}

/// Most steps that do not lead beyond `lo`, which is not below the origin.
fn below(origin: f32, scale: f32, lo: f32) -> u8 {
    let mut steps = steps_to(origin, scale, lo);
    while steps > 0 && place(origin, scale, steps) > f64::from(lo) {
        steps -= 1;
    }
    steps
}

/// Fewest steps that lead to `hi` or beyond, which the whole grid does.
fn above(origin: f32, scale: f32, hi: f32) -> u8 {
    let mut steps = steps_to(origin, scale, hi);
    while steps < u8::MAX && place(origin, scale, steps) < f64::from(hi) {
        steps += 1;
    }
    steps
}

/// The number of whole steps to `x`, up to rounding.
#[expect(clippy::cast_possible_truncation, reason = "the cast of a float saturates")]
fn steps_to(origin: f32, scale: f32, x: f32) -> u8 {
    ((f64::from(x) - f64::from(origin)) / f64::from(scale)) as u8
}

/// Whether the box of child `slot`, as every device computes it and as real numbers, contains `bounds`.
fn covers(node: &WideNode, slot: usize, bounds: &Bounds) -> bool {
    let ([lo, hi], [steps_lo, steps_hi]) = (node.corners(slot), node.steps(slot));
    let real = |k: usize, steps: [u8; 3]| place(node.origin[k], node.scale[k], steps[k]);
    (0..3).all(|k| {
        lo[k] <= bounds.lo[k]
            && hi[k] >= bounds.hi[k]
            && real(k, steps_lo) <= f64::from(bounds.lo[k])
            && real(k, steps_hi) >= f64::from(bounds.hi[k])
            && (node.scale[k].to_bits() & ((1 << SHORT) - 1)) == 0
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::Vec4;

    fn bounds(lo: [f32; 3], hi: [f32; 3]) -> Bounds {
        let corner = |c: [f32; 3]| Vec4::new(c[0], c[1], c[2], 0.0);
        Bounds { lo: corner(lo), hi: corner(hi) }
    }

    #[test]
    fn boxes_of_any_size_anywhere_are_covered_closely() {
        let mut state = 7_u32;
        let mut next = move || {
            state = state.wrapping_mul(747_796_405).wrapping_add(2_891_336_453);
            state >> 8
        };
        for round in 0..20_000 {
            let n = 2 + next() as usize % 3;
            let size = (-(next() as f32 / 16_777_216.0) * 40.0).exp2();
            let away = [0.0, 1.0, -1.0, 1e-6][round % 4];
            let mut at = || away + (next() as f32 / 16_777_216.0 - 0.5) * size;
            let children: Vec<(Bounds, u32)> = (0..n)
                .map(|_| {
                    let (a, b) = ([0; 3].map(|_| at()), [0; 3].map(|_| at()));
                    let lo = [0, 1, 2].map(|k| a[k].min(b[k]) - f32::EPSILON * a[k].abs());
                    let hi = [0, 1, 2].map(|k| a[k].max(b[k]) + f32::EPSILON * a[k].abs());
                    (bounds(lo, hi), 0)
                })
                .collect();
            let node = quantize(&children).expect("the boxes are sound");
            for (slot, (bounds, _)) in children.iter().enumerate() {
                let [lo, hi] = node.corners(slot);
                for k in 0..3 {
                    let step = node.scale[k] * 1.001 + f32::EPSILON * (lo[k].abs() + hi[k].abs());
                    assert!(bounds.lo[k] - lo[k] <= step && hi[k] - bounds.hi[k] <= step);
                }
            }
            for slot in n..WIDTH {
                assert_eq!(node.steps(slot), [[255; 3], [0; 3]]);
            }
        }
    }

    /// The product with a step is exact: fused or not, the sum is the same.
    #[test]
    fn a_plane_is_rounded_once() {
        let children = [(bounds([-0.3, 0.1, 0.7], [0.11, 0.13, 0.9]), 0)].repeat(2);
        let node = quantize(&children).expect("the boxes are sound");
        for (steps, k) in (0..=255_u8).flat_map(|steps| [0, 1, 2].map(|k| (steps, k))) {
            let (origin, scale) = (node.origin[k], node.scale[k]);
            let apart = origin + f32::from(steps) * scale;
            assert_eq!(apart.to_bits(), f32::from(steps).mul_add(scale, origin).to_bits());
        }
    }
}

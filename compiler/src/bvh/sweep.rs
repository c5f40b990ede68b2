//! Exact surface-area heuristic for small nodes.
//!
//! Turns at most [`SWEEP_MAX`] fragments, sorted by index, into the best of all 3 x (n - 1) splits
//! of their sorted centroids. Below a few dozen fragments this is both better and quicker than
//! filling bins.

use super::fragment::{Bounds, Fragment};

/// Most fragments for which every split is tried.
pub(super) const SWEEP_MAX: usize = 24;

/// A split of a small range.
#[derive(Clone, Copy, Debug)]
pub(super) struct SweepSplit {
    /// Bit `i`: fragment `i` goes left.
    pub(super) mask: u32,
    pub(super) n_left: usize,
    pub(super) left: Bounds,
    pub(super) right: Bounds,
    /// Half-areas weighted by counts; compare with half-area of the parent times its count.
    pub(super) cost: f32,
}

/// Sorts positions by centroid along `axis`, equal centroids by position.
fn sorted(frags: &[Fragment], axis: usize, order: &mut [u64; SWEEP_MAX]) {
    for (i, (slot, f)) in order.iter_mut().zip(frags).enumerate() {
        *slot = (f.key(axis) & !0xffff_ffff) | i as u64;
    }
    let keys = &mut order[..frags.len()];
    for i in 1..keys.len() {
        let key = keys[i];
        let mut j = i;
        while j > 0 && keys[j - 1] > key {
            keys[j] = keys[j - 1];
            j -= 1;
        }
        keys[j] = key;
    }
}

/// The cheapest split, or `None` when areas cannot tell splits apart. Of equal costs the more even
/// split wins, then the lower axis, then the lower position.
pub(super) fn best(frags: &[Fragment]) -> Option<SweepSplit> {
    let n = frags.len();
    let mut order = [0_u64; SWEEP_MAX];
    let mut above = [(Bounds::EMPTY, 0.0_f32); SWEEP_MAX];
    let mut key = (f32::INFINITY, usize::MAX);
    let mut found: Option<SweepSplit> = None;
    for axis in 0..3 {
        sorted(frags, axis, &mut order);
        let at = |k: usize| (order[k] & 0xff) as usize;
        let mut acc = Bounds::EMPTY;
        for k in (1..n).rev() {
            acc = acc.union(frags[at(k)].bounds());
            above[k] = (acc, acc.half_area() * (n - k) as f32);
        }
        let (mut acc, mut mask) = (Bounds::EMPTY, 0);
        for (k, &(right, cost_right)) in above.iter().enumerate().take(n).skip(1) {
            let position = at(k - 1);
            acc = acc.union(frags[position].bounds());
            mask |= 1_u32 << position;
            let cost = acc.half_area() * k as f32 + cost_right;
            let this = (cost, k.abs_diff(n - k));
            if cost > 0.0 && cost.is_finite() && this < key {
                key = this;
                found = Some(SweepSplit { mask, n_left: k, left: acc, right, cost });
            }
        }
    }
    found
}

/// Half of the fragments along the widest axis of their centroids, equal centroids by index.
pub(super) fn median(frags: &[Fragment]) -> SweepSplit {
    let centroids = frags.iter().fold(Bounds::EMPTY, |b, f| b.with_point(f.centroid2()));
    let mut order = [0_u64; SWEEP_MAX];
    sorted(frags, centroids.widest_axis(), &mut order);
    let n_left = frags.len() / 2;
    let mask = order[..n_left].iter().fold(0, |m, key| m | 1_u32 << (key & 0xff));
    let side = |bit: u32| {
        let members = frags.iter().enumerate().filter(|(i, _)| mask >> i & 1 == bit);
        members.fold(Bounds::EMPTY, |b, (_, f)| b.union(f.bounds()))
    };
    SweepSplit { mask, n_left, left: side(1), right: side(0), cost: f32::INFINITY }
}

/// Moves the left side to the front; both sides keep their order.
pub(super) fn partition(frags: &mut [Fragment], split: &SweepSplit) {
    let mut copy = [frags[0]; SWEEP_MAX];
    copy[..frags.len()].copy_from_slice(frags);
    let (mut left, mut right) = (0, split.n_left);
    for (i, f) in copy[..frags.len()].iter().enumerate() {
        let slot = if split.mask >> i & 1 == 1 { &mut left } else { &mut right };
        frags[*slot] = *f;
        *slot += 1;
    }
}

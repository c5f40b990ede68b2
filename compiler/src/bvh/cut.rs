//! A spatial split, before and while it is made.
//!
//! Turns a range of fragments and a plane into what goes left, what goes right and what is cut in two.
//! A fragment that crosses the plane is put on one side whole where that costs no more, or where there
//! is no room for another piece.
//!
//! Stich et al. 2009, section 4.4, "Reference unsplitting".

use super::clip::{Plane, clip};
use super::fragment::{Bounds, Fragment};
use super::input::Corners;
use super::pieces::Split;
use super::range::{Range, Sides};

/// A spatial split that is being made.
pub(super) struct Cut {
    plane: Plane,
    pub(super) counts: [usize; 2],
    bounds: [Bounds; 2],
    /// Positions of the fragments that cross the plane, and what becomes of them.
    crossing: Vec<(usize, Fate)>,
}

/// Where a fragment that crosses the plane goes.
#[derive(Clone, Copy)]
enum Fate {
    Side(bool),
    Both([Fragment; 2]),
}

impl Cut {
    pub(super) fn new(frags: &[Fragment], corners: Corners, plane: Plane) -> Self {
        let mut cut =
            Self { plane, counts: [0; 2], bounds: [Bounds::EMPTY; 2], crossing: Vec::new() };
        for (i, f) in frags.iter().enumerate() {
            let b = f.bounds();
            if let Some(side) = cut.side(&b) {
                cut.counts[side] += 1;
                cut.bounds[side] = cut.bounds[side].union(b);
                continue;
            }
            let halves = if f.is_whole() { None } else { clip(f, corners.of(f), plane) };
            let fate =
                halves.map_or(Fate::Side(f.centroid2()[plane.axis] > 2.0 * plane.at), Fate::Both);
            cut.crossing.push((i, fate));
        }
        for at in 0..cut.crossing.len() {
            match cut.crossing[at] {
                (i, Fate::Side(side)) => {
                    let side = usize::from(side);
                    cut.counts[side] += 1;
                    cut.bounds[side] = cut.bounds[side].union(frags[i].bounds());
                }
                (_, Fate::Both(halves)) => {
                    for (side, half) in halves.iter().enumerate() {
                        cut.counts[side] += 1;
                        cut.bounds[side] = cut.bounds[side].union(half.bounds());
                    }
                }
            }
        }
        cut.unsplit(frags);
        cut
    }

    /// The side of a box that does not cross the plane.
    fn side(&self, b: &Bounds) -> Option<usize> {
        let Plane { axis, at } = self.plane;
        if b.hi[axis] <= at { Some(0) } else { (b.lo[axis] >= at).then_some(1) }
    }

    /// Takes back what is cheaper on one side.
    fn unsplit(&mut self, frags: &[Fragment]) {
        for at in 0..self.crossing.len() {
            let (i, Fate::Both(_)) = self.crossing[at] else { continue };
            let whole = frags[i].bounds();
            let [left, right] = self.one_sided(whole);
            let side = usize::from(right < left);
            if left.min(right) <= self.cost() && self.counts[1 - side] > 1 {
                self.counts[1 - side] -= 1;
                self.bounds[side] = self.bounds[side].union(whole);
                self.crossing[at].1 = Fate::Side(side == 1);
            }
        }
    }

    /// Takes back as many as are too many, those first that cost least on one side.
    pub(super) fn limit_pieces(&mut self, frags: &[Fragment], most: usize) {
        let excess = self.n_pieces().saturating_sub(most);
        if excess == 0 {
            return;
        }
        let mut prices: Vec<(f32, usize, bool)> = Vec::with_capacity(self.crossing.len());
        for (at, (i, fate)) in self.crossing.iter().enumerate() {
            if matches!(fate, Fate::Both(_)) {
                let [left, right] = self.one_sided(frags[*i].bounds());
                prices.push((left.min(right), at, right < left));
            }
        }
        prices.sort_unstable_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
        for &(_, at, right) in &prices[..excess] {
            let side = usize::from(right);
            let (i, fate) = &mut self.crossing[at];
            self.counts[1 - side] -= 1;
            self.bounds[side] = self.bounds[side].union(frags[*i].bounds());
            *fate = Fate::Side(right);
        }
    }

    /// The cost if a fragment that now counts on both sides were on the left or on the right alone.
    fn one_sided(&self, whole: Bounds) -> [f32; 2] {
        let n = self.counts.map(|n| n as f32);
        let area = self.bounds.map(Bounds::half_area);
        let grown = self.bounds.map(|b| b.union(whole).half_area());
        [grown[0] * n[0] + area[1] * (n[1] - 1.0), area[0] * (n[0] - 1.0) + grown[1] * n[1]]
    }

    pub(super) fn n_pieces(&self) -> usize {
        self.crossing.iter().filter(|(_, fate)| matches!(fate, Fate::Both(_))).count()
    }

    pub(super) fn cost(&self) -> f32 {
        let side = |k: usize| self.bounds[k].half_area() * self.counts[k] as f32;
        side(0) + side(1)
    }

    /// Cuts the fragments of the range and puts the left side first.
    pub(super) fn make(self, range: &mut Range) -> Sides {
        let n = range.n;
        for f in &mut range.frags[..n] {
            let right = f.bounds().hi[self.plane.axis] > self.plane.at;
            f.send(right);
        }
        let mut n_new = 0;
        for (i, fate) in self.crossing {
            match fate {
                Fate::Side(right) => range.frags[i].send(right),
                Fate::Both([mut left, mut right]) => {
                    left.send(false);
                    right.send(true);
                    range.splits[n_new] = Split::new(left.piece(), self.plane);
                    let number = range.next + u32::try_from(n_new).expect("at most 2^27 pieces");
                    range.frags[i] = left;
                    range.frags[n + n_new] = right.with_piece(number);
                    n_new += 1;
                }
            }
        }
        range.n += n_new;
        range.next += u32::try_from(n_new).expect("at most 2^27 pieces");
        let splits = std::mem::take(&mut range.splits);
        range.splits = &mut splits[n_new..];
        gather(&mut range.frags[..n + n_new])
    }
}

/// Moves the fragments that go left to the front; measures both sides.
fn gather(frags: &mut [Fragment]) -> Sides {
    let (mut i, mut j) = (0, frags.len());
    loop {
        while i < j && !frags[i].goes_right() {
            i += 1;
        }
        while i < j && frags[j - 1].goes_right() {
            j -= 1;
        }
        if i >= j {
            break;
        }
        frags.swap(i, j - 1);
    }
    let (left, right) = frags.split_at_mut(i);
    let [l, r] = [left, right].map(|part| {
        for f in part.iter_mut() {
            f.send(false);
        }
        part.iter().fold([Bounds::EMPTY; 2], |[b, c], f| {
            [b.union(f.bounds()), c.with_point(f.centroid2())]
        })
    });
    let counts = [i, frags.len() - i];
    Sides { counts, bounds: [l[0], r[0]], centroids: [l[1], r[1]] }
}

//! What the builder sees of a primitive: its box and its index.
//!
//! Turns triangles and spheres into axis-aligned boxes in the frame of their input. Keeps two
//! invariants: every coordinate is finite with magnitude at most [`COORD_MAX`] (so that no area
//! overflows), and no coordinate is negative zero (so that minimum and maximum do not depend on the
//! order of their arguments).

use glam::{DVec3, Vec4};

use super::path::Motion;

/// Largest coordinate magnitude. The half-area of a box of side 2e18 is 1.2e37, below `f32::MAX`.
pub const COORD_MAX: f32 = 1e18;

/// Most primitives of one kind: leaf references have 27 bits for the first primitive.
pub const MAX_PRIMITIVES: usize = 1 << 27;

/// Added to indices stored in a float lane: all results are ordinary floats in [2, 131072), so that
/// whole-vector arithmetic never meets a denormal or NaN in that lane.
const INDEX_BIAS: u32 = 0x4000_0000;

/// The piece begins at this bit of the upper corner's fourth lane; indices of pieces are below 2^27,
/// as those of primitives.
const PIECE_SHIFT: u32 = 2;
/// Mark of that lane: must not be split.
const WHOLE: u32 = 1;
/// Mark of that lane: belongs to the right side of the split that is being made.
const TO_RIGHT: u32 = 2;

/// An axis-aligned box; the fourth lanes mean nothing.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Bounds {
    /// Lower corner.
    pub lo: Vec4,
    /// Upper corner.
    pub hi: Vec4,
}

impl Bounds {
    /// The box of nothing: neutral in [`Bounds::union`].
    pub const EMPTY: Self = Self { lo: Vec4::INFINITY, hi: Vec4::NEG_INFINITY };

    /// The smallest box around both.
    #[inline]
    #[must_use]
    pub fn union(self, other: Self) -> Self {
        Self { lo: self.lo.min(other.lo), hi: self.hi.max(other.hi) }
    }

    /// The largest box in both; corners in the wrong order where there is none.
    #[inline]
    #[must_use]
    pub(super) fn intersection(self, other: Self) -> Self {
        Self { lo: self.lo.max(other.lo), hi: self.hi.min(other.hi) }
    }

    /// Half the surface area of what both have in common; 0 where that is nothing.
    #[inline]
    #[must_use]
    pub(super) fn overlap(self, other: Self) -> f32 {
        let common = self.intersection(other);
        let d = (common.hi - common.lo).max(Vec4::ZERO);
        // A side of length 0 with others below 0 has no area.
        let apart = common.lo.cmpgt(common.hi).bitmask() & 7;
        if apart == 0 { d.x * d.y + d.y * d.z + d.z * d.x } else { 0.0 }
    }

    /// The smallest box around this one and the point `p`.
    #[inline]
    #[must_use]
    pub fn with_point(self, p: Vec4) -> Self {
        Self { lo: self.lo.min(p), hi: self.hi.max(p) }
    }

    /// The same box with both fourth lanes 0.
    #[must_use]
    pub(super) fn without_lanes(mut self) -> Self {
        (self.lo.w, self.hi.w) = (0.0, 0.0);
        self
    }

    /// Half the surface area, in squared units of the frame; not meaningful for `EMPTY`.
    #[inline]
    #[must_use]
    pub fn half_area(self) -> f32 {
        let d = self.hi - self.lo;
        d.x * d.y + d.y * d.z + d.z * d.x
    }

    /// The axis (0, 1, 2) of the largest extent; the first one of equals.
    #[must_use]
    pub fn widest_axis(self) -> usize {
        let d = (self.hi - self.lo).to_array();
        let yz = if d[2] > d[1] { 2 } else { 1 };
        if d[yz] > d[0] { yz } else { 0 }
    }

    /// The lower corner as a record field.
    #[must_use]
    pub fn lo3(self) -> [f32; 3] {
        self.lo.truncate().to_array()
    }

    /// The upper corner as a record field.
    #[must_use]
    pub fn hi3(self) -> [f32; 3] {
        self.hi.truncate().to_array()
    }
}

/// The box of one primitive, with the index of the primitive in the caller's list. 32 bytes.
#[derive(Clone, Copy, Debug, PartialEq, bytemuck::Pod, bytemuck::Zeroable)]
#[repr(C)]
pub struct Fragment {
    /// Lower corner; the fourth lane carries the index.
    lo: Vec4,
    /// Upper corner; the fourth lane carries the piece and its marks.
    hi: Vec4,
}

impl Fragment {
    /// A fragment from the corners of a box. NaN becomes `-COORD_MAX`, larger magnitudes are
    /// clamped: whoever imports geometry has reported them before.
    #[must_use]
    pub fn new(lo: [f32; 3], hi: [f32; 3], index: u32) -> Self {
        debug_assert!((index as usize) < MAX_PRIMITIVES);
        let limit = Vec4::splat(COORD_MAX);
        // `+ 0.0` turns -0 into +0; the order of operands in `max` drops NaN.
        let clean = |v: [f32; 3]| {
            let v = v.map(|x| if x > -COORD_MAX { x } else { -COORD_MAX });
            Vec4::new(v[0], v[1], v[2], 0.0).min(limit) + Vec4::ZERO
        };
        let (mut lo, mut hi) = (clean(lo), clean(hi));
        lo.w = f32::from_bits(index | INDEX_BIAS);
        hi.w = f32::from_bits(index << PIECE_SHIFT | INDEX_BIAS);
        Self { lo, hi }
    }

    /// The exact box of a triangle. One whose corners had to be made finite must not be split.
    #[must_use]
    pub fn of_triangle(corners: &[[f32; 3]; 3], index: u32) -> Self {
        let [a, b, c] = corners;
        let lo = [0, 1, 2].map(|k| a[k].min(b[k]).min(c[k]));
        let hi = [0, 1, 2].map(|k| a[k].max(b[k]).max(c[k]));
        let new = Self::new(lo, hi, index);
        // NaN is not in any range.
        let sound = corners.as_flattened().iter().all(|x| (-COORD_MAX..=COORD_MAX).contains(x));
        if sound { new } else { new.whole() }
    }

    /// A box that contains the real sphere, not just its rounded corners.
    #[must_use]
    pub fn of_sphere(center: [f32; 3], radius: f32, index: u32) -> Self {
        let r = f64::from(radius);
        let lo = center.map(|c| round_down(f64::from(c) - r));
        let hi = center.map(|c| round_up(f64::from(c) + r));
        Self::new(lo, hi, index)
    }

    /// The box of all places where the primitive is while it moves by `motion`, with room for what the
    /// kernel rounds on the way: the product with the time and the sum, 2^-24 each. It must not be
    /// split: its corners are elsewhere most of the time.
    #[must_use]
    pub fn swept(&self, motion: [f32; 3]) -> Self {
        let (lo, hi) = (self.lo.truncate().to_array(), self.hi.truncate().to_array());
        let reach = motion.map(f64::from);
        let room = reach.map(|m| libm::fabs(m) / 4_194_304.0);
        let low = |k: usize| round_down(f64::from(lo[k]) + reach[k].min(0.0) - room[k]);
        let high = |k: usize| round_up(f64::from(hi[k]) + reach[k].max(0.0) + room[k]);
        Self::new([0, 1, 2].map(low), [0, 1, 2].map(high), self.index()).whole()
    }

    /// The box of all places where the primitive is while it moves, likewise.
    #[must_use]
    pub fn moving(&self, motion: &Motion) -> Self {
        let path = match motion {
            Motion::Straight(way) => return self.swept(*way),
            Motion::Along(path) => path,
        };
        let corner = |v: Vec4| DVec3::from(v.truncate().to_array().map(f64::from));
        let [lo, hi] = path.sweep_with_room(corner(self.lo), corner(self.hi));
        let (lo, hi) = (lo.to_array().map(round_down), hi.to_array().map(round_up));
        Self::new(lo, hi, self.index()).whole()
    }

    /// Index of the primitive.
    #[inline]
    #[must_use]
    pub fn index(&self) -> u32 {
        self.lo.w.to_bits() & !INDEX_BIAS
    }

    /// The same fragment, which must not be split: its primitive is no triangle, or is not where its
    /// corners say.
    #[must_use]
    pub fn whole(mut self) -> Self {
        self.hi.w = f32::from_bits(self.hi.w.to_bits() | WHOLE);
        self
    }

    /// Whether it must not be split.
    #[inline]
    #[must_use]
    pub fn is_whole(&self) -> bool {
        self.hi.w.to_bits() & WHOLE != 0
    }

    /// Which piece of a primitive this is: the index of the primitive until it is split.
    #[inline]
    #[must_use]
    pub(super) fn piece(&self) -> u32 {
        (self.hi.w.to_bits() & !INDEX_BIAS) >> PIECE_SHIFT
    }

    /// The same part under another number.
    #[inline]
    #[must_use]
    pub(super) fn with_piece(mut self, piece: u32) -> Self {
        let marks = self.hi.w.to_bits() & (WHOLE | TO_RIGHT);
        self.hi.w = f32::from_bits(piece << PIECE_SHIFT | INDEX_BIAS | marks);
        self
    }

    /// The same piece with another box, made of finite coordinates.
    #[must_use]
    pub(super) fn with_box(&self, lo: [f32; 3], hi: [f32; 3]) -> Self {
        let mut new = Self::new(lo, hi, self.index());
        new.hi.w = self.hi.w;
        new
    }

    /// Whether it was sent to the right side.
    #[inline]
    pub(super) fn goes_right(&self) -> bool {
        self.hi.w.to_bits() & TO_RIGHT != 0
    }

    /// Sends it to a side.
    #[inline]
    pub(super) fn send(&mut self, right: bool) {
        let mark = if right { TO_RIGHT } else { 0 };
        self.hi.w = f32::from_bits(self.hi.w.to_bits() & !TO_RIGHT | mark);
    }

    /// The box.
    #[inline]
    #[must_use]
    pub fn bounds(&self) -> Bounds {
        Bounds { lo: self.lo, hi: self.hi }
    }

    /// Twice the centre of the box; the fourth lane means nothing but is an ordinary float.
    #[inline]
    #[must_use]
    pub(super) fn centroid2(&self) -> Vec4 {
        self.lo + self.hi
    }

    /// A total order along one axis: by centroid, then by index. Signed zeros cannot occur.
    #[inline]
    #[must_use]
    pub(super) fn key(&self, axis: usize) -> u64 {
        (u64::from(ordered_bits(self.centroid2()[axis])) << 32) | u64::from(self.index())
    }
}

/// Bits that compare as unsigned integers the way finite floats compare.
#[inline]
pub(super) fn ordered_bits(x: f32) -> u32 {
    let bits = (x + 0.0).to_bits();
    if bits >> 31 == 0 { bits | (1 << 31) } else { !bits }
}

/// The largest `f32` not above `x`.
#[expect(clippy::cast_possible_truncation, reason = "rounding is corrected below")]
pub(super) fn round_down(x: f64) -> f32 {
    let y = x as f32;
    if f64::from(y) > x { y.next_down() } else { y }
}

/// The smallest `f32` not below `x`.
#[expect(clippy::cast_possible_truncation, reason = "rounding is corrected below")]
pub(super) fn round_up(x: f64) -> f32 {
    let y = x as f32;
    if f64::from(y) < x { y.next_up() } else { y }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    #[expect(clippy::float_cmp, reason = "exact results are the point")]
    fn bad_coordinates_are_made_finite() {
        let f = Fragment::new([f32::NAN, f32::NEG_INFINITY, -0.0], [1.0, f32::INFINITY, 1e30], 7);
        let b = f.bounds();
        assert_eq!(b.lo3(), [-COORD_MAX, -COORD_MAX, 0.0]);
        assert_eq!(b.hi3(), [1.0, COORD_MAX, COORD_MAX]);
        assert!(b.lo.z.is_sign_positive());
        assert_eq!(f.index(), 7);
    }

    #[test]
    fn every_index_survives_the_float_lane() {
        for index in [0, 1, 77, (1 << 23) - 1, 1 << 23, (1 << 27) - 1] {
            let f = Fragment::new([0.0; 3], [1.0; 3], index);
            assert_eq!(f.index(), index);
            assert!(f.lo.w.is_normal());
        }
    }

    #[test]
    fn a_sphere_box_contains_the_real_sphere() {
        for k in 1..2000_u16 {
            let c = 1.0 + f32::from(k) * 1e-3;
            let r = 1e-4 / f32::from(k);
            let b = Fragment::of_sphere([c; 3], r, 0).bounds();
            assert!(f64::from(b.lo.x) <= f64::from(c) - f64::from(r));
            assert!(f64::from(b.hi.x) >= f64::from(c) + f64::from(r));
        }
    }

    #[test]
    fn ordered_bits_order_like_floats() {
        let xs = [-1e18, -1.0, -1e-40, 0.0, 1e-40, 0.5, 1.0, 2e18_f32];
        assert!(xs.windows(2).all(|w| ordered_bits(w[0]) < ordered_bits(w[1])));
        assert_eq!(ordered_bits(-0.0), ordered_bits(0.0));
    }
}

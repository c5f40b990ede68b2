//! Judges triangles by their shape.

/// What a triangle is worth.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Quality {
    /// Ordinary.
    Fine,
    /// Longer than `NEEDLE` times its height.
    Needle,
    /// No area: corners coincide or lie on a line. No ray can meet it.
    ZeroArea,
}

/// Longest side over height from which a triangle is called a needle.
const NEEDLE: f64 = 1e5;

/// Height over longest side below which corners lie on a line. The sides are exact differences of
/// `f32` in `f64`, and their cross product errs by about 2^-52 relative to the product of lengths.
const FLATNESS: f64 = 1e-14;

/// Judges one triangle with finite corners.
pub(super) fn quality(corners: [[f32; 3]; 3]) -> Quality {
    let sides =
        [edge(corners[0], corners[1]), edge(corners[1], corners[2]), edge(corners[2], corners[0])];
    let longest2 = sides.iter().map(|side| dot(*side, *side)).fold(0.0, f64::max);
    let area2 = cross(sides[0], sides[1]); // twice the area
    let area2 = dot(area2, area2).sqrt();
    if area2 <= FLATNESS * longest2 {
        return Quality::ZeroArea;
    }
    // height = 2 area / longest, so longest / height = longest^2 / 2 area.
    if longest2 > NEEDLE * area2 { Quality::Needle } else { Quality::Fine }
}

/// From `a` to `b`.
pub(super) fn edge(a: [f32; 3], b: [f32; 3]) -> [f64; 3] {
    [
        f64::from(b[0]) - f64::from(a[0]),
        f64::from(b[1]) - f64::from(a[1]),
        f64::from(b[2]) - f64::from(a[2]),
    ]
}

pub(super) fn dot(a: [f64; 3], b: [f64; 3]) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

pub(super) fn cross(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}

/// `v` scaled to length 1; `None` if it has no length or an infinite one.
pub(super) fn unit(v: [f64; 3]) -> Option<[f64; 3]> {
    let length = dot(v, v).sqrt();
    (length > 0.0 && length.is_finite()).then(|| v.map(|x| x / length))
}

/// Whether `v` has no length.
pub(super) fn is_zero(v: [f32; 3]) -> bool {
    v.iter().all(|x| x.abs() <= 0.0)
}

/// Rounded to single precision.
#[expect(clippy::cast_possible_truncation, reason = "rounding is what it is for")]
pub(super) fn single<const N: usize>(v: [f64; N]) -> [f32; N] {
    v.map(|x| x as f32)
}

/// Widens `bounds` by the given points.
pub(super) fn grow(bounds: &mut Option<[[f32; 3]; 2]>, points: &[[f32; 3]]) {
    for p in points {
        let [low, high] = bounds.get_or_insert([*p, *p]);
        for axis in 0..3 {
            low[axis] = low[axis].min(p[axis]);
            high[axis] = high[axis].max(p[axis]);
        }
    }
}

/// Bits of a position such that equal positions have equal bits.
pub(super) fn position_bits(p: [f32; 3]) -> [u32; 3] {
    p.map(|x| (x + 0.0).to_bits()) // -0 + 0 is +0
}

//! The frame that the kernel works in.
//!
//! Turns the bounds of a scene, in metres, into a centre and a power-of-two scale such that half the
//! diagonal of the bounds (the radius of a ball around everything) is in [0.5, 1). Every tolerance
//! of the kernel is then free of scale. Scaling by a power of two is exact; the one rounding is that
//! of the final `f32`.

/// `normalised = (world - center) * 2^exponent`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Normalization {
    /// Centre of the scene's bounds, metres, world frame.
    pub center: [f64; 3],
    /// Exponent of the scale, in -1025 ..= 1023.
    pub exponent: i32,
}

impl Normalization {
    /// The frame that changes nothing.
    pub const IDENTITY: Self = Self { center: [0.0; 3], exponent: 0 };

    /// The frame of everything between two corners, metres. An empty scene (`lo` above `hi`, or not
    /// finite) gives the identity, a single point only a centre.
    #[must_use]
    pub fn of_bounds(lo: [f64; 3], hi: [f64; 3]) -> Self {
        let finite = |k: usize| lo[k].is_finite() && hi[k].is_finite() && lo[k] <= hi[k];
        if !(0..3).all(finite) {
            return Self::IDENTITY;
        }
        // Halves first: the sum or difference of two large numbers could overflow.
        let center = [0, 1, 2].map(|k| lo[k] * 0.5 + hi[k] * 0.5);
        let half = [0, 1, 2].map(|k| hi[k] * 0.5 - lo[k] * 0.5);
        let largest = half[0].max(half[1]).max(half[2]);
        if largest == 0.0 {
            return Self { center, exponent: 0 };
        }
        // `largest` becomes a number in [1, 2), so the squares neither overflow nor vanish.
        let shift = -libm::ilogb(largest);
        let unit = half.map(|h| libm::scalbn(h, shift));
        let radius = (unit[0] * unit[0] + unit[1] * unit[1] + unit[2] * unit[2]).sqrt();
        // `radius * 2^down` is in [0.5, 1).
        let down = -libm::ilogb(radius) - 1;
        // Scales beyond 2^1023 are no numbers; a scene that small stays smaller than 0.5.
        Self { center, exponent: (shift + down).min(1023) }
    }

    /// The frame of points, metres. Points that are not finite are ignored.
    #[must_use]
    pub fn of_points(points: impl IntoIterator<Item = [f64; 3]>) -> Self {
        let empty = ([f64::INFINITY; 3], [f64::NEG_INFINITY; 3]);
        let finite = points.into_iter().filter(|p| p.iter().all(|x| x.is_finite()));
        let (lo, hi) = finite.fold(empty, |(lo, hi), p| {
            ([0, 1, 2].map(|k| lo[k].min(p[k])), [0, 1, 2].map(|k| hi[k].max(p[k])))
        });
        Self::of_bounds(lo, hi)
    }

    /// The scale, a power of two, per metre. Zero only where the scene is too large to have one.
    #[must_use]
    pub fn scale(&self) -> f64 {
        libm::scalbn(1.0, self.exponent)
    }

    /// A world point in the normalised frame.
    #[must_use]
    pub fn point(&self, world: [f64; 3]) -> [f32; 3] {
        [0, 1, 2].map(|k| self.length(world[k] - self.center[k]))
    }

    /// A length or a component of a displacement, metres, in the normalised frame.
    #[must_use]
    #[expect(clippy::cast_possible_truncation, reason = "the one rounding of the whole conversion")]
    pub fn length(&self, metres: f64) -> f32 {
        let metres = match u64::try_from(self.exponent + 1023) {
            // The product with a power of two is what `scalbn` gives, many times quicker.
            Ok(biased @ 1..=2046) => metres * f64::from_bits(biased << 52),
            _ => libm::scalbn(metres, self.exponent),
        };
        metres as f32
    }

    /// A quantity per metre (absorption, scattering) per unit of the normalised frame.
    #[must_use]
    #[expect(clippy::cast_possible_truncation, reason = "the one rounding of the whole conversion")]
    pub fn per_length(&self, per_metre: f64) -> f32 {
        libm::scalbn(per_metre, -self.exponent) as f32
    }

    /// The world length of a normalised one, metres.
    #[must_use]
    pub fn world_length(&self, normalised: f32) -> f64 {
        libm::scalbn(f64::from(normalised), -self.exponent)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Half the diagonal in the normalised frame.
    fn radius(n: &Normalization, lo: [f64; 3], hi: [f64; 3]) -> f64 {
        let half = [0, 1, 2].map(|k| libm::scalbn(hi[k] * 0.5 - lo[k] * 0.5, n.exponent));
        half.iter().map(|h| h * h).sum::<f64>().sqrt()
    }

    #[test]
    fn the_radius_is_between_a_half_and_one() {
        for (lo, hi) in [
            ([0.0; 3], [1.0; 3]),
            ([-1.0, 0.0, 0.0], [1.0, 0.0, 0.0]),
            ([-0.5, 0.0, 0.0], [0.5, 0.0, 0.0]),
            ([1e6, 1e6, 1e6], [1e6 + 1.0, 1e6 + 2.0, 1e6 + 3.0]),
            ([0.0; 3], [1e-30, 2e-31, 0.0]),
            ([-1e300; 3], [1e300; 3]),
            ([-f64::MAX; 3], [f64::MAX; 3]),
            ([0.0; 3], [f64::MIN_POSITIVE, 0.0, 0.0]),
        ] {
            let n = Normalization::of_bounds(lo, hi);
            let r = radius(&n, lo, hi);
            assert!((0.5..1.0).contains(&r), "{lo:?} {hi:?}: {r}");
            assert!(n.point(lo).iter().chain(&n.point(hi)).all(|x| x.abs() < 1.0));
        }
    }

    #[test]
    #[expect(clippy::float_cmp, reason = "exact results are the point")]
    fn empty_and_single_point_scenes_have_a_frame() {
        assert_eq!(Normalization::of_points([]), Normalization::IDENTITY);
        let bad = [[f64::NAN, 0.0, 0.0], [0.0, f64::INFINITY, 0.0]];
        assert_eq!(Normalization::of_points(bad), Normalization::IDENTITY);
        let n = Normalization::of_points([[1e300, -3.0, 7.0]]);
        assert_eq!(n, Normalization { center: [1e300, -3.0, 7.0], exponent: 0 });
        assert_eq!(n.point([1e300, -3.0, 7.0]), [0.0; 3]);
    }

    #[test]
    fn the_smallest_scenes_stay_finite() {
        let n = Normalization::of_bounds([0.0; 3], [f64::from_bits(1), 0.0, 0.0]);
        assert!(n.exponent <= 1023 && n.scale().is_finite());
        assert!(n.point([f64::from_bits(1), 0.0, 0.0]).iter().all(|x| x.is_finite()));
    }

    #[test]
    #[expect(clippy::cast_possible_truncation, reason = "what is tested")]
    fn a_length_is_scaled_as_by_scalbn() {
        let lengths = [0.0, -0.0, 1.0, -0.3, 1e-300, 5e-324, 1e300, f64::MAX, f64::INFINITY];
        for exponent in [-1025, -1023, -1022, -1021, -150, -149, -1, 0, 1, 127, 128, 1022, 1023] {
            let frame = Normalization { center: [0.0; 3], exponent };
            for x in lengths {
                let expected = libm::scalbn(x, exponent) as f32;
                assert_eq!(frame.length(x).to_bits(), expected.to_bits(), "{x} {exponent}");
            }
        }
    }

    #[test]
    fn powers_of_two_change_no_bit() {
        let points = [[0.1, 0.2, 0.7], [3.3, -1.7, 0.9], [1.1, 1.2, -1.3]];
        let base = Normalization::of_points(points);
        for k in [-60, -20, -1, 1, 20, 60] {
            let scaled = points.map(|p| p.map(|x| libm::scalbn(x, k)));
            let n = Normalization::of_points(scaled);
            assert_eq!(n.exponent, base.exponent - k);
            for (p, s) in points.iter().zip(&scaled) {
                assert_eq!(base.point(*p).map(f32::to_bits), n.point(*s).map(f32::to_bits));
            }
        }
    }

    #[test]
    #[expect(clippy::float_cmp, reason = "exact results are the point")]
    fn a_representable_shift_changes_no_bit() {
        let points = [[0.5, 0.25, 0.75], [3.5, -1.75, 0.0], [1.125, 1.0, -1.5]];
        let base = Normalization::of_points(points);
        let moved = points.map(|p| p.map(|x| x + 1e6));
        let n = Normalization::of_points(moved);
        for (p, m) in points.iter().zip(&moved) {
            assert_eq!(base.point(*p), n.point(*m));
        }
    }

    #[test]
    #[expect(clippy::float_cmp, reason = "exact results are the point")]
    fn there_and_back_is_exact_for_normalised_numbers() {
        let n = Normalization { center: [0.0; 3], exponent: -7 };
        for x in [0.1_f32, -0.9, 1e-30, 0.0] {
            assert_eq!(n.length(n.world_length(x)).to_bits(), x.to_bits());
        }
        assert_eq!(n.world_length(-0.125), -16.0);
        assert_eq!(n.per_length(0.25) * n.length(4.0), 1.0);
    }
}

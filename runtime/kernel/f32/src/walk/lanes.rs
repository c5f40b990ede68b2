//! Eight numbers at once, by whatever instructions the processor has.
//!
//! Each operation is IEEE 754's in every lane, so that the bits do not depend on who does it; only `mul_add` may round once
//! or twice. Of two numbers of which one is not a number, which does not happen here, `min` and `max` give either.

use bytemuck::cast;
use wide::f32x4;
#[cfg(target_arch = "x86_64")]
use {
    core::arch::x86_64::{__m256, _CMP_LE_OQ},
    pulp::x86::V3,
};

/// How to compute with eight numbers.
pub(super) trait Lanes: Copy {
    /// Eight numbers.
    type Eight: Copy;

    /// The same number in all lanes.
    fn splat(self, x: f32) -> Self::Eight;
    /// Numbers from memory.
    fn load(self, row: &[f32; 8]) -> Self::Eight;
    /// Numbers as they lie in memory.
    fn array(self, a: Self::Eight) -> [f32; 8];
    /// `a * b + c`, rounded once or twice.
    fn mul_add(self, a: Self::Eight, b: Self::Eight, c: Self::Eight) -> Self::Eight;
    /// `a * b`.
    fn mul(self, a: Self::Eight, b: Self::Eight) -> Self::Eight;
    /// The lesser of each two.
    fn min(self, a: Self::Eight, b: Self::Eight) -> Self::Eight;
    /// The greater of each two.
    fn max(self, a: Self::Eight, b: Self::Eight) -> Self::Eight;
    /// One bit a lane, the lowest first: `a <= b`.
    fn at_most(self, a: Self::Eight, b: Self::Eight) -> u32;
}

/// AVX2, which the value proves to be there.
#[cfg(target_arch = "x86_64")]
impl Lanes for V3 {
    type Eight = __m256;

    #[inline(always)]
    fn splat(self, x: f32) -> __m256 {
        self.avx._mm256_set1_ps(x)
    }

    #[inline(always)]
    fn load(self, row: &[f32; 8]) -> __m256 {
        cast(*row)
    }

    #[inline(always)]
    fn array(self, a: __m256) -> [f32; 8] {
        cast(a)
    }

    #[inline(always)]
    fn mul_add(self, a: __m256, b: __m256, c: __m256) -> __m256 {
        self.fma._mm256_fmadd_ps(a, b, c)
    }

    #[inline(always)]
    fn mul(self, a: __m256, b: __m256) -> __m256 {
        self.avx._mm256_mul_ps(a, b)
    }

    #[inline(always)]
    fn min(self, a: __m256, b: __m256) -> __m256 {
        self.avx._mm256_min_ps(a, b)
    }

    #[inline(always)]
    fn max(self, a: __m256, b: __m256) -> __m256 {
        self.avx._mm256_max_ps(a, b)
    }

    #[inline(always)]
    fn at_most(self, a: __m256, b: __m256) -> u32 {
        let lanes = self.avx._mm256_cmp_ps::<_CMP_LE_OQ>(a, b);
        self.avx._mm256_movemask_ps(lanes).cast_unsigned()
    }
}

/// Four lanes twice, with what every processor of its kind has: SSE2, NEON.
#[derive(Clone, Copy)]
pub(super) struct Halves;

impl Lanes for Halves {
    type Eight = [f32x4; 2];

    #[inline(always)]
    fn splat(self, x: f32) -> [f32x4; 2] {
        [f32x4::splat(x); 2]
    }

    #[inline(always)]
    fn load(self, row: &[f32; 8]) -> [f32x4; 2] {
        cast(*row)
    }

    #[inline(always)]
    fn array(self, a: [f32x4; 2]) -> [f32; 8] {
        cast(a)
    }

    #[inline(always)]
    fn mul_add(self, a: [f32x4; 2], b: [f32x4; 2], c: [f32x4; 2]) -> [f32x4; 2] {
        [a[0] * b[0] + c[0], a[1] * b[1] + c[1]]
    }

    #[inline(always)]
    fn mul(self, a: [f32x4; 2], b: [f32x4; 2]) -> [f32x4; 2] {
        [a[0] * b[0], a[1] * b[1]]
    }

    #[inline(always)]
    fn min(self, a: [f32x4; 2], b: [f32x4; 2]) -> [f32x4; 2] {
        [a[0].fast_min(b[0]), a[1].fast_min(b[1])]
    }

    #[inline(always)]
    fn max(self, a: [f32x4; 2], b: [f32x4; 2]) -> [f32x4; 2] {
        [a[0].fast_max(b[0]), a[1].fast_max(b[1])]
    }

    #[inline(always)]
    fn at_most(self, a: [f32x4; 2], b: [f32x4; 2]) -> u32 {
        let half = |k: usize| a[k].simd_le(b[k]).to_bitmask();
        half(0) | half(1) << 4
    }
}

#[cfg(all(test, target_arch = "x86_64"))]
mod tests {
    use super::*;

    /// Numbers of all sizes and signs, zeros and infinities.
    const ROWS: [[f32; 8]; 4] = [
        [1.0, -2.5, 0.0, -0.0, 3e-39, -7e30, f32::INFINITY, 0.1],
        [0.3, -2.5, 1e-20, 5.0, 3e-39, 7e30, f32::NEG_INFINITY, 0.2],
        [-1e-3, 4.0, 2.0, -1.5, 1e38, 6.1e-5, 1.0, -8.0],
        [f32::MAX, 0.7, -3.0, 1.0 / 3.0, -1e-38, 9.0, 2.0, 0.5],
    ];

    /// Everything that the walk does with two rows.
    fn all<L: Lanes>(l: L, a: &[f32; 8], b: &[f32; 8]) -> ([[u32; 8]; 3], u32) {
        let (a, b) = (l.load(a), l.load(b));
        let bits = |x: L::Eight| l.array(x).map(f32::to_bits);
        ([bits(l.mul(a, b)), bits(l.min(a, b)), bits(l.max(a, b))], l.at_most(a, b))
    }

    #[test]
    fn both_instruction_sets_compute_the_same_bits() {
        let Some(avx2) = V3::try_new() else { return };
        for (a, b) in ROWS.iter().flat_map(|a| ROWS.iter().map(move |b| (a, b))) {
            let (wide, narrow) = (all(avx2, a, b), all(Halves, a, b));
            // The bits of what is not a number are nobody's business.
            let known = |row: [u32; 8]| row.map(|x| if f32::from_bits(x).is_nan() { 0 } else { x });
            assert_eq!(wide.0.map(known), narrow.0.map(known), "{a:?} {b:?}");
            assert_eq!(wide.1, narrow.1, "{a:?} {b:?}");
            let ordered: Vec<bool> = a.iter().zip(b).map(|(a, b)| a <= b).collect();
            let bits: Vec<bool> = (0..8).map(|lane| wide.1 >> lane & 1 == 1).collect();
            assert_eq!(ordered, bits);
        }
    }
}

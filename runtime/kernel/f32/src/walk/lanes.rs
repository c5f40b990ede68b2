//! A number for each child of a node, all at once, by whatever instructions the processor has.
//!
//! Turns rows of eight or sixteen numbers into others. Each operation is IEEE 754's in every lane, so that the bits do
//! not depend on who does it; only `mul_add` may round once or twice. Of two numbers of which one is not a number, which
//! does not happen here, `min` and `max` give either.

use super::tree::{Node, Tree};
use bytemuck::cast;
use wide::f32x4;
#[cfg(target_arch = "x86_64")]
use {
    core::arch::x86_64::{__m256, __m512, _CMP_LE_OQ},
    pulp::x86::{V3, V4},
};

/// How to compute with a number for each of up to `W` children.
pub trait Lanes<const W: usize>: Copy {
    /// `W` numbers.
    type Row: Copy;

    /// The nodes of `tree`, if they are of that width.
    fn nodes(self, tree: &Tree) -> Option<&[Node<W>]>;
    /// The same number in all lanes.
    fn splat(self, x: f32) -> Self::Row;
    /// Numbers from memory.
    fn load(self, row: &[f32; W]) -> Self::Row;
    /// Numbers as they lie in memory.
    fn array(self, a: Self::Row) -> [f32; W];
    /// `a * b + c`, rounded once or twice.
    fn mul_add(self, a: Self::Row, b: Self::Row, c: Self::Row) -> Self::Row;
    /// `a * b`.
    fn mul(self, a: Self::Row, b: Self::Row) -> Self::Row;
    /// The lesser of each two.
    fn min(self, a: Self::Row, b: Self::Row) -> Self::Row;
    /// The greater of each two.
    fn max(self, a: Self::Row, b: Self::Row) -> Self::Row;
    /// One bit a lane, the lowest first: `a <= b`.
    fn at_most(self, a: Self::Row, b: Self::Row) -> u32;
}

/// AVX2, which the value proves to be there.
#[cfg(target_arch = "x86_64")]
impl Lanes<8> for V3 {
    type Row = __m256;

    #[inline(always)]
    fn nodes(self, tree: &Tree) -> Option<&[Node<8>]> {
        tree.nodes.eights()
    }

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

/// Two rows with AVX2, for a kernel that is not compiled for AVX-512.
#[cfg(target_arch = "x86_64")]
#[derive(Clone, Copy)]
pub(super) struct Pairs(pub(super) V3);

#[cfg(target_arch = "x86_64")]
impl Pairs {
    /// The same with both halves of two rows.
    #[inline(always)]
    fn each(a: [__m256; 2], b: [__m256; 2], f: impl Fn(__m256, __m256) -> __m256) -> [__m256; 2] {
        [f(a[0], b[0]), f(a[1], b[1])]
    }
}

#[cfg(target_arch = "x86_64")]
impl Lanes<16> for Pairs {
    type Row = [__m256; 2];

    #[inline(always)]
    fn nodes(self, tree: &Tree) -> Option<&[Node<16>]> {
        tree.nodes.sixteens()
    }

    #[inline(always)]
    fn splat(self, x: f32) -> [__m256; 2] {
        [self.0.splat(x); 2]
    }

    #[inline(always)]
    fn load(self, row: &[f32; 16]) -> [__m256; 2] {
        cast(*row)
    }

    #[inline(always)]
    fn array(self, a: [__m256; 2]) -> [f32; 16] {
        cast(a)
    }

    #[inline(always)]
    fn mul_add(self, a: [__m256; 2], b: [__m256; 2], c: [__m256; 2]) -> [__m256; 2] {
        [self.0.mul_add(a[0], b[0], c[0]), self.0.mul_add(a[1], b[1], c[1])]
    }

    #[inline(always)]
    fn mul(self, a: [__m256; 2], b: [__m256; 2]) -> [__m256; 2] {
        Self::each(a, b, |a, b| self.0.mul(a, b))
    }

    #[inline(always)]
    fn min(self, a: [__m256; 2], b: [__m256; 2]) -> [__m256; 2] {
        Self::each(a, b, |a, b| self.0.min(a, b))
    }

    #[inline(always)]
    fn max(self, a: [__m256; 2], b: [__m256; 2]) -> [__m256; 2] {
        Self::each(a, b, |a, b| self.0.max(a, b))
    }

    #[inline(always)]
    fn at_most(self, a: [__m256; 2], b: [__m256; 2]) -> u32 {
        self.0.at_most(a[0], b[0]) | self.0.at_most(a[1], b[1]) << 8
    }
}

/// AVX-512, which the value proves to be there.
#[cfg(target_arch = "x86_64")]
impl Lanes<16> for V4 {
    type Row = __m512;

    #[inline(always)]
    fn nodes(self, tree: &Tree) -> Option<&[Node<16>]> {
        tree.nodes.sixteens()
    }

    #[inline(always)]
    fn splat(self, x: f32) -> __m512 {
        self.avx512f._mm512_set1_ps(x)
    }

    #[inline(always)]
    fn load(self, row: &[f32; 16]) -> __m512 {
        cast(*row)
    }

    #[inline(always)]
    fn array(self, a: __m512) -> [f32; 16] {
        cast(a)
    }

    #[inline(always)]
    fn mul_add(self, a: __m512, b: __m512, c: __m512) -> __m512 {
        self.avx512f._mm512_fmadd_ps(a, b, c)
    }

    #[inline(always)]
    fn mul(self, a: __m512, b: __m512) -> __m512 {
        self.avx512f._mm512_mul_ps(a, b)
    }

    #[inline(always)]
    fn min(self, a: __m512, b: __m512) -> __m512 {
        self.avx512f._mm512_min_ps(a, b)
    }

    #[inline(always)]
    fn max(self, a: __m512, b: __m512) -> __m512 {
        self.avx512f._mm512_max_ps(a, b)
    }

    #[inline(always)]
    fn at_most(self, a: __m512, b: __m512) -> u32 {
        u32::from(self.avx512f._mm512_cmp_ps_mask::<_CMP_LE_OQ>(a, b))
    }
}

/// Four lanes twice, with what every processor of its kind has: SSE2, NEON.
#[derive(Clone, Copy)]
pub(super) struct Halves;

impl Lanes<8> for Halves {
    type Row = [f32x4; 2];

    #[inline(always)]
    fn nodes(self, tree: &Tree) -> Option<&[Node<8>]> {
        tree.nodes.eights()
    }

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

    /// Bits of products, lesser and greater ones, and which are at most the others.
    type All<const W: usize> = ([[u32; W]; 3], u32);

    /// Everything that the walk does with two rows. The bits of what is not a number are nobody's business.
    fn all<L: Lanes<W>, const W: usize>(l: L, a: &[f32; W], b: &[f32; W]) -> All<W> {
        let (a, b) = (l.load(a), l.load(b));
        let known = |x: f32| if x.is_nan() { 0 } else { x.to_bits() };
        let bits = |x: L::Row| l.array(x).map(known);
        ([bits(l.mul(a, b)), bits(l.min(a, b)), bits(l.max(a, b))], l.at_most(a, b))
    }

    #[test]
    fn all_instruction_sets_compute_the_same_bits() {
        for (a, b) in ROWS.iter().flat_map(|a| ROWS.iter().map(move |b| (a, b))) {
            let narrow = all(Halves, a, b);
            let ordered: Vec<bool> = a.iter().zip(b).map(|(a, b)| a <= b).collect();
            let bits: Vec<bool> = (0..8).map(|lane| narrow.1 >> lane & 1 == 1).collect();
            assert_eq!(ordered, bits);
            if let Some(avx2) = V3::try_new() {
                assert_eq!(all(avx2, a, b), narrow, "{a:?} {b:?}");
            }
            if let Some(avx512) = V4::try_new() {
                // Two rows beside each other, and the other way round.
                let pairs = all(Pairs(*avx512), &cast([*a, *b]), &cast([*b, *a]));
                let (wide, back) =
                    (all(avx512, &cast([*a, *b]), &cast([*b, *a])), all(Halves, b, a));
                let both = [0, 1, 2].map(|k| cast::<_, [u32; 16]>([narrow.0[k], back.0[k]]));
                assert_eq!(wide, (both, narrow.1 | back.1 << 8), "{a:?} {b:?}");
                assert_eq!(pairs, wide, "{a:?} {b:?}");
            }
        }
    }
}

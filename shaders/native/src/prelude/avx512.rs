// Operations on sixteen lanes with AVX-512, those of `avx2.rs` one by one: masks have registers of their own, a bit a lane.

use core::arch::x86_64::*;
use glam::UVec4;

/// How many there are.
pub const LANES: usize = 16;

/// Sixteen `f32`.
#[derive(Clone, Copy, Debug)]
pub struct F(pub __m512);
/// Sixteen `u32`.
#[derive(Clone, Copy, Debug)]
pub struct U(pub __m512i);
/// Sixteen `i32`.
#[derive(Clone, Copy, Debug)]
pub struct I(pub __m512i);
/// Sixteen `bool`, a bit each; and the lanes that do something.
#[derive(Clone, Copy, Debug)]
pub struct B(pub __mmask16);

macro_rules! lanes {
    ($($(#[$doc:meta])* fn $name:ident($($arg:ident: $ty:ty),*) -> $out:ty $body:block)*) => {$(
        $(#[$doc])*
        #[inline]
        #[target_feature(enable = "avx512f,avx512bw,avx512cd,avx512dq,avx512vl,avx2,bmi1,bmi2,lzcnt,popcnt")]
        pub fn $name($($arg: $ty),*) -> $out $body
    )*};
}

lanes! {
    // The same in all lanes.
    fn f(x: f32) -> F { F(_mm512_set1_ps(x)) }
    fn u(x: u32) -> U { U(_mm512_set1_epi32(x as i32)) }
    fn i(x: i32) -> I { I(_mm512_set1_epi32(x)) }
    fn b(x: bool) -> B { B(if x { 0xffff } else { 0 }) }

    // Lanes in memory, and back.
    fn b_of(x: [bool; LANES]) -> B {
        let mut lanes = 0;
        for (k, x) in x.into_iter().enumerate() {
            lanes |= u16::from(x) << k;
        }
        B(lanes)
    }
    fn b_to(x: B) -> [bool; LANES] {
        let mut out = [false; LANES];
        for (k, out) in out.iter_mut().enumerate() {
            *out = x.0 >> k & 1 == 1;
        }
        out
    }

    // Masks.
    /// One bit a lane, the lowest first.
    fn bits(m: B) -> u32 { u32::from(m.0) }
    fn any(m: B) -> bool { m.0 != 0 }
    fn and_b(a: B, b: B) -> B { B(a.0 & b.0) }
    fn or_b(a: B, b: B) -> B { B(a.0 | b.0) }
    fn xor_b(a: B, b: B) -> B { B(a.0 ^ b.0) }
    fn not_b(a: B) -> B { B(!a.0) }
    /// `a` and not `b`.
    fn but_b(a: B, b: B) -> B { B(a.0 & !b.0) }
    fn eq_b(a: B, b: B) -> B { B(!(a.0 ^ b.0)) }

    // One or the other, lane by lane.
    fn select_f(m: B, yes: F, no: F) -> F { F(_mm512_mask_blend_ps(m.0, no.0, yes.0)) }
    fn select_u(m: B, yes: U, no: U) -> U { U(_mm512_mask_blend_epi32(m.0, no.0, yes.0)) }
    fn select_i(m: B, yes: I, no: I) -> I { I(_mm512_mask_blend_epi32(m.0, no.0, yes.0)) }
    fn select_b(m: B, yes: B, no: B) -> B { B(m.0 & yes.0 | !m.0 & no.0) }

    // Floats.
    fn add_f(a: F, b: F) -> F { F(_mm512_add_ps(a.0, b.0)) }
    fn sub_f(a: F, b: F) -> F { F(_mm512_sub_ps(a.0, b.0)) }
    fn mul_f(a: F, b: F) -> F { F(_mm512_mul_ps(a.0, b.0)) }
    fn div_f(a: F, b: F) -> F { F(_mm512_div_ps(a.0, b.0)) }
    fn neg_f(a: F) -> F { F(_mm512_xor_ps(a.0, _mm512_set1_ps(-0.0))) }
    fn abs_f(a: F) -> F { F(_mm512_andnot_ps(_mm512_set1_ps(-0.0), a.0)) }
    fn sqrt_f(a: F) -> F { F(_mm512_sqrt_ps(a.0)) }
    fn floor_f(a: F) -> F {
        F(_mm512_roundscale_ps::<{ _MM_FROUND_TO_NEG_INF | _MM_FROUND_NO_EXC }>(a.0))
    }
    fn ceil_f(a: F) -> F {
        F(_mm512_roundscale_ps::<{ _MM_FROUND_TO_POS_INF | _MM_FROUND_NO_EXC }>(a.0))
    }
    fn trunc_f(a: F) -> F {
        F(_mm512_roundscale_ps::<{ _MM_FROUND_TO_ZERO | _MM_FROUND_NO_EXC }>(a.0))
    }
    fn round_f(a: F) -> F {
        F(_mm512_roundscale_ps::<{ _MM_FROUND_TO_NEAREST_INT | _MM_FROUND_NO_EXC }>(a.0))
    }
    /// `b` if it is smaller, else `a`.
    fn min_f(a: F, b: F) -> F { F(_mm512_min_ps(b.0, a.0)) }
    /// `b` if it is larger, else `a`.
    fn max_f(a: F, b: F) -> F { F(_mm512_max_ps(b.0, a.0)) }
    /// `high` wins where they cross; not a number is `low`.
    fn clamp_f(x: F, low: F, high: F) -> F {
        F(_mm512_min_ps(_mm512_max_ps(x.0, low.0), high.0))
    }
    /// The least of all lanes.
    fn least_f(a: F) -> f32 {
        let (low, high) = (_mm512_castps512_ps256(a.0), _mm512_extractf32x8_ps::<1>(a.0));
        let eight = _mm256_min_ps(low, high);
        let four = _mm_min_ps(_mm256_castps256_ps128(eight), _mm256_extractf128_ps::<1>(eight));
        let pairs = _mm_min_ps(four, _mm_movehl_ps(four, four));
        _mm_cvtss_f32(_mm_min_ss(pairs, _mm_movehdup_ps(pairs)))
    }
    fn eq_f(a: F, b: F) -> B { B(_mm512_cmp_ps_mask::<_CMP_EQ_OQ>(a.0, b.0)) }
    fn ne_f(a: F, b: F) -> B { B(_mm512_cmp_ps_mask::<_CMP_NEQ_UQ>(a.0, b.0)) }
    fn lt_f(a: F, b: F) -> B { B(_mm512_cmp_ps_mask::<_CMP_LT_OQ>(a.0, b.0)) }
    fn le_f(a: F, b: F) -> B { B(_mm512_cmp_ps_mask::<_CMP_LE_OQ>(a.0, b.0)) }
    fn gt_f(a: F, b: F) -> B { B(_mm512_cmp_ps_mask::<_CMP_GT_OQ>(a.0, b.0)) }
    fn ge_f(a: F, b: F) -> B { B(_mm512_cmp_ps_mask::<_CMP_GE_OQ>(a.0, b.0)) }

    // Integers without a sign.
    fn add_u(a: U, b: U) -> U { U(_mm512_add_epi32(a.0, b.0)) }
    fn sub_u(a: U, b: U) -> U { U(_mm512_sub_epi32(a.0, b.0)) }
    fn mul_u(a: U, b: U) -> U { U(_mm512_mullo_epi32(a.0, b.0)) }
    fn and_u(a: U, b: U) -> U { U(_mm512_and_si512(a.0, b.0)) }
    fn or_u(a: U, b: U) -> U { U(_mm512_or_si512(a.0, b.0)) }
    fn xor_u(a: U, b: U) -> U { U(_mm512_xor_si512(a.0, b.0)) }
    fn not_u(a: U) -> U { U(_mm512_xor_si512(a.0, _mm512_set1_epi32(-1))) }
    fn shl_u(a: U, n: U) -> U {
        U(_mm512_sllv_epi32(a.0, _mm512_and_si512(n.0, _mm512_set1_epi32(31))))
    }
    fn shr_u(a: U, n: U) -> U {
        U(_mm512_srlv_epi32(a.0, _mm512_and_si512(n.0, _mm512_set1_epi32(31))))
    }
    fn min_u(a: U, b: U) -> U { U(_mm512_min_epu32(a.0, b.0)) }
    fn max_u(a: U, b: U) -> U { U(_mm512_max_epu32(a.0, b.0)) }
    fn eq_u(a: U, b: U) -> B { B(_mm512_cmpeq_epi32_mask(a.0, b.0)) }
    fn ne_u(a: U, b: U) -> B { B(_mm512_cmpneq_epi32_mask(a.0, b.0)) }
    fn ge_u(a: U, b: U) -> B { B(_mm512_cmpge_epu32_mask(a.0, b.0)) }
    fn le_u(a: U, b: U) -> B { B(_mm512_cmple_epu32_mask(a.0, b.0)) }
    fn gt_u(a: U, b: U) -> B { B(_mm512_cmpgt_epu32_mask(a.0, b.0)) }
    fn lt_u(a: U, b: U) -> B { B(_mm512_cmplt_epu32_mask(a.0, b.0)) }
    fn reverse_u(a: U) -> U {
        let low = _mm512_set1_epi32(0x0f0f_0f0f);
        let table = _mm512_broadcast_i32x4(_mm_setr_epi8(
            0, 8, 4, 12, 2, 10, 6, 14, 1, 9, 5, 13, 3, 11, 7, 15,
        ));
        let order = _mm512_broadcast_i32x4(_mm_setr_epi8(
            3, 2, 1, 0, 7, 6, 5, 4, 11, 10, 9, 8, 15, 14, 13, 12,
        ));
        let first = _mm512_shuffle_epi8(table, _mm512_and_si512(a.0, low));
        let high = _mm512_and_si512(_mm512_srli_epi32::<4>(a.0), low);
        let second = _mm512_shuffle_epi8(table, high);
        let bytes = _mm512_or_si512(_mm512_slli_epi32::<4>(first), second);
        U(_mm512_shuffle_epi8(bytes, order))
    }

    // Integers with a sign.
    fn add_i(a: I, b: I) -> I { I(_mm512_add_epi32(a.0, b.0)) }
    fn sub_i(a: I, b: I) -> I { I(_mm512_sub_epi32(a.0, b.0)) }
    fn mul_i(a: I, b: I) -> I { I(_mm512_mullo_epi32(a.0, b.0)) }
    fn neg_i(a: I) -> I { I(_mm512_sub_epi32(_mm512_setzero_si512(), a.0)) }
    fn abs_i(a: I) -> I { I(_mm512_abs_epi32(a.0)) }
    fn and_i(a: I, b: I) -> I { I(_mm512_and_si512(a.0, b.0)) }
    fn or_i(a: I, b: I) -> I { I(_mm512_or_si512(a.0, b.0)) }
    fn xor_i(a: I, b: I) -> I { I(_mm512_xor_si512(a.0, b.0)) }
    fn not_i(a: I) -> I { I(_mm512_xor_si512(a.0, _mm512_set1_epi32(-1))) }
    fn shr_i(a: I, n: U) -> I {
        I(_mm512_srav_epi32(a.0, _mm512_and_si512(n.0, _mm512_set1_epi32(31))))
    }
    fn min_i(a: I, b: I) -> I { I(_mm512_min_epi32(a.0, b.0)) }
    fn max_i(a: I, b: I) -> I { I(_mm512_max_epi32(a.0, b.0)) }
    fn eq_i(a: I, b: I) -> B { B(_mm512_cmpeq_epi32_mask(a.0, b.0)) }
    fn ne_i(a: I, b: I) -> B { B(_mm512_cmpneq_epi32_mask(a.0, b.0)) }
    fn gt_i(a: I, b: I) -> B { B(_mm512_cmpgt_epi32_mask(a.0, b.0)) }
    fn lt_i(a: I, b: I) -> B { B(_mm512_cmplt_epi32_mask(a.0, b.0)) }
    fn ge_i(a: I, b: I) -> B { B(_mm512_cmpge_epi32_mask(a.0, b.0)) }
    fn le_i(a: I, b: I) -> B { B(_mm512_cmple_epi32_mask(a.0, b.0)) }

    // From one kind to another.
    fn u_bits_f(a: F) -> U { U(_mm512_castps_si512(a.0)) }
    fn i_bits_f(a: F) -> I { I(_mm512_castps_si512(a.0)) }
    fn f_bits_u(a: U) -> F { F(_mm512_castsi512_ps(a.0)) }
    fn f_bits_i(a: I) -> F { F(_mm512_castsi512_ps(a.0)) }
    fn f_from_i(a: I) -> F { F(_mm512_cvtepi32_ps(a.0)) }
    fn f_from_u(a: U) -> F { F(_mm512_cvtepu32_ps(a.0)) }
    fn f_from_b(a: B) -> F { F(_mm512_maskz_mov_ps(a.0, _mm512_set1_ps(1.0))) }
    fn u_from_b(a: B) -> U { U(_mm512_maskz_set1_epi32(a.0, 1)) }
    fn i_from_b(a: B) -> I { I(_mm512_maskz_set1_epi32(a.0, 1)) }
    /// Towards zero; outside the range the nearest value that `f32` also holds; not a number is 0.
    fn i_from_f(a: F) -> I {
        let cut = _mm512_cvttps_epi32(a.0);
        let far = ge_f(a, f(2_147_483_648.0));
        let near = select_i(far, i(2_147_483_520), I(cut));
        I(_mm512_maskz_mov_epi32(eq_f(a, a).0, near.0))
    }
    /// As `i_from_f`.
    fn u_from_f(a: F) -> U {
        let far = ge_f(a, f(4_294_967_296.0));
        let near = select_u(far, u(4_294_967_040), U(_mm512_cvttps_epu32(a.0)));
        U(_mm512_maskz_mov_epi32(gt_f(a, f(0.0)).0, near.0))
    }

    /// The number of one lane; any one where there is no such lane.
    fn from_lane(x: U, lane: u32) -> u32 {
        let first = _mm512_permutexvar_epi32(_mm512_set1_epi32(lane as i32), x.0);
        _mm512_cvtsi512_si32(first) as u32
    }

    /// One of four words for each lane.
    fn word_f(row: [f32; 4], axis: U) -> F {
        let row: __m128 = bytemuck::cast(row);
        F(_mm512_permutevar_ps(_mm512_broadcast_f32x4(row), axis.0))
    }

    /// Turns four words a lane into a row for each lane: that of lane `k` is `[k % 4][k / 4]`.
    fn rows(a: V4<U>) -> [[[u32; 4]; LANES / 4]; 4] {
        let (xy, zw) = (_mm512_unpacklo_epi32(a.x.0, a.y.0), _mm512_unpacklo_epi32(a.z.0, a.w.0));
        let (high_xy, high_zw) =
            (_mm512_unpackhi_epi32(a.x.0, a.y.0), _mm512_unpackhi_epi32(a.z.0, a.w.0));
        bytemuck::cast([
            _mm512_unpacklo_epi64(xy, zw),
            _mm512_unpackhi_epi64(xy, zw),
            _mm512_unpacklo_epi64(high_xy, high_zw),
            _mm512_unpackhi_epi64(high_xy, high_zw),
        ])
    }

    /// Four rows, of which each is there.
    fn four(rows: &[[u32; 4]], at: [u32; 4]) -> __m512i {
        let row = |k: u32| rows.get(k as usize).copied().unwrap_or_default();
        let [a, b, c, d] = at.map(|k| -> __m128i { bytemuck::cast(row(k)) });
        let low = _mm256_inserti128_si256::<1>(_mm256_castsi128_si256(a), b);
        let high = _mm256_inserti128_si256::<1>(_mm256_castsi128_si256(c), d);
        _mm512_inserti64x4::<1>(_mm512_castsi256_si512(low), high)
    }
}

/// Elements that are not all the same.
#[inline(never)]
#[target_feature(enable = "avx512f,avx512bw,avx512cd,avx512dq,avx512vl,avx2,bmi1,bmi2,lzcnt,popcnt")]
fn gather(array: &[UVec4], index: U) -> V4<U> {
    let rows: &[[u32; 4]] = bytemuck::cast_slice(array);
    let Some(last) = rows.len().checked_sub(1) else { return at_same(array, 0) };
    let k = u_to(min_u(index, u(last as u32)));
    let a = four(rows, [k[0], k[4], k[8], k[12]]);
    let b = four(rows, [k[1], k[5], k[9], k[13]]);
    let c = four(rows, [k[2], k[6], k[10], k[14]]);
    let d = four(rows, [k[3], k[7], k[11], k[15]]);
    let (ab, cd) = (_mm512_unpacklo_epi32(a, b), _mm512_unpacklo_epi32(c, d));
    let (ef, gh) = (_mm512_unpackhi_epi32(a, b), _mm512_unpackhi_epi32(c, d));
    V4 {
        x: U(_mm512_unpacklo_epi64(ab, cd)),
        y: U(_mm512_unpackhi_epi64(ab, cd)),
        z: U(_mm512_unpacklo_epi64(ef, gh)),
        w: U(_mm512_unpackhi_epi64(ef, gh)),
    }
}

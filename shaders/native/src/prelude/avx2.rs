// Operations on eight lanes with AVX2. With `lanes.rs` this text is pasted into every such module as `mod v`. Each lane of
// each function has the bits of the scalar rule of WGSL; lanes that a mask leaves out are computed and not kept.
//
// No function is unsafe: the instruction set is that of the functions themselves, and who calls the first of them must
// know that the processor has it.

use core::arch::x86_64::*;
use glam::UVec4;

/// How many there are.
pub const LANES: usize = 8;

/// Eight `f32`.
#[derive(Clone, Copy, Debug)]
pub struct F(pub __m256);
/// Eight `u32`.
#[derive(Clone, Copy, Debug)]
pub struct U(pub __m256i);
/// Eight `i32`.
#[derive(Clone, Copy, Debug)]
pub struct I(pub __m256i);
/// Eight `bool`, each all ones or all zeros; and the lanes that do something.
#[derive(Clone, Copy, Debug)]
pub struct B(pub __m256i);

macro_rules! lanes {
    ($($(#[$doc:meta])* fn $name:ident($($arg:ident: $ty:ty),*) -> $out:ty $body:block)*) => {$(
        $(#[$doc])*
        #[inline]
        #[target_feature(enable = "avx2,fma,bmi1,bmi2,lzcnt,popcnt")]
        pub fn $name($($arg: $ty),*) -> $out $body
    )*};
}

lanes! {
    // The same in all lanes.
    fn f(x: f32) -> F { F(_mm256_set1_ps(x)) }
    fn u(x: u32) -> U { U(_mm256_set1_epi32(x as i32)) }
    fn i(x: i32) -> I { I(_mm256_set1_epi32(x)) }
    fn b(x: bool) -> B { B(_mm256_set1_epi32(-i32::from(x))) }

    // Lanes in memory, and back.
    fn b_of(x: [bool; LANES]) -> B {
        let mut lanes = [0_i32; LANES];
        for (lane, x) in lanes.iter_mut().zip(x) {
            *lane = -i32::from(x);
        }
        B(bytemuck::cast(lanes))
    }
    fn b_to(x: B) -> [bool; LANES] {
        let lanes: [i32; LANES] = bytemuck::cast(x.0);
        let mut out = [false; LANES];
        for (out, lane) in out.iter_mut().zip(lanes) {
            *out = lane != 0;
        }
        out
    }

    // Masks.
    /// One bit a lane, the lowest first.
    fn bits(m: B) -> u32 { _mm256_movemask_ps(_mm256_castsi256_ps(m.0)) as u32 }
    fn any(m: B) -> bool { _mm256_testz_si256(m.0, m.0) == 0 }
    fn and_b(a: B, b: B) -> B { B(_mm256_and_si256(a.0, b.0)) }
    fn or_b(a: B, b: B) -> B { B(_mm256_or_si256(a.0, b.0)) }
    fn xor_b(a: B, b: B) -> B { B(_mm256_xor_si256(a.0, b.0)) }
    fn not_b(a: B) -> B { B(_mm256_xor_si256(a.0, _mm256_set1_epi32(-1))) }
    /// `a` and not `b`.
    fn but_b(a: B, b: B) -> B { B(_mm256_andnot_si256(b.0, a.0)) }
    fn eq_b(a: B, b: B) -> B { B(_mm256_cmpeq_epi32(a.0, b.0)) }

    // One or the other, lane by lane. By bytes, floats too: a blend of words that is stored where its old value came
    // from becomes a masked store, which is slow on processors of AMD.
    fn select_f(m: B, yes: F, no: F) -> F {
        let (no, yes) = (_mm256_castps_si256(no.0), _mm256_castps_si256(yes.0));
        F(_mm256_castsi256_ps(_mm256_blendv_epi8(no, yes, m.0)))
    }
    fn select_u(m: B, yes: U, no: U) -> U { U(_mm256_blendv_epi8(no.0, yes.0, m.0)) }
    fn select_i(m: B, yes: I, no: I) -> I { I(_mm256_blendv_epi8(no.0, yes.0, m.0)) }
    fn select_b(m: B, yes: B, no: B) -> B { B(_mm256_blendv_epi8(no.0, yes.0, m.0)) }

    // Floats.
    fn add_f(a: F, b: F) -> F { F(_mm256_add_ps(a.0, b.0)) }
    fn sub_f(a: F, b: F) -> F { F(_mm256_sub_ps(a.0, b.0)) }
    fn mul_f(a: F, b: F) -> F { F(_mm256_mul_ps(a.0, b.0)) }
    fn div_f(a: F, b: F) -> F { F(_mm256_div_ps(a.0, b.0)) }
    fn neg_f(a: F) -> F { F(_mm256_xor_ps(a.0, _mm256_set1_ps(-0.0))) }
    fn abs_f(a: F) -> F { F(_mm256_andnot_ps(_mm256_set1_ps(-0.0), a.0)) }
    fn sqrt_f(a: F) -> F { F(_mm256_sqrt_ps(a.0)) }
    fn floor_f(a: F) -> F { F(_mm256_floor_ps(a.0)) }
    fn ceil_f(a: F) -> F { F(_mm256_ceil_ps(a.0)) }
    fn trunc_f(a: F) -> F {
        F(_mm256_round_ps::<{ _MM_FROUND_TO_ZERO | _MM_FROUND_NO_EXC }>(a.0))
    }
    fn round_f(a: F) -> F {
        F(_mm256_round_ps::<{ _MM_FROUND_TO_NEAREST_INT | _MM_FROUND_NO_EXC }>(a.0))
    }
    /// `b` if it is smaller, else `a`.
    fn min_f(a: F, b: F) -> F { F(_mm256_min_ps(b.0, a.0)) }
    /// `b` if it is larger, else `a`.
    fn max_f(a: F, b: F) -> F { F(_mm256_max_ps(b.0, a.0)) }
    /// `high` wins where they cross; not a number is `low`.
    fn clamp_f(x: F, low: F, high: F) -> F {
        F(_mm256_min_ps(_mm256_max_ps(x.0, low.0), high.0))
    }
    /// The least of all lanes.
    fn least_f(a: F) -> f32 {
        let halves = _mm_min_ps(_mm256_castps256_ps128(a.0), _mm256_extractf128_ps::<1>(a.0));
        let pairs = _mm_min_ps(halves, _mm_movehl_ps(halves, halves));
        _mm_cvtss_f32(_mm_min_ss(pairs, _mm_movehdup_ps(pairs)))
    }
    fn eq_f(a: F, b: F) -> B { B(_mm256_castps_si256(_mm256_cmp_ps::<_CMP_EQ_OQ>(a.0, b.0))) }
    fn ne_f(a: F, b: F) -> B { B(_mm256_castps_si256(_mm256_cmp_ps::<_CMP_NEQ_UQ>(a.0, b.0))) }
    fn lt_f(a: F, b: F) -> B { B(_mm256_castps_si256(_mm256_cmp_ps::<_CMP_LT_OQ>(a.0, b.0))) }
    fn le_f(a: F, b: F) -> B { B(_mm256_castps_si256(_mm256_cmp_ps::<_CMP_LE_OQ>(a.0, b.0))) }
    fn gt_f(a: F, b: F) -> B { B(_mm256_castps_si256(_mm256_cmp_ps::<_CMP_GT_OQ>(a.0, b.0))) }
    fn ge_f(a: F, b: F) -> B { B(_mm256_castps_si256(_mm256_cmp_ps::<_CMP_GE_OQ>(a.0, b.0))) }

    // Integers without a sign.
    fn add_u(a: U, b: U) -> U { U(_mm256_add_epi32(a.0, b.0)) }
    fn sub_u(a: U, b: U) -> U { U(_mm256_sub_epi32(a.0, b.0)) }
    fn mul_u(a: U, b: U) -> U { U(_mm256_mullo_epi32(a.0, b.0)) }
    fn and_u(a: U, b: U) -> U { U(_mm256_and_si256(a.0, b.0)) }
    fn or_u(a: U, b: U) -> U { U(_mm256_or_si256(a.0, b.0)) }
    fn xor_u(a: U, b: U) -> U { U(_mm256_xor_si256(a.0, b.0)) }
    fn not_u(a: U) -> U { U(_mm256_xor_si256(a.0, _mm256_set1_epi32(-1))) }
    fn shl_u(a: U, n: U) -> U {
        U(_mm256_sllv_epi32(a.0, _mm256_and_si256(n.0, _mm256_set1_epi32(31))))
    }
    fn shr_u(a: U, n: U) -> U {
        U(_mm256_srlv_epi32(a.0, _mm256_and_si256(n.0, _mm256_set1_epi32(31))))
    }
    fn min_u(a: U, b: U) -> U { U(_mm256_min_epu32(a.0, b.0)) }
    fn max_u(a: U, b: U) -> U { U(_mm256_max_epu32(a.0, b.0)) }
    fn eq_u(a: U, b: U) -> B { B(_mm256_cmpeq_epi32(a.0, b.0)) }
    fn ne_u(a: U, b: U) -> B { not_b(eq_u(a, b)) }
    fn ge_u(a: U, b: U) -> B { B(_mm256_cmpeq_epi32(_mm256_max_epu32(a.0, b.0), a.0)) }
    fn le_u(a: U, b: U) -> B { ge_u(b, a) }
    fn gt_u(a: U, b: U) -> B { not_b(ge_u(b, a)) }
    fn lt_u(a: U, b: U) -> B { not_b(ge_u(a, b)) }
    fn reverse_u(a: U) -> U {
        let low = _mm256_set1_epi32(0x0f0f_0f0f);
        let table = _mm256_setr_epi8(
            0, 8, 4, 12, 2, 10, 6, 14, 1, 9, 5, 13, 3, 11, 7, 15,
            0, 8, 4, 12, 2, 10, 6, 14, 1, 9, 5, 13, 3, 11, 7, 15,
        );
        let order = _mm256_setr_epi8(
            3, 2, 1, 0, 7, 6, 5, 4, 11, 10, 9, 8, 15, 14, 13, 12,
            3, 2, 1, 0, 7, 6, 5, 4, 11, 10, 9, 8, 15, 14, 13, 12,
        );
        let first = _mm256_shuffle_epi8(table, _mm256_and_si256(a.0, low));
        let high = _mm256_and_si256(_mm256_srli_epi32::<4>(a.0), low);
        let second = _mm256_shuffle_epi8(table, high);
        let bytes = _mm256_or_si256(_mm256_slli_epi32::<4>(first), second);
        U(_mm256_shuffle_epi8(bytes, order))
    }

    // Integers with a sign.
    fn add_i(a: I, b: I) -> I { I(_mm256_add_epi32(a.0, b.0)) }
    fn sub_i(a: I, b: I) -> I { I(_mm256_sub_epi32(a.0, b.0)) }
    fn mul_i(a: I, b: I) -> I { I(_mm256_mullo_epi32(a.0, b.0)) }
    fn neg_i(a: I) -> I { I(_mm256_sub_epi32(_mm256_setzero_si256(), a.0)) }
    fn abs_i(a: I) -> I { I(_mm256_abs_epi32(a.0)) }
    fn and_i(a: I, b: I) -> I { I(_mm256_and_si256(a.0, b.0)) }
    fn or_i(a: I, b: I) -> I { I(_mm256_or_si256(a.0, b.0)) }
    fn xor_i(a: I, b: I) -> I { I(_mm256_xor_si256(a.0, b.0)) }
    fn not_i(a: I) -> I { I(_mm256_xor_si256(a.0, _mm256_set1_epi32(-1))) }
    fn shr_i(a: I, n: U) -> I {
        I(_mm256_srav_epi32(a.0, _mm256_and_si256(n.0, _mm256_set1_epi32(31))))
    }
    fn min_i(a: I, b: I) -> I { I(_mm256_min_epi32(a.0, b.0)) }
    fn max_i(a: I, b: I) -> I { I(_mm256_max_epi32(a.0, b.0)) }
    fn eq_i(a: I, b: I) -> B { B(_mm256_cmpeq_epi32(a.0, b.0)) }
    fn ne_i(a: I, b: I) -> B { not_b(eq_i(a, b)) }
    fn gt_i(a: I, b: I) -> B { B(_mm256_cmpgt_epi32(a.0, b.0)) }
    fn lt_i(a: I, b: I) -> B { gt_i(b, a) }
    fn ge_i(a: I, b: I) -> B { not_b(gt_i(b, a)) }
    fn le_i(a: I, b: I) -> B { not_b(gt_i(a, b)) }

    // From one kind to another.
    fn u_bits_f(a: F) -> U { U(_mm256_castps_si256(a.0)) }
    fn i_bits_f(a: F) -> I { I(_mm256_castps_si256(a.0)) }
    fn f_bits_u(a: U) -> F { F(_mm256_castsi256_ps(a.0)) }
    fn f_bits_i(a: I) -> F { F(_mm256_castsi256_ps(a.0)) }
    fn f_from_i(a: I) -> F { F(_mm256_cvtepi32_ps(a.0)) }
    /// Both halves are exact, and their sum is rounded once.
    fn f_from_u(a: U) -> F {
        let high = _mm256_cvtepi32_ps(_mm256_srli_epi32::<16>(a.0));
        let low = _mm256_cvtepi32_ps(_mm256_and_si256(a.0, _mm256_set1_epi32(0xffff)));
        F(_mm256_add_ps(_mm256_mul_ps(high, _mm256_set1_ps(65_536.0)), low))
    }
    fn f_from_b(a: B) -> F {
        F(_mm256_and_ps(_mm256_castsi256_ps(a.0), _mm256_set1_ps(1.0)))
    }
    fn u_from_b(a: B) -> U { U(_mm256_srli_epi32::<31>(a.0)) }
    fn i_from_b(a: B) -> I { I(_mm256_srli_epi32::<31>(a.0)) }
    /// Towards zero; outside the range the nearest value that `f32` also holds; not a number is 0.
    fn i_from_f(a: F) -> I {
        let cut = _mm256_cvttps_epi32(a.0);
        let far = ge_f(a, f(2_147_483_648.0));
        let near = select_i(far, i(2_147_483_520), I(cut));
        I(_mm256_and_si256(near.0, eq_f(a, a).0))
    }
    /// As `i_from_f`.
    fn u_from_f(a: F) -> U {
        let high = ge_f(a, f(2_147_483_648.0));
        let less = select_f(high, sub_f(a, f(2_147_483_648.0)), a);
        let cut = _mm256_xor_si256(
            _mm256_cvttps_epi32(less.0),
            _mm256_and_si256(high.0, _mm256_set1_epi32(i32::MIN)),
        );
        let far = ge_f(a, f(4_294_967_296.0));
        let near = select_u(far, u(4_294_967_040), U(cut));
        U(_mm256_and_si256(near.0, gt_f(a, f(0.0)).0))
    }

    /// The number of one lane; any one where there is no such lane.
    fn from_lane(x: U, lane: u32) -> u32 {
        let first = _mm256_permutevar8x32_epi32(x.0, _mm256_set1_epi32(lane as i32));
        _mm256_cvtsi256_si32(first) as u32
    }

    /// One of four words for each lane.
    fn word_f(row: [f32; 4], axis: U) -> F {
        let row: __m128 = bytemuck::cast(row);
        F(_mm256_permutevar_ps(_mm256_set_m128(row, row), axis.0))
    }

    /// Turns four words a lane into a row for each lane: that of lane `k` is `[k % 4][k / 4]`.
    fn rows(a: V4<U>) -> [[[u32; 4]; LANES / 4]; 4] {
        let (xy, zw) = (_mm256_unpacklo_epi32(a.x.0, a.y.0), _mm256_unpacklo_epi32(a.z.0, a.w.0));
        let (high_xy, high_zw) =
            (_mm256_unpackhi_epi32(a.x.0, a.y.0), _mm256_unpackhi_epi32(a.z.0, a.w.0));
        bytemuck::cast([
            _mm256_unpacklo_epi64(xy, zw),
            _mm256_unpackhi_epi64(xy, zw),
            _mm256_unpacklo_epi64(high_xy, high_zw),
            _mm256_unpackhi_epi64(high_xy, high_zw),
        ])
    }

    /// Two rows, of which each is there.
    fn pair(rows: &[[u32; 4]], high: u32, low: u32) -> __m256i {
        match (rows.get(high as usize), rows.get(low as usize)) {
            (Some(high), Some(low)) => {
                _mm256_set_m128i(bytemuck::cast(*high), bytemuck::cast(*low))
            }
            _ => _mm256_setzero_si256(),
        }
    }
}

/// Elements that are not all the same.
#[inline(never)]
#[target_feature(enable = "avx2,fma,bmi1,bmi2,lzcnt,popcnt")]
fn gather(array: &[UVec4], index: U) -> V4<U> {
    let rows: &[[u32; 4]] = bytemuck::cast_slice(array);
    let Some(last) = rows.len().checked_sub(1) else { return at_same(array, 0) };
    let k = u_to(min_u(index, u(last as u32)));
    let a = pair(rows, k[4], k[0]);
    let b = pair(rows, k[5], k[1]);
    let c = pair(rows, k[6], k[2]);
    let d = pair(rows, k[7], k[3]);
    let (ab, cd) = (_mm256_unpacklo_epi32(a, b), _mm256_unpacklo_epi32(c, d));
    let (ef, gh) = (_mm256_unpackhi_epi32(a, b), _mm256_unpackhi_epi32(c, d));
    V4 {
        x: U(_mm256_unpacklo_epi64(ab, cd)),
        y: U(_mm256_unpackhi_epi64(ab, cd)),
        z: U(_mm256_unpacklo_epi64(ef, gh)),
        w: U(_mm256_unpackhi_epi64(ef, gh)),
    }
}

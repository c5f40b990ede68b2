// Generated from WGSL by the crate `native`. Do not edit.

/// WGSL's `f32`.
pub type Real = f32;
pub type Vec2 = glam::Vec2;
pub type Vec3 = glam::Vec3;
pub type Vec4 = glam::Vec4;
pub type Mat2 = glam::Mat2;
pub type Mat3 = glam::Mat3;
pub type Mat4 = glam::Mat4;
pub use glam::{BVec2, BVec3, BVec4, IVec2, IVec3, IVec4, UVec2, UVec3, UVec4};

#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Kernel_ {
    pub match_: u32,
    pub type_: u32,
    pub box_: Real,
    pub dyn_: Vec2,
}

impl Kernel_ {
    /// All members zero.
    pub const ZERO: Self = Kernel_ { match_: 0u32, type_: 0u32, box_: 0.0f32, dyn_: Vec2::ZERO };
}

impl Default for Kernel_ {
    fn default() -> Self {
        Self::ZERO
    }
}

#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Vec3_ {
    pub gen_: u32,
}

impl Vec3_ {
    /// All members zero.
    pub const ZERO: Self = Vec3_ { gen_: 0u32 };
}

impl Default for Vec3_ {
    fn default() -> Self {
        Self::ZERO
    }
}

pub const limit: u32 = 4u32;
pub const e1: u32 = 3u32;

/// What the kernel reads and writes, one member a WGSL resource.
pub struct Bindings<'a> {
    pub unused: core::marker::PhantomData<&'a ()>,
}

/// The resources and the private variables of one invocation after another.
pub struct Kernel<'a> {
    pub self_: u32,
    pub bindings: u32,
    pub unused: core::marker::PhantomData<&'a ()>,
}

impl<'a> Kernel<'a> {
    /// Binds the resources; the private variables get their initial values.
    pub fn new(bindings: Bindings<'a>) -> Self {
        Self {
            self_: 0u32,
            bindings: 2u32,
            unused: bindings.unused,
        }
    }

    /// WGSL line 12.
    #[inline]
    pub fn try_new(&mut self, in_: u32, box_: u32) -> u32 {
        let mut gen_: u32 = 0u32;
        let dyn_ = in_.wrapping_add(box_);
        gen_ = dyn_.wrapping_mul(2u32);
        return gen_;
    }

    /// WGSL line 18.
    #[inline]
    pub fn box_(&mut self, f64: u32) -> Kernel_ {
        let first_chunk = f64.min(limit);
        return Kernel_ { match_: first_chunk, type_: e1, box_: 3.0f32, dyn_: Vec2::splat(0.0f32) };
    }

    /// WGSL line 23.
    #[inline]
    pub fn shadows_constant(&mut self, x: u32) -> u32 {
        let limit_ = x.wrapping_add(1u32);
        let e1_ = limit_.wrapping_mul(2u32);
        return limit_.wrapping_add(e1_);
    }

    /// WGSL line 29.
    #[inline]
    pub fn vec3_of(&mut self, gen_: u32) -> Vec3_ {
        self.self_ = self.bindings;
        return Vec3_ { gen_: gen_.wrapping_add(self.self_) };
    }

    /// WGSL line 34.
    #[inline]
    pub fn none(&mut self) -> u32 {
        let mut None_: u32 = 1u32;
        None_ = None_.wrapping_add(1u32);
        let Ok_ = None_.wrapping_add(1u32);
        return None_.wrapping_mul(Ok_);
    }

    /// WGSL line 41.
    #[inline]
    pub fn render_(&mut self, at: UVec3) -> u32 {
        let e1_ = at.x;
        let e2 = at.y;
        let e3 = self.try_new(e1_, e2);
        return e3;
    }
}

mod wgsl {
use super::Real;

/// Element `i`; outside the array the last element; of an empty array `zero`.
#[inline(always)]
pub fn at<'s, T>(array: &'s [T], i: u32, zero: &'s T) -> &'s T {
    match array.get(i as usize) {
        Some(element) => element,
        None => last(array, zero),
    }
}

#[cold]
fn last<'s, T>(array: &'s [T], zero: &'s T) -> &'s T {
    array.last().unwrap_or(zero)
}

/// `b` if it is smaller, else `a`: what WGSL allows and one instruction does.
#[inline(always)]
pub fn min(a: Real, b: Real) -> Real {
    if b < a { b } else { a }
}

/// `b` if it is larger, else `a`.
#[inline(always)]
pub fn max(a: Real, b: Real) -> Real {
    if a < b { b } else { a }
}

/// `x` between `low` and `high`; `high` wins where they cross; NaN is `low`.
#[inline(always)]
pub fn clamp(x: Real, low: Real, high: Real) -> Real {
    let x = if low < x { x } else { low };
    if x < high { x } else { high }
}

/// -1, 0 or 1; 0 for both zeros and for NaN.
#[inline(always)]
pub fn sign(x: Real) -> Real {
    if x > 0.0 {
        1.0
    } else if x < 0.0 {
        -1.0
    } else {
        0.0
    }
}

/// `x` less the integer below it.
#[inline(always)]
pub fn fract(x: Real) -> Real {
    x - x.floor()
}

/// `a` at `t` 0, `b` at 1.
#[inline(always)]
pub fn mix(a: Real, b: Real, t: Real) -> Real {
    a * (1.0 - t) + b * t
}

/// 0 below `edge`, else 1.
#[inline(always)]
pub fn step(edge: Real, x: Real) -> Real {
    if edge <= x { 1.0 } else { 0.0 }
}

/// The cubic ramp from 0 at `low` to 1 at `high`.
#[inline(always)]
pub fn smoothstep(low: Real, high: Real, x: Real) -> Real {
    let t = clamp((x - low) / (high - low), 0.0, 1.0);
    t * (t * (3.0 - 2.0 * t))
}

/// Remainder of truncated division, rounded as WGSL defines it and not as `fmod` does.
#[inline(always)]
pub fn rem(a: Real, b: Real) -> Real {
    a - b * (a / b).trunc()
}

/// `x` times two to the power of `e`.
#[inline]
pub fn ldexp(x: Real, e: i32) -> Real {
    let e = e.clamp(-2000, 2000);
    let power = |e: i32| f64::from_bits(((e + 1023) as u64) << 52);
    (f64::from(x) * power(e / 2) * power(e - e / 2)) as Real
}

/// The fraction of `x`, in 0.5 <= |f| < 1, and its exponent.
#[inline]
pub fn frexp(x: Real) -> (Real, i32) {
    let wide = f64::from(x);
    if wide == 0.0 || !wide.is_finite() {
        return (x, 0);
    }
    let tiny = wide.abs() < f64::MIN_POSITIVE;
    let bits = if tiny { wide * 18_014_398_509_481_984.0 } else { wide }.to_bits();
    let exponent = ((bits >> 52) & 0x7ff) as i32 - 1022 - if tiny { 54 } else { 0 };
    let fraction = f64::from_bits((bits & !(0x7ff << 52)) | (1022 << 52));
    (fraction as Real, exponent)
}

/// To u32: towards zero; outside its range the nearest value that f32 also holds; NaN is 0.
#[inline(always)]
pub fn to_u32(x: Real) -> u32 {
    (x as u32).min(4_294_967_040)
}

/// To i32: towards zero; outside its range the nearest value that f32 also holds; NaN is 0.
#[inline(always)]
pub fn to_i32(x: Real) -> i32 {
    (x as i32).min(2_147_483_520)
}

/// Quotient; by zero the dividend.
#[inline(always)]
pub fn div_u32(a: u32, b: u32) -> u32 {
    if b == 0 { a } else { a / b }
}

/// Remainder; by zero 0.
#[inline(always)]
pub fn rem_u32(a: u32, b: u32) -> u32 {
    if b == 0 { 0 } else { a % b }
}

/// Quotient towards zero; by zero, and where it overflows, the dividend.
#[inline(always)]
pub fn div_i32(a: i32, b: i32) -> i32 {
    if b == 0 { a } else { a.wrapping_div(b) }
}

/// Remainder with the sign of the dividend; by zero, and where the quotient overflows, 0.
#[inline(always)]
pub fn rem_i32(a: i32, b: i32) -> i32 {
    if b == 0 { 0 } else { a.wrapping_rem(b) }
}

/// Position of the highest one; of 0 all ones.
#[inline(always)]
pub fn first_leading_u32(x: u32) -> u32 {
    if x == 0 { u32::MAX } else { 31 - x.leading_zeros() }
}

/// Position of the highest bit that differs from the sign; of 0 and -1, -1.
#[inline(always)]
pub fn first_leading_i32(x: i32) -> i32 {
    first_leading_u32((if x < 0 { !x } else { x }) as u32) as i32
}

/// Position of the lowest one; of 0 all ones.
#[inline(always)]
pub fn first_trailing_u32(x: u32) -> u32 {
    if x == 0 { u32::MAX } else { x.trailing_zeros() }
}

/// Position of the lowest one; of 0, -1.
#[inline(always)]
pub fn first_trailing_i32(x: i32) -> i32 {
    first_trailing_u32(x as u32) as i32
}

/// `count` bits from bit `offset` up, both cut to the width.
#[inline(always)]
pub fn extract_u32(x: u32, offset: u32, count: u32) -> u32 {
    let offset = offset.min(32);
    let count = count.min(32 - offset);
    if count == 0 { 0 } else { x << (32 - count - offset) >> (32 - count) }
}

/// As `extract_u32`, with the sign of the highest bit taken.
#[inline(always)]
pub fn extract_i32(x: i32, offset: u32, count: u32) -> i32 {
    let offset = offset.min(32);
    let count = count.min(32 - offset);
    if count == 0 { 0 } else { x << (32 - count - offset) >> (32 - count) }
}

/// `x` with `count` bits from `offset` up replaced by the low bits of `new`.
#[inline(always)]
pub fn insert_u32(x: u32, new: u32, offset: u32, count: u32) -> u32 {
    let offset = offset.min(32);
    let count = count.min(32 - offset);
    if count == 0 {
        return x;
    }
    let mask = (u32::MAX >> (32 - count)) << offset;
    (x & !mask) | ((new << offset) & mask)
}

/// As `insert_u32`.
#[inline(always)]
pub fn insert_i32(x: i32, new: i32, offset: u32, count: u32) -> i32 {
    insert_u32(x as u32, new as u32, offset, count) as i32
}

/// The bits of the nearest binary16, ties to even.
#[inline]
pub fn f16_from(x: f32) -> u32 {
    let bits = x.to_bits();
    let sign = (bits >> 16) & 0x8000;
    let magnitude = bits & 0x7fff_ffff;
    if magnitude > 0x7f80_0000 {
        return sign | 0x7e00;
    }
    if magnitude >= 0x4780_0000 {
        return sign | 0x7c00;
    }
    if magnitude < 0x3880_0000 {
        // Below the smallest normal: the addition rounds to a multiple of 2^-24.
        return sign | ((f32::from_bits(magnitude) + 0.5).to_bits() - 0x3f00_0000);
    }
    let odd = (magnitude >> 13) & 1;
    sign | ((magnitude - 0x3800_0000 + 0xfff + odd) >> 13)
}

/// The value of the binary16 in the low 16 bits.
#[inline]
pub fn f16_to(bits: u32) -> f32 {
    let sign = f32::from_bits(0x3f80_0000 | ((bits & 0x8000) << 16));
    let magnitude = bits & 0x7fff;
    if magnitude >= 0x7c00 {
        let quiet = if magnitude > 0x7c00 { 0x0040_0000 } else { 0 };
        f32::from_bits(((bits & 0x8000) << 16) | 0x7f80_0000 | quiet | ((magnitude & 0x3ff) << 13))
    } else if magnitude >= 0x400 {
        sign * f32::from_bits((magnitude << 13) + 0x3800_0000)
    } else {
        sign * (magnitude as f32 * (1.0 / 16_777_216.0))
    }
}

/// The nearest value that binary16 holds, those below its normal numbers taken for 0.
#[inline]
pub fn quantize_f16(x: Real) -> Real {
    let bits = f16_from(x as f32);
    if bits & 0x7c00 == 0 { 0.0 } else { Real::from(f16_to(bits)) }
}

/// `x` in -1..=1 as a signed integer with `scale` at 1, ties to even.
#[inline]
pub fn pack_snorm(x: Real, scale: Real) -> u32 {
    (clamp(x, -1.0, 1.0) * scale).round_ties_even() as i32 as u32
}

/// `x` in 0..=1 as an unsigned integer with `scale` at 1, ties to even.
#[inline]
pub fn pack_unorm(x: Real, scale: Real) -> u32 {
    (clamp(x, 0.0, 1.0) * scale).round_ties_even() as u32
}

/// Byte `lane` of `x`.
#[inline(always)]
pub fn byte_u32(x: u32, lane: u32) -> u32 {
    (x >> (8 * lane)) & 0xff
}

/// Byte `lane` of `x`, with its sign.
#[inline(always)]
pub fn byte_i32(x: u32, lane: u32) -> i32 {
    i32::from((x >> (8 * lane)) as i8)
}

/// Half `lane` of `x`, with its sign.
#[inline(always)]
pub fn half_i32(x: u32, lane: u32) -> i32 {
    i32::from((x >> (16 * lane)) as i16)
}

/// Four bytes as one word, lane 0 lowest.
#[inline(always)]
pub fn join_bytes(x: u32, y: u32, z: u32, w: u32) -> u32 {
    (x & 0xff) | ((y & 0xff) << 8) | ((z & 0xff) << 16) | (w << 24)
}
}

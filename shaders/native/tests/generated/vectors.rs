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

pub const AXIS: Vec3 = Vec3::new(0.1f32, 0.2f32, 0.3f32);

/// What the kernel reads and writes, one member a WGSL resource.
pub struct Bindings<'a> {
    pub unused: core::marker::PhantomData<&'a ()>,
}

/// The resources and the private variables of one invocation after another.
pub struct Kernel<'a> {
    pub unused: core::marker::PhantomData<&'a ()>,
}

impl<'a> Kernel<'a> {
    /// Binds the resources; the private variables get their initial values.
    pub fn new(bindings: Bindings<'a>) -> Self {
        Self {
            unused: bindings.unused,
        }
    }

    /// WGSL line 5.
    #[inline]
    pub fn zxy(&mut self, v: Vec3) -> Vec3 {
        return Vec3::new(v.z, v.x, v.y);
    }

    /// WGSL line 6.
    #[inline]
    pub fn xxz(&mut self, v: Vec3) -> Vec3 {
        return Vec3::new(v.x, v.x, v.z);
    }

    /// WGSL line 7.
    #[inline]
    pub fn wzyx(&mut self, v: Vec4) -> Vec4 {
        return Vec4::new(v.w, v.z, v.y, v.x);
    }

    /// WGSL line 8.
    #[inline]
    pub fn yzw(&mut self, v: UVec4) -> UVec3 {
        return UVec3::new(v.y, v.z, v.w);
    }

    /// WGSL line 9.
    #[inline]
    pub fn zw(&mut self, v: IVec4) -> IVec2 {
        return IVec2::new(v.z, v.w);
    }

    /// WGSL line 10.
    #[inline]
    pub fn yy(&mut self, v: BVec2) -> BVec4 {
        return BVec4::new(v.y, v.y, v.x, v.x);
    }

    /// WGSL line 11.
    #[inline]
    pub fn chained(&mut self, v: Vec4) -> Vec2 {
        return Vec2::new(v.w, v.z);
    }

    /// WGSL line 12.
    #[inline]
    pub fn of_sum(&mut self, v: Vec4) -> Vec2 {
        let e2 = v + Vec4::new(v.w, v.z, v.y, v.x);
        return Vec2::new(e2.w, e2.x);
    }

    /// WGSL line 13.
    #[inline]
    pub fn constant_swizzle(&mut self) -> Vec3 {
        return Vec3::new(0.3f32, 0.2f32, 0.1f32);
    }

    /// WGSL line 15.
    #[inline]
    pub fn composed(&mut self, a: Vec2, b: Real) -> Vec4 {
        return Vec4::new(b, a.x, a.y, b);
    }

    /// WGSL line 16.
    #[inline]
    pub fn from_pairs(&mut self, a: UVec2, b: UVec2) -> UVec4 {
        return UVec4::new(a.y, a.x, b.x, b.y);
    }

    /// WGSL line 17.
    #[inline]
    pub fn splat(&mut self, a: Real) -> Vec3 {
        return Vec3::splat(a);
    }

    /// WGSL line 19.
    #[inline]
    pub fn select_scalar(&mut self, f: Real, t: Real, c: bool) -> Real {
        return if c { t } else { f };
    }

    /// WGSL line 20.
    #[inline]
    pub fn select_whole(&mut self, f: Vec3, t: Vec3, c: bool) -> Vec3 {
        return if c { t } else { f };
    }

    /// WGSL line 21.
    #[inline]
    pub fn select_lanes(&mut self, f: Vec3, t: Vec3, c: BVec3) -> Vec3 {
        return Vec3::new(if c.x { t.x } else { f.x }, if c.y { t.y } else { f.y }, if c.z { t.z } else { f.z });
    }

    /// WGSL line 22.
    #[inline]
    pub fn select_less(&mut self, a: UVec4, b: UVec4) -> UVec4 {
        let e2 = BVec4::new(a.x < b.x, a.y < b.y, a.z < b.z, a.w < b.w);
        return UVec4::new(if e2.x { a.x } else { b.x }, if e2.y { a.y } else { b.y }, if e2.z { a.z } else { b.z }, if e2.w { a.w } else { b.w });
    }

    /// WGSL line 24.
    #[inline]
    pub fn less(&mut self, a: Vec3, b: Vec3) -> BVec3 {
        return BVec3::new(a.x < b.x, a.y < b.y, a.z < b.z);
    }

    /// WGSL line 25.
    #[inline]
    pub fn equal(&mut self, a: Vec4, b: Vec4) -> BVec4 {
        return BVec4::new(a.x == b.x, a.y == b.y, a.z == b.z, a.w == b.w);
    }

    /// WGSL line 26.
    #[inline]
    pub fn any_all(&mut self, v: BVec3) -> u32 {
        return (if v.any() { 1u32 } else { 0u32 }).wrapping_add(if v.all() { 2u32 } else { 0u32 }).wrapping_add(if v.x { 4u32 } else { 0u32 }).wrapping_add(if (!v).all() { 8u32 } else { 0u32 });
    }

    /// WGSL line 29.
    #[inline]
    pub fn bools(&mut self, a: BVec2, b: BVec2) -> BVec2 {
        return (a & b) | (!a);
    }

    /// WGSL line 31.
    #[inline]
    pub fn arithmetic(&mut self, a: Vec3, b: Vec3, s: Real) -> Vec3 {
        return ((a + (b * s)) / (Vec3::splat(s) - b)) - ((s * a) / Vec3::splat(s));
    }

    /// WGSL line 34.
    #[inline]
    pub fn negated(&mut self, a: Vec4) -> Vec4 {
        return -a;
    }

    /// WGSL line 35.
    #[inline]
    pub fn remainder(&mut self, a: Real, b: Real) -> Real {
        return wgsl::rem(a, b);
    }

    /// WGSL line 36.
    #[inline]
    pub fn remainder_v(&mut self, a: Vec2, b: Real) -> Vec2 {
        return Vec2::new(wgsl::rem(a.x, b), wgsl::rem(a.y, b));
    }

    /// WGSL line 38.
    #[inline]
    pub fn dot3(&mut self, a: Vec3, b: Vec3) -> Real {
        return a.x * b.x + a.y * b.y + a.z * b.z;
    }

    /// WGSL line 39.
    #[inline]
    pub fn dot4(&mut self, a: Vec4, b: Vec4) -> Real {
        return a.x * b.x + a.y * b.y + a.z * b.z + a.w * b.w;
    }

    /// WGSL line 40.
    #[inline]
    pub fn cross3(&mut self, a: Vec3, b: Vec3) -> Vec3 {
        return Vec3::new(a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x);
    }

    /// WGSL line 41.
    #[inline]
    pub fn length3(&mut self, a: Vec3) -> Real {
        return (a.x * a.x + a.y * a.y + a.z * a.z).sqrt();
    }

    /// WGSL line 42.
    #[inline]
    pub fn length1(&mut self, a: Real) -> Real {
        return a.abs();
    }

    /// WGSL line 43.
    #[inline]
    pub fn distance3(&mut self, a: Vec3, b: Vec3) -> Real {
        let t1 = a - b;
        return (t1.x * t1.x + t1.y * t1.y + t1.z * t1.z).sqrt();
    }

    /// WGSL line 44.
    #[inline]
    pub fn normalize3(&mut self, a: Vec3) -> Vec3 {
        return a / (a.x * a.x + a.y * a.y + a.z * a.z).sqrt();
    }

    /// WGSL line 45.
    #[inline]
    pub fn reflected(&mut self, a: Vec3, n: Vec3) -> Vec3 {
        return a - n * (2.0 * (n.x * a.x + n.y * a.y + n.z * a.z));
    }

    /// WGSL line 46.
    #[inline]
    pub fn refracted(&mut self, a: Vec3, n: Vec3, eta: Real) -> Vec3 {
        let t1 = n.x * a.x + n.y * a.y + n.z * a.z;
        let t2 = 1.0 - eta * (eta * (1.0 - t1 * t1));
        return if t2 < 0.0 { Vec3::ZERO } else { a * eta - n * (eta * t1 + t2.sqrt()) };
    }

    /// WGSL line 47.
    #[inline]
    pub fn facing(&mut self, n: Vec3, i: Vec3, r: Vec3) -> Vec3 {
        return if i.x * r.x + i.y * r.y + i.z * r.z < 0.0 { n } else { -n };
    }

    /// WGSL line 49.
    #[inline]
    pub fn mat_vec(&mut self, v: Vec3) -> Vec3 {
        let t1 = Mat3::from_cols(Vec3::new(1.0f32, 2.0f32, 3.0f32), Vec3::new(4.0f32, 5.0f32, 6.0f32), Vec3::new(7.0f32, 8.0f32, 9.5f32));
        return t1.z_axis * v.z + t1.y_axis * v.y + t1.x_axis * v.x;
    }

    /// WGSL line 53.
    #[inline]
    pub fn vec_mat(&mut self, v: Vec2) -> Vec2 {
        let t1 = Mat2::from_cols(Vec2::new(1.0f32, 2.0f32), Vec2::new(3.0f32, 4.0f32));
        return Vec2::new(v.x * t1.x_axis.x + v.y * t1.x_axis.y, v.x * t1.y_axis.x + v.y * t1.y_axis.y);
    }

    /// WGSL line 57.
    #[inline]
    pub fn mat_mat(&mut self, a: Mat2, b: Mat2) -> Mat2 {
        return Mat2::from_cols(a.y_axis * b.x_axis.y + a.x_axis * b.x_axis.x, a.y_axis * b.y_axis.y + a.x_axis * b.y_axis.x);
    }

    /// WGSL line 58.
    #[inline]
    pub fn mat_scaled(&mut self, a: Mat4, s: Real) -> Mat4 {
        let e2 = Mat4::from_cols(a.x_axis * s, a.y_axis * s, a.z_axis * s, a.w_axis * s);
        let e3 = Mat4::from_cols(e2.x_axis + a.x_axis, e2.y_axis + a.y_axis, e2.z_axis + a.z_axis, e2.w_axis + a.w_axis);
        let e4 = Mat4::from_cols(a.x_axis * s, a.y_axis * s, a.z_axis * s, a.w_axis * s);
        return Mat4::from_cols(e3.x_axis - e4.x_axis, e3.y_axis - e4.y_axis, e3.z_axis - e4.z_axis, e3.w_axis - e4.w_axis);
    }

    /// WGSL line 59.
    #[inline]
    pub fn mat_column(&mut self, a: Mat4, i: u32) -> Vec4 {
        return a.col((i as usize).min(3));
    }

    /// WGSL line 60.
    #[inline]
    pub fn mat_entry(&mut self, a: Mat3) -> Real {
        let e1 = a.z_axis;
        let e5 = a.x_axis;
        return (e1.x * 10.0f32) + e5.z;
    }

    /// WGSL line 61.
    #[inline]
    pub fn affine(&mut self, p: Vec3) -> Vec3 {
        let t1 = [Vec3::new(1.0f32, 0.0f32, 0.0f32), Vec3::new(0.0f32, 2.0f32, 0.0f32), Vec3::new(0.0f32, 0.0f32, 3.0f32), Vec3::new(10.0f32, 20.0f32, 30.0f32)];
        let e19 = Vec4::new(p.x, p.y, p.z, 1.0f32);
        return t1[3] * e19.w + t1[2] * e19.z + t1[1] * e19.y + t1[0] * e19.x;
    }

    /// WGSL line 65.
    #[inline]
    pub fn affine_transposed(&mut self, p: Vec3) -> Vec4 {
        let mut m: [Vec4; 3] = [Vec4::ZERO; 3];
        let t1 = [Vec3::new(1.0f32, 0.0f32, 0.0f32), Vec3::new(0.0f32, 2.0f32, 0.0f32), Vec3::new(0.0f32, 0.0f32, 3.0f32), Vec3::new(10.0f32, 20.0f32, 30.0f32)];
        m = [Vec4::new(t1[0].x, t1[1].x, t1[2].x, t1[3].x), Vec4::new(t1[0].y, t1[1].y, t1[2].y, t1[3].y), Vec4::new(t1[0].z, t1[1].z, t1[2].z, t1[3].z)];
        m[1].w = 25.0f32;
        let e23 = m;
        return e23[2] * p.z + e23[1] * p.y + e23[0] * p.x;
    }

    /// WGSL line 70.
    #[inline]
    pub fn determinant3(&mut self, m: Mat3) -> Real {
        return m.x_axis.x * (m.y_axis.y * m.z_axis.z - m.y_axis.z * m.z_axis.y) + m.x_axis.y * (m.y_axis.z * m.z_axis.x - m.y_axis.x * m.z_axis.z) + m.x_axis.z * (m.y_axis.x * m.z_axis.y - m.y_axis.y * m.z_axis.x);
    }

    /// WGSL line 71.
    #[inline]
    pub fn transposed(&mut self, m: Mat3) -> Mat3 {
        return Mat3::from_cols(Vec3::new(m.x_axis.x, m.y_axis.x, m.z_axis.x), Vec3::new(m.x_axis.y, m.y_axis.y, m.z_axis.y), Vec3::new(m.x_axis.z, m.y_axis.z, m.z_axis.z));
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

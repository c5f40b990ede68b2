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


/// What the kernel reads and writes, one member a WGSL resource.
pub struct Bindings<'a> {
    pub unused: core::marker::PhantomData<&'a ()>,
}

/// The resources and the private variables of one invocation after another.
pub struct Kernel<'a> {
    pub trace: u32,
    pub unused: core::marker::PhantomData<&'a ()>,
}

impl<'a> Kernel<'a> {
    /// Binds the resources; the private variables get their initial values.
    pub fn new(bindings: Bindings<'a>) -> Self {
        Self {
            trace: 0u32,
            unused: bindings.unused,
        }
    }

    /// WGSL line 5.
    #[inline]
    pub fn note(&mut self, digit: u32) -> bool {
        self.trace = self.trace.wrapping_mul(10u32).wrapping_add(digit);
        return digit > 4u32;
    }

    /// WGSL line 11.
    #[inline]
    pub fn break_in_switch(&mut self, n: u32) -> u32 {
        let mut sum: u32 = 0u32;
        let mut i: u32 = 0u32;
        'repeat1: loop {
            if !(i < n) {
                break 'repeat1;
            }
            {
                'switch2: {
                    match i {
                        1u32 => {
                            if i == 1u32 {
                                break 'switch2;
                            }
                            sum = sum.wrapping_add(1000u32);
                        }
                        2u32 | 3u32 => {
                            sum = sum.wrapping_add(10u32);
                        }
                        _ => {
                            sum = sum.wrapping_add(1u32);
                        }
                    }
                }
                sum = sum.wrapping_add(100u32);
            }
            i = i.wrapping_add(1u32);
        }
        return sum;
    }

    /// WGSL line 27.
    #[inline]
    pub fn switch_default_first(&mut self, x: i32) -> i32 {
        match x {
            -7i32 => {
                return 1i32;
            }
            3i32 => {
                return 2i32;
            }
            _ => {
                return 0i32;
            }
        }
    }

    /// WGSL line 35.
    #[inline]
    pub fn switch_default_shared(&mut self, x: u32) -> u32 {
        let mut r: u32 = 7u32;
        match x {
            4u32 => {
                r = 1u32;
            }
            _ => {
                r = 2u32;
            }
        }
        return r;
    }

    /// WGSL line 45.
    #[inline]
    pub fn continue_in_switch(&mut self, n: u32) -> u32 {
        let mut sum: u32 = 0u32;
        let mut i: u32 = 0u32;
        'repeat1: loop {
            'next2: {
                if !(i < n) {
                    break 'repeat1;
                }
                {
                    match wgsl::rem_u32(i, 3u32) {
                        0u32 => {
                            break 'next2;
                        }
                        _ => {
                        }
                    }
                    sum = sum.wrapping_add(i);
                }
            }
            i = i.wrapping_add(1u32);
        }
        return sum;
    }

    /// WGSL line 57.
    #[inline]
    pub fn continue_runs_continuing(&mut self, n: u32) -> u32 {
        let mut i: u32 = 0u32;
        let mut odd: u32 = 0u32;
        'repeat1: loop {
            let mut next: u32 = 0u32;
            'next2: {
                if i >= n {
                    break 'repeat1;
                }
                next = i.wrapping_add(1u32);
                if wgsl::rem_u32(i, 2u32) == 0u32 {
                    break 'next2;
                }
                odd = odd.wrapping_add(i);
            }
            i = next;
        }
        return odd;
    }

    /// WGSL line 70.
    #[inline]
    pub fn break_if(&mut self, n: i32) -> i32 {
        let mut i: i32 = 0i32;
        let mut sum: i32 = 0i32;
        'repeat1: loop {
            'next2: {
                sum = sum.wrapping_add(i);
                if sum == 3i32 {
                    break 'next2;
                }
                sum = sum.wrapping_add(100i32);
            }
            i = i.wrapping_add(1i32);
            let e18 = i >= n;
            if e18 {
                break 'repeat1;
            }
        }
        return sum;
    }

    /// WGSL line 85.
    #[inline]
    pub fn nested_loops(&mut self, n: u32) -> u32 {
        let mut count: u32 = 0u32;
        let mut i: u32 = 0u32;
        let mut j: u32 = 0u32;
        let mut k: u32 = 0u32;
        'repeat1: loop {
            if !(i < n) {
                break 'repeat1;
            }
            {
                j = 0u32;
                'repeat2: loop {
                    'next3: {
                        if !(j < n) {
                            break 'repeat2;
                        }
                        {
                            if j > i {
                                break 'repeat2;
                            }
                            if wgsl::rem_u32(i.wrapping_add(j), 2u32) == 1u32 {
                                break 'next3;
                            }
                            k = 0u32;
                            'repeat4: loop {
                                if !(true) {
                                    break 'repeat4;
                                }
                                {
                                    k = k.wrapping_add(1u32);
                                    if k == 3u32 {
                                        break 'repeat4;
                                    }
                                }
                            }
                            count = count.wrapping_add(k);
                        }
                    }
                    j = j.wrapping_add(1u32);
                }
                count = count.wrapping_add(100u32);
            }
            i = i.wrapping_add(1u32);
        }
        return count;
    }

    /// WGSL line 103.
    #[inline]
    pub fn while_loop(&mut self, start: u32) -> u32 {
        let mut x: u32 = 0u32;
        let mut steps: u32 = 0u32;
        let mut local: bool = false;
        x = start;
        'repeat1: loop {
            if x != 1u32 {
                local = steps < 200u32;
            } else {
                local = false;
            }
            if !(local) {
                break 'repeat1;
            }
            {
                x = if wgsl::rem_u32(x, 2u32) == 0u32 { wgsl::div_u32(x, 2u32) } else { 3u32.wrapping_mul(x).wrapping_add(1u32) };
                steps = steps.wrapping_add(1u32);
            }
        }
        return steps;
    }

    /// WGSL line 113.
    #[inline]
    pub fn early_return(&mut self, values: [u32; 4], wanted: u32) -> i32 {
        let mut i: i32 = 0i32;
        'repeat1: loop {
            if !(i < 4i32) {
                break 'repeat1;
            }
            {
                if values[(i as usize).min(3)] == wanted {
                    return i;
                }
            }
            i = i.wrapping_add(1i32);
        }
        return -1i32;
    }

    /// WGSL line 121.
    #[inline]
    pub fn zeroed_in_loop(&mut self, n: u32) -> u32 {
        let mut last: u32 = 0u32;
        let mut i: u32 = 0u32;
        let mut fresh: u32 = 0u32;
        let mut list: [u32; 3] = [0u32; 3];
        'repeat1: loop {
            if !(i < n) {
                break 'repeat1;
            }
            {
                fresh = 0u32;
                list = [0u32; 3];
                fresh = fresh.wrapping_add(1u32);
                let e16 = wgsl::rem_u32(i, 3u32);
                if (e16 as usize) < 3 {
                    list[e16 as usize] = list[(e16 as usize).min(2)].wrapping_add(fresh);
                }
                last = fresh.wrapping_mul(10u32).wrapping_add(list[0]).wrapping_add(list[1]).wrapping_add(list[2]);
            }
            i = i.wrapping_add(1u32);
        }
        return last;
    }

    /// WGSL line 133.
    #[inline]
    pub fn and_evaluates_left_first(&mut self, a: u32, b: u32) -> u32 {
        let mut local: bool = false;
        self.trace = 0u32;
        let e4 = self.note(a);
        if e4 {
            let e7 = self.note(b);
            local = e7;
        } else {
            local = false;
        }
        if local {
            return self.trace.wrapping_add(1000u32);
        }
        return self.trace;
    }

    /// WGSL line 139.
    #[inline]
    pub fn or_evaluates_left_first(&mut self, a: u32, b: u32) -> u32 {
        let mut local: bool = false;
        self.trace = 0u32;
        let e4 = self.note(a);
        if !e4 {
            let e8 = self.note(b);
            local = e8;
        } else {
            local = true;
        }
        if local {
            return self.trace.wrapping_add(1000u32);
        }
        return self.trace;
    }

    /// WGSL line 146.
    #[inline]
    pub fn load_before_store(&mut self) -> u32 {
        let mut x: u32 = 1u32;
        let before = x;
        x = 5u32;
        let after = x;
        x = before;
        return before.wrapping_mul(100u32).wrapping_add(after.wrapping_mul(10u32)).wrapping_add(x);
    }

    /// WGSL line 155.
    #[inline]
    pub fn call_between_loads(&mut self) -> u32 {
        self.trace = 3u32;
        let before = self.trace;
        let high = self.note(9u32);
        let after = self.trace;
        return before.wrapping_mul(1000u32).wrapping_add(after).wrapping_add(if high { 500u32 } else { 0u32 });
    }

    /// WGSL line 163.
    #[inline]
    pub fn else_if_chain(&mut self, x: Real) -> u32 {
        if x < 0.0f32 {
            return 0u32;
        } else {
            if x < 1.0f32 {
                return 1u32;
            } else {
                if x < 2.0f32 {
                    return 2u32;
                }
            }
        }
        return 3u32;
    }

    /// WGSL line 168.
    #[inline]
    pub fn only_else(&mut self, x: bool) -> u32 {
        let mut r: u32 = 1u32;
        if !(x) {
            r = 2u32;
        }
        return r;
    }

    /// WGSL line 174.
    #[inline]
    pub fn shadowed(&mut self, x: u32) -> u32 {
        let mut y: u32 = 0u32;
        let mut y_: u32 = 7u32;
        y = x;
        {
            y_ = y_.wrapping_add(1u32);
            {
            }
        }
        let z = y.wrapping_add(1u32);
        {
            y = y.wrapping_add(9u32);
        }
        return y.wrapping_add(z);
    }

    /// WGSL line 187.
    #[inline]
    pub fn deep(&mut self, n: u32) -> u32 {
        let mut sum: u32 = 0u32;
        let mut i: u32 = 0u32;
        let mut seen: [u32; 4] = [0u32, 0u32, 0u32, 0u32];
        let mut k: u32 = 0u32;
        'repeat1: loop {
            let mut e15: u32 = 0u32;
            let mut step: u32 = 0u32;
            'next2: {
                if i >= n {
                    break 'repeat1;
                }
                e15 = wgsl::rem_u32(i, 4u32);
                step = i.wrapping_add(1u32);
                'switch3: {
                    match wgsl::rem_u32(i, 4u32) {
                        0u32 | 1u32 => {
                            'switch4: {
                                match wgsl::rem_u32(i, 2u32) {
                                    0u32 => {
                                        if i > 4u32 {
                                            break 'switch4;
                                        }
                                        sum = sum.wrapping_add(1u32);
                                        break 'next2;
                                    }
                                    _ => {
                                        sum = sum.wrapping_add(10u32);
                                        break 'switch4;
                                    }
                                }
                            }
                            sum = sum.wrapping_add(100u32);
                        }
                        2u32 => {
                            break 'next2;
                        }
                        _ => {
                            if i == 7u32 {
                                break 'switch3;
                            }
                            sum = sum.wrapping_add(1000u32);
                        }
                    }
                }
                sum = sum.wrapping_add(10000u32);
            }
            k = 0u32;
            'repeat5: loop {
                if !(k < step) {
                    break 'repeat5;
                }
                {
                    if k == 2u32 {
                        break 'repeat5;
                    }
                    if (e15 as usize) < 4 {
                        seen[e15 as usize] = seen[(e15 as usize).min(3)].wrapping_add(1u32);
                    }
                }
                k = k.wrapping_add(1u32);
            }
            i = step;
        }
        return sum.wrapping_add(1000000u32.wrapping_mul(seen[0].wrapping_add(seen[1]).wrapping_add(seen[2]).wrapping_add(seen[3])));
    }

    /// WGSL line 218.
    #[inline]
    pub fn loops_and_returns(&mut self, n: u32) -> u32 {
        let mut a: u32 = 0u32;
        let mut b: u32 = 0u32;
        let mut c: u32 = 0u32;
        a = n;
        'repeat1: loop {
            'next2: {
                if !(a > 0u32) {
                    break 'repeat1;
                }
                {
                    c = a;
                    'repeat3: loop {
                        if c < 3u32 {
                            break 'repeat3;
                        }
                        c = c.wrapping_sub(3u32);
                        b = b.wrapping_add(1u32);
                        if b > 50u32 {
                            return 1000u32.wrapping_add(a);
                        }
                    }
                    if c == 1u32 {
                        break 'next2;
                    }
                    b = b.wrapping_add(100u32.wrapping_mul(c));
                }
            }
            a = wgsl::div_u32(a, 2u32);
        }
        return b;
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

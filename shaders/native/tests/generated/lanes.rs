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
pub struct Pair {
    pub a: Real,
    pub n: u32,
    pub v: Vec3,
    pub odd: bool,
}

impl Pair {
    /// All members zero.
    pub const ZERO: Self = Pair { a: 0.0f32, n: 0u32, v: Vec3::ZERO, odd: false };
}

impl Default for Pair {
    fn default() -> Self {
        Self::ZERO
    }
}

#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Pairs {
    pub first: Pair,
    pub second: Pair,
}

impl Pairs {
    /// All members zero.
    pub const ZERO: Self = Pairs { first: Pair::ZERO, second: Pair::ZERO };
}

impl Default for Pairs {
    fn default() -> Self {
        Self::ZERO
    }
}


/// What the kernel reads and writes, one member a WGSL resource.
pub struct Bindings<'a> {
    pub given: &'a [UVec4],
    pub found: &'a mut [UVec4],
}

/// The resources and the private variables of one invocation after another.
pub struct Kernel<'a> {
    pub given: &'a [UVec4],
    pub found: &'a mut [UVec4],
}

impl<'a> Kernel<'a> {
    /// Binds the resources; the private variables get their initial values.
    pub fn new(bindings: Bindings<'a>) -> Self {
        Self {
            given: bindings.given,
            found: bindings.found,
        }
    }

    pub fn main(&mut self, id: UVec3) {
        let given = self.given;
        let i = id.x;
        let word = *wgsl::at(given, i as u32, &UVec4::ZERO);
        let x = f32::from_bits(word.z);
        let y = f32::from_bits(word.w);
        if word.x == 77u32 {
            return;
        }
        let at = i.wrapping_mul(10u32);
        let e16 = word.x;
        let e19 = wgsl::rem_u32(word.y, 9u32);
        let e20 = self.parting(e16, e19);
        let e23 = wgsl::rem_u32(word.x, 9u32);
        let e24 = self.turns(e23);
        let e25 = word.x;
        let e26 = self.anew(e25);
        let e27 = word.y;
        let e28 = self.kept(e27);
        if (at as usize) < self.found.len() {
            self.found[at as usize] = UVec4::new(e20, e24, e26, e28);
        }
        let e32 = at.wrapping_add(1u32);
        let e34 = self.guarded(x);
        let e35 = e34.to_bits();
        let e36 = self.guarded(y);
        if (e32 as usize) < self.found.len() {
            self.found[e32 as usize] = UVec4::new(e35, e36.to_bits(), i, 0u32);
        }
        let e42 = at.wrapping_add(2u32);
        let e44 = word.x;
        let e45 = self.pointed(x, e44);
        if (e42 as usize) < self.found.len() {
            self.found[e42 as usize] = UVec4::new(e45.x.to_bits(), e45.y.to_bits(), e45.z.to_bits(), e45.w.to_bits());
        }
        let e49 = at.wrapping_add(3u32);
        let e52 = word.y as i32;
        let e53 = self.indexed(e52, x);
        if (e49 as usize) < self.found.len() {
            self.found[e49 as usize] = UVec4::new(e53.x.to_bits(), e53.y.to_bits(), e53.z.to_bits(), e53.w.to_bits());
        }
        let e57 = at.wrapping_add(4u32);
        let e59 = word.x;
        let e61 = word.y as i32;
        let e62 = self.integers(e59, e61);
        if (e57 as usize) < self.found.len() {
            self.found[e57 as usize] = e62;
        }
        let e65 = at.wrapping_add(5u32);
        let e67 = self.floats(x, y);
        if (e65 as usize) < self.found.len() {
            self.found[e65 as usize] = UVec4::new(e67.x.to_bits(), e67.y.to_bits(), e67.z.to_bits(), e67.w.to_bits());
        }
        let e71 = at.wrapping_add(6u32);
        let e73 = word.y;
        let e74 = self.conversions(e73, x);
        if (e71 as usize) < self.found.len() {
            self.found[e71 as usize] = e74;
        }
        let e77 = at.wrapping_add(7u32);
        let e84 = *wgsl::at(given, 3, &UVec4::ZERO);
        if (e77 as usize) < self.found.len() {
            self.found[e77 as usize] = (*wgsl::at(given, 2, &UVec4::ZERO)).wrapping_add(UVec4::new(e84.w, e84.z, e84.y, e84.x));
        }
        let e89 = at.wrapping_add(8u32);
        let e93 = i ^ word.x;
        let e99 = wgsl::rem_u32(word.x, 11u32);
        if (e89 as usize) < self.found.len() {
            self.found[e89 as usize] = (*wgsl::at(given, e93 as u32, &UVec4::ZERO)).wrapping_add(*wgsl::at(given, e99 as u32, &UVec4::ZERO));
        }
        let second = Pair { a: y, n: 3u32, v: Vec3::new(x, 2.0f32, y), odd: (word.x & 1u32) == 1u32 };
        let pairs = Pairs { first: Pair { a: x, n: word.y, v: Vec3::new(y, x, 1.0f32), odd: true }, second: second };
        let e120 = at.wrapping_add(9u32);
        let e122 = word.x;
        let e123 = self.exchanged(pairs, e122);
        if (e120 as usize) < self.found.len() {
            self.found[e120 as usize] = UVec4::new(e123.x.to_bits(), e123.y.to_bits(), e123.z.to_bits(), e123.w.to_bits());
        }
    }

    /// WGSL line 19.
    #[inline]
    pub fn parting(&mut self, kind: u32, n: u32) -> u32 {
        let mut sum: u32 = 1u32;
        let mut i: u32 = 0u32;
        'switch1: {
            match wgsl::rem_u32(kind, 5u32) {
                0u32 => {
                    'repeat2: loop {
                        if !(i < n) {
                            break 'repeat2;
                        }
                        {
                            sum = sum.wrapping_mul(3u32).wrapping_add(i);
                            if wgsl::rem_u32(sum, 7u32) == 3u32 {
                                return sum;
                            }
                        }
                        i = i.wrapping_add(1u32);
                    }
                    sum = sum.wrapping_add(1000u32);
                }
                1u32 | 2u32 => {
                    if wgsl::rem_u32(n, 3u32) == 1u32 {
                        break 'switch1;
                    }
                    sum = sum.wrapping_add(20u32);
                }
                3u32 => {
                    return 7u32;
                }
                _ => {
                    sum = sum.wrapping_add(30u32);
                }
            }
        }
        return sum.wrapping_add(kind);
    }

    /// WGSL line 42.
    #[inline]
    pub fn turns(&mut self, n: u32) -> u32 {
        let mut sum: u32 = 0u32;
        let mut i: u32 = 0u32;
        let mut inner: u32 = 0u32;
        'repeat1: loop {
            if i >= n {
                break 'repeat1;
            }
            inner = 0u32;
            'repeat2: loop {
                'next3: {
                    inner = inner.wrapping_add(1u32);
                    if inner > i {
                        break 'repeat2;
                    }
                    if (inner & 1u32) == 0u32 {
                        break 'next3;
                    }
                    sum = sum.wrapping_add(inner);
                }
                sum = sum.wrapping_add(1u32);
                let e28 = inner == 5u32;
                if e28 {
                    break 'repeat2;
                }
            }
            i = i.wrapping_add(1u32);
            if wgsl::rem_u32(i, 4u32) == 2u32 {
                continue 'repeat1;
            }
            if sum > 60u32 {
                return sum.wrapping_add(500u32);
            }
            sum = sum.wrapping_add(2u32);
        }
        return sum;
    }

    /// WGSL line 67.
    #[inline]
    pub fn guarded(&mut self, x: Real) -> Real {
        let mut y: Real = 0.0f32;
        y = x;
        if x > 0.0f32 {
            y = x.sqrt() / x;
        } else {
            if x < (-1.0f32) {
                y = (-x).sqrt() - (1.0f32 / x);
            }
        }
        return y;
    }

    /// WGSL line 77.
    #[inline]
    pub fn change(&mut self, pair: &mut Pair, x: Real) -> bool {
        if x < 0.0f32 {
            pair.n = pair.n.wrapping_add(5u32);
            return false;
        }
        pair.v.y = x;
        pair.a = pair.a * 2.0f32;
        return pair.odd;
    }

    /// WGSL line 88.
    #[inline]
    pub fn pointed(&mut self, x: Real, n: u32) -> Vec4 {
        let mut pair: Pair = Pair::ZERO;
        let mut other: Pair = Pair { a: 1.0f32, n: 2u32, v: Vec3::splat(3.0f32), odd: false };
        let mut sum: Real = 0.0f32;
        pair = Pair { a: x, n: n, v: Vec3::new(x, 1.0f32, 2.0f32), odd: (n & 1u32) == 1u32 };
        if wgsl::rem_u32(n, 3u32) == 0u32 {
            let e24 = self.change(&mut pair, x);
            if e24 {
                sum = 10.0f32;
            }
        } else {
            if wgsl::rem_u32(n, 3u32) == 1u32 {
                other = pair;
                let e31 = sum;
                let e32 = -x;
                let e33 = self.change(&mut other, e32);
                sum = e31 + (if e33 { 2.0f32 } else { 1.0f32 });
                pair.v = other.v * 2.0f32;
            }
        }
        let e44 = pair.v;
        return Vec4::new(e44.x, e44.y, e44.z, ((sum + pair.a) + other.a) + (pair.n.wrapping_add(other.n) as Real));
    }

    /// WGSL line 105.
    #[inline]
    pub fn exchanged(&mut self, p: Pairs, n: u32) -> Vec4 {
        let mut q: Pair = Pair::ZERO;
        q = p.second;
        if wgsl::rem_u32(n, 3u32) != 0u32 {
            let e19 = p.first.v;
            q = Pair { a: q.v.y, n: q.n.wrapping_add(p.first.n), v: Vec3::new(q.a, e19.x, q.v.z), odd: !q.odd };
        }
        let e30 = q.v;
        return Vec4::new(e30.x, e30.y, e30.z, (q.a + (q.n as Real)) + (if q.odd { 0.5f32 } else { 0.0f32 }));
    }

    /// WGSL line 114.
    #[inline]
    pub fn anew(&mut self, n: u32) -> u32 {
        let mut sum: u32 = 0u32;
        let mut i: u32 = 0u32;
        let mut part: UVec2 = UVec2::ZERO;
        'repeat1: loop {
            'next2: {
                if !(i < 6u32) {
                    break 'repeat1;
                }
                {
                    part = UVec2::ZERO;
                    part = UVec2::new(i, n);
                    if wgsl::rem_u32(n.wrapping_add(i), 3u32) == 0u32 {
                        break 'next2;
                    }
                    part.x = part.x.wrapping_add(7u32);
                    if wgsl::rem_u32(n ^ i, 5u32) == 0u32 {
                        break 'repeat1;
                    }
                    part.y = part.y.wrapping_add(i);
                    sum = sum.wrapping_mul(5u32).wrapping_add(part.x).wrapping_add(part.y);
                }
            }
            i = i.wrapping_add(1u32);
        }
        return sum;
    }

    /// WGSL line 129.
    #[inline]
    pub fn kept(&mut self, n: u32) -> u32 {
        let mut last: u32 = 0u32;
        let mut sum: u32 = 0u32;
        let mut i: u32 = 0u32;
        last = n;
        'repeat1: loop {
            'next2: {
                if !(i < 6u32) {
                    break 'repeat1;
                }
                {
                    if wgsl::rem_u32(n.wrapping_add(i), 2u32) == 0u32 {
                        break 'next2;
                    }
                    sum = sum.wrapping_add(last);
                    last = i.wrapping_mul(3u32);
                }
            }
            i = i.wrapping_add(1u32);
        }
        return sum.wrapping_mul(8u32).wrapping_add(last);
    }

    /// WGSL line 141.
    #[inline]
    pub fn indexed(&mut self, n: i32, x: Real) -> Vec4 {
        let mut list: [Real; 4] = [0.0f32; 4];
        let mut v: Vec3 = Vec3::ZERO;
        list = [x, 2.0f32, 3.0f32, 4.0f32];
        v = Vec3::new(x, 5.0f32, 6.0f32);
        let i = wgsl::rem_i32(n, 6i32);
        let e15 = wgsl::rem_u32(i as u32, 4u32);
        if (e15 as usize) < 4 {
            list[e15 as usize] = list[(e15 as usize).min(3)] + 10.0f32;
        }
        if x > 0.5f32 {
            let e24 = wgsl::rem_u32(n as u32, 3u32);
            if (e24 as usize) < 3 {
                v[e24 as usize] = -x;
            }
        }
        let e31 = (n as u32) & 3u32;
        return Vec4::new(list[(i as usize).min(3)], v[(e31 as usize).min(2)], list[0] + list[3], v.z);
    }

    /// WGSL line 152.
    #[inline]
    pub fn integers(&mut self, a: u32, b: i32) -> UVec4 {
        let c = a as i32;
        let d = b as u32;
        return UVec4::new((((wgsl::div_u32(a, d) ^ wgsl::rem_u32(a, d)) ^ a.reverse_bits()) ^ a.wrapping_shl(d & 31u32)) ^ a.wrapping_shr(wgsl::rem_u32(d, 40u32)), ((((wgsl::div_i32(c, b) ^ wgsl::rem_i32(c, b)) ^ c.wrapping_shr(d & 31u32)) ^ b.wrapping_neg()) ^ c.wrapping_abs()) as u32, ((((if a < d { d } else { a }) ^ (if c < b { 2u32 } else { 1u32 })) ^ a.min(d)) ^ a.max(d).wrapping_mul(3u32)) ^ (!a), ((c.min(b).wrapping_sub(c.max(3i32)) as u32) ^ (if a >= d { 8u32 } else { 4u32 })) ^ (if c >= b { 32u32 } else { 16u32 }));
    }

    /// WGSL line 163.
    #[inline]
    pub fn floats(&mut self, x: Real, y: Real) -> Vec4 {
        let e30 = Vec3::new(x * y - 2.0f32 * x, 2.0f32 * 1.0f32 - y * y, y * x - x * 1.0f32);
        return Vec4::new((wgsl::min(x, y) + (x.floor() * y.ceil())) - x.trunc(), (wgsl::max(x, y) - wgsl::clamp(x, -1.0f32, y)) + wgsl::fract(y), (((wgsl::to_u32(x) as Real) + (wgsl::to_i32(y) as Real)) - x.abs()) + y.round_ties_even(), x * e30.x + y * e30.y + 1.0f32 * e30.z);
    }

    /// WGSL line 172.
    #[inline]
    pub fn conversions(&mut self, a: u32, x: Real) -> UVec4 {
        let bytes = UVec4::new(wgsl::byte_u32(a, 0), wgsl::byte_u32(a, 1), wgsl::byte_u32(a, 2), wgsl::byte_u32(a, 3));
        let truth = BVec3::new(a > 5u32, x > 0.0f32, (a & 2u32) == 2u32);
        return UVec4::new((a as Real).to_bits(), ((a as i32) as Real).to_bits(), wgsl::to_u32(x) ^ (wgsl::to_i32(x) as u32), bytes.x.wrapping_add(bytes.y.wrapping_mul(3u32)).wrapping_add(bytes.w.wrapping_mul(5u32)).wrapping_add(truth.all() as u32).wrapping_add(truth.any() as u32).wrapping_add(truth.z as u32));
    }
}

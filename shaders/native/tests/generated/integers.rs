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
    pub unused: core::marker::PhantomData<&'a ()>,
}

impl<'a> Kernel<'a> {
    /// Binds the resources; the private variables get their initial values.
    pub fn new(bindings: Bindings<'a>) -> Self {
        Self {
            unused: bindings.unused,
        }
    }

    /// WGSL line 3.
    #[inline]
    pub fn add(&mut self, a: u32, b: u32) -> u32 {
        return a.wrapping_add(b);
    }

    /// WGSL line 4.
    #[inline]
    pub fn sub(&mut self, a: u32, b: u32) -> u32 {
        return a.wrapping_sub(b);
    }

    /// WGSL line 5.
    #[inline]
    pub fn mul(&mut self, a: i32, b: i32) -> i32 {
        return a.wrapping_mul(b);
    }

    /// WGSL line 6.
    #[inline]
    pub fn neg(&mut self, a: i32) -> i32 {
        return a.wrapping_neg();
    }

    /// WGSL line 7.
    #[inline]
    pub fn abs_i(&mut self, a: i32) -> i32 {
        return a.wrapping_abs();
    }

    /// WGSL line 8.
    #[inline]
    pub fn div_u(&mut self, a: u32, b: u32) -> u32 {
        return wgsl::div_u32(a, b);
    }

    /// WGSL line 9.
    #[inline]
    pub fn rem_u(&mut self, a: u32, b: u32) -> u32 {
        return wgsl::rem_u32(a, b);
    }

    /// WGSL line 10.
    #[inline]
    pub fn div_i(&mut self, a: i32, b: i32) -> i32 {
        return wgsl::div_i32(a, b);
    }

    /// WGSL line 11.
    #[inline]
    pub fn rem_i(&mut self, a: i32, b: i32) -> i32 {
        return wgsl::rem_i32(a, b);
    }

    /// WGSL line 12.
    #[inline]
    pub fn div_v(&mut self, a: IVec3, b: IVec3) -> IVec3 {
        return IVec3::new(wgsl::div_i32(a.x, b.x), wgsl::div_i32(a.y, b.y), wgsl::div_i32(a.z, b.z));
    }

    /// WGSL line 13.
    #[inline]
    pub fn rem_v(&mut self, a: UVec2, b: UVec2) -> UVec2 {
        return UVec2::new(wgsl::rem_u32(a.x, b.x), wgsl::rem_u32(a.y, b.y));
    }

    /// WGSL line 14.
    #[inline]
    pub fn mul_v(&mut self, a: UVec3, s: u32) -> UVec3 {
        return a.wrapping_mul(UVec3::splat(s)).wrapping_add(UVec3::splat(1u32));
    }

    /// WGSL line 15.
    #[inline]
    pub fn sub_v(&mut self, s: u32, a: UVec3) -> UVec3 {
        return UVec3::splat(s).wrapping_sub(a);
    }

    /// WGSL line 16.
    #[inline]
    pub fn neg_v(&mut self, a: IVec2) -> IVec2 {
        return IVec2::new(a.x.wrapping_neg(), a.y.wrapping_neg());
    }

    /// WGSL line 17.
    #[inline]
    pub fn shl(&mut self, a: u32, n: u32) -> u32 {
        return a.wrapping_shl(n);
    }

    /// WGSL line 18.
    #[inline]
    pub fn shr(&mut self, a: u32, n: u32) -> u32 {
        return a.wrapping_shr(n);
    }

    /// WGSL line 19.
    #[inline]
    pub fn shr_i(&mut self, a: i32, n: u32) -> i32 {
        return a.wrapping_shr(n);
    }

    /// WGSL line 20.
    #[inline]
    pub fn shl_v(&mut self, a: UVec2, n: UVec2) -> UVec2 {
        return UVec2::new(a.x.wrapping_shl(n.x), a.y.wrapping_shl(n.y));
    }

    /// WGSL line 21.
    #[inline]
    pub fn masks(&mut self, a: u32, b: u32) -> u32 {
        return (a & b) | (a ^ (!b));
    }

    /// WGSL line 22.
    #[inline]
    pub fn masks_v(&mut self, a: UVec4, b: UVec4) -> UVec4 {
        return (a & b) | (a ^ (!b));
    }

    /// WGSL line 23.
    #[inline]
    pub fn limits(&mut self, a: i32) -> i32 {
        return a.min(50i32).max(-50i32).max((-7i32)).min(9i32);
    }

    /// WGSL line 24.
    #[inline]
    pub fn clamp_crossed(&mut self, a: i32) -> i32 {
        let mut low: i32 = 5i32;
        let mut high: i32 = 3i32;
        return a.max(low).min(high);
    }

    /// WGSL line 25.
    #[inline]
    pub fn sign_i(&mut self, a: i32) -> i32 {
        return a.signum();
    }

    /// WGSL line 26.
    #[inline]
    pub fn most_negative(&mut self) -> i32 {
        return i32::MIN;
    }

    /// WGSL line 28.
    #[inline]
    pub fn to_u32(&mut self, x: Real) -> u32 {
        return wgsl::to_u32(x);
    }

    /// WGSL line 29.
    #[inline]
    pub fn to_i32(&mut self, x: Real) -> i32 {
        return wgsl::to_i32(x);
    }

    /// WGSL line 30.
    #[inline]
    pub fn to_u32_v(&mut self, x: Vec3) -> UVec3 {
        return UVec3::new(wgsl::to_u32(x.x), wgsl::to_u32(x.y), wgsl::to_u32(x.z));
    }

    /// WGSL line 31.
    #[inline]
    pub fn from_u32(&mut self, x: u32) -> Real {
        return x as Real;
    }

    /// WGSL line 32.
    #[inline]
    pub fn from_i32(&mut self, x: IVec2) -> Vec2 {
        return Vec2::new(x.x as Real, x.y as Real);
    }

    /// WGSL line 33.
    #[inline]
    pub fn from_bool(&mut self, x: bool) -> Vec3 {
        return Vec3::new(if x { 1.0 } else { 0.0 }, (x as u32) as Real, (x as i32) as Real);
    }

    /// WGSL line 34.
    #[inline]
    pub fn to_bool(&mut self, x: Real, y: u32, z: i32) -> BVec3 {
        return BVec3::new(x != 0.0, y != 0, z != 0);
    }

    /// WGSL line 35.
    #[inline]
    pub fn sign_change(&mut self, x: u32) -> i32 {
        return (x as i32).wrapping_add(x as i32);
    }

    /// WGSL line 36.
    #[inline]
    pub fn to_bits(&mut self, x: Real) -> u32 {
        return x.to_bits();
    }

    /// WGSL line 37.
    #[inline]
    pub fn to_bits_i(&mut self, x: Vec2) -> IVec2 {
        return IVec2::new(x.x.to_bits() as i32, x.y.to_bits() as i32);
    }

    /// WGSL line 38.
    #[inline]
    pub fn from_bits(&mut self, x: u32) -> Real {
        return f32::from_bits(x);
    }

    /// WGSL line 39.
    #[inline]
    pub fn from_bits_v(&mut self, x: UVec4) -> Vec4 {
        return Vec4::new(f32::from_bits(x.x), f32::from_bits(x.y), f32::from_bits(x.z), f32::from_bits(x.w));
    }

    /// WGSL line 40.
    #[inline]
    pub fn from_bits_i(&mut self, x: i32) -> Real {
        return f32::from_bits(x as u32);
    }

    /// WGSL line 41.
    #[inline]
    pub fn infinity(&mut self) -> Real {
        return f32::from_bits(2139095040u32);
    }

    /// WGSL line 42.
    #[inline]
    pub fn words_to_ints(&mut self, x: UVec3) -> IVec3 {
        return IVec3::new(x.x as i32, x.y as i32, x.z as i32);
    }

    /// WGSL line 44.
    #[inline]
    pub fn reverse(&mut self, x: u32) -> u32 {
        return x.reverse_bits();
    }

    /// WGSL line 45.
    #[inline]
    pub fn ones(&mut self, x: u32) -> u32 {
        return x.count_ones();
    }

    /// WGSL line 46.
    #[inline]
    pub fn ones_i(&mut self, x: i32) -> i32 {
        return x.count_ones() as i32;
    }

    /// WGSL line 47.
    #[inline]
    pub fn leading(&mut self, x: u32) -> u32 {
        return x.leading_zeros();
    }

    /// WGSL line 48.
    #[inline]
    pub fn trailing(&mut self, x: UVec2) -> UVec2 {
        return UVec2::new(x.x.trailing_zeros(), x.y.trailing_zeros());
    }

    /// WGSL line 49.
    #[inline]
    pub fn first_leading(&mut self, x: u32) -> u32 {
        return wgsl::first_leading_u32(x);
    }

    /// WGSL line 50.
    #[inline]
    pub fn first_leading_i(&mut self, x: i32) -> i32 {
        return wgsl::first_leading_i32(x);
    }

    /// WGSL line 51.
    #[inline]
    pub fn first_trailing(&mut self, x: u32) -> u32 {
        return wgsl::first_trailing_u32(x);
    }

    /// WGSL line 52.
    #[inline]
    pub fn extract(&mut self, x: u32, o: u32, c: u32) -> u32 {
        return wgsl::extract_u32(x, o, c);
    }

    /// WGSL line 53.
    #[inline]
    pub fn extract_i(&mut self, x: i32, o: u32, c: u32) -> i32 {
        return wgsl::extract_i32(x, o, c);
    }

    /// WGSL line 54.
    #[inline]
    pub fn extract_v(&mut self, x: UVec2, o: u32, c: u32) -> UVec2 {
        return UVec2::new(wgsl::extract_u32(x.x, o, c), wgsl::extract_u32(x.y, o, c));
    }

    /// WGSL line 55.
    #[inline]
    pub fn insert(&mut self, x: u32, n: u32, o: u32, c: u32) -> u32 {
        return wgsl::insert_u32(x, n, o, c);
    }

    /// WGSL line 56.
    #[inline]
    pub fn dot_u(&mut self, a: UVec3, b: UVec3) -> u32 {
        return a.x.wrapping_mul(b.x).wrapping_add(a.y.wrapping_mul(b.y)).wrapping_add(a.z.wrapping_mul(b.z));
    }

    /// WGSL line 58.
    #[inline]
    pub fn pcg4d(&mut self, seed: UVec4) -> UVec4 {
        let mut v: UVec4 = UVec4::ZERO;
        v = seed.wrapping_mul(UVec4::splat(1664525u32)).wrapping_add(UVec4::splat(1013904223u32));
        v.x = v.x.wrapping_add(v.y.wrapping_mul(v.w));
        v.y = v.y.wrapping_add(v.z.wrapping_mul(v.x));
        v.z = v.z.wrapping_add(v.x.wrapping_mul(v.y));
        v.w = v.w.wrapping_add(v.y.wrapping_mul(v.z));
        let e40 = v;
        v = v ^ UVec4::new(e40.x.wrapping_shr(16u32), e40.y.wrapping_shr(16u32), e40.z.wrapping_shr(16u32), e40.w.wrapping_shr(16u32));
        v.x = v.x.wrapping_add(v.y.wrapping_mul(v.w));
        v.y = v.y.wrapping_add(v.z.wrapping_mul(v.x));
        v.z = v.z.wrapping_add(v.x.wrapping_mul(v.y));
        v.w = v.w.wrapping_add(v.y.wrapping_mul(v.z));
        return v;
    }

    /// WGSL line 72.
    #[inline]
    pub fn pack_half(&mut self, v: Vec2) -> u32 {
        return (wgsl::f16_from(v.x as f32) & 0xffff) | (wgsl::f16_from(v.y as f32) << 16);
    }

    /// WGSL line 73.
    #[inline]
    pub fn unpack_half(&mut self, x: u32) -> Vec2 {
        return Vec2::new(Real::from(wgsl::f16_to(x >> 0)), Real::from(wgsl::f16_to(x >> 16)));
    }

    /// WGSL line 74.
    #[inline]
    pub fn pack_snorm2(&mut self, v: Vec2) -> u32 {
        return (wgsl::pack_snorm(v.x, 32767.0) & 0xffff) | (wgsl::pack_snorm(v.y, 32767.0) << 16);
    }

    /// WGSL line 75.
    #[inline]
    pub fn unpack_snorm2(&mut self, x: u32) -> Vec2 {
        return Vec2::new(wgsl::max(wgsl::half_i32(x, 0) as Real / 32767.0, -1.0), wgsl::max(wgsl::half_i32(x, 1) as Real / 32767.0, -1.0));
    }

    /// WGSL line 76.
    #[inline]
    pub fn pack_unorm2(&mut self, v: Vec2) -> u32 {
        return (wgsl::pack_unorm(v.x, 65535.0) & 0xffff) | (wgsl::pack_unorm(v.y, 65535.0) << 16);
    }

    /// WGSL line 77.
    #[inline]
    pub fn unpack_unorm2(&mut self, x: u32) -> Vec2 {
        return Vec2::new(((x >> 0) & 0xffff) as Real / 65535.0, ((x >> 16) & 0xffff) as Real / 65535.0);
    }

    /// WGSL line 78.
    #[inline]
    pub fn pack_snorm4(&mut self, v: Vec4) -> u32 {
        return wgsl::join_bytes(wgsl::pack_snorm(v.x, 127.0), wgsl::pack_snorm(v.y, 127.0), wgsl::pack_snorm(v.z, 127.0), wgsl::pack_snorm(v.w, 127.0));
    }

    /// WGSL line 79.
    #[inline]
    pub fn unpack_snorm4(&mut self, x: u32) -> Vec4 {
        return Vec4::new(wgsl::max(wgsl::byte_i32(x, 0) as Real / 127.0, -1.0), wgsl::max(wgsl::byte_i32(x, 1) as Real / 127.0, -1.0), wgsl::max(wgsl::byte_i32(x, 2) as Real / 127.0, -1.0), wgsl::max(wgsl::byte_i32(x, 3) as Real / 127.0, -1.0));
    }

    /// WGSL line 80.
    #[inline]
    pub fn pack_unorm4(&mut self, v: Vec4) -> u32 {
        return wgsl::join_bytes(wgsl::pack_unorm(v.x, 255.0), wgsl::pack_unorm(v.y, 255.0), wgsl::pack_unorm(v.z, 255.0), wgsl::pack_unorm(v.w, 255.0));
    }

    /// WGSL line 81.
    #[inline]
    pub fn unpack_unorm4(&mut self, x: u32) -> Vec4 {
        return Vec4::new(wgsl::byte_u32(x, 0) as Real / 255.0, wgsl::byte_u32(x, 1) as Real / 255.0, wgsl::byte_u32(x, 2) as Real / 255.0, wgsl::byte_u32(x, 3) as Real / 255.0);
    }

    /// WGSL line 82.
    #[inline]
    pub fn bytes(&mut self, x: u32) -> UVec4 {
        return UVec4::new(wgsl::byte_u32(x, 0), wgsl::byte_u32(x, 1), wgsl::byte_u32(x, 2), wgsl::byte_u32(x, 3));
    }

    /// WGSL line 83.
    #[inline]
    pub fn bytes_i(&mut self, x: u32) -> IVec4 {
        return IVec4::new(wgsl::byte_i32(x, 0), wgsl::byte_i32(x, 1), wgsl::byte_i32(x, 2), wgsl::byte_i32(x, 3));
    }

    /// WGSL line 84.
    #[inline]
    pub fn join(&mut self, v: UVec4) -> u32 {
        return wgsl::join_bytes(v.x as u32, v.y as u32, v.z as u32, v.w as u32);
    }

    /// WGSL line 85.
    #[inline]
    pub fn join_clamped(&mut self, v: IVec4) -> u32 {
        return wgsl::join_bytes(v.x.max(-128).min(127) as u32, v.y.max(-128).min(127) as u32, v.z.max(-128).min(127) as u32, v.w.max(-128).min(127) as u32);
    }

    /// WGSL line 86.
    #[inline]
    pub fn packed_dot(&mut self, a: u32, b: u32) -> i32 {
        return wgsl::byte_i32(a, 0) * wgsl::byte_i32(b, 0) + wgsl::byte_i32(a, 1) * wgsl::byte_i32(b, 1) + wgsl::byte_i32(a, 2) * wgsl::byte_i32(b, 2) + wgsl::byte_i32(a, 3) * wgsl::byte_i32(b, 3);
    }
}

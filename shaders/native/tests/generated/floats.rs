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
pub struct __modf_result_f32 {
    pub fract: Real,
    pub whole: Real,
}

impl __modf_result_f32 {
    /// All members zero.
    pub const ZERO: Self = __modf_result_f32 { fract: 0.0f32, whole: 0.0f32 };
}

impl Default for __modf_result_f32 {
    fn default() -> Self {
        Self::ZERO
    }
}

#[derive(Clone, Copy, Debug, PartialEq)]
pub struct __frexp_result_f32 {
    pub fract: Real,
    pub exp: i32,
}

impl __frexp_result_f32 {
    /// All members zero.
    pub const ZERO: Self = __frexp_result_f32 { fract: 0.0f32, exp: 0i32 };
}

impl Default for __frexp_result_f32 {
    fn default() -> Self {
        Self::ZERO
    }
}

pub const INV_PI: Real = 0.31830987f32;
pub const TINY: Real = 1e-7f32;
pub const MIX: Vec3 = Vec3::new(0.1f32, 0.7f32, 0.001f32);
pub const gamma: Real = 2.2f32;

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

    /// WGSL line 10.
    #[inline]
    pub fn tenth(&mut self) -> Real {
        return 0.1f32;
    }

    /// WGSL line 11.
    #[inline]
    pub fn pi_times(&mut self, x: Real) -> Real {
        return x * 3.1415927f32;
    }

    /// WGSL line 12.
    #[inline]
    pub fn inv_pi(&mut self) -> Real {
        return INV_PI;
    }

    /// WGSL line 13.
    #[inline]
    pub fn third(&mut self, x: Real) -> Real {
        return x * 0.33333334f32;
    }

    /// WGSL line 14.
    #[inline]
    pub fn long_decimal(&mut self) -> Real {
        return 0.12345679f32;
    }

    /// WGSL line 15.
    #[inline]
    pub fn negative(&mut self) -> Real {
        return -0.7f32;
    }

    /// WGSL line 16.
    #[inline]
    pub fn suffixed(&mut self) -> Real {
        return 0.3000001f32;
    }

    /// WGSL line 17.
    #[inline]
    pub fn folded(&mut self) -> Real {
        return 6.183185f32;
    }

    /// WGSL line 18.
    #[inline]
    pub fn whole_number(&mut self) -> Real {
        return 3.0f32;
    }

    /// WGSL line 19.
    #[inline]
    pub fn hexadecimal(&mut self) -> Real {
        return 3.0f32;
    }

    /// WGSL line 20.
    #[inline]
    pub fn constant_vector(&mut self) -> Vec3 {
        return MIX;
    }

    /// WGSL line 21.
    #[inline]
    pub fn overridden(&mut self, x: Real) -> Real {
        return x * gamma;
    }

    /// WGSL line 22.
    #[inline]
    pub fn largest(&mut self) -> Real {
        return 3.4028235e38f32;
    }

    /// WGSL line 24.
    #[inline]
    pub fn floor_ceil(&mut self, x: Real) -> Vec2 {
        return Vec2::new(x.floor(), x.ceil());
    }

    /// WGSL line 25.
    #[inline]
    pub fn rounded(&mut self, x: Real) -> Real {
        return x.round_ties_even();
    }

    /// WGSL line 26.
    #[inline]
    pub fn truncated(&mut self, x: Real) -> Real {
        return x.trunc();
    }

    /// WGSL line 27.
    #[inline]
    pub fn fraction(&mut self, x: Real) -> Real {
        return wgsl::fract(x);
    }

    /// WGSL line 28.
    #[inline]
    pub fn sign_f(&mut self, x: Real) -> Real {
        return wgsl::sign(x);
    }

    /// WGSL line 29.
    #[inline]
    pub fn smaller(&mut self, a: Real, b: Real) -> Real {
        return wgsl::min(a, b);
    }

    /// WGSL line 30.
    #[inline]
    pub fn larger(&mut self, a: Vec3, b: Vec3) -> Vec3 {
        return Vec3::new(wgsl::max(a.x, b.x), wgsl::max(a.y, b.y), wgsl::max(a.z, b.z));
    }

    /// WGSL line 31.
    #[inline]
    pub fn clamped(&mut self, x: Real) -> Real {
        return wgsl::clamp(x, -1.5f32, 2.5f32);
    }

    /// WGSL line 32.
    #[inline]
    pub fn saturated(&mut self, x: Vec2) -> Vec2 {
        return Vec2::new(wgsl::clamp(x.x, 0.0, 1.0), wgsl::clamp(x.y, 0.0, 1.0));
    }

    /// WGSL line 33.
    #[inline]
    pub fn root(&mut self, x: Real) -> Real {
        return x.sqrt();
    }

    /// WGSL line 34.
    #[inline]
    pub fn inverse_root(&mut self, x: Real) -> Real {
        return 1.0 / x.sqrt();
    }

    /// WGSL line 35.
    #[inline]
    pub fn absolute(&mut self, x: Vec4) -> Vec4 {
        return Vec4::new(x.x.abs(), x.y.abs(), x.z.abs(), x.w.abs());
    }

    /// WGSL line 36.
    #[inline]
    pub fn stepped(&mut self, e: Real, x: Real) -> Real {
        return wgsl::step(e, x);
    }

    /// WGSL line 37.
    #[inline]
    pub fn smooth_ramp(&mut self, x: Real) -> Real {
        return wgsl::smoothstep(1.0f32, 3.0f32, x);
    }

    /// WGSL line 38.
    #[inline]
    pub fn mixed(&mut self, a: Vec2, b: Vec2, t: Real) -> Vec2 {
        return Vec2::new(wgsl::mix(a.x, b.x, t), wgsl::mix(a.y, b.y, t));
    }

    /// WGSL line 39.
    #[inline]
    pub fn fused(&mut self, a: Real, b: Real, c: Real) -> Real {
        return a * b + c;
    }

    /// WGSL line 40.
    #[inline]
    pub fn waves(&mut self, x: Real) -> Vec3 {
        return Vec3::new(x.sin(), x.cos(), x.tan());
    }

    /// WGSL line 41.
    #[inline]
    pub fn arcs(&mut self, x: Real) -> Vec4 {
        return Vec4::new(x.asin(), x.acos(), x.atan(), x.atan2(2.0f32));
    }

    /// WGSL line 42.
    #[inline]
    pub fn growth(&mut self, x: Real) -> Vec4 {
        return Vec4::new(x.exp(), x.exp2(), x.ln(), x.log2());
    }

    /// WGSL line 43.
    #[inline]
    pub fn power(&mut self, x: Real, y: Real) -> Real {
        return x.powf(y);
    }

    /// WGSL line 44.
    #[inline]
    pub fn angles(&mut self, x: Real) -> Vec2 {
        return Vec2::new(x.to_radians(), x.to_degrees());
    }

    /// WGSL line 45.
    #[inline]
    pub fn scaled(&mut self, x: Real, e: i32) -> Real {
        return wgsl::ldexp(x, e);
    }

    /// WGSL line 46.
    #[inline]
    pub fn parts(&mut self, x: Real) -> Vec2 {
        let p = __modf_result_f32 { fract: x - x.trunc(), whole: x.trunc() };
        return Vec2::new(p.fract, p.whole);
    }

    /// WGSL line 47.
    #[inline]
    pub fn mantissa(&mut self, x: Real) -> Real {
        return (__frexp_result_f32 { fract: wgsl::frexp(x).0, exp: wgsl::frexp(x).1 }).fract;
    }

    /// WGSL line 48.
    #[inline]
    pub fn exponent(&mut self, x: Real) -> i32 {
        return (__frexp_result_f32 { fract: wgsl::frexp(x).0, exp: wgsl::frexp(x).1 }).exp;
    }

    /// WGSL line 49.
    #[inline]
    pub fn halved(&mut self, x: Real) -> Real {
        return wgsl::quantize_f16(x);
    }

    /// WGSL line 50.
    #[inline]
    pub fn polynomial(&mut self, x: Real) -> Real {
        return (((((0.2f32 * x) + 0.3f32) * x) - 0.4f32) * x) + 0.5f32;
    }
}

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

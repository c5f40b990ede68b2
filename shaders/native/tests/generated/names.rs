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

//! What next-event estimation may sample. Emission itself is the material's.

use super::field::abi_struct;
use super::tag::tags;

tags! {
    /// Shape of a `Light`. The numbers are part of the pack format.
    pub enum LightKind {
        /// Sphere `primitive`, sampled by its visible cone.
        Sphere = 0 as 2 "sphere lights",
        /// Parallelogram `origin + u edge1 + v edge2`, sampled by area; two triangles in the BVH.
        Rectangle = 1 as 3 "rectangle lights",
        /// Triangle `primitive`, sampled by area.
        Triangle = 2 as 4 "triangle lights",
        /// The sky, sampled by the SKYTABLE section.
        Sky = 3 as 53 "sky light",
    }
}

/// Which primitives a light is made of.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum LightSurface {
    /// One sphere.
    Sphere,
    /// Triangles, from `primitive` on.
    Triangles,
}

impl LightKind {
    /// What rays hit of it; `None` for the sky.
    #[must_use]
    pub const fn surface(self) -> Option<LightSurface> {
        match self {
            Self::Sphere => Some(LightSurface::Sphere),
            Self::Rectangle | Self::Triangle => Some(LightSurface::Triangles),
            Self::Sky => None,
        }
    }
}

abi_struct! {
    /// An emitter in the selection table, 64 bytes. Normalised world frame.
    pub struct Light {
        /// Centre (sphere), corner (rectangle), first vertex (triangle); unused for the sky, as all of its geometry.
        pub origin: [f32; 3],
        /// `LightKind`.
        pub kind: u32,
        /// First edge; for a sphere x is the radius, y the cosine of the angle of its tint or of the outer cone of its
        /// beam, z that of the inner cone.
        pub edge1: [f32; 3],
        /// Area in square normalised units; unused for a sphere.
        pub area: f32,
        /// Second edge; for a sphere the unit vector towards which it is tinted, or against its beam.
        pub edge2: [f32; 3],
        /// Index of the sphere, of the triangle, or of the rectangle's first triangle; 0 for the sky.
        pub primitive: u32,
        /// Probability of choosing this light, > 0; all of them sum to 1.
        pub pmf: f32,
        /// Sum of `pmf` up to and including this light; the last is exactly 1.
        pub cdf: f32,
        /// Index of the `Material` that emits; 0 for the sky.
        pub material: u32,
        /// Turns from the root of the tree of lights to this one, the first in bit 0; 0 without a tree.
        pub trail: u32,
    }
}

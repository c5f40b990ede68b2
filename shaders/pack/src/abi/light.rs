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
        /// The same radiance from all directions around one, from infinitely far away; sampled by solid angle.
        Directional = 4 as 61 "directional lights",
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
    /// What rays hit of it; `None` for lights that only rays see which leave the scene: sky and directional lights.
    #[must_use]
    pub const fn surface(self) -> Option<LightSurface> {
        match self {
            Self::Sphere => Some(LightSurface::Sphere),
            Self::Rectangle | Self::Triangle => Some(LightSurface::Triangles),
            Self::Sky | Self::Directional => None,
        }
    }
}

impl Light {
    /// Whether it is a surface that rays can hit.
    #[must_use]
    pub fn has_surface(&self) -> bool {
        LightKind::from_tag(self.kind).is_some_and(|kind| kind.surface().is_some())
    }

    /// Whether it is a directional light that the camera does not see. What has a surface says so by its material.
    #[must_use]
    pub fn is_unseen(&self) -> bool {
        self.kind == LightKind::Directional as u32 && self.edge2[1] > 0.0
    }
}

abi_struct! {
    /// An emitter in the selection table, 64 bytes. Normalised world frame. Directional lights come first.
    pub struct Light {
        /// Centre (sphere), corner (rectangle), first vertex (triangle), unit vector towards the light (directional);
        /// unused for the sky, as all of its geometry.
        pub origin: [f32; 3],
        /// `LightKind`.
        pub kind: u32,
        /// First edge; for a sphere x is the radius, y the cosine of the angle of its tint or of the outer cone of its
        /// beam, z that of the inner cone; for a directional light its radiance, linear Rec. 709, W/(m2 sr).
        pub edge1: [f32; 3],
        /// Area in square normalised units; unused for a sphere and a directional light.
        pub area: f32,
        /// Second edge; for a sphere the unit vector towards which it is tinted, or against its beam; for a
        /// directional light x is 1 less the cosine of the angle between its middle and its rim, in (0, 1], and y is 1
        /// if rays that come straight from the camera do not find it, else 0.
        pub edge2: [f32; 3],
        /// Index of the sphere, of the triangle, or of the rectangle's first triangle; the number of the object for a
        /// directional light, for its light group; 0 for the sky.
        pub primitive: u32,
        /// Probability of choosing this light, > 0; all of them sum to 1.
        pub pmf: f32,
        /// Sum of `pmf` up to and including this light; the last is exactly 1.
        pub cdf: f32,
        /// Index of the `Material` that emits; 0 for the sky and directional lights.
        pub material: u32,
        /// Turns from the root of the tree of lights to this one, the first in bit 0; 0 without a tree.
        pub trail: u32,
    }
}

//! What the kernel returns of a sample beside its radiance.

use super::field::abi_struct;

abi_struct! {
    /// One sample of a pixel, 80 bytes. World frame, normalised units.
    pub struct AovSample {
        /// Albedo of the first surface that is not specular, times what the specular ones before it keep;
        /// 0 ..= 1, with the emission of what emits. 0 where nothing is.
        pub albedo: [f32; 3],
        /// Index of the `Material` of the first surface, or `NONE`.
        pub material: u32,
        /// Shading normal of the first surface that is not specular, unit, on the side that the ray came from;
        /// 0 where nothing is, and in media.
        pub normal: [f32; 3],
        /// Index of the `Object` of the first surface, as its primitive has it, or `NONE`.
        pub object: u32,
        /// The first surface.
        pub position: [f32; 3],
        /// 1 where the camera ray met a surface, or was scattered in a medium; otherwise 0.
        pub alpha: f32,
        /// Radiance of the sample where `alpha` is 0; otherwise 0.
        pub backdrop: [f32; 3],
        /// Rays of the path, at least 1. All bits: nothing of the pixel is true, as in `FilmPixel::CUT`.
        pub rays: u32,
        /// Texture coordinates of the first surface.
        pub uv: [f32; 2],
        /// Unused.
        pub _pad0: u32,
        /// Unused.
        pub _pad1: u32,
    }
}

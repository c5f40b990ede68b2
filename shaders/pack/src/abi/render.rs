//! Settings that the runtime needs and the kernel does not.

use super::field::abi_struct;
use super::tag::tags;

tags! {
    /// Film response of the PNG. The numbers are part of the pack format.
    pub enum ToneMap {
        /// Exposure and sRGB encoding only.
        None = 0,
        /// `x / (1 + x)` a channel.
        Reinhard = 1,
        /// A filmic curve fitted to the ACES reference (Narkowicz 2015).
        Aces = 2,
    }
}

tags! {
    /// Where random numbers come from. The numbers are part of the pack format.
    pub enum SamplerKind {
        /// Sobol pairs, Owen-scrambled and shuffled for every pixel and purpose.
        Sobol = 0,
        /// Independent numbers, hashed by pcg4d.
        Pcg = 1 as 48 "independent samples",
    }
}

tags! {
    /// How the samples of a pixel are spread around it. The numbers are part of the pack format.
    pub enum FilterKind {
        /// Over the pixel's own square.
        Pixel = 0,
        /// Over a square.
        Box = 1 as 32 "box filter",
        /// Falls off evenly along each axis.
        Tent = 2 as 33 "tent filter",
        /// Falls off as a normal distribution.
        Gaussian = 3 as 34 "gaussian filter",
        /// The window of Blackman and Harris along each axis.
        BlackmanHarris = 4 as 35 "Blackman-Harris filter",
    }
}

/// `max_depth` of paths of any length: they end by Russian roulette.
pub const UNLIMITED_DEPTH: u32 = u32::MAX;

abi_struct! {
    /// The RENDER section: exactly one element, 112 bytes.
    pub struct RenderSettings {
        /// Image size in pixels.
        pub image_size: [u32; 2],
        /// Samples per pixel.
        pub samples: u32,
        /// Longest path in segments, >= 1, or `UNLIMITED_DEPTH`.
        pub max_depth: u32,
        /// Bounce from which Russian roulette may end a path.
        pub roulette_depth: u32,
        /// Seed of the image.
        pub seed: u32,
        /// Exposure in stops: the PNG is multiplied by `2^exposure`.
        pub exposure: f32,
        /// `ToneMap`.
        pub tone_map: u32,
        /// Root of the BVH: a `ChildRef` word, `NONE` without geometry.
        pub root: u32,
        /// Entries that the traversal stack needs, exactly, over all rays.
        pub stack_need: u32,
        /// Lower and upper half of the `f64` scale: normalised = (world - center) * scale, a power of two.
        pub scale_bits: [u32; 2],
        /// Halves of the `f64` x of the world's centre, metres.
        pub center_x_bits: [u32; 2],
        /// Halves of the `f64` y of the world's centre.
        pub center_y_bits: [u32; 2],
        /// Halves of the `f64` z of the world's centre.
        pub center_z_bits: [u32; 2],
        /// Number of lights in the selection table.
        pub n_lights: u32,
        /// `SamplerKind`.
        pub sampler: u32,
        /// Indices of the `Material`s inside of which the camera is, the one that counts first, then
        /// `NONE`.
        pub inside: [u32; 4],
        /// Index of the `Medium` outside of everything, or `NONE`.
        pub air: u32,
        /// Index of the `Medium` that is fog, or `NONE`.
        pub fog: u32,
        /// `FilterKind`.
        pub filter: u32,
        /// Side of the square outside of which the filter is 0, pixels; 0 for `FilterKind::Pixel`, which knows it.
        pub filter_width: f32,
    }
}

impl RenderSettings {
    /// Longest path in segments; `None`: of any length.
    #[must_use]
    pub fn depth(&self) -> Option<u32> {
        (self.max_depth != UNLIMITED_DEPTH).then_some(self.max_depth)
    }

    /// `normalised = (world - center) * scale`; a power of two in a checked pack.
    #[must_use]
    pub fn scale(&self) -> f64 {
        f64_from_bits(self.scale_bits)
    }

    /// The world's centre, metres.
    #[must_use]
    pub fn center(&self) -> [f64; 3] {
        [self.center_x_bits, self.center_y_bits, self.center_z_bits].map(f64_from_bits)
    }
}

/// Lower and upper half of an `f64`, as records store it.
#[must_use]
#[expect(clippy::cast_possible_truncation, reason = "the halves are what is wanted")]
pub fn f64_bits(value: f64) -> [u32; 2] {
    let bits = value.to_bits();
    [bits as u32, (bits >> 32) as u32]
}

/// The `f64` with these halves.
#[must_use]
pub fn f64_from_bits([low, high]: [u32; 2]) -> f64 {
    f64::from_bits(u64::from(high) << 32 | u64::from(low))
}

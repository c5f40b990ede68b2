//! What the kernel returns.

use super::field::abi_struct;

abi_struct! {
    /// One pixel of a tile after one dispatch, 32 bytes.
    pub struct FilmPixel {
        /// Sum of radiance over the samples of this dispatch; bad samples add 0.
        pub sum: [f32; 3],
        /// Rays traced: camera, bounce and shadow.
        pub rays: u32,
        /// Samples whose radiance was not finite.
        pub bad: u32,
        /// Index of the first bad sample; meaningful when `bad > 0`.
        pub first_bad: u32,
        /// Longest path of this dispatch in segments.
        pub depth: u32,
        /// Crossings at which the medium stack was wrong: bits 0-15 count those that found it full,
        /// bits 16-31 those that left a thing which the path had never entered.
        pub stack_errors: u32,
    }
}

impl FilmPixel {
    /// `rays` of a pixel of which nothing is true: one whose loops the driver has cut short. No pixel traces so many: a dispatch has 16 samples
    /// of a pixel.
    pub const CUT: u32 = u32::MAX;
}

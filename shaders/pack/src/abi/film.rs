//! What the kernel returns.

use super::field::abi_struct;

abi_struct! {
    /// One pixel of a tile after one dispatch, 32 bytes.
    pub struct FilmPixel {
        /// Sum of radiance over the samples of this dispatch; bad samples add 0.
        pub sum: [f32; 3],
        /// Rays traced: camera, bounce and shadow; a shadow ray that goes through surfaces is one.
        pub rays: u32,
        /// Samples whose radiance was not finite: bits 0-15 count them, bits 16-31 say which of this dispatch
        /// was the first.
        pub bad: u32,
        /// Sum of the luminance that was taken away from the samples, Rec. 709.
        pub removed: f32,
        /// Longest path of this dispatch in segments.
        pub depth: u32,
        /// Crossings at which the medium stack was wrong: bits 0-15 count those that found it full,
        /// bits 16-31 those that left a thing which the path had never entered.
        pub stack_errors: u32,
    }
}

impl FilmPixel {
    /// Samples whose radiance was not finite.
    #[must_use]
    pub fn n_bad(&self) -> u32 {
        self.bad & 0xffff
    }

    /// Which sample of the dispatch was the first of them.
    #[must_use]
    pub fn first_bad(&self) -> u32 {
        self.bad >> 16
    }

    /// `rays` of a pixel of which nothing is true: one whose loops the driver has cut short. No pixel traces so many: a dispatch has 16 samples
    /// of a pixel.
    pub const CUT: u32 = u32::MAX;
}

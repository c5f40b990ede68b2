//! What single and double precision make of an image, pixel by pixel, and how far apart they are.

use crate::film::{BadSample, Counters};

/// Relative difference of a pixel from which it counts as parted.
pub const PARTED: f64 = 1e-3;

/// Pixels that are named.
const WORST: usize = 8;

/// A pixel in both precisions.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Pixel {
    /// Mean radiance in `f32` and in `f64`.
    pub means: [[f64; 3]; 2],
    /// Largest difference of a channel over the larger of the two pixels, or over a thousandth of the
    /// image's mean where both are darker.
    pub off: f64,
    /// Samples whose paths went other ways.
    pub parted: u32,
    /// The sample that differs most, and by how much.
    pub worst: (u32, f64),
}

/// What was found.
#[derive(Clone, Debug)]
pub struct Report {
    /// Image in pixels.
    pub size: [u32; 2],
    /// Samples of every pixel.
    pub samples: u32,
    /// Row by row.
    pub pixels: Vec<Pixel>,
    /// Mean radiance of the image in `f32` and in `f64`, all channels.
    pub means: [f64; 2],
    /// What the two counted.
    pub counters: [Counters; 2],
    /// Paths that went other ways.
    pub parted: u64,
    /// Samples of radiance NaN, and of infinite radiance, in `f32` and in `f64`.
    pub bad: [[u64; 2]; 2],
}

impl Report {
    /// Largest relative difference of a pixel.
    #[must_use]
    pub fn largest(&self) -> f64 {
        self.pixels.iter().map(|pixel| pixel.off).fold(0.0, f64::max)
    }

    /// Mean relative difference of the pixels.
    #[must_use]
    pub fn mean(&self) -> f64 {
        self.pixels.iter().map(|pixel| pixel.off).sum::<f64>() / self.pixels.len().max(1) as f64
    }

    /// Share of the pixels that differ by more than [`PARTED`].
    #[must_use]
    pub fn share_of_pixels(&self) -> f64 {
        let parted = self.pixels.iter().filter(|pixel| pixel.off > PARTED).count();
        parted as f64 / self.pixels.len().max(1) as f64
    }

    /// Share of the paths that went other ways.
    #[must_use]
    pub fn share_of_paths(&self) -> f64 {
        let paths = self.pixels.len() as f64 * f64::from(self.samples);
        self.parted as f64 / paths.max(1.0)
    }

    /// Relative difference of the image's mean.
    #[must_use]
    pub fn brightness(&self) -> f64 {
        let [single, double] = self.means;
        if single.to_bits() == double.to_bits() { 0.0 } else { (single / double - 1.0).abs() }
    }

    /// The pixels that differ most, the worst first, each with the sample to replay.
    #[must_use]
    pub fn worst(&self) -> Vec<(BadSample, Pixel)> {
        let mut order: Vec<usize> = (0..self.pixels.len()).collect();
        order.retain(|i| self.pixels[*i].off > 0.0);
        // Equal ones in the order of the image: the sort is stable.
        order.sort_by(|a, b| self.pixels[*b].off.total_cmp(&self.pixels[*a].off));
        let width = self.size[0] as usize;
        let place = |i: usize| {
            let side = |x: usize| u32::try_from(x).expect("a pixel of the image");
            let sample = self.pixels[i].worst.0;
            (BadSample { x: side(i % width), y: side(i / width), sample }, self.pixels[i])
        };
        order.into_iter().take(WORST).map(place).collect()
    }
}

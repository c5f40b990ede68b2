//! Differences of pixels → a picture of them.

use super::Report;
use crate::output::{OutputError, write_atomic};
use image::ImageEncoder as _;
use std::io;
use std::path::Path;

/// Colours from no difference to all of it, sRGB: black, blue, purple, orange, yellow, white.
const RAMP: [[f64; 3]; 6] = [
    [0.0, 0.0, 0.0],
    [20.0, 20.0, 120.0],
    [150.0, 30.0, 130.0],
    [240.0, 110.0, 30.0],
    [250.0, 220.0, 60.0],
    [255.0, 255.0, 255.0],
];

/// Decades that the ramp covers: from 1e-7, the rounding of a number, to 1.
const DECADES: f64 = 7.0;

/// Colour of a relative difference.
fn color(off: f64) -> [u8; 3] {
    if off <= 0.0 {
        return [0; 3];
    }
    let steps = (RAMP.len() - 1) as f64;
    let at = ((libm::log10(off) + DECADES) / DECADES).clamp(0.0, 1.0) * steps;
    let mut color = [0; 3];
    for (i, pair) in RAMP.windows(2).enumerate() {
        let t = at - i as f64;
        if (0.0..=1.0).contains(&t) {
            let mix = |k: usize| pair[0][k] + (pair[1][k] - pair[0][k]) * t;
            #[expect(
                clippy::cast_possible_truncation,
                clippy::cast_sign_loss,
                reason = "0 ..= 255"
            )]
            let byte = |k: usize| mix(k).round() as u8;
            color = [0, 1, 2].map(byte);
        }
    }
    color
}

/// Writes a PNG: black where the two precisions agree, white where they differ by all.
///
/// # Errors
/// When the file cannot be written.
pub fn write_heat(path: &Path, report: &Report) -> Result<(), OutputError> {
    let pixels: Vec<[u8; 3]> = report.pixels.iter().map(|pixel| color(pixel.off)).collect();
    let mut file = Vec::new();
    let encoder = image::codecs::png::PngEncoder::new(io::Cursor::new(&mut file));
    let [width, height] = report.size;
    encoder
        .write_image(pixels.as_flattened(), width, height, image::ExtendedColorType::Rgb8)
        .map_err(|error| OutputError::Encode {
            path: path.to_owned(),
            message: error.to_string(),
        })?;
    write_atomic(path, &file)
}

#[cfg(test)]
mod tests {
    use super::color;

    #[test]
    fn colors_grow_brighter_with_the_difference() {
        let sum = |off: f64| color(off).map(u32::from).iter().sum::<u32>();
        assert_eq!((sum(0.0), sum(1e-9), sum(1.0), sum(50.0)), (0, 0, 765, 765));
        let steps: Vec<u32> = (0..=7).map(|i| sum(10.0_f64.powi(i - 7))).collect();
        assert!(steps.is_sorted(), "{steps:?}");
    }
}

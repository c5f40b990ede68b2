//! Differences of pixels → a picture of them.

use super::report::Report;
use crate::output::{OutputError, encode_rgb};

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

/// A PNG: black where the two precisions agree, white where they differ by all.
///
/// # Errors
/// When the encoder refuses.
pub fn encode_heat(report: &Report) -> Result<Vec<u8>, OutputError> {
    let pixels: Vec<[u8; 3]> = report.pixels.iter().map(|pixel| color(pixel.off)).collect();
    encode_rgb(&pixels, report.size)
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

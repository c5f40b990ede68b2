//! Colours: sRGB and black-body radiation become linear Rec. 709.

use crate::scene::Rgb;

/// Luminance weights of linear Rec. 709, ITU-R BT.709-6.
pub(crate) const LUMINANCE: Rgb = [0.2126, 0.7152, 0.0722];

/// Undoes the sRGB curve (IEC 61966-2-1) of one channel, 0 ..= 1.
pub(crate) fn linear_from_srgb(value: f64) -> f64 {
    if value <= 0.040_45 { value / 12.92 } else { libm::pow((value + 0.055) / 1.055, 2.4) }
}

/// Linear colour of `#rrggbb`.
pub(crate) fn linear_from_hex(bytes: [u8; 3]) -> Rgb {
    bytes.map(|byte| linear_from_srgb(f64::from(byte) / 255.0))
}

/// Coolest and hottest black body, in kelvins.
pub(crate) const BLACKBODY_RANGE: [f64; 2] = [500.0, 100_000.0];

/// Colour of a black body at `kelvin` (500 ..= 100 000), with luminance 1.
///
/// Planck's law times the CIE 1931 observer, summed over 360 to 830 nm, then XYZ to Rec. 709.
/// Channels below zero (deep red lies outside Rec. 709) become zero before the colour is scaled.
pub(crate) fn blackbody(kelvin: f64) -> Rgb {
    let mut xyz = [0.0; 3];
    for nm in 360..=830 {
        let nm = f64::from(nm);
        let power = planck(nm, kelvin);
        for (sum, weight) in xyz.iter_mut().zip(observer(nm)) {
            *sum += power * weight;
        }
    }
    let [x, y, z] = xyz.map(|v| v / xyz[1]);
    let rgb = [
        3.240_454_2 * x - 1.537_138_5 * y - 0.498_531_4 * z,
        -0.969_266_0 * x + 1.876_010_8 * y + 0.041_556_0 * z,
        0.055_643_4 * x - 0.204_025_9 * y + 1.057_225_2 * z,
    ]
    .map(|v| v.max(0.0));
    let luminance: f64 = rgb.iter().zip(LUMINANCE).map(|(c, w)| c * w).sum();
    rgb.map(|c| c / luminance)
}

/// Spectral radiance at `nm` nanometres relative to that at 560 nm: only its shape matters here, and
/// the ratio stays finite for cold bodies.
fn planck(nm: f64, kelvin: f64) -> f64 {
    // Second radiation constant, metres times kelvins (CODATA 2018).
    const C2: f64 = 1.438_776_877e-2;
    let exponent = |nm: f64| C2 / (nm * 1e-9 * kelvin);
    let ratio = libm::exp(exponent(560.0) - exponent(nm));
    let tail = -libm::expm1(-exponent(560.0)) / -libm::expm1(-exponent(nm));
    libm::pow(560.0 / nm, 5.0) * ratio * tail
}

/// CIE 1931 2-degree observer, the multi-lobe fit of Wyman, Sloan and Shirley 2013, "Simple Analytic
/// Approximations to the CIE XYZ Color Matching Functions", JCGT 2(2).
fn observer(nm: f64) -> [f64; 3] {
    let lobe = |height: f64, middle: f64, below: f64, above: f64| {
        let t = (nm - middle) / if nm < middle { below } else { above };
        height * libm::exp(-0.5 * t * t)
    };
    [
        lobe(1.056, 599.8, 37.9, 31.0)
            + lobe(0.362, 442.0, 16.0, 26.7)
            + lobe(-0.065, 501.1, 20.4, 26.2),
        lobe(0.821, 568.8, 46.9, 40.5) + lobe(0.286, 530.9, 16.3, 31.1),
        lobe(1.217, 437.0, 11.8, 36.0) + lobe(0.681, 459.0, 26.0, 13.8),
    ]
}

#[cfg(test)]
#[expect(clippy::float_cmp, reason = "the ends of the curve are exact")]
mod tests {
    use super::*;

    #[test]
    fn black_bodies_have_luminance_one_and_the_colours_of_the_planckian_locus() {
        for kelvin in [500.0, 1000.0, 1900.0, 4300.0, 6504.0, 20_000.0, 100_000.0] {
            let rgb = blackbody(kelvin);
            let luminance: f64 = rgb.iter().zip(LUMINANCE).map(|(c, w)| c * w).sum();
            assert!((luminance - 1.0).abs() < 1e-12, "{kelvin}: {rgb:?}");
            assert!(rgb.iter().all(|c| c.is_finite() && *c >= 0.0));
        }
        // The Planckian locus passes (0.3135, 0.3237) at 6504 K; Rec. 709's white is (0.3127, 0.3290).
        let [r, g, b] = blackbody(6504.0);
        assert!((r - 1.03).abs() < 0.03 && (g - 0.99).abs() < 0.02 && (b - 1.02).abs() < 0.03);
        let [r, _, b] = blackbody(2856.0);
        assert!(r > 1.8 && b < 0.35, "illuminant A is orange");
    }

    #[test]
    fn srgb_curve_meets_its_ends() {
        assert_eq!(linear_from_hex([0, 0, 0]), [0.0; 3]);
        assert_eq!(linear_from_hex([255, 255, 255]), [1.0; 3]);
        assert!((linear_from_srgb(0.5) - 0.214_041).abs() < 1e-6);
    }
}

//! Mean reflectances of smooth interfaces, in double precision: what a material record holds so that the
//! kernel needs no integral.

/// Mean reflectance of the interface of a medium of refractive index `ior` >= 1 for diffuse light from
/// within: total internal reflection included. 0 for an index of 1; 0.59635 for 1.5.
///
/// Radiance in equilibrium gives it from the mean for light from outside: 1 - B = (1 - A) / ior^2.
pub(super) fn mean_from_within(ior: f64) -> f64 {
    1.0 - (1.0 - mean_from_outside(ior)) / (ior * ior)
}

/// Mean reflectance for diffuse light from outside: 0.09178 for an index of 1.5.
///
/// Below an index of 1 + 1e-4 the terms of the closed form cancel to less than rounding leaves; the mean is
/// under 4e-5 there, and is taken in proportion to the index less one.
fn mean_from_outside(ior: f64) -> f64 {
    const NEAR: f64 = 1e-4;
    let less = ior - 1.0;
    if less < NEAR { walsh(1.0 + NEAR) * less.max(0.0) / NEAR } else { walsh(ior) }
}

/// Walsh 1926, "The Reflection Factor of a Polished Glass Surface for Diffused Light". `n` well above 1.
fn walsh(n: f64) -> f64 {
    let less = n - 1.0;
    let (n2, n3, n4) = (n * n, n * n * n, n * n * n * n);
    let (plus, minus) = (n2 + 1.0, less * (n + 1.0));
    0.5 + less * (3.0 * n + 1.0) / (6.0 * (n + 1.0) * (n + 1.0))
        + n2 * minus * minus / (plus * plus * plus) * libm::log(less / (n + 1.0))
        - 2.0 * n3 * (n2 + 2.0 * n - 1.0) / (plus * plus * minus)
        + 8.0 * n4 * (n4 + 1.0) / (plus * plus * plus * minus * minus) * libm::log(n)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Fresnel's mean by quadrature over the cosine squared.
    fn quadrature(eta: f64) -> f64 {
        let n = 200_000;
        let at = |i: u32| {
            let c = ((f64::from(i) + 0.5) / f64::from(n)).sqrt();
            let g2 = eta * eta - 1.0 + c * c;
            if g2 <= 0.0 {
                return 1.0;
            }
            let g = g2.sqrt();
            let s = (c - g) / (c + g);
            let p = (eta * eta * c - g) / (eta * eta * c + g);
            0.5 * (s * s + p * p)
        };
        (0..n).map(at).sum::<f64>() / f64::from(n)
    }

    #[test]
    fn means_are_those_of_quadrature() {
        for ior in [1.00001, 1.00015, 1.001, 1.1, 1.333, 1.5, 1.65, 2.42, 10.0] {
            let (outside, within) = (mean_from_outside(ior), mean_from_within(ior));
            assert!((outside - quadrature(ior)).abs() < 2e-6, "{ior}: {outside}");
            assert!((within - quadrature(1.0 / ior)).abs() < 2e-5, "{ior}: {within}");
        }
        assert!((mean_from_outside(1.5) - 0.09178).abs() < 1e-5);
        assert!((mean_from_within(1.5) - 0.59635).abs() < 1e-5);
        assert!((mean_from_outside(10.0) - 0.64017).abs() < 1e-5);
        assert!((mean_from_within(10.0) - 0.99640).abs() < 1e-5);
        assert!(mean_from_within(1.0).abs() < 1e-15);
    }
}

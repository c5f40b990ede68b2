//! Exact reflectance and transmittance of scattering layers: what the random walks are compared with.
//!
//! Isotropic scattering, no interface, light at normal incidence. A half-space by Chandrasekhar's H
//! function; a layer by the integral equation of its collision density.

/// Reflectance of a half-space of single-scattering albedo `a` < 1: 1 - H(1) sqrt(1 - a).
/// Chandrasekhar 1960, "Radiative Transfer", ch. 5; H by iteration of its integral equation.
#[must_use]
pub fn half_space(a: f64) -> f64 {
    let n = 2000;
    let mu = |i: usize| (i as f64 + 0.5) / n as f64;
    let root = (1.0 - a).sqrt();
    let h_at = |h: &[f64], x: f64| {
        let sum: f64 = h.iter().enumerate().map(|(i, h)| h * mu(i) / (x + mu(i))).sum();
        1.0 / (root + 0.5 * a * sum / n as f64)
    };
    let mut h = vec![1.0; n];
    loop {
        let next: Vec<f64> = (0..n).map(|i| h_at(&h, mu(i))).collect();
        let moved = next.iter().zip(&h).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
        h = next;
        if moved < 1e-9 {
            return 1.0 - h_at(&h, 1.0) * root;
        }
    }
}

/// Exponential integrals E1, E2, E3 at x > 0. Abramowitz & Stegun 5.1: the series below 1, the continued
/// fraction above.
fn integrals(x: f64) -> [f64; 3] {
    let e1 = if x < 1.0 {
        let mut term = 1.0;
        let mut sum = -0.577_215_664_901_532_9 - x.ln();
        for k in 1..30 {
            term *= -x / f64::from(k);
            sum -= term / f64::from(k);
        }
        sum
    } else {
        let tail = (1..200).rev().fold(0.0, |t, k| {
            let k = f64::from(k);
            k / (1.0 + k / (x + t))
        });
        (-x).exp() / (x + tail)
    };
    let e2 = (-x).exp() - x * e1;
    [e1, e2, 0.5 * ((-x).exp() - x * e2)]
}

/// E2 and E3 at x >= 0.
fn e2_e3(x: f64) -> [f64; 2] {
    if x <= 0.0 {
        return [1.0, 0.5];
    }
    let [_, e2, e3] = integrals(x);
    [e2, e3]
}

/// Reflectance and transmittance, the unscattered light included, of a layer of optical thickness
/// `depth` and albedo `a`. The collision density C(t) = e^-t + a/2 ∫ E1(|t - s|) C(s) ds, constant in each
/// of 1000 cells; a collision leaves unscattered with chance E2 of its depth over 2.
#[must_use]
pub fn layer(depth: f64, a: f64) -> [f64; 2] {
    let n = 1000_usize;
    let h = depth / n as f64;
    let edge: Vec<[f64; 2]> = (0..=n).map(|i| e2_e3(i as f64 * h)).collect();
    // From the middle of one cell to all of the cell k further on.
    let reach: Vec<f64> = (0..n)
        .map(|k| {
            let [far, _] = e2_e3((k as f64 + 0.5) * h);
            if k == 0 { 2.0 * (1.0 - far) } else { e2_e3((k as f64 - 0.5) * h)[0] - far }
        })
        .collect();
    let first: Vec<f64> = (0..n).map(|i| (-(i as f64 + 0.5) * h).exp()).collect();
    let mut density = first.clone();
    loop {
        let next: Vec<f64> = (0..n)
            .map(|i| {
                let sum: f64 = (0..n).map(|j| reach[i.abs_diff(j)] * density[j]).sum();
                first[i] + 0.5 * a * sum
            })
            .collect();
        let moved = next.iter().zip(&density).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
        density = next;
        if moved < 1e-7 {
            break;
        }
    }
    // ∫ E2 over a cell is a difference of E3.
    let leave = |i: usize| edge[i][1] - edge[i + 1][1];
    let back: f64 = (0..n).map(|i| density[i] * leave(i)).sum();
    let through: f64 = (0..n).map(|i| density[i] * leave(n - 1 - i)).sum();
    [0.5 * a * back, (-depth).exp() + 0.5 * a * through]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_not_absorbed_leaves() {
        let [back, through] = layer(2.0, 1.0);
        assert!((back + through - 1.0).abs() < 1e-4, "{back} {through}");
    }

    /// Two methods that share nothing: H by its own equation, the layer by its collision density.
    #[test]
    fn a_thick_layer_is_a_half_space() {
        for a in [0.3, 0.5, 0.8, 0.9] {
            let ([back, through], truth) = (layer(20.0, a), half_space(a));
            assert!((back - truth).abs() < 1e-4 && through < 1e-3, "{a}: {back} {through} {truth}");
        }
    }
}

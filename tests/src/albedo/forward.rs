//! What the forward lobe of a thin sheet does not let through, by quadrature over the phase function.

use std::f64::consts::TAU;

/// L of `leaf_albedo.wgsl` at cosine `c` for the mean cosine `g`, -1 ..= 1.
pub(super) fn lost(c: f64, g: f64) -> f64 {
    let c = c.max(1e-4);
    let flat = (1.0 - c * c).max(0.0).sqrt();
    let (n, m) = (512_usize, 64_usize);
    let mut kept = 0.0;
    for k in 0..n {
        let mu = turn(g, (k as f64 + 0.5) / n as f64);
        let sin = (1.0 - mu * mu).max(0.0).sqrt();
        for j in 0..m {
            let azimuth = ((j as f64 + 0.5) / m as f64 * TAU).cos();
            // Cosine to the normal behind the sheet.
            let cos_i = mu * c + sin * flat * azimuth;
            kept += (cos_i / c).clamp(0.0, 1.0);
        }
    }
    1.0 - kept / (n * m) as f64
}

/// The cosine of turning below which the share `u` of Henyey & Greenstein's function lies.
fn turn(g: f64, u: f64) -> f64 {
    if g.abs() >= 1.0 {
        return g;
    }
    if g.abs() < 1e-9 {
        return 2.0 * u - 1.0;
    }
    let s = (1.0 - g * g) / (1.0 - g + 2.0 * g * u);
    ((1.0 + g * g - s * s) / (2.0 * g)).clamp(-1.0, 1.0)
}

//! What one scattering at GGX microfacets gives back, by quadrature over the visible normals.
//!
//! Local frame: z is the normal, directions unit and above the surface. Masking: Smith with correlated heights.

use std::f64::consts::TAU;

use glam::{DVec2, DVec3};

/// Points of a quadrature: along the height of the cap of visible normals, and around it.
pub type Points = [usize; 2];

/// The direction at cosine `c` and azimuth `turn` from the x axis.
#[must_use]
pub fn direction(c: f64, turn: f64) -> DVec3 {
    let c = c.max(1e-4);
    let flat = (1.0 - c * c).max(0.0).sqrt();
    DVec3::new(flat * turn.cos(), flat * turn.sin(), c)
}

/// Length of `w` on the ellipsoid of widths `alpha`.
fn length(w: DVec3, alpha: DVec2) -> f64 {
    DVec3::new(w.x * alpha.x, w.y * alpha.y, w.z).length()
}

/// G2 over the masking of `o` alone, for the other direction `i` on either side.
fn seen(o: DVec3, i: DVec3, alpha: DVec2) -> f64 {
    let (lo, li, c) = (length(o, alpha), length(i, alpha), i.z.abs());
    c * (o.z + lo) / (lo * c + li * o.z)
}

/// The mean of `f` over the normals visible from `o`: Dupuy & Benyoub 2023, CGF 42(8), with points that crowd where
/// the normals lean most.
fn over_normals(o: DVec3, alpha: DVec2, points: Points, f: impl Fn(DVec3) -> DVec2) -> DVec2 {
    let [n, m] = points.map(|n| n as f64);
    let i = DVec3::new(o.x * alpha.x, o.y * alpha.y, o.z).normalize();
    let mut sum = DVec2::ZERO;
    for k in 0..points[0] {
        let t = (k as f64 + 0.5) / n;
        let z = t * t * t * (1.0 + i.z) - i.z;
        let flat = (1.0 - z * z).max(0.0).sqrt();
        for j in 0..points[1] {
            let (sin, cos) = ((j as f64 + 0.5) / m * TAU).sin_cos();
            let h = i + DVec3::new(flat * cos, flat * sin, z);
            let normal = DVec3::new(h.x * alpha.x, h.y * alpha.y, h.z.max(1e-300)).normalize();
            sum += f(normal) * (3.0 * t * t);
        }
    }
    sum / (n * m)
}

/// E = 1 - M, and B: the mean of (1 - wo.h)^5 over what comes back.
#[must_use]
pub fn reflected(o: DVec3, alpha: DVec2, points: Points) -> DVec2 {
    over_normals(o, alpha, points, |h| {
        let c = o.dot(h).min(1.0);
        let i = 2.0 * c * h - o;
        let seen = if i.z > 0.0 { seen(o, i, alpha) } else { 0.0 };
        DVec2::new(seen, seen * (1.0 - c).powi(5))
    })
}

/// What a smooth coat of index 1.5 keeps from coming out that it let in from `o`: the mean of how much more it reflects
/// of what comes back than of `o`, where that is more.
#[must_use]
pub fn flattened(o: DVec3, alpha: DVec2, points: Points) -> f64 {
    flattened_under(|c| 0.96 * (1.0 - c).max(0.0).powi(5), o, alpha, points)
}

/// What a layer that reflects `layer` of a cosine keeps so.
#[must_use]
pub fn flattened_under(layer: impl Fn(f64) -> f64, o: DVec3, alpha: DVec2, points: Points) -> f64 {
    let own = layer(o.z);
    let lost = over_normals(o, alpha, points, |h| {
        let i = 2.0 * o.dot(h).min(1.0) * h - o;
        let lost = if i.z > 0.0 { seen(o, i, alpha) * (layer(i.z) - own).max(0.0) } else { 0.0 };
        DVec2::new(lost, 0.0)
    });
    lost.x
}

/// What a dielectric of index `eta` behind the surface over that before it reflects, and what it transmits.
#[must_use]
pub fn dielectric(o: DVec3, alpha: f64, eta: f64, points: Points) -> DVec2 {
    let alpha = DVec2::splat(alpha);
    over_normals(o, alpha, points, |h| {
        let c = o.dot(h).min(1.0);
        if c <= 0.0 {
            return DVec2::ZERO;
        }
        let (f, g) = fresnel(c, eta);
        let i = 2.0 * c * h - o;
        let back = if i.z > 0.0 { f * seen(o, i, alpha) } else { 0.0 };
        let through = (h * (c - g) - o) / eta;
        let on = if f < 1.0 && through.z < 0.0 { (1.0 - f) * seen(o, through, alpha) } else { 0.0 };
        DVec2::new(back, on)
    })
}

/// The share that a smooth interface reflects at cosine `c`, and eta times the cosine behind it.
fn fresnel(c: f64, eta: f64) -> (f64, f64) {
    let g2 = eta * eta - 1.0 + c * c;
    if g2 <= 0.0 {
        return (1.0, 0.0);
    }
    let g = g2.sqrt();
    let (s, p) = ((c - g) / (c + g), (eta * eta * c - g) / (eta * eta * c + g));
    (0.5 * (s * s + p * p), g)
}

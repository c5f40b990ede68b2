//! Reflectance of a smooth interface: Schlick as the naive form uses it, the textbook's exact form in single
//! precision, and the kernel's.

#![expect(clippy::cast_possible_truncation, reason = "all forms but the truth compute in f32")]

use super::{Topic, percent, row, tiny};
use crate::kernel::Bench;

/// Unpolarised reflectance in double precision. `c`: cosine of the incident angle; `m`: index behind over
/// the one before, less 1. Sums and differences are those of Cook & Torrance 1982.
#[must_use]
pub fn truth(c: f64, m: f64) -> f64 {
    let e2 = m * (m + 2.0);
    let g2 = e2 + c * c;
    if g2 <= 0.0 {
        return 1.0;
    }
    let g = g2.sqrt();
    let rs = e2 / (c + g).powi(2);
    let s2 = (1.0 - c) * (1.0 + c);
    let k = (c * g - s2) / (c * g + s2);
    0.5 * rs * rs * (1.0 + k * k)
}

/// Naive: Schlick with the cosine of the incident angle on either side, 1 past the critical angle.
#[must_use]
pub fn naive(c: f32, m: f32) -> f32 {
    let eta = 1.0 / (1.0 + m);
    let sine = (1.0 - c * c).max(0.0).sqrt();
    if eta * sine > 1.0 {
        return 1.0;
    }
    let r0 = ((1.0 - eta) / (1.0 + eta)).powi(2);
    r0 + (1.0 - r0) * (1.0 - c).powi(5)
}

/// The textbook's exact form in single precision.
#[must_use]
pub fn textbook(c: f32, m: f32) -> f32 {
    let eta = 1.0 + m;
    let sine2 = (1.0 - c * c) / (eta * eta);
    if sine2 >= 1.0 {
        return 1.0;
    }
    let t = (1.0 - sine2).sqrt();
    let parallel = (eta * c - t) / (eta * c + t);
    let perpendicular = (c - eta * t) / (c + eta * t);
    0.5 * (parallel * parallel + perpendicular * perpendicular)
}

/// Largest absolute and largest relative error of the naive form, the textbook and the kernel, against the truth
/// for the same single-precision numbers.
#[derive(Clone, Copy, Debug, Default)]
pub struct Errors {
    /// Of the naive form, the textbook, the kernel.
    pub absolute: [f64; 3],
    /// Of the naive form, the textbook, the kernel.
    pub relative: [f64; 3],
    /// Means over a diffuse field, 2 c dc: of the truth, then as above.
    pub mean: [f64; 4],
}

/// Compares all forms at index ratio 1 + `m`.
#[must_use]
pub fn compare(m: f32) -> Errors {
    let bench = Bench::new();
    let mut kernel = bench.single();
    let mut errors = Errors::default();
    let grazing = (0..200).map(|i| (1e-5 * 1.05_f64.powi(i), 0.0));
    let n = 20_000;
    let even = (0..n).map(|i| (f64::from(i) + 0.5) / f64::from(n));
    for (c, weight) in grazing.chain(even.map(|c| (c, 2.0 * c / f64::from(n)))) {
        let c = c as f32;
        let exact = truth(f64::from(c), f64::from(m));
        let ours = kernel.fresnel_dielectric(c, 1.0 + m, m);
        errors.mean[0] += weight * exact;
        for (k, form) in [naive(c, m), textbook(c, m), ours].map(f64::from).into_iter().enumerate()
        {
            errors.mean[k + 1] += weight * form;
            errors.absolute[k] = errors.absolute[k].max((form - exact).abs());
            if exact > 0.0 {
                errors.relative[k] = errors.relative[k].max((form / exact - 1.0).abs());
            }
        }
    }
    errors
}

/// 1 / index - 1 without a difference.
fn inside(index_minus_1: f32) -> f32 {
    -index_minus_1 / (1.0 + index_minus_1)
}

/// Measures the topic.
#[must_use]
pub fn topic() -> Topic {
    let glass = compare(0.5);
    let back = compare(inside(0.5));
    let faint = compare(1e-4);
    let fainter = compare(1e-6);
    let none = compare(0.0);
    let figure = |x: f64| format!("{x:.4}");
    Topic {
        title: "Fresnel reflectance: Schlick is for the way in",
        places: &["shaders/wgsl/bsdf/fresnel.wgsl"],
        rows: vec![
            row(
                "largest error, into glass of index 1.5",
                figure(glass.absolute[0]),
                tiny(glass.absolute[2]),
            ),
            row(
                "largest error, out of it (ours next to the critical angle)",
                figure(back.absolute[0]),
                tiny(back.absolute[2]),
            ),
            row(
                format!("mean out of it, over a diffuse field (truth {:.4})", back.mean[0]),
                figure(back.mean[1]),
                figure(back.mean[3]),
            ),
            row(
                format!("the same into index 1.0001 (truth {})", percent(faint.mean[0])),
                percent(faint.mean[1]),
                percent(faint.mean[3]),
            ),
            row(
                "textbook form: largest relative error, index 1.000001",
                tiny(fainter.relative[1]),
                tiny(fainter.relative[2]),
            ),
            row(
                "textbook form: reflectance of no interface at all, largest",
                figure(none.absolute[1]),
                tiny(none.absolute[2]),
            ),
        ],
        fact: "On the way out of glass Schlick's approximation with the incident cosine jumps from \
            4 % to 1 at the critical angle, and near an index of 1 it is wrong on either side. The \
            exact form costs one square root: with e = (η - 1)(η + 1) and g² = e + c², g - c is e \
            / (g + c), which does not cancel. (Cook & Torrance 1982, *A Reflectance Model for \
            Computer Graphics*.)",
    }
}

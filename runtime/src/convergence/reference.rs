//! A picture and what it should be → how wrong it is, and how much of that is not noise.

use super::estimate::{Blocks, TRIM, share, trimmed_mean};
use crate::film::Film;
use crate::region::Rect;
use crate::replicate::{REPLICATES, luminance, moments};
use std::fmt;

/// Standard errors that a bias must be away from 0 to be believed.
const BELIEVED: f64 = 3.0;

/// What a picture converges to.
#[derive(Clone, PartialEq)]
pub struct Reference {
    /// Whole image in pixels.
    pub image_size: [u32; 2],
    /// The pixels that there are.
    pub region: Rect,
    /// Luminance.
    values: Vec<f64>,
    /// Variance of the luminance; empty where nobody measured it.
    variance: Vec<f64>,
}

/// Without the pixels.
impl fmt::Debug for Reference {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Reference").field("region", &self.region).finish_non_exhaustive()
    }
}

/// A picture against its reference, in luminance.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Versus {
    /// Mean square of the difference.
    pub mse: f64,
    /// Root of it.
    pub rmse: f64,
    /// `sqrt(mean(d^2 / (R^2 + e^2)))`, to be compared with `Noise::rel`; its square is relMSE.
    pub rel: f64,
    /// The same without the worst 0.1 % of the pixels.
    pub rel_trim: f64,
    /// Mean of `2 |I - R| / (|I| + |R|)`, from 0 to 2.
    pub smape: f64,
    /// `mse` less the variance of both pictures: the mean square of what no more samples remove.
    pub bias2: f64,
    /// The same surplus, each pixel over `R^2 + e^2` so that the bright ones do not rule it, over its
    /// standard error from blocks; `None` where the variance of the reference is not known.
    pub z: Option<f64>,
}

impl Versus {
    /// What `bias2` says.
    #[must_use]
    pub fn verdict(&self) -> &'static str {
        match self.z {
            None => "unknown: the reference has no variance",
            Some(z) if z > BELIEVED => "biased",
            Some(z) if z < -BELIEVED => "overestimated noise",
            Some(_) => "unbiased",
        }
    }
}

impl Reference {
    /// The luminance of a film, with its variance where replicates made it.
    #[must_use]
    pub fn of(film: &Film) -> Self {
        let values = film.means().into_iter().map(luminance).collect();
        let (image_size, region) = (film.image_size, film.region);
        Self { image_size, region, values, variance: film.variance.clone() }
    }

    /// Whether it shows the same pixels.
    #[must_use]
    pub fn shows(&self, image_size: [u32; 2], region: Rect) -> bool {
        self.image_size == image_size && self.region == region
    }

    /// Judges a picture of the same pixels. `scale` times a sum is the mean of a replicate; `e` is
    /// what counts as black.
    #[must_use]
    pub fn judge(&self, sums: &[[f64; REPLICATES]], scale: f64, e: f64) -> Versus {
        let width = self.region.w as usize;
        let n = self.values.len().max(1) as f64;
        let (mut relative, mut surplus) = (Vec::new(), Vec::new());
        let (mut mse, mut smape, mut bias2) = (0.0, 0.0, 0.0);
        for (i, (sums, reference)) in sums.iter().zip(&self.values).enumerate() {
            let (y, v) = moments(sums, scale);
            let square = (y - reference) * (y - reference);
            mse += square / n;
            smape += share(2.0 * (y - reference).abs(), y.abs() + reference.abs()) / n;
            let more = square - v - self.variance.get(i).copied().unwrap_or(0.0);
            bias2 += more / n;
            let judged_by = reference * reference + e * e;
            relative.push(share(square, judged_by));
            surplus.push(share(more, judged_by));
        }
        let rel = (relative.iter().sum::<f64>() / n).sqrt();
        let rel_trim = trimmed_mean(&mut relative, TRIM).sqrt();
        let bias = Blocks::of(surplus.iter().copied(), width, self.values.len() / width.max(1));
        let z = (!self.variance.is_empty()).then(|| share(bias.mean, bias.error));
        Versus { mse, rmse: mse.sqrt(), rel, rel_trim, smape, bias2, z }
    }
}

//! A picture that is known well → how wrong others of the same pixels are.

use runtime::Film;
use runtime::convergence::luminance;

/// Luminance of every pixel as it should be, and the variance that is left of it.
#[derive(Clone, Debug)]
pub struct Truth {
    pixels: Vec<(f64, f64)>,
    /// What counts as black: a hundredth of the mean.
    pub e: f64,
}

impl Truth {
    /// What a film of replicates shows.
    #[must_use]
    pub fn of(film: &Film) -> Self {
        let values = film.means().into_iter().map(luminance);
        let pixels: Vec<_> = values.zip(film.variance.iter().copied()).collect();
        let truth = Self { pixels, e: 0.0 };
        Self { e: 0.01 * truth.light(), ..truth }
    }

    /// Mean luminance.
    #[must_use]
    pub fn light(&self) -> f64 {
        self.pixels.iter().map(|(y, _)| y).sum::<f64>() / self.pixels.len() as f64
    }

    /// Variance of `light`.
    #[must_use]
    pub fn variance_of_light(&self) -> f64 {
        let n = self.pixels.len() as f64;
        self.pixels.iter().map(|(_, variance)| variance).sum::<f64>() / (n * n)
    }

    /// relMSE of a picture: mean of `d^2 / (Y^2 + e^2)` in luminance, where `d^2` lacks the variance of the truth itself.
    #[must_use]
    pub fn rel_mse(&self, pixels: &[[f64; 3]]) -> f64 {
        self.squares(pixels).sum::<f64>() / self.pixels.len() as f64
    }

    /// The same without the worst thousandth of the pixels, which else may be most of it.
    #[must_use]
    pub fn trimmed_rel_mse(&self, pixels: &[[f64; 3]]) -> f64 {
        let mut squares: Vec<f64> = self.squares(pixels).collect();
        squares.sort_by(f64::total_cmp);
        squares.truncate(squares.len() - squares.len().div_ceil(1000));
        squares.iter().sum::<f64>() / squares.len() as f64
    }

    fn squares(&self, pixels: &[[f64; 3]]) -> impl Iterator<Item = f64> {
        pixels.iter().zip(&self.pixels).map(|(rgb, &(truth, variance))| {
            ((luminance(*rgb) - truth).powi(2) - variance) / (truth * truth + self.e * self.e)
        })
    }
}

//! Names in files that are the same in both styles of names.

/// Channels of what rounding left over.
pub(super) const RESIDUALS: [&str; 3] = ["residual.R", "residual.G", "residual.B"];
/// The channel of the samples of each pixel.
pub(super) const COUNTS: &str = "samples";
/// The channel of the variance of the mean luminance.
pub(super) const VARIANCE: &str = "variance.Y";
/// Attribute of pictures that are denoised.
pub(super) const DENOISER: &str = "denoiser";

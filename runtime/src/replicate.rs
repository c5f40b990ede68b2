//! Replicates: pictures of one scene with independent noise, whose mean is the picture that is kept.
//!
//! Turns the seed of an image into theirs, and sums of a pixel into its mean and variance. It knows no film.

/// Pictures of independent noise.
pub const REPLICATES: usize = 4;
/// `REPLICATES` as a count of samples.
pub(crate) const REPLICATES_U32: u32 = 4;

/// Luminance of linear Rec. 709, ITU-R BT.709-6, item 3.2.
#[must_use]
pub fn luminance([r, g, b]: [f64; 3]) -> f64 {
    0.2126 * r + 0.7152 * g + 0.0722 * b
}

/// The seed of a replicate: the first has that of the image, so it is part of the usual picture.
/// Both samplers hash the seed, so any other number makes other noise.
#[must_use]
pub fn replicate_seed(seed: u32, replicate: u32) -> u32 {
    // 2^32 over the golden ratio: far from the seeds that people choose.
    seed.wrapping_add(replicate.wrapping_mul(0x9e37_79b9))
}

/// Mean of a pixel and the variance of that mean. `scale` times a sum is the mean of a replicate.
#[must_use]
pub fn moments(sums: &[f64; REPLICATES], scale: f64) -> (f64, f64) {
    const R: f64 = REPLICATES as f64;
    let mean = sums.iter().sum::<f64>() / R;
    let square = sums.iter().map(|sum| (sum - mean) * (sum - mean)).sum::<f64>();
    (mean * scale, square * scale * scale / (R * (R - 1.0)))
}

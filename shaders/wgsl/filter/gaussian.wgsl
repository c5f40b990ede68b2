// A normal distribution around the middle of the pixel, cut off at a circle of three standard deviations.

#import "math/exp_log.wgsl"
#import "math/disk.wgsl"

// Offset from the middle of the pixel, pixels: a sixth of `width` is the standard deviation, half of it the longest
// offset. `u` in [0, 1)^2. Box & Muller 1958, with the share 1 - e^-4.5 of a normal distribution that is in the circle.
fn gaussian_offset(u: vec2f, width: f32) -> vec2f {
    // -2 ln(x) = -2 ln(2) log2(x).
    let at = disk_concentric(u);
    let square = -1.3862944 * exp_log_log2(1.0 - 0.9888910 * at.r * at.r);
    return at.turn * (sqrt(max(square, 0.0)) * (width / 6.0));
}

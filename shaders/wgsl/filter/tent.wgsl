// A filter that falls off evenly along each axis.

// Offset from the middle of the pixel, pixels, with density (1 - |x|) (1 - |y|) in halves of `width`. `u` in [0, 1)^2.
fn tent_offset(u: vec2f, width: f32) -> vec2f {
    return vec2f(tent_axis(u.x), tent_axis(u.y)) * (0.5 * width);
}

// The inverse of the distribution function of 1 - |x| on -1 ..= 1.
fn tent_axis(u: f32) -> f32 {
    return select(1.0 - sqrt(max(2.0 - 2.0 * u, 0.0)), sqrt(2.0 * u) - 1.0, u < 0.5);
}

// A square around the middle of the pixel.

// Offset from the middle of the pixel, pixels, uniform in a square of side `width`. `u` in [0, 1)^2.
fn box_offset(u: vec2f, width: f32) -> vec2f {
    return (u - 0.5) * width;
}

// The four-term window of Blackman and Harris along each axis.

#import "math/sincos.wgsl"

// Offset from the middle of the pixel, pixels, at most half of `width` along each axis. `u` in [0, 1)^2.
fn blackman_harris_offset(u: vec2f, width: f32) -> vec2f {
    return vec2f(blackman_harris_axis(u.x), blackman_harris_axis(u.y)) * width;
}

// The inverse of the distribution function, in -1/2 ..= 1/2: bisection of the lower half to intervals of 1/512, in
// which it is almost straight.
fn blackman_harris_axis(u: f32) -> f32 {
    let share = min(u, 1.0 - u);
    var low = 0.0;
    var width = 0.5;
    for (var i = 0u; i < 8u; i += 1u) {
        width *= 0.5;
        low = select(low, low + width, blackman_harris_below(low + width) <= share);
    }
    let below = blackman_harris_below(low);
    let rise = max(blackman_harris_below(low + width) - below, 1e-9);
    let t = low + width * clamp((share - below) / rise, 0.0, 1.0);
    return select(0.5 - t, t - 0.5, u < 0.5);
}

// Share of the window on 0 ..= 1 that is below `t`, 0 ..= 1/2: the integral of
// 0.35875 - 0.48829 cos(2 pi t) + 0.14128 cos(4 pi t) - 0.01168 cos(6 pi t), over that of all of it.
// Harris 1978, "On the use of windows for harmonic analysis with the discrete Fourier transform", table 1.
fn blackman_harris_below(t: f32) -> f32 {
    let sc = sincos_2pi(t);
    // sin 2a = 2 sin a cos a, sin 3a = sin a (3 - 4 sin^2 a).
    let third = 3.0 - 4.0 * sc.x * sc.x;
    return t - 0.21662374 * sc.x + 0.062677102 * sc.x * sc.y - 0.0017272286 * sc.x * third;
}

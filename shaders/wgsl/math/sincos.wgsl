// Sine and cosine of a fraction of a turn. The WGSL built-ins promise only 2^-11 absolute error and
// differ between devices.

// (sin, cos)(2 pi u), u in [0, 1]. Largest absolute error 8.9e-8, |s^2 + c^2 - 1| <= 2.2e-7.
// Quarter turns are folded off exactly; the rest is a least-maximum polynomial on |x| <= 1/4.
fn sincos_2pi(u: f32) -> vec2f {
    let k = floor(4.0 * u + 0.5);
    let x = 2.0 * u - 0.5 * k;
    let sc = sincos_pi(x);
    switch (u32(k) & 3u) {
        case 0u: { return sc; }
        case 1u: { return vec2f(sc.y, -sc.x); }
        case 2u: { return -sc; }
        default: { return vec2f(-sc.y, sc.x); }
    }
}

// (sin, cos)(pi x), |x| <= 1/4: the polynomials of `sincos_2pi`, with its errors.
fn sincos_pi(x: f32) -> vec2f {
    let y = x * x;
    let s = x * (3.1415927410 + y * (-5.1677126884 + y * (2.5501625538 + y * (-0.5992020965 + y * 0.0810017437))));
    let high = -1.3352619410 + y * (0.2353054136 - y * 0.0254474152);
    let c = 1.0 + y * (-4.9348020554 + y * (4.0587120056 + y * high));
    return vec2f(s, c);
}

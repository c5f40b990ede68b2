// Powers with real exponents, from arithmetic and bit patterns alone: the built-ins `pow`, `exp2`
// and `log2` differ between devices.

// 2^x. Largest relative error 9.2e-8 for x in -100 .. 100; 0 below -126, 2^127.5 above it.
// The Taylor series of 2^f on |f| <= 1/2, degree 7.
fn exp_log_exp2(x: f32) -> f32 {
    if (x < -126.0) {
        return 0.0;
    }
    let y = min(x, 127.5);
    let k = min(floor(y + 0.5), 127.0);
    let f = y - k;
    let high = 9.6181291e-3 + f * (1.3333558e-3 + f * (1.5403530e-4 + f * 1.5252734e-5));
    let p = 1.0 + f * (6.9314718e-1 + f * (2.4022651e-1 + f * (5.5504109e-2 + f * high)));
    return p * bitcast<f32>(u32(i32(k) + 127) << 23u);
}

// Logarithm to base 2 of a normal x > 0. Largest error 1.3e-7 absolute and 2.6e-7 relative on 0.5 .. 2.
// 2 artanh((m - 1) / (m + 1)) of the mantissa m in 0.7 .. 1.42, its series to the ninth power.
fn exp_log_log2(x: f32) -> f32 {
    let bits = bitcast<u32>(x);
    let mantissa = bitcast<f32>((bits & 0x007fffffu) | 0x3f800000u);
    let upper = mantissa > 1.4142135;
    let m = select(mantissa, 0.5 * mantissa, upper);
    let e = f32(i32(bits >> 23u) - 127 + select(0, 1, upper));
    let s = (m - 1.0) / (m + 1.0);
    let z = s * s;
    let p = 1.0 + z * (0.33333334 + z * (0.2 + z * (0.14285715 + z * 0.11111111)));
    return e + (2.8853900 * s) * p;
}

// x^y for x in 0 ..= 1 and y >= 0; 0 where x is 0 or subnormal. Largest relative error 1.8e-6 at
// y = 6 for x >= 0.05, and 3.6e-6 at y = 400 for x >= 0.96: it grows as |y log2 x| times 1e-7.
fn exp_log_pow(x: f32, y: f32) -> f32 {
    if (x < 1.1754944e-38) {
        return 0.0;
    }
    return exp_log_exp2(y * exp_log_log2(x));
}

// The cube root of x in 0 ..= 1, of 2^-24 where x is less. Largest relative error 4.8e-7.
fn exp_log_cbrt(x: f32) -> f32 {
    return exp_log_exp2(0.33333334 * exp_log_log2(max(x, 5.9604645e-8)));
}

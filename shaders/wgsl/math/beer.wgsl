// The law of Beer and Lambert: transmittance of an optical depth, and how to sample one.

#import "math/exp_log.wgsl"

// Transmittance e^-tau for each channel; `tau` >= 0. Largest relative error 1e-7 (1 + tau).
fn beer_transmittance(tau: vec3f) -> vec3f {
    // By division: drivers would move a factor 1 / ln 2 into the product that `tau` is.
    let t = -tau / 0.6931472;
    return vec3f(exp_log_exp2(t.x), exp_log_exp2(t.y), exp_log_exp2(t.z));
}

// Absorptance 1 - e^-tau for each channel; `tau` >= 0, `left`: e^-tau. Largest relative error 6e-6, where
// 1 - e^-tau alone has 5 % at 1e-6.
fn beer_absorptance(tau: vec3f, left: vec3f) -> vec3f {
    let series = tau * (vec3f(1.0) - tau * (vec3f(3.0) - tau) / 6.0);
    return select(vec3f(1.0) - left, series, tau < vec3f(0.01));
}

// -ln(1 - u) for u in [0, 1 - 2^-24]: an optical depth with density e^-tau. Never negative; largest relative
// error 4e-7. Below 1/2 by 2 artanh(u / (2 - u)), where the logarithm of 1 - u has lost the digits of u.
fn beer_depth(u: f32) -> f32 {
    if (u >= 0.5) {
        return -0.6931472 * exp_log_log2(1.0 - u);
    }
    let s = u / (2.0 - u);
    let z = s * s;
    let high = 0.14285715 + z * (0.11111111 + z * (0.09090909 + z * 0.07692308));
    return 2.0 * s * (1.0 + z * (0.33333334 + z * (0.2 + z * high)));
}

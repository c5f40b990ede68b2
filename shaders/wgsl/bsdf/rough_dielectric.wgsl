// A rough interface between two clear media: microfacets that reflect and refract like smooth glass.
// Walter et al. 2007, with the exact Fresnel term at the facet. Light that meets a second facet is lost: at
// an index of 1.5, from the outside at cosines 1, 0.6 and 0.2, there is left 0.999, 0.996 and 0.957 at roughness
// 0.3; 0.983, 0.946 and 0.859 at 0.6; 0.893, 0.728 and 0.489 at 1.

#import "bsdf/dielectric.wgsl"
#import "bsdf/fresnel.wgsl"
#import "bsdf/ggx.wgsl"
#import "bsdf/ggx_transmission.wgsl"
#import "bsdf/scatter.wgsl"
#import "math/basis.wgsl"
#import "math/vector.wgsl"

// Below this product of alpha and |eta - 1| refraction is narrower than directions in single precision
// resolve, and the interface counts as smooth; as does an index of 1.
const ROUGH_DIELECTRIC_NARROW: f32 = 1e-4;

// Index behind the surface over that before it, as the path comes, and the same less one.
fn rough_dielectric_eta(s: Scatter) -> vec2f {
    return select(vec2f(1.0 / s.ior, -s.ior_minus_1 / s.ior), vec2f(s.ior, s.ior_minus_1), s.front);
}

// Whether both lobes are deltas.
fn rough_dielectric_is_smooth(s: Scatter) -> bool {
    let alpha = s.roughness * s.roughness;
    return alpha < GGX_SMOOTH || alpha * abs(rough_dielectric_eta(s).y) < ROUGH_DIELECTRIC_NARROW;
}

// Samples `wi`. `u`: facet, `v`: reflection or refraction; all in [0, 1 - 2^-24].
fn rough_dielectric_sample(s: Scatter, wo: vec3f, u: vec2f, v: f32) -> Scattered {
    if (rough_dielectric_is_smooth(s)) {
        return dielectric_sample(s, wo, v);
    }
    let alpha = s.roughness * s.roughness;
    let eta = rough_dielectric_eta(s);
    let basis = basis_around(s.ns);
    let o = basis_local_from_world(basis, wo);
    if (o.z <= 0.0) {
        return scatter_absorb();
    }
    let h = ggx_transmission_normal(o, alpha, u);
    let c = min(dot(o, h), 1.0);
    let reflects = v < fresnel_dielectric(c, eta.x, eta.y);
    var i: vec3f;
    if (reflects) {
        i = h * (2.0 * c) - o;
    } else {
        i = dielectric_refract(h, o, eta.x, eta.y);
    }
    let wi = vector_unit(basis_world_from_local(basis, i));
    if (!select(scatter_below(s, wi), scatter_above(s, wi), reflects)) {
        return scatter_absorb();
    }
    let pdf = rough_dielectric_pdf(s, wo, wi);
    if (pdf <= 0.0) {
        return scatter_absorb();
    }
    let eta2 = select(eta.x * eta.x, 1.0, reflects);
    return Scattered(wi, pdf, rough_dielectric_eval(s, wo, wi) / pdf, eta2);
}

// f |cos|, for `wi` on either side of the surface; 0 where the interface is smooth.
fn rough_dielectric_eval(s: Scatter, wo: vec3f, wi: vec3f) -> vec3f {
    if (rough_dielectric_is_smooth(s) || dot(s.ns, wo) <= 0.0) {
        return vec3f(0.0);
    }
    let alpha = s.roughness * s.roughness;
    let eta = rough_dielectric_eta(s);
    let basis = basis_around(s.ns);
    let o = basis_local_from_world(basis, wo);
    let i = basis_local_from_world(basis, wi);
    if (scatter_above(s, wi)) {
        let h = o + i;
        let f = fresnel_dielectric(min(0.5 * sqrt(dot(h, h)), 1.0), eta.x, eta.y);
        return vec3f(f * ggx_eval(o, i, alpha));
    }
    if (!scatter_below(s, wi)) {
        return vec3f(0.0);
    }
    let h = ggx_transmission_facet(o, i, eta.y);
    if (h.z <= 0.0) {
        return vec3f(0.0);
    }
    let f = fresnel_dielectric(min(dot(o, h), 1.0), eta.x, eta.y);
    return vec3f((1.0 - f) * ggx_transmission_eval(o, i, h, alpha, eta.y));
}

// Density of `rough_dielectric_sample` over both lobes, per steradian of `wi`; 0 where the interface is smooth.
fn rough_dielectric_pdf(s: Scatter, wo: vec3f, wi: vec3f) -> f32 {
    if (rough_dielectric_is_smooth(s) || dot(s.ns, wo) <= 0.0) {
        return 0.0;
    }
    let alpha = s.roughness * s.roughness;
    let eta = rough_dielectric_eta(s);
    let basis = basis_around(s.ns);
    let o = basis_local_from_world(basis, wo);
    let i = basis_local_from_world(basis, wi);
    if (dot(s.ns, wi) > 0.0) {
        let h = o + i;
        let f = fresnel_dielectric(min(0.5 * sqrt(dot(h, h)), 1.0), eta.x, eta.y);
        return f * ggx_transmission_mirror_pdf(o, vector_unit(h), alpha);
    }
    let h = ggx_transmission_facet(o, i, eta.y);
    if (h.z <= 0.0) {
        return 0.0;
    }
    let f = fresnel_dielectric(min(dot(o, h), 1.0), eta.x, eta.y);
    return (1.0 - f) * ggx_transmission_pdf(o, i, h, alpha, eta.y);
}

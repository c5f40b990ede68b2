// A principled surface that is a thin sheet and lets light through: what its interface does not reflect is
// shared between the diffuse base and the other side. The sheet does not bend light; a rough one spreads it
// as it spreads what it reflects, and lets what its microfacets keep go out diffusely:
//   f = t (1 - metallic) color (min(T_o, T_j) (1 - F(wo.h)) D G2 / (4 cos_o cos_j) + n_o n_j / (pi mean n))
// with j = wi mirrored to the side of wo, and T, n as in `principled.wgsl`.
// Reciprocal: h is the same both ways. Energy: F + (1 - F) = 1 at every h, so reflected and transmitted light
// are together the unmasked share 1 - M of the lobe, and the second term gives M; what is diffuse is taken off by
// 1 - t.

#import "bsdf/diffuse.wgsl"
#import "bsdf/fresnel.wgsl"
#import "bsdf/gloss.wgsl"
#import "bsdf/principled.wgsl"
#import "bsdf/scatter.wgsl"
#import "math/vector.wgsl"
#import "scene/layers.wgsl"

// Share of light that goes through at cosine `c` to the normal that it meets.
fn thin_clear(p: Principled, c: f32) -> vec3f {
    return p.clear * (1.0 - min(fresnel_schlick_to(vec3f(p.entry.x), p.entry.y, c).x, 1.0));
}

// Probability of sampling the far side. A function of wo alone.
fn thin_probability(p: Principled) -> f32 {
    let clear = p.albedo.z;
    if (clear <= 0.0) {
        return 0.0;
    }
    let near = p.albedo.x + p.albedo.y;
    return select(clamp(clear / (clear + near), 0.1, 0.9), 1.0, near <= 0.0);
}

// The part of it that is spread evenly.
fn thin_even(p: Principled) -> f32 {
    return min(p.o.missing / max(p.o.enters, 1e-6), 1.0);
}

// `d` mirrored at the plane of the shading normal.
fn thin_mirrored(s: Scatter, d: vec3f) -> vec3f {
    return vector_unit(d - s.ns * (2.0 * dot(s.ns, d)));
}

// As `principled_direction`.
fn thin_direction(s: Scatter, p: Principled, wo: vec3f, u: vec2f, v: f32) -> Scattered {
    let cos_o = dot(s.ns, wo);
    if (cos_o <= 0.0) {
        return scatter_absorb();
    }
    let far = thin_probability(p);
    if (v >= far) {
        // No other lobe reaches the near side.
        let near = principled_direction(s, p, wo, u, min((v - far) / (1.0 - far), 0.99999994));
        return Scattered(near.wi, near.pdf, near.weight / (1.0 - far), 1.0);
    }
    if (p.gloss.alpha < GLOSS_SMOOTH) {
        return Scattered(-wo, 0.0, thin_clear(p, cos_o) * (p.o.through / far), 1.0);
    }
    var wi: vec3f;
    if (v < far * thin_even(p)) {
        wi = diffuse_direction(-s.ns, u);
    } else {
        wi = thin_mirrored(s, dispatch_gloss_sample(s, p.gloss.alpha, wo, u));
    }
    if (!scatter_below(s, wi)) {
        return scatter_absorb();
    }
    return scatter_toward(wi);
}

// What a ray keeps that goes straight through.
fn thin_straight(s: Scatter, p: Principled, wo: vec3f) -> vec3f {
    let cos_o = dot(s.ns, wo);
    if (p.gloss.alpha >= GLOSS_SMOOTH || cos_o <= 0.0) {
        return vec3f(0.0);
    }
    return thin_clear(p, cos_o) * p.o.through;
}

// f |cos| and the density over all lobes, the mirror and the straight part left out.
fn thin_eval(s: Scatter, p: Principled, wo: vec3f, wi: vec3f) -> Evaluated {
    let far = thin_probability(p);
    if (dot(s.ns, wi) >= 0.0) {
        let near = principled_eval(s, p, wo, wi);
        return Evaluated(near.f, (1.0 - far) * near.pdf);
    }
    if (p.gloss.alpha < GLOSS_SMOOTH || dot(s.ns, wo) <= 0.0) {
        return scatter_nothing();
    }
    let j = thin_mirrored(s, wi);
    let cos_j = dot(s.ns, j);
    let side = principled_side(s, p, j);
    let gloss = dispatch_gloss_eval(s, p.gloss.alpha, wo, j);
    let lobe = gloss.x * min(p.o.through, side.through);
    let several = p.several * (p.o.missing * side.missing) * cos_j;
    let value = thin_clear(p, gloss_cosine(wo, j)) * lobe + p.clear * several;
    let even = thin_even(p);
    let pdf = far * ((1.0 - even) * gloss.y + even * (-dot(s.ns, wi) * INV_PI));
    return scatter_only(Evaluated(value, pdf), scatter_below(s, wi));
}

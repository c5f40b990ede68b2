// A principled surface that is a thin sheet and lets light through: what its interface does not reflect is
// shared between the diffuse base and the other side. The sheet does not bend light; a rough one spreads it
// as it spreads what it reflects:
//   f = t (1 - metallic) color (1 - F(wo.h)) D G2 / (4 cos_o cos_j)      with j = wi mirrored to the side of wo
// Reciprocal: h is the same both ways. Energy: F + (1 - F) = 1 at every h, so reflected and transmitted light
// are together at most the unmasked share of the lobe, and what is diffuse is taken off by 1 - t.

#import "bsdf/gloss.wgsl"
#import "bsdf/principled.wgsl"
#import "bsdf/scatter.wgsl"
#import "math/vector.wgsl"

// Share of light that goes through at cosine `c` to the normal that it meets.
fn thin_clear(p: Principled, c: f32) -> vec3f {
    return p.clear * (vec3f(1.0) - principled_entry(p, c));
}

// Probability of sampling the far side. A function of wo alone.
fn thin_probability(p: Principled, cos_o: f32) -> f32 {
    let clear = vector_max(thin_clear(p, cos_o));
    if (clear <= 0.0) {
        return 0.0;
    }
    let near = vector_max(principled_fresnel(p, cos_o)) + vector_max(principled_base(p, cos_o));
    return select(clamp(clear / (clear + near), 0.1, 0.9), 1.0, near <= 0.0);
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
    let far = thin_probability(p, cos_o);
    if (v >= far) {
        // No other lobe reaches the near side.
        let near = principled_direction(s, p, wo, u, min((v - far) / (1.0 - far), 0.99999994));
        return Scattered(near.wi, near.pdf, near.weight / (1.0 - far), 1.0);
    }
    if (p.alpha < GLOSS_SMOOTH) {
        return Scattered(-wo, 0.0, thin_clear(p, cos_o) / far, 1.0);
    }
    let wi = thin_mirrored(s, gloss_sample(s.ns, wo, p.alpha, u));
    if (!scatter_below(s, wi)) {
        return scatter_absorb();
    }
    return scatter_toward(wi);
}

// What a ray keeps that goes straight through.
fn thin_straight(s: Scatter, p: Principled, wo: vec3f) -> vec3f {
    let cos_o = dot(s.ns, wo);
    if (p.alpha >= GLOSS_SMOOTH || cos_o <= 0.0) {
        return vec3f(0.0);
    }
    return thin_clear(p, cos_o);
}

// f |cos|, the mirror and the straight part left out.
fn thin_eval(s: Scatter, p: Principled, wo: vec3f, wi: vec3f) -> vec3f {
    if (dot(s.ns, wi) >= 0.0) {
        return principled_eval(s, p, wo, wi);
    }
    if (p.alpha < GLOSS_SMOOTH || dot(s.ns, wo) <= 0.0 || !scatter_below(s, wi)) {
        return vec3f(0.0);
    }
    let j = thin_mirrored(s, wi);
    return thin_clear(p, gloss_cosine(wo, j)) * gloss_eval(s.ns, wo, j, p.alpha);
}

// Density of `wi` over all lobes, per steradian, the mirror and the straight part left out.
fn thin_pdf(s: Scatter, p: Principled, wo: vec3f, wi: vec3f) -> f32 {
    let cos_o = dot(s.ns, wo);
    if (cos_o <= 0.0) {
        return 0.0;
    }
    let far = thin_probability(p, cos_o);
    if (dot(s.ns, wi) >= 0.0) {
        return (1.0 - far) * principled_pdf(s, p, wo, wi);
    }
    if (p.alpha < GLOSS_SMOOTH) {
        return 0.0;
    }
    return far * gloss_pdf(s.ns, wo, thin_mirrored(s, wi), p.alpha);
}

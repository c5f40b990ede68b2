// A clear coat of index 1.5 over the surface that the rest of a principled material makes.
//   f = c F(wo.h) D G2 / (4 cos_o cos_i) + f_bare
// with c the share under the coat and Schlick's F from 0.04. The surface below knows of the coat: `under_coat.wgsl`
// says what gets there and out again. A sheet that lets light through has its coat on the side that is lit.

#import "bsdf/gloss.wgsl"
#import "bsdf/principled.wgsl"
#import "bsdf/scatter.wgsl"
#import "bsdf/under_coat.wgsl"
#import "math/vector.wgsl"
#import "scene/bare.wgsl"

// Share of light at cosine `c`, of either sign, that a coat of share `share` reflects: Schlick 1994.
fn coat_fresnel(share: f32, c: f32) -> f32 {
    let m = clamp(1.0 - abs(c), 0.0, 1.0);
    let m2 = m * m;
    return share * (UNDER_COAT_F0 + m2 * m2 * (m * (1.0 - UNDER_COAT_F0)));
}

// Probability of sampling the coat. A function of wo alone.
fn coat_probability(s: Scatter, p: Principled) -> f32 {
    let lobe = 1.0 - p.o.through;
    let bare = p.o.through * max(vector_max(s.color), UNDER_COAT_F0);
    return clamp(lobe / (lobe + bare), 0.1, 0.9);
}

// As `principled_direction`.
fn coat_direction(s: Scatter, p: Principled, wo: vec3f, u: vec2f, v: f32) -> Scattered {
    let cos_o = dot(s.ns, wo);
    let coated = p.coat.x > 0.0 && cos_o > 0.0;
    let share = select(0.0, coat_probability(s, p), coated);
    if (v < share) {
        return coat_reflected(s, p, wo, u, share);
    }
    // v is uniform beyond the share; the least number below 1 is what rounding may not pass.
    let bare = dispatch_bare_direction(s, p, wo, u, min((v - share) / (1.0 - share), 0.99999994));
    return Scattered(bare.wi, bare.pdf, bare.weight / (1.0 - share), bare.eta2);
}

// A direction reflected by the coat, which is chosen with probability `share`.
fn coat_reflected(s: Scatter, p: Principled, wo: vec3f, u: vec2f, share: f32) -> Scattered {
    let alpha = gloss_alpha(p.coat.y);
    if (alpha < GLOSS_SMOOTH) {
        let weight = coat_fresnel(p.coat.x, dot(s.ns, wo)) / share;
        return Scattered(scatter_mirror(s, wo), 0.0, vec3f(weight), 1.0);
    }
    let wi = gloss_sample(s.ns, wo, alpha, u);
    if (!scatter_above(s, wi)) {
        return scatter_absorb();
    }
    return scatter_toward(wi);
}

// What a ray keeps that goes straight through coat and sheet.
fn coat_straight(s: Scatter, p: Principled, wo: vec3f) -> vec3f {
    return dispatch_bare_straight(s, p, wo);
}

// f |cos| and the density over all lobes, the mirror parts left out.
fn coat_eval(s: Scatter, p: Principled, wo: vec3f, wi: vec3f) -> Evaluated {
    let bare = dispatch_bare_eval(s, p, wo, wi);
    if (p.coat.x <= 0.0 || dot(s.ns, wo) <= 0.0) {
        return bare;
    }
    let share = coat_probability(s, p);
    let rest = (1.0 - share) * bare.pdf;
    let alpha = gloss_alpha(p.coat.y);
    if (alpha < GLOSS_SMOOTH || dot(s.ns, wi) <= 0.0) {
        return Evaluated(bare.f, rest);
    }
    let lobe = gloss_eval(s.ns, wo, wi, alpha);
    let value = bare.f + vec3f(coat_fresnel(p.coat.x, gloss_cosine(wo, wi)) * lobe.x);
    return scatter_only(Evaluated(value, rest + share * lobe.y), scatter_above(s, wi));
}

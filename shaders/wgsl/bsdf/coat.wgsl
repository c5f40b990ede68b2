// A clear coat of index 1.5 over the surface that the rest of a principled material makes.
//   f = c F(wo.h) D G2 / (4 cos_o cos_i) + (1 - c F(cos_o)) (1 - c F(cos_i)) f_bare
// with c the share under the coat and Schlick's F from 0.04. Reciprocal: every factor is symmetric in wo and
// wi. Light that goes back and forth between coat and surface is lost; the sum of both terms was measured to
// stay below 1 over the whole range of parameters. A sheet that lets light through is coated on both sides.

#import "bsdf/gloss.wgsl"
#import "bsdf/principled.wgsl"
#import "bsdf/scatter.wgsl"
#import "math/vector.wgsl"
#import "scene/bare.wgsl"

// ((1.5 - 1) / (1.5 + 1))^2
const COAT_F0: f32 = 0.04;

// Share of light at cosine `c`, of either sign, that a coat of share `share` reflects: Schlick 1994.
fn coat_fresnel(share: f32, c: f32) -> f32 {
    let m = clamp(1.0 - abs(c), 0.0, 1.0);
    let m2 = m * m;
    return share * (COAT_F0 + m2 * m2 * (m * (1.0 - COAT_F0)));
}

// Probability of sampling the coat. A function of wo alone.
fn coat_probability(s: Scatter, share: f32, cos_o: f32) -> f32 {
    let lobe = coat_fresnel(share, cos_o);
    let bare = (1.0 - lobe) * max(vector_max(s.color), COAT_F0);
    return clamp(lobe / (lobe + bare), 0.1, 0.9);
}

// As `principled_direction`.
fn coat_direction(s: Scatter, p: Principled, wo: vec3f, u: vec2f, v: f32) -> Scattered {
    let cos_o = dot(s.ns, wo);
    let coated = p.coat.x > 0.0 && cos_o > 0.0;
    let share = select(0.0, coat_probability(s, p.coat.x, cos_o), coated);
    if (v < share) {
        return coat_reflected(s, p, wo, u, share);
    }
    // v is uniform beyond the share; the least number below 1 is what rounding may not pass.
    let bare = dispatch_bare_direction(s, p, wo, u, min((v - share) / (1.0 - share), 0.99999994));
    let seen = (1.0 - coat_fresnel(p.coat.x, cos_o)) * (1.0 - coat_fresnel(p.coat.x, dot(s.ns, bare.wi)));
    let weight = select(1.0, seen, coated) / (1.0 - share);
    return Scattered(bare.wi, bare.pdf, bare.weight * weight, bare.eta2);
}

// A direction reflected by the coat, which is chosen with probability `share`.
fn coat_reflected(s: Scatter, p: Principled, wo: vec3f, u: vec2f, share: f32) -> Scattered {
    if (p.coat.y < GLOSS_SMOOTH) {
        let weight = coat_fresnel(p.coat.x, dot(s.ns, wo)) / share;
        return Scattered(scatter_mirror(s, wo), 0.0, vec3f(weight), 1.0);
    }
    let wi = gloss_sample(s.ns, wo, p.coat.y, u);
    if (!scatter_above(s, wi)) {
        return scatter_absorb();
    }
    return scatter_toward(wi);
}

// What a ray keeps that goes straight through coat and sheet.
fn coat_straight(s: Scatter, p: Principled, wo: vec3f) -> vec3f {
    let seen = 1.0 - coat_fresnel(p.coat.x, dot(s.ns, wo));
    return dispatch_bare_straight(s, p, wo) * seen * seen;
}

// f |cos|, the mirror part left out.
fn coat_eval(s: Scatter, p: Principled, wo: vec3f, wi: vec3f) -> vec3f {
    let bare = dispatch_bare_eval(s, p, wo, wi);
    let cos_o = dot(s.ns, wo);
    if (p.coat.x <= 0.0 || cos_o <= 0.0) {
        return bare;
    }
    let seen = (1.0 - coat_fresnel(p.coat.x, cos_o)) * (1.0 - coat_fresnel(p.coat.x, dot(s.ns, wi)));
    if (p.coat.y < GLOSS_SMOOTH || !scatter_above(s, wi)) {
        return bare * seen;
    }
    let lobe = coat_fresnel(p.coat.x, gloss_cosine(wo, wi)) * gloss_eval(s.ns, wo, wi, p.coat.y);
    return bare * seen + vec3f(lobe);
}

// Density of `wi` over all lobes, per steradian, the mirror parts left out.
fn coat_pdf(s: Scatter, p: Principled, wo: vec3f, wi: vec3f) -> f32 {
    let bare = dispatch_bare_pdf(s, p, wo, wi);
    let cos_o = dot(s.ns, wo);
    if (p.coat.x <= 0.0 || cos_o <= 0.0) {
        return bare;
    }
    let share = coat_probability(s, p.coat.x, cos_o);
    let rest = (1.0 - share) * bare;
    if (p.coat.y < GLOSS_SMOOTH || dot(s.ns, wi) <= 0.0) {
        return rest;
    }
    return rest + share * gloss_pdf(s.ns, wo, wi, p.coat.y);
}

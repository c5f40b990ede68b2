// A rough surface that is not metal: Lambert's reflection, a share of gloss from a GGX lobe without Fresnel, and
// for thin things Lambert's transmission to the other side:
//   above  f = base / pi + gloss (D G2 / (4 cos_o cos_i) + M_o M_i / (pi mean M)),     below  f = through / pi.
// M is what one reflection off the microfacets does not give back (`brushed_albedo.wgsl`).
// Reciprocal, as every term is. Energy: base + through + gloss.

#import "bsdf/brushed_albedo.wgsl"
#import "bsdf/diffuse.wgsl"
#import "bsdf/ggx_albedo.wgsl"
#import "bsdf/ggx_anisotropic.wgsl"
#import "bsdf/scatter.wgsl"
#import "math/basis.wgsl"
#import "math/vector.wgsl"

// The surface at one point.
struct Matte {
    // World frame; z is the shading normal.
    basis: Basis,
    // Widths of the lobe along x and y, 1e-3 or more.
    alpha: vec2f,
    // Perceptual roughness of the gloss, and how much wider it is along x than along y.
    roughness: f32,
    anisotropy: f32,
    // Share of the light that becomes gloss.
    gloss: f32,
    // Lambert's reflectance and transmittance.
    base: vec3f,
    through: vec3f,
}

// The gloss seen from one direction.
struct MatteGloss {
    // `wo` in the local frame.
    o: vec3f,
    albedo: BrushedAlbedo,
    // M_o; 0 without gloss.
    missing: f32,
    // Square of the width that stands for both, at most 1.
    a2: f32,
}

// The gloss from `wo`, above the surface.
fn matte_gloss(m: Matte, wo: vec3f) -> MatteGloss {
    let o = basis_local_from_world(m.basis, wo);
    if (m.gloss <= 0.0) {
        var none: MatteGloss;
        none.missing = 0.0;
        return none;
    }
    let albedo = brushed_albedo_at(m.roughness, m.anisotropy, m.alpha);
    let missing = brushed_albedo_missing(albedo, vec3f(o.xy * m.alpha, o.z));
    return MatteGloss(o, albedo, missing, min(0.5 * dot(m.alpha, m.alpha), 1.0));
}

// Samples `wi`. `u`: direction, `v`: which term, each with its share of the albedo; all in [0, 1 - 2^-24].
fn matte_sample(s: Scatter, m: Matte, wo: vec3f, u: vec2f, v: f32) -> Scattered {
    if (dot(s.ns, wo) <= 0.0) {
        return scatter_absorb();
    }
    let gloss = matte_gloss(m, wo);
    let share = matte_shares(m, gloss);
    let facets = share.x + share.y;
    let total = facets + share.z + share.w;
    if (total <= 0.0) {
        return scatter_absorb();
    }
    let at = v * total;
    var wi: vec3f;
    if (at < facets) {
        wi = matte_gloss_direction(m, gloss, u, at < share.x);
    } else {
        wi = diffuse_direction(select(-s.ns, s.ns, at < facets + share.z), u);
    }
    let to = matte_toward(s, m, gloss, wi);
    // A reflection that falls below the surface is lost: it is no transmission.
    let lost = at < facets && dot(s.ns, wi) <= 0.0;
    if (lost || to.pdf <= 0.0) {
        return scatter_absorb();
    }
    return Scattered(wi, to.pdf, to.f / to.pdf, 1.0);
}

// A direction of the gloss after one reflection off the microfacets, `once`, or after several.
fn matte_gloss_direction(m: Matte, gloss: MatteGloss, u: vec2f, once: bool) -> vec3f {
    var i: vec3f;
    if (once) {
        i = ggx_anisotropic_sample(gloss.o, m.alpha, u);
    } else {
        i = ggx_albedo_sample(gloss.a2, u);
    }
    return vector_unit(basis_world_from_local(m.basis, i));
}

// f |cos|, and the density of `matte_sample` over all terms.
fn matte_eval(s: Scatter, m: Matte, wo: vec3f, wi: vec3f) -> Evaluated {
    if (dot(s.ns, wo) <= 0.0) {
        return scatter_nothing();
    }
    return matte_toward(s, m, matte_gloss(m, wo), wi);
}

// `matte_eval` where the other direction is above the surface.
fn matte_toward(s: Scatter, m: Matte, gloss: MatteGloss, wi: vec3f) -> Evaluated {
    let share = matte_shares(m, gloss);
    let total = share.x + share.y + share.z + share.w;
    if (total <= 0.0) {
        return scatter_nothing();
    }
    let cos_i = dot(s.ns, wi);
    let even = abs(cos_i) * INV_PI;
    if (cos_i <= 0.0) {
        return scatter_only(Evaluated(m.through * even, share.w * even / total), scatter_below(s, wi));
    }
    let above = scatter_above(s, wi);
    let base = share.z * even;
    if (m.gloss <= 0.0) {
        return scatter_only(Evaluated(m.base * even, base / total), above);
    }
    let i = basis_local_from_world(m.basis, wi);
    let missing = brushed_albedo_missing(gloss.albedo, vec3f(i.xy * m.alpha, i.z));
    let several = gloss.missing * missing / gloss.albedo.mean * (i.z * INV_PI);
    let value = m.base * even + vec3f(m.gloss * (ggx_anisotropic_eval(gloss.o, i, m.alpha) + several));
    let once_pdf = share.x * ggx_anisotropic_pdf(gloss.o, i, m.alpha);
    let several_pdf = share.y * ggx_albedo_pdf(gloss.a2, max(i.z, 0.0));
    return scatter_only(Evaluated(value, (base + (once_pdf + several_pdf)) / total), above);
}

// The proportions in which the terms are sampled: one reflection off the microfacets, several, diffuse reflection,
// transmission. One reflection counts with all of the gloss: its values are below its density, its albedo is not.
fn matte_shares(m: Matte, gloss: MatteGloss) -> vec4f {
    return vec4f(m.gloss, m.gloss * gloss.missing, vector_max(m.base), vector_max(m.through));
}

// A rough surface that is not metal: Lambert's reflection, a share of gloss from a GGX lobe without Fresnel, and
// for thin things Lambert's transmission to the other side:
//   above  f = base / pi + gloss D G2 / (4 cos_o cos_i),     below  f = through / pi.
// Reciprocal, as every term is. Energy: base + through + gloss E(cos_o), where E <= 1 is what one bounce off the
// microfacets keeps; so at most 1 where base + through + gloss <= 1.

#import "bsdf/diffuse.wgsl"
#import "bsdf/ggx_anisotropic.wgsl"
#import "bsdf/scatter.wgsl"
#import "math/basis.wgsl"
#import "math/vector.wgsl"

// The surface at one point.
struct Matte {
    // World frame; z is the shading normal.
    basis: Basis,
    // Widths of the lobe along x and y, in 1e-3 ..= 1.
    alpha: vec2f,
    // Share of the light that becomes gloss.
    gloss: f32,
    // Lambert's reflectance and transmittance.
    base: vec3f,
    through: vec3f,
}

// Samples `wi`. `u`: direction, `v`: which term, each with its share of the albedo; all in [0, 1 - 2^-24].
fn matte_sample(s: Scatter, m: Matte, wo: vec3f, u: vec2f, v: f32) -> Scattered {
    let share = matte_shares(m);
    let total = share.x + share.y + share.z;
    if (total <= 0.0 || dot(s.ns, wo) <= 0.0) {
        return scatter_absorb();
    }
    let at = v * total - share.x;
    var wi: vec3f;
    if (at < 0.0) {
        let o = basis_local_from_world(m.basis, wo);
        wi = vector_unit(basis_world_from_local(m.basis, ggx_anisotropic_sample(o, m.alpha, u)));
    } else {
        wi = diffuse_direction(select(-s.ns, s.ns, at < share.y), u);
    }
    let pdf = matte_pdf(s, m, wo, wi);
    // A reflection that falls below the surface is lost: it is no transmission.
    let lost = at < 0.0 && dot(s.ns, wi) <= 0.0;
    if (lost || pdf <= 0.0) {
        return scatter_absorb();
    }
    return Scattered(wi, pdf, matte_eval(s, m, wo, wi) / pdf, 1.0);
}

// f |cos|.
fn matte_eval(s: Scatter, m: Matte, wo: vec3f, wi: vec3f) -> vec3f {
    let cos_i = dot(s.ns, wi);
    if (dot(s.ns, wo) <= 0.0) {
        return vec3f(0.0);
    }
    if (cos_i < 0.0 && dot(s.ng, wi) < 0.0) {
        return m.through * (-cos_i * INV_PI);
    }
    if (!scatter_above(s, wi)) {
        return vec3f(0.0);
    }
    let base = m.base * (cos_i * INV_PI);
    if (m.gloss <= 0.0) {
        return base;
    }
    let o = basis_local_from_world(m.basis, wo);
    let i = basis_local_from_world(m.basis, wi);
    return base + vec3f(m.gloss * ggx_anisotropic_eval(o, i, m.alpha));
}

// Density of `matte_sample` over all terms, per steradian of `wi`.
fn matte_pdf(s: Scatter, m: Matte, wo: vec3f, wi: vec3f) -> f32 {
    let share = matte_shares(m);
    let total = share.x + share.y + share.z;
    let cos_i = dot(s.ns, wi);
    if (total <= 0.0 || dot(s.ns, wo) <= 0.0) {
        return 0.0;
    }
    if (cos_i <= 0.0) {
        return share.z * (-cos_i * INV_PI) / total;
    }
    let base = share.y * (cos_i * INV_PI);
    if (share.x <= 0.0) {
        return base / total;
    }
    let o = basis_local_from_world(m.basis, wo);
    let i = basis_local_from_world(m.basis, wi);
    return (base + share.x * ggx_anisotropic_pdf(o, i, m.alpha)) / total;
}

// Albedos of gloss, reflection, transmission, up to masking: in these proportions the terms are sampled, so
// that no weight exceeds their sum.
fn matte_shares(m: Matte) -> vec3f {
    return vec3f(m.gloss, vector_max(m.base), vector_max(m.through));
}

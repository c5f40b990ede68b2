// Metal with a rough surface: GGX with Schlick's Fresnel from `color` at normal incidence, and the light
// that leaves after several reflections, without which rough metals are too dark.
//   f = F(wo.h) D G2 / (4 cos_o cos_i) + K M_o M_i / (pi mean M)
// K = A^2 E / (1 - A (1 - E)) tints the second lobe: A the mean of F, E = 1 - mean M (Kulla & Conty 2017, with
// the square of Hill 2018: light reflected once is the first lobe's). White metal returns 1 within 1e-3.
// Reciprocal. With anisotropy M is that of `brushed_albedo.wgsl`, and white metal returns 1 within 0.015.

#import "bsdf/brushed_albedo.wgsl"
#import "bsdf/fresnel.wgsl"
#import "bsdf/ggx.wgsl"
#import "bsdf/ggx_albedo.wgsl"
#import "bsdf/ggx_anisotropic.wgsl"
#import "bsdf/scatter.wgsl"
#import "math/basis.wgsl"
#import "math/vector.wgsl"
#import "scene/records.wgsl"

// What depends on the surface and on `wo` alone.
struct ConductorLobe {
    basis: Basis,
    // `wo` in the local frame.
    o: vec3f,
    alpha: vec2f,
    // Square of the width that stands for both, at most 1.
    a2: f32,
    // K M_o / mean M; 0 without compensation.
    extra: vec3f,
    albedo: BrushedAlbedo,
    // Probability of sampling the second lobe.
    share: f32,
}

// The lobe seen from `wo`, above the surface.
fn conductor_lobe(s: Scatter, wo: vec3f) -> ConductorLobe {
    let anisotropy = load_material_anisotropy(s.material);
    let alpha = ggx_anisotropic_alpha(s.roughness, anisotropy);
    let basis = basis_along(s.ns, s.tangent);
    let o = basis_local_from_world(basis, wo);
    let a2 = min(0.5 * dot(alpha, alpha), 1.0);
    let on = load_material_compensation(s.material) > 0.0;
    let albedo = brushed_albedo_at(s.roughness, select(0.0, anisotropy, on), alpha);
    if (!on) {
        return ConductorLobe(basis, o, alpha, a2, vec3f(0.0), albedo, 0.0);
    }
    // The mean of Schlick's term: the integral of 2 c (1 - c)^5 is 1/21.
    let mean = s.color + (vec3f(1.0) - s.color) * 0.047619048;
    let missing = brushed_albedo_missing(albedo, vec3f(o.xy * alpha, o.z));
    let tint = mean * mean * (1.0 - albedo.mean) / (vec3f(1.0) - mean * albedo.mean);
    let once = vector_max(max(fresnel_schlick_to(s.color, 1.0, o.z), mean)) * (1.0 - missing);
    let more = vector_max(tint) * missing;
    return ConductorLobe(basis, o, alpha, a2, tint * (missing / albedo.mean), albedo, more / (once + more));
}

// Samples `wi`. `u`: direction, `v`: which lobe; all in [0, 1 - 2^-24].
fn conductor_sample(s: Scatter, wo: vec3f, u: vec2f, v: f32) -> Scattered {
    let cos_o = dot(s.ns, wo);
    if (cos_o <= 0.0) {
        return scatter_absorb();
    }
    if (conductor_is_smooth(s)) {
        return Scattered(scatter_mirror(s, wo), 0.0, fresnel_schlick_to(s.color, 1.0, cos_o), 1.0);
    }
    let lobe = conductor_lobe(s, wo);
    var i: vec3f;
    if (v < lobe.share) {
        i = ggx_albedo_sample(lobe.a2, u);
    } else {
        i = ggx_anisotropic_sample(lobe.o, lobe.alpha, u);
    }
    let wi = vector_unit(basis_world_from_local(lobe.basis, i));
    if (!scatter_above(s, wi)) {
        return scatter_absorb();
    }
    let to = conductor_toward(s, lobe, wi);
    if (to.pdf <= 0.0) {
        return scatter_absorb();
    }
    return Scattered(wi, to.pdf, to.f / to.pdf, 1.0);
}

// f |cos| and the density of `conductor_sample` over both lobes; nothing for a mirror.
fn conductor_eval(s: Scatter, wo: vec3f, wi: vec3f) -> Evaluated {
    if (conductor_is_smooth(s) || dot(s.ns, wo) <= 0.0 || dot(s.ns, wi) <= 0.0) {
        return scatter_nothing();
    }
    return scatter_only(conductor_toward(s, conductor_lobe(s, wo), wi), scatter_above(s, wi));
}

// Too smooth for a lobe: a mirror.
fn conductor_is_smooth(s: Scatter) -> bool {
    return s.roughness * s.roughness < GGX_SMOOTH;
}

// The same towards `wi`, above the surface.
fn conductor_toward(s: Scatter, lobe: ConductorLobe, wi: vec3f) -> Evaluated {
    let i = basis_local_from_world(lobe.basis, wi);
    // cos(wo, h) = |wo + wi| / 2.
    let h = lobe.o + i;
    let once = fresnel_schlick_to(s.color, 1.0, 0.5 * sqrt(dot(h, h))) * ggx_anisotropic_eval(lobe.o, i, lobe.alpha);
    let once_pdf = (1.0 - lobe.share) * ggx_anisotropic_pdf(lobe.o, i, lobe.alpha);
    if (lobe.share <= 0.0) {
        return Evaluated(once, once_pdf);
    }
    let missing = brushed_albedo_missing(lobe.albedo, vec3f(i.xy * lobe.alpha, i.z));
    let several = lobe.extra * (missing * (i.z * INV_PI));
    return Evaluated(once + several, once_pdf + lobe.share * ggx_albedo_pdf(lobe.a2, i.z));
}

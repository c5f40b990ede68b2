// A rough interface between two clear media: microfacets that reflect and refract like smooth glass, and the light
// that meets several of them.
// Walter et al. 2007, with the exact Fresnel term at the facet, and both lobes masked by Smith's form with correlated
// heights (Heitz 2014, JCGT 3(2)). Light that meets a second facet is given back diffusely on both sides
// (`glass_albedo.wgsl`), so that a clear interface keeps all light; without compensation it is lost.

#import "bsdf/dielectric.wgsl"
#import "bsdf/diffuse.wgsl"
#import "bsdf/fresnel.wgsl"
#import "bsdf/ggx.wgsl"
#import "bsdf/ggx_transmission.wgsl"
#import "bsdf/glass_albedo.wgsl"
#import "bsdf/scatter.wgsl"
#import "math/basis.wgsl"
#import "math/vector.wgsl"
#import "scene/records.wgsl"

// Below this product of alpha and |eta - 1| refraction is narrower than directions in single precision
// resolve, and the interface counts as smooth; as does an index of 1.
const ROUGH_DIELECTRIC_NARROW: f32 = 1e-4;

// What light does that meets several facets, seen from `wo`.
struct RoughDielectricSeveral {
    // M at `wo`: the probability of sampling it. 0 without compensation.
    missing: f32,
    // Of that, the share that is transmitted.
    transmitted: f32,
    // Its means, on the side of `wo` and behind it.
    near: f32,
    far: f32,
    albedo: GlassAlbedo,
}

// Index behind the surface over that before it, as the path comes, and the same less one.
fn rough_dielectric_eta(s: Scatter) -> vec2f {
    return select(vec2f(1.0 / s.ior, -s.ior_minus_1 / s.ior), vec2f(s.ior, s.ior_minus_1), s.front);
}

// Whether both lobes are deltas.
fn rough_dielectric_is_smooth(s: Scatter) -> bool {
    let alpha = s.roughness * s.roughness;
    return alpha < GGX_SMOOTH || alpha * abs(rough_dielectric_eta(s).y) < ROUGH_DIELECTRIC_NARROW;
}

// What several facets do for light seen at cosine `cos_o` > 0.
fn rough_dielectric_several(s: Scatter, cos_o: f32) -> RoughDielectricSeveral {
    var several: RoughDielectricSeveral;
    several.missing = 0.0;
    if (load_material_compensation(s.material) <= 0.0) {
        return several;
    }
    let albedo = glass_albedo_at(s.roughness, s.roughness * s.roughness, s.ior, s.ior_minus_1);
    let missing = glass_albedo_missing(albedo, cos_o);
    let transmitted = glass_albedo_transmitted(albedo, s.ior);
    several.missing = select(missing.y, missing.x, s.front);
    several.transmitted = select(transmitted.y, transmitted.x, s.front);
    several.near = select(albedo.mean.y, albedo.mean.x, s.front);
    several.far = select(albedo.mean.x, albedo.mean.y, s.front);
    several.albedo = albedo;
    return several;
}

// Samples `wi`. `u`: facet, `v`: which lobe; all in [0, 1 - 2^-24].
fn rough_dielectric_sample(s: Scatter, wo: vec3f, u: vec2f, v: f32) -> Scattered {
    if (rough_dielectric_is_smooth(s)) {
        return dielectric_sample(s, wo, v);
    }
    let cos_o = dot(s.ns, wo);
    if (cos_o <= 0.0) {
        return scatter_absorb();
    }
    let eta = rough_dielectric_eta(s);
    let several = rough_dielectric_several(s, cos_o);
    var wi: vec3f;
    var reflects: bool;
    if (v < several.missing) {
        reflects = v >= several.missing * several.transmitted;
        wi = diffuse_direction(select(-s.ns, s.ns, reflects), u);
    } else {
        let basis = basis_around(s.ns);
        let o = basis_local_from_world(basis, wo);
        let h = ggx_transmission_normal(o, s.roughness * s.roughness, u);
        let c = min(dot(o, h), 1.0);
        reflects = (v - several.missing) < fresnel_dielectric(c, eta.x, eta.y) * (1.0 - several.missing);
        var i: vec3f;
        if (reflects) {
            i = h * (2.0 * c) - o;
        } else {
            i = dielectric_refract(h, o, eta.x, eta.y);
        }
        wi = vector_unit(basis_world_from_local(basis, i));
    }
    if (!select(scatter_below(s, wi), scatter_above(s, wi), reflects)) {
        return scatter_absorb();
    }
    let to = rough_dielectric_toward(s, wo, wi, several);
    if (to.pdf <= 0.0) {
        return scatter_absorb();
    }
    let eta2 = select(eta.x * eta.x, 1.0, reflects);
    return Scattered(wi, to.pdf, to.f / to.pdf, eta2);
}

// f |cos| and the density of `rough_dielectric_sample` over all lobes, for `wi` on either side of the surface; nothing
// where the interface is smooth.
fn rough_dielectric_eval(s: Scatter, wo: vec3f, wi: vec3f) -> Evaluated {
    let cos_o = dot(s.ns, wo);
    if (rough_dielectric_is_smooth(s) || cos_o <= 0.0) {
        return scatter_nothing();
    }
    return rough_dielectric_toward(s, wo, wi, rough_dielectric_several(s, cos_o));
}

// `rough_dielectric_eval` of a rough interface, `wo` above it.
fn rough_dielectric_toward(s: Scatter, wo: vec3f, wi: vec3f, several: RoughDielectricSeveral) -> Evaluated {
    let cos_i = dot(s.ns, wi);
    let above = cos_i > 0.0;
    let once = rough_dielectric_once(s, wo, wi, above);
    let diffuse = rough_dielectric_diffuse(s, abs(cos_i), above, several);
    let side = select(several.transmitted, 1.0 - several.transmitted, above);
    let diffuse_pdf = select(0.0, several.missing * side * (abs(cos_i) * INV_PI), several.missing > 0.0);
    let pdf = (1.0 - several.missing) * once.y + diffuse_pdf;
    let reached = select(scatter_below(s, wi), scatter_above(s, wi), above);
    return scatter_only(Evaluated(vec3f(once.x + diffuse), pdf), reached);
}

// f |cos| of what several facets do, at cosine `cos_i` > 0 on the side of `wo` (`above`) or behind it.
fn rough_dielectric_diffuse(s: Scatter, cos_i: f32, above: bool, several: RoughDielectricSeveral) -> f32 {
    if (several.missing <= 0.0) {
        return 0.0;
    }
    let missing = glass_albedo_missing(several.albedo, cos_i);
    let there = select(missing.y, missing.x, s.front == above) * (cos_i * INV_PI);
    if (above) {
        return (1.0 - several.transmitted) * several.missing * there / several.near;
    }
    let eta = rough_dielectric_eta(s).x;
    return several.transmitted * several.missing * there / (several.far * (eta * eta));
}

// f |cos| of one facet, and the density of sampling `wi` by it.
fn rough_dielectric_once(s: Scatter, wo: vec3f, wi: vec3f, above: bool) -> vec2f {
    let alpha = s.roughness * s.roughness;
    let eta = rough_dielectric_eta(s);
    let basis = basis_around(s.ns);
    let o = basis_local_from_world(basis, wo);
    let i = basis_local_from_world(basis, wi);
    if (above) {
        let h = o + i;
        let f = fresnel_dielectric(min(0.5 * sqrt(dot(h, h)), 1.0), eta.x, eta.y);
        return vec2f(f * ggx_eval(o, i, alpha), f * ggx_transmission_mirror_pdf(o, vector_unit(h), alpha));
    }
    let h = ggx_transmission_facet(o, i, eta.y);
    if (h.z <= 0.0) {
        return vec2f(0.0);
    }
    let through = 1.0 - fresnel_dielectric(min(dot(o, h), 1.0), eta.x, eta.y);
    return vec2f(
        through * ggx_transmission_eval(o, i, h, alpha, eta.y),
        through * ggx_transmission_pdf(o, i, h, alpha, eta.y),
    );
}

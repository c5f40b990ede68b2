// Refraction through a surface of GGX microfacets, without Fresnel. Local frame: z is the shading normal,
// `wo` above the surface, `wi` below it, both unit. `alpha` in 1e-3 ..= 1; `eta`: refractive index below the
// surface over that above it, `eta_minus_1`: the same less one, rounded once.
// Walter et al. 2007, "Microfacet Models for Refraction through Rough Surfaces", EGSR.

#import "bsdf/ggx.wgsl"
#import "math/disk.wgsl"
#import "math/vector.wgsl"

// Smith's masking: the share of a facet that is seen from `w`, on either side of the surface.
fn ggx_transmission_seen(w: vec3f, alpha: f32) -> f32 {
    let v = vec3f(w.xy * alpha, w.z);
    let c = abs(w.z);
    return 2.0 * c / (c + sqrt(dot(v, v)));
}

// A normal visible from `wo`, above the surface; `u` in [0, 1 - 2^-24]^2. The whole cap: what is refracted may
// come from any normal. Dupuy & Benyoub 2023, CGF 42(8).
fn ggx_transmission_normal(wo: vec3f, alpha: f32, u: vec2f) -> vec3f {
    let i = vector_unit(vec3f(wo.xy * alpha, wo.z));
    // Height of the cap's point above the other end, so that z below and i.z need not be added again.
    let at = disk_concentric(u);
    let top = (1.0 - at.r * at.r) * (1.0 + i.z);
    let z = top - i.z;
    let flat = i.xy + at.turn * sqrt(max(1.0 - z * z, 0.0));
    return vector_unit_or(vec3f(flat * alpha, top), vec3f(0.0, 0.0, 1.0));
}

// Density of `ggx_transmission_normal` over 4 cos(wo, h): per steradian of the direction mirrored at `h`.
fn ggx_transmission_mirror_pdf(wo: vec3f, h: vec3f, alpha: f32) -> f32 {
    return ggx_transmission_seen(wo, alpha) * ggx_normals(h, alpha) / (4.0 * wo.z);
}

// The vector wo + eta wi, not unit: along the facet's normal or against it. Its square is that of
// wo.h + eta wi.h. Written so that it is exact for an index near 1, where `wi` is nearly -`wo`.
fn ggx_transmission_along(wo: vec3f, wi: vec3f, eta_minus_1: f32) -> vec3f {
    return (wo + wi) + wi * eta_minus_1;
}

// The facet's unit normal, on the side of z, that refracts `wo` into `wi`; 0 if none does.
fn ggx_transmission_facet(wo: vec3f, wi: vec3f, eta_minus_1: f32) -> vec3f {
    let along = ggx_transmission_along(wo, wi, eta_minus_1);
    let unit = vector_unit_or(along, vec3f(0.0));
    let h = select(unit, -unit, unit.z < 0.0);
    // `wo` must meet the front of the facet and `wi` leave behind it.
    return select(vec3f(0.0), h, dot(wo, h) > 0.0 && dot(wi, h) < 0.0);
}

// The lobe at facet `h`, without Fresnel, times the cosine of `wi`: radiance coming from below the surface,
// per radiance above it. D G2 |wo.h wi.h| / (cos_o (wo.h + eta wi.h)^2), masked as reflection is: heights correlated,
// G2 = 1 / (1 + L_o + L_i).
fn ggx_transmission_eval(wo: vec3f, wi: vec3f, h: vec3f, alpha: f32, eta_minus_1: f32) -> f32 {
    let lo = abs(wi.z) * sqrt(wo.z * wo.z + alpha * alpha * dot(wo.xy, wo.xy));
    let li = wo.z * sqrt(wi.z * wi.z + alpha * alpha * dot(wi.xy, wi.xy));
    // G2 over cos_o; both cosines are > 0.
    let masked = 2.0 * abs(wi.z) / (lo + li);
    let along = ggx_transmission_along(wo, wi, eta_minus_1);
    let k = ggx_normals(h, alpha) * masked / dot(along, along);
    return k * abs(dot(wo, h) * dot(wi, h));
}

// Density per steradian of `wi` where `h` is drawn by `ggx_transmission_normal` and `wo` refracted at it:
// that of `h` times eta^2 |wi.h| / (wo.h + eta wi.h)^2.
fn ggx_transmission_pdf(wo: vec3f, wi: vec3f, h: vec3f, alpha: f32, eta_minus_1: f32) -> f32 {
    let along = ggx_transmission_along(wo, wi, eta_minus_1);
    let eta = 1.0 + eta_minus_1;
    let k = ggx_normals(h, alpha) * ggx_transmission_seen(wo, alpha) / (wo.z * dot(along, along));
    return k * abs(dot(wo, h) * dot(wi, h)) * (eta * eta);
}

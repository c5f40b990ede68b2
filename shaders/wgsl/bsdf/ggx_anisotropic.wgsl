// The GGX microfacet reflection lobe with two widths, without Fresnel. Local frame: z is the shading
// normal, x the direction of brushing; both directions unit and above the surface. `alpha`: widths along
// x and y, 1e-3 or more; the first may exceed 1.
// Heitz 2014, JCGT 3(2); remapping of roughness: Burley 2012, "Physically Based Shading at Disney".

#import "bsdf/ggx.wgsl"
#import "math/disk.wgsl"
#import "math/vector.wgsl"

// Widths of perceptual `roughness` and `anisotropy`, both 0 ..= 1: at 1 the lobe is ten times as wide
// along x as along y.
fn ggx_anisotropic_alpha(roughness: f32, anisotropy: f32) -> vec2f {
    let a = roughness * roughness;
    let aspect = sqrt(1.0 - 0.9 * anisotropy);
    return max(vec2f(a / aspect, a * aspect), vec2f(GGX_SMOOTH));
}

// Length of `w` on the ellipsoid: its cosine times 1 + 2 Lambda, with Smith's Lambda.
fn ggx_anisotropic_length(w: vec3f, alpha: vec2f) -> f32 {
    let v = vec3f(w.xy * alpha, w.z);
    return sqrt(dot(v, v));
}

// Density of normals, per steradian and unit projected area, at half vector `h`.
fn ggx_anisotropic_normals(h: vec3f, alpha: vec2f) -> f32 {
    let v = vec3f(h.xy / alpha, h.z);
    let t = dot(v, v);
    return INV_PI / ((alpha.x * alpha.y) * (t * t));
}

// The lobe without Fresnel, times the cosine of `wi`: D G2 / (4 cos_o), heights correlated.
fn ggx_anisotropic_eval(wo: vec3f, wi: vec3f, alpha: vec2f) -> f32 {
    let d = ggx_anisotropic_normals(vector_unit(wo + wi), alpha);
    let lo = wi.z * ggx_anisotropic_length(wo, alpha);
    let li = wo.z * ggx_anisotropic_length(wi, alpha);
    return d * wi.z / (2.0 * (lo + li));
}

// A direction `wi` reflected at a visible normal, as `ggx_sample`; it may lie below the surface.
fn ggx_anisotropic_sample(wo: vec3f, alpha: vec2f, u: vec2f) -> vec3f {
    let i = vector_unit(vec3f(wo.xy * alpha, wo.z));
    let b = ggx_anisotropic_bound(wo, alpha) * i.z;
    let at = disk_concentric(u);
    let z = (1.0 - at.r * at.r) * (1.0 + b) - b;
    let h = i + vec3f(at.turn * sqrt(max(1.0 - z * z, 0.0)), z);
    // h.z = i.z + z >= (1 - k) i.z > 0.
    let m = vector_unit_or(vec3f(h.xy * alpha, h.z), vec3f(0.0, 0.0, 1.0));
    return vector_unit(m * (2.0 * dot(wo, m)) - wo);
}

// Density of `ggx_anisotropic_sample`, per steradian of `wi`.
fn ggx_anisotropic_pdf(wo: vec3f, wi: vec3f, alpha: vec2f) -> f32 {
    let d = ggx_anisotropic_normals(vector_unit(wo + wi), alpha);
    return d / (2.0 * (ggx_anisotropic_bound(wo, alpha) * wo.z + ggx_anisotropic_length(wo, alpha)));
}

// The share k of the cap's height that can reflect above the surface, that of the narrower width:
// Eto & Tokuyoshi 2023, eq. 5, with a = min(alpha.x, alpha.y, 1).
fn ggx_anisotropic_bound(wo: vec3f, alpha: vec2f) -> f32 {
    return ggx_bound(wo, min(min(alpha.x, alpha.y), 1.0));
}

// The GGX microfacet reflection lobe, isotropic, without Fresnel. Local frame: z is the shading normal,
// both directions unit and above the surface. `alpha` in 1e-3 ..= 1.
// Trowbridge & Reitz 1975; Walter et al. 2007; height-correlated masking: Heitz 2014, JCGT 3(2).

#import "math/disk.wgsl"
#import "math/vector.wgsl"

// Below this alpha a surface is smooth: single precision cannot resolve its lobe.
const GGX_SMOOTH: f32 = 1e-3;

// Density of normals, per steradian and unit projected area, at half vector `h`.
// (a / t)^2 / pi with t = sin^2 + a^2 cos^2: relative error 5e-7 where (a^2 - 1) c^2 + 1 is 12 % off at 1e-3.
fn ggx_normals(h: vec3f, alpha: f32) -> f32 {
    let t = h.x * h.x + h.y * h.y + alpha * alpha * h.z * h.z;
    let k = alpha / t;
    return (k * INV_PI) * k;
}

// The lobe without Fresnel, times the cosine of `wi`: D G2 / (4 cos_o).
fn ggx_eval(wo: vec3f, wi: vec3f, alpha: f32) -> f32 {
    let h = vector_unit(wo + wi);
    let lo = wi.z * sqrt(wo.z * wo.z + alpha * alpha * dot(wo.xy, wo.xy));
    let li = wo.z * sqrt(wi.z * wi.z + alpha * alpha * dot(wi.xy, wi.xy));
    // G2 / (4 cos_o cos_i) = 1 / (2 (lo + li)); both cosines are > 0.
    return ggx_normals(h, alpha) * wi.z / (2.0 * (lo + li));
}

// A direction `wi` reflected at a visible normal; `u` in [0, 1 - 2^-24]^2. It may lie below the surface.
// Dupuy & Benyoub 2023, "Sampling Visible GGX Normals with Spherical Caps", CGF 42(8), with the cap
// bounded as in Eto & Tokuyoshi 2023, "Bounded VNDF Sampling for Smith-GGX Reflections".
fn ggx_sample(wo: vec3f, alpha: f32, u: vec2f) -> vec3f {
    let i = vector_unit(vec3f(wo.xy * alpha, wo.z));
    let b = ggx_bound(wo, alpha) * i.z;
    let at = disk_concentric(u);
    let z = (1.0 - at.r * at.r) * (1.0 + b) - b;
    let h = i + vec3f(at.turn * sqrt(max(1.0 - z * z, 0.0)), z);
    // h.z = i.z + z >= (1 - k) i.z > 0.
    let m = vector_unit_or(vec3f(h.xy * alpha, h.z), vec3f(0.0, 0.0, 1.0));
    return vector_unit(m * (2.0 * dot(wo, m)) - wo);
}

// Density of `ggx_sample`, per steradian of `wi`.
fn ggx_pdf(wo: vec3f, wi: vec3f, alpha: f32) -> f32 {
    let d = ggx_normals(vector_unit(wo + wi), alpha);
    let length = sqrt(alpha * alpha * dot(wo.xy, wo.xy) + wo.z * wo.z);
    return d / (2.0 * (ggx_bound(wo, alpha) * wo.z + length));
}

// The share k of the cap's height that can reflect above the surface, 0 < k <= 1.
fn ggx_bound(wo: vec3f, alpha: f32) -> f32 {
    let s = 1.0 + sqrt(dot(wo.xy, wo.xy));
    let a2 = alpha * alpha;
    let s2 = s * s;
    return (1.0 - a2) * s2 / (s2 + a2 * wo.z * wo.z);
}

// The GGX microfacet reflection lobe with two widths, without Fresnel. Local frame: z is the shading normal,
// `alpha` in 1e-3 ..= 1 along x and along y; directions unit and above the surface. With equal widths it is
// the lobe of `ggx.wgsl`.
// Trowbridge & Reitz 1975; Walter et al. 2007; height-correlated masking: Heitz 2014, JCGT 3(2).

#import "math/sincos.wgsl"
#import "math/vector.wgsl"

// Density of normals, per steradian and unit projected area, at half vector `h`:
// 1 / (pi ax ay t^2) with t = (x / ax)^2 + (y / ay)^2 + z^2, with the widths multiplied out so that nothing
// is divided by a small number.
fn ggx_anisotropic_normals(h: vec3f, alpha: vec2f) -> f32 {
    let product = alpha.x * alpha.y;
    let x = h.x * alpha.y;
    let y = h.y * alpha.x;
    let z = h.z * product;
    // k = ax ay / (ax ay)^2 t.
    let k = product / (x * x + y * y + z * z);
    return (k * INV_PI) * (k * product);
}

// The lobe without Fresnel, times the cosine of `wi`: D G2 / (4 cos_o).
fn ggx_anisotropic_eval(wo: vec3f, wi: vec3f, alpha: vec2f) -> f32 {
    let h = vector_unit(wo + wi);
    let lo = wi.z * ggx_anisotropic_length(wo, alpha);
    let li = wo.z * ggx_anisotropic_length(wi, alpha);
    // G2 / (4 cos_o cos_i) = 1 / (2 (lo + li)); both cosines are > 0.
    return ggx_anisotropic_normals(h, alpha) * wi.z / (2.0 * (lo + li));
}

// |(ax x, ay y, z)|: cos (1 + 2 Lambda) of Smith's masking.
fn ggx_anisotropic_length(w: vec3f, alpha: vec2f) -> f32 {
    let s = w.xy * alpha;
    return sqrt(w.z * w.z + dot(s, s));
}

// A direction `wi` reflected at a visible normal; `u` in [0, 1 - 2^-24]^2. It may lie below the surface.
// Dupuy & Benyoub 2023, "Sampling Visible GGX Normals with Spherical Caps", CGF 42(8), with the cap
// bounded as in Eto & Tokuyoshi 2023, "Bounded VNDF Sampling for Smith-GGX Reflections".
fn ggx_anisotropic_sample(wo: vec3f, alpha: vec2f, u: vec2f) -> vec3f {
    let i = vector_unit(vec3f(wo.xy * alpha, wo.z));
    let b = ggx_anisotropic_bound(wo, alpha) * i.z;
    let z = (1.0 - u.y) * (1.0 + b) - b;
    let sc = sincos_2pi(u.x) * sqrt(max(1.0 - z * z, 0.0));
    let h = i + vec3f(sc.y, sc.x, z);
    // h.z = i.z + z >= (1 - k) i.z > 0.
    let m = vector_unit_or(vec3f(h.xy * alpha, h.z), vec3f(0.0, 0.0, 1.0));
    return vector_unit(m * (2.0 * dot(wo, m)) - wo);
}

// Density of `ggx_anisotropic_sample`, per steradian of `wi`.
fn ggx_anisotropic_pdf(wo: vec3f, wi: vec3f, alpha: vec2f) -> f32 {
    let d = ggx_anisotropic_normals(vector_unit(wo + wi), alpha);
    return d / (2.0 * (ggx_anisotropic_bound(wo, alpha) * wo.z + ggx_anisotropic_length(wo, alpha)));
}

// The share k of the cap's height that can reflect above the surface, 0 < k <= 1; of the smaller width, as
// in Eto & Tokuyoshi.
fn ggx_anisotropic_bound(wo: vec3f, alpha: vec2f) -> f32 {
    let s = 1.0 + sqrt(dot(wo.xy, wo.xy));
    let a = min(alpha.x, alpha.y);
    let a2 = a * a;
    let s2 = s * s;
    return (1.0 - a2) * s2 / (s2 + a2 * wo.z * wo.z);
}

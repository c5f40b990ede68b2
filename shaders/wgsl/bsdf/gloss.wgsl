// The GGX reflection lobe of `ggx.wgsl` around a shading normal in the world frame. `alpha` in 1e-4 ..= 1; below
// `GLOSS_SMOOTH` a model takes a mirror in its place.

#import "bsdf/ggx.wgsl"
#import "math/basis.wgsl"
#import "math/vector.wgsl"

// Below this alpha a lobe is a mirror: narrower than a thousandth of a radian.
const GLOSS_SMOOTH: f32 = 1e-3;

// Width of a lobe of perceptual roughness `roughness`: its square, at least 1e-4.
fn gloss_alpha(roughness: f32) -> f32 {
    return max(roughness * roughness, 1e-4);
}

// A direction reflected at a visible normal, unit; it may lie below the surface. `u` in [0, 1 - 2^-24]^2.
fn gloss_sample(ns: vec3f, wo: vec3f, alpha: f32, u: vec2f) -> vec3f {
    let basis = basis_around(ns);
    return vector_unit(basis_world_from_local(basis, ggx_sample(basis_local_from_world(basis, wo), alpha, u)));
}

// The lobe without Fresnel, times the cosine of `wi`; and the density of `gloss_sample`, per steradian of `wi`. Both
// directions are above the shading normal's surface.
fn gloss_eval(ns: vec3f, wo: vec3f, wi: vec3f, alpha: f32) -> vec2f {
    let basis = basis_around(ns);
    let o = basis_local_from_world(basis, wo);
    let i = basis_local_from_world(basis, wi);
    return vec2f(ggx_eval(o, i, alpha), ggx_pdf(o, i, alpha));
}

// Cosine between `wo` and the normal that reflects it into `wi`: |wo + wi| / 2.
fn gloss_cosine(wo: vec3f, wi: vec3f) -> f32 {
    let h = wo + wi;
    return 0.5 * sqrt(dot(h, h));
}

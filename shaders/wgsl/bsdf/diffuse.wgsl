// Lambert: the same radiance into every direction above the surface.

#import "bsdf/scatter.wgsl"
#import "math/basis.wgsl"
#import "math/disk.wgsl"
#import "math/vector.wgsl"

// A direction with density cos / pi around the shading normal. `u` in [0, 1 - 2^-24]^2.
fn diffuse_direction(ns: vec3f, u: vec2f) -> vec3f {
    let at = disk_concentric(u);
    // at.r < 1, so the direction is at least 2^-12 above the surface.
    let wi = vec3f(at.turn * at.r, sqrt(1.0 - at.r * at.r));
    return vector_unit(basis_world_from_local(basis_around(ns), wi));
}

// Samples `wi`; `u` in [0, 1 - 2^-24]^2.
fn diffuse_sample(s: Scatter, u: vec2f) -> Scattered {
    let wi = diffuse_direction(s.ns, u);
    if (!scatter_above(s, wi)) {
        return scatter_absorb();
    }
    return Scattered(wi, diffuse_eval(s, wi).pdf, s.color, 1.0);
}

// f |cos|, and the density of `diffuse_sample`.
fn diffuse_eval(s: Scatter, wi: vec3f) -> Evaluated {
    let even = max(dot(s.ns, wi), 0.0) * INV_PI;
    return scatter_only(Evaluated(s.color * even, even), scatter_above(s, wi));
}

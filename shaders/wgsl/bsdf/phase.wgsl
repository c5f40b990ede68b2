// Scattering inside a medium, by the phase function of `hg.wgsl` between the directions of travel before and after.
// `Scatter::material` is the index of the `Medium`. Beyond |g| = 1 - 1e-6 light goes straight on, or back.

#import "bsdf/hg.wgsl"
#import "bsdf/scatter.wgsl"
#import "sampler/key.wgsl"
#import "scene/records.wgsl"
#import "surface/place.wgsl"
#import "texture/texture_point.wgsl"

// `Scatter::kind` of a point in a medium.
const PHASE_KIND: u32 = 0xffffffffu;

// From here on scattering is a delta.
const PHASE_DELTA: f32 = 0.999999;

// A point in medium `i`: without normals.
fn phase_scatter(i: u32, key: SampleKey) -> Scatter {
    let none = vec3f(0.0);
    return Scatter(
        none, none, none, PHASE_KIND, i,
        none, 0.0, texture_point(vec2f(0.0)), Place(none, 0u), 0.0,
        0.0, 0.0,
        1.0, 0.0, true, key,
    );
}

// Samples `wi`; `u` in [0, 1 - 2^-24]^2.
fn phase_sample(s: Scatter, wo: vec3f, u: vec2f) -> Scattered {
    let g = load_medium_g(s.material);
    if (abs(g) >= PHASE_DELTA) {
        return Scattered(select(-wo, wo, g < 0.0), 0.0, vec3f(1.0), 1.0);
    }
    let wi = hg_sample(-wo, g, u);
    return Scattered(wi, hg_pdf(-wo, g, wi), vec3f(1.0), 1.0);
}

// The phase function, per steradian, which is the density of `phase_sample` too; nothing where it is a delta.
fn phase_eval(s: Scatter, wo: vec3f, wi: vec3f) -> Evaluated {
    let g = load_medium_g(s.material);
    if (abs(g) >= PHASE_DELTA) {
        return scatter_nothing();
    }
    let density = hg_pdf(-wo, g, wi);
    return Evaluated(vec3f(density), density);
}

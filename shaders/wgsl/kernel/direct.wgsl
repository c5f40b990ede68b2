// Light that reaches a vertex directly: one light sampled at each vertex, and both ways of finding a light
// weighted by the balance heuristic (Veach 1997, ch. 9) with the same denominator,
//   light sample:  L f |cos| / (P pl + pb)         BSDF sample that hits:  w = pb / (P pl + pb)
// where P is the probability of the light, pl its density and pb that of the BSDF, per steradian.
// Tests may ask for one way alone, or for the power heuristic instead.

#import "abi/light.wgsl"
#import "bsdf/scatter.wgsl"
#import "kernel/state.wgsl"
#import "light/choose.wgsl"
#import "light/emission.wgsl"
#import "light/light_sample.wgsl"
#import "math/vector.wgsl"
#import "sampler/key.wgsl"
#import "scene/constants.wgsl"
#import "scene/dispatch_light.wgsl"
#import "scene/dispatch_bsdf.wgsl"
#import "scene/records.wgsl"
#import "scene/sampler.wgsl"
#import "surface/surface.wgsl"

// Values of `Frame::estimator`.
const DIRECT_LIGHT_ONLY: u32 = 1u;
const DIRECT_BSDF_ONLY: u32 = 2u;
const DIRECT_POWER: u32 = 3u;

// Leaves a shadow ray in `path` if a light was sampled that may light the vertex at `p`.
fn direct_sample(path: ptr<function, Path>, p: vec3f, scatter: Scatter, wo: vec3f) {
    let n_lights = load_frame_n_lights();
    if (n_lights == 0u || load_frame_estimator() == DIRECT_BSDF_ONLY) {
        return;
    }
    let key = (*path).key;
    let index = choose_light(n_lights, sample_1d(key, PURPOSE_LIGHT_CHOICE));
    let light = load_light(index);
    let to = dispatch_light_sample(light, p, sample_2d(key, PURPOSE_LIGHT_POINT));
    if (to.pdf <= 0.0) {
        return;
    }
    let f = dispatch_eval(scatter, wo, to.wi);
    if (vector_max(f) <= 0.0) {
        return;
    }
    let radiance = direct_radiance(light, p, to);
    if (vector_max(radiance) <= 0.0) {
        return;
    }
    let pb = select(dispatch_pdf(scatter, wo, to.wi), 0.0, load_frame_estimator() == DIRECT_LIGHT_ONLY);
    (*path).shadow_dir = to.wi;
    // The light itself is skipped by its index; 2^-18 keeps off what lies in its plane.
    (*path).shadow_t = to.t * 0.9999962;
    (*path).shadow_radiance = (*path).throughput * f * radiance / direct_divisor(light.pmf * to.pdf, pb);
    (*path).shadow_light = index;
}

// Radiance of `light` at its sample `to` from `p`.
fn direct_radiance(light: Light, p: vec3f, to: LightSample) -> vec3f {
    let i = light.material;
    let uv = dispatch_light_uv(light, p + to.wi * to.t);
    if (!dispatch_light_exists(i, uv)) {
        return vec3f(0.0);
    }
    let image = load_material_emission_texture(i);
    return emission_radiance(load_material_emission(i), load_material_flags(i), image, uv, to.front);
}

// Weight of emission found by a direction that a BSDF sampled with density `pb` at `from`: 1 if the light
// could not have been sampled from there.
fn direct_weight(from_point: vec3f, dir: vec3f, pb: f32, s: Surface) -> f32 {
    if (pb <= 0.0 || s.light == NONE || load_frame_n_lights() == 0u || load_frame_estimator() == DIRECT_BSDF_ONLY) {
        return 1.0;
    }
    let light = load_light(s.light);
    let pl = light.pmf * dispatch_light_pdf(light, from_point, s.p, dot(s.ng, dir));
    if (pl <= 0.0) {
        return 1.0;
    }
    if (load_frame_estimator() == DIRECT_LIGHT_ONLY) {
        return 0.0;
    }
    return pb / direct_divisor(pb, pl);
}

// Density `ours` > 0 over the weight of its sample, where the other way has the density `theirs` >= 0.
// Balance: ours + theirs. Power 2: (ours^2 + theirs^2) / ours, written without squares, which overflow
// beyond 1.8e19; a weight of 1e-24 is as good as a smaller one.
fn direct_divisor(ours: f32, theirs: f32) -> f32 {
    if (load_frame_estimator() == DIRECT_POWER) {
        return ours + theirs * min(theirs / ours, 1e12);
    }
    return ours + theirs;
}

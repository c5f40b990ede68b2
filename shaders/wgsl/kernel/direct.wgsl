// Light that reaches a vertex directly: one light sampled at each vertex, and both ways of finding a light
// weighted by the balance heuristic (Veach 1997, ch. 9) with the same denominator,
//   light sample:  L f |cos| / (P pl + pb)         BSDF sample that hits:  w = pb / (P pl + pb)
// where P is the probability of the light, pl its density and pb that of the BSDF, per steradian.
// Tests may ask for one way alone, or for the power heuristic instead.

#import "bsdf/scatter.wgsl"
#import "kernel/state.wgsl"
#import "light/light_sample.wgsl"
#import "light/sky.wgsl"
#import "math/vector.wgsl"
#import "scene/constants.wgsl"
#import "scene/dispatch_light.wgsl"
#import "scene/dispatch_bsdf.wgsl"
#import "scene/dispatch_choice.wgsl"
#import "scene/dispatch_radiance.wgsl"
#import "scene/links.wgsl"
#import "scene/receiver.wgsl"
#import "scene/records.wgsl"
#import "scene/sampler.wgsl"
#import "surface/surface.wgsl"

// Values of `Frame::estimator`.
const DIRECT_LIGHT_ONLY: u32 = 1u;
const DIRECT_BSDF_ONLY: u32 = 2u;
const DIRECT_POWER: u32 = 3u;

// Leaves a shadow ray in `path` if a light was sampled that may light the vertex at `p`, off which rays start
// by `ray_offset` on either side.
fn direct_sample(
    path: ptr<function, Path>, p: vec3f, ray_offset: vec3f, receiver: Receiver, scatter: Scatter, wo: vec3f,
) {
    let n_lights = load_frame_n_lights();
    if (n_lights == 0u || load_frame_estimator() == DIRECT_BSDF_ONLY) {
        return;
    }
    let key = (*path).key;
    let point = sample_light(key);
    let choice = dispatch_choose(n_lights, p, receiver, point.x);
    if (choice.pmf <= 0.0) {
        return;
    }
    if (!links_joined(choice.index, receiver_links(receiver))) {
        return;
    }
    let light = load_light(choice.index);
    // The light stands still, and the vertex is moved back instead.
    let rest = p - dispatch_light_shift(light, (*path).time);
    let to = dispatch_light_sample(light, rest, dispatch_light_point(choice, point, key));
    if (to.pdf <= 0.0) {
        return;
    }
    let e = dispatch_eval(scatter, wo, to.wi);
    if (vector_max(e.f) <= 0.0) {
        return;
    }
    let radiance = dispatch_light_radiance(light, rest, to);
    if (vector_max(radiance) <= 0.0) {
        return;
    }
    let pb = select(e.pdf, 0.0, load_frame_estimator() == DIRECT_LIGHT_ONLY);
    let aim = direct_aim(ray_offset, to);
    (*path).shadow_dir = aim.xyz;
    // The light itself is skipped by its index; 2^-18 keeps off what lies in its plane.
    (*path).shadow_t = aim.w * 0.9999962;
    (*path).shadow_radiance = (*path).throughput * e.f * radiance / direct_divisor(choice.pmf * to.pdf, pb);
    (*path).shadow_light = choice.index;
}

// Direction and length of the ray that starts off the surface, by `ray_offset` on its side, and ends at the sample.
// A ray along `to.wi` would pass the sample at the distance of that start, and meet the neighbours of a small
// triangle instead of it.
fn direct_aim(ray_offset: vec3f, to: LightSample) -> vec4f {
    let v = to.wi * to.t - select(ray_offset, -ray_offset, dot(ray_offset, to.wi) < 0.0);
    let d2 = dot(v, v);
    // Too far to be missed, as the sky is; or no distance at all.
    if (to.t >= 1e6 || d2 < 1.1754944e-38) {
        return vec4f(to.wi, to.t);
    }
    let t = sqrt(d2);
    return vec4f(v / t, t);
}

// Weight of emission found at `time` by a direction that a BSDF sampled with density `pb` at `from`: 1 if
// the light could not have been sampled from there.
fn direct_weight(from_point: vec3f, receiver: Receiver, dir: vec3f, pb: f32, s: Surface, time: f32) -> f32 {
    if (pb <= 0.0 || s.light == NONE || load_frame_n_lights() == 0u || load_frame_estimator() == DIRECT_BSDF_ONLY) {
        return 1.0;
    }
    let light = load_light(s.light);
    let rest = from_point - dispatch_light_shift(light, time);
    let pmf = dispatch_choose_pmf(s.light, from_point, receiver);
    let pl = pmf * dispatch_light_pdf(light, rest, s.rest, dot(s.ng, dir));
    if (pl <= 0.0) {
        return 1.0;
    }
    if (load_frame_estimator() == DIRECT_LIGHT_ONLY) {
        return 0.0;
    }
    return pb / direct_divisor(pb, pl);
}

// As `direct_weight`, for the sky seen along `dir`.
fn direct_sky_weight(dir: vec3f, pb: f32) -> f32 {
    let index = load_sky_light();
    if (pb <= 0.0 || index == NONE || load_frame_n_lights() == 0u || load_frame_estimator() == DIRECT_BSDF_ONLY) {
        return 1.0;
    }
    let pl = dispatch_sky_pmf(index) * sky_light_pdf(dir);
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

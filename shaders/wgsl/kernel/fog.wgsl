// Fog along a segment: L = T L + (1 - T) color, with the transmittance T of Beer and Lambert. No samples, no noise;
// light of the same colour is neither gained nor lost. Inside of another medium both take light at once: with optical
// depths f and m the fog's part of what is lost is f / (f + m), so L = T_f T_m L + (1 - T_f T_m) color f / (f + m).

#import "kernel/state.wgsl"
#import "math/beer.wgsl"
#import "scene/constants.wgsl"
#import "scene/inside.wgsl"
#import "scene/records.wgsl"

// Longer than any distance between two points of the scene: the segment leaves it.
const FOG_LEAVES: f32 = 1e20;

// How much longer the path's segment along `dir` is than its ray, which starts off the surface.
fn fog_start(path: ptr<function, Path>, dir: vec3f) -> f32 {
    return abs(dot((*path).ray_offset, dir));
}

// Length of a segment along `dir` whose ray hits at `t`, in what is `reach` deep where there is no hit.
fn fog_length(path: ptr<function, Path>, dir: vec3f, t: f32, reach: f32) -> f32 {
    return select(t + fog_start(path, dir), reach, t > FOG_LEAVES);
}

// The same of the shadow ray's length since the last surface that it went through, if it hits at `t`.
fn fog_shadow_length(path: ptr<function, Path>, t: f32, reach: f32) -> f32 {
    let passed = passed_length((*path).passage);
    if (passed == 0.0) {
        return fog_length(path, (*path).shadow_dir, t, reach);
    }
    return select(t - passed, reach, t > FOG_LEAVES);
}

// Light of colour `color` that takes the place of what is lost at optical depth `tau` along a segment, on which `both`
// is lost, another medium's share included. Before the throughput has lost any.
fn fog_glow(path: ptr<function, Path>, color: vec3f, tau: vec3f, both: vec3f) {
    let lost = beer_absorptance(both, beer_transmittance(both));
    // Without depth nothing is lost; 1 without another medium.
    let share = tau / max(both, vec3f(1.1754944e-38));
    (*path).radiance += (*path).throughput * color * (lost * share);
}

// Optical depth of the fog along the path's segment up to `t`.
fn fog_depth(path: ptr<function, Path>, t: f32) -> vec3f {
    let i = load_frame_fog();
    if (i == NONE) {
        return vec3f(0.0);
    }
    return load_medium_sigma_a(i) * fog_length(path, (*path).dir, t, load_medium_reach(i));
}

// Adds the light of the fog along the path's segment, of optical depths as in `fog_glow`. Wherever a medium scatters
// the path on its way, that is the mean of what the fog sends.
fn fog_segment(path: ptr<function, Path>, tau: vec3f, both: vec3f) {
    let i = load_frame_fog();
    if (i != NONE) {
        fog_glow(path, load_medium_color(i), tau, both);
    }
}

// Takes away what the fog absorbs along the path's segment up to `t`.
fn fog_absorb(path: ptr<function, Path>, t: f32) {
    if (load_frame_fog() == NONE) {
        return;
    }
    (*path).throughput *= beer_transmittance(fog_depth(path, t));
}

// Transmittance of the fog along the path's shadow ray up to its hit at `t`.
fn fog_transmittance(path: ptr<function, Path>, t: f32) -> vec3f {
    let i = load_frame_fog();
    if (i == NONE) {
        return vec3f(1.0);
    }
    let length = fog_shadow_length(path, t, load_medium_reach(i));
    return beer_transmittance(load_medium_sigma_a(i) * length);
}

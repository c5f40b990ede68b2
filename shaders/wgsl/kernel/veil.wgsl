// What takes light away along a segment and puts its own in its place: L = T L + (1 - T) color, with T the share
// that passes (Beer-Lambert). No samples, no noise; light of the same colour is neither gained nor lost.

#import "abi/medium.wgsl"
#import "kernel/state.wgsl"
#import "math/beer.wgsl"
#import "scene/constants.wgsl"
#import "scene/records.wgsl"

// Longer than any distance between two points of the scene: the segment leaves it.
const VEIL_LEAVES: f32 = 1e20;

// How much longer the path's segment along `dir` is than its ray, which starts off the surface.
fn veil_start(path: ptr<function, Path>, dir: vec3f) -> f32 {
    return abs(dot((*path).gap, dir));
}

// Length of a segment along `dir` whose ray hits at `t`, in what is `reach` deep where there is no hit.
fn veil_length(path: ptr<function, Path>, dir: vec3f, t: f32, reach: f32) -> f32 {
    return select(t + veil_start(path, dir), reach, t > VEIL_LEAVES);
}

// A segment of length `length` of the path in `m`, which scatters no light of the path.
fn veil_add(path: ptr<function, Path>, m: Medium, length: f32) {
    let tau = m.sigma_a * length;
    let left = beer_left(tau);
    (*path).radiance += (*path).throughput * m.color * beer_lost(tau, left);
    (*path).throughput *= left;
}

// The fog along the path's segment up to its hit at `t`.
fn veil_fog(path: ptr<function, Path>, t: f32) {
    let i = load_frame_fog();
    if (i == NONE) {
        return;
    }
    let fog = load_medium(i);
    veil_add(path, fog, veil_length(path, (*path).dir, t, fog.reach));
}

// What fog leaves of the path's shadow ray up to its hit at `t`.
fn veil_fog_fade(path: ptr<function, Path>, t: f32) -> vec3f {
    let i = load_frame_fog();
    if (i == NONE) {
        return vec3f(1.0);
    }
    let length = veil_length(path, (*path).shadow_dir, t, load_medium_reach(i));
    return beer_left(load_medium_sigma_a(i) * length);
}

// Fog along a segment: L = T L + (1 - T) color, with the transmittance T of Beer and Lambert. No samples, no noise;
// light of the same colour is neither gained nor lost.

#import "abi/medium.wgsl"
#import "kernel/state.wgsl"
#import "math/beer.wgsl"
#import "scene/constants.wgsl"
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

// A segment of length `length` of the path in `m`, which scatters no light of the path.
fn fog_add(path: ptr<function, Path>, m: Medium, length: f32) {
    let tau = m.sigma_a * length;
    let left = beer_transmittance(tau);
    (*path).radiance += (*path).throughput * m.color * beer_absorptance(tau, left);
    (*path).throughput *= left;
}

// The fog along the path's segment up to its hit at `t`.
fn fog_segment(path: ptr<function, Path>, t: f32) {
    let i = load_frame_fog();
    if (i == NONE) {
        return;
    }
    let fog = load_medium(i);
    fog_add(path, fog, fog_length(path, (*path).dir, t, fog.reach));
}

// Transmittance of the fog along the path's shadow ray up to its hit at `t`.
fn fog_transmittance(path: ptr<function, Path>, t: f32) -> vec3f {
    let i = load_frame_fog();
    if (i == NONE) {
        return vec3f(1.0);
    }
    let length = fog_length(path, (*path).shadow_dir, t, load_medium_reach(i));
    return beer_transmittance(load_medium_sigma_a(i) * length);
}

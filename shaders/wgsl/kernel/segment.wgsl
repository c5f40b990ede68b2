// The medium that a path is in, between two vertices.

#import "kernel/state.wgsl"
#import "kernel/fog.wgsl"
#import "kernel/vertex.wgsl"
#import "math/beer.wgsl"
#import "math/vector.wgsl"
#import "media/homogeneous.wgsl"
#import "sampler/key.wgsl"
#import "scene/before.wgsl"
#import "scene/constants.wgsl"
#import "scene/fog.wgsl"
#import "scene/records.wgsl"
#import "scene/sampler.wgsl"
#import "scene/start.wgsl"
#import "trace/ray.wgsl"

// How far beyond its free path the ray of a segment looks. A surface farther away is no nearer to the end of the free
// path than rounding, except to rays within 2.4e-3 of its plane.
const SEGMENT_BEYOND: f32 = 1e-4;

// Takes away what the path's medium absorbs along its segment. Where the segment leaves the scene, the
// medium's colour takes its place.
fn segment_absorb(path: ptr<function, Path>, t: f32) {
    let i = (*path).inside.medium;
    if (i == NONE) {
        return;
    }
    let m = load_medium(i);
    if (t > FOG_LEAVES) {
        let tau = m.sigma_a * m.reach;
        fog_glow(path, m.color, tau, dispatch_fog_with(path, t, tau));
        (*path).throughput *= beer_transmittance(tau);
        return;
    }
    (*path).throughput *= beer_transmittance(m.sigma_a * (t + fog_start(path, (*path).dir)));
}

// Optical depth of the path's medium along its segment.
fn segment_depth(path: ptr<function, Path>, t: f32) -> vec3f {
    let i = (*path).inside.medium;
    if (i == NONE) {
        return vec3f(0.0);
    }
    let m = load_medium(i);
    return (m.sigma_a + m.sigma_s) * fog_length(path, (*path).dir, t, m.reach);
}

// Chooses where the medium scatters the path along its next segment, and tells how far the segment's ray has to look: a
// little farther, so that a surface just behind that point is found.
fn segment_reach(path: ptr<function, Path>) -> f32 {
    (*path).inside.free_path = RAY_FAR;
    let i = (*path).inside.medium;
    if (i == NONE) {
        return RAY_FAR;
    }
    let m = load_medium(i);
    if (vector_max(m.sigma_s) <= 0.0) {
        return RAY_FAR;
    }
    let t = homogeneous_free_path(m, (*path).throughput, sample_2d((*path).key, PURPOSE_DISTANCE));
    (*path).inside.free_path = t;
    return select(RAY_FAR, t * 1.0001 + SEGMENT_BEYOND, t < m.reach);
}

// As `segment_absorb` for media that may scatter: true if the path is scattered on its way, in `v` unless it has ended.
fn segment_scatter(path: ptr<function, Path>, hit: Hit, v: ptr<function, Vertex>) -> bool {
    let i = (*path).inside.medium;
    if (i == NONE) {
        return false;
    }
    let m = load_medium(i);
    if (vector_max(m.sigma_s) <= 0.0) {
        segment_absorb(path, hit.t);
        return false;
    }
    let length = fog_length(path, (*path).dir, hit.t, m.reach);
    let free_path = (*path).inside.free_path;
    (*path).throughput *= homogeneous_weight(m, (*path).throughput, free_path, length);
    if (free_path >= length) {
        return false;
    }
    let from_start = max(free_path - fog_start(path, (*path).dir), 0.0);
    // Beyond the surface at the end of its segment it would never leave the medium.
    let at = min(from_start, dispatch_before(hit, (*path).dir));
    dispatch_fog_absorb(path, at);
    let origin = dispatch_origin((*path).point, (*path).ray_offset, (*path).start, (*path).dir);
    vertex_medium(path, origin + (*path).dir * at, i, v);
    return true;
}

// Transmittance of the medium along the path's shadow ray up to its hit at `t`.
fn segment_shadow_transmittance(path: ptr<function, Path>, t: f32) -> vec3f {
    let i = (*path).inside.shadow_medium;
    if (i == NONE) {
        return vec3f(1.0);
    }
    let m = load_medium(i);
    return beer_transmittance((m.sigma_a + m.sigma_s) * fog_shadow_length(path, t, m.reach));
}

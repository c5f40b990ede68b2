// Light groups: moves a path on as `path_advance` does, along the same rays and random numbers, and tells what this
// step has found apart from what was found before. Whose light that is knows who has the ray and its hit.

#import "kernel/path.wgsl"
#import "kernel/state.wgsl"
#import "kernel/vertex.wgsl"
#import "scene/constants.wgsl"
#import "scene/dispatch.wgsl"
#import "scene/probe.wgsl"
#import "scene/segment.wgsl"
#import "trace/ray.wgsl"

// Radiance that one step adds to its path.
struct LightsFound {
    // From the light of the shadow ray, from the surface that was hit, or from the sky where nothing was.
    emitted: vec3f,
    // From media on the way.
    glow: vec3f,
    // The path has met something that scatters it, or would if it were not at its end.
    met: bool,
}

// Moves the path on by what its ray has hit. Its radiance is what it would be after `path_advance`.
fn lights_advance(path: ptr<function, Path>, hit: Hit) -> LightsFound {
    let before = (*path).radiance;
    (*path).radiance = vec3f(0.0);
    if ((*path).shadow_light != NONE) {
        // Or a probe, which finds nothing.
        path_advance(path, hit);
        let emitted = (*path).radiance;
        (*path).radiance = before + emitted;
        return LightsFound(emitted, vec3f(0.0), false);
    }
    if (dispatch_probe_advance(path, hit)) {
        (*path).radiance = before;
        return LightsFound(vec3f(0.0), vec3f(0.0), false);
    }
    (*path).segments += 1u;
    var v: Vertex;
    let in_medium = dispatch_segment(path, hit, &v);
    var goes_on = in_medium && (*path).open;
    let glow = (*path).radiance;
    (*path).radiance = vec3f(0.0);
    if (!in_medium && hit.prim == NONE) {
        let straight = (*path).scattered == 0u;
        (*path).radiance = (*path).throughput * dispatch_miss((*path).dir, (*path).pdf, (*path).receiver, straight);
        (*path).open = false;
    } else if (!in_medium) {
        goes_on = vertex_surface(path, hit, &v);
    }
    let emitted = (*path).radiance;
    // Before the path is scattered, which may have to know it.
    (*path).radiance = before + glow + emitted;
    if (goes_on) {
        vertex_scatter(path, v);
    }
    return LightsFound(emitted, glow, in_medium || goes_on);
}

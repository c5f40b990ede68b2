// The state of one path between two rays, and how a ray's answer moves it on.
// A vertex may leave two rays to trace: the shadow ray to the sampled light, then the next segment. Both
// go through the same call of `trace`, one a turn of the kernel's loop. A shadow ray may take several turns.

#import "kernel/vertex.wgsl"
#import "kernel/state.wgsl"
#import "sampler/key.wgsl"
#import "scene/constants.wgsl"
#import "scene/dispatch.wgsl"
#import "scene/probe.wgsl"
#import "scene/segment.wgsl"
#import "scene/shadow.wgsl"
#import "scene/start.wgsl"
#import "trace/ray.wgsl"

// The camera path of `key` through `pixel`.
fn path_begin(key: SampleKey, pixel: vec2u) -> Path {
    return state_at_camera(key, dispatch_camera(key, dispatch_film(key, pixel)));
}

// The ray to trace next.
fn path_ray(path: ptr<function, Path>) -> Ray {
    var dir = (*path).shadow_dir;
    var t_max = (*path).shadow_t;
    if ((*path).shadow_light == NONE) {
        dir = (*path).dir;
        t_max = dispatch_segment_reach(path);
    }
    let origin = dispatch_origin((*path).point, (*path).ray_offset, (*path).start, dir);
    let skip = dispatch_skip((*path).skip, (*path).ray_offset, (*path).start, dir);
    let whole = ray_new(origin, dir, t_max, skip, (*path).shadow_light, (*path).time);
    let ray = dispatch_shadow_rest(path, whole);
    return dispatch_probe_ray(path, ray);
}

// Whether there is no ray left.
fn path_ended(path: Path) -> bool {
    return !path.open && path.shadow_light == NONE;
}

// Moves the path on by what its ray has hit.
fn path_advance(path: ptr<function, Path>, hit: Hit) {
    if (!path_connect(path, hit)) {
        path_extend(path, hit);
    }
}

// Takes in what a probe or a shadow ray has hit; false, and nothing happens, for a ray that is the next segment.
fn path_connect(path: ptr<function, Path>, hit: Hit) -> bool {
    if (dispatch_probe_advance(path, hit)) {
        return true;
    }
    if ((*path).shadow_light == NONE) {
        return false;
    }
    dispatch_shadow_transmittance(path, hit.t);
    if (hit.prim == NONE) {
        (*path).radiance += (*path).shadow_radiance;
    } else if (dispatch_shadow_advance(path, hit)) {
        return true;
    }
    (*path).shadow_light = NONE;
    dispatch_shadow_end(path);
    return true;
}

// Moves the path on to the end of its segment, which has hit that, and scatters it there.
fn path_extend(path: ptr<function, Path>, hit: Hit) {
    (*path).segments += 1u;
    var v: Vertex;
    if (dispatch_segment(path, hit, &v)) {
        if (!(*path).open) {
            return;
        }
    } else if (hit.prim == NONE) {
        let straight = (*path).scattered == 0u;
        (*path).radiance += (*path).throughput * dispatch_miss((*path).dir, (*path).pdf, (*path).receiver, straight);
        (*path).open = false;
        return;
    } else if (!vertex_surface(path, hit, &v)) {
        return;
    }
    vertex_scatter(path, v);
}

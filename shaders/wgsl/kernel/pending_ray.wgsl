// What a path must remember where shadow rays pass through surfaces: the start of its next ray while the shadow ray
// is traced from somewhere else, and the vertex that lights are weighted against.

#import "scene/constants.wgsl"

struct PendingRay {
    // A ray is pending: `point`, `ray_offset` and `skip` of the path.
    used: bool,
    point: vec3f,
    ray_offset: vec3f,
    skip: vec2u,
    // The last vertex at which the path was scattered, or the camera: where a light would have been sampled.
    vertex: vec3f,
}

// Nothing yet; the path leaves the camera at `origin`.
fn pending_ray_begin(origin: vec3f) -> PendingRay {
    return PendingRay(false, vec3f(0.0), vec3f(0.0), vec2u(NONE), origin);
}

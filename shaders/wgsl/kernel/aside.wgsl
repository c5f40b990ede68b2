// What a path must know where shadow rays go on behind what they hit: the start of its next ray, put aside while
// its shadow ray is traced from somewhere else, and the vertex that lights are weighted against.

#import "scene/constants.wgsl"

struct Aside {
    // There is something put aside: `point`, `gap` and `skip` of the path.
    used: bool,
    point: vec3f,
    gap: vec3f,
    skip: vec2u,
    // The last vertex at which the path was scattered, or the camera: where a light would have been sampled.
    vertex: vec3f,
}

// Nothing yet; the path leaves the camera at `origin`.
fn aside_begin(origin: vec3f) -> Aside {
    return Aside(false, vec3f(0.0), vec3f(0.0), vec2u(NONE), origin);
}

// What a path must remember where rays go straight through surfaces: how far its shadow ray has come, and the vertex
// that lights are weighted against.

#import "scene/constants.wgsl"

struct Passage {
    // The last surface that the shadow ray went through, as `Ray::t_min` and `Ray::last`.
    t: f32,
    last: vec2u,
    // The last vertex at which the path was scattered, or the camera: where a light would have been sampled.
    vertex: vec3f,
}

// Nothing yet; the path leaves the camera at `origin`.
fn passage_begin(origin: vec3f) -> Passage {
    return Passage(0.0, vec2u(NONE), origin);
}

// What a path remembers between two rays. World frame, normalised units.

#import "camera/film_plane.wgsl"
#import "sampler/key.wgsl"
#import "scene/constants.wgsl"
#import "scene/inside.wgsl"
#import "scene/motion.wgsl"
#import "scene/receiver.wgsl"
#import "scene/start.wgsl"

struct Path {
    // Which random numbers; `bounce` counts the vertices so far.
    key: SampleKey,
    // Radiance found so far.
    radiance: vec3f,
    // Segments traced.
    segments: u32,
    // What of `radiance` is direct light, from the second scattering on; see `indirect.wgsl`.
    direct: vec3f,
    // Times it was scattered.
    scattered: u32,
    // Product of f |cos| / pdf over the vertices, roulette included.
    throughput: vec3f,
    // What Russian roulette multiplies `throughput` with: the product of eta^2, which refraction has taken from it
    // until the path comes out again and which is no absorption. From the first bounce on, that of later refractions
    // over the largest channel of `throughput` then.
    roulette_scale: f32,
    // Last vertex: on its surface, or the camera.
    point: vec3f,
    // Density per steradian with which `dir` was sampled; 0 for the camera and for delta lobes.
    pdf: f32,
    // Next segment, unit. Meaningful while `open`.
    dir: vec3f,
    // Primitive of `point`, as `Ray::skip`.
    skip: vec2u,
    // Ray offset: from `point` to a ray's start, on one side of the surface; the other side is its negative.
    ray_offset: vec3f,
    // Where rays start that leave a smooth surface below its triangle's plane.
    start: Start,
    // There is a next segment.
    open: bool,
    // The shadow ray to trace before it: unit direction, length, light (`NONE`: no shadow ray), and the
    // radiance that it brings if nothing is in between.
    shadow_dir: vec3f,
    shadow_t: f32,
    shadow_radiance: vec3f,
    shadow_light: u32,
    // Media that the path is in, if the scene has any.
    inside: Inside,
    // How far the shadow ray has come, if shadow rays go through surfaces.
    passage: Passed,
    // Of the last vertex at which the path was scattered, if lights are chosen by it.
    receiver: Receiver,
    // When all of it sees the scene: 0 where the shutter opens, 1 where it closes.
    time: f32,
}

// A path that is about to leave the camera along `ray`.
fn state_at_camera(key: SampleKey, ray: CameraRay) -> Path {
    return Path(
        key, vec3f(0.0), 0u, vec3f(0.0), 0u, vec3f(1.0), 1.0,
        ray.origin, 0.0, ray.dir, vec2u(NONE), vec3f(0.0), dispatch_start_plain(), true,
        ray.dir, 0.0, vec3f(0.0), NONE,
        inside_begin(), passed_begin(ray.origin), receiver_none(), dispatch_time(key),
    );
}

// What the traversal is asked and what it answers. World frame, normalised units, unless `Ray::instance` says
// otherwise.

#import "scene/constants.wgsl"

// Bit 31 of `Hit::prim`: a sphere index, otherwise a triangle index.
const PRIM_SPHERE: u32 = 0x80000000u;

// Farther than anything: the normalised scene lies in a ball of radius 1.
const RAY_FAR: f32 = 1e30;

struct Ray {
    origin: vec3f,
    // Nothing beyond this distance is hit.
    t_max: f32,
    // Nothing before this distance is hit, and at it only what comes after `last`: a shadow ray that goes on behind a
    // surface is the same ray, so that it meets what it would have met. 0 for all others, and nothing is hit at 0.
    t_min: f32,
    // The surface at `t_min`, as `skip`, or `NONE`.
    last: vec2u,
    // Unit in the world.
    dir: vec3f,
    // The primitive that the ray starts on and the instance that it is in, as in `Hit`; or `NONE`. A triangle
    // cannot be hit again, in any of its places; of a sphere only the other end of the chord counts.
    skip: vec2u,
    // `NONE`: find the nearest hit. Otherwise a shadow ray towards this light: any hit ends the search,
    // and primitives of this light are not there.
    light: u32,
    // When it sees the scene: 0 where the shutter opens, 1 where it closes.
    time: f32,
    // The instance in whose frame the ray is; `NONE`: the world.
    instance: u32,
}

struct Hit {
    // Distance along the ray.
    t: f32,
    // Which primitive, or `NONE`.
    prim: u32,
    // Barycentric weights of v1 and v2; unused for a sphere.
    b: vec2f,
    // The instance that the primitive is in, or `NONE`.
    instance: u32,
}

// Nothing hit before `t_max`.
fn ray_miss(t_max: f32) -> Hit {
    return Hit(t_max, NONE, vec2f(0.0), NONE);
}

// What a ray that starts at the hit must not meet again, as `Ray::skip`.
fn ray_skip(hit: Hit) -> vec2u {
    return vec2u(hit.prim, hit.instance);
}

// A ray from `origin` along `dir` up to `t_max`, in the world; `light`, `skip`, `time`: as in `Ray`.
fn ray_new(origin: vec3f, dir: vec3f, t_max: f32, skip: vec2u, light: u32, time: f32) -> Ray {
    return Ray(origin, t_max, 0.0, vec2u(NONE), dir, skip, light, time, NONE);
}

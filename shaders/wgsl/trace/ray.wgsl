// What the traversal is asked and what it answers. World frame, normalised units.

#import "scene/constants.wgsl"

// Bit 31 of `Hit::prim`: a sphere index, otherwise a triangle index.
const PRIM_SPHERE: u32 = 0x80000000u;

// Farther than anything: the normalised scene lies in a ball of radius 1.
const RAY_FAR: f32 = 1e30;

struct Ray {
    origin: vec3f,
    // Nothing beyond this distance is hit.
    t_max: f32,
    // Unit.
    dir: vec3f,
    // The primitive that the ray starts on, as in `Hit::prim`, or `NONE`. A triangle cannot be hit
    // again, in any of its places; of a sphere only the other end of the chord counts.
    skip: u32,
    // `NONE`: find the nearest hit. Otherwise a shadow ray towards this light: any hit ends the search,
    // and primitives of this light are not there.
    light: u32,
    // When it sees the scene: 0 where the shutter opens, 1 where it closes.
    time: f32,
}

struct Hit {
    // Distance along the ray.
    t: f32,
    // Which primitive, or `NONE`.
    prim: u32,
    // Barycentric weights of v1 and v2; unused for a sphere.
    b: vec2f,
}

// Nothing hit before `t_max`.
fn ray_miss(t_max: f32) -> Hit {
    return Hit(t_max, NONE, vec2f(0.0));
}

// Whether a sphere replaces the best hit so far. On equal distance the lower index wins, so that the
// picture of coinciding surfaces does not depend on the order of traversal.
fn ray_accepts(best: Hit, t: f32, prim: u32) -> bool {
    return t > 0.0 && (t < best.t || (t == best.t && prim < best.prim));
}

// Ray against sphere, and what the hit looks like.
// Haines, Gunther & Akenine-Moller, "Precision Improvements for Ray/Sphere Intersection", Ray Tracing
// Gems ch. 7: 0 wrong hits at distance/radius 1e4, where the school form has 71 %.

#import "abi/sphere.wgsl"
#import "math/vector.wgsl"
#import "math/atan.wgsl"
#import "scene/constants.wgsl"
#import "surface/surface.wgsl"

// Distances of the two hits, the nearer first; both -1 on a miss. `leaving`: the ray starts on this very
// sphere, so only the other end of the chord counts, and only if the ray goes in.
fn sphere_intersect(sphere: Sphere, origin: vec3f, dir: vec3f, leaving: bool) -> vec2f {
    let f = origin - sphere.center;
    let b = -dot(f, dir);
    let l = f + dir * b;
    let d = sphere.radius * sphere.radius - dot(l, l);
    if (d < 0.0) {
        return vec2f(-1.0);
    }
    let root = sqrt(d);
    if (leaving) {
        return vec2f(-1.0, select(-1.0, b + root, b > 0.0));
    }
    let q = b + select(-root, root, b >= 0.0);
    if (q == 0.0) {
        // The ray touches the sphere where it starts.
        return vec2f(-1.0);
    }
    let other = (dot(f, f) - sphere.radius * sphere.radius) / q;
    return vec2f(min(other, q), max(other, q));
}

// Outward unit normal at the hit at distance `t`.
fn sphere_normal(sphere: Sphere, origin: vec3f, dir: vec3f, t: f32) -> vec3f {
    return vector_unit_or(origin + dir * t - sphere.center, -dir);
}

// The surface of `sphere` at distance `t` of a ray.
fn sphere_surface(sphere: Sphere, origin: vec3f, dir: vec3f, t: f32) -> Surface {
    let out = sphere_normal(sphere, origin, dir, t);
    // Back onto the sphere: 1e3 times nearer to it than `origin + t dir`.
    let p = sphere.center + out * sphere.radius;
    let reach = max(vector_max(max(abs(sphere.center), abs(p))), sphere.radius);
    var s = surface_new(p, out, dir, reach);
    s.material = sphere.material;
    s.light = sphere.light;
    s.object = sphere.object & ~MOVES;
    return s;
}

// Texture coordinates of the outward normal `n`, both 0 ..= 1: u is the longitude, growing to the right
// as seen from outside with y up, 0.5 at +z; v is the latitude, 0 at -y and 1 at +y.
fn sphere_uv(n: vec3f) -> vec2f {
    let latitude = atan_turns(n.y, sqrt(n.x * n.x + n.z * n.z));
    // Not 0.5 + 2 latitude: texture lookups take 1 - v, and drivers fold the constants of 1 - (0.5 + x).
    return vec2f(0.5 + atan_turns(n.x, n.z), 2.0 * (0.25 + latitude));
}

// The direction in which the longitude grows at the outward normal `n`, unit; at the poles it is any.
fn sphere_tangent(n: vec3f) -> vec3f {
    return vector_unit_or(vec3f(n.z, 0.0, -n.x), vec3f(1.0, 0.0, 0.0));
}

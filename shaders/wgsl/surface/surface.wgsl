// The point where a path meets a surface. World frame, normalised units.

#import "math/vector.wgsl"
#import "scene/constants.wgsl"
#import "texture/texture_point.wgsl"

struct Surface {
    // On the surface, from its own parametrisation and not from `origin + t dir`.
    p: vec3f,
    // Where `p` was when the shutter opened, carried along by the surface.
    rest: vec3f,
    // Geometric normal, unit, on the side that the ray came from.
    ng: vec3f,
    // Normal of the plane above which reflected light leaves, unit: `ng`, unless the mesh stands for a smooth
    // surface that bulges towards the ray; then the normal of that.
    horizon: vec3f,
    // From `p` to that smooth surface; 0 where there is none.
    bulge: vec3f,
    // Shading normal, unit; dot(ns, ng) > 0 and dot(ns, wo) >= 0.
    ns: vec3f,
    // For textures.
    at: TexturePoint,
    // How far a ray that leaves must start from `p`, along `ng` or against it.
    ray_offset: f32,
    // Index of the `Material`.
    material: u32,
    // Index of the `Light`, or `NONE`.
    light: u32,
    // Index of the `Object`.
    object: u32,
    // Where the material asks for it: unit, the direction in which u grows, at a right angle to `ng` up to
    // rounding; otherwise 0.
    tangent: vec3f,
    // 1 where v grows along cross(ng, tangent), -1 where it grows against it.
    handed: f32,
    // The ray came from the front side: outside of a sphere, counter-clockwise triangle.
    front: bool,
}

// A flat surface at `p` with unit normal `out` of its front side, seen along `dir`. `reach`: the
// largest coordinate that went into `p`. Normals are turned to the ray, so every surface is two-sided;
// what depends on the side reads `front`.
fn surface_new(p: vec3f, out: vec3f, dir: vec3f, reach: f32) -> Surface {
    let front = dot(out, dir) <= 0.0;
    let ng = select(-out, out, front);
    // 16 ulp of the largest coordinate: measured to lose no neighbour and to hit no own primitive for
    // triangles of any size and distance, down to grazing cosines of 1e-4, where the source is skipped.
    let ray_offset = 9.5367432e-7 * reach; // 16 * 2^-24
    let at = texture_point(vec2f(0.0));
    return Surface(p, p, ng, ng, vec3f(0.0), ng, at, ray_offset, 0u, NONE, 0u, vec3f(0.0), 1.0, front);
}

// How far along a ray that hits a surface at `t` a point can be and still be on this side of it, at least, whatever
// the surface: 16 ulp of the largest coordinate before it, or half way.
fn surface_before(t: f32) -> f32 {
    return max(0.5 * t, t - 9.5367432e-7); // 16 * 2^-24
}

// `bulge` of the surface, if that is above it and rays can be told that leave below it.
fn surface_bulge(s: Surface, bulge: vec3f) -> vec3f {
    return select(vec3f(0.0), bulge, s.ray_offset > 0.0 && dot(bulge, s.ng) > 0.0);
}

// Moves the surface by `shift`, which it has come since the shutter opened.
fn surface_carry(s: ptr<function, Surface>, shift: vec3f) {
    (*s).p += shift;
    // As in `surface_new`, with 2 ulp more: the sum above rounds, and so does the way back of the next ray.
    let ray_offset = 9.5367432e-7 * vector_max(abs((*s).p));
    (*s).ray_offset = max((*s).ray_offset, ray_offset) * 1.125;
}

// A shading normal that can be used with `ng` (faces the ray) for a ray along `dir`, from an
// interpolated unit normal `n` on any side.
// First `n` is turned to the side of `ng`. Near silhouettes it may still face away from the ray, which
// would make every model black; it is then bent towards the ray by the least amount that lifts its
// cosine to 1e-3, or to that of `ng` if that is less: so a flat surface is never changed.
fn surface_shading_normal(ng: vec3f, n: vec3f, dir: vec3f) -> vec3f {
    let ns = select(-n, n, dot(n, ng) >= 0.0);
    let lift = min(1e-3, -dot(ng, dir)) + dot(ns, dir);
    if (lift <= 0.0) {
        return ns;
    }
    // dot(ns - lift dir, -dir) is the wanted cosine, and its dot with ng only grows: not the zero vector.
    return vector_unit_or(ns - dir * lift, ng);
}

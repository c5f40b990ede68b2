// Texture coordinates by projection along the axes of an object: of surfaces that have none, or none that will do.

#import "math/vector.wgsl"
#import "sampler/key.wgsl"
#import "scene/constants.wgsl"
#import "scene/motion.wgsl"
#import "scene/records.wgsl"
#import "scene/sampler.wgsl"
#import "surface/place.wgsl"
#import "surface/surface.wgsl"

// Gives `s`, on a material with these flags, the texture coordinates and the tangent of one of the planes at right
// angles to the axes. Where all three are asked for, each is seen from outside, so that nothing is mirrored, and one is
// taken by chance: the mean over samples blends them, each with the fourth power of the normal's part along its axis
// (triplanar mapping: Geiss 2007, GPU Gems 3, 1.5). `key`: the vertex.
fn projection_apply(s: ptr<function, Surface>, flags: u32, key: SampleKey, time: f32) {
    let o = load_object((*s).object);
    let q = place_at((*s).object, (*s).rest).q;
    let outside = dispatch_turn_back((*s).object, select(-(*s).ns, (*s).ns, (*s).front), time);
    let n = vec3f(dot(o.row_x, outside), dot(o.row_y, outside), dot(o.row_z, outside));
    let axis = projection_axis(n, flags, key);
    var side = 1.0;
    if ((flags & FLAG_PROJECT) == FLAG_PROJECT) {
        side = select(-1.0, 1.0, select(select(n.x, n.y, axis == 1u), n.z, axis == 2u) >= 0.0);
    }
    // Up is +y, and on what faces up or down -z or +z.
    var u = o.row_x;
    var v = o.row_y;
    if (axis == 0u) {
        (*s).uv = vec2f(-side * q.z, q.y);
        u = o.row_z * -side;
    } else if (axis == 1u) {
        (*s).uv = vec2f(q.x, -side * q.z);
        v = o.row_z * -side;
    } else {
        (*s).uv = vec2f(side * q.x, q.y);
        u = o.row_x * side;
    }
    let along = dispatch_turn((*s).object, vector_unit(u), time);
    let up = dispatch_turn((*s).object, v, time);
    (*s).tangent = vector_unit_or(along - (*s).ng * dot((*s).ng, along), vec3f(0.0));
    (*s).handed = select(-1.0, 1.0, dot(vector_cross((*s).ng, along), up) >= 0.0);
}

// The axis along which to look at a surface with normal `n`, of any length, in the object's frame.
fn projection_axis(n: vec3f, flags: u32, key: SampleKey) -> u32 {
    switch (flags & FLAG_PROJECT) {
        case FLAG_PROJECT_X: { return 0u; }
        case FLAG_PROJECT_Y: { return 1u; }
        case FLAG_PROJECT_Z: { return 2u; }
        default: {}
    }
    let a = abs(n) / max(vector_max(abs(n)), 1e-30);
    let a2 = a * a;
    let pick = sample_1d(key, PURPOSE_PROJECTION) * dot(a2, a2);
    let beyond = pick - a2.x * a2.x;
    if (beyond < 0.0) {
        return 0u;
    }
    return select(2u, 1u, beyond < a2.y * a2.y);
}

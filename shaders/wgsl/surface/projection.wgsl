// Texture coordinates by projection along the axes of an object: of surfaces that have none, or none that will do.

#import "math/vector.wgsl"
#import "sampler/key.wgsl"
#import "scene/constants.wgsl"
#import "scene/motion.wgsl"
#import "scene/records.wgsl"
#import "scene/sampler.wgsl"
#import "surface/place.wgsl"
#import "surface/surface.wgsl"

// Along which axis of the object to look at a surface, and from which side.
struct ProjectionPlane {
    axis: u32,
    // 1, or -1 where the axis is looked along from its far end.
    side: f32,
}

// Gives `s`, on a material with these flags, the texture coordinates and the tangent of one of the planes at right
// angles to the axes. `key`: the vertex.
fn projection_apply(s: ptr<function, Surface>, flags: u32, key: SampleKey, time: f32) {
    let o = load_object((*s).object);
    let plane = projection_plane(*s, flags, key, time);
    let at = projection_on(plane, *s, flags);
    (*s).at.uv = at.xy;
    (*s).at.w = at.z;
    // Up is +y, and on what faces up or down -z or +z.
    var u = o.row_x;
    var v = o.row_y;
    if (plane.axis == 0u) {
        u = o.row_z * -plane.side;
    } else if (plane.axis == 1u) {
        v = o.row_z * -plane.side;
    } else {
        u = o.row_x * plane.side;
    }
    let along = dispatch_turn((*s).object, vector_unit(u), time);
    let up = dispatch_turn((*s).object, v, time);
    (*s).tangent = vector_unit_or(along - (*s).ng * dot((*s).ng, along), vec3f(0.0));
    (*s).handed = select(-1.0, 1.0, dot(vector_cross((*s).ng, along), up) >= 0.0);
}

// The texture coordinates u, v and w that `projection_apply` gives.
fn projection_at(s: Surface, flags: u32, key: SampleKey, time: f32) -> vec3f {
    return projection_on(projection_plane(s, flags, key, time), s, flags);
}

// Texture coordinates on `plane`. Textures that fill the object are those across the z axis, with z as the third
// coordinate.
fn projection_on(plane: ProjectionPlane, s: Surface, flags: u32) -> vec3f {
    let q = place_at(s.object, s.rest).q;
    if (plane.axis == 0u) {
        return vec3f(-plane.side * q.z, q.y, 0.0);
    }
    if (plane.axis == 1u) {
        return vec3f(q.x, -plane.side * q.z, 0.0);
    }
    return vec3f(plane.side * q.x, q.y, select(0.0, q.z, (flags & FLAG_PROJECT_SOLID) != 0u));
}

// The plane on which a material with these flags is projected. Where all three are asked for, each is seen from
// outside, so that nothing is mirrored, and one is taken by chance: the mean over samples blends them, each with the
// fourth power of the normal's part along its axis (triplanar mapping: Geiss 2007, GPU Gems 3, 1.5).
fn projection_plane(s: Surface, flags: u32, key: SampleKey, time: f32) -> ProjectionPlane {
    let o = load_object(s.object);
    let outside = dispatch_turn_back(s.object, select(-s.ns, s.ns, s.front), time);
    let n = vec3f(dot(o.row_x, outside), dot(o.row_y, outside), dot(o.row_z, outside));
    let axis = projection_axis(n, flags, key);
    var side = 1.0;
    if ((flags & FLAG_PROJECT_BOX) == FLAG_PROJECT_BOX) {
        side = select(-1.0, 1.0, select(select(n.x, n.y, axis == 1u), n.z, axis == 2u) >= 0.0);
    }
    return ProjectionPlane(axis, side);
}

// The axis along which to look at a surface with normal `n`, of any length, in the object's frame.
fn projection_axis(n: vec3f, flags: u32, key: SampleKey) -> u32 {
    switch (flags & FLAG_PROJECT) {
        case FLAG_PROJECT_X: { return 0u; }
        case FLAG_PROJECT_Y: { return 1u; }
        case FLAG_PROJECT_Z, FLAG_PROJECT_SOLID: { return 2u; }
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

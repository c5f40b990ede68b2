// What a hit on a triangle of an instance looks like in the world.

#import "abi/instance.wgsl"
#import "abi/triangle.wgsl"
#import "math/octahedral.wgsl"
#import "math/vector.wgsl"
#import "scene/constants.wgsl"
#import "scene/motion.wgsl"
#import "scene/records.wgsl"
#import "shape/triangle.wgsl"
#import "surface/surface.wgsl"
#import "texture/texture_point.wgsl"
#import "trace/ray.wgsl"

// The material that instance `i` has where its triangle has `own`.
fn instance_material(i: u32, own: u32) -> u32 {
    let material = load_instance_material(i);
    return select(material, own, material == NONE);
}

// Vector `v` of the frame of instance `o` in the world.
fn instance_vector(o: Instance, v: vec3f) -> vec3f {
    return o.col_x * v.x + o.col_y * v.y + o.col_z * v.z;
}

// Normal `n` of the frame of instance `o` in the world, unit, for a unit `n`: by the transposed inverse, which
// keeps outside outside, also where the instance is mirrored.
fn instance_normal(o: Instance, n: vec3f) -> vec3f {
    return vector_unit_or(o.row_x * n.x + o.row_y * n.y + o.row_z * n.z, vec3f(0.0, 0.0, 1.0));
}

// The surface that a ray along `dir`, world frame, has hit at `time` in an instance.
fn instance_surface(hit: Hit, dir: vec3f, time: f32) -> Surface {
    let o = load_instance(hit.instance);
    let tri = load_triangle(hit.prim);
    let shade = load_tri_shade(hit.prim);
    let b = hit.b;
    let q = tri.v0 * (1.0 - b.x - b.y) + tri.v1 * b.x + tri.v2 * b.y;
    let p = instance_vector(o, q) + o.center;
    let back = dispatch_thing_dir(o.object, dir, time);
    var s = surface_new(p, instance_normal(o, triangle_normal(tri)), back, o.reach);
    s.at = TexturePoint(triangle_mix_uv(shade, b), 0.0, hit.prim, b);
    s.material = select(o.material, shade.material, o.material == NONE);
    s.object = o.object & ~MOVES;
    if ((shade.object & TRI_SMOOTH) != 0u) {
        s.ns = surface_shading_normal(s.ng, instance_smooth_normal(o, shade.normals, b, s.ng), back);
        s.bulge = instance_bulge(o, tri, shade.normals, b, s);
    }
    dispatch_thing_carry(&s, o.object, time);
    return s;
}

// As `triangle_bulge`, in the world.
fn instance_bulge(o: Instance, tri: Triangle, normals: vec3u, b: vec2f, s: Surface) -> vec3f {
    let n0 = instance_normal(o, octahedral_decode(normals.x));
    let n1 = instance_normal(o, octahedral_decode(normals.y));
    let n2 = instance_normal(o, octahedral_decode(normals.z));
    let q = tri.v0 * (1.0 - b.x - b.y) + tri.v1 * b.x + tri.v2 * b.y;
    let l0 = triangle_lift(instance_vector(o, q - tri.v0), n0, s.ng) * (1.0 - b.x - b.y);
    let l1 = triangle_lift(instance_vector(o, q - tri.v1), n1, s.ng) * b.x;
    let l2 = triangle_lift(instance_vector(o, q - tri.v2), n2, s.ng) * b.y;
    return surface_bulge(s, l0 + l1 + l2);
}

// As `triangle_smooth_normal`. The corners' normals are unit in the world before they are mixed, as those of
// triangles that are stored in the world.
fn instance_smooth_normal(o: Instance, normals: vec3u, b: vec2f, fallback: vec3f) -> vec3f {
    let n0 = instance_normal(o, octahedral_decode(normals.x));
    let n1 = instance_normal(o, octahedral_decode(normals.y));
    let n2 = instance_normal(o, octahedral_decode(normals.z));
    return vector_unit_or(n0 * (1.0 - b.x - b.y) + n1 * b.x + n2 * b.y, fallback);
}

// The tangent of `triangle_tangent` in the world; in a mirrored instance v grows on the other side of it.
fn instance_tangent(i: u32, tangent: vec4f) -> vec4f {
    let o = load_instance(i);
    let along = vector_unit_or(instance_vector(o, tangent.xyz), vec3f(1.0, 0.0, 0.0));
    let turn = vector_cross(o.col_x, o.col_y);
    return vec4f(along, select(tangent.w, -tangent.w, dot(turn, o.col_z) < 0.0));
}

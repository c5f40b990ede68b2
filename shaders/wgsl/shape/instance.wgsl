// What a hit on a triangle of an instance looks like in the world.

#import "math/octahedral.wgsl"
#import "math/vector.wgsl"
#import "scene/constants.wgsl"
#import "scene/motion.wgsl"
#import "scene/records.wgsl"
#import "shape/triangle.wgsl"
#import "surface/surface.wgsl"
#import "trace/ray.wgsl"

// The material that instance `i` has where its triangle has `own`.
fn instance_material(i: u32, own: u32) -> u32 {
    let material = load_instance_material(i);
    return select(material, own, material == NONE);
}

// Vector `v` of the frame of instance `i` in the world.
fn instance_vector(i: u32, v: vec3f) -> vec3f {
    return load_instance_col_x(i) * v.x + load_instance_col_y(i) * v.y + load_instance_col_z(i) * v.z;
}

// Normal `n` of the frame of instance `i` in the world, unit, for a unit `n`: by the transposed inverse, which
// keeps outside outside, also where the instance is mirrored.
fn instance_normal(i: u32, n: vec3f) -> vec3f {
    let turned = load_instance_row_x(i) * n.x + load_instance_row_y(i) * n.y + load_instance_row_z(i) * n.z;
    return vector_unit_or(turned, vec3f(0.0, 0.0, 1.0));
}

// The surface that a ray along `dir`, world frame, has hit at `time` in an instance.
fn instance_surface(hit: Hit, dir: vec3f, time: f32) -> Surface {
    let tri = load_triangle(hit.prim);
    let b = hit.b;
    let q = tri.v0 * (1.0 - b.x - b.y) + tri.v1 * b.x + tri.v2 * b.y;
    let p = instance_vector(hit.instance, q) + load_instance_center(hit.instance);
    let out = instance_normal(hit.instance, triangle_normal(tri));
    let object = load_instance_object(hit.instance);
    let back = dispatch_thing_dir(object, dir, time);
    var s = surface_new(p, out, back, load_instance_reach(hit.instance));
    s.uv = triangle_uv(hit.prim, b);
    s.material = instance_material(hit.instance, load_tri_shade_material(hit.prim));
    s.object = object & ~MOVES;
    if ((load_tri_shade_object(hit.prim) & TRI_SMOOTH) != 0u) {
        let n = instance_smooth_normal(hit.instance, load_tri_shade_normals(hit.prim), b, s.ng);
        s.ns = surface_shading_normal(s.ng, n, back);
        s.bulge = instance_bulge(hit, q, s);
    }
    dispatch_thing_carry(&s, object, time);
    return s;
}

// As `triangle_bulge`, in the world. `q`: the point in the instance's frame.
fn instance_bulge(hit: Hit, q: vec3f, s: Surface) -> vec3f {
    let tri = load_triangle(hit.prim);
    let normals = load_tri_shade_normals(hit.prim);
    let i = hit.instance;
    let b = hit.b;
    let n0 = instance_normal(i, octahedral_decode(normals.x));
    let n1 = instance_normal(i, octahedral_decode(normals.y));
    let n2 = instance_normal(i, octahedral_decode(normals.z));
    let l0 = triangle_lift(instance_vector(i, q - tri.v0), n0, s.ng) * (1.0 - b.x - b.y);
    let l1 = triangle_lift(instance_vector(i, q - tri.v1), n1, s.ng) * b.x;
    let l2 = triangle_lift(instance_vector(i, q - tri.v2), n2, s.ng) * b.y;
    return surface_bulge(s, l0 + l1 + l2);
}

// As `triangle_smooth_normal`. The corners' normals are unit in the world before they are mixed, as those of
// triangles that are stored in the world.
fn instance_smooth_normal(i: u32, normals: vec3u, b: vec2f, fallback: vec3f) -> vec3f {
    let n0 = instance_normal(i, octahedral_decode(normals.x));
    let n1 = instance_normal(i, octahedral_decode(normals.y));
    let n2 = instance_normal(i, octahedral_decode(normals.z));
    return vector_unit_or(n0 * (1.0 - b.x - b.y) + n1 * b.x + n2 * b.y, fallback);
}

// The tangent of `triangle_tangent` in the world; in a mirrored instance v grows on the other side of it.
fn instance_tangent(i: u32, tangent: vec4f) -> vec4f {
    let along = vector_unit_or(instance_vector(i, tangent.xyz), vec3f(1.0, 0.0, 0.0));
    let turn = vector_cross(load_instance_col_x(i), load_instance_col_y(i));
    return vec4f(along, select(tangent.w, -tangent.w, dot(turn, load_instance_col_z(i)) < 0.0));
}

// Ray against triangle, watertight, and what the hit looks like.
// Woop et al. 2013, "Watertight Ray/Triangle Intersection", JCGT 2(1), with every edge evaluated in
// the order of its welded vertex ids, so that two triangles that share an edge compute the same
// number with opposite sign, fused multiply-add or not. Measured on a closed mesh of 2,208
// triangles with 60,000 rays aimed at its edges and vertices, a third of them exact to the bit: one hit each.

#import "abi/tri_shade.wgsl"
#import "abi/triangle.wgsl"
#import "math/vector.wgsl"
#import "math/octahedral.wgsl"
#import "scene/constants.wgsl"
#import "scene/records.wgsl"
#import "surface/surface.wgsl"
#import "texture/texture_point.wgsl"

// The shear that turns a ray into the z axis.
struct TriangleShear {
    // x and y of the direction over its largest component, after the rotation of axes.
    slope: vec2f,
    // One over the largest component.
    inv_depth: f32,
    // Which axis is the largest: 0 x, 1 y, 2 z.
    axis: u32,
}

// The shear of direction `dir`, unit, world frame.
fn triangle_shear(dir: vec3f) -> TriangleShear {
    let a = abs(dir);
    var axis = 2u;
    if (a.x > a.y && a.x > a.z) {
        axis = 0u;
    } else if (a.y > a.z) {
        axis = 1u;
    }
    let d = triangle_permute(dir, axis);
    return TriangleShear(vec2f(d.x / d.z, d.y / d.z), 1.0 / d.z, axis);
}

// The axes turned round so that `axis` becomes z; a cyclic change keeps the winding.
fn triangle_permute(v: vec3f, axis: u32) -> vec3f {
    if (axis == 0u) {
        return v.yzx;
    }
    if (axis == 1u) {
        return v.zxy;
    }
    return v;
}

// (t, b1, b2, 0): distance along the ray and barycentric weights of v1 and v2; t = -1 on a miss.
// Both sides count. A hit on an edge or a vertex belongs to exactly one of the triangles around it.
fn triangle_intersect(tri: Triangle, origin: vec3f, shear: TriangleShear) -> vec4f {
    let p0 = triangle_permute(tri.v0 - origin, shear.axis);
    let p1 = triangle_permute(tri.v1 - origin, shear.axis);
    let p2 = triangle_permute(tri.v2 - origin, shear.axis);
    // Each lane depends on the ray and one vertex only.
    let x = vec3f(p0.x - shear.slope.x * p0.z, p1.x - shear.slope.x * p1.z, p2.x - shear.slope.x * p2.z);
    let y = vec3f(p0.y - shear.slope.y * p0.z, p1.y - shear.slope.y * p1.z, p2.y - shear.slope.y * p2.z);
    // Lane i is the edge opposite vertex i. All three are one expression, so that a compiler which
    // fuses one product fuses the same product of the neighbour's edge.
    let ids = vec3u(tri.id0, tri.id1, tri.id2);
    let swap = ids.yzx > ids.zxy;
    let px = select(x.yzx, x.zxy, swap);
    let py = select(y.yzx, y.zxy, swap);
    let qx = select(x.zxy, x.yzx, swap);
    let qy = select(y.zxy, y.yzx, swap);
    let e = px * qy - py * qx;
    var side = e;
    if (any(e == vec3f(0.0))) {
        // The ray meets an edge or a vertex: it counts as moved by (epsilon, epsilon^2), which is what is left
        // of e then. Ids would not do: a vertex with the least id around it would be a hole.
        side = select(e, select(qy - py, px - qx, qy == py), e == vec3f(0.0));
    }
    let inside = (side > vec3f(0.0)) != swap;
    if (any(inside) && !all(inside)) {
        return vec4f(-1.0, 0.0, 0.0, 0.0);
    }
    let w = select(e, -e, swap);
    let det = w.x + w.y + w.z;
    if (det == 0.0) {
        return vec4f(-1.0, 0.0, 0.0, 0.0);
    }
    var t = dot(w, vec3f(p0.z, p1.z, p2.z)) / det * shear.inv_depth;
    // The weights are off by the roundings of the whole triangle. In a plane across an axis the distance needs none
    // of them: there it is right but for four roundings of itself, and has the right sign.
    if (p0.x == p1.x && p1.x == p2.x && shear.slope.x != 0.0) {
        t = p0.x / shear.slope.x * shear.inv_depth;
    } else if (p0.y == p1.y && p1.y == p2.y && shear.slope.y != 0.0) {
        t = p0.y / shear.slope.y * shear.inv_depth;
    }
    return vec4f(t, w.y / det, w.z / det, 0.0);
}

// 0 in the coordinate that all corners share, if the triangle stands still in a plane across an axis: rays meet
// such a plane at distances of the right sign. Otherwise above 0 in all three.
fn triangle_spread(tri: Triangle) -> vec3f {
    if ((tri.id0 & MOVES) != 0u) {
        return vec3f(1.0);
    }
    return max(abs(tri.v1 - tri.v0), abs(tri.v2 - tri.v0));
}

// Unit normal of the front side, from which v0, v1, v2 run counter-clockwise; world frame.
// A triangle without area has +z; the compiler drops such triangles.
fn triangle_normal(tri: Triangle) -> vec3f {
    return vector_unit_or(vector_cross(tri.v1 - tri.v0, tri.v2 - tri.v0), vec3f(0.0, 0.0, 1.0));
}

// The surface at barycentric weights `b` = (b1, b2) of triangle `tri`, seen along `dir`; not interpolated.
fn triangle_flat_surface(tri: Triangle, shade: TriShade, b: vec2f, dir: vec3f) -> Surface {
    let flat = triangle_spread(tri) == vec3f(0.0);
    // What all corners share is not mixed, and stays exact.
    let p = select(tri.v0 * (1.0 - b.x - b.y) + tri.v1 * b.x + tri.v2 * b.y, tri.v0, flat);
    let reach = max(max(abs(tri.v0), abs(tri.v1)), max(abs(tri.v2), abs(p)));
    var s = surface_new(p, triangle_normal(tri), dir, vector_max(reach));
    if (any(flat)) {
        // The point is in the plane, and whatever else is in it is at a distance of 0: one ulp is enough to be on the
        // right side of it, however thin that side is.
        s.ray_offset = 1.1920929e-7 * vector_max(select(vec3f(0.0), abs(p), flat)); // 2^-23
    }
    s.at.uv = triangle_mix_uv(shade, b);
    s.material = shade.material;
    s.light = shade.light;
    s.object = shade.object & ~TRI_SMOOTH;
    return s;
}

// As `triangle_flat_surface`, with the interpolated normal where the triangle has one.
fn triangle_surface(tri: Triangle, shade: TriShade, b: vec2f, dir: vec3f) -> Surface {
    var s = triangle_flat_surface(tri, shade, b, dir);
    if ((shade.object & TRI_SMOOTH) != 0u) {
        let n = triangle_smooth_normal(shade.normals, b, s.ng);
        s.ns = surface_shading_normal(s.ng, n, dir);
        s.bulge = triangle_bulge(tri, shade.normals, b, s);
    }
    return s;
}

// The object of a triangle and whether it moves, as `Sphere::object` has them.
fn triangle_thing(tri: Triangle, shade: TriShade) -> u32 {
    return (shade.object & ~TRI_SMOOTH) | (tri.id0 & MOVES);
}

// From the surface point `s` at weights `b` of triangle `tri` to the smooth surface that the corners' normals span:
// the point is lifted to the plane through each corner at a right angle to its normal, where that is above it, and
// the three points are mixed. 0 where the smooth surface is flat or hollow.
// Hanika 2021, "Hacking the Shadow Terminator", Ray Tracing Gems II, ch. 4.
fn triangle_bulge(tri: Triangle, normals: vec3u, b: vec2f, s: Surface) -> vec3f {
    let q = tri.v0 * (1.0 - b.x - b.y) + tri.v1 * b.x + tri.v2 * b.y;
    let l0 = triangle_lift(q - tri.v0, octahedral_decode(normals.x), s.ng) * (1.0 - b.x - b.y);
    let l1 = triangle_lift(q - tri.v1, octahedral_decode(normals.y), s.ng) * b.x;
    let l2 = triangle_lift(q - tri.v2, octahedral_decode(normals.z), s.ng) * b.y;
    return surface_bulge(s, l0 + l1 + l2);
}

// From a point of a triangle to the plane with unit normal `n`, on any side, through a corner, where that is above
// the triangle as `ng` has it; otherwise 0. `v`: from the corner to the point.
fn triangle_lift(v: vec3f, n: vec3f, ng: vec3f) -> vec3f {
    let out = select(-n, n, dot(n, ng) >= 0.0);
    return out * max(-dot(v, out), 0.0);
}

// The interpolated normal, unit; `fallback` where the corners cancel.
fn triangle_smooth_normal(normals: vec3u, b: vec2f, fallback: vec3f) -> vec3f {
    let n0 = octahedral_decode(normals.x);
    let n1 = octahedral_decode(normals.y);
    let n2 = octahedral_decode(normals.z);
    return vector_unit_or(n0 * (1.0 - b.x - b.y) + n1 * b.x + n2 * b.y, fallback);
}

// How far along a ray in direction `dir`, which hits triangle `i` of the world at `t`, a point can be and still be on
// this side of it when its coordinates are rounded.
fn triangle_before(i: u32, dir: vec3f, t: f32) -> f32 {
    let tri = load_triangle(i);
    let flat = triangle_spread(tri) == vec3f(0.0);
    if (!any(flat)) {
        return surface_before(t);
    }
    // Two ulp of the coordinate that the plane has, and eight roundings of the way.
    let ulps = 2.3841858e-7 * vector_max(select(vec3f(0.0), abs(tri.v0), flat)); // 2^-22
    let cosine = max(vector_max(select(vec3f(0.0), abs(dir), flat)), 1e-30);
    return max(t * 0.9999995 - ulps / cosine, 0.0); // 1 - 2^-21
}

// Texture coordinates at barycentric weights `b` = (b1, b2).
fn triangle_mix_uv(shade: TriShade, b: vec2f) -> vec2f {
    return shade.uv0 * (1.0 - b.x - b.y) + shade.uv1 * b.x + shade.uv2 * b.y;
}

// The point at weights `b` of triangle `i`, for textures.
fn triangle_texture_point(i: u32, b: vec2f) -> TexturePoint {
    return TexturePoint(triangle_mix_uv(load_tri_shade(i), b), 0.0, i, b);
}

// Barycentric weights (b1, b2) of point `p` in the plane of triangle `i`, also outside of it.
fn triangle_weights(i: u32, p: vec3f) -> vec2f {
    let tri = load_triangle(i);
    let e1 = tri.v1 - tri.v0;
    let e2 = tri.v2 - tri.v0;
    let r = p - tri.v0;
    let n = vector_cross(e1, e2);
    let n2 = dot(n, n);
    if (n2 < 1.1754944e-38) {
        return vec2f(0.0);
    }
    return vec2f(dot(vector_cross(r, e2), n), dot(vector_cross(e1, r), n)) / n2;
}

// The direction in which u grows on triangle `i`, unit, and in w the sign of `Surface::handed` for a front
// side; where all texture coordinates are the same, the first edge.
fn triangle_tangent(i: u32) -> vec4f {
    let tri = load_triangle(i);
    let shade = load_tri_shade(i);
    let e1 = tri.v1 - tri.v0;
    let d1 = shade.uv1 - shade.uv0;
    let d2 = shade.uv2 - shade.uv0;
    let area = d1.x * d2.y - d1.y * d2.x;
    let side = select(-1.0, 1.0, area >= 0.0);
    let along = (e1 * d2.y - (tri.v2 - tri.v0) * d1.y) * side;
    return vec4f(vector_unit_or(along, vector_unit_or(e1, vec3f(1.0, 0.0, 0.0))), side);
}

// A leaf of triangles.

#import "scene/candidate.wgsl"
#import "scene/motion.wgsl"
#import "scene/records.wgsl"
#import "shape/triangle.wgsl"
#import "trace/ray.wgsl"

// Bit 31 of `Hit::prim`: no triangle, whatever else it is. `NONE` has it, too. The name of what else there may be
// is not for scenes that have only triangles.
const PRIM_OTHER: u32 = 0x80000000u;

// The better of `best` and the hits of triangles `first .. first + count`.
fn triangles_trace(first: u32, count: u32, ray: Ray, shear: TriangleShear, best: Hit) -> Hit {
    var hit = best;
    var i = first;
    let end = first + count;
    loop {
        if (i == end) { break; }
        let tri = load_triangle(i);
        let h = triangle_intersect(tri, dispatch_triangle_origin(i, tri.id0, ray.origin, ray.time), shear);
        let accepted = triangles_accept(hit, h.x, i, ray.instance) && !triangles_skipped(i, ray);
        if (accepted && candidate_triangle(i, h.yz, ray)) {
            hit = Hit(h.x, i, h.yz, ray.instance);
        }
        i += 1u;
    }
    return hit;
}

// Whether triangle `i` of `instance` at distance `t` replaces the best hit so far. Of equal distances a triangle
// goes before a sphere, one of an instance before those of later instances and of none, and the first of two
// triangles of one frame in the order of what they are: never in the order of their places, of which one that
// was split has several.
fn triangles_accept(best: Hit, t: f32, i: u32, instance: u32) -> bool {
    if (t != best.t) {
        return t > 0.0 && t < best.t;
    }
    if ((best.prim & PRIM_OTHER) != 0u || instance != best.instance) {
        return t > 0.0 && ((best.prim & PRIM_OTHER) != 0u || instance < best.instance);
    }
    return t > 0.0 && triangles_before(i, best.prim);
}

// Whether triangle `i`, in the frame of `ray`, is what the ray starts on.
fn triangles_skipped(i: u32, ray: Ray) -> bool {
    return ray.instance == ray.skip.y && triangles_same(i, ray.skip.x);
}

// Whether `j`, as in `Hit::prim`, is the triangle `i` of the same frame itself, which may have several places.
fn triangles_same(i: u32, j: u32) -> bool {
    if (i == j) {
        return true;
    }
    if ((j & PRIM_OTHER) != 0u || load_triangle_id0(i) != load_triangle_id0(j)) {
        return false;
    }
    return load_triangle_id1(i) == load_triangle_id1(j) && load_triangle_id2(i) == load_triangle_id2(j)
        && load_tri_shade_material(i) == load_tri_shade_material(j)
        && load_tri_shade_object(i) == load_tri_shade_object(j);
}

// An order of all triangles of a frame: by their corners, then by what they are made of. Only of those that are alike
// in all of that the place counts.
fn triangles_before(i: u32, j: u32) -> bool {
    if (load_triangle_id0(i) != load_triangle_id0(j)) {
        return load_triangle_id0(i) < load_triangle_id0(j);
    }
    if (load_triangle_id1(i) != load_triangle_id1(j)) {
        return load_triangle_id1(i) < load_triangle_id1(j);
    }
    if (load_triangle_id2(i) != load_triangle_id2(j)) {
        return load_triangle_id2(i) < load_triangle_id2(j);
    }
    if (load_tri_shade_material(i) != load_tri_shade_material(j)) {
        return load_tri_shade_material(i) < load_tri_shade_material(j);
    }
    if (load_tri_shade_object(i) != load_tri_shade_object(j)) {
        return load_tri_shade_object(i) < load_tri_shade_object(j);
    }
    return i < j;
}

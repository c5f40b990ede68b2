// The order of what a ray meets at equal distances, so that the picture of coinciding surfaces does not depend on the
// order of traversal.

#import "scene/records.wgsl"
#import "trace/ray.wgsl"

// Bit 31 of `Hit::prim`: no triangle, whatever else it is. `NONE` has it, too. The name of what else there may be
// is not for scenes that have only triangles.
const PRIM_OTHER: u32 = 0x80000000u;

// Whether triangle `i` of `instance` at distance `t` replaces the best hit so far. Of equal distances a triangle
// goes before a sphere, one of an instance before those of later instances and of none, and the first of two
// triangles of one frame in the order of what they are: never in the order of their places, of which one that
// was split has several.
fn order_triangle(best: Hit, t: f32, i: u32, instance: u32) -> bool {
    if (t != best.t) {
        return t < best.t;
    }
    if ((best.prim & PRIM_OTHER) != 0u || instance != best.instance) {
        return (best.prim & PRIM_OTHER) != 0u || instance < best.instance;
    }
    return order_before(i, best.prim);
}

// Whether a sphere at distance `t` replaces the best hit so far: of equal distances the lowest index.
fn order_sphere(best: Hit, t: f32, prim: u32) -> bool {
    return t < best.t || (t == best.t && prim < best.prim);
}

// Whether triangle `i`, in the frame of `ray`, comes after what the ray has met at the same distance.
fn order_triangle_after(ray: Ray, i: u32) -> bool {
    if ((ray.last.x & PRIM_OTHER) != 0u || ray.instance != ray.last.y) {
        return (ray.last.x & PRIM_OTHER) == 0u && ray.instance > ray.last.y;
    }
    return !order_same(i, ray.last.x) && order_before(ray.last.x, i);
}

// The same of a sphere; nothing comes after `NONE`.
fn order_sphere_after(ray: Ray, prim: u32) -> bool {
    return (ray.last.x & PRIM_OTHER) == 0u || prim > ray.last.x;
}

// Whether triangle `i`, in the frame of `ray`, is what the ray starts on.
fn order_skipped(i: u32, ray: Ray) -> bool {
    return ray.instance == ray.skip.y && order_same(i, ray.skip.x);
}

// Whether `j`, as in `Hit::prim`, is the triangle `i` of the same frame itself, which may have several places.
fn order_same(i: u32, j: u32) -> bool {
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
fn order_before(i: u32, j: u32) -> bool {
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

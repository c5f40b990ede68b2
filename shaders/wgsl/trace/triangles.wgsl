// A leaf of triangles.

#import "scene/after.wgsl"
#import "scene/candidate.wgsl"
#import "scene/motion.wgsl"
#import "scene/records.wgsl"
#import "scene/shear.wgsl"
#import "shape/triangle.wgsl"
#import "trace/order.wgsl"
#import "trace/ray.wgsl"

// The better of `best` and the hits of triangles `first .. first + count`.
fn triangles_trace(first: u32, count: u32, ray: Ray, shear: TriangleShear, best: Hit) -> Hit {
    var hit = best;
    var i = first;
    let end = first + count;
    loop {
        if (i == end) { break; }
        let tri = load_triangle(i);
        let origin = dispatch_triangle_origin(i, tri.id0, ray.origin, ray.time);
        let h = triangle_intersect(tri, origin, dispatch_triangle_shear(i, tri.id0, ray, shear));
        let accepted = dispatch_triangle_after(ray, h.x, i) && order_triangle(hit, h.x, i, ray.instance);
        if (accepted && !order_skipped(i, ray) && candidate_triangle(i, h.yz, ray)) {
            hit = Hit(h.x, i, h.yz, ray.instance);
        }
        i += 1u;
    }
    return hit;
}

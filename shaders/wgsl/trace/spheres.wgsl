// A leaf of spheres.

#import "scene/after.wgsl"
#import "scene/candidate.wgsl"
#import "scene/constants.wgsl"
#import "scene/motion.wgsl"
#import "scene/records.wgsl"
#import "shape/sphere.wgsl"
#import "trace/order.wgsl"
#import "trace/ray.wgsl"

// The better of `best` and the hits of spheres `first .. first + count`.
fn spheres_trace(first: u32, count: u32, ray: Ray, best: Hit) -> Hit {
    var hit = best;
    var i = first;
    let end = first + count;
    loop {
        if (i == end) { break; }
        let prim = i | PRIM_SPHERE;
        let sphere = load_sphere(i);
        let origin = dispatch_thing_origin(sphere.object, ray.origin, ray.time);
        let dir = dispatch_thing_dir(sphere.object, ray.dir, ray.time);
        let t = sphere_intersect(sphere, origin, dir, prim == ray.skip.x);
        // The far end counts where the near end is behind the ray, or not there.
        if (spheres_counts(hit, t.x, prim, ray) && candidate_sphere(sphere, ray, origin, dir, t.x)) {
            hit = Hit(t.x, prim, vec2f(0.0), NONE);
        } else if (spheres_counts(hit, t.y, prim, ray) && candidate_sphere(sphere, ray, origin, dir, t.y)) {
            hit = Hit(t.y, prim, vec2f(0.0), NONE);
        }
        i += 1u;
    }
    return hit;
}

// Whether the sphere at distance `t` is in front of the ray and before the best hit so far.
fn spheres_counts(best: Hit, t: f32, prim: u32, ray: Ray) -> bool {
    return dispatch_sphere_after(ray, t, prim) && order_sphere(best, t, prim);
}

// Walks the BVH: the nearest hit, or any hit that hides a light.
// Nothing bounds the number of steps, because a tree is finite and a cap would open holes where geometry is hard.

#import "scene/constants.wgsl"
#import "scene/ends.wgsl"
#import "scene/leaf.wgsl"
#import "scene/nodes.wgsl"
#import "scene/records.wgsl"
#import "trace/box.wgsl"
#import "trace/ray.wgsl"
#import "trace/stack.wgsl"

// The nearest hit before `ray.t_max`, or a miss. For a shadow ray: some opaque hit on the way, else the nearest.
fn trace(ray: Ray) -> Hit {
    var hit = ray_miss(ray.t_max);
    var child = load_frame_root();
    let inverse = box_inverse(ray.dir);
    let leaf = leaf_prepare(ray);
    var n_stack = 0u;
    loop {
        if (child == NONE) { break; }
        if ((child & CHILD_INNER) != 0u) {
            child = dispatch_node(child & CHILD_INDEX, ray.origin, inverse, hit.t, &n_stack);
            if (child != NONE) {
                continue;
            }
        } else {
            hit = leaf_trace(child, ray, leaf, hit);
            if (ray.light != NONE && hit.prim != NONE && dispatch_ends(hit)) {
                break;
            }
        }
        child = stack_pop(&n_stack, hit.t);
    }
    return hit;
}

// Walks the BVH: the nearest hit, or any hit that hides a light. Trees of instances are walked by the same loop, in
// their own frame, with the rest of the world waiting on the same stack.
// Nothing bounds the number of steps, because a tree is finite and a cap would open holes where geometry is hard.

#import "scene/constants.wgsl"
#import "scene/instance_leaf.wgsl"
#import "scene/ends.wgsl"
#import "scene/leaf.wgsl"
#import "scene/nodes.wgsl"
#import "scene/records.wgsl"
#import "trace/ray.wgsl"
#import "trace/stack.wgsl"
#import "trace/walk.wgsl"

// The nearest hit before `ray.t_max`, or a miss. For a shadow ray: some opaque hit on the way, else the nearest.
fn trace(ray: Ray) -> Hit {
    var hit = ray_miss(ray.t_max);
    var child = load_frame_root();
    var walk = walk_begin(ray);
    var n_stack = 0u;
    // A triangle's distance has more roundings than that of its box.
    let t_min = ray.t_min * 0.9999;
    loop {
        if (child == NONE) { break; }
        if ((child & CHILD_INNER) != 0u) {
            child = dispatch_node(child & CHILD_INDEX, walk.ray.origin, walk.inverse, t_min, hit.t, &n_stack);
            if (child != NONE) {
                continue;
            }
        } else if (dispatch_is_instance_leaf(child)) {
            child = dispatch_instance_leaf(child, ray, &walk);
            if (child != NONE) {
                // Nothing lies before it: it is never left out.
                stack_push(&n_stack, CHILD_OUT, 0u);
                continue;
            }
        } else {
            hit = leaf_trace(child, walk.ray, walk.leaf, hit);
            if (ray.light != NONE && hit.prim != NONE && dispatch_ends(hit)) {
                break;
            }
        }
        child = stack_pop(&n_stack, hit.t);
    }
    return hit;
}

// Walks the binary BVH: the nearest hit, or any hit that hides a light. Trees of instances are walked by the same
// loop, in their own frame, with the rest of the world waiting on the same stack.
// The stack is private and exactly as long as the scene's deepest walk needs; nothing bounds the number
// of steps, because a tree is finite and a cap would open holes where geometry is hard.

#import "scene/constants.wgsl"
#import "scene/door.wgsl"
#import "scene/ends.wgsl"
#import "scene/leaf.wgsl"
#import "scene/records.wgsl"
#import "trace/box.wgsl"
#import "trace/ray.wgsl"
#import "trace/walk.wgsl"

// Children still to visit.
var<private> stack: array<u32, STACK_SIZE>;

// The nearest hit before `ray.t_max`, or a miss. For a shadow ray: some opaque hit on the way, else the nearest.
fn trace(ray: Ray) -> Hit {
    var hit = ray_miss(ray.t_max);
    var child = load_frame_root();
    if (child == NONE) {
        return hit;
    }
    var walk = walk_begin(ray);
    var n_stack = 0u;
    loop {
        if ((child & CHILD_INNER) != 0u) {
            let node = load_node(child & CHILD_INDEX);
            let left = box_enter(node.left_lo, node.left_hi, walk.ray.origin, walk.inverse, hit.t);
            let right = box_enter(node.right_lo, node.right_hi, walk.ray.origin, walk.inverse, hit.t);
            let left_first = left <= right;
            if (min(left, right) < RAY_FAR) {
                if (max(left, right) < RAY_FAR) {
                    stack[n_stack] = select(node.left, node.right, left_first);
                    n_stack += 1u;
                }
                child = select(node.right, node.left, left_first);
                continue;
            }
        } else if (dispatch_is_door(child)) {
            child = dispatch_door(child, ray, &walk);
            if (child != NONE) {
                stack[n_stack] = CHILD_OUT;
                n_stack += 1u;
                continue;
            }
        } else {
            hit = leaf_trace(child, walk.ray, walk.leaf, hit);
            if (ray.light != NONE && hit.prim != NONE && dispatch_ends(hit)) {
                break;
            }
        }
        if (n_stack == 0u) { break; }
        n_stack -= 1u;
        child = stack[n_stack];
    }
    return hit;
}

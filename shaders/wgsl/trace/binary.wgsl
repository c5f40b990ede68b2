// A node of the binary tree: the reference layout.

#import "scene/constants.wgsl"
#import "scene/records.wgsl"
#import "trace/box.wgsl"
#import "trace/ray.wgsl"
#import "trace/stack.wgsl"

// The child of node `i` to visit next, or `NONE`; the other one, if the ray meets both, goes on the stack.
fn binary_visit(
    i: u32, origin: vec3f, inverse: vec3f, t_min: f32, t_max: f32, n_stack: ptr<function, u32>,
) -> u32 {
    let node = load_node(i);
    let left = box_enter(node.left_lo, node.left_hi, origin, inverse, t_min, t_max);
    let right = box_enter(node.right_lo, node.right_hi, origin, inverse, t_min, t_max);
    let far = max(left, right);
    if (min(left, right) >= RAY_FAR) {
        return NONE;
    }
    let left_first = left <= right;
    if (far < RAY_FAR) {
        stack_push(n_stack, select(node.left, node.right, left_first), bitcast<u32>(far));
    }
    return select(node.right, node.left, left_first);
}

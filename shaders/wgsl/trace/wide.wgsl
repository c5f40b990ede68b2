// A node of the wide tree: four boxes at once, in steps of the node's grid. Ylitie, Karras & Laine 2017,
// "Efficient Incoherent Ray Traversal on GPUs Through Compressed Wide BVHs", HPG, with four children.

#import "abi/wide_node.wgsl"
#import "scene/constants.wgsl"
#import "scene/records.wgsl"
#import "trace/stack.wgsl"

// What `wide_keys` says of a child that the ray does not meet; above the bits of every distance.
const WIDE_MISS: u32 = 0xffffffffu;

// Four bytes as numbers, child by child.
fn wide_bytes(word: u32) -> vec4f {
    return vec4f(unpack4xU8(word));
}

// For each child: the bits of the distance at which the ray enters its box, the lowest two replaced by the
// number of the child, so that sorting them sorts the children; `WIDE_MISS` if it is not there from `t_min` to `t_max`.
//
// The distance to a plane is steps * a + b, which cancels far from the node: each of its roundings, at
// most five, is at most 2^-24 (|b| + 256 |a|). The planes are moved apart by 8 of those, so that no box is
// smaller than it really is, whether products are fused or not. The far end grows as in `box_enter`.
fn wide_keys(node: WideNode, origin: vec3f, inverse: vec3f, t_min: f32, t_max: f32) -> vec4<u32> {
    let a = node.scale * inverse;
    let b = (node.origin - origin) * inverse;
    let slack = (abs(b) + abs(a) * 256.0) * 4.76837158203125e-7;
    let low = b - slack;
    let high = b + slack;
    let back = inverse < vec3f(0.0);
    let first = select(node.lo, node.hi, back);
    let last = select(node.hi, node.lo, back);
    let near_x = wide_bytes(first.x) * a.x + low.x;
    let near_y = wide_bytes(first.y) * a.y + low.y;
    let near_z = wide_bytes(first.z) * a.z + low.z;
    let far_x = wide_bytes(last.x) * a.x + high.x;
    let far_y = wide_bytes(last.y) * a.y + high.y;
    let far_z = wide_bytes(last.z) * a.z + high.z;
    let enter = max(max(near_x, near_y), max(near_z, vec4f(t_min)));
    let leave = min(min(far_x, far_y), min(far_z, vec4f(t_max))) * 1.00000095;
    // A box that is inside out can seem to be met from far away.
    let there = vec4<u32>(node.child0, node.child1, node.child2, node.child3) != vec4<u32>(NONE);
    // The sign too: -0 is 0.
    let keys = (bitcast<vec4<u32>>(enter) & vec4<u32>(0x7ffffffcu)) | vec4<u32>(0u, 1u, 2u, 3u);
    return select(vec4<u32>(WIDE_MISS), keys, (enter <= leave) & there);
}

// The child that `key` is of.
fn wide_child(node: WideNode, key: u32) -> u32 {
    let low = select(node.child0, node.child1, (key & 1u) != 0u);
    let high = select(node.child2, node.child3, (key & 1u) != 0u);
    return select(low, high, (key & 2u) != 0u);
}

// The nearest child of node `i`, or `NONE`; the others that the ray meets go on the stack, the farthest first.
fn wide_visit(
    i: u32, origin: vec3f, inverse: vec3f, t_min: f32, t_max: f32, n_stack: ptr<function, u32>,
) -> u32 {
    let node = load_wide_node(i);
    let keys = wide_keys(node, origin, inverse, t_min, t_max);
    let low = min(keys.xz, keys.yw);
    let high = max(keys.xz, keys.yw);
    let nearest = min(low.x, low.y);
    if (nearest == WIDE_MISS) {
        return NONE;
    }
    let farthest = max(high.x, high.y);
    let inner = max(low.x, low.y);
    let outer = min(high.x, high.y);
    let second = min(inner, outer);
    let third = max(inner, outer);
    if (farthest != WIDE_MISS) {
        stack_push(n_stack, wide_child(node, farthest), farthest & 0xfffffffcu);
    }
    if (third != WIDE_MISS) {
        stack_push(n_stack, wide_child(node, third), third & 0xfffffffcu);
    }
    if (second != WIDE_MISS) {
        stack_push(n_stack, wide_child(node, second), second & 0xfffffffcu);
    }
    return wide_child(node, nearest);
}

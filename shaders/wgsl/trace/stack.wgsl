// What a ray has still to visit. The stack is private and exactly as long as the scene's deepest walk needs.

#import "scene/constants.wgsl"

// References of children, each with the bits of a distance before which the ray does not enter it.
var<private> stack: array<vec2<u32>, STACK_SIZE>;

// Puts `child` on the stack, which holds `n_stack` before; `key` is the bits of that distance.
fn stack_push(n_stack: ptr<function, u32>, child: u32, key: u32) {
    stack[*n_stack] = vec2<u32>(child, key);
    *n_stack += 1u;
}

// Takes the last child off that a ray may enter before `t_max`, or `NONE` when there is none left. What was
// near enough when it was put there may have come to lie behind a hit.
fn stack_pop(n_stack: ptr<function, u32>, t_max: f32) -> u32 {
    var child = NONE;
    loop {
        if (child != NONE || *n_stack == 0u) { break; }
        *n_stack -= 1u;
        let top = stack[*n_stack];
        if (bitcast<f32>(top.y) <= t_max * 1.00000095) {
            child = top.x;
        }
    }
    return child;
}

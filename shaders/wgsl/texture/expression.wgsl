// Texture expressions: runs of operations in reverse Polish notation, see `TextureOp`. An image is an expression of
// one operation, because compilers for GPUs copy what is called: so its lookup is there once.

#import "abi/texture_op.wgsl"
#import "math/sincos.wgsl"
#import "pattern/fbm.wgsl"
#import "scene/constants.wgsl"
#import "scene/records.wgsl"
#import "texture/bilinear.wgsl"
#import "texture/texture_point.wgsl"
#import "texture/vertex_color.wgsl"

// The value of texture `i`, an expression or an image, at a point.
fn expression_fetch(i: u32, at: TexturePoint) -> vec4f {
    let expression = load_texture(i);
    let is_image = expression.format != TEXTURE_EXPRESSION;
    let count = select(expression.width, 1u, is_image);
    // The stack, its top first. No more than six values ever wait: the check of packs proves it.
    var a = vec4f(0.0);
    var b = vec4f(0.0);
    var c = vec4f(0.0);
    var d = vec4f(0.0);
    var e = vec4f(0.0);
    var f = vec4f(0.0);
    let first = expression.offset / 3u;
    var k = 0u;
    loop {
        if (k == count) { break; }
        var op = expression_image(i);
        if (!is_image) {
            op = load_texture_op(first + k);
        }
        k += 1u;
        switch (op.kind) {
            case TEXTURE_OP_CHANNEL: { a = vec4f(expression_lane(a, op.arg)); }
            case TEXTURE_OP_CLAMP: { a = min(max(a, vec4f(op.p.x)), vec4f(op.p.y)); }
            case TEXTURE_OP_TILT: { a = expression_tilt(a, op.p); }
            case TEXTURE_OP_MULTIPLY: {
                a = b * a;
                b = c; c = d; d = e; e = f;
            }
            case TEXTURE_OP_ADD: {
                a = b + a;
                b = c; c = d; d = e; e = f;
            }
            case TEXTURE_OP_MIX: {
                a = c * (vec4f(1.0) - a) + b * a;
                b = d; c = e; d = f;
            }
            case TEXTURE_OP_INSERT: {
                a = select(b, vec4f(a.x), vec4u(op.arg) == vec4u(0u, 1u, 2u, 3u));
                b = c; c = d; d = e; e = f;
            }
            default: {
                f = e; e = d; d = c; c = b; b = a;
                a = expression_leaf(op, at);
            }
        }
    }
    return a;
}

// The operation that looks up image `i` as it is.
fn expression_image(i: u32) -> TextureOp {
    return TextureOp(TEXTURE_OP_IMAGE, i, 0u, 0u, vec4f(1.0, 0.0, 0.0, 1.0), vec4f(0.0));
}

// An operation without operands.
fn expression_leaf(op: TextureOp, at: TexturePoint) -> vec4f {
    let place = (op.q.xy + op.p.xz * at.uv.x) + op.p.yw * at.uv.y;
    switch (op.kind) {
        case TEXTURE_OP_IMAGE: { return bilinear_fetch(op.arg, place); }
        case TEXTURE_OP_CHECKER: {
            return vec4f(expression_odd(floor(place.x) + floor(place.y) + floor(op.q.z * at.w)));
        }
        case TEXTURE_OP_BRICKS: { return vec4f(expression_bricks(place, op.q.zw)); }
        case TEXTURE_OP_GRADIENT: { return vec4f(clamp(place.x, 0.0, 1.0)); }
        case TEXTURE_OP_WAVE: { return vec4f(0.5 - 0.5 * sincos_2pi(place.x - floor(place.x)).y); }
        case TEXTURE_OP_NOISE: { return vec4f(fbm_value(vec3f(place, op.q.z * at.w), op.arg, 0x7e07u)); }
        case TEXTURE_OP_VERTEX_COLOR: { return vertex_color(at); }
        default: { return op.p; }
    }
}

// Channel `i` of a value.
fn expression_lane(v: vec4f, i: u32) -> f32 {
    return select(select(v.x, v.y, i == 1u), select(v.z, v.w, i == 3u), i >= 2u);
}

// A texel of a normal map, its x and y turned by the matrix `m`: both are encoded as 0 to 1.
fn expression_tilt(texel: vec4f, m: vec4f) -> vec4f {
    let tilt = texel.xy * 2.0 - vec2f(1.0);
    let turned = vec2f(m.x * tilt.x + m.y * tilt.y, m.z * tilt.x + m.w * tilt.y);
    return vec4f(turned * 0.5 + vec2f(0.5), texel.zw);
}

// 1 for odd whole numbers, 0 for even ones.
fn expression_odd(n: f32) -> f32 {
    return n - 2.0 * floor(0.5 * n);
}

// 1 inside of a brick, 0 in the mortar: nearer to an end than `joint.x`, to an edge than `joint.y`.
fn expression_bricks(place: vec2f, joint: vec2f) -> f32 {
    let row = floor(place.y);
    let x = place.x + 0.5 * expression_odd(row);
    let along = x - floor(x);
    let up = place.y - row;
    let inside = min(along, 1.0 - along) >= joint.x && min(up, 1.0 - up) >= joint.y;
    return select(0.0, 1.0, inside);
}

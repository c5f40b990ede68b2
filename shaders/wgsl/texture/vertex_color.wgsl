// Colours of vertices, mixed over triangles.

#import "scene/constants.wgsl"
#import "scene/records.wgsl"
#import "texture/texture_point.wgsl"

// Linear colour and alpha at a point; 1 where it is of no triangle.
fn vertex_color(at: TexturePoint) -> vec4f {
    if (at.prim == NONE) {
        return vec4f(1.0);
    }
    let c = load_vertex_colors(at.prim);
    let c0 = vertex_color_corner(c.high.x, c.low);
    let c1 = vertex_color_corner(c.high.y, c.low >> 10u);
    let c2 = vertex_color_corner(c.high.z, c.low >> 20u);
    return c0 * (1.0 - at.b.x - at.b.y) + c1 * at.b.x + c2 * at.b.y;
}

// The colour and alpha of a corner, see `VertexColors`.
fn vertex_color_corner(high: u32, low: u32) -> vec4f {
    let blue = ((high >> 22u) << 1u) | (low & 1u);
    let root = vec3f(f32(high & 2047u), f32((high >> 11u) & 2047u), f32(blue)) * 0.0004885198; // 1 / 2047
    return vec4f(root * root, f32((low >> 1u) & 511u) * 0.0019569471); // 1 / 511
}

// Where a texture is asked for its value.

#import "scene/constants.wgsl"

// A point of a surface, as textures see it.
struct TexturePoint {
    // Texture coordinates.
    uv: vec2f,
    // Third coordinate of textures that fill their object; 0 on all others.
    w: f32,
    // Index of the triangle, whose corners have colours; `NONE` on what is no triangle.
    prim: u32,
    // Barycentric weights of its second and its third corner.
    b: vec2f,
}

// A point with these texture coordinates, of no triangle.
fn texture_point(uv: vec2f) -> TexturePoint {
    return TexturePoint(uv, 0.0, NONE, vec2f(0.0));
}

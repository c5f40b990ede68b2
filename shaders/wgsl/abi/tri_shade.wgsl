// What shading needs of a triangle, 48 bytes, same index as its `Triangle`.
struct TriShade {
    // Shading normals of the three corners, octahedral, x and y as 16-bit signed normalised
    // integers (x in the low half); world frame, not necessarily on the geometric side.
    normals: vec3<u32>,
    // Index of the `Material`.
    material: u32,
    // Texture coordinates of the first corner; v points up.
    uv0: vec2<f32>,
    // Texture coordinates of the second corner.
    uv1: vec2<f32>,
    // Texture coordinates of the third corner.
    uv2: vec2<f32>,
    // Index of the `Light` this triangle belongs to, or `NONE`.
    light: u32,
    // Bits 0-30: index of the `Object`. Bit 31, `TRI_SMOOTH`: interpolate `normals`;
    // otherwise the triangle is flat.
    object: u32,
}

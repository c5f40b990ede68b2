// Four bytes a texel, red in the low byte, four texels a word.

#import "scene/bindings.wgsl"
#import "scene/records.wgsl"

// All four channels linear. `offset`: first word of the image; `i`: texel index.
fn rgba8_linear(offset: u32, i: u32) -> vec4f {
    return vec4f(rgba8_bytes(rgba8_texel(offset, i))) * 0.003921569; // 1 / 255, exact at 255
}

// Colour sRGB-encoded, decoded by the table in the heap; alpha linear.
fn rgba8_srgb(offset: u32, i: u32) -> vec4f {
    let c = rgba8_bytes(rgba8_texel(offset, i));
    return vec4f(rgba8_decode(c.x), rgba8_decode(c.y), rgba8_decode(c.z), f32(c.w) * 0.003921569);
}

// Alpha, which is linear in both.
fn rgba8_alpha(offset: u32, i: u32) -> f32 {
    return f32(rgba8_texel(offset, i) >> 24u) * 0.003921569;
}

// Texel `i` of the image whose first word is `offset`.
fn rgba8_texel(offset: u32, i: u32) -> u32 {
    return rgba8_lane(texel_word(offset + (i >> 2u)), i & 3u);
}

// Lane `lane` of a word.
fn rgba8_lane(word: vec4u, lane: u32) -> u32 {
    let low = select(word.x, word.y, lane == 1u);
    let high = select(word.z, word.w, lane == 3u);
    return select(low, high, lane >= 2u);
}

// Red, green, blue, alpha as stored.
fn rgba8_bytes(texel: u32) -> vec4u {
    return vec4u(texel & 0xffu, (texel >> 8u) & 0xffu, (texel >> 16u) & 0xffu, texel >> 24u);
}

// Linear value of the sRGB-encoded byte `c`.
fn rgba8_decode(c: u32) -> f32 {
    return bitcast<f32>(rgba8_lane(heap_word(load_frame_srgb_at() + (c >> 2u)), c & 3u));
}

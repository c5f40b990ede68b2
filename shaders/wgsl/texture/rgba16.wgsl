// Four half floats a texel, two texels a word; linear.

#import "math/half.wgsl"
#import "scene/bindings.wgsl"

// `offset`: first word of the image; `i`: texel index.
fn rgba16_linear(offset: u32, i: u32) -> vec4f {
    let texel = rgba16_texel(offset, i);
    return vec4f(half_decode(texel.x), half_decode(texel.x >> 16u), half_decode(texel.y), half_decode(texel.y >> 16u));
}

// Alpha alone.
fn rgba16_alpha(offset: u32, i: u32) -> f32 {
    return half_decode(rgba16_texel(offset, i).y >> 16u);
}

// Texel `i` of the image whose first word is `offset`, as stored.
fn rgba16_texel(offset: u32, i: u32) -> vec2u {
    let word = texel_word(offset + (i >> 1u));
    return select(word.xy, word.zw, (i & 1u) == 1u);
}

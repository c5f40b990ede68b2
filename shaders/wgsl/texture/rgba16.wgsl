// Four half floats a texel, two texels a word; linear.

#import "math/half.wgsl"
#import "scene/bindings.wgsl"

// `offset`: first word of the image; `i`: texel index.
fn rgba16_linear(offset: u32, i: u32) -> vec4f {
    let word = texel_word(offset + (i >> 1u));
    let texel = select(word.xy, word.zw, (i & 1u) == 1u);
    return vec4f(half_decode(texel.x), half_decode(texel.x >> 16u), half_decode(texel.y), half_decode(texel.y >> 16u));
}

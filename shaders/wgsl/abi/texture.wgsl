// An image, 32 bytes. Row 0 is the top of the image, v = 1; bilinear filtering, texel centres at half integers.
struct Texture {
    // Width in texels, >= 1.
    width: u32,
    // Height in texels, >= 1.
    height: u32,
    // `TextureFormat`.
    format: u32,
    // First 16-byte word of the texels; rows follow without gaps.
    offset: u32,
    // `Wrap` along u.
    wrap_u: u32,
    // `Wrap` along v.
    wrap_v: u32,
    _pad0: u32,
    _pad1: u32,
}

// Bilinear lookup of an image. Row 0 of the texels is the top of the image, v = 1; texel centres are at
// half integers.

#import "abi/texture.wgsl"
#import "scene/constants.wgsl"
#import "scene/records.wgsl"
#import "scene/texel.wgsl"

// The four texels around a point of an image, and how far it lies from the first to the last.
struct BilinearTexels {
    // Indices: top left, top right, bottom left, bottom right.
    at: vec4u,
    // To the right and down, 0 ..= 1.
    f: vec2f,
}

// Linear red, green, blue and alpha of texture `i` at `uv`.
fn bilinear_fetch(i: u32, uv: vec2f) -> vec4f {
    let image = load_texture(i);
    return bilinear_at(image, bilinear_place(image, uv));
}

// The alpha of `bilinear_fetch`, without what it costs to decode a colour.
fn bilinear_fetch_alpha(i: u32, uv: vec2f) -> f32 {
    let image = load_texture(i);
    let near = bilinear_texels(image, bilinear_place(image, uv));
    let a = texel_alpha(image, near.at.x) * (1.0 - near.f.x) + texel_alpha(image, near.at.y) * near.f.x;
    let b = texel_alpha(image, near.at.z) * (1.0 - near.f.x) + texel_alpha(image, near.at.w) * near.f.x;
    return a * (1.0 - near.f.y) + b * near.f.y;
}

// Linear red, green, blue and alpha of `image` at `place`, 0 ..= 1 from its top left corner.
fn bilinear_at(image: Texture, place: vec2f) -> vec4f {
    let near = bilinear_texels(image, place);
    let a = texel_decode(image, near.at.x) * (1.0 - near.f.x) + texel_decode(image, near.at.y) * near.f.x;
    let b = texel_decode(image, near.at.z) * (1.0 - near.f.x) + texel_decode(image, near.at.w) * near.f.x;
    return a * (1.0 - near.f.y) + b * near.f.y;
}

// Where `uv` lies in `image`, 0 ..= 1 from its top left corner.
fn bilinear_place(image: Texture, uv: vec2f) -> vec2f {
    return vec2f(bilinear_unit(uv.x, image.wrap_u), bilinear_unit(1.0 - uv.y, image.wrap_v));
}

// The texels of `image` around `place`, 0 ..= 1 from its top left corner.
fn bilinear_texels(image: Texture, place: vec2f) -> BilinearTexels {
    let x = place.x * f32(image.width) - 0.5;
    let y = place.y * f32(image.height) - 0.5;
    let x0 = floor(x);
    let y0 = floor(y);
    let left = bilinear_index(i32(x0), image.width, image.wrap_u);
    let right = bilinear_index(i32(x0) + 1, image.width, image.wrap_u);
    let top = bilinear_index(i32(y0), image.height, image.wrap_v) * image.width;
    let bottom = bilinear_index(i32(y0) + 1, image.height, image.wrap_v) * image.width;
    let at = vec4u(top + left, top + right, bottom + left, bottom + right);
    return BilinearTexels(at, vec2f(x - x0, y - y0));
}

// Coordinate `u` brought into 0 ..= 1. The subtractions are exact, so large coordinates lose no more
// than they have lost already.
fn bilinear_unit(u: f32, wrap: u32) -> f32 {
    if (wrap == WRAP_REPEAT) {
        return u - floor(u);
    }
    if (wrap == WRAP_MIRROR) {
        let m = u - 2.0 * floor(0.5 * u);
        return select(m, 2.0 - m, m > 1.0);
    }
    return clamp(u, 0.0, 1.0);
}

// Texel index of `i` in -1 ..= n: the neighbour across the edge. A mirrored edge repeats its texel, as a
// clamped one does.
fn bilinear_index(i: i32, n: u32, wrap: u32) -> u32 {
    let last = i32(n) - 1;
    if (wrap == WRAP_REPEAT) {
        if (i < 0) {
            return u32(last);
        }
        return select(u32(i), 0u, i > last);
    }
    return u32(clamp(i, 0, last));
}

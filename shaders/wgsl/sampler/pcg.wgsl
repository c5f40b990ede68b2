// Independent uniform numbers: a hash of where they are used. Any module with `SampleKey`,
// `sample_1d` and `sample_2d` can take this one's place.
// Jarzynski & Olano 2020, "Hash Functions for GPU Rendering", JCGT 9(3): pcg4d is a bijection on
// 128 bits, so two different (pixel, sample, dimension, seed) never share their number stream.

// Which random numbers: everything that they depend on besides their purpose.
struct SampleKey {
    // Image column in bits 0-15, image row in bits 16-31.
    pixel: u32,
    // Sample index in the pixel.
    sample: u32,
    // Scattering events before the use, 0 for the camera and the first vertex.
    bounce: u32,
    // Seed of the image.
    seed: u32,
}

// What the numbers are for. Every use has its own, so that switching one use off never shifts the
// numbers of another. Fewer than 16.
const PURPOSE_PIXEL: u32 = 0u;
const PURPOSE_LENS: u32 = 1u;
const PURPOSE_LIGHT_CHOICE: u32 = 2u;
const PURPOSE_LIGHT_POINT: u32 = 3u;
const PURPOSE_LOBE: u32 = 4u;
const PURPOSE_DIRECTION: u32 = 5u;
const PURPOSE_RADIUS: u32 = 6u;
const PURPOSE_ROULETTE: u32 = 7u;

// The key of `pixel` (image coordinates below 65536), first vertex.
fn sample_key(pixel: vec2u, sample: u32, seed: u32) -> SampleKey {
    return SampleKey(pixel.x | (pixel.y << 16u), sample, 0u, seed);
}

// One number in [0, 1 - 2^-24].
fn sample_1d(key: SampleKey, purpose: u32) -> f32 {
    return f32(pcg_words(key, purpose).x >> 8u) * 5.9604645e-8; // 2^-24
}

// Two numbers in [0, 1 - 2^-24].
fn sample_2d(key: SampleKey, purpose: u32) -> vec2f {
    let v = pcg_words(key, purpose);
    return vec2f(f32(v.x >> 8u), f32(v.y >> 8u)) * 5.9604645e-8; // 2^-24
}

fn pcg_words(key: SampleKey, purpose: u32) -> vec4u {
    var v = vec4u(key.pixel, key.sample, key.bounce * 16u + purpose, key.seed) * 1664525u + 1013904223u;
    v.x += v.y * v.w;
    v.y += v.z * v.x;
    v.z += v.x * v.y;
    v.w += v.y * v.z;
    v ^= v >> vec4u(16u);
    v.x += v.y * v.w;
    v.y += v.z * v.x;
    v.z += v.x * v.y;
    v.w += v.y * v.z;
    return v;
}

// Independent uniform numbers: a hash of where they are used.
// Jarzynski & Olano 2020, "Hash Functions for GPU Rendering", JCGT 9(3): pcg4d is a bijection on
// 128 bits, so two different (pixel, sample, dimension, seed) never share their number stream.

#import "sampler/key.wgsl"

// One number in [0, 1 - 2^-24].
fn pcg_1d(key: SampleKey, purpose: u32) -> f32 {
    return f32(pcg_words(key, purpose).x >> 8u) * 5.9604645e-8; // 2^-24
}

// Two numbers in [0, 1 - 2^-24].
fn pcg_2d(key: SampleKey, purpose: u32) -> vec2f {
    let v = pcg_words(key, purpose);
    return vec2f(f32(v.x >> 8u), f32(v.y >> 8u)) * 5.9604645e-8; // 2^-24
}

// Two numbers in [0, 1 - 2^-24] for a point on a light.
fn pcg_light(key: SampleKey) -> vec2f {
    return pcg_2d(key, PURPOSE_LIGHT_POINT);
}

// One number in [0, 1 - 2^-24] of a series of its own for each `id`.
fn pcg_of(key: SampleKey, purpose: u32, id: u32) -> f32 {
    let v = pcg_hash(pcg_words(key, purpose) ^ vec4u(id, 0u, 0u, 0u));
    return f32(v.x >> 8u) * 5.9604645e-8; // 2^-24
}

fn pcg_words(key: SampleKey, purpose: u32) -> vec4u {
    return pcg_hash(vec4u(key.pixel, key.sample, sample_dimension(key, purpose), key.seed));
}

// pcg4d.
fn pcg_hash(words: vec4u) -> vec4u {
    var v = words * 1664525u + 1013904223u;
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

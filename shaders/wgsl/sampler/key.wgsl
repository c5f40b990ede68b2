// Which random number is meant. A number depends on nothing but its key and its purpose, so that any
// sample of any pixel can be computed anywhere, alone and in any order.

// Everything that a number depends on besides its purpose.
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
// numbers of another. All below `PURPOSE_STRIDE`.
const PURPOSE_PIXEL: u32 = 0u;
const PURPOSE_LENS: u32 = 1u;
const PURPOSE_LIGHT_CHOICE: u32 = 2u;
const PURPOSE_LIGHT_POINT: u32 = 3u;
const PURPOSE_LOBE: u32 = 4u;
const PURPOSE_DIRECTION: u32 = 5u;
const PURPOSE_RADIUS: u32 = 6u;
const PURPOSE_ROULETTE: u32 = 7u;
const PURPOSE_DISTANCE: u32 = 8u;
const PURPOSE_TIME: u32 = 9u;
const PURPOSE_COVERAGE: u32 = 10u;
const PURPOSE_SHADOW_COVERAGE: u32 = 11u;
const PURPOSE_MIX: u32 = 12u;
const PURPOSE_PROJECTION: u32 = 13u;
const PURPOSE_SLAB: u32 = 16u;
const PURPOSE_SLAB_TURN: u32 = 17u;
const PURPOSE_SLAB_END: u32 = 18u;

// Purposes that a bounce has room for.
const PURPOSE_STRIDE: u32 = 32u;

// The key of `pixel` (image coordinates below 65536), first vertex.
fn sample_key(pixel: vec2u, sample: u32, seed: u32) -> SampleKey {
    return SampleKey(pixel.x | (pixel.y << 16u), sample, 0u, seed);
}

// Which dimension of the sample `purpose` is.
fn sample_dimension(key: SampleKey, purpose: u32) -> u32 {
    return key.bounce * PURPOSE_STRIDE + purpose;
}

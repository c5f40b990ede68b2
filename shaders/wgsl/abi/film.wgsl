// One pixel of a tile after one dispatch, 32 bytes.
struct FilmPixel {
    // Sum of radiance over the samples of this dispatch; bad samples add 0.
    sum: vec3<f32>,
    // Rays traced: camera, bounce and shadow.
    rays: u32,
    // Samples whose radiance was not finite.
    bad: u32,
    // Index of the first bad sample; meaningful when `bad > 0`.
    first_bad: u32,
    // Longest path of this dispatch in segments.
    depth: u32,
    // Crossings at which the nest of media was wrong: bits 0-15 count those that found it full,
    // bits 16-31 those that left a thing which the path had never entered.
    strays: u32,
}

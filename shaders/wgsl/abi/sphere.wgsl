// A sphere, 32 bytes, in leaf order. Normalised world frame, as when the shutter opens.
struct Sphere {
    // Centre.
    center: vec3<f32>,
    // Radius, > 0.
    radius: f32,
    // Index of the `Material`.
    material: u32,
    // Index of the `Light`, or `NONE`.
    light: u32,
    // Bits 0-30: index of the `Object`. Bit 31: `MOVES`.
    object: u32,
    _pad0: u32,
}

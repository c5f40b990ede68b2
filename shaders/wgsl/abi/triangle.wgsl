// A triangle's corners, 48 bytes, in leaf order. Normalised world frame, as when the shutter
// opens; the geometric normal is `cross(v1 - v0, v2 - v0)`.
struct Triangle {
    // First corner.
    v0: vec3<f32>,
    // Bits 0-30: id of the first corner after welding by position: equal bits, equal id. Bit 31, `MOVES`, is
    // the same in all three.
    id0: u32,
    // Second corner.
    v1: vec3<f32>,
    // Welded id of the second corner.
    id1: u32,
    // Third corner.
    v2: vec3<f32>,
    // Welded id of the third corner.
    id2: u32,
}

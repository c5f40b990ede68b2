// An emitter in the selection table, 64 bytes. Normalised world frame.
struct Light {
    // Centre (sphere), corner (rectangle), first vertex (triangle).
    origin: vec3<f32>,
    // `LightKind`.
    kind: u32,
    // First edge; x is the radius for a sphere.
    edge1: vec3<f32>,
    // Area in square normalised units; unused for a sphere.
    area: f32,
    // Second edge.
    edge2: vec3<f32>,
    // Index of the sphere, of the triangle, or of the rectangle's first triangle.
    primitive: u32,
    // Probability of choosing this light, > 0; all of them sum to 1.
    pmf: f32,
    // Sum of `pmf` up to and including this light; the last is exactly 1.
    cdf: f32,
    // Index of the `Material` that emits.
    material: u32,
    _pad0: u32,
}

// An emitter in the selection table, 64 bytes. Normalised world frame.
struct Light {
    // Centre (sphere), corner (rectangle), first vertex (triangle); unused for the sky, as all of its geometry.
    origin: vec3<f32>,
    // `LightKind`.
    kind: u32,
    // First edge; for a sphere x is the radius, y the cosine of the angle of its tint.
    edge1: vec3<f32>,
    // Area in square normalised units; unused for a sphere.
    area: f32,
    // Second edge; for a sphere the unit vector towards which it is tinted.
    edge2: vec3<f32>,
    // Index of the sphere, of the triangle, or of the rectangle's first triangle; 0 for the sky.
    primitive: u32,
    // Probability of choosing this light, > 0; all of them sum to 1.
    pmf: f32,
    // Sum of `pmf` up to and including this light; the last is exactly 1.
    cdf: f32,
    // Index of the `Material` that emits; 0 for the sky.
    material: u32,
    // Turns from the root of the tree of lights to this one, the first in bit 0; 0 without a tree.
    trail: u32,
}

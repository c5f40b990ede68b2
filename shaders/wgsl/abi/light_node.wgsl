// Some lights, 48 bytes. Normalised world frame.
struct LightNode {
    // Middle of the box around the lights.
    center: vec3<f32>,
    // Square of half its diagonal, > 0.
    radius2: f32,
    // Axis of the cone of directions that the lights face, unit.
    axis: vec3<f32>,
    // Power of the lights, in any unit that is the same for all nodes.
    power: f32,
    // Cosine of the largest angle between `axis` and a light's normal; -1 for lights that face everywhere.
    cos_spread: f32,
    // Its sine.
    sin_spread: f32,
    // A leaf: bit 31, and the index of its `Light`. Otherwise the index of the second child; the first
    // is the next node.
    child: u32,
    _pad0: u32,
}

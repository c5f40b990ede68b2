// A thing in the world, 64 bytes: its own frame, its motion, its key. The point `p` of the
// normalised world frame is (row_x . p + offset_x, ...) in the object, in metres, unscaled:
// patterns turn and move with the thing, but do not grow with it.
struct Object {
    // First row of the rotation, times metres per normalised unit.
    row_x: vec3<f32>,
    // x of the origin of the world in the object, metres.
    offset_x: f32,
    // Second row.
    row_y: vec3<f32>,
    // y of the origin of the world.
    offset_y: f32,
    // Third row.
    row_z: vec3<f32>,
    // z of the origin of the world.
    offset_z: f32,
    // How far it moves while the shutter is open, normalised world frame; the geometry of the
    // pack is where it is when the shutter opens.
    motion: vec3<f32>,
    // A hash of its name: what differs from one petal to the next depends on it alone.
    key: u32,
}

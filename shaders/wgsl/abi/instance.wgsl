// A mesh in the world, 112 bytes. Its triangles have a frame of their own; the point p of the
// normalised world frame, when the shutter opens, is (row_x . (p - center), ...) there, and the point
// q of that frame is center + col_x q.x + col_y q.y + col_z q.z in the world. Any affine map that
// has an inverse: a mirrored one keeps the front of triangles outside.
struct Instance {
    // First row of the inverse.
    row_x: vec3<f32>,
    // Root of the mesh's tree: a `ChildRef` word, an inner node or triangles.
    root: u32,
    // Second row of the inverse.
    row_y: vec3<f32>,
    // Index of the `Material` that all of it has, or `NONE`: its triangles have their own.
    material: u32,
    // Third row of the inverse.
    row_z: vec3<f32>,
    // Bits 0-30: index of the `Object`. Bit 31, `MOVES`: it moves while the shutter is open.
    object: u32,
    // Where the origin of the mesh's frame is, normalised world frame.
    center: vec3<f32>,
    // Rays that leave its surface start 2^-20 of this off it: the largest number, normalised world
    // frame, that goes into a point of the surface or takes a ray to the mesh's frame and back.
    reach: f32,
    // First column of the map from the mesh's frame.
    col_x: vec3<f32>,
    _pad0: u32,
    // Second column of the map.
    col_y: vec3<f32>,
    _pad1: u32,
    // Third column of the map.
    col_z: vec3<f32>,
    _pad2: u32,
}

// Inner node of the binary BVH, 64 bytes: the boxes of both children and where they are.
// Normalised world frame, or the frame of a mesh, see `Instance`.
struct Node {
    // Lower corner of the left child's box.
    left_lo: vec3<f32>,
    // `ChildRef` word of the left child.
    left: u32,
    // Upper corner of the left child's box.
    left_hi: vec3<f32>,
    // `ChildRef` word of the right child.
    right: u32,
    // Lower corner of the right child's box.
    right_lo: vec3<f32>,
    _pad0: u32,
    // Upper corner of the right child's box.
    right_hi: vec3<f32>,
    _pad1: u32,
}

// Inner node of the wide BVH, 64 bytes: up to four children with boxes in steps of a grid of the node's own.
// Normalised world frame, or the frame of a mesh, see `Instance`. Child k is at byte k of the words of `lo` and
// `hi`, the lowest byte is 0.
struct WideNode {
    // Lower corner of the grid.
    origin: vec3<f32>,
    // `ChildRef` word of the first child.
    child0: u32,
    // Length of a step along each axis; at most 16 significant bits.
    scale: vec3<f32>,
    // `ChildRef` word of the second child.
    child1: u32,
    // Lower ends of the boxes along x, y and z, a byte a child; 255 for one that is not there.
    lo: vec3<u32>,
    // `ChildRef` word of the third child, or `NONE`.
    child2: u32,
    // Upper ends of the boxes along x, y and z, a byte a child; 0 for one that is not there.
    hi: vec3<u32>,
    // `ChildRef` word of the fourth child, or `NONE`.
    child3: u32,
}

// Where a walk through the trees is: the ray in the frame of the tree, and what is worked out once for it.

#import "scene/leaf.wgsl"
#import "trace/box.wgsl"
#import "trace/ray.wgsl"

struct Walk {
    ray: Ray,
    // As `box_inverse`.
    inverse: vec3f,
    leaf: Leaf,
}

// A walk of `ray` that begins at a root.
fn walk_begin(ray: Ray) -> Walk {
    return Walk(ray, box_inverse(ray.dir), leaf_prepare(ray));
}

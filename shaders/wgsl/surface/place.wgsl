// Where a point is in its own object, and which object that is.

#import "scene/records.wgsl"

// A point of an object.
struct Place {
    // Metres, the object's frame, unscaled.
    q: vec3f,
    // The object's key.
    key: u32,
}

// Point `p` of the normalised world frame in object `i`.
fn place_at(i: u32, p: vec3f) -> Place {
    let o = load_object(i);
    let turned = vec3f(dot(o.row_x, p), dot(o.row_y, p), dot(o.row_z, p));
    return Place(turned + vec3f(o.offset_x, o.offset_y, o.offset_z), o.key);
}

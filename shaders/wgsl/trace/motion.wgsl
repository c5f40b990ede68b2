// Things that move along straight lines while the shutter is open. The geometry is where it is when the
// shutter opens. A thing that has moved by d meets a ray exactly as it met the ray moved by -d before:
// one sum a ray, the same for all triangles of the thing, so that its seams stay closed and its normals
// keep every bit.

#import "scene/records.wgsl"

// How far object `i` has come at `time`: 0 where the shutter opens, 1 where it closes. Normalised world frame.
fn motion_shift(i: u32, time: f32) -> vec3f {
    return load_object_motion(i) * time;
}

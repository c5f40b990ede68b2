// Things that turn while the shutter is open, or whose way is not one straight line: pieces, one after the other. The
// geometry is where it is when the shutter opens, and a ray is taken there instead: back by the way, then turned back
// about the pivot. All triangles of a thing meet the same ray, so that its seams stay closed.
// A turn about an axis is a unit quaternion, and v + 2 w (q x v) + 2 q x (q x v) turns v (Shoemake 1985, "Animating
// Rotation with Quaternion Curves"). Between keys the angle grows evenly, which is slerp without its division.

#import "math/sincos.wgsl"
#import "math/vector.wgsl"
#import "scene/records.wgsl"
#import "surface/surface.wgsl"
#import "trace/motion.wgsl"

// Where a thing is at some time.
struct Pose {
    // How far it has come since the shutter opened. Normalised world frame.
    shift: vec3f,
    // About which point it was turned before.
    pivot: vec3f,
    // And how: a unit quaternion, its real part last.
    turn: vec4f,
}

// Object `i` at `time`: 0 where the shutter opens, 1 where it closes.
fn pose_at(i: u32, time: f32) -> Pose {
    let path = load_object_path(i);
    if (path == 0u) {
        return Pose(motion_shift(i, time), vec3f(0.0), vec4f(0.0, 0.0, 0.0, 1.0));
    }
    // The last piece of a way ends at 1.
    var k = path - 1u;
    loop {
        if (time <= load_motion_piece_end(k)) { break; }
        k += 1u;
    }
    let piece = load_motion_piece(k);
    let u = (time - piece.start) / (piece.end - piece.start);
    let half_turns = 0.5 * piece.turns * u;
    let sc = sincos_2pi(half_turns - floor(half_turns));
    let turn = pose_product(vec4f(piece.axis * sc.x, sc.y), piece.turn);
    return Pose(piece.shift + piece.travel * u, load_object_pivot(i), turn / sqrt(dot(turn, turn)));
}

// The turn `b`, then the turn `a`.
fn pose_product(a: vec4f, b: vec4f) -> vec4f {
    let v = vector_cross(a.xyz, b.xyz) + b.xyz * a.w + a.xyz * b.w;
    return vec4f(v, a.w * b.w - dot(a.xyz, b.xyz));
}

// Vector `v`, turned by the unit quaternion `q`.
fn pose_turned(q: vec4f, v: vec3f) -> vec3f {
    let t = vector_cross(q.xyz, v) * 2.0;
    return vector_cross(q.xyz, t) + t * q.w + v;
}

// How far object `i` has come at `time`, if it does not turn.
fn pose_shift(i: u32, time: f32) -> vec3f {
    return pose_at(i, time).shift;
}

// Point `p` of the world at `time`, where it was on object `i` when the shutter opened.
fn pose_origin(i: u32, p: vec3f, time: f32) -> vec3f {
    if (load_object_path(i) == 0u) {
        return p - motion_shift(i, time);
    }
    let pose = pose_at(i, time);
    return pose_turned(pose_back(pose.turn), p - pose.pivot - pose.shift) + pose.pivot;
}

// The turn that undoes `q`.
fn pose_back(q: vec4f) -> vec4f {
    return vec4f(-q.xyz, q.w);
}

// Direction `v` of the world at `time`, as it was on object `i` when the shutter opened.
fn pose_dir(i: u32, v: vec3f, time: f32) -> vec3f {
    if (load_object_path(i) == 0u) {
        return v;
    }
    return pose_turned(pose_back(pose_at(i, time).turn), v);
}

// Direction `v` on object `i` when the shutter opened, in the world at `time`.
fn pose_turn(i: u32, v: vec3f, time: f32) -> vec3f {
    if (load_object_path(i) == 0u) {
        return v;
    }
    return pose_turned(pose_at(i, time).turn, v);
}

// Takes the surface `s` of its object to where that is at `time`.
fn pose_carry(s: ptr<function, Surface>, time: f32) {
    let i = (*s).object;
    if (load_object_path(i) == 0u) {
        surface_carry(s, motion_shift(i, time));
        return;
    }
    let pose = pose_at(i, time);
    let v = (*s).p - pose.pivot;
    (*s).p = pose.pivot;
    surface_carry(s, pose.shift + pose_turned(pose.turn, v));
    // The way there and back rounds more often than a sum, and what it rounds is as large as this.
    let reach = max(vector_max(abs(pose.pivot)), vector_max(abs(v)));
    (*s).ray_offset = 2.0 * max((*s).ray_offset, 9.5367432e-7 * reach); // 16 * 2^-24
    (*s).ng = pose_turned(pose.turn, (*s).ng);
    (*s).horizon = pose_turned(pose.turn, (*s).horizon);
    (*s).ns = pose_turned(pose.turn, (*s).ns);
    (*s).bulge = pose_turned(pose.turn, (*s).bulge);
}

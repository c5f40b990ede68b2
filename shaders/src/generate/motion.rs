//! `scene/motion.wgsl`: when a path sees the scene, and where things and the camera are then. In a scene where nothing
//! moves the functions are there, and do nothing.

use super::wgsl::imports;
use crate::FeatureSet;
use std::fmt::Write as _;

/// A function of the module: what it does, its signature, and its bodies.
struct Function {
    comment: &'static str,
    signature: &'static str,
    /// Where nothing moves.
    still: &'static str,
    /// Where things move on straight lines.
    straight: &'static str,
    /// Where things turn, or have ways of several pieces.
    keyed: &'static str,
}

const TRIANGLE: Function = Function {
    comment: "How far triangle `i` has come at `time`, if it does not turn.",
    signature: "triangle_shift(i: u32, time: f32) -> vec3f",
    still: "    return vec3f(0.0);\n",
    straight: "    if ((load_triangle_id0(i) & MOVES) == 0u) {\n        return vec3f(0.0);\n    }\n    \
               return motion_shift(load_tri_shade_object(i) & ~TRI_SMOOTH, time);\n",
    keyed: "    if ((load_triangle_id0(i) & MOVES) == 0u) {\n        return vec3f(0.0);\n    }\n    \
            return pose_shift(load_tri_shade_object(i) & ~TRI_SMOOTH, time);\n",
};

const SPHERE: Function = Function {
    comment: "How far sphere `i` has come at `time`, if it does not turn.",
    signature: "sphere_shift(i: u32, time: f32) -> vec3f",
    still: "    return vec3f(0.0);\n",
    straight: "    let object = load_sphere_object(i);\n    \
               if ((object & MOVES) == 0u) {\n        return vec3f(0.0);\n    }\n    \
               return motion_shift(object & ~MOVES, time);\n",
    keyed: "    let object = load_sphere_object(i);\n    \
            if ((object & MOVES) == 0u) {\n        return vec3f(0.0);\n    }\n    \
            return pose_shift(object & ~MOVES, time);\n",
};

const TRIANGLE_ORIGIN: Function = Function {
    comment: "Where a ray from `origin` at `time` starts for triangle `i`, one of whose ids is `id`, if the\n\
              // triangle is thought to stand still.",
    signature: "triangle_origin(i: u32, id: u32, origin: vec3f, time: f32) -> vec3f",
    still: "    return origin;\n",
    straight: "    if ((id & MOVES) == 0u) {\n        return origin;\n    }\n    \
               return origin - motion_shift(load_tri_shade_object(i) & ~TRI_SMOOTH, time);\n",
    keyed: "    if ((id & MOVES) == 0u) {\n        return origin;\n    }\n    \
            return pose_origin(load_tri_shade_object(i) & ~TRI_SMOOTH, origin, time);\n",
};

const THING_ORIGIN: Function = Function {
    comment: "As `dispatch_triangle_origin`, for a sphere or an instance with this word `object`.",
    signature: "thing_origin(object: u32, origin: vec3f, time: f32) -> vec3f",
    still: "    return origin;\n",
    straight: "    if ((object & MOVES) == 0u) {\n        return origin;\n    }\n    \
               return origin - motion_shift(object & ~MOVES, time);\n",
    keyed: "    if ((object & MOVES) == 0u) {\n        return origin;\n    }\n    \
            return pose_origin(object & ~MOVES, origin, time);\n",
};

const TRIANGLE_DIR: Function = Function {
    comment: "Where a ray along `dir` at `time` leads for triangle `i`, likewise.",
    signature: "triangle_dir(i: u32, dir: vec3f, time: f32) -> vec3f",
    still: "    return dir;\n",
    straight: "    return dir;\n",
    keyed: "    if ((load_triangle_id0(i) & MOVES) == 0u) {\n        return dir;\n    }\n    \
            return pose_dir(load_tri_shade_object(i) & ~TRI_SMOOTH, dir, time);\n",
};

const THING_DIR: Function = Function {
    comment: "As `dispatch_triangle_dir`, for a thing with this word `object`.",
    signature: "thing_dir(object: u32, dir: vec3f, time: f32) -> vec3f",
    still: "    return dir;\n",
    straight: "    return dir;\n",
    keyed: "    if ((object & MOVES) == 0u) {\n        return dir;\n    }\n    \
            return pose_dir(object & ~MOVES, dir, time);\n",
};

const THING_CARRY: Function = Function {
    comment: "Takes the surface `s` of a thing with this word `object` to where it is at `time`.",
    signature: "thing_carry(s: ptr<function, Surface>, object: u32, time: f32)",
    still: "",
    straight: "    if ((object & MOVES) != 0u) {\n        \
               surface_carry(s, motion_shift((*s).object, time));\n    }\n",
    keyed: "    if ((object & MOVES) != 0u) {\n        pose_carry(s, time);\n    }\n",
};

const TURN: Function = Function {
    comment: "Direction `v` on object `i` when the shutter opened, in the world at `time`.",
    signature: "turn(i: u32, v: vec3f, time: f32) -> vec3f",
    still: "    return v;\n",
    straight: "    return v;\n",
    keyed: "    if (load_frame_path_at() == NONE) {\n        return v;\n    }\n    return pose_turn(i, v, time);\n",
};

const TURN_BACK: Function = Function {
    comment: "Direction `v` of the world at `time`, as it was on object `i` when the shutter opened.",
    signature: "turn_back(i: u32, v: vec3f, time: f32) -> vec3f",
    still: "    return v;\n",
    straight: "    return v;\n",
    keyed: "    if (load_frame_path_at() == NONE) {\n        return v;\n    }\n    return pose_dir(i, v, time);\n",
};

const TURN_OF: Function = Function {
    comment: "As `dispatch_turn`, at the time of the path of `key`, which is some vertex of it.",
    signature: "turn_of(i: u32, v: vec3f, key: SampleKey) -> vec3f",
    still: "    return v;\n",
    straight: "    return v;\n",
    keyed: "    if (load_frame_path_at() == NONE) {\n        return v;\n    }\n    \
            var first = key;\n    first.bounce = 0u;\n    return pose_turn(i, v, dispatch_time(first));\n",
};

const FUNCTIONS: [Function; 10] = [
    TRIANGLE,
    SPHERE,
    TRIANGLE_ORIGIN,
    THING_ORIGIN,
    TRIANGLE_DIR,
    THING_DIR,
    THING_CARRY,
    TURN,
    TURN_BACK,
    TURN_OF,
];

/// The module for this scene.
pub(crate) fn text(features: &FeatureSet) -> String {
    let mut text =
        String::from("// Generated: whether anything moves while the shutter is open.\n\n");
    text += &imports([
        "sampler/key.wgsl",
        "scene/sampler.wgsl",
        "scene/constants.wgsl",
        "scene/records.wgsl",
        "surface/surface.wgsl",
        "trace/motion.wgsl",
    ]);
    if features.keys {
        text += &imports(["trace/pose.wgsl"]);
    }
    text += &time(features);
    for Function { comment, signature, still, straight, keyed } in FUNCTIONS {
        let body = match (features.motion, features.keys) {
            (false, _) => still,
            (true, false) => straight,
            (true, true) => keyed,
        };
        let _ = write!(text, "\n// {comment}\nfn dispatch_{signature} {{\n{body}}}\n");
    }
    text
}

/// When a path sees the scene.
fn time(features: &FeatureSet) -> String {
    let still = match (features.motion, features.keys || features.camera_keys) {
        (false, _) => "",
        (true, false) => "    if (load_frame_object_at() == NONE) {\n        return 0.0;\n    }\n",
        (true, true) => {
            "    if (load_frame_object_at() == NONE && load_frame_camera_key_at() == NONE) {\n        \
             return 0.0;\n    }\n"
        }
    };
    let time = if features.motion { "sample_1d(key, PURPOSE_TIME)" } else { "0.0" };
    format!(
        "\n// When the path of `key` sees the scene: 0 where the shutter opens, 1 where it closes. The full\n\
         // kernel asks whether there are objects: without, nothing moves.\n\
         fn dispatch_time(key: SampleKey) -> f32 {{\n{still}    return {time};\n}}\n"
    )
}

/// `scene/eye.wgsl`: where the camera is. A module of its own, so that the cameras of the others need no motion.
pub(crate) fn eye(features: &FeatureSet) -> String {
    let mut text = String::from("// Generated: whether the camera of this scene moves.\n\n");
    text += &imports(["abi/camera.wgsl", "sampler/key.wgsl", "scene/records.wgsl"]);
    let moved = if features.camera_keys {
        text += &imports(["camera/keys.wgsl", "scene/constants.wgsl", "scene/motion.wgsl"]);
        "    if (load_frame_camera_key_at() != NONE) {\n        return keys_camera(dispatch_time(key));\n    }\n"
    } else {
        ""
    };
    let _ = write!(
        text,
        "\n// The camera as the path of `key` sees it.\n\
         fn dispatch_eye(key: SampleKey) -> Camera {{\n{moved}    return load_camera();\n}}\n"
    );
    text
}

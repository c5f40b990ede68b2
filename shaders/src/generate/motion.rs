//! `scene/motion.wgsl`: when a path sees the scene, and where things are then. In a scene where nothing
//! moves the functions are there, and do nothing.

use super::wgsl::imports;
use crate::FeatureSet;
use std::fmt::Write as _;

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
    let functions = [
        (
            "When the path of `key` sees the scene: 0 where the shutter opens, 1 where it closes. The \
             full\n// kernel asks whether there are objects: without, nothing moves.",
            "time(key: SampleKey) -> f32",
            "    if (load_frame_object_at() == NONE) {\n        return 0.0;\n    }\n    \
             return sample_1d(key, PURPOSE_TIME);\n",
            "    return 0.0;\n",
        ),
        (
            "How far triangle `i` has come at `time`.",
            "triangle_shift(i: u32, time: f32) -> vec3f",
            "    if ((load_triangle_id0(i) & MOVES) == 0u) {\n        return vec3f(0.0);\n    }\n    \
             return motion_shift(load_tri_shade_object(i) & ~TRI_SMOOTH, time);\n",
            "    return vec3f(0.0);\n",
        ),
        (
            "How far sphere `i` has come at `time`.",
            "sphere_shift(i: u32, time: f32) -> vec3f",
            "    let object = load_sphere_object(i);\n    \
             if ((object & MOVES) == 0u) {\n        return vec3f(0.0);\n    }\n    \
             return motion_shift(object & ~MOVES, time);\n",
            "    return vec3f(0.0);\n",
        ),
        (
            "Where a ray from `origin` at `time` starts for triangle `i`, one of whose ids is `id`, if the\n\
             // triangle is thought to stand still.",
            "triangle_origin(i: u32, id: u32, origin: vec3f, time: f32) -> vec3f",
            "    if ((id & MOVES) == 0u) {\n        return origin;\n    }\n    \
             return origin - motion_shift(load_tri_shade_object(i) & ~TRI_SMOOTH, time);\n",
            "    return origin;\n",
        ),
        (
            "As `dispatch_triangle_origin`, for a sphere or an instance with this word `object`.",
            "thing_origin(object: u32, origin: vec3f, time: f32) -> vec3f",
            "    if ((object & MOVES) == 0u) {\n        return origin;\n    }\n    \
             return origin - motion_shift(object & ~MOVES, time);\n",
            "    return origin;\n",
        ),
        (
            "Takes the surface `s` of triangle `i` to where the triangle is at `time`.",
            "triangle_carry(s: ptr<function, Surface>, i: u32, time: f32)",
            "    if ((load_triangle_id0(i) & MOVES) != 0u) {\n        \
             surface_carry(s, motion_shift((*s).object, time));\n    }\n",
            "",
        ),
        (
            "Takes the surface `s` of a sphere or an instance with this word `object` to where it is at `time`.",
            "thing_carry(s: ptr<function, Surface>, object: u32, time: f32)",
            "    if ((object & MOVES) != 0u) {\n        \
             surface_carry(s, motion_shift((*s).object, time));\n    }\n",
            "",
        ),
    ];
    for (comment, signature, moving, still) in functions {
        let body = if features.motion { moving } else { still };
        let _ = write!(text, "\n// {comment}\nfn dispatch_{signature} {{\n{body}}}\n");
    }
    text
}

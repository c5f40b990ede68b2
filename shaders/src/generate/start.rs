//! `scene/start.wgsl`, `scene/probe.wgsl`: where rays start off a mesh that stands for a smooth surface. Each function
//! depends on nothing but whether there is one.

use super::wgsl::imports;
use crate::FeatureSet;
use std::fmt::Write as _;

/// A function with its comment; `body` is indented lines.
fn function(text: &mut String, comment: &str, head: &str, body: &str) {
    let _ = write!(text, "\n// {comment}\nfn {head} {{\n{body}}}\n");
}

/// Whether a mesh may stand for a smooth surface.
fn is_smooth(features: &FeatureSet) -> bool {
    features.triangles && features.smooth_normals
}

/// What a path remembers of it.
pub(crate) fn start(features: &FeatureSet) -> String {
    let mut text = String::from("// Generated: where rays start.\n\n");
    let smooth = is_smooth(features);
    let with = |there: &'static str, absent: &'static str| if smooth { there } else { absent };
    text += &imports(["kernel/smooth_start.wgsl", "trace/ray_offset.wgsl"]);
    let _ = write!(text, "\nalias Start = {};\n", with("SmoothStart", "u32"));
    function(
        &mut text,
        "Rays start at the ray offset.",
        "dispatch_start_plain() -> Start",
        with("    return smooth_start_plain();\n", "    return 0u;\n"),
    );
    function(
        &mut text,
        "Where a ray along `dir` starts that leaves `point`.",
        "dispatch_origin(point: vec3f, ray_offset: vec3f, start: Start, dir: vec3f) -> vec3f",
        with(
            "    return smooth_start_origin(point, ray_offset, start, dir);\n",
            "    return ray_offset_origin(point, ray_offset, dir);\n",
        ),
    );
    function(
        &mut text,
        "What a ray along `dir` must not meet, as `Ray::skip`; `skip`: what it starts on.",
        "dispatch_skip(skip: vec2u, ray_offset: vec3f, start: Start, dir: vec3f) -> vec2u",
        with("    return smooth_start_skip(skip, ray_offset, start, dir);\n", "    return skip;\n"),
    );
    text
}

/// How a path finds out whether rays may start there.
pub(crate) fn probe(features: &FeatureSet) -> String {
    let mut text = String::from("// Generated: whether this scene has smooth meshes.\n\n");
    text += &imports(["kernel/state.wgsl", "surface/surface.wgsl", "trace/ray.wgsl"]);
    let smooth = is_smooth(features);
    if smooth {
        text += &imports(["kernel/smooth_probe.wgsl"]);
    }
    let with = |there: &'static str, absent: &'static str| if smooth { there } else { absent };
    function(
        &mut text,
        "Says above which plane the surface of a material of this kind and these flags reflects.",
        "dispatch_horizon(s: ptr<function, Surface>, kind: u32, flags: u32)",
        with("    smooth_probe_horizon(s, kind, flags);\n", ""),
    );
    function(
        &mut text,
        "Lets the rays that leave the vertex at `s` start where they can.",
        "dispatch_probe_begin(path: ptr<function, Path>, s: Surface)",
        with("    smooth_probe_begin(path, s);\n", ""),
    );
    let next = with("smooth_probe_ray(path, ray)", "ray");
    let next = if features.alpha_blend {
        format!("    var next = {next};\n    next.key = (*path).key;\n    return next;\n")
    } else {
        format!("    return {next};\n")
    };
    function(
        &mut text,
        "The ray to trace next, if it is not `ray`.",
        "dispatch_probe_ray(path: ptr<function, Path>, ray: Ray) -> Ray",
        &next,
    );
    function(
        &mut text,
        "Whether that was another ray than the path's own; its hit has been dealt with.",
        "dispatch_probe_advance(path: ptr<function, Path>, hit: Hit) -> bool",
        with("    return smooth_probe_advance(path, hit);\n", "    return false;\n"),
    );
    text
}

//! `scene/inside.wgsl`, `fog`, `segment`, `crossing`, `shadow`, `through`, `ends`: what media and see-through
//! surfaces do to a path. Each function depends on one of these features at most, and does nothing in
//! a scene without it.

use super::wgsl::imports;
use crate::FeatureSet;
use std::fmt::Write as _;

/// A function with its comment; `body` is indented lines.
fn function(text: &mut String, comment: &str, head: &str, body: &str) {
    let _ = write!(text, "\n// {comment}\nfn {head} {{\n{body}}}\n");
}

/// What a path remembers.
pub(crate) fn inside(features: &FeatureSet) -> String {
    let mut text = String::from("// Generated: what a path remembers of media.\n\n");
    let (volume, begin) = if features.media {
        text += &imports(["media/volume.wgsl"]);
        ("Volume", "volume_begin()")
    } else {
        ("u32", "0u")
    };
    let (passage, empty) = if features.through {
        text += &imports(["kernel/passage.wgsl"]);
        ("Passage", "passage_begin(origin)")
    } else {
        ("u32", "0u")
    };
    let _ = write!(text, "\nalias Inside = {volume};\n\nalias Passed = {passage};\n");
    let comment = "What a path that leaves the camera is in.";
    let body = format!("    return {begin};\n");
    function(&mut text, comment, "inside_begin() -> Inside", &body);
    let comment = "No ray has gone through anything; the path leaves the camera at `origin`.";
    let body = format!("    return {empty};\n");
    function(&mut text, comment, "passed_begin(origin: vec3f) -> Passed", &body);
    let comment = "How far the shadow ray has come.";
    let body = if features.through { "    return passage.t;\n" } else { "    return 0.0;\n" };
    function(&mut text, comment, "passed_length(passage: Passed) -> f32", body);
    text
}

/// Fog along a segment.
pub(crate) fn fog(features: &FeatureSet) -> String {
    let mut text = String::from("// Generated: whether this scene has fog.\n\n");
    text += &imports(["kernel/state.wgsl", "kernel/fog.wgsl"]);
    let with =
        |there: &'static str, absent: &'static str| if features.fog { there } else { absent };
    function(
        &mut text,
        "Takes away what the fog absorbs along the path's segment up to `t`.",
        "dispatch_fog_absorb(path: ptr<function, Path>, t: f32)",
        with("    fog_absorb(path, t);\n", ""),
    );
    function(
        &mut text,
        "Optical depth of the fog and of a medium of depth `tau` along the path's segment up to `t`.",
        "dispatch_fog_with(path: ptr<function, Path>, t: f32, tau: vec3f) -> vec3f",
        with("    return tau + fog_depth(path, t);\n", "    return tau;\n"),
    );
    let fade = with("fog_transmittance(path, t)", "vec3f(1.0)");
    let comment = "Transmittance of the fog along the path's shadow ray up to its hit at `t`.";
    let body = format!("    return {fade};\n");
    function(
        &mut text,
        comment,
        "dispatch_fog_fade(path: ptr<function, Path>, t: f32) -> vec3f",
        &body,
    );
    text
}

/// The medium along a segment.
pub(crate) fn segment(features: &FeatureSet) -> String {
    let mut text = String::from("// Generated: what lies along a segment.\n\n");
    text += &imports([
        "kernel/segment.wgsl",
        "kernel/state.wgsl",
        "kernel/vertex.wgsl",
        "scene/constants.wgsl",
        "scene/fog.wgsl",
        "scene/records.wgsl",
        "trace/ray.wgsl",
    ]);
    let medium = match (features.media, features.scattering) {
        (true, true) => "    if (segment_scatter(path, hit, v)) {\n        return true;\n    }\n",
        (true, false) => "    segment_absorb(path, hit.t);\n",
        (false, _) => "",
    };
    let both = if features.media { "fog + segment_depth(path, hit.t)" } else { "fog" };
    let glow = if features.fog {
        text += &imports(["kernel/fog.wgsl"]);
        format!("    let fog = fog_depth(path, hit.t);\n    fog_segment(path, fog, {both});\n")
    } else {
        String::new()
    };
    // Fog glows along the whole segment, wherever a medium scatters the path.
    let reach = match (features.media && features.scattering, features.fog) {
        (true, false) => "    return segment_reach(path);\n",
        (true, true) => {
            "    return select(RAY_FAR, segment_reach(path), load_frame_fog() == NONE);\n"
        }
        (false, _) => "    return RAY_FAR;\n",
    };
    let comment = "How far along the path's next segment its ray has to look.";
    function(&mut text, comment, "dispatch_segment_reach(path: ptr<function, Path>) -> f32", reach);
    let comment =
        "The path's segment up to `hit`: true if the path is scattered on the way, in `v`.";
    let head =
        "dispatch_segment(path: ptr<function, Path>, hit: Hit, v: ptr<function, Vertex>) -> bool";
    function(
        &mut text,
        comment,
        head,
        &format!("{glow}{medium}    dispatch_fog_absorb(path, hit.t);\n    return false;\n"),
    );
    text
}

/// How near to what ends a segment a point of it can be.
pub(crate) fn before(features: &FeatureSet) -> String {
    let mut text = String::from("// Generated: how near to a surface a point can be.\n\n");
    text += &imports(["surface/surface.wgsl", "trace/ray.wgsl"]);
    let mut body = String::new();
    if features.triangles {
        text += &imports(["scene/placed.wgsl", "shape/triangle.wgsl", "trace/order.wgsl"]);
        body += "    if ((hit.prim & PRIM_OTHER) == 0u && !dispatch_is_placed(hit)) {\n        \
                 return triangle_before(hit.prim, dir, hit.t);\n    }\n";
    }
    body += "    return surface_before(hit.t);\n";
    let comment =
        "How far along a ray in direction `dir` a point can be and still be before `hit`, rounded.";
    function(&mut text, comment, "dispatch_before(hit: Hit, dir: vec3f) -> f32", &body);
    text
}

/// Surfaces between media.
pub(crate) fn crossing(features: &FeatureSet) -> String {
    let mut text = String::from("// Generated: whether things of this scene have an inside.\n\n");
    text += &imports([
        "bsdf/scatter.wgsl",
        "kernel/state.wgsl",
        "scene/receiver.wgsl",
        "surface/surface.wgsl",
    ]);
    if features.media {
        text += &imports(["kernel/crossing.wgsl"]);
    }
    if features.sheets {
        text += &imports(["kernel/sheet.wgsl"]);
    }
    let with =
        |there: &'static str, absent: &'static str| if features.media { there } else { absent };
    let path = "path: ptr<function, Path>";
    function(
        &mut text,
        "True if the surface is not there for the path, which then goes straight on.",
        &format!("dispatch_pass({path}, s: Surface, flags: u32, skip: vec2u) -> bool"),
        with("    return crossing_pass(path, s, flags, skip);\n", "    return false;\n"),
    );
    function(
        &mut text,
        "Gives `scatter` the refractive index against what is around it.",
        &format!("dispatch_bend({path}, scatter: ptr<function, Scatter>, flags: u32)"),
        with("    crossing_bend(path, scatter, flags);\n", ""),
    );
    function(
        &mut text,
        "The path leaves the surface along `wi`, and its shadow ray on its own side.",
        &format!("dispatch_cross({path}, s: Surface, flags: u32, wi: vec3f)"),
        with("    crossing_cross(path, s, flags, wi);\n", ""),
    );
    function(
        &mut text,
        "The last vertex at which the path was scattered, or the camera.",
        &format!("dispatch_vertex({path}) -> vec3f"),
        if features.through {
            "    return (*path).passage.vertex;\n"
        } else {
            "    return (*path).point;\n"
        },
    );
    function(
        &mut text,
        "As `FilmPixel::stack_errors`.",
        &format!("dispatch_stack_errors({path}) -> u32"),
        with("    return (*path).inside.stack_errors;\n", "    return 0u;\n"),
    );
    depart(&mut text, features);
    text
}

/// What the camera does not see.
pub(crate) fn unseen(features: &FeatureSet) -> String {
    let mut text =
        String::from("// Generated: whether the camera sees all that is in this scene.\n\n");
    text += &imports(["kernel/state.wgsl", "surface/surface.wgsl"]);
    let mut body = "    return false;\n";
    if features.unseen {
        text += &imports(["kernel/unseen.wgsl"]);
        body = "    return unseen_pass(path, s, flags, skip);\n";
    }
    function(
        &mut text,
        "True if the surface is not there for the camera, from which the path comes; it then goes straight on.",
        "dispatch_unseen(path: ptr<function, Path>, s: Surface, flags: u32, skip: vec2u) -> bool",
        body,
    );
    text
}

/// What happens to a shadow ray on its way.
pub(crate) fn shadow(features: &FeatureSet) -> String {
    let mut text = String::from("// Generated: what a shadow ray meets.\n\n");
    text +=
        &imports(["kernel/segment.wgsl", "kernel/state.wgsl", "scene/fog.wgsl", "trace/ray.wgsl"]);
    if features.through {
        text += &imports(["kernel/shadow_ray.wgsl"]);
    }
    let path = "path: ptr<function, Path>";
    let fade = if features.media { " * segment_shadow_transmittance(path, t)" } else { "" };
    function(
        &mut text,
        "Weights the shadow ray with the transmittance up to its hit at `t`.",
        &format!("dispatch_shadow_transmittance({path}, t: f32)"),
        &format!("    (*path).shadow_radiance *= dispatch_fog_fade(path, t){fade};\n"),
    );
    let with =
        |there: &'static str, absent: &'static str| if features.through { there } else { absent };
    function(
        &mut text,
        "Moves the shadow ray through the surface it hit; false if that lets no light through.",
        &format!("dispatch_shadow_advance({path}, hit: Hit) -> bool"),
        with("    return shadow_ray_advance(path, hit);\n", "    return false;\n"),
    );
    function(
        &mut text,
        "The shadow ray has ended.",
        &format!("dispatch_shadow_end({path})"),
        with("    shadow_ray_end(path);\n", ""),
    );
    function(
        &mut text,
        "What is left of the path's next ray, which is `ray` in whole, behind what it went through as a shadow ray.",
        "dispatch_shadow_rest(path: ptr<function, Path>, ray: Ray) -> Ray",
        with("    return shadow_ray_rest(path, ray);\n", "    return ray;\n"),
    );
    function(
        &mut text,
        "What the path's next ray adds to `FilmPixel::rays`: nothing if it is the rest of a shadow ray.",
        &format!("dispatch_counted_rays({path}) -> u32"),
        with("    return select(1u, 0u, (*path).passage.t > 0.0);\n", "    return 1u;\n"),
    );
    text
}

/// What a shadow ray keeps at a surface.
pub(crate) fn through(features: &FeatureSet) -> String {
    let mut text = String::from("// Generated: the see-through surfaces of this scene.\n\n");
    text += &imports([
        "kernel/state.wgsl",
        "scene/constants.wgsl",
        "surface/surface.wgsl",
        "trace/ray.wgsl",
    ]);
    let mut body = String::new();
    if features.media {
        text += &imports(["kernel/crossing.wgsl"]);
        body += "    if ((flags & FLAG_INTERIOR) != 0u) {\n        \
                 return crossing_through(path, s);\n    }\n";
    }
    if features.sheets {
        text += &imports(["kernel/sheet.wgsl"]);
        body += "    return sheet_through(path, s, hit);\n";
    } else {
        body += "    return vec3f(0.0);\n";
    }
    function(
        &mut text,
        "What a shadow ray keeps that goes on behind a surface of a material with these flags; 0: nothing.",
        "dispatch_through(path: ptr<function, Path>, s: Surface, flags: u32, hit: Hit) -> vec3f",
        &body,
    );
    text
}

/// What a path remembers of a vertex that it leaves.
fn depart(text: &mut String, features: &FeatureSet) {
    let mark = if features.through { "    (*path).passage.vertex = p;\n" } else { "" };
    let sheet = if features.sheets {
        "    if (sheet_passes(path, flags, next)) {\n        // Like a shadow ray, which counts as one segment.\n        \
         (*path).segments -= 1u;\n        return (*path).pdf;\n    }\n"
    } else {
        ""
    };
    function(
        text,
        "Density against which lights are weighted that the path finds beyond `p`, which it leaves as `next` says.",
        "dispatch_depart(path: ptr<function, Path>, p: vec3f, flags: u32, next: Scattered) -> f32",
        &format!("{sheet}{mark}    return next.pdf;\n"),
    );
    let passes = if features.sheets { "sheet_passes(path, flags, next)" } else { "false" };
    function(
        text,
        "Whether `next` goes straight through a sheet with these flags.",
        "dispatch_passes(path: ptr<function, Path>, flags: u32, next: Scattered) -> bool",
        &format!("    return {passes};\n"),
    );
    let is_sheet = if features.sheets { "sheet_is(flags)" } else { "false" };
    function(
        text,
        "Whether some light goes straight through a surface with these flags.",
        "dispatch_sheet(flags: u32) -> bool",
        &format!("    return {is_sheet};\n"),
    );
}

/// Which hits end the search of a shadow ray.
pub(crate) fn ends(features: &FeatureSet) -> String {
    let mut text = String::from("// Generated: which hits hide a light.\n\n");
    text += &imports([
        "scene/constants.wgsl",
        "scene/placed.wgsl",
        "scene/records.wgsl",
        "trace/ray.wgsl",
    ]);
    let sphere = "load_sphere_material(hit.prim & ~PRIM_SPHERE)";
    let triangle = "dispatch_placed_material(hit.instance, load_tri_shade_material(hit.prim))";
    let material = match (features.spheres, features.triangles) {
        (true, true) => format!(
            "    if ((hit.prim & PRIM_SPHERE) != 0u) {{\n        return {sphere};\n    }}\n    \
             return {triangle};\n"
        ),
        (true, false) => format!("    return {sphere};\n"),
        (false, _) => format!("    return {triangle};\n"),
    };
    function(
        &mut text,
        "The material that was hit.",
        "dispatch_material(hit: Hit) -> u32",
        &material,
    );
    let body = if features.through {
        "    return (load_material_flags(dispatch_material(hit)) & FLAG_THROUGH) == 0u;\n"
    } else {
        "    return true;\n"
    };
    function(&mut text, "Nothing gets behind the hit.", "dispatch_ends(hit: Hit) -> bool", body);
    text
}

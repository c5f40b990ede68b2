//! `scene/dispatch.wgsl` and `scene/place.wgsl`: what a path asks of the scene at its vertices, from the camera on.

use super::wgsl::{imports, switch, tag};
use crate::FeatureSet;
use pack::abi::{CameraKind, FilterKind, LightKind};
use std::fmt::Write as _;

/// Camera, sky, surfaces and direct light.
pub(crate) fn dispatch(features: &FeatureSet) -> String {
    let mut text =
        String::from("// Generated: camera, sky, shapes and direct light of this scene.\n\n");
    let mut modules = vec![
        "abi/material_head.wgsl",
        "bsdf/scatter.wgsl",
        "camera/film_plane.wgsl",
        "kernel/state.wgsl",
        "math/vector.wgsl",
        "sampler/key.wgsl",
        "scene/constants.wgsl",
        "scene/dispatch_sky.wgsl",
        "scene/eye.wgsl",
        "scene/motion.wgsl",
        "scene/placed.wgsl",
        "scene/receiver.wgsl",
        "scene/records.wgsl",
        "scene/sampler.wgsl",
        "scene/seen.wgsl",
        "shape/sphere.wgsl",
        "shape/triangle.wgsl",
        "surface/surface.wgsl",
        "trace/ray.wgsl",
    ];
    modules.extend(features.cameras.iter().map(|kind| match kind {
        CameraKind::Perspective => "camera/pinhole.wgsl",
        CameraKind::Orthographic => "camera/orthographic.wgsl",
        CameraKind::Panoramic => "camera/panoramic.wgsl",
    }));
    modules
        .extend(features.filters.iter().filter_map(|kind| filter(*kind)).map(|(module, _)| module));
    if features.lens {
        modules.push("camera/thin_lens.wgsl");
        if features.blades {
            modules.push("camera/blades.wgsl");
        }
    }
    if features.normal_maps {
        modules.push("surface/normal_map.wgsl");
    }
    let directional = features.lights.contains(&LightKind::Directional);
    if features.geometry() && !features.lights.is_empty() {
        modules.push("kernel/direct.wgsl");
    }
    if directional {
        modules.push(if features.geometry() {
            "kernel/directional.wgsl"
        } else {
            "light/directional.wgsl"
        });
    }
    text += &imports(modules);
    text += &film(features);
    text += &camera(features);
    text += &miss(features);
    if features.geometry() {
        text += &surface(features);
        text += &tangent(features);
        text += &shading_normal(features);
        text += &direct(features);
    }
    text
}

/// The module of a filter, and its offset from the middle of the pixel; `None`: it is the pixel.
fn filter(kind: FilterKind) -> Option<(&'static str, &'static str)> {
    match kind {
        FilterKind::Pixel => None,
        FilterKind::Box => Some(("filter/box.wgsl", "box_offset")),
        FilterKind::Tent => Some(("filter/tent.wgsl", "tent_offset")),
        FilterKind::Gaussian => Some(("filter/gaussian.wgsl", "gaussian_offset")),
        FilterKind::BlackmanHarris => {
            Some(("filter/blackman_harris.wgsl", "blackman_harris_offset"))
        }
    }
}

/// Where on the film a sample looks.
fn film(features: &FeatureSet) -> String {
    let cases: Vec<(String, String)> = features
        .filters
        .iter()
        .map(|kind| {
            let at = match filter(*kind) {
                None => "vec2f(pixel) + u".to_owned(),
                Some((_, offset)) => {
                    format!("vec2f(pixel) + 0.5 + {offset}(u, load_frame_filter_width())")
                }
            };
            (tag("FILTER", &kind.stem()), at)
        })
        .collect();
    format!(
        "\n// Where a sample of `pixel` looks, pixels from the top left corner: the filter, importance sampled.\n\
         fn dispatch_film(key: SampleKey, pixel: vec2u) -> vec2f {{\n    \
         let u = sample_2d(key, PURPOSE_PIXEL);\n{}}}\n",
        switch("load_frame_pixel_filter()", &cases, "vec2f(pixel) + u")
    )
}

fn camera(features: &FeatureSet) -> String {
    let blades = if features.blades {
        "        if (camera.blades > 0u) {\n            \
         return thin_lens_ray(camera, at, blades_point(camera, u));\n        }\n"
    } else {
        ""
    };
    let lens = if features.lens {
        format!(
            "    if (camera.lens_radius > 0.0) {{\n        \
             let u = sample_2d(key, PURPOSE_LENS);\n{blades}        \
             return thin_lens_ray(camera, at, thin_lens_disk(camera, u));\n    }}\n"
        )
    } else {
        String::new()
    };
    let cases: Vec<(String, String)> = features
        .cameras
        .iter()
        .map(|kind| {
            let ray = match kind {
                CameraKind::Perspective => "pinhole_ray(camera, at)",
                CameraKind::Orthographic => "orthographic_ray(camera, at)",
                CameraKind::Panoramic => "panoramic_ray(camera, at)",
            };
            (tag("CAMERA", &kind.stem()), ray.to_owned())
        })
        .collect();
    format!(
        "\n// The ray through `at`, pixels from the top left corner.\n\
         fn dispatch_camera(key: SampleKey, at: vec2f) -> CameraRay {{\n    \
         let camera = dispatch_eye(key);\n{lens}{}}}\n",
        switch("camera.kind", &cases, cases.first().map_or("", |(_, ray)| ray.as_str()))
    )
}

fn surface(features: &FeatureSet) -> String {
    let mut body = String::new();
    if features.spheres {
        let mut sphere = String::from(
            "    let sphere = load_sphere(hit.prim & ~PRIM_SPHERE);\n    \
             let start = dispatch_thing_origin(sphere.object, origin, time);\n    \
             let back = dispatch_thing_dir(sphere.object, dir, time);\n    \
             var s = sphere_surface(sphere, start, back, hit.t);\n",
        );
        if !features.textures.is_empty() || features.tangents {
            // On a CPU the full kernel is told whether anything asks for them.
            sphere += "    if (load_frame_texture_at() != NONE) {\n        \
                       s.at.uv = sphere_uv(select(-s.ng, s.ng, s.front));\n    }\n";
        }
        sphere += "    dispatch_thing_carry(&s, sphere.object, time);\n    return s;\n";
        if features.triangles {
            let inner = sphere.replace("    ", "        ");
            let _ = write!(body, "    if ((hit.prim & PRIM_SPHERE) != 0u) {{\n{inner}    }}\n");
        } else {
            body += &sphere;
        }
    }
    if features.triangles {
        let function =
            if features.smooth_normals { "triangle_surface" } else { "triangle_flat_surface" };
        let _ = write!(
            body,
            "    if (dispatch_is_placed(hit)) {{\n        return dispatch_placed_surface(hit, dir, time);\n    }}\n    \
             let tri = load_triangle(hit.prim);\n    \
             let shade = load_tri_shade(hit.prim);\n    \
             let thing = triangle_thing(tri, shade);\n    \
             let back = dispatch_thing_dir(thing, dir, time);\n    \
             var s = {function}(tri, shade, hit.b, back);\n    \
             s.at.prim = hit.prim;\n    \
             s.at.b = hit.b;\n    \
             dispatch_thing_carry(&s, thing, time);\n    return s;\n"
        );
    }
    format!(
        "\n// The surface that the ray from `origin` along `dir` has hit at `time`.\n\
         fn dispatch_surface(hit: Hit, origin: vec3f, dir: vec3f, time: f32) -> Surface {{\n{body}}}\n"
    )
}

fn tangent(features: &FeatureSet) -> String {
    let mut body = String::new();
    if features.tangents && features.geometry() {
        body += "    if ((flags & FLAG_TANGENT) == 0u) {\n        return;\n    }\n";
        let sphere = "let out = dispatch_turn_back((*s).object, select(-(*s).ng, (*s).ng, (*s).front), time);\n        \
                      (*s).tangent = dispatch_turn((*s).object, sphere_tangent(out), time);";
        let triangle = "let t = dispatch_placed_tangent(hit.instance, triangle_tangent(hit.prim));\n    (*s).tangent = dispatch_turn((*s).object, t.xyz, time);\n    \
                        (*s).handed = select(-t.w, t.w, (*s).front);";
        let lines = match (features.spheres, features.triangles) {
            (true, true) => format!(
                "    if ((hit.prim & PRIM_SPHERE) != 0u) {{\n        {sphere}\n        \
                 (*s).handed = select(-1.0, 1.0, (*s).front);\n        return;\n    }}\n    {triangle}\n"
            ),
            (true, false) => {
                format!("    {sphere}\n    (*s).handed = select(-1.0, 1.0, (*s).front);\n")
            }
            (false, _) => format!("    {triangle}\n"),
        };
        body += &lines;
    }
    format!(
        "\n// Finds the direction in which u grows, for materials whose flags ask for it.\n\
         fn dispatch_tangent(s: ptr<function, Surface>, hit: Hit, flags: u32, time: f32) {{\n{body}}}\n"
    )
}

fn shading_normal(features: &FeatureSet) -> String {
    let map = if features.normal_maps {
        "    if (m.normal_texture != NONE) {\n        \
         normal_map_tilt(s, m.normal_texture, m.normal_strength, dir);\n    }\n"
    } else {
        ""
    };
    format!(
        "\n// Tilts the shading normal of `s`, seen along `dir`, as the material says.\n\
         fn dispatch_shading_normal(s: ptr<function, Surface>, m: MaterialHead, dir: vec3f) {{\n{map}}}\n"
    )
}

/// Where a point is in its object, if any material asks.
pub(crate) fn place(features: &FeatureSet) -> String {
    let mut text = String::from("// Generated: whether this scene has objects.\n\n");
    text += &imports(["scene/constants.wgsl", "surface/place.wgsl"]);
    let body = if features.objects {
        "    if ((flags & FLAG_OBJECT) != 0u) {\n        return place_at(object, p);\n    }\n"
    } else {
        ""
    };
    let _ = write!(
        text,
        "\n// Point `p` in its object, for materials whose flags ask for it; otherwise the origin.\n\
         fn dispatch_place(object: u32, flags: u32, p: vec3f) -> Place {{\n{body}    \
         return Place(vec3f(0.0), 0u);\n}}\n"
    );
    text
}

/// Whether textures of any material are projected.
pub(crate) fn projection(features: &FeatureSet) -> String {
    let mut text = String::from("// Generated: whether this scene projects textures.\n\n");
    text += &imports([
        "sampler/key.wgsl",
        "scene/constants.wgsl",
        "surface/surface.wgsl",
        "texture/texture_point.wgsl",
    ]);
    let (mut body, mut at) = ("", "");
    if features.projection {
        text += &imports(["surface/projection.wgsl"]);
        body = "    if ((flags & FLAG_PROJECT) != 0u) {\n        \
                projection_apply(s, flags, key, time);\n    }\n";
        at = "    if ((flags & FLAG_PROJECT) != 0u) {\n        \
              let at = projection_at(s, flags, key, time);\n        \
              return TexturePoint(at.xy, at.z, s.at.prim, s.at.b);\n    }\n";
    }
    let _ = write!(
        text,
        "\n// Gives `s`, on a material with these flags, other texture coordinates, if the material says so.\n\
         fn dispatch_projection(s: ptr<function, Surface>, flags: u32, key: SampleKey, time: f32) {{\n{body}}}\n\
         \n// Where `s`, on a material with these flags, is for textures.\n\
         fn dispatch_projected(s: Surface, flags: u32, key: SampleKey, time: f32) -> TexturePoint {{\n{at}    \
         return s.at;\n}}\n"
    );
    text
}

/// Whether any principled material is brushed.
pub(crate) fn brushing(features: &FeatureSet) -> String {
    let mut text =
        String::from("// Generated: whether this scene has brushed principled surfaces.\n\n");
    text += &imports(["abi/material_head.wgsl", "surface/brushing.wgsl", "surface/surface.wgsl"]);
    let body = if features.principled_anisotropy {
        "    if (kind == MATERIAL_PRINCIPLED) {\n        return brushing_at(s);\n    }\n"
    } else {
        ""
    };
    let _ = write!(
        text,
        "\n// `Scatter::tangent` and `Scatter::anisotropy` of the surface `s`, whose material is of this `kind`.\n\
         fn dispatch_brushing(s: Surface, kind: u32) -> vec4f {{\n{body}    \
         return vec4f(s.tangent, 0.0);\n}}\n"
    );
    text
}

/// What a ray sees that hits nothing; weighted where the sky is sampled, too.
fn miss(features: &FeatureSet) -> String {
    let sky_is_sampled = features.geometry() && features.lights.contains(&LightKind::Sky);
    let plus = match (features.lights.contains(&LightKind::Directional), features.geometry()) {
        (false, _) => "",
        (true, true) => " + directional_miss(dir, pdf, receiver, straight)",
        // Every ray is the camera's.
        (true, false) => " + directional_backdrop(dir)",
    };
    let unseen = "    if (!dispatch_sky_seen(straight)) {\n        return vec3f(0.0);\n    }\n";
    let weighted = if sky_is_sampled {
        "    let radiance = dispatch_sky(dir);\n    \
         if (vector_max(radiance) <= 0.0) {\n        return radiance;\n    }\n    \
         return radiance * direct_sky_weight(dir, pdf);\n"
    } else {
        "    return dispatch_sky(dir);\n"
    };
    let (alone, body) = if plus.is_empty() {
        (String::new(), format!("{unseen}{weighted}"))
    } else {
        let alone = format!(
            "\n// What is of the sky in `dispatch_miss`.\n\
             fn dispatch_sky_miss(dir: vec3f, pdf: f32, straight: bool) -> vec3f {{\n{unseen}{weighted}}}\n"
        );
        (alone, format!("    return dispatch_sky_miss(dir, pdf, straight){plus};\n"))
    };
    format!(
        "{alone}\n// Radiance that a direction from a `receiver`, sampled with density `pdf`, finds where it hits nothing.\n\
         // `straight`: it is that of the camera.\n\
         fn dispatch_miss(dir: vec3f, pdf: f32, receiver: Receiver, straight: bool) -> vec3f {{\n{body}}}\n"
    )
}

/// `scene/directional.wgsl`: how many lights are directional, and their share of the table. A module of its own, so that
/// the choice of a light does not depend on their kinds.
pub(crate) fn directional(features: &FeatureSet) -> String {
    let mut text = String::from("// Generated: whether lights of this scene are directional.\n\n");
    let there = features.lights.contains(&LightKind::Directional);
    let (count, share) =
        if there { ("directional_count()", "directional_share()") } else { ("0u", "0.0") };
    text += &imports(there.then_some("light/directional.wgsl"));
    let _ = write!(
        text,
        "\n// Number of directional lights, which come first in the table.\n\
         fn dispatch_n_directional() -> u32 {{\n    return {count};\n}}\n\
         \n// Sum of their probabilities.\n\
         fn dispatch_directional_share() -> f32 {{\n    return {share};\n}}\n"
    );
    text
}

fn direct(features: &FeatureSet) -> String {
    let sample = if features.lights.is_empty() {
        ""
    } else {
        "    direct_sample(path, p, ray_offset, receiver, scatter, wo);\n"
    };
    let weight = if features.surface_lights() {
        "direct_weight(origin, receiver, dir, pdf, s, time)"
    } else {
        "1.0"
    };
    format!(
        "\n// Leaves a shadow ray in `path` if light may reach the vertex at `p` directly; rays start off it\n\
         // by `ray_offset` on either side.\n\
         fn dispatch_direct(path: ptr<function, Path>, p: vec3f, ray_offset: vec3f, receiver: Receiver, scatter: Scatter, wo: vec3f) {{\n{sample}}}\n\
         \n// Weight of emission that a direction sampled with density `pdf` has found at `time`.\n\
         fn dispatch_emission_weight(origin: vec3f, receiver: Receiver, dir: vec3f, pdf: f32, s: Surface, time: f32) -> f32 {{\n    \
         return {weight};\n}}\n"
    )
}

//! `scene/dispatch_sky.wgsl`, `scene/dispatch_radiance.wgsl`: what the sky sends, and what a light sends.

use super::wgsl::{imports, switch, tag};
use crate::FeatureSet;
use pack::abi::{LightKind, SkyKind};
use std::fmt::Write as _;

/// Radiance by direction.
pub(crate) fn sky(features: &FeatureSet) -> String {
    let files: Vec<String> =
        features.skies.iter().map(|sky| format!("sky/{}.wgsl", sky.stem())).collect();
    let mut text = String::from("// Generated: the sky of this scene.\n\n");
    text += &imports(["scene/constants.wgsl", "scene/records.wgsl"]);
    text += &imports(files.iter().map(String::as_str));
    let cases: Vec<(String, String)> = features
        .skies
        .iter()
        .map(|sky| {
            let arguments = match sky {
                SkyKind::Constant => "",
                SkyKind::Gradient | SkyKind::Image => "dir",
            };
            let stem = sky.stem();
            (tag("SKY", &stem), format!("{stem}_radiance({arguments})"))
        })
        .collect();
    let none = if cases.is_empty() {
        ""
    } else {
        "    if (load_frame_sky_at() == NONE) {\n        return vec3f(0.0);\n    }\n"
    };
    let _ = write!(
        text,
        "\n// Radiance of the sky along `dir`.\nfn dispatch_sky(dir: vec3f) -> vec3f {{\n{none}{}}}\n",
        switch("load_sky_kind()", &cases, "vec3f(0.0)")
    );
    text
}

/// What rays that leave the scene do not find.
pub(crate) fn seen(features: &FeatureSet) -> String {
    let mut text = String::from(
        "// Generated: whether rays that leave this scene see all of what is there.\n\n",
    );
    text += &imports(["abi/light.wgsl", "scene/constants.wgsl", "scene/records.wgsl"]);
    let (sky, light) = if features.unseen {
        (
            "    if (!straight || load_frame_sky_at() == NONE) {\n        return true;\n    }\n    \
             return load_sky_unseen() == 0u;\n",
            "    return !straight || light.edge2.y <= 0.0;\n",
        )
    } else {
        ("    return true;\n", "    return true;\n")
    };
    let _ = write!(
        text,
        "\n// Whether it finds the sky. `straight`: it comes from the camera.\n\
         fn dispatch_sky_seen(straight: bool) -> bool {{\n{sky}}}\n\
         \n// Whether it finds the directional light `light`.\n\
         fn dispatch_directional_seen(light: Light, straight: bool) -> bool {{\n{light}}}\n"
    );
    text
}

/// Radiance of a sampled light.
pub(crate) fn radiance(features: &FeatureSet) -> String {
    let mut modules = vec!["abi/light.wgsl", "light/light_sample.wgsl", "scene/constants.wgsl"];
    // Each kind without a surface, and all surfaces as one.
    let mut calls = Vec::new();
    if features.lights.contains(&LightKind::Sky) {
        modules.push("scene/dispatch_sky.wgsl");
        calls.push(("LIGHT_SKY", "dispatch_sky(to.wi)"));
    }
    if features.lights.contains(&LightKind::Directional) {
        modules.push("light/directional.wgsl");
        calls.push(("LIGHT_DIRECTIONAL", "light.edge1"));
    }
    if features.surface_lights() {
        modules.push("light/surface_light.wgsl");
        calls.push((
            "",
            if features.alpha_blend {
                modules.push("light/light_coverage.wgsl");
                "surface_light_radiance(light, p, to) * light_coverage(light, p, to)"
            } else {
                "surface_light_radiance(light, p, to)"
            },
        ));
    }
    let last = calls.pop().map_or("vec3f(0.0)", |(_, call)| call);
    let mut body = String::new();
    for (tag, call) in calls {
        let _ = write!(body, "    if (light.kind == {tag}) {{\n        return {call};\n    }}\n");
    }
    let mut text = String::from("// Generated: what the lights of this scene send.\n\n");
    text += &imports(modules);
    let _ = write!(
        text,
        "\n// Radiance of `light` at its sample `to` from `p`.\n\
         fn dispatch_light_radiance(light: Light, p: vec3f, to: LightSample) -> vec3f {{\n{body}    \
         return {last};\n}}\n"
    );
    text
}

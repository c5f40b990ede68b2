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

/// Radiance of a sampled light.
pub(crate) fn radiance(features: &FeatureSet) -> String {
    let mut modules = vec!["abi/light.wgsl", "light/light_sample.wgsl", "scene/constants.wgsl"];
    let mut body = String::new();
    let has_sky = features.lights.contains(&LightKind::Sky);
    if has_sky {
        modules.push("scene/dispatch_sky.wgsl");
    }
    let (sky, surface) = ("dispatch_sky(to.wi)", "surface_light_radiance(light, p, to)");
    if features.surface_lights() {
        modules.push("light/surface_light.wgsl");
        if has_sky {
            let _ = write!(
                body,
                "    if (light.kind == LIGHT_SKY) {{\n        return {sky};\n    }}\n"
            );
        }
    }
    let last = if features.surface_lights() { surface } else { sky };
    let last = if features.lights.is_empty() { "vec3f(0.0)" } else { last };
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

//! `scene/dispatch_choice.wgsl`, `scene/dispatch_tint.wgsl`: which light, and which colour it has seen from somewhere.

use super::wgsl::imports;
use crate::FeatureSet;
use std::fmt::Write as _;

/// The choice of a light: there is but one, or by the table, or by the tree.
pub(crate) fn text(features: &FeatureSet) -> String {
    let mut text = String::from("// Generated: how a light of this scene is chosen.\n\n");
    if features.light_choice {
        chosen(features, &mut text);
    } else {
        only(&mut text);
    }
    text
}

/// One light: its entry of the table says 1, and needs not be read.
fn only(text: &mut String) {
    *text += &imports(["light/light_choice.wgsl", "sampler/key.wgsl", "scene/receiver.wgsl"]);
    let number = "point";
    let choose = "    return LightChoice(0u, 1.0, u);\n";
    let pmf = "    return 1.0;\n";
    functions(text, number, choose, [pmf, pmf]);
}

fn chosen(features: &FeatureSet, text: &mut String) {
    let mut modules = vec![
        "light/choose.wgsl",
        "light/light_choice.wgsl",
        "sampler/key.wgsl",
        "scene/constants.wgsl",
        "scene/receiver.wgsl",
        "scene/records.wgsl",
        "scene/sampler.wgsl",
    ];
    let (mut choose, mut pmf) = (String::new(), String::new());
    if features.light_tree {
        modules.extend(["light/tree.wgsl", "scene/directional.wgsl"]);
        choose += "    if (load_frame_light_tree_at() != NONE) {\n";
        pmf += "    if (load_frame_light_tree_at() != NONE) {\n        return ";
        // Lights without a surface keep their shares of the table; the tree has the rest. All shares are multiples of
        // 2^-24, as `u` is, so that differences are exact.
        choose += "        let far = dispatch_directional_share();\n        \
                   if (u < far) {\n            return choose_from_table(dispatch_n_directional(), u);\n        }\n        \
                   let sky = tree_sky();\n        \
                   if (u - far < sky.pmf) {\n            return LightChoice(sky.index, sky.pmf, light_choice_unit((u - far) / sky.pmf));\n        }\n        \
                   let rest = (1.0 - far) - sky.pmf;\n        \
                   let choice = tree_choose(p, receiver_facing(receiver), light_choice_unit(((u - far) - sky.pmf) / rest));\n        \
                   return LightChoice(choice.index, choice.pmf * rest, choice.rest);\n    }\n";
        pmf += "((1.0 - dispatch_directional_share()) - tree_sky().pmf) * tree_pmf(index, p, receiver_facing(receiver));\n    }\n";
    }
    choose += "    return choose_from_table(n_lights, u);\n";
    let table = "    return load_light_pmf(index);\n";
    pmf += table;
    *text += &imports(modules);
    functions(text, "light_choice_point(choice, point, key)", &choose, [&pmf, table]);
}

/// The functions with these bodies; `pmfs`: of a surface, and of the sky.
fn functions(text: &mut String, number: &str, choose: &str, [surface, sky]: [&str; 2]) {
    let _ = write!(
        text,
        "\n// The pair for a point of the light that the first number of `point` chose.\n\
         fn dispatch_light_point(choice: LightChoice, point: vec2f, key: SampleKey) -> vec2f {{\n    \
         return {number};\n}}\n\
         \n// One of `n_lights` lights for the point `p` of a `receiver`; `u` in [0, 1 - 2^-24].\n\
         fn dispatch_choose(n_lights: u32, p: vec3f, receiver: Receiver, u: f32) -> LightChoice {{\n{choose}}}\n\
         \n// Probability with which `dispatch_choose` finds light `index`, a surface, from `p`.\n\
         fn dispatch_choose_pmf(index: u32, p: vec3f, receiver: Receiver) -> f32 {{\n{surface}}}\n\
         \n// Probability with which `dispatch_choose` finds the sky, light `index`.\n\
         fn dispatch_sky_pmf(index: u32) -> f32 {{\n{sky}}}\n"
    );
}

/// What lights do with the direction from which they are seen.
pub(crate) fn tint(features: &FeatureSet) -> String {
    let mut text =
        String::from("// Generated: whether lights of this scene depend on direction.\n\n");
    let mut modules = vec!["abi/light.wgsl"];
    let (mut found, mut sampled) = (String::new(), String::new());
    if features.tint || features.spot || features.profile {
        modules.extend(["scene/constants.wgsl", "scene/records.wgsl"]);
    }
    if features.tint {
        modules.push("light/tint.wgsl");
        found += "    if ((flags & FLAG_EMIT_TINT) != 0u && light != NONE) {\n        \
                  let cosine = load_light_edge1(light).y;\n        \
                  return tint_radiance(radiance, material, load_light_edge2(light), cosine, dir);\n    }\n";
        sampled += "    if ((flags & FLAG_EMIT_TINT) != 0u) {\n        \
                    return tint_radiance(radiance, light.material, light.edge2, light.edge1.y, dir);\n    }\n";
    }
    if features.spot {
        modules.push("light/spot.wgsl");
        found += "    if ((flags & FLAG_EMIT_SPOT) != 0u && light != NONE) {\n        \
                  let cone = load_light_edge1(light);\n        \
                  return spot_radiance(radiance, load_light_edge2(light), cone.y, cone.z, dir);\n    }\n";
        sampled += "    if ((flags & FLAG_EMIT_SPOT) != 0u) {\n        \
                    return spot_radiance(radiance, light.edge2, light.edge1.y, light.edge1.z, dir);\n    }\n";
    }
    if features.profile {
        modules.push("light/profile.wgsl");
        found += "    if ((flags & FLAG_EMIT_PROFILE) != 0u && light != NONE) {\n        \
                  let turn = load_light_edge1(light).y;\n        \
                  let image = load_material_color_texture(material);\n        \
                  return profile_radiance(radiance, image, load_light_edge2(light), turn, dir);\n    }\n";
        sampled += "    if ((flags & FLAG_EMIT_PROFILE) != 0u) {\n        \
                    let image = load_material_color_texture(light.material);\n        \
                    return profile_radiance(radiance, image, light.edge2, light.edge1.y, dir);\n    }\n";
    }
    text += &imports(modules);
    let _ = write!(
        text,
        "\n// `radiance` of a surface with flags `flags`, light `light` or `NONE`, as a ray along `dir` sees it.\n\
         fn dispatch_tint(radiance: vec3f, material: u32, flags: u32, light: u32, dir: vec3f) -> vec3f {{\n\
         {found}    return radiance;\n}}\n\
         \n// The same for a light that was sampled.\n\
         fn dispatch_light_tint(radiance: vec3f, flags: u32, light: Light, dir: vec3f) -> vec3f {{\n\
         {sampled}    return radiance;\n}}\n"
    );
    text
}

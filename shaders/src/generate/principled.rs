//! `scene/layers.wgsl`, `scene/bare.wgsl`, `scene/principled.wgsl`: which layers the principled materials of
//! a scene have.

use super::wgsl::imports;
use crate::FeatureSet;
use std::fmt::Write as _;

/// Parameters that few scenes use, or what they are without them.
pub(crate) fn layers(features: &FeatureSet) -> String {
    let mut text = String::from("// Generated: which layers the principled surfaces have.\n\n");
    text += &imports([
        "bsdf/gloss_albedo.wgsl",
        "bsdf/layers.wgsl",
        "bsdf/scatter.wgsl",
        "bsdf/under_coat.wgsl",
    ]);
    let choose = |present: bool, value: &'static str, absent| if present { value } else { absent };
    let specular = choose(features.principled_specular, "layers_specular(s)", "vec4f(1.0)");
    let through = choose(features.principled_transmission, "layers_transmission(s)", "0.0");
    let coated = features.principled_coat;
    let coat = choose(coated, "layers_coat(s)", "vec2f(0.0, 1.0)");
    let under = choose(coated, "under_coat_through(coat, on, c)", "1.0");
    let kept = choose(coated, "under_coat_kept(coat, g, roughness, entry)", "0.0");
    let missing = choose(coated, "under_coat_missing(coat, g, roughness)", "g.mean_missing");
    let flattened = choose(coated, "under_coat_flattened(coat, g, c)", "0.0");
    let _ = write!(
        text,
        "\n// Colour and factor of the reflectance of the dielectric part.\n\
         fn dispatch_specular(s: Scatter) -> vec4f {{\n    return {specular};\n}}\n\
         \n// Share of the light entering that goes through.\n\
         fn dispatch_transmission(s: Scatter) -> f32 {{\n    return {through};\n}}\n\
         \n// Share under a clear coat, and its perceptual roughness.\n\
         fn dispatch_coat(s: Scatter) -> vec2f {{\n    return {coat};\n}}\n\
         \n// What a coat lets through at cosine `c`.\n\
         fn dispatch_under_coat(coat: vec2f, on: bool, c: f32) -> f32 {{\n    return {under};\n}}\n\
         \n// How much it takes off the mean of what enters the lobe `g`.\n\
         fn dispatch_coat_keeps(coat: vec2f, g: GlossAlbedo, roughness: f32, entry: vec2f) -> f32 {{\n    return {kept};\n}}\n\
         \n// What the lobe `g` loses under it at cosine `c`.\n\
         fn dispatch_coat_flattened(coat: vec2f, g: GlossAlbedo, c: f32) -> f32 {{\n    return {flattened};\n}}\n\
         \n// The mean of what the lobe `g` does not give back.\n\
         fn dispatch_coat_missing(coat: vec2f, g: GlossAlbedo, roughness: f32) -> f32 {{\n    return {missing};\n}}\n"
    );
    text
}

/// The functions of a layer and of all that is under it, without their prefix.
const FUNCTIONS: [(&str, &str, &str, &str, &str); 3] = [
    ("direction", ", u: vec2f, v: f32", ", u, v", "Scattered", "As `principled_direction`."),
    ("eval", ", wi: vec3f", ", wi", "Evaluated", "f |cos| and the density, delta lobes left out."),
    ("straight", "", "", "vec3f", "Share of light that goes straight through."),
];

/// The call of `function` of the layer `stem`; nothing goes straight through an opaque one.
fn call(stem: &str, function: &str, arguments: &str) -> String {
    if (stem, function) == ("principled", "straight") {
        return "vec3f(0.0)".to_owned();
    }
    format!("{stem}_{function}(s, p, wo{arguments})")
}

/// The model under a coat.
pub(crate) fn bare(features: &FeatureSet) -> String {
    let stem = bare_stem(features);
    let mut text = String::from("// Generated: the principled surface under a coat.\n\n");
    let module = format!("bsdf/{stem}.wgsl");
    text += &imports(["bsdf/principled.wgsl", "bsdf/scatter.wgsl", &module]);
    for (function, parameters, arguments, result, comment) in FUNCTIONS {
        let called = call(stem, function, arguments);
        let _ = write!(
            text,
            "\n// {comment}\n\
             fn dispatch_bare_{function}(s: Scatter, p: Principled, wo: vec3f{parameters}) -> {result} {{\n    \
             return {called};\n}}\n"
        );
    }
    text
}

fn bare_stem(features: &FeatureSet) -> &'static str {
    if features.principled_transmission { "thin" } else { "principled" }
}

/// The whole model. What the surface is made of is worked out once in each function, and each layer is
/// called once: compilers for GPUs copy what is called.
pub(crate) fn outer(features: &FeatureSet) -> String {
    let stem = if features.principled_coat { "coat" } else { bare_stem(features) };
    let mut text = String::from("// Generated: the principled surface with all its layers.\n\n");
    let module = format!("bsdf/{stem}.wgsl");
    text += &imports(["bsdf/principled.wgsl", "bsdf/scatter.wgsl", &module]);
    let [direction, eval, straight] =
        FUNCTIONS.map(|(function, _, arguments, _, _)| call(stem, function, arguments));
    let _ = write!(
        text,
        "\n// Samples `wi`. `u`: direction, `v`: which lobe; all in [0, 1 - 2^-24].\n\
         fn dispatch_principled_sample(s: Scatter, wo: vec3f, u: vec2f, v: f32) -> Scattered {{\n    \
         let p = principled_at(s, wo);\n    \
         let to = {direction};\n    \
         if (to.pdf <= 0.0) {{\n        return to;\n    }}\n    \
         let wi = to.wi;\n    \
         let e = {eval};\n    \
         if (e.pdf <= 0.0) {{\n        return scatter_absorb();\n    }}\n    \
         return Scattered(wi, e.pdf, e.f / e.pdf, 1.0);\n}}\n"
    );
    for (name, parameters, result, called, comment) in [
        ("eval", ", wi: vec3f", "Evaluated", eval.as_str(), FUNCTIONS[1].4),
        ("straight", "", "vec3f", &straight, FUNCTIONS[2].4),
    ] {
        let _ = write!(
            text,
            "\n// {comment}\n\
             fn dispatch_principled_{name}(s: Scatter, wo: vec3f{parameters}) -> {result} {{\n    \
             let p = principled_at(s, wo);\n    \
             return {called};\n}}\n"
        );
    }
    text
}

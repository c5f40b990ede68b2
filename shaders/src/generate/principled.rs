//! `scene/layers.wgsl`, `scene/bare.wgsl`, `scene/plain.wgsl`, `scene/principled.wgsl`: which layers the principled
//! materials of a scene have.

use super::wgsl::imports;
use crate::FeatureSet;
use std::fmt::Write as _;

/// Parameters that few scenes use, or what they are without them.
pub(crate) fn layers(features: &FeatureSet) -> String {
    let mut text = String::from("// Generated: which layers the principled surfaces have.\n\n");
    text += &imports([
        "bsdf/brushed_coat.wgsl",
        "bsdf/brushed_gloss.wgsl",
        "bsdf/gloss.wgsl",
        "bsdf/gloss_albedo.wgsl",
        "bsdf/layers.wgsl",
        "bsdf/scatter.wgsl",
        "bsdf/under_coat.wgsl",
        "bsdf/under_sheen.wgsl",
    ]);
    let choose = |present: bool, value: &'static str, absent| if present { value } else { absent };
    let specular = choose(features.principled_specular, "layers_specular(s)", "vec4f(1.0)");
    let through = choose(features.principled_transmission, "layers_transmission(s)", "0.0");
    let coated = features.principled_coat;
    let coat = choose(coated, "layers_coat(s)", "vec2f(0.0, 1.0)");
    let under = choose(coated, "under_coat_through(coat, on, c)", "1.0");
    let kept = choose(
        coated,
        "under_coat_kept(coat, g, s.roughness, dispatch_gloss_mean_flattened(s), entry)",
        "0.0",
    );
    let missing = choose(
        coated,
        "under_coat_missing(coat, g, s.roughness, dispatch_gloss_mean_flattened(s))",
        "g.mean_missing",
    );
    let flattened = match (coated, features.principled_anisotropy) {
        (true, true) => "brushed_coat_flattened(s, coat, g, w, c)",
        (true, false) => "under_coat_flattened(coat, g, c)",
        (false, _) => "0.0",
    };
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
         fn dispatch_coat_keeps(s: Scatter, coat: vec2f, g: GlossAlbedo, entry: vec2f) -> f32 {{\n    return {kept};\n}}\n\
         \n// What the lobe `g` as it is towards `w` loses under it at cosine `c`.\n\
         fn dispatch_coat_flattened(s: Scatter, coat: vec2f, g: GlossAlbedo, w: vec3f, c: f32) -> f32 {{\n    return {flattened};\n}}\n\
         \n// The mean of what the lobe `g` does not give back.\n\
         fn dispatch_coat_missing(s: Scatter, coat: vec2f, g: GlossAlbedo) -> f32 {{\n    return {missing};\n}}\n"
    );
    text + &sheen(features) + &gloss(features)
}

/// A function of `scene/layers.wgsl`: what it does, its head and its value.
type Row = (&'static str, &'static str, &'static str);

fn functions(rows: &[Row]) -> String {
    let function = |(comment, head, value): &Row| {
        format!("\n// {comment}\nfn dispatch_{head} {{\n    return {value};\n}}\n")
    };
    rows.iter().map(function).collect()
}

/// Sheen over the surface.
fn sheen(features: &FeatureSet) -> String {
    let choose = |present: &'static str, absent| {
        if features.principled_sheen { present } else { absent }
    };
    functions(&[
        (
            "Colour of the sheen, and its perceptual roughness.",
            "sheen(s: Scatter) -> vec4f",
            choose("layers_sheen(s)", "vec4f(0.0)"),
        ),
        (
            "What sheen lets through at cosine `c`.",
            "under_sheen(sheen: vec4f, c: f32) -> f32",
            choose("under_sheen_through(sheen, c)", "1.0"),
        ),
        (
            "How much it takes off the mean of what enters the lobe `g`.",
            "sheen_keeps(sheen: vec4f, g: GlossAlbedo, entry: vec2f) -> f32",
            choose("under_sheen_kept_mean(sheen, g, entry)", "0.0"),
        ),
        (
            "What the lobe `g` loses under it at cosine `c`.",
            "sheen_flattened(sheen: vec4f, g: GlossAlbedo, c: f32) -> f32",
            choose("under_sheen_flattened(sheen, g, c)", "0.0"),
        ),
        (
            "What it adds to the mean of what the lobe `g` does not give back.",
            "sheen_missing(sheen: vec4f, g: GlossAlbedo) -> f32",
            choose("under_sheen_missing(sheen, g)", "0.0"),
        ),
    ])
}

/// The lobe: round, or brushed in a direction.
fn gloss(features: &FeatureSet) -> String {
    let choose = |brushed: &'static str, round| {
        if features.principled_anisotropy { brushed } else { round }
    };
    let round = "gloss_albedo_at(s.roughness, gloss_alpha(s.roughness), on)";
    functions(&[
        (
            "The lobe's albedo; `on`: several reflections count.",
            "gloss_albedo(s: Scatter, on: bool) -> GlossAlbedo",
            choose("brushed_gloss_albedo(s, on)", round),
        ),
        (
            "The mean of what it loses under a smooth coat.",
            "gloss_mean_flattened(s: Scatter) -> f32",
            choose("brushed_coat_mean_flattened(s)", "gloss_albedo_mean_flattened(s.roughness)"),
        ),
        (
            "The lobe `g` as it is towards `w`, at cosine `c`.",
            "gloss_along(s: Scatter, g: GlossAlbedo, w: vec3f, c: f32) -> GlossAlbedo",
            choose("brushed_gloss_along(s, g, w, c)", "g"),
        ),
        (
            "What `w`, at cosine `c`, does not get back of the lobe `g` towards it.",
            "gloss_shares(s: Scatter, g: GlossAlbedo, w: vec3f, c: f32) -> GlossShares",
            choose("brushed_gloss_shares(s, g, w, c)", "gloss_albedo_shares(g, c)"),
        ),
        (
            "A direction reflected at a visible normal.",
            "gloss_sample(s: Scatter, alpha: f32, wo: vec3f, u: vec2f) -> vec3f",
            choose("brushed_gloss_sample(s, alpha, wo, u)", "gloss_sample(s.ns, wo, alpha, u)"),
        ),
        (
            "The lobe without Fresnel, times the cosine of `wi`, and its density.",
            "gloss_eval(s: Scatter, alpha: f32, wo: vec3f, wi: vec3f) -> vec2f",
            choose("brushed_gloss_eval(s, alpha, wo, wi)", "gloss_eval(s.ns, wo, wi, alpha)"),
        ),
    ])
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
    under(bare_stem(features), "bare", "under a coat")
}

/// The model under sheen.
pub(crate) fn plain(features: &FeatureSet) -> String {
    under(plain_stem(features), "plain", "under sheen")
}

/// The functions of the layer `stem` as those of `name`, what is `place`.
fn under(stem: &str, name: &str, place: &str) -> String {
    let mut text = format!("// Generated: the principled surface {place}.\n\n");
    let module = format!("bsdf/{stem}.wgsl");
    text += &imports(["bsdf/principled.wgsl", "bsdf/scatter.wgsl", &module]);
    for (function, parameters, arguments, result, comment) in FUNCTIONS {
        let called = call(stem, function, arguments);
        let _ = write!(
            text,
            "\n// {comment}\n\
             fn dispatch_{name}_{function}(s: Scatter, p: Principled, wo: vec3f{parameters}) -> {result} {{\n    \
             return {called};\n}}\n"
        );
    }
    text
}

fn plain_stem(features: &FeatureSet) -> &'static str {
    if features.principled_transmission { "thin" } else { "principled" }
}

fn bare_stem(features: &FeatureSet) -> &'static str {
    if features.principled_sheen { "sheen" } else { plain_stem(features) }
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

//! `scene/texture.wgsl`, `scene/lookup.wgsl` and `scene/texel.wgsl`: from the format of a texture to its texels.

use super::wgsl::{imports, switch, tag};
use crate::FeatureSet;
use pack::abi::TextureFormat;
use std::fmt::Write as _;

/// A texture, or white where there is none.
pub(crate) fn texture(features: &FeatureSet) -> String {
    let mut text = String::from("// Generated: whether this scene has textures.\n\n");
    text += &imports(["texture/texture_point.wgsl"]);
    let (body, alpha, at) = if features.textures.is_empty() {
        ("    return vec4f(1.0);\n", "    return 1.0;\n", "    return vec4f(1.0);\n")
    } else {
        text += &imports([
            "scene/constants.wgsl",
            "scene/lookup.wgsl",
            "scene/records.wgsl",
            "texture/bilinear.wgsl",
        ]);
        (
            "    if (i == NONE) {\n        return vec4f(1.0);\n    }\n    return texture_lookup(i, at);\n",
            "    if (i == NONE) {\n        return 1.0;\n    }\n    return texture_lookup_alpha(i, at);\n",
            "    return bilinear_at(load_texture(i), place);\n",
        )
    };
    let _ = write!(
        text,
        "\n// Texture `i` at a point, linear; 1 in every channel where `i` is `NONE`.\n\
         fn texture_fetch(i: u32, at: TexturePoint) -> vec4f {{\n{body}}}\n\
         \n// The alpha of texture `i` at a point.\n\
         fn texture_alpha(i: u32, at: TexturePoint) -> f32 {{\n{alpha}}}\n\
         \n// Texture `i`, an image, at `place`, 0 ..= 1 from its top left corner, linear.\n\
         fn texture_fetch_at(i: u32, place: vec2f) -> vec4f {{\n{at}}}\n"
    );
    text
}

/// An image or an expression.
pub(crate) fn lookup(features: &FeatureSet) -> String {
    let mut text = String::from("// Generated: whether textures of this scene are computed.\n\n");
    let computed = features.textures.contains(&TextureFormat::Expression);
    let (module, at) = if computed { ("expression", "at") } else { ("bilinear", "at.uv") };
    text += &imports([format!("texture/{module}.wgsl").as_str(), "texture/texture_point.wgsl"]);
    let alpha = if computed {
        text += &imports(["scene/constants.wgsl", "scene/records.wgsl", "texture/bilinear.wgsl"]);
        "    if (load_texture_format(i) == TEXTURE_EXPRESSION) {\n        \
         return expression_fetch(i, at).w;\n    }\n"
    } else {
        ""
    };
    let _ = write!(
        text,
        "\n// Texture `i` at a point, linear.\n\
         fn texture_lookup(i: u32, at: TexturePoint) -> vec4f {{\n    return {module}_fetch(i, {at});\n}}\n\
         \n// The alpha of texture `i` at a point.\n\
         fn texture_lookup_alpha(i: u32, at: TexturePoint) -> f32 {{\n{alpha}    return bilinear_fetch_alpha(i, at.uv);\n}}\n"
    );
    text
}

/// One texel of a texture.
pub(crate) fn texel(features: &FeatureSet) -> String {
    let rows: Vec<(&TextureFormat, &str, &str)> = features
        .textures
        .iter()
        .filter_map(|format| match format {
            TextureFormat::Rgba8Srgb => Some((format, "rgba8", "srgb")),
            TextureFormat::Rgba8Linear => Some((format, "rgba8", "linear")),
            TextureFormat::Rgba16Float => Some((format, "rgba16", "linear")),
            TextureFormat::Expression => None,
        })
        .collect();
    let mut files: Vec<String> = rows.iter().map(|row| format!("texture/{}.wgsl", row.1)).collect();
    files.dedup();
    let mut text = String::from("// Generated: the texture formats of this scene.\n\n");
    text += &imports(["abi/texture.wgsl", "scene/constants.wgsl"]);
    text += &imports(files.iter().map(String::as_str));
    let cases = |function: fn(&str, &str) -> String| -> Vec<(String, String)> {
        let case = |(format, file, coding): &(&TextureFormat, &str, &str)| {
            let call = format!("{}(image.offset, i)", function(file, coding));
            (tag("TEXTURE", &format.stem()), call)
        };
        rows.iter().map(case).collect()
    };
    let decode = cases(|file, coding| format!("{file}_{coding}"));
    let mut alpha = cases(|file, _| format!("{file}_alpha"));
    // Both codings of a byte have the same.
    if alpha.iter().all(|(_, call)| *call == alpha[0].1) {
        alpha.truncate(1);
    }
    let _ = write!(
        text,
        "\n// Texel `i` of `image`, linear.\n\
         fn texel_decode(image: Texture, i: u32) -> vec4f {{\n{}}}\n\
         \n// The alpha of texel `i` of `image`.\n\
         fn texel_alpha(image: Texture, i: u32) -> f32 {{\n{}}}\n",
        switch("image.format", &decode, "vec4f(1.0)"),
        switch("image.format", &alpha, "1.0")
    );
    text
}

//! `scene/dispatch_light.wgsl`: from the kind of a light to its functions.

use super::{cases, imports, switch};
use crate::FeatureSet;
use pack::abi::LightKind;
use std::fmt::Write as _;

/// The functions of a light kind.
pub(crate) fn dispatch(features: &FeatureSet) -> String {
    let rows: Vec<(&str, &str)> = features
        .lights
        .iter()
        .map(|kind| match kind {
            LightKind::Sphere => ("LIGHT_SPHERE", "sphere"),
            LightKind::Rectangle => ("LIGHT_RECTANGLE", "rectangle"),
            LightKind::Triangle => ("LIGHT_TRIANGLE", "triangle"),
            LightKind::Sky => ("LIGHT_SKY", "sky"),
        })
        .collect();
    let files: Vec<String> = rows.iter().map(|row| format!("light/{}.wgsl", row.1)).collect();
    let mut text = String::from("// Generated: the lights of this scene.\n\n");
    text += &imports([
        "abi/light.wgsl",
        "light/light_sample.wgsl",
        "math/vector.wgsl",
        "scene/constants.wgsl",
        "scene/motion.wgsl",
        "scene/records.wgsl",
        "shape/sphere.wgsl",
        "shape/triangle.wgsl",
        "trace/alpha.wgsl",
    ]);
    text += &imports(files.iter().map(String::as_str));
    let sample = cases(&rows, |stem| match stem {
        "sky" => "sky_light_sample(u)".to_owned(),
        _ => format!("{stem}_light_sample(light, p, u)"),
    });
    let rows: Vec<_> = rows.iter().copied().filter(|row| row.1 != "sky").collect();
    let pdf = cases(&rows, |stem| match stem {
        "sphere" => "sphere_light_pdf(light, p)".to_owned(),
        _ => format!("{stem}_light_pdf(light, p, x, cos_l)"),
    });
    let _ = write!(
        text,
        "\n// A direction from `p` to the light.\n\
         fn dispatch_light_sample(light: Light, p: vec3f, u: vec2f) -> LightSample {{\n{}}}\n\
         \n// Density of `dispatch_light_sample` towards the point `x` of a light that is a surface,\n\
         // where the cosine to the geometric normal is `cos_l`, of either sign.\n\
         fn dispatch_light_pdf(light: Light, p: vec3f, x: vec3f, cos_l: f32) -> f32 {{\n{}}}\n",
        switch("light.kind", &sample, "light_sample_none()"),
        switch("light.kind", &pdf, "0.0"),
    );
    text += &shift(features);
    text += &surface(features);
    text
}

/// Where a light is.
fn shift(features: &FeatureSet) -> String {
    let triangle = "dispatch_triangle_shift(light.primitive, time)";
    let cases: Vec<(&str, String)> = features
        .lights
        .iter()
        .filter_map(|kind| match kind {
            LightKind::Sphere if features.spheres => {
                Some(("LIGHT_SPHERE", "dispatch_sphere_shift(light.primitive, time)".to_owned()))
            }
            LightKind::Rectangle if features.triangles => {
                Some(("LIGHT_RECTANGLE", triangle.to_owned()))
            }
            LightKind::Triangle if features.triangles => {
                Some(("LIGHT_TRIANGLE", triangle.to_owned()))
            }
            _ => None,
        })
        .collect();
    format!(
        "\n// How far the light has come at `time`.\n\
         fn dispatch_light_shift(light: Light, time: f32) -> vec3f {{\n{}}}\n",
        switch("light.kind", &cases, "vec3f(0.0)"),
    )
}

/// Texture coordinates and cut-outs of a light.
fn surface(features: &FeatureSet) -> String {
    let sphere = "sphere_uv(vector_unit_or(x - light.origin, vec3f(0.0, 1.0, 0.0)))";
    let flat = "triangle_uv(light.primitive, triangle_weights(light.primitive, x))";
    let cases: Vec<(&str, String)> = features
        .lights
        .iter()
        .filter_map(|kind| match kind {
            LightKind::Sphere => Some(("LIGHT_SPHERE", sphere.to_owned())),
            LightKind::Rectangle => Some(("LIGHT_RECTANGLE", flat.to_owned())),
            LightKind::Triangle => Some(("LIGHT_TRIANGLE", flat.to_owned())),
            LightKind::Sky => None,
        })
        .filter(|(tag, _)| features.triangles || *tag == "LIGHT_SPHERE")
        .collect();
    let uv = if features.textures.is_empty() {
        "    return vec2f(0.0);\n".to_owned()
    } else {
        "    let i = light.material;\n    \
         if (load_material_emission_texture(i) == NONE && load_material_alpha_texture(i) == NONE) {\n        \
         return vec2f(0.0);\n    }\n"
            .to_owned()
            + &switch("light.kind", &cases, "vec2f(0.0)")
    };
    let exists = if features.alpha_clip { "alpha_exists(material, uv)" } else { "true" };
    format!(
        "\n// Texture coordinates of the light's point `x`; 0 where its material has no texture for them.\n\
         fn dispatch_light_uv(light: Light, x: vec3f) -> vec2f {{\n{uv}}}\n\
         \n// Whether a light of material `material` exists at `uv`.\n\
         fn dispatch_light_exists(material: u32, uv: vec2f) -> bool {{\n    return {exists};\n}}\n"
    )
}

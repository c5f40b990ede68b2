//! `scene/dispatch_light.wgsl`: from the kind of a light to its functions.

use super::wgsl::{imports, switch, tag};
use crate::FeatureSet;
use pack::abi::{LightKind, LightSurface};
use std::fmt::Write as _;

/// The functions of a light kind.
pub(crate) fn dispatch(features: &FeatureSet) -> String {
    let files: Vec<String> =
        features.lights.iter().map(|kind| format!("light/{}.wgsl", kind.stem())).collect();
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
        "texture/texture_point.wgsl",
        "trace/alpha.wgsl",
    ]);
    text += &imports(files.iter().map(String::as_str));
    let sample = cases(features, |kind, stem| match kind {
        LightKind::Sky => Some(format!("{stem}_light_sample(u)")),
        LightKind::Directional => Some(format!("{stem}_light_sample(light, u)")),
        LightKind::Sphere | LightKind::Rectangle | LightKind::Triangle => {
            Some(format!("{stem}_light_sample(light, p, u)"))
        }
    });
    let pdf = cases(features, |kind, stem| match kind.surface()? {
        LightSurface::Sphere => Some(format!("{stem}_light_pdf(light, p)")),
        LightSurface::Triangles => Some(format!("{stem}_light_pdf(light, p, x, cos_l)")),
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

/// A case for each kind of light for which `call`, given the beginning of its functions' names, has something
/// to do.
fn cases(
    features: &FeatureSet,
    call: impl Fn(LightKind, &str) -> Option<String>,
) -> Vec<(String, String)> {
    let case = |kind: &LightKind| {
        let stem = kind.stem();
        Some((tag("LIGHT", &stem), call(*kind, &stem)?))
    };
    features.lights.iter().filter_map(case).collect()
}

/// Where a light is.
fn shift(features: &FeatureSet) -> String {
    let cases = cases(features, |kind, _| match kind.surface()? {
        LightSurface::Sphere => {
            features.spheres.then(|| "dispatch_sphere_shift(light.primitive, time)".to_owned())
        }
        LightSurface::Triangles => {
            features.triangles.then(|| "dispatch_triangle_shift(light.primitive, time)".to_owned())
        }
    });
    format!(
        "\n// How far the light has come at `time`.\n\
         fn dispatch_light_shift(light: Light, time: f32) -> vec3f {{\n{}}}\n",
        switch("light.kind", &cases, "vec3f(0.0)"),
    )
}

/// Texture coordinates and cut-outs of a light.
fn surface(features: &FeatureSet) -> String {
    let sphere = "texture_point(sphere_uv(vector_unit_or(x - light.origin, vec3f(0.0, 1.0, 0.0))))";
    let flat = "triangle_texture_point(light.primitive, triangle_weights(light.primitive, x))";
    let cases = cases(features, |kind, _| match kind.surface()? {
        LightSurface::Sphere => Some(sphere.to_owned()),
        LightSurface::Triangles => features.triangles.then(|| flat.to_owned()),
    });
    let point = if features.textures.is_empty() {
        "    return texture_point(vec2f(0.0));\n".to_owned()
    } else {
        "    let i = light.material;\n    \
         if (load_material_emission_texture(i) == NONE && load_material_alpha_texture(i) == NONE) {\n        \
         return texture_point(vec2f(0.0));\n    }\n"
            .to_owned()
            + &switch("light.kind", &cases, "texture_point(vec2f(0.0))")
    };
    let exists = if features.alpha_clip { "alpha_exists(material, at)" } else { "true" };
    format!(
        "\n// The light's point `x` for textures; any where its material has none.\n\
         fn dispatch_light_texture_point(light: Light, x: vec3f) -> TexturePoint {{\n{point}}}\n\
         \n// Whether a light of material `material` exists at a point.\n\
         fn dispatch_light_exists(material: u32, at: TexturePoint) -> bool {{\n    return {exists};\n}}\n"
    )
}

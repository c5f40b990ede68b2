//! `scene/dispatch*.wgsl`, `scene/sampler.wgsl`, `scene/texture.wgsl`, `scene/texel.wgsl`: from a record's tag to the function
//! of its kind. The case of a kind reads the same in every kernel, so that a kernel with fewer kinds
//! computes the same bits.

use super::{imports, switch};
use crate::FeatureSet;
use pack::abi::{LightKind, MaterialKind, SamplerKind, TextureFormat};
use std::fmt::Write as _;

/// Camera, sky, surfaces and direct light.
pub(crate) fn path(features: &FeatureSet) -> String {
    let mut text =
        String::from("// Generated: camera, sky, shapes and direct light of this scene.\n\n");
    let mut modules = vec![
        "abi/material.wgsl",
        "bsdf/scatter.wgsl",
        "camera/film_plane.wgsl",
        "camera/pinhole.wgsl",
        "kernel/state.wgsl",
        "math/vector.wgsl",
        "sampler/key.wgsl",
        "scene/constants.wgsl",
        "scene/dispatch_sky.wgsl",
        "scene/motion.wgsl",
        "scene/placed.wgsl",
        "scene/records.wgsl",
        "scene/sampler.wgsl",
        "shape/sphere.wgsl",
        "shape/triangle.wgsl",
        "surface/surface.wgsl",
        "trace/ray.wgsl",
    ];
    if features.lens {
        modules.push("camera/thin_lens.wgsl");
    }
    if features.normal_maps {
        modules.push("surface/normal_map.wgsl");
    }
    if !features.lights.is_empty() {
        modules.push("kernel/direct.wgsl");
    }
    text += &imports(modules);
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

fn camera(features: &FeatureSet) -> String {
    let lens = if features.lens {
        "    if (camera.lens_radius > 0.0) {\n        \
         return thin_lens_ray(camera, at, sample_2d(key, PURPOSE_LENS));\n    }\n"
    } else {
        ""
    };
    format!(
        "\n// The ray through `at`, pixels from the top left corner.\n\
         fn dispatch_camera(key: SampleKey, at: vec2f) -> CameraRay {{\n    \
         let camera = load_camera();\n{lens}    return pinhole_ray(camera, at);\n}}\n"
    )
}

fn surface(features: &FeatureSet) -> String {
    let mut body = String::new();
    if features.spheres {
        let mut sphere = String::from(
            "    let i = hit.prim & ~PRIM_SPHERE;\n    \
             let start = dispatch_thing_origin(load_sphere_object(i), origin, time);\n    \
             var s = sphere_surface(i, start, dir, hit.t);\n    dispatch_thing_carry(&s, load_sphere_object(i), time);\n",
        );
        if !features.textures.is_empty() || features.tangents {
            sphere += "    s.uv = sphere_uv(select(-s.ng, s.ng, s.front));\n";
        }
        sphere += "    return s;\n";
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
             var s = {function}(hit.prim, hit.b, dir);\n    \
             dispatch_triangle_carry(&s, hit.prim, time);\n    return s;\n"
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
        let sphere = "(*s).tangent = sphere_tangent(select(-(*s).ng, (*s).ng, (*s).front));";
        let triangle = "let t = dispatch_placed_tangent(hit.instance, triangle_tangent(hit.prim));\n    (*s).tangent = t.xyz;\n    \
                        (*s).handed = select(-t.w, t.w, (*s).front);";
        let lines = match (features.spheres, features.triangles) {
            (true, true) => format!(
                "    if ((hit.prim & PRIM_SPHERE) != 0u) {{\n        {sphere}\n        \
                 (*s).handed = select(-1.0, 1.0, (*s).front);\n        return;\n    }}\n    {triangle}\n"
            ),
            (true, false) => {
                format!("    {sphere}\n    (*s).handed = select(-1.0, 1.0, (*s).front);\n")
            }
            _ => format!("    {triangle}\n"),
        };
        body += &lines;
    }
    format!(
        "\n// Finds the direction in which u grows, for materials whose flags ask for it.\n\
         fn dispatch_tangent(s: ptr<function, Surface>, hit: Hit, flags: u32) {{\n{body}}}\n"
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
         fn dispatch_shading_normal(s: ptr<function, Surface>, m: Material, dir: vec3f) {{\n{map}}}\n"
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

/// What a ray sees that hits nothing; weighted where the sky is sampled, too.
fn miss(features: &FeatureSet) -> String {
    let body = if features.lights.contains(&LightKind::Sky) {
        "    let radiance = dispatch_sky(dir);\n    \
         if (vector_max(radiance) <= 0.0) {\n        return radiance;\n    }\n    \
         return radiance * direct_sky_weight(dir, pdf);\n"
    } else {
        "    return dispatch_sky(dir);\n"
    };
    format!(
        "\n// Radiance found by a direction that was sampled with density `pdf` and hits nothing.\n\
         fn dispatch_miss(dir: vec3f, pdf: f32) -> vec3f {{\n{body}}}\n"
    )
}

fn direct(features: &FeatureSet) -> String {
    let sample = if features.lights.is_empty() {
        ""
    } else {
        "    direct_sample(path, p, gap, scatter, wo);\n"
    };
    let weight =
        if features.surface_lights() { "direct_weight(origin, dir, pdf, s, time)" } else { "1.0" };
    format!(
        "\n// Leaves a shadow ray in `path` if light may reach the vertex at `p` directly; rays start off it\n\
         // by `gap` on either side.\n\
         fn dispatch_direct(path: ptr<function, Path>, p: vec3f, gap: vec3f, scatter: Scatter, wo: vec3f) {{\n{sample}}}\n\
         \n// Weight of emission that a direction sampled with density `pdf` has found at `time`.\n\
         fn dispatch_emission_weight(origin: vec3f, dir: vec3f, pdf: f32, s: Surface, time: f32) -> f32 {{\n    \
         return {weight};\n}}\n"
    )
}

/// Tag, beginning of the functions' names, and the arguments of its sample, eval and pdf.
fn bsdf_row(kind: MaterialKind) -> (&'static str, &'static str, [&'static str; 3]) {
    match kind {
        MaterialKind::Diffuse => (
            "MATERIAL_DIFFUSE",
            "diffuse",
            ["s, sample_2d(key, PURPOSE_DIRECTION)", "s, wi", "s, wi"],
        ),
        MaterialKind::Metal => (
            "MATERIAL_METAL",
            "metal",
            [
                "s, wo, sample_2d(key, PURPOSE_DIRECTION), sample_1d(key, PURPOSE_RADIUS)",
                "s, wo, wi",
                "s, wo, wi",
            ],
        ),
        MaterialKind::Dielectric => {
            ("MATERIAL_DIELECTRIC", "dielectric", ["s, wo, sample_1d(key, PURPOSE_LOBE)", "", ""])
        }
        MaterialKind::Water => {
            ("MATERIAL_WATER", "water", ["s, wo, sample_1d(key, PURPOSE_LOBE)", "", ""])
        }
        MaterialKind::Emissive => ("MATERIAL_EMISSIVE", "emissive", ["", "", ""]),
        MaterialKind::Principled => {
            ("MATERIAL_PRINCIPLED", "dispatch_principled", DIRECTION_AND_LOBE)
        }
        MaterialKind::Conductor => ("MATERIAL_CONDUCTOR", "conductor", DIRECTION_AND_LOBE),
        MaterialKind::RoughDielectric => {
            ("MATERIAL_ROUGH_DIELECTRIC", "rough_dielectric", DIRECTION_AND_LOBE)
        }
        MaterialKind::Clearcoat => (
            "MATERIAL_CLEARCOAT",
            "clearcoat",
            [
                "s, wo, sample_2d(key, PURPOSE_DIRECTION), sample_1d(key, PURPOSE_RADIUS), sample_1d(key, PURPOSE_LOBE)",
                "s, wo, wi",
                "s, wo, wi",
            ],
        ),
        MaterialKind::Stone => ("MATERIAL_STONE", "stone", DIRECTION_AND_LOBE),
        MaterialKind::Wood => ("MATERIAL_WOOD", "wood", DIRECTION_AND_LOBE),
        MaterialKind::Fabric => ("MATERIAL_FABRIC", "fabric", DIRECTION_AND_LOBE),
        MaterialKind::Petal => (
            "MATERIAL_PETAL",
            "petal",
            [
                "s, wo, sample_2d(key, PURPOSE_DIRECTION), sample_1d(key, PURPOSE_LOBE), \
                 sample_1d(key, PURPOSE_RADIUS)",
                "s, wo, wi",
                "s, wo, wi",
            ],
        ),
        MaterialKind::Leaf => (
            "MATERIAL_LEAF",
            "leaf",
            [
                "s, wo, sample_2d(key, PURPOSE_DIRECTION), sample_1d(key, PURPOSE_LOBE)",
                "s, wo, wi",
                "s, wo, wi",
            ],
        ),
    }
}

/// Arguments of a model with two lobes, one of which is chosen.
const DIRECTION_AND_LOBE: [&str; 3] = [
    "s, wo, sample_2d(key, PURPOSE_DIRECTION), sample_1d(key, PURPOSE_LOBE)",
    "s, wo, wi",
    "s, wo, wi",
];

/// Whether places of an object differ under this kind.
fn has_pattern(kind: MaterialKind) -> bool {
    matches!(kind, MaterialKind::Stone | MaterialKind::Wood | MaterialKind::Fabric)
}

/// What patterns change of a surface point before it scatters. The function has the same head and foot in
/// every kernel, and a line for each kind with a pattern.
pub(crate) fn pattern(features: &FeatureSet) -> String {
    let kinds = features.materials.iter().filter(|kind| has_pattern(**kind));
    let rows: Vec<_> = kinds.map(|kind| bsdf_row(*kind)).collect();
    let files: Vec<String> = rows.iter().map(|row| format!("bsdf/{}.wgsl", row.1)).collect();
    let mut text = String::from("// Generated: the patterns of this scene's materials.\n\n");
    text += &imports(["bsdf/scatter.wgsl", "scene/constants.wgsl", "surface/surface.wgsl"]);
    text += &imports(files.iter().map(String::as_str));
    text += "\n// Gives `scatter` at `s` the colour, roughness and shading normal of its place, where the kind has a\n\
             // pattern; once a vertex, so that sampling, value and density see the same surface.\n\
             fn dispatch_pattern(scatter: ptr<function, Scatter>, s: Surface, wo: vec3f) {\n    \
             switch ((*scatter).kind) {\n";
    for (tag, stem, _) in rows {
        let _ = writeln!(text, "        case {tag}: {{ {stem}_pattern(scatter, s, wo); }}");
    }
    text + "        default: {}\n    }\n}\n"
}

/// What goes straight through a sheet. The function has the same head and foot in every kernel, and a line for
/// each kind of sheet.
pub(crate) fn straight(features: &FeatureSet) -> String {
    let mut text = String::from("// Generated: the thin sheets of this scene.\n\n");
    text += &imports(["bsdf/scatter.wgsl", "scene/constants.wgsl"]);
    let mut cases = String::new();
    if features.materials.contains(&MaterialKind::Petal) {
        text += &imports(["bsdf/petal.wgsl"]);
        cases += "        case MATERIAL_PETAL: { return petal_through(s, wo); }\n";
    }
    if features.materials.contains(&MaterialKind::Principled) {
        text += &imports(["scene/principled.wgsl"]);
        cases +=
            "        case MATERIAL_PRINCIPLED: { return dispatch_principled_straight(s, wo); }\n";
    }
    let _ = write!(
        text,
        "\n// Share of light that goes straight through the sheet at `s`.\n\
         fn dispatch_straight(s: Scatter, wo: vec3f) -> vec3f {{\n    switch (s.kind) {{\n{cases}        \
         default: {{ return vec3f(0.0); }}\n    }}\n}}\n"
    );
    text
}

/// A point in a medium scatters like a surface, but is of no material.
const PHASE_ROW: (&str, &str, [&str; 3]) =
    ("PHASE_KIND", "phase", ["s, wo, sample_2d(key, PURPOSE_DIRECTION)", "s, wo, wi", "s, wo, wi"]);

/// The module of a model's functions: written by hand, or generated where it depends on more than its kind.
fn module_of(stem: &str) -> String {
    match stem.strip_prefix("dispatch_") {
        Some(generated) => format!("scene/{generated}.wgsl"),
        None => format!("bsdf/{stem}.wgsl"),
    }
}

/// The three functions of a scattering model.
pub(crate) fn bsdf(features: &FeatureSet) -> String {
    let mut rows: Vec<_> = features.materials.iter().map(|kind| bsdf_row(*kind)).collect();
    if features.scattering {
        rows.push(PHASE_ROW);
    }
    let files: Vec<String> = rows.iter().map(|row| module_of(row.1)).collect();
    let mut text = String::from("// Generated: the scattering models of this scene.\n\n");
    text += &imports([
        "bsdf/scatter.wgsl",
        "sampler/key.wgsl",
        "scene/constants.wgsl",
        "scene/sampler.wgsl",
    ]);
    text += &imports(files.iter().map(String::as_str));
    let functions = [
        ("sample", "wo: vec3f, key: SampleKey", "Scattered", "scatter_absorb()", "Samples `wi`."),
        ("eval", "wo: vec3f, wi: vec3f", "vec3f", "vec3f(0.0)", "f |cos|, delta lobes left out."),
        (
            "pdf",
            "wo: vec3f, wi: vec3f",
            "f32",
            "0.0",
            "Density of `dispatch_sample`, per steradian.",
        ),
    ];
    for (i, (name, parameters, result, absent, comment)) in functions.into_iter().enumerate() {
        let cases: Vec<(&str, String)> = rows
            .iter()
            .map(|(tag, stem, arguments)| (*tag, format!("{stem}_{name}({})", arguments[i])))
            .collect();
        let _ = write!(
            text,
            "\n// {comment}\nfn dispatch_{name}(s: Scatter, {parameters}) -> {result} {{\n{}}}\n",
            switch("s.kind", &cases, absent)
        );
    }
    text
}

/// The functions of a light kind.
pub(crate) fn light(features: &FeatureSet) -> String {
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
    let cases = |call: &dyn Fn(&str) -> String| -> Vec<(&str, String)> {
        rows.iter().map(|(tag, stem)| (*tag, call(stem))).collect()
    };
    let sample = cases(&|stem| match stem {
        "sky" => "sky_light_sample(u)".to_owned(),
        _ => format!("{stem}_light_sample(light, p, u)"),
    });
    let rows: Vec<_> = rows.iter().copied().filter(|row| row.1 != "sky").collect();
    let cases = |call: &dyn Fn(&str) -> String| -> Vec<(&str, String)> {
        rows.iter().map(|(tag, stem)| (*tag, call(stem))).collect()
    };
    let pdf = cases(&|stem| match stem {
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
    text += &light_shift(features);
    text += &light_surface(features);
    text
}

/// Where a light is.
fn light_shift(features: &FeatureSet) -> String {
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
fn light_surface(features: &FeatureSet) -> String {
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

/// The numbers that every random decision is made with.
pub(crate) fn sampler(features: &FeatureSet) -> String {
    let rows: Vec<(&str, &str)> = features
        .samplers
        .iter()
        .map(|kind| match kind {
            SamplerKind::Sobol => ("SAMPLER_SOBOL", "sobol"),
            SamplerKind::Pcg => ("SAMPLER_PCG", "pcg"),
        })
        .collect();
    let files: Vec<String> = rows.iter().map(|row| format!("sampler/{}.wgsl", row.1)).collect();
    let mut text = String::from("// Generated: the sampler of this scene.\n\n");
    text += &imports(["sampler/key.wgsl", "scene/constants.wgsl", "scene/records.wgsl"]);
    text += &imports(files.iter().map(String::as_str));
    for (name, result, none) in [("1d", "f32", "0.0"), ("2d", "vec2f", "vec2f(0.0)")] {
        let cases: Vec<(&str, String)> =
            rows.iter().map(|(tag, stem)| (*tag, format!("{stem}_{name}(key, purpose)"))).collect();
        let _ = write!(
            text,
            "\n// Numbers for `purpose`, in [0, 1 - 2^-24].\n\
             fn sample_{name}(key: SampleKey, purpose: u32) -> {result} {{\n{}}}\n",
            switch("load_frame_sampler()", &cases, none)
        );
    }
    text
}

/// A texture, or white where there is none.
pub(crate) fn texture(features: &FeatureSet) -> String {
    let mut text = String::from("// Generated: whether this scene has textures.\n\n");
    let (body, at) = if features.textures.is_empty() {
        ("    return vec4f(1.0);\n", "    return vec4f(1.0);\n")
    } else {
        text += &imports(["scene/constants.wgsl", "scene/records.wgsl", "texture/bilinear.wgsl"]);
        (
            "    if (i == NONE) {\n        return vec4f(1.0);\n    }\n    return bilinear_fetch(i, uv);\n",
            "    return bilinear_at(load_texture(i), place);\n",
        )
    };
    let _ = write!(
        text,
        "\n// Texture `i` at `uv`, linear; 1 in every channel where `i` is `NONE`.\n\
         fn texture_fetch(i: u32, uv: vec2f) -> vec4f {{\n{body}}}\n\
         \n// Texture `i` at `place`, 0 ..= 1 from its top left corner, linear.\n\
         fn texture_fetch_at(i: u32, place: vec2f) -> vec4f {{\n{at}}}\n"
    );
    text
}

/// One texel of a texture.
pub(crate) fn texel(features: &FeatureSet) -> String {
    let rows: Vec<(&str, &str, &str)> = features
        .textures
        .iter()
        .map(|format| match format {
            TextureFormat::Rgba8Srgb => ("TEXTURE_RGBA8_SRGB", "rgba8", "rgba8_srgb"),
            TextureFormat::Rgba8Linear => ("TEXTURE_RGBA8_LINEAR", "rgba8", "rgba8_linear"),
            TextureFormat::Rgba16Float => ("TEXTURE_RGBA16_FLOAT", "rgba16", "rgba16_linear"),
        })
        .collect();
    let mut files: Vec<String> = rows.iter().map(|row| format!("texture/{}.wgsl", row.1)).collect();
    files.dedup();
    let mut text = String::from("// Generated: the texture formats of this scene.\n\n");
    text += &imports(["abi/texture.wgsl", "scene/constants.wgsl"]);
    text += &imports(files.iter().map(String::as_str));
    let cases: Vec<(&str, String)> = rows
        .iter()
        .map(|(tag, _, function)| (*tag, format!("{function}(image.offset, i)")))
        .collect();
    let _ = write!(
        text,
        "\n// Texel `i` of `image`, linear.\n\
         fn texel_decode(image: Texture, i: u32) -> vec4f {{\n{}}}\n",
        switch("image.format", &cases, "vec4f(1.0)")
    );
    text
}

//! `scene/dispatch_bsdf.wgsl`, `scene/dispatch_pattern.wgsl`, `scene/straight.wgsl`: from the kind of a material to the
//! functions of its model.
//!
//! The case of a kind reads the same in every kernel, so that a kernel with fewer kinds computes the same bits.

use super::{imports, switch};
use crate::FeatureSet;
use pack::abi::MaterialKind;
use std::fmt::Write as _;

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
pub(crate) fn dispatch(features: &FeatureSet) -> String {
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

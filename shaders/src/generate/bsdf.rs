//! `scene/model.wgsl`, `scene/dispatch_bsdf.wgsl`, `scene/dispatch_mix.wgsl`, `scene/dispatch_pattern.wgsl`,
//! `scene/straight.wgsl`: from the kind of a material to the functions of its model.
//!
//! The case of a kind reads the same in every kernel, so that a kernel with fewer kinds computes the same bits.

use super::wgsl::{imports, switch, tag};
use crate::FeatureSet;
use pack::abi::{Lobes, MaterialKind, Number};
use std::fmt::Write as _;

/// A case of a switch over models.
struct Row {
    tag: String,
    /// Beginning of the functions' names.
    stem: String,
    /// Arguments of its sample and eval.
    arguments: [String; 2],
}

fn row(kind: MaterialKind) -> Row {
    let (stem, traits) = (kind.stem(), kind.traits());
    let begin = match traits.lobes {
        Lobes::None => "",
        Lobes::Fixed => "s",
        Lobes::Delta | Lobes::Moving => "s, wo",
    };
    let numbers = traits.numbers.iter().map(|number| match number {
        Number::Direction => "sample_2d(key, PURPOSE_DIRECTION)",
        Number::Lobe => "sample_1d(key, PURPOSE_LOBE)",
        Number::Radius => "sample_1d(key, PURPOSE_RADIUS)",
    });
    let sample: Vec<&str> =
        [begin].into_iter().filter(|begin| !begin.is_empty()).chain(numbers).collect();
    let value = match traits.lobes {
        Lobes::None | Lobes::Delta => "",
        Lobes::Fixed => "s, wi",
        Lobes::Moving => "s, wo, wi",
    };
    Row {
        tag: tag("MATERIAL", &stem),
        stem: if traits.generated { format!("dispatch_{stem}") } else { stem },
        arguments: [sample.join(", "), value.to_owned()],
    }
}

/// Which of its materials a surface has at a point. As in `pattern`, the function has the same head and foot in every
/// kernel.
pub(crate) fn mix(features: &FeatureSet) -> String {
    let mut text = String::from("// Generated: whether materials of this scene are mixed.\n\n");
    text += &imports([
        "abi/material_head.wgsl",
        "sampler/key.wgsl",
        "scene/constants.wgsl",
        "surface/surface.wgsl",
    ]);
    let mut case = "";
    if features.materials.contains(&MaterialKind::Mix) {
        text += &imports(["bsdf/mix.wgsl"]);
        case = "        case MATERIAL_MIX: { mix_choose(s, m, key, time); }\n";
    }
    let _ = write!(
        text,
        "\n// Gives the surface `s` of material `m` one of those that `m` is made of.\n\
         fn dispatch_mix(\n    \
         s: ptr<function, Surface>, m: ptr<function, MaterialHead>, key: SampleKey, time: f32\n) {{\n    \
         switch ((*m).kind) {{\n{case}        default: {{}}\n    }}\n}}\n"
    );
    text
}

/// What patterns change of a surface point before it scatters. The function has the same head and foot in
/// every kernel, and a line for each kind with a pattern.
pub(crate) fn pattern(features: &FeatureSet) -> String {
    let kinds = features.materials.iter().filter(|kind| kind.traits().pattern);
    let rows: Vec<Row> = kinds.map(|kind| row(*kind)).collect();
    let files: Vec<String> = rows.iter().map(|row| module_of(&row.stem)).collect();
    let mut text = String::from("// Generated: the patterns of this scene's materials.\n\n");
    text += &imports(["bsdf/scatter.wgsl", "scene/constants.wgsl", "surface/surface.wgsl"]);
    text += &imports(files.iter().map(String::as_str));
    text += "\n// Gives `scatter` at `s` the colour, roughness and shading normal of its place, where the kind has a\n\
             // pattern; once a vertex, so that sampling, value and density see the same surface.\n\
             fn dispatch_pattern(scatter: ptr<function, Scatter>, s: Surface, wo: vec3f) {\n    \
             switch ((*scatter).kind) {\n";
    for Row { tag, stem, .. } in rows {
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
    for kind in features.materials.iter().rev() {
        if let Some(function) = kind.traits().straight {
            let Row { tag, stem, .. } = row(*kind);
            text += &imports([module_of(&stem).as_str()]);
            let _ = writeln!(cases, "        case {tag}: {{ return {function}(s, wo); }}");
        }
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
fn phase_row() -> Row {
    let sample = "s, wo, sample_2d(key, PURPOSE_DIRECTION)";
    Row {
        tag: "PHASE_KIND".to_owned(),
        stem: "phase".to_owned(),
        arguments: [sample, "s, wo, wi"].map(str::to_owned),
    }
}

/// The module of a model's functions: written by hand, or generated where it depends on more than its kind.
fn module_of(stem: &str) -> String {
    match stem.strip_prefix("dispatch_") {
        Some(generated) => format!("scene/{generated}.wgsl"),
        None => format!("bsdf/{stem}.wgsl"),
    }
}

/// The functions of a scattering model: name, parameters, result, what there is without a model, comment.
const FUNCTIONS: [[&str; 5]; 2] = [
    ["sample", "wo: vec3f, key: SampleKey", "Scattered", "scatter_absorb()", "Samples `wi`."],
    [
        "eval",
        "wo: vec3f, wi: vec3f",
        "Evaluated",
        "scatter_nothing()",
        "f |cos| and the density of `model_sample`, delta lobes left out.",
    ],
];

/// The models, as they are without regard to the sides of the surface.
pub(crate) fn model(features: &FeatureSet) -> String {
    let mut rows: Vec<Row> = features.materials.iter().map(|kind| row(*kind)).collect();
    if features.scattering {
        rows.push(phase_row());
    }
    let files: Vec<String> = rows.iter().map(|row| module_of(&row.stem)).collect();
    let mut text = String::from("// Generated: the scattering models of this scene.\n\n");
    text += &imports([
        "bsdf/scatter.wgsl",
        "sampler/key.wgsl",
        "scene/constants.wgsl",
        "scene/sampler.wgsl",
    ]);
    text += &imports(files.iter().map(String::as_str));
    for (i, [name, parameters, result, absent, comment]) in FUNCTIONS.into_iter().enumerate() {
        let cases: Vec<(&str, String)> = rows
            .iter()
            .map(|row| (row.tag.as_str(), format!("{}_{name}({})", row.stem, row.arguments[i])))
            .collect();
        let _ = write!(
            text,
            "\n// {comment}\nfn model_{name}(s: Scatter, {parameters}) -> {result} {{\n{}}}\n",
            switch("s.kind", &cases, absent)
        );
    }
    text
}

/// The models on the sides of a surface: the same in every kernel.
pub(crate) fn dispatch() -> String {
    let mut text = String::from("// Generated: how surfaces and media scatter.\n\n");
    text += &imports(["bsdf/fold.wgsl", "bsdf/scatter.wgsl", "sampler/key.wgsl"]);
    for [name, parameters, result, _, comment] in FUNCTIONS {
        let arguments = parameters.replace(": vec3f", "").replace(": SampleKey", "");
        let comment = comment.replace("model", "dispatch");
        let _ = write!(
            text,
            "\n// {comment}\nfn dispatch_{name}(s: Scatter, {parameters}) -> {result} {{\n    \
             return fold_{name}(s, {arguments});\n}}\n"
        );
    }
    text
}

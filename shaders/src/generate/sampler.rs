//! `scene/sampler.wgsl`: from the kind of a sampler to its numbers.

use super::wgsl::{imports, switch, tag};
use crate::FeatureSet;
use std::fmt::Write as _;

/// The numbers that every random decision is made with.
pub(crate) fn text(features: &FeatureSet) -> String {
    let files: Vec<String> =
        features.samplers.iter().map(|kind| format!("sampler/{}.wgsl", kind.stem())).collect();
    let mut text = String::from("// Generated: the sampler of this scene.\n\n");
    text += &imports(["sampler/key.wgsl", "scene/constants.wgsl", "scene/records.wgsl"]);
    text += &imports(files.iter().map(String::as_str));
    for (name, result, none) in [("1d", "f32", "0.0"), ("2d", "vec2f", "vec2f(0.0)")] {
        let cases: Vec<(String, String)> = features
            .samplers
            .iter()
            .map(|kind| {
                let stem = kind.stem();
                (tag("SAMPLER", &stem), format!("{stem}_{name}(key, purpose)"))
            })
            .collect();
        let _ = write!(
            text,
            "\n// Numbers for `purpose`, in [0, 1 - 2^-24].\n\
             fn sample_{name}(key: SampleKey, purpose: u32) -> {result} {{\n{}}}\n",
            switch("load_frame_sampler()", &cases, none)
        );
    }
    let cases: Vec<(String, String)> = features
        .samplers
        .iter()
        .map(|kind| {
            let stem = kind.stem();
            (tag("SAMPLER", &stem), format!("{stem}_of(key, purpose, id)"))
        })
        .collect();
    let _ = write!(
        text,
        "\n// A number for `purpose`, in [0, 1 - 2^-24], independent of those for any other `id`.\n\
         fn sample_of(key: SampleKey, purpose: u32, id: u32) -> f32 {{\n{}}}\n",
        switch("load_frame_sampler()", &cases, "0.0")
    );
    text
}

//! `scene/sampler.wgsl`: from the kind of a sampler to its numbers.

use super::{cases, imports, switch};
use crate::FeatureSet;
use pack::abi::SamplerKind;
use std::fmt::Write as _;

/// The numbers that every random decision is made with.
pub(crate) fn text(features: &FeatureSet) -> String {
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
        let cases = cases(&rows, |stem| format!("{stem}_{name}(key, purpose)"));
        let _ = write!(
            text,
            "\n// Numbers for `purpose`, in [0, 1 - 2^-24].\n\
             fn sample_{name}(key: SampleKey, purpose: u32) -> {result} {{\n{}}}\n",
            switch("load_frame_sampler()", &cases, none)
        );
    }
    text
}

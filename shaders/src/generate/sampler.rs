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
    let number = |name: &str, arguments: &str, none: &str| {
        let case = |stem: String| (tag("SAMPLER", &stem), format!("{stem}_{name}({arguments})"));
        let cases: Vec<_> = features.samplers.iter().map(|kind| case(kind.stem())).collect();
        switch("load_frame_sampler()", &cases, none)
    };
    let _ = write!(
        text,
        "\n// A number for `purpose`, in [0, 1 - 2^-24].\n\
         fn sample_1d(key: SampleKey, purpose: u32) -> f32 {{\n{}}}\n\
         \n// Two numbers for `purpose`, in [0, 1 - 2^-24].\n\
         fn sample_2d(key: SampleKey, purpose: u32) -> vec2f {{\n{}}}\n\
         \n// Two numbers for a point on a light, in [0, 1 - 2^-24].\n\
         fn sample_light(key: SampleKey) -> vec2f {{\n{}}}\n\
         \n// A number for `purpose`, in [0, 1 - 2^-24], independent of those for any other `id`.\n\
         fn sample_of(key: SampleKey, purpose: u32, id: u32) -> f32 {{\n{}}}\n",
        number("1d", "key, purpose", "0.0"),
        number("2d", "key, purpose", "vec2f(0.0)"),
        number("light", "key", "vec2f(0.0)"),
        number("of", "key, purpose, id", "0.0"),
    );
    text
}
